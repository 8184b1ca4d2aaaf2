"""Charts: data or a description of it in, an Altair chart out. The only package that imports altair."""

from shapeviz_report.charts.bars import class_bars
from shapeviz_report.charts.maps import class_map, hit_map, thumbnail_map
from shapeviz_report.charts.palette import (
    DARK,
    LIGHT,
    SYMBOLS,
    THEMES,
    Theme,
    ThemeName,
    class_color_indices,
    class_symbol_indices,
    feature_color_indices,
)
from shapeviz_report.charts.subsets import (
    class_boxes,
    effect_dots,
    feature_matrix,
    seed_dots,
    subset_bars,
)
from shapeviz_report.charts.theme import theme_config

__all__ = [
    "DARK",
    "LIGHT",
    "SYMBOLS",
    "THEMES",
    "Theme",
    "ThemeName",
    "class_bars",
    "class_boxes",
    "class_color_indices",
    "class_map",
    "class_symbol_indices",
    "effect_dots",
    "feature_color_indices",
    "feature_matrix",
    "hit_map",
    "seed_dots",
    "subset_bars",
    "theme_config",
    "thumbnail_map",
]
