"""The Shapes page: all shapes as pictures, to search, filter, group and sort."""

from __future__ import annotations

import numpy as np

from shapeviz_report.order import natural
from shapeviz_report.pages.base import PageContent
from shapeviz_report.pages.fields import describe_fields
from shapeviz_report.pages.hierarchy import describe_hierarchy
from shapeviz_report.types import Report


class ShapesPage:
    """A gallery of the whole database."""

    name = "shapes"
    title = "Shapes"
    file = "shapes.html"
    within = None

    def content(self, report: Report) -> PageContent:
        fields = describe_fields(report)
        names = [shape.name for shape in report.shapes]
        return PageContent(
            context={},
            chunks={
                "fields": {
                    # The rows in the order of their names; those of one name by id, as the shapes stand.
                    "byName": np.array(
                        sorted(range(len(names)), key=lambda row: natural(names[row])), np.int32
                    ),
                    "fields": fields,
                },
                "hierarchy": describe_hierarchy(report, fields),
            },
        )
