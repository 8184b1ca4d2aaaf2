"""Features that are brought along in a file: a row a shape, by the order of the shapes or by their ids."""

from __future__ import annotations

import csv
import io
import re
import struct
import unicodedata
import zipfile
import zlib
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.arrow import column_numbers, column_texts, read_parquet, require_pyarrow
from shapeviz_report.cells import NAMELESS, part_cells, read_cell
from shapeviz_report.errors import ConfigError
from shapeviz_report.executor import call_apart
from shapeviz_report.files import decode_text, read_regular
from shapeviz_report.types import FloatArray

MOST_EXTERNAL_BYTES = 256 * 1024**2
"""Size of the largest file of a user's own feature, and of what is packed in it."""

MOST_EXTERNAL_COLUMNS = 2000
"""Columns of a user's own feature, each of which is scored and shown: as many as all of the descriptors have."""

_LARGEST = 1e100
"""Numbers and differences between this and its reciprocal have squares, and sums of them, that are numbers too."""

_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)

DESCRIBING = ("class", "label:", "metadata:")
"""How columns begin that say what a shape is, in files that ``shapeviz-report describe`` writes."""


def load_external(path: Path, ids: Sequence[str]) -> FloatArray:
    """A user's own feature: (n, d) float64 values, a row for each of n shapes.

    Parameters
    ----------
    path : Path
        An array ``.npy`` with the rows in the order of the shapes; or, with rows for more shapes and in any order, an
        archive ``.npz`` of ``values`` and ``shape_ids``, or a table ``.csv``, ``.tsv`` or ``.parquet`` with a column
        ``id``.
    ids : sequence of str
        Of the shapes.

    Raises
    ------
    ConfigError
        The file is none of these, lacks a shape, or holds anything but finite numbers.
    """
    values = _load(f"the feature file {path}", path, ids, ())
    if values.shape[1] > MOST_EXTERNAL_COLUMNS:
        raise ConfigError(
            f"the feature file {path} has {values.shape[1]:,} columns, more than {MOST_EXTERNAL_COLUMNS:,}; keep those "
            "that tell most"
        )
    if np.abs(values).max(initial=0.0) > _LARGEST or np.any(_extents(values) < 1 / _LARGEST):
        raise ConfigError(
            f"the feature file {path} has numbers above {_LARGEST:g}, or that differ by less than {1 / _LARGEST:g}; "
            "scale them"
        )
    return values


def _extents(values: FloatArray) -> FloatArray:
    """How far the numbers of each column that has different ones reach."""
    extents = values.max(axis=0, initial=-np.inf) - values.min(axis=0, initial=np.inf)
    return np.asarray(extents[extents > 0])


def load_coordinates(path: Path, ids: Sequence[str]) -> FloatArray:
    """A user's own map: the place (n, 2) of each of n shapes, as it stands in the file.

    Parameters
    ----------
    path : Path
        As for :func:`load_external`, with two values a shape; those of a table are its columns ``x`` and ``y``.
    ids : sequence of str
        Of the shapes.

    Raises
    ------
    ConfigError
        The file is none of these, lacks a shape, holds anything but finite numbers, or has all shapes in one place.
    """
    what = f"the file of coordinates {path}"
    places = _load(what, path, ids, ("x", "y"))
    if places.shape[1] != 2:
        raise ConfigError(f"{what} has {places.shape[1]} values a shape, and not two, x and y")
    with np.errstate(over="ignore"):
        extent = np.ptp(places, axis=0).max(initial=0.0)
    if not np.isfinite(extent):
        raise ConfigError(f"{what} has places that lie farther apart than numbers can tell; scale them")
    if extent == 0 and len(ids) > 1:
        raise ConfigError(f"{what} has all {len(ids)} shapes of the database in one place, which is no map")
    return places


