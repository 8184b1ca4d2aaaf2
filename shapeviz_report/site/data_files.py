"""The site's ``data/`` folder: what a build found, for machines. ``docs/site-data.md`` describes it.

Everything here but the times in ``summary.json`` depends on the input alone, so two builds of the same database
write the same bytes.
"""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path

import numpy as np

from shapeviz_report.types import Report

#: Tells a folder that this package wrote from one that it must not replace.
GENERATOR = "shapeviz-report"


def data_files(report: Report, version: str) -> dict[str, bytes]:
    """``summary.json``, ``shapes.csv``, ``features.npz`` and one ``projection-METHOD.csv`` a projection, by name.

    Parameters
    ----------
    report : Report
    version : str
        Of this package.
    """
    files = {
        "summary.json": (json_text(summary(report, version), indent=1) + "\n").encode(),
        "shapes.csv": _csv(_shape_rows(report)),
        "features.npz": _features(report),
    }
    for method, (projection, _) in report.projections.items():
        points = zip(report.shapes, projection.xy, strict=True)
        rows = [["id", "x", "y"], *([shape.id, _number(x), _number(y)] for shape, (x, y) in points)]
        files[f"projection-{method}.csv"] = _csv(rows)
    return files


def summary(report: Report, version: str) -> dict[str, object]:
    """The content of ``summary.json``: counts, failures, quality, times. Missing numbers are None."""
    classes = {label for label in report.labels if label is not None}
    return {
        "generator": GENERATOR,
        "version": version,
        "database": report.database.name,
        "layout": report.database.layout,
        "labeling": report.labeling,
        "labelings": list(report.database.labelings),
        "shapes": len(report.shapes),
        "classes": len(classes),
        "unlabelled": sum(label is None for label in report.labels),
        "failures": [
            {"path": failure.path, "stage": failure.stage, "reason": failure.reason}
            for failure in report.failures
        ],
        "warnings": list(report.database.warnings),
        "repairs": {
            shape.id: dict(facts.repairs)
            for shape, facts in zip(report.shapes, report.facts, strict=True)
            if facts.repairs
        },
        "projections": {
            method: {
                "features": list(projection.features),
                "seed": projection.seed,
                "k": quality.k,
                "nh_s": _finite(quality.nh_s),
                "nh_c": {name: _finite(value) for name, value in quality.nh_c.items()},
                "null": {"mean": _finite(quality.null_mean), "std": _finite(quality.null_std)},
            }
            for method, (projection, quality) in report.projections.items()
        },
        "seconds": dict(report.seconds),
        "cpu_seconds": dict(report.cpu_seconds),
        "parameters": dict(report.parameters),
        "versions": dict(report.versions),
    }


def json_text(value: object, indent: int | None = None) -> str:
    """JSON in ASCII, so that any text survives any encoding. Raises ``ValueError`` for a NaN or an infinity."""
    separators = None if indent else (",", ":")
    return json.dumps(value, allow_nan=False, indent=indent, separators=separators)


def _features(report: Report) -> bytes:
    file = io.BytesIO()
    np.savez_compressed(
        file,
        values=np.ascontiguousarray(report.features.values, dtype=np.float64),
        columns=np.array(report.features.columns, dtype=np.str_),
        shape_ids=np.array(report.features.shape_ids, dtype=np.str_),
    )
    return file.getvalue()


def _shape_rows(report: Report) -> list[list[str]]:
    labelings = report.database.labelings
    columns = list(dict.fromkeys(column for shape in report.shapes for column in shape.metadata))
    methods = list(report.projections)
    rows = [
        [
            "id",
            "name",
            "file",
            "class",
            *(f"label:{labeling}" for labeling in labelings),
            *(f"metadata:{column}" for column in columns),
            *(f"nh:{method}" for method in methods),
            *("faces_read", "vertices_read", "faces", "vertices", "components", "watertight", "deviation"),
            *("repairs", "sha256"),
        ]
    ]
    for index, (shape, facts, label) in enumerate(
        zip(report.shapes, report.facts, report.labels, strict=True)
    ):
        rows.append(
            [
                shape.id,
                shape.name,
                _relative_file(report, shape.path),
                label or "",
                *(shape.labels.get(labeling, "") for labeling in labelings),
                *(shape.metadata.get(column, "") for column in columns),
                *(_number(report.projections[method][1].nh[index]) for method in methods),
                *map(
                    str,
                    (facts.faces_read, facts.vertices_read, facts.faces, facts.vertices, facts.components),
                ),
                "true" if facts.watertight else "false",
                _number(facts.deviation),
                json_text(dict(facts.repairs)) if facts.repairs else "",
                facts.sha256,
            ]
        )
    return rows


def _relative_file(report: Report, path: Path) -> str:
    """A mesh file as seen from the database's root, with ``/``; only its name where it lies elsewhere."""
    try:
        return path.resolve().relative_to(report.database.root.resolve()).as_posix()
    except ValueError:
        return path.name


def _csv(rows: list[list[str]]) -> bytes:
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(rows)
    # A file name that is no valid text holds lone surrogates, which have no place in UTF-8.
    return text.getvalue().encode("utf-8", "backslashreplace")


def _number(value: float) -> str:
    """The shortest text that reads back as the same number; empty for NaN."""
    return "" if math.isnan(value) else repr(float(value) + 0.0)


def _finite(value: float | None) -> float | None:
    return None if value is None or math.isnan(value) else float(value)
