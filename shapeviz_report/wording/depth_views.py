"""What one sees of a shape along its axes."""

from __future__ import annotations

from shapeviz_report.global_descriptors.posed_shape import WAVES_ACROSS
from shapeviz_report.wording.base import AXES, GlobalWording, name_waves_across, place_waves_across

_PARTS = (
    ("relief", "the depths seen from both sides"),
    ("front against back", "the depths seen from one side but not the other"),
)

DEPTH_VIEWS = GlobalWording(
    aspect="relief",
    names=tuple(
        f"{part} along the {axis} axis, {waves}" if waves else f"mean {part} along the {axis} axis"
        for number, axis in enumerate(AXES)
        for part, _ in _PARTS
        for waves in name_waves_across(WAVES_ACROSS)
    ),
    quantities=tuple(
        f"the root of the {waves}, in {part} along the {axis} axis"
        for number, axis in enumerate(AXES)
        for _, part in _PARTS
        for waves in place_waves_across(number, WAVES_ACROSS)
    ),
)
