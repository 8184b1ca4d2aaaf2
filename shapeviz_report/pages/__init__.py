"""Pages: a report in, the frozen content of one page out.

A new page is one file here with a class that follows :class:`~shapeviz_report.pages.base.Page`, and one line in
``PAGES``; CONTRIBUTING.md names its template, script and style sheet.
"""

from shapeviz_report.pages.about import AboutPage
from shapeviz_report.pages.base import Page, PageContent
from shapeviz_report.pages.bins import BinsPage
from shapeviz_report.pages.compare import ComparePage
from shapeviz_report.pages.features import FeaturesPage
from shapeviz_report.pages.overview import OverviewPage
from shapeviz_report.pages.shape import ShapePage
from shapeviz_report.pages.shapes import ShapesPage
from shapeviz_report.pages.workbench import WorkbenchPage

#: In the order of the navigation.
PAGES: tuple[Page, ...] = (
    OverviewPage(),
    ShapesPage(),
    ShapePage(),
    ComparePage(),
    FeaturesPage(),
    WorkbenchPage(),
    BinsPage(),
    AboutPage(),
)

__all__ = ["PAGES", "Page", "PageContent"]
