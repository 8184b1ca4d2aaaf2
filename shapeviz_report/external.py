"""Features that are brought along in a file: a row a shape, by the order of the shapes or by their ids."""

from __future__ import annotations

import csv
import io
import struct
import zipfile
import zlib
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.arrow import column_numbers, column_texts, read_parquet, require_pyarrow
from shapeviz_report.cells import read_cell
from shapeviz_report.errors import ConfigError
from shapeviz_report.files import read_regular
from shapeviz_report.types import FloatArray

MOST_EXTERNAL_BYTES = 256 * 1024**2
"""Size of the largest file of a user's own feature, and of what is packed in it."""

MOST_EXTERNAL_COLUMNS = 2000
"""Columns of a user's own feature, each of which is scored and shown: as many as all of the descriptors have."""

DESCRIBING = ("class", "label:", "metadata:")
"""How columns begin that say what a shape is, in files that ``shapeviz-report describe`` writes."""


def load_external(path: Path, ids: Sequence[str]) -> FloatArray:
    """A user's own feature: (n, d) float64 values, a row for each of n shapes.

    Parameters
    ----------
    path : Path
        An array ``.npy`` with the rows in the order of the shapes; or, with rows for more shapes and in any order, an
        archive ``.npz`` of ``values`` and ``shape_ids``, or a table ``.csv`` or ``.parquet`` with a column ``id``.
    ids : sequence of str
        Of the shapes.

    Raises
    ------
    ConfigError
        The file is none of these, lacks a shape, or holds anything but finite numbers.
    """
    suffix = path.suffix.lower()
    if suffix not in (".npy", *_READ):
        raise ConfigError(f"the feature file {path} must end in .npy, {', '.join(_READ)}")
    if suffix == ".parquet":
        require_pyarrow(f"the feature file {path}", "or write it as .npz or .csv")
    try:
        content = read_regular(path, MOST_EXTERNAL_BYTES)
        if suffix == ".npy":
            values = np.load(io.BytesIO(content), allow_pickle=False)
        else:
            rows, values = _READ[suffix](content)
    except OSError as error:
        raise ConfigError(f"the feature file {path} cannot be read: {error.strerror}") from error
    except (
        ValueError, TypeError, KeyError, OverflowError, MemoryError, EOFError, RuntimeError, NotImplementedError,
        csv.Error, struct.error, zipfile.BadZipFile, zlib.error,
    ) as error:  # fmt: skip
        raise ConfigError(f"the feature file {path} cannot be read: {error}") from error
    if not isinstance(values, np.ndarray) or values.ndim not in (1, 2) or values.dtype.kind not in "fiub":
        raise ConfigError(f"the feature file {path} must hold one array of numbers with one row a shape")
    if suffix == ".npy":
        if len(values) != len(ids):
            raise ConfigError(
                f"the feature file {path} has {len(values)} rows, but the database has {len(ids)} shapes; "
                "`shapeviz-report check DATABASE --list` prints them in the order of the rows"
            )
    else:
        values = values[_places(path, rows, len(values), ids)]
    values = values.reshape(len(values), -1).astype(np.float64)
    if values.shape[1] > MOST_EXTERNAL_COLUMNS:
        raise ConfigError(
            f"the feature file {path} has {values.shape[1]:,} columns, more than {MOST_EXTERNAL_COLUMNS:,}; keep those "
            "that tell most"
        )
    if values.shape[1] == 0 or not np.isfinite(values).all():
        raise ConfigError(f"the feature file {path} must hold finite numbers only")
    return values


def _places(path: Path, rows: Sequence[str], count: int, ids: Sequence[str]) -> list[int]:
    """The row of each shape. Raises ``ConfigError``."""
    if len(rows) != count:
        raise ConfigError(f"the feature file {path} has {count} rows, but {len(rows)} ids of shapes")
    twice = next((shape for shape, times in Counter(rows).items() if times > 1), None)
    if twice is not None:
        raise ConfigError(f"the feature file {path} has two rows for the shape {twice!r}")
    place = {shape: number for number, shape in enumerate(rows)}
    missing = [shape for shape in ids if shape not in place]
    if missing:
        raise ConfigError(
            f"the feature file {path} has no row for {len(missing)} of the {len(ids)} shapes of the database, such as "
            f"{missing[0]!r}; `shapeviz-report check DATABASE --list` prints the ids"
        )
    return [place[shape] for shape in ids]


def _read_archive(content: bytes) -> tuple[list[str], npt.NDArray[Any]]:
    """Ids and values, as in ``data/features.npz`` of a site."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        if sum(member.file_size for member in archive.infolist()) > MOST_EXTERNAL_BYTES:
            raise ValueError(f"it holds more than {MOST_EXTERNAL_BYTES // 2**20} MiB")
    with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
        for name in ("shape_ids", "values"):
            if name not in arrays:
                raise ValueError(f"it has no array {name!r}")
        return [str(shape) for shape in arrays["shape_ids"].ravel().tolist()], arrays["values"]


def _read_table(content: bytes) -> tuple[list[str], npt.NDArray[np.float64]]:
    """Ids and values of a table, whose columns that say what a shape is do not count."""
    head, *rows = csv.reader(io.StringIO(content.decode("utf-8-sig"), newline=""), strict=True)
    rows = [row for row in rows if row]
    if "id" not in head:
        raise ValueError("it has no column 'id'")
    for number, row in enumerate(rows, start=2):
        if len(row) != len(head):
            raise ValueError(f"row {number} has {len(row)} cells, and the head {len(head)}")
    key = head.index("id")
    told = [place for place, name in enumerate(head) if place != key and not name.startswith(DESCRIBING)]
    values = np.array([[float(row[place]) for place in told] for row in rows], np.float64)
    return [read_cell(row[key]) for row in rows], values.reshape(len(rows), len(told))


def _read_columns(content: bytes) -> tuple[list[str], npt.NDArray[np.float64]]:
    """Ids and values of a Parquet table, whose columns may also be lists of as many numbers a shape."""
    table = read_parquet(content, MOST_EXTERNAL_BYTES // 2, MOST_EXTERNAL_BYTES)
    if table.column_names.count("id") != 1:
        raise ValueError("it needs one column 'id' (the index of a data frame is one once it has this name)")
    ids = column_texts(table["id"])
    if ids is None:
        raise ValueError("its column 'id' holds no text")
    columns = [np.empty((len(ids), 0))]
    for name, column in zip(table.column_names, table.columns):
        if name == "id" or name.startswith(DESCRIBING):
            continue
        values = column_numbers(column)
        if values is None:
            raise ValueError(f"its column {name!r} holds neither numbers nor lists of as many numbers a row")
        columns.append(values)
    return ids, np.hstack(columns)


_READ: dict[str, Callable[[bytes], tuple[list[str], npt.NDArray[Any]]]] = {
    ".npz": _read_archive,
    ".csv": _read_table,
    ".parquet": _read_columns,
}
"""What reads rows with ids, by suffix."""
