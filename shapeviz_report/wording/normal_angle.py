"""Whether the surface runs along the shape or faces its ends."""

from __future__ import annotations

from shapeviz_report.wording.base import Said, Wording, as_slope, measure, say_more, span

FROM = "from the longest direction"
RUNS, FACES = "runs lengthways", "faces the two ends"
HALF = 46.0


def _say(_: int, low: float | None, high: float | None) -> Said:
    name = f"{span(low, high, '°')} off lengthways"
    if low is None:
        return Said(
            name,
            f"keeps within {measure(high or 0, '°')} of the longest direction",
            *say_more(RUNS, FACES, high or 0, HALF),
        )
    if high is None:
        return Said(
            name, f"turns more than {measure(low, '°')} {FROM}", *say_more(FACES, RUNS, 90 - low, HALF)
        )
    return Said(name, f"turns {span(low, high, '°')} {FROM}")


NORMAL_ANGLE = Wording(
    aspect="direction of the surface",
    topics=("angle between the surface and the longest direction",),
    quantities=("the angle between the surface and the shape's longest direction",),
    unit="°",
    shown=as_slope,
    low="surface that runs along the longest direction",
    high="surface that faces the ends",
    sought=(("side along lengthways long tall elongated slender", "across end front back cap"),),
    ease=2,
    say=_say,
)
