"""How thick the shape is."""

from __future__ import annotations

import numpy as np

from shapeviz_report.wording.base import Said, Wording, radii, span


def _say(_: int, low: float | None, high: float | None) -> Said:
    name = f"thickness {span(low, high)}"
    if low is None:
        return Said(name, f"is thinner than {radii(high or 0)}", "bodies are thinner")
    if high is None:
        return Said(name, f"is thicker than {radii(low)}", "bodies are thicker")
    return Said(name, f"is {span(low, high)} radii thick")


NORMAL_DIAMETER = Wording(
    aspect="thickness",
    topics=("thickness",),
    quantities=("the thickness of the shape, straight through,",),
    unit="times the shape's radius",
    shown=np.asarray,
    low="thin sheets and limbs",
    high="full bodies",
    sought=(("thin slim slender plate narrow", "thick fat stout massive bulky"),),
    ease=2,
    say=_say,
)
