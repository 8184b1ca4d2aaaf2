"""Text in CSV files, so that no spreadsheet program takes it for a formula."""

from __future__ import annotations

import re

_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
_FORMULA = re.compile(r"'*[=+\-@\t\r\n\uff1d\uff0b\uff0d\uff20]")
"""How a formula begins, also in full-width characters, and after apostrophes, so that one more can be taken off again.
``site/scripts/tray/export.js`` has the same."""


def write_cell(text: str) -> str:
    """A text as a cell: with an apostrophe before it if it would be a formula. Numbers stay."""
    return f"'{text}" if _FORMULA.match(text) and not _NUMBER.fullmatch(text) else text


def read_cell(cell: str) -> str:
    """The text of a cell that :func:`write_cell` has written."""
    return cell[1:] if cell.startswith("'") and _FORMULA.match(cell) else cell
