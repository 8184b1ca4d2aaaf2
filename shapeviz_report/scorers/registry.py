"""All scorers: ours, and those of plug-ins."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from shapeviz_report.plugins import Plugin, guarded, require, take_numbers, with_plugins
from shapeviz_report.scorers import SCORERS, Scorer
from shapeviz_report.types import BoolArray, FloatArray


def _prepare(plugin: Plugin, scorer: Scorer) -> Scorer:
    require(plugin, scorer.name.isidentifier(), "its name is part of addresses: letters and digits only")
    require(
        plugin, scorer.explanation.endswith("."), "its explanation is a sentence, which ends with a full stop"
    )

    def take(scores: Any, values: FloatArray, positive: BoolArray, seed: int) -> FloatArray:
        return take_numbers(scores, (values.shape[1],), "its scores", lowest=0)

    return replace(scorer, measure=guarded(plugin, scorer.measure, take))


ALL_SCORERS = with_plugins("shapeviz_report.scorers", SCORERS, Scorer, _prepare)
"""Ours first, in the order in which readers meet them."""
