"""How far a shape reaches from its axes."""

from __future__ import annotations

from shapeviz_report.global_descriptors.posed_shape import WAVES_AROUND
from shapeviz_report.wording.base import GlobalWording, name_waves_around, place_waves_around

PANORAMA = GlobalWording(
    aspect="girth",
    names=tuple(
        f"{'' if ':' in waves else 'mean '}reach from the {waves}"
        for waves in name_waves_around(WAVES_AROUND)
    ),
    quantities=tuple(
        f"the root of the {waves}, in how far the surface reaches from it"
        for waves in place_waves_around(WAVES_AROUND)
    ),
)
