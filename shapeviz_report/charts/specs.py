"""All charts, and what a page takes of one."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

from shapeviz_report.charts.bars import class_bars
from shapeviz_report.charts.maps import class_map, hit_map, thumbnail_map
from shapeviz_report.charts.subsets import (
    class_boxes,
    effect_dots,
    feature_matrix,
    seed_dots,
    subset_bars,
)

if TYPE_CHECKING:
    import altair as alt

__all__ = [
    "class_bars",
    "class_boxes",
    "class_map",
    "effect_dots",
    "feature_matrix",
    "hit_map",
    "seed_dots",
    "spec_of",
    "subset_bars",
    "thumbnail_map",
]


def spec_of(make: Callable[..., alt.TopLevelMixin], *arguments: int) -> dict[str, Any]:
    """The Vega-Lite specification of a chart by the function that makes it: made and checked once in a process."""
    return json.loads(_text_of(make, *arguments))


@cache
def _text_of(make: Callable[..., alt.TopLevelMixin], *arguments: int) -> str:
    return make(*arguments).to_json(indent=None, sort_keys=False)
