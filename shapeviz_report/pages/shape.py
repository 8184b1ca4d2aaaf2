"""The page of one shape: what it is, where it lies, and which shapes are most like it."""

from __future__ import annotations

from shapeviz_report.pages.base import PageContent, is_in_full
from shapeviz_report.pages.levels import level_parts, level_table, levels_chunk
from shapeviz_report.presets import PRESETS
from shapeviz_report.types import Report
from shapeviz_report.wording import word_whole


class ShapePage:
    """One shape, named in the address."""

    name = "shape"
    title = "Shape"
    file = "shape.html"
    within = "shapes"

    def content(self, report: Report) -> PageContent:
        preset = PRESETS[str(report.parameters["preset"])]
        context = {"models": report.models is not None, "whole": word_whole(preset.by_area)}
        if is_in_full(report):
            return PageContent(context)
        levels = level_table(report, preset)
        return PageContent(context, {"levels": levels_chunk(levels)}, level_parts(levels))
