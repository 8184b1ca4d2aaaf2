"""How the outside of a shape faces its axes."""

from __future__ import annotations

from shapeviz_report.global_descriptors.posed_shape import WAVES_AROUND
from shapeviz_report.wording.base import GlobalWording, list_waves, name_waves_around, place_waves_around

_WAVES = tuple(list_waves(WAVES_AROUND))


def _seek(number: int) -> str:
    _, around = _WAVES[number % len(_WAVES)]
    return "wall lid round" if around else "wall lid"


PANORAMA_SLANT = GlobalWording(
    aspect="slant of the outside",
    names=tuple(f"steepness {where}" for where in name_waves_around(WAVES_AROUND)),
    quantities=tuple(
        f"the root of the {waves}, in how squarely the outer surface faces away from it: 1 for a wall along the axis, "
        "0 for a lid across it"
        for waves in place_waves_around(WAVES_AROUND)
    ),
    seek=_seek,
)
