"""All projections: ours, and those of plug-ins."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from shapeviz_report.plugins import Plugin, guarded, require, with_plugins
from shapeviz_report.projections import PROJECTIONS, Method
from shapeviz_report.types import FloatArray


def _prepare(plugin: Plugin, method: Method) -> Method:
    require(
        plugin, method.name.isidentifier(), "its name is part of the names of files: letters and digits only"
    )
    require(
        plugin, method.explanation.endswith("."), "its explanation is a sentence, which ends with a full stop"
    )
    require(
        plugin, method.rounds == 0, "its rounds are not 0: features are searched by our own methods alone"
    )

    def check(xy: Any, rows: FloatArray, seed: int) -> str:
        if np.shape(xy) != (len(rows), 2):
            return f"its map is an array {np.shape(xy)}, and not {(len(rows), 2)}"
        return "" if np.isfinite(xy).all() else "a place on its map is not finite"

    return replace(
        method,
        arrange=guarded(plugin, method.arrange, check),
        embed=None if method.embed is None else guarded(plugin, method.embed, check),
    )


ALL_PROJECTIONS = with_plugins("shapeviz_report.projections", PROJECTIONS, Method, _prepare)
"""Ours first, in the order in which readers meet them."""
