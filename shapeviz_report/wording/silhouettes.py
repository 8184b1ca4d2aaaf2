"""The shadows of a shape."""

from __future__ import annotations

from shapeviz_report.global_descriptors.posed_shape import WAVES_ACROSS
from shapeviz_report.wording.base import AXES, ENDS, GlobalWording, name_waves_across, place_waves_across

_VALUES = WAVES_ACROSS[0] * WAVES_ACROSS[1]

SILHOUETTES = GlobalWording(
    aspect="silhouette",
    names=tuple(
        f"shadow of the {end}{waves}" if waves else f"size of the shadow of the {end}"
        for end in ENDS
        for waves in name_waves_across(WAVES_ACROSS)
    ),
    quantities=tuple(
        f"the root of the {waves}, in the silhouette seen along the {axis} axis"
        for number, axis in enumerate(AXES)
        for waves in place_waves_across(number, WAVES_ACROSS)
    ),
    seek=lambda number: "outline" if number % _VALUES else "outline large wide broad",
)
