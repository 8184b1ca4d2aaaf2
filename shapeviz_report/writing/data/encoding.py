"""How the files of ``data/`` are encoded: JSON, tables, archives of arrays."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.cells import read_cell, write_cell

#: Tells a folder that this package wrote from one that it must not replace.
GENERATOR = "shapeviz-report"


def json_text(value: object, indent: int | None = None) -> str:
    """JSON in ASCII, so that any text survives any encoding. Raises ``ValueError`` for a NaN or an infinity."""
    separators = None if indent else (",", ":")
    return json.dumps(value, allow_nan=False, indent=indent, separators=separators)


def archive(**arrays: np.ndarray) -> bytes:
    """Arrays as a compressed file, for numpy."""
    file = io.BytesIO()
    np.savez_compressed(file, allow_pickle=False, **arrays)
    return file.getvalue()


def read_archive(content: bytes) -> dict[str, npt.NDArray[Any]]:
    """The arrays in a file of :func:`archive`."""
    with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
        return dict(arrays)


def csv_text(rows: Iterable[list[str]]) -> bytes:
    """A table as a file, in which no spreadsheet program meets a formula."""
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows([write_cell(text) for text in row] for row in rows)
    # A file name that is no valid text holds lone surrogates, which have no place in UTF-8.
    return text.getvalue().encode("utf-8", "backslashreplace")


def read_csv(content: bytes) -> list[list[str]]:
    """The cells of a file of :func:`csv_text`, as they were."""
    rows = csv.reader(io.StringIO(content.decode(), newline=""), strict=True)
    return [[read_cell(cell) for cell in row] for row in rows]


def number(value: float | None) -> str:
    """The shortest text that reads back as the same number; empty for NaN and for none."""
    return "" if value is None or math.isnan(value) else repr(float(value) + 0.0)


def finite(value: float | None) -> float | None:
    """A number for JSON; None for NaN and for none."""
    return None if value is None or math.isnan(value) else float(value)
