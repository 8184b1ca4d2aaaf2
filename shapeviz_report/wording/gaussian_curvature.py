"""Bumps, flats and saddles."""

from __future__ import annotations

from shapeviz_report.wording.base import Said, Wording, as_degrees, measure, span

NOTICED, MARKED = 1.0, 2.5
"""Degrees at a point from which a bend is clear, and strong."""


def _say(_: int, low: float | None, high: float | None) -> Said:
    if low is None:
        return _say_up_to(high or 0.0)
    if high is None:
        return _say_from(low)
    if low < 0 < high:
        return Said(
            f"flat, {span(low, high, '°')}",
            f"is nearly flat, by {measure(max(-low, high), '°')} at a point or less",
        )
    if low >= 0:
        return Said(
            f"bump {span(low, high, '°')}", f"bulges {_how(low)}, by {span(low, high, '°')} at a point"
        )
    return Said(
        f"saddle {span(-high, -low, '°')}",
        f"bends {_how(-high)} like a saddle, by {span(-high, -low, '°')} at a point",
    )


def _say_up_to(high: float) -> Said:
    if high > 0:
        return Said(
            f"bump under {measure(high, '°')}",
            f"bulges by less than {measure(high, '°')} at a point, if at all",
            "there are fewer bumps and tips",
            True,
        )
    return Said(
        f"saddle over {measure(-high, '°')}",
        f"bends like a saddle by more than {measure(-high, '°')} at a point",
        "there are more saddle-like bends",
    )


def _say_from(low: float) -> Said:
    if low < 0:
        return Said(
            f"saddle under {measure(-low, '°')}",
            f"bends like a saddle by less than {measure(-low, '°')} at a point, if at all",
            "there are fewer saddle-like bends",
            True,
        )
    return Said(
        f"bump over {measure(low, '°')}",
        f"bulges by more than {measure(low, '°')} at a point",
        "there are more bumps and tips",
    )


def _how(degrees: float) -> str:
    return "strongly" if degrees >= MARKED else "clearly" if degrees >= NOTICED else "slightly"


GAUSSIAN_CURVATURE = Wording(
    aspect="curvature",
    topics=("how much the surface bulges; below 0, how much it bends like a saddle",),
    quantities=("the angle by which the triangles around a point fall short of a full turn",),
    unit="°",
    shown=as_degrees,
    low="saddles, as where a limb leaves the body or inside a handle",
    high="bumps and tips",
    sought=(
        (
            "saddle neck fork branch handle hole ring loop",
            "bump round rounded bulge ball corner pointed sharp spiky spike",
        ),
    ),
    ease=2,
    say=_say,
)
