"""How two places of a shape lie to each other."""

from __future__ import annotations

import numpy as np

from shapeviz_report.global_descriptors.surflets import ANGLES, DISTANCES, FARTHEST
from shapeviz_report.wording.base import GlobalWording, span

_LIMITS = np.degrees(np.arccos(np.linspace(0, 1, ANGLES + 1)))
"""Between flat on and edge on: falling."""

_RANGES = tuple(f"{_LIMITS[place + 1]:.0f}–{_LIMITS[place]:.0f}°" for place in range(ANGLES))

_ENDS = np.linspace(0, FARTHEST, DISTANCES + 1)

_APART = tuple(
    span(float(_ENDS[place]), None if place == DISTANCES - 1 else float(_ENDS[place + 1]))
    for place in range(DISTANCES)
)

_KINDS = tuple(
    (apart, turned, _RANGES[large], _RANGES[small])
    for apart in _APART
    for turned in _RANGES
    for large in range(ANGLES)
    for small in range(large + 1)
)

SURFLETS = GlobalWording(
    aspect="lie of the parts",
    names=tuple(
        f"share of pairs {apart} apart, turned {turned}, at {one} and {other}"
        for apart, turned, one, other in _KINDS
    ),
    quantities=tuple(
        f"the square root of the share of pairs of places that lie {apart} apart, in units of the typical distance "
        f"from the middle, whose surfaces are turned by {turned} against each other, and face the line between the "
        f"two at {one} and {other}"
        for apart, turned, one, other in _KINDS
    ),
)
