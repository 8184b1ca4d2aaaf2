"""All scorers: ours, and those of plug-ins."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from shapeviz_report.plugins import Plugin, guarded, require, with_plugins
from shapeviz_report.scorers import SCORERS, Scorer
from shapeviz_report.types import BoolArray, FloatArray


def _prepare(plugin: Plugin, scorer: Scorer) -> Scorer:
    require(plugin, scorer.name.isidentifier(), "its name is part of addresses: letters and digits only")
    require(
        plugin, scorer.explanation.endswith("."), "its explanation is a sentence, which ends with a full stop"
    )

    def check(scores: Any, values: FloatArray, positive: BoolArray, seed: int) -> str:
        size = (values.shape[1],)
        if np.shape(scores) != size:
            return f"its scores are an array {np.shape(scores)}, and not {size}"
        held = np.isfinite(scores).all() and np.min(scores) >= 0
        return "" if held else "a score is not finite, or below 0"

    return replace(scorer, measure=guarded(plugin, scorer.measure, check))


ALL_SCORERS = with_plugins("shapeviz_report.scorers", SCORERS, Scorer, _prepare)
"""Ours first, in the order in which readers meet them."""
