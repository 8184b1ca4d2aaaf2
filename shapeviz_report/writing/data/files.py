"""The site's ``data/`` folder: what a build found, for machines. ``docs/using/site-data.md`` describes it.

Everything here but the times in ``summary.json`` depends on the input alone, so two builds of the same database
write the same bytes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.arrow import parquet_bytes
from shapeviz_report.pages.base import feature_files, is_in_full
from shapeviz_report.projections import MAIN_PROJECTION
from shapeviz_report.quality import hit_range
from shapeviz_report.types import BinSelection, Report
from shapeviz_report.writing.data.encoding import archive, csv_text, json_text, number
from shapeviz_report.writing.data.retrieval import retrieval_class_rows, retrieval_rows
from shapeviz_report.writing.data.separation import separation_rows
from shapeviz_report.writing.data.summary import summary
from shapeviz_report.writing.data.tables import (
    copy_rows,
    greedy_rows,
    shape_columns,
    shape_rows,
    subset_rows,
    table_rows,
)

DATA_NAMES = (
    r"summary\.json|(features(-\d+)?|scores)\.npz|(features|shapes)\.parquet|selected-bins\.txt"
    r"|(shapes|copies|subsets|greedy|table2|retrieval|retrieval-classes|separation|projection-\w+)\.csv"
)
"""The names that :func:`data_files` gives, as a regular expression."""


def data_files(report: Report, version: str) -> Iterator[tuple[str, bytes]]:
    """``summary.json``, ``shapes.csv``, ``features.npz`` or its parts, both as Parquet where the build was told so, one
    ``projection-METHOD.csv`` a projection, and what a search found in ``subsets.csv``, ``greedy.csv`` and
    ``table2.csv``, the scores of bins in ``scores.npz``, the bins that separate all classes in ``selected-bins.txt``,
    and how well shapes are found in ``retrieval.csv`` and ``retrieval-classes.csv``, and how far classes are told apart
    in ``separation.csv``: names and contents, each made when it is asked for.

    Parameters
    ----------
    report : Report
    version : str
        Of this package.
    """
    yield "summary.json", (json_text(summary(report, version), indent=1) + "\n").encode()
    yield "shapes.csv", csv_text(shape_rows(report))
    for name, part in feature_files(len(report.shapes)).items():
        yield (
            name,
            archive(
                values=np.ascontiguousarray(report.features.values[part], dtype=np.float64),
                columns=np.array(report.features.columns, dtype=np.str_),
                shape_ids=np.array(report.features.shape_ids[part], dtype=np.str_),
                edges=report.edges,
            ),
        )
    if report.parameters.get("parquet"):
        yield "shapes.parquet", parquet_bytes(shape_columns(report))
        yield "features.parquet", parquet_bytes(_feature_columns(report))
    for method, (projection, _) in report.projections.items():
        points = zip(report.shapes, projection.xy, strict=True)
        rows = ([shape.id, number(x), number(y)] for shape, (x, y) in points)
        yield f"projection-{method}.csv", csv_text(chain([["id", "x", "y"]], rows))
    if report.search is not None:
        limits = hit_range([report.labels[row] for row in report.search.rows], report.search.k)
        yield "subsets.csv", csv_text(subset_rows(report.search, limits))
        if report.search.table:
            yield "greedy.csv", csv_text(greedy_rows(report.search, limits))
            yield "table2.csv", csv_text(table_rows(report.search, limits))
    if report.scores is not None:
        yield (
            "scores.npz",
            archive(
                scores=report.scores.values,
                methods=np.array(report.scores.methods, dtype=np.str_),
                classes=np.array(report.scores.classes, dtype=np.str_),
                columns=np.array(report.features.columns, dtype=np.str_),
            ),
        )
    if report.retrieval is not None:
        yield "retrieval.csv", csv_text(retrieval_rows(report.retrieval))
        yield "retrieval-classes.csv", csv_text(retrieval_class_rows(report.retrieval))
    if report.separation is not None:
        yield "separation.csv", csv_text(separation_rows(report.separation))
    if report.copies:
        yield "copies.csv", csv_text(copy_rows(report))
    if report.bins is not None:
        yield "selected-bins.txt", _bin_list(report.bins.automatic).encode()


def _feature_columns(report: Report) -> dict[str, npt.NDArray[Any] | Sequence[str | None]]:
    """The values of ``features.npz``, below their names; of very many shapes with seven digits."""
    kind = np.float64 if is_in_full(report) else np.float32
    columns = np.ascontiguousarray(report.features.values.T, dtype=kind)
    return {"id": report.features.shape_ids, **dict(zip(report.features.columns, columns, strict=True))}


def _bin_list(selection: BinSelection) -> str:
    """What ``build --bins`` reads."""
    head = f"# {len(selection.bins)} bins that separate all classes: NH_s {selection.nh_s:.3f} on their "
    head += f"{MAIN_PROJECTION.title} map\n"
    return head + "".join(f"{name}\n" for name in selection.bins)
