"""Pictures of shapes, drawn offline: the only package that uses pyrender."""

from shapeviz_report.render.painting import MARKED, mark_colors, render_painted, value_colors
from shapeviz_report.render.ramp import ramp_codes
from shapeviz_report.render.rasteriser import RENDERERS, Renderer, check_renderer
from shapeviz_report.render.shading import CLAY
from shapeviz_report.render.thumbnail import render_thumbnail
from shapeviz_report.render.viewpoint import choose_view

__all__ = [
    "CLAY",
    "MARKED",
    "RENDERERS",
    "Renderer",
    "check_renderer",
    "choose_view",
    "mark_colors",
    "ramp_codes",
    "render_painted",
    "render_thumbnail",
    "value_colors",
]