def _load(what: str, path: Path, ids: Sequence[str], columns: Sequence[str]) -> FloatArray:
    """The values (n, d) of each shape in a file: finite, of some columns where a table names them, else of all."""
    suffix = path.suffix.lower()
    if suffix not in (".npy", *_READ):
        raise ConfigError(f"{what} must end in .npy, {', '.join(_READ)}")
    if suffix == ".parquet":
        require_pyarrow(what, "or write it as .npz or .csv")
    try:
        content = read_regular(path, MOST_EXTERNAL_BYTES)
        if suffix == ".npy":
            values = np.load(io.BytesIO(content), allow_pickle=False)
        else:
            rows, values = _READ[suffix](content, columns)
    except OSError as error:
        raise ConfigError(f"{what} cannot be read: {error.strerror}") from error
    except (
        ValueError, TypeError, KeyError, OverflowError, MemoryError, EOFError, RuntimeError, NotImplementedError,
        csv.Error, struct.error, zipfile.BadZipFile, zlib.error,
    ) as error:  # fmt: skip
        if "pickle" in str(error):  # numpy would have it trusted
            error = ValueError("it holds Python objects, not numbers alone; save an array of numbers")
        raise ConfigError(f"{what} cannot be read: {error}") from error
    if not isinstance(values, np.ndarray) or values.ndim not in (1, 2) or values.dtype.kind not in "fiub":
        raise ConfigError(f"{what} must hold one array of numbers with one row a shape")
    if suffix == ".npy":
        if len(values) != len(ids):
            raise ConfigError(
                f"{what} has {len(values)} rows, but the database has {len(ids)} shapes; "
                "`shapeviz-report check DATABASE --list` prints them in the order of the rows"
            )
    else:
        values = values[_places(what, rows, len(values), ids)]
    values = values.reshape(len(values), -1).astype(np.float64)
    if values.shape[1] == 0:
        raise ConfigError(f"{what} has no columns of numbers")
    wrong = np.argwhere(~np.isfinite(values))
    if len(wrong):
        shape, column = wrong[0].tolist()
        count = len(np.unique(wrong[:, 0]))
        raise ConfigError(
            f"{what} must hold finite numbers only, and has {values[shape, column]} as number {column + 1} of the "
            f"shape {ids[shape]!r}" + (f", and such of {count - 1} more" if count > 1 else "")
        )
    return values


def _places(what: str, rows: Sequence[str], count: int, ids: Sequence[str]) -> list[int]:
    """The row of each shape. Raises ``ConfigError``."""
    if len(rows) != count:
        raise ConfigError(f"{what} has {count} rows, but {len(rows)} ids of shapes")
    twice = next((shape for shape, times in Counter(rows).items() if times > 1), None)
    if twice is not None:
        raise ConfigError(f"{what} has two rows for the shape {twice!r}")
    place = {shape: number for number, shape in enumerate(rows)}
    # programs write accents in one form, file systems have them in another: one row and one shape that look alike
    # are the same
    composed = [*map(_composed, rows)]
    once = {form for form, times in Counter(composed).items() if times == 1}
    once -= {form for form, times in Counter(map(_composed, ids)).items() if times > 1}
    alike = {form: number for number, form in enumerate(composed) if form in once}
    found = [place.get(shape, alike.get(_composed(shape))) for shape in ids]
    missing = [shape for shape, row in zip(ids, found) if row is None]
    if missing:
        strange = sorted({*rows}.difference(ids))
        theirs = f", but rows of none, such as {strange[0]!r}" if strange else ""
        raise ConfigError(
            f"{what} has no row for {len(missing)} of the {len(ids)} shapes of the database, such as "
            f"{missing[0]!r}{theirs}; `shapeviz-report check DATABASE --list` prints the ids"
        )
    return [row for row in found if row is not None]


def _composed(shape: str) -> str:
    return unicodedata.normalize("NFC", shape)


