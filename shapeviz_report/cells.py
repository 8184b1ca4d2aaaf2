"""CSV files: how their cells are parted, and text in them, so that no spreadsheet program takes it for a formula."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from functools import partial
from typing import Any, NamedTuple

DELIMITERS = (",", ";", "\t", "|")

NAMELESS = re.compile(r"(__index_level_\d+__|Unnamed: \d+)?")
"""What a column without a name is called; such an index of a data frame is mere numbers of rows."""

_EXCEL_DELIMITER = re.compile(r'"?sep=(.)"?')
_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
_FORMULA = re.compile(r"'*[=+\-@\t\r\n\uff1d\uff0b\uff0d\uff20]")
"""How a formula begins, also in full-width characters, and after apostrophes, so that one more can be taken off again.
``site/scripts/tray/export.js`` has the same."""


class Parted(NamedTuple):
    """A text as CSV with one delimiter.

    Attributes
    ----------
    delimiter : str
    header : list of str
        Its first row; empty if there is none.
    rows : iterator of list of str
        The others, with ``line_num`` as the csv module has it. They may raise ``csv.Error``.
    above : int
        Lines above the header, which do not count in ``line_num``.
    """

    delimiter: str
    header: list[str]
    rows: Any
    above: int


def part_cells(text: str) -> Iterator[Parted]:
    """A text as CSV, empty lines above it apart, with each delimiter that programs use, or with the one that its first
    line names: whoever knows a column takes the first in which it appears. In the rows, quotes that are not as they
    should be are an error.

    Raises
    ------
    csv.Error
        The header cannot be read.
    """
    written = text.lstrip("\r\n")
    above = text[: len(text) - len(written)].count("\n")
    first, _, rest = written.partition("\n")
    told = _EXCEL_DELIMITER.fullmatch(first.strip(" \r"))
    body, above = (rest, above + 1) if told else (written, above)
    for delimiter in (told[1],) if told else DELIMITERS:
        read = partial(csv.reader, delimiter=delimiter, skipinitialspace=True)
        header = next(read(io.StringIO(body, newline="")), [])
        rows = read(io.StringIO(body, newline=""), strict=True)
        next(rows, None)
        yield Parted(delimiter, header, rows, above)


def write_cell(text: str) -> str:
    """A text as a cell: with an apostrophe before it if it would be a formula. Numbers stay."""
    return f"'{text}" if _FORMULA.match(text) and not _NUMBER.fullmatch(text) else text


def read_cell(cell: str) -> str:
    """The text of a cell that :func:`write_cell` has written."""
    return cell[1:] if cell.startswith("'") and _FORMULA.match(cell) else cell
