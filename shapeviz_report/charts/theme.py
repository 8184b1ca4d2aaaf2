"""What the charts look like under a theme: a Vega-Lite ``config``, kept apart from the charts themselves."""

from __future__ import annotations

from shapeviz_report.charts.palette import Theme, class_color_indices

FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Noto Sans', sans-serif"


def theme_config(theme: Theme, class_count: int) -> dict[str, object]:
    """A Vega-Lite configuration with the colours of ``theme`` for ``class_count`` classes, and of the features."""
    return {
        "background": None,
        "font": FONT,
        "range": {
            # Vega needs at least one colour even where there is no class.
            "category": [theme.classes[index] for index in class_color_indices(max(class_count, 1))],
            "ramp": list(theme.hit),
            "ordinal": list(theme.features),
        },
        "axis": {
            "gridColor": theme.grid,
            "labelColor": theme.ink,
            "labelFontSize": 12,
            "titleColor": theme.ink,
            "titleFontSize": 12,
            "titleFontWeight": "normal",
        },
    }
