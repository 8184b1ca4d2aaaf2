"""The features of a database as one file, for other programs."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from zipfile import BadZipFile, ZipFile

import numpy as np

from shapeviz_report.arrow import parquet_bytes, parquet_names, require_pyarrow
from shapeviz_report.descriptors import DESCRIPTORS
from shapeviz_report.errors import ConfigError, SiteError
from shapeviz_report.places import explain, tried
from shapeviz_report.staging import write_atomically
from shapeviz_report.types import Database, FeatureTable, FloatArray, ShapeEntry
from shapeviz_report.writing.data.encoding import archive, csv_text, number

SUFFIXES = (".parquet", ".csv", ".npz")
"""What such a file may be, by its name."""


def check_feature_file(path: Path) -> None:
    """Refuse, before anything is computed, a file that cannot be written, or would take the place of another.

    Raises
    ------
    ConfigError, SiteError
    """
    if path.suffix.lower() not in SUFFIXES:
        raise ConfigError(
            f"the file of features {path} must end in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}"
        )
    if path.is_dir():
        raise ConfigError(f"the file of features {path} is a folder")
    if path.suffix.lower() == ".parquet":
        require_pyarrow(f"the file of features {path}", ".csv and .npz need nothing more")
    if path.exists() and not _is_replaced(path):
        raise ConfigError(
            f"{path} is not what `describe` writes, and would be replaced: move it, or choose another name"
        )
    try:
        with tried(path.absolute().parent) as trial:
            (trial / path.name).write_bytes(b"")
    except OSError as error:
        raise _unwritable(path, error) from error


def write_feature_file(
    path: Path, database: Database, shapes: Sequence[ShapeEntry], features: FeatureTable, edges: FloatArray
) -> None:
    """Write a row a shape: what it is, and its features.

    Parameters
    ----------
    path : Path
        Its suffix, one of :data:`SUFFIXES`, says what is written.
    database : Database
    shapes : sequence of ShapeEntry
        That of each row.
    features : FeatureTable
    edges : (D, 11) float64 array

    Raises
    ------
    SiteError
        It cannot be written.
    """
    texts = _describe(database, shapes)
    write = {".parquet": _parquet, ".csv": _csv, ".npz": _archive}[path.suffix.lower()]
    try:
        write_atomically(path.absolute(), write(texts, features, edges))
    except OSError as error:
        raise _unwritable(path, error) from error


def _is_replaced(path: Path) -> bool:
    """Whether what lies there is nothing, or an earlier file of features."""
    if path.stat().st_size == 0:
        return True
    try:
        names = _NAMES[path.suffix.lower()](path)
    except (OSError, ValueError, BadZipFile):
        return False
    return {"id", "class", _FIRST} <= set(names) or {"columns", "shape_ids", "classes"} <= set(names)


def _csv_names(path: Path) -> Sequence[str]:
    with path.open(encoding="utf-8", newline="") as file:
        try:
            return next(csv.reader(file))
        except csv.Error as error:
            raise ValueError(error) from error


def _archive_names(path: Path) -> Sequence[str]:
    with ZipFile(path) as file:
        return [Path(name).stem for name in file.namelist()]


_NAMES = {".csv": _csv_names, ".npz": _archive_names, ".parquet": parquet_names}
"""What the columns or arrays of a file are called."""

_FIRST = f"{DESCRIPTORS[0].name}:1"
"""A column that every table of features has."""


def _unwritable(path: Path, error: OSError) -> SiteError:
    return SiteError(f"the features cannot be written to {path}: {explain(error)}")


def _describe(database: Database, shapes: Sequence[ShapeEntry]) -> dict[str, list[str | None]]:
    """Column -> what it says of each shape, named as in ``data/shapes.csv``."""
    metadata = dict.fromkeys(column for shape in shapes for column in shape.metadata)
    active = database.labelings[0] if database.labelings else ""
    return {
        "id": [shape.id for shape in shapes],
        "class": [shape.labels.get(active) for shape in shapes],
        **{f"label:{name}": [shape.labels.get(name) for shape in shapes] for name in database.labelings},
        **{f"metadata:{name}": [shape.metadata.get(name) for shape in shapes] for name in metadata},
    }


def _csv(texts: dict[str, list[str | None]], features: FeatureTable, edges: FloatArray) -> bytes:
    rows = [[*texts, *features.columns]]
    for told, values in zip(zip(*texts.values(), strict=True), features.values.tolist(), strict=True):
        rows.append([*(text or "" for text in told), *map(number, values)])
    return csv_text(rows)


def _archive(texts: dict[str, list[str | None]], features: FeatureTable, edges: FloatArray) -> bytes:
    """As ``data/features.npz`` of a site, and the classes."""
    return archive(
        values=features.values,
        columns=np.array(features.columns, dtype=np.str_),
        shape_ids=np.array(features.shape_ids, dtype=np.str_),
        edges=edges,
        classes=np.array([text or "" for text in texts["class"]], dtype=np.str_),
    )


def _parquet(texts: dict[str, list[str | None]], features: FeatureTable, edges: FloatArray) -> bytes:
    columns = np.ascontiguousarray(features.values.T)
    return parquet_bytes({**texts, **dict(zip(features.columns, columns, strict=True))})
