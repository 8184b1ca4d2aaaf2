"""How the points of a small patch lie to each other, two by two."""

from __future__ import annotations

from shapeviz_report.wording.base import Said, Wording, amount, as_percent, span

COUNT = 125

MIDDLE = 2
"""The fifth of an angle that is nothing special."""

LEANS = (
    ("twisted far left", "leans more than 37° to the left"),
    ("twisted left", "leans 12 to 37° to the left"),
    ("untwisted", "leans sideways by less than 12°"),
    ("twisted right", "leans 12 to 37° to the right"),
    ("twisted far right", "leans more than 37° to the right"),
)
HEIGHTS = (
    ("dropping steeply", "more than 37° below"),
    ("dropping", "12 to 37° below"),
    ("level", "within 12° of"),
    ("rising", "12 to 37° above"),
    ("rising steeply", "more than 37° above"),
)
TURNS = (
    ("folded inwards", "folds inwards by more than 108°"),
    ("hollow", "bends inwards by 36 to 108°"),
    ("straight", "turns by less than 36°"),
    ("rounded", "bends outwards by 36 to 108°"),
    ("folded outwards", "folds outwards by more than 108°"),
)
"""What the fifths of alpha, phi and theta say of the second point of a pair, as seen from the first: in few words, and
exactly."""


def _fifths(dimension: int) -> tuple[int, int, int]:
    return dimension // 25, dimension // 5 % 5, dimension % 5


def _name_pairs(dimension: int) -> list[str]:
    """How the surface goes from one point of a pair to the other; what is nothing special is not said."""
    alpha, phi, theta = _fifths(dimension)
    special = [words[fifth][0] for fifth, words in ((phi, HEIGHTS), (alpha, LEANS)) if fifth != MIDDLE]
    return [TURNS[theta][0], *special] if special or theta != MIDDLE else ["flat"]


def _look_for(dimension: int) -> str:
    """Words for patches that are mostly as a dimension counts."""
    alpha, phi, theta = _fifths(dimension)
    if alpha != MIDDLE:
        return "twisted leaning skewed"
    if theta != MIDDLE:
        return "round rounded convex edge bent" if theta > MIDDLE else "hollow concave groove bent"
    return "even smooth" if phi == MIDDLE else "step layers"


def _say(dimension: int, low: float | None, high: float | None) -> Said:
    *first, last = _name_pairs(dimension)
    pairs = f"{', '.join(first)} and {last}" if first else last
    return Said(
        f"patch {', '.join((*first, last))}: {span(low, high, '%')}",
        f"has {amount(low, high)} the patch around it {pairs}",
    )


def _word_cell(dimension: int) -> str:
    """The pairs that a dimension counts."""
    alpha, phi, theta = _fifths(dimension)
    return (
        f"the share of point pairs in a patch of which one lies {HEIGHTS[phi][1]} the other's tangent plane, while the "
        f"normal {TURNS[theta][1]} on the way and {LEANS[alpha][1]}"
    )


POINT_FEATURE_HISTOGRAM = Wording(
    aspect="fine bends",
    topics=tuple(
        f"share of a small patch that is {', '.join(_name_pairs(dimension))}" for dimension in range(COUNT)
    ),
    quantities=tuple(_word_cell(dimension) for dimension in range(COUNT)),
    unit="%",
    shown=as_percent,
    low="patches with few such pairs",
    high="patches with many such pairs",
    sought=tuple(("", _look_for(dimension)) for dimension in range(COUNT)),
    ease=1,
    say=_say,
)
