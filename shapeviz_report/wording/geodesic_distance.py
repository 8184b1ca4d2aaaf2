"""How far the surface reaches from all the rest."""

from __future__ import annotations

import numpy as np

from shapeviz_report.wording.base import Said, Wording, radii, span

FROM = "from the other points, walking on the surface"


def _say(_: int, low: float | None, high: float | None) -> Said:
    name = f"remoteness {span(low, high)}"
    if low is None:
        return Said(
            name,
            f"is on average less than {radii(high or 0)} {FROM}",
            "there is more near the middle of the shape",
        )
    if high is None:
        return Said(
            name, f"is on average more than {radii(low)} {FROM}", "there is more far out, as on long limbs"
        )
    return Said(name, f"is on average {span(low, high)} radii {FROM}")


GEODESIC_DISTANCE = Wording(
    aspect="reach",
    topics=("mean distance from the other points, walking on the surface",),
    quantities=("the mean distance to all other points, walking on the surface,",),
    unit="times the shape's radius",
    shown=np.asarray,
    low="the middle of the shape",
    high="the ends of its limbs",
    ease=2,
    say=_say,
)
