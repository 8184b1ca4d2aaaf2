"""Whether the surface lies around the waist or towards the ends."""

from __future__ import annotations

from shapeviz_report.wording.base import Said, Wording, as_slope, measure, say_more, span

SEEN = "from the waist, seen from the middle"
WAIST, ENDS = "lies around the waist", "lies towards the two ends"
HALF = 46.0


def _say(_: int, low: float | None, high: float | None) -> Said:
    name = f"{span(low, high, '°')} from the waist"
    if low is None:
        return Said(
            name,
            f"lies within {measure(high or 0, '°')} of the waist, seen from the middle",
            *say_more(WAIST, ENDS, high or 0, HALF),
        )
    if high is None:
        return Said(
            name, f"lies more than {measure(low, '°')} {SEEN}", *say_more(ENDS, WAIST, 90 - low, HALF)
        )
    return Said(name, f"lies {span(low, high, '°')} {SEEN}")


POINT_ANGLE = Wording(
    aspect="spread lengthways",
    topics=("angle from the waist, seen from the middle",),
    quantities=("the angle, seen from the shape's middle, from the plane across its longest direction",),
    unit="°",
    shown=as_slope,
    low="the waist",
    high="the ends of the longest direction",
    sought=(("middle belt centre center", "tip head tail front back"),),
    ease=2,
    say=_say,
)
