"""How far the surface reaches from all the rest."""

from __future__ import annotations

import numpy as np

from shapeviz_report.wording.base import Said, Wording, radii, say_more, span

FROM = "from all other points, walking on the surface"
MIDDLE, LIMBS = "lies near the middle", "lies far out"
HALF = 1.1


def _say(_: int, low: float | None, high: float | None) -> Said:
    name = f"remoteness {span(low, high)}"
    if low is None:
        return Said(
            name,
            f"is on average less than {radii(high or 0)} {FROM}",
            *say_more(MIDDLE, LIMBS, high or 0, HALF),
        )
    if high is None:
        return Said(
            name,
            f"is on average more than {radii(low)} {FROM}",
            *say_more(LIMBS, MIDDLE, 2 * HALF - low, HALF),
        )
    return Said(name, f"is on average {span(low, high)} radii {FROM}")


GEODESIC_DISTANCE = Wording(
    aspect="reach",
    topics=("mean distance from all other points, walking on the surface",),
    quantities=("the mean distance to all other points, walking on the surface,",),
    unit="times the shape's radius",
    shown=np.asarray,
    low="the middle of the shape",
    high="the ends of its limbs",
    sought=(("centre center core near compact", "far remote limb leg arm finger tail tip long tall"),),
    ease=2,
    say=_say,
)
