"""The shadows of a shape."""

from __future__ import annotations

from shapeviz_report.global_descriptors.posed_shape import WAVES_ACROSS
from shapeviz_report.wording.base import AXES, GlobalWording, name_waves_across, place_waves_across

SILHOUETTES = GlobalWording(
    aspect="silhouette",
    names=tuple(
        f"shadow along the {axis} axis, {waves}" if waves else f"mean shadow along the {axis} axis"
        for number, axis in enumerate(AXES)
        for waves in name_waves_across(WAVES_ACROSS)
    ),
    quantities=tuple(
        f"the root of the {waves}, in the silhouette seen along the {axis} axis"
        for number, axis in enumerate(AXES)
        for waves in place_waves_across(number, WAVES_ACROSS)
    ),
)
