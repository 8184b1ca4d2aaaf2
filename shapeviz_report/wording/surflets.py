"""How two places of a shape lie to each other."""

from __future__ import annotations

import numpy as np

from shapeviz_report.global_descriptors.surflets import ANGLES, DISTANCES, FARTHEST
from shapeviz_report.wording.base import GlobalWording, span

_LIMITS = np.degrees(np.arccos(np.linspace(0, 1, ANGLES + 1)))
"""Between flat on and edge on: falling."""

_RANGES = tuple(f"{_LIMITS[place + 1]:.0f}–{_LIMITS[place]:.0f}°" for place in range(ANGLES))

TURNED = ("square", "nearly square", "nearly parallel", "parallel")
FACING = ("edge-on", "slanting", "steep", "face-on")
"""How surfaces at two places are turned against each other, and how each meets the line between the two."""

_ENDS = np.linspace(0, FARTHEST, DISTANCES + 1)

_APART = tuple(
    span(float(_ENDS[place]), None if place == DISTANCES - 1 else float(_ENDS[place + 1]))
    for place in range(DISTANCES)
)

_KINDS = tuple(
    (apart, turned, large, small)
    for apart in _APART
    for turned in range(ANGLES)
    for large in range(ANGLES)
    for small in range(large + 1)
)


def _name(apart: str, turned: int, large: int, small: int) -> str:
    facing = f"both {FACING[large]}" if large == small else f"{FACING[large]} and {FACING[small]}"
    return f"share of pairs {apart} apart ({TURNED[turned]}, {facing})"


def _seek(number: int) -> str:
    _, turned, large, small = _KINDS[number]
    if turned == ANGLES - 1 and large == 0:
        return "flat plane plate distance"
    if turned == ANGLES - 1 and small == ANGLES - 1:
        return "opposite walls distance"
    return "corner angle distance" if turned == 0 else "distance"


SURFLETS = GlobalWording(
    aspect="lie of the parts",
    names=tuple(_name(*kind) for kind in _KINDS),
    quantities=tuple(
        f"the share of pairs of places that lie {apart} apart, in units of the typical distance from the middle, whose "
        f"surfaces are turned by {_RANGES[turned]} against each other, and face the line between the two at "
        f"{_RANGES[large]} and {_RANGES[small]}; shapes are compared by its square root"
        for apart, turned, large, small in _KINDS
    ),
    seek=_seek,
    rooted=True,
)
