"""Charts: data or a description of it in, an Altair chart out. The only package that imports altair, and what does so,
:mod:`shapeviz_report.charts.specs`, is imported where charts are made: it takes long, and most commands make none."""

from __future__ import annotations

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
from shapeviz_report.charts.theme import theme_config

__all__ = [
    "DARK",
    "LIGHT",
    "SYMBOLS",
    "THEMES",
    "Theme",
    "ThemeName",
    "class_color_indices",
    "class_symbol_indices",
    "feature_color_indices",
    "theme_config",
]
