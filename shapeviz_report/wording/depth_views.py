"""What one sees of a shape along its axes."""

from __future__ import annotations

from shapeviz_report.global_descriptors.posed_shape import WAVES_ACROSS
from shapeviz_report.wording.base import AXES, ENDS, GlobalWording, name_waves_across, place_waves_across

_VALUES = WAVES_ACROSS[0] * WAVES_ACROSS[1]

_PARTS = (
    ("relief seen from the {}", "the depths seen from both sides"),
    ("difference of the two {}s", "the depths seen from one side but not the other"),
)

DEPTH_VIEWS = GlobalWording(
    aspect="relief",
    names=tuple(
        f"{part.format(end)}{waves or ' on average'}"
        for end in ENDS
        for part, _ in _PARTS
        for waves in name_waves_across(WAVES_ACROSS)
    ),
    quantities=tuple(
        f"the root of the {waves}, in {part} along the {axis} axis"
        for number, axis in enumerate(AXES)
        for _, part in _PARTS
        for waves in place_waves_across(number, WAVES_ACROSS)
    ),
    seek=lambda number: "symmetric symmetrical front back" if number // _VALUES % 2 else "depth",
)
