"""How much of the shape lies where, seen from the surface."""

from __future__ import annotations

from shapeviz_report.descriptors.shape_context import SHELLS
from shapeviz_report.wording.base import Said, Wording, amount, as_percent, span

COUNT = 24
DISTANCES = ("close", "some way", "far")
WAYS = (
    "away from the middle",
    "towards the middle lengthways only",
    "towards the middle crossways only",
    "towards the middle",
)


def _place(dimension: int) -> tuple[str, str, str]:
    """How far, on which side of the surface, and which way a dimension counts."""
    shell, octant = divmod(dimension, 8)
    return DISTANCES[shell], "in front" if octant & 4 else "behind", WAYS[octant & 3]


def _say(dimension: int, low: float | None, high: float | None) -> Said:
    distance, side, way = _place(dimension)
    front = "in front of it" if side == "in front" else "behind it"
    return Said(
        f"{distance} {side}, {way}: {span(low, high, '%')}",
        f"has {amount(low, high)} the shape {distance} {front}, {way}",
    )


def _word_part(dimension: int) -> str:
    """The part of the space around a point that a dimension counts."""
    shell, octant = divmod(dimension, 8)
    inner, outer = (f"{2 * share:g} times the shape's radius" for share in SHELLS)
    distance = (f"within {inner}", f"{2 * SHELLS[0]:g} to {outer} away", f"more than {outer} away")[shell]
    side = "outside" if octant & 4 else "inside"
    lengthways, crossways = ("towards" if octant & bit else "away from" for bit in (1, 2))
    tangents = (
        f"{lengthways} its middle both lengthways and crossways"
        if lengthways == crossways
        else f"{lengthways} its middle lengthways and {crossways} it crossways"
    )
    return f"the share of the shape that is {distance}, {side} the tangent plane, and {tangents}"


SHAPE_CONTEXT = Wording(
    aspect="surroundings",
    topics=tuple("share of the shape {} {}, {}".format(*_place(dimension)) for dimension in range(COUNT)),
    quantities=tuple(_word_part(dimension) for dimension in range(COUNT)),
    unit="%",
    shown=as_percent,
    low="points with little of the shape in that part of their surroundings",
    high="points with much of the shape in that part of their surroundings",
    sought=(("empty free open", "crowded enclosed"),) * COUNT,
    ease=1.5,
    say=_say,
)