def _read_archive(content: bytes, columns: Sequence[str]) -> tuple[list[str], npt.NDArray[Any]]:
    """Ids and values, as in ``data/features.npz`` of a site; its columns need no names."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        if sum(member.file_size for member in archive.infolist()) > MOST_EXTERNAL_BYTES:
            raise ValueError(f"it holds more than {MOST_EXTERNAL_BYTES // 2**20} MiB")
    with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
        for name in ("shape_ids", "values"):
            if name not in arrays:
                raise ValueError(f"it has no array {name!r}")
        try:
            ids = arrays["shape_ids"]
        except ValueError as error:
            raise ValueError("its ids are no text, as numpy.array(ids, str) makes it") from error
        if ids.dtype.kind == "S":  # text as HDF5 has it
            ids = np.char.decode(ids, "utf-8")
        return [str(shape) for shape in ids.ravel().tolist()], arrays["values"]


def _read_table(content: bytes, columns: Sequence[str]) -> tuple[list[str], npt.NDArray[np.float64]]:
    """Ids and values of a table: of some columns, or of all but those that say what a shape is."""
    ways = list(part_cells(decode_text(content)))
    table = next((way for way in ways if "id" in way.header), ways[0])
    head, rows = table.header, [row for row in table.rows if row]
    if not head:
        raise ValueError("it is empty")
    for name in ("id", *columns):
        if name not in head:
            raise ValueError(f"it has no column {name!r}")
    for number, row in enumerate(rows, start=2):
        if len(row) != len(head):
            raise ValueError(f"row {number} has {len(row)} cells, and the head {len(head)}")
    key = head.index("id")
    told = [head.index(name) for name in columns] or [
        place for place, name in enumerate(head) if place != key and not _is_no_number(name)
    ]
    values = np.array(
        [
            [_number(row[place], number, head[place]) for place in told]
            for number, row in enumerate(rows, start=2)
        ],
        np.float64,
    )
    return [read_cell(row[key]) for row in rows], values.reshape(len(rows), len(told))


def _is_no_number(column: str) -> bool:
    """Whether a column says what a shape is, or only numbers the rows, and so is no part of the feature."""
    return column.startswith(DESCRIBING) or NAMELESS.fullmatch(column) is not None


def _number(cell: str, row: int, column: str) -> float:
    try:
        return float(cell)
    except ValueError:
        hint = "; write numbers with a decimal point" if _DECIMAL_COMMA.fullmatch(cell.strip()) else ""
        raise ValueError(
            f"row {row} has {cell!r} in the column {column!r}, which is no number{hint}"
        ) from None


def _read_columns(content: bytes, columns: Sequence[str]) -> tuple[list[str], npt.NDArray[np.float64]]:
    """As :func:`_read_table`, of a Parquet table, whose columns may also be lists of as many numbers a shape."""
    table = read_parquet(content, MOST_EXTERNAL_BYTES // 2, MOST_EXTERNAL_BYTES)
    for name in ("id", *columns):
        if table.column_names.count(name) != 1:
            raise ValueError(
                f"it needs one column {name!r} (the index of a data frame is one if it has a name)"
            )
    ids = column_texts(table["id"])
    if ids is None:
        raise ValueError("its column 'id' holds no text")
    told = columns or [name for name in table.column_names if name != "id" and not _is_no_number(name)]
    found = [np.empty((len(ids), 0))]
    for name in told:
        values = column_numbers(table[name])
        if values is None:
            raise ValueError(f"its column {name!r} holds neither numbers nor lists of as many numbers a row")
        found.append(values)
    return ids, np.hstack(found)


def _read_parquet(content: bytes, columns: Sequence[str]) -> tuple[list[str], npt.NDArray[np.float64]]:
    """As :func:`_read_columns`, in another process: pyarrow is C++, and the file perhaps a stranger's."""
    return call_apart(_read_columns, content, columns)


_READ: dict[str, Callable[[bytes, Sequence[str]], tuple[list[str], npt.NDArray[Any]]]] = {
    ".npz": _read_archive,
    ".csv": _read_table,
    ".tsv": _read_table,
    ".parquet": _read_parquet,
}
"""What reads rows with ids, by suffix."""
