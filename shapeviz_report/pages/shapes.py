"""The Shapes page: all shapes as pictures, to search, filter, group and sort."""

from __future__ import annotations

from shapeviz_report.pages.base import PageContent
from shapeviz_report.types import Report


class ShapesPage:
    """A gallery of the whole database."""

    name = "shapes"
    title = "Shapes"
    file = "shapes.html"
    within = None

    def content(self, report: Report) -> PageContent:
        return PageContent(context={})
