"""The Compare page: what sets two groups apart, what they share, outliers, and classes that are alike."""

from __future__ import annotations

from shapeviz_report.pages.base import PageContent
from shapeviz_report.types import Report


class ComparePage:
    """Two groups of shapes beside each other."""

    name = "compare"
    title = "Compare"
    file = "compare.html"
    within = None

    def content(self, report: Report) -> PageContent:
        return PageContent(context={})
