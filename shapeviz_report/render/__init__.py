"""Pictures of shapes, drawn offline: the only package that uses pyrender."""

from shapeviz_report.render.rasteriser import check_renderer
from shapeviz_report.render.thumbnail import render_thumbnail
from shapeviz_report.render.viewpoint import UpAxis

__all__ = ["UpAxis", "check_renderer", "render_thumbnail"]
