"""Pictures of shapes, drawn offline: the only package that uses pyrender."""

from shapeviz_report.render.painting import MARKED
from shapeviz_report.render.ramp import ramp_codes
from shapeviz_report.render.rasteriser import check_renderer
from shapeviz_report.render.shading import CLAY
from shapeviz_report.render.thumbnail import render_thumbnail
from shapeviz_report.render.viewpoint import UpAxis

__all__ = ["CLAY", "MARKED", "UpAxis", "check_renderer", "ramp_codes", "render_thumbnail"]
