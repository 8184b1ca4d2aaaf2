"""How far a shape reaches from its axes."""

from __future__ import annotations

from shapeviz_report.global_descriptors.posed_shape import WAVES_AROUND
from shapeviz_report.wording.base import GlobalWording, list_waves, name_waves_around, place_waves_around

_WAVES = tuple(list_waves(WAVES_AROUND))


def _seek(number: int) -> str:
    along, around = _WAVES[number % len(_WAVES)]
    if around == 0:
        return "width" if along else "wide width slim bulky"
    # What is as wide on all sides is round.
    sides = (
        "lopsided symmetric symmetrical" if around == 1 else "flat winged" if around == 2 else "winged star"
    )
    return f"{sides} round"


PANORAMA = GlobalWording(
    aspect="girth",
    names=tuple(f"reach {where}" for where in name_waves_around(WAVES_AROUND)),
    quantities=tuple(
        f"the root of the {waves}, in how far the surface reaches from it"
        for waves in place_waves_around(WAVES_AROUND)
    ),
    seek=_seek,
)
