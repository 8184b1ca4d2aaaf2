"""How the outside of a shape faces its axes."""

from __future__ import annotations

from shapeviz_report.global_descriptors.posed_shape import WAVES_AROUND
from shapeviz_report.wording.base import GlobalWording, name_waves_around, place_waves_around

PANORAMA_SLANT = GlobalWording(
    aspect="slant of the outside",
    names=tuple(
        f"{'' if ':' in waves else 'mean '}slant to the {waves}" for waves in name_waves_around(WAVES_AROUND)
    ),
    quantities=tuple(
        f"the root of the {waves}, in how squarely the outer surface faces away from it"
        for waves in place_waves_around(WAVES_AROUND)
    ),
)
