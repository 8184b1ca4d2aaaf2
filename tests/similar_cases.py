"""What is similar to some shapes of a report, as Python finds it: for tests that hold the browser to the same."""

from __future__ import annotations

from shapeviz_report.presets import PRESETS
from shapeviz_report.similarity import rank_similar
from shapeviz_report.types import Report


def similar_cases(report: Report) -> list[dict[str, object]]:
    """Questions about a report and their answers, as JSON values.

    Each is ``{"row", "features", "bins", "found"}``: a shape; what to compare, names of features or of bins, the other
    one null, both null for all features; and all other shapes from the most similar on, each
    ``{"row", "distance", "closer"}`` with a share for every feature of the table, as
    :class:`~shapeviz_report.similarity.SimilarShape` has it.
    """
    table = report.features
    names = [block.name for block in table.blocks]
    last = len(table.values) - 1
    columns = table.columns
    choices = [
        (None, None),
        ([names[0]], None),
        ([names[-1]], None),
        (names[::2], None),
        (None, [columns[2]]),
        (None, [columns[0], columns[5], columns[-1]]),
    ]
    return [
        {"row": row, "features": features, "bins": bins, "found": _answer(report, row, features, bins)}
        for row in sorted({0, last // 2, last})
        for features, bins in choices
    ]


def _answer(
    report: Report, row: int, features: list[str] | None, bins: list[str] | None
) -> list[dict[str, object]]:
    table = report.features
    found = rank_similar(
        table,
        PRESETS[str(report.parameters["preset"])],
        table.values[row],
        features=features,
        bins=bins,
        member=row,
        count=len(table.values),
    )
    return [
        {"row": shape.row, "distance": shape.distance, "closer": shape.closer.tolist()} for shape in found
    ]
