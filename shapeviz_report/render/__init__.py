"""Pictures of shapes, drawn offline: the only package that uses pyrender."""

from shapeviz_report.render.rasteriser import check_renderer
from shapeviz_report.render.thumbnail import render_thumbnail

__all__ = ["check_renderer", "render_thumbnail"]
