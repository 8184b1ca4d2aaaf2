"""The tables of ``data/``: shapes, copies, and what a search of features found."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.types import FeatureSearch, HitRange, Report, list_groups
from shapeviz_report.writing.data.encoding import json_text, number

_INTEGERS = ("faces_read", "vertices_read", "faces", "vertices", "components")
_FLOATS = ("nh_max", "deviation", "area", "volume", "extent_x", "extent_y", "extent_z")
_MEASURES = ("nh:", "kept:", "false:", "missing:")
"""How the names of columns of a map begin, all numbers."""


def column_type(column: str) -> type[int | float | bool | str]:
    """What the cells of a column of :func:`shape_rows` are."""
    if column in _FLOATS or column.startswith(_MEASURES):
        return float
    return int if column in _INTEGERS else bool if column == "watertight" else str


def shape_rows(report: Report) -> Iterator[list[str]]:
    """A shape a row, below the names of the columns."""
    root = report.database.root.resolve()
    labelings = report.database.labelings
    columns = list(dict.fromkeys(column for shape in report.shapes for column in shape.metadata))
    methods = list(report.projections)
    highest = next(quality.range for _, quality in report.projections.values()).highest_of_class
    yield [
        "id",
        "name",
        "file",
        "class",
        *(("cluster",) if report.clusters is not None else ()),
        *(f"label:{labeling}" for labeling in labelings),
        *(f"metadata:{column}" for column in columns),
        *(f"nh:{method}" for method in methods),
        "nh_max",
        *(f"{name}:{method}" for method in report.faithfulness for name in ("kept", "false", "missing")),
        *("faces_read", "vertices_read", "faces", "vertices", "components", "watertight", "deviation"),
        *("area", "volume", "extent_x", "extent_y", "extent_z"),
        *("repairs", "sha256"),
        *(("gltf",) if report.exported is not None else ()),
    ]
    for index, (shape, facts, label) in enumerate(
        zip(report.shapes, report.facts, report.labels, strict=True)
    ):
        yield [
            shape.id,
            shape.name,
            _relative_file(root, shape.path),
            label or "",
            *(
                (report.clusters.clusters[report.clusters.of[index]].name,)
                if report.clusters is not None
                else ()
            ),
            *(shape.labels.get(labeling, "") for labeling in labelings),
            *(shape.metadata.get(column, "") for column in columns),
            *(number(report.projections[method][1].nh[index]) for method in methods),
            number(None if label is None else highest.get(label)),
            *(
                number(None if values is None else values[index])
                for found in report.faithfulness.values()
                for values in (found.kept, found.false, found.missing)
            ),
            *map(
                str,
                (facts.faces_read, facts.vertices_read, facts.faces, facts.vertices, facts.components),
            ),
            "true" if facts.watertight else "false",
            number(facts.deviation),
            *("" if value is None else number(value) for value in (facts.area, facts.volume)),
            *map(number, facts.extents),
            json_text(dict(facts.repairs)) if facts.repairs else "",
            facts.sha256,
            *((f"gltf/{report.exported.names[index]}",) if report.exported is not None else ()),
        ]


def shape_columns(report: Report) -> dict[str, npt.NDArray[Any] | list[str | None]]:
    """What :func:`shape_rows` has and the places on all maps, by column: numbers where they are such, and None or NaN
    for an empty cell."""
    header, *rows = shape_rows(report)
    columns: dict[str, npt.NDArray[Any] | list[str | None]] = {}
    for name, cells in zip(header, zip(*rows, strict=True), strict=True):
        kind = column_type(name)
        if kind is str:
            columns[name] = [cell or None for cell in cells]
        elif kind is bool:
            columns[name] = np.array([cell == "true" for cell in cells])
        else:
            columns[name] = np.array([cell or "nan" for cell in cells]).astype(kind)
    for method, (projection, _) in report.projections.items():
        columns[f"x:{method}"], columns[f"y:{method}"] = projection.xy.T
    return columns


def copy_rows(report: Report) -> list[list[str]]:
    """A pair of copies a row, with the number of its group."""
    rows = [["first", "second", "kind", "distance", "largest", "scale", "mirrored", "group"]]
    groups = list_groups(report.copies, [shape.id for shape in report.shapes])
    for place, copy in ((place, copy) for place, group in enumerate(groups, 1) for copy in group.copies):
        match = copy.match
        measured = map(number, (match.distance, match.largest, match.scale))
        mirrored = "true" if match.mirrored else "false"
        rows.append([copy.first, copy.second, match.kind, *measured, mirrored, str(place)])
    return rows


def subset_rows(search: FeatureSearch, limits: HitRange) -> list[list[str]]:
    subsets, found = search.subsets, search.subsets.faithfulness
    measures = (
        () if found is None else (found.trustworthiness, found.continuity, found.stress, found.random_stress)
    )
    header = [
        *(f"feature:{name}" for name in search.features),
        "nh_s",
        *(f"nh_c:{name}" for name in search.classes),
        "nh_max",
        *(f"nh_c_max:{name}" for name in search.classes),
        *("kept", "trustworthiness", "continuity", "stress", "stress_by_chance"),
    ]
    return [
        header,
        *(
            [
                *("1" if has else "0" for has in subsets.members[row]),
                number(subsets.nh_s[row]),
                *map(number, subsets.nh_c[row]),
                number(limits.highest),
                *(number(limits.highest_of_class.get(name)) for name in search.classes),
                number(None if found is None else float(found.kept[row].mean(dtype=np.float64))),
                *(number(None if values is None else values[row]) for values in measures or [None] * 4),
            ]
            for row in by_score(search)
        ),
    ]


def greedy_rows(search: FeatureSearch, limits: HitRange) -> list[list[str]]:
    return [
        ["s", "step", *(f"feature:{name}" for name in search.features), "nh_s", "nh_max"],
        *(
            [
                str(run.s),
                str(place),
                *("1" if name in step.features else "0" for name in search.features),
                number(step.nh_s),
                number(limits.highest),
            ]
            for run in search.greedy
            for place, step in enumerate(run.path, start=1)
        ),
    ]


def table_rows(search: FeatureSearch, limits: HitRange) -> list[list[str]]:
    return [
        ["round", "method", "s", "nh_s", "runs", "nh_max", *(f"feature:{name}" for name in search.features)],
        *(
            [
                str(row.round),
                row.method,
                "" if row.s is None else str(row.s),
                number(row.nh_s),
                str(row.runs),
                number(limits.highest),
                *("1" if name in row.features else "0" for name in search.features),
            ]
            for row in search.table
        ),
    ]


def _relative_file(root: Path, path: Path) -> str:
    """A mesh file as seen from the database's root, with ``/``; only its name where it lies elsewhere."""
    try:
        return path.resolve().relative_to(root).as_posix()
    except ValueError:
        return path.name


def by_score(search: FeatureSearch) -> list[int]:
    """The evaluated subsets from best to worst, in the order of the search where there are no labels."""
    return np.argsort(-search.subsets.nh_s, kind="stable").tolist()
