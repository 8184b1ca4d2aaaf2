"""The page of one shape: what it is, where it lies, and which shapes are most like it."""

from __future__ import annotations

from shapeviz_report.pages.base import PageContent
from shapeviz_report.types import Report


class ShapePage:
    """One shape, named in the address."""

    name = "shape"
    title = "Shape"
    file = "shape.html"
    within = "shapes"

    def content(self, report: Report) -> PageContent:
        return PageContent(context={"models": report.models is not None})
