"""All projections: ours, and those of plug-ins."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from shapeviz_report.plugins import Plugin, guarded, require, same_name, take_numbers, with_plugins
from shapeviz_report.projections import PROJECTIONS, Method
from shapeviz_report.types import FloatArray

TAKEN_NAMES = ("features", "best")
"""What pages call something else that stands beside maps."""


def _prepare(plugin: Plugin, method: Method) -> Method:
    require(
        plugin, method.name.isidentifier(), "its name is part of the names of files: letters and digits only"
    )
    require(plugin, same_name(method.name) not in TAKEN_NAMES, f"pages call something else {method.name!r}")
    require(
        plugin, method.explanation.endswith("."), "its explanation is a sentence, which ends with a full stop"
    )
    require(
        plugin, method.rounds == 0, "its rounds are not 0: features are searched by our own methods alone"
    )

    def take(xy: Any, rows: FloatArray, seed: int) -> FloatArray:
        return take_numbers(xy, (len(rows), 2), "the places on its map")

    return replace(
        method,
        arrange=guarded(plugin, method.arrange, take),
        embed=None if method.embed is None else guarded(plugin, method.embed, take),
    )


ALL_PROJECTIONS = with_plugins("shapeviz_report.projections", PROJECTIONS, Method, _prepare)
"""Ours first, in the order in which readers meet them."""
