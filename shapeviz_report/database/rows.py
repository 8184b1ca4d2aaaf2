"""What a table says: the rows of CSV, JSON and Parquet, of the columns that name files and classes."""

from __future__ import annotations

import csv
import json
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from itertools import zip_longest
from pathlib import Path
from typing import TypeGuard

from shapeviz_report.arrow import Columns, parquet_texts, require_pyarrow
from shapeviz_report.cells import NAMELESS, part_cells
from shapeviz_report.database.formats import suffix_of
from shapeviz_report.database.text import clean, decode, encodable
from shapeviz_report.errors import ConfigError, DatabaseError
from shapeviz_report.executor import call_apart
from shapeviz_report.files import read_regular

FILE_COLUMN = "file"
LABEL_COLUMN = "label"
FILE_COLUMNS = (
    FILE_COLUMN,
    "filename",
    "filepath",
    "path",
    "mesh",
    "meshfile",
    "model",
    "modelfile",
    "fullid",
    "id",
)
"""Names of the column with the files, from the plainest on; case, spaces, ``_`` and ``-`` do not matter."""
_BIN = re.compile(r"\w+(\[\d+\])?:\d+")
"""Names of columns in tables of features, such as ``shapeviz-report describe`` writes."""
CLASS_COLUMNS = ("class", "classname", "category")
"""Names of metadata columns that are labelings whatever their values are; written as those above."""
NO_VALUES = frozenset({"NaN", "nan", "N/A", "n/a", "#N/A", "<NA>"})
"""Cells with which programs write that there is no value. A class may be called "none" or "null"."""
LINES_SUFFIXES = (".jsonl", ".ndjson")
PARQUET = ".parquet"
TABLE_SUFFIXES = (".csv", ".tsv", ".json", *LINES_SUFFIXES, PARQUET)
MOST_BYTES = 64 * 1024**2
"""Size of the largest table that is read."""
MOST_UNPACKED = 256 * 1024**2
"""Bytes that a Parquet table may unpack to."""
MOST_CELLS = 5_000_000
"""Cells of a table, empty ones too: 50 for each of 100,000 shapes."""
MOST_LETTERS = 131_072
"""Letters of a cell, as the csv module has it."""

_SECOND_OBJECT = re.compile(r"\s*\{.*\}[ \t\r]*\n\s*\{")
"""An object that ends on its line and another below, without a comma: JSON lines, whatever the file is called."""


@dataclass(frozen=True)
class Row:
    """One row: where it stands, its file, and its other cells by column, in the table's order, empty ones too."""

    place: str
    file: str
    cells: Mapping[str, str]

    @property
    def filled(self) -> dict[str, str]:
        """The cells that say something."""
        return {column: cell for column, cell in self.cells.items() if cell}


@dataclass(frozen=True)
class Content:
    """What a table says: its rows, warnings, and whether it plainly is one of meshes, with a column ``file``."""

    rows: list[Row]
    warnings: list[str]
    plain: bool


class OtherContentError(DatabaseError):
    """A table has neither a column of files nor one of classes, or holds features: it lists no shapes.

    Attributes
    ----------
    texts : iterable of str
        What it holds, in which names of meshes may stand all the same.
    """

    def __init__(self, complaint: str, texts: Iterable[str]) -> None:
        super().__init__(complaint)
        self.texts = texts


def _read_text(table: Path) -> tuple[str, bool]:
    try:
        return decode(read_regular(table, MOST_BYTES))
    except OSError as error:
        raise DatabaseError(f"The table {table} cannot be read: {error.strerror}.") from error


def read_rows(table: Path) -> Content:
    """The rows of a CSV, JSON or Parquet table. Raises ``DatabaseError`` where it cannot be understood."""
    if suffix_of(table.name) == PARQUET:
        return _read_parquet(table)
    text, certain = _read_text(table)
    warnings = [] if certain else [f"{table.name} is not UTF-8; it was read as Windows-1252."]
    is_csv = suffix_of(table.name) in (".csv", ".tsv")
    rows, plain = _csv_rows(text, table) if is_csv else _json_rows(text, table)
    return Content(rows, warnings, plain)


def _read_parquet(table: Path) -> Content:
    try:
        require_pyarrow(f"The table {table}", "or save it as CSV")
        found = call_apart(parquet_texts, read_regular(table, MOST_BYTES), MOST_CELLS, MOST_UNPACKED)
    except ConfigError as error:
        raise DatabaseError(f"{error}.") from error
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise DatabaseError(f"The table {table} cannot be read: {reason}.") from error
    return column_rows(found, table)


def column_rows(found: Columns, table: Path) -> Content:
    """The rows of a table of columns with types."""
    texts = {}
    left_out = []
    found = [(name, cells) for name, cells in found if not NAMELESS.fullmatch(name)]
    names = [name for name, _ in found]
    columns = _columns(names)
    _check_names(columns, names, table)
    for column, (name, cells) in zip(columns, found):
        if cells is None:
            left_out.append(name)
        elif any(len(cell) > MOST_LETTERS for cell in cells):
            raise DatabaseError(
                f"The table {table} has a value longer than {MOST_LETTERS:,} letters in its column '{name}'."
            )
        else:
            # a text of many rows stays one, and is looked at once
            texts[column] = [*map(cache(partial(_tidy, column)), cells)]
    warnings = []
    if left_out:
        warnings.append(
            f"Columns of {table.name} hold neither text, numbers nor dates and are left out: "
            f"{', '.join(map(clean, left_out))}."
        )
    if FILE_COLUMN not in texts:
        complaint = " ".join([f"The table {table} has no column '{FILE_COLUMN}'.", *warnings])
        raise _no_files(names, complaint, (cell for cells in texts.values() for cell in cells))
    rows = [
        _row(f"row {number}", dict(zip(texts, cells)))
        for number, cells in enumerate(zip(*texts.values()), 1)
        if any(cells)
    ]
    return Content(rows, warnings, FILE_COLUMN in map(plain_name, names))


def _no_files(names: Sequence[str], complaint: str, texts: Iterable[str]) -> DatabaseError:
    """The error of a table without a column of files that can be read."""
    if any(map(_BIN.fullmatch, names)):
        return OtherContentError(complaint, ())
    about_shapes = any(plain_name(name) in (FILE_COLUMN, LABEL_COLUMN, *CLASS_COLUMNS) for name in names)
    return DatabaseError(complaint) if about_shapes else OtherContentError(complaint, texts)


def _csv_rows(text: str, table: Path) -> tuple[list[Row], bool]:
    """The rows, separated by the delimiter that makes a column of files appear."""
    seen: list[str] = []
    try:
        for parted in part_cells(text):
            columns = _columns(parted.header)
            if FILE_COLUMN in columns:
                break
            seen += parted.header
    except csv.Error as error:
        raise DatabaseError(f"The table {table} is not CSV: {error}.") from error
    if FILE_COLUMN not in columns:
        raise _no_files(
            seen,
            f"The table {table} has no column '{FILE_COLUMN}'. Its first line must name the columns, "
            "for instance: file,label.",
            [text],
        )
    delimiter, header, reader, above = parted
    _check_names(columns, header, table)
    rows: list[Row] = []
    read = reader.line_num
    try:
        for cells in reader:
            check_cells(table, len(rows) * len(columns))
            place = f"line {reader.line_num + above}"
            if any(cell.strip() for cell in cells[len(columns) :]):
                raise DatabaseError(
                    f"{table}, {place}: there are more cells than the {len(columns)} columns. "
                    f"A cell that contains '{delimiter}' belongs in double quotes."
                )
            if any(cell.strip() for cell in cells):
                texts = zip_longest(columns, cells, fillvalue="")
                rows.append(_row(place, {column: _tidy(column, cell) for column, cell in texts}))
            read = reader.line_num
    except csv.Error as error:
        # the row that begins here: what a quote opens may swallow all lines below
        raise DatabaseError(f"{table}, line {read + above + 1}: this is not CSV: {error}.") from error
    return rows, FILE_COLUMN in map(plain_name, header)


def _json_rows(text: str, table: Path) -> tuple[list[Row], bool]:
    # by the characters that part values, before any is made
    check_cells(table, text.count(",") + text.count("[") + text.count("{"))
    entries = _json_entries(text, table)
    keys = list(dict.fromkeys(key for _, entry in entries for key in entry))
    names = dict(zip(keys, _columns(keys)))
    if FILE_COLUMN not in names.values():
        raise _no_files(keys, f"The table {table} has no key '{FILE_COLUMN}' in its objects.", [text])
    rows = []
    for place, entry in entries:
        _check_names([names[key] for key in entry], list(entry), table, place)
        cells = {names[key]: _as_text(value) for key, value in entry.items()}
        if any(len(cell) > MOST_LETTERS for cell in cells.values()):
            raise DatabaseError(f"{table}, {place}: a value is longer than {MOST_LETTERS:,} letters.")
        rows.append(_row(place, {column: _tidy(column, cell) for column, cell in cells.items()}))
    return rows, FILE_COLUMN in map(plain_name, keys)


def _json_entries(text: str, table: Path) -> list[tuple[str, dict[str, object]]]:
    """The objects of a list, of the only such list under a key of an object, or one a line; each with its place."""

    def parse(text: str, where: str = "") -> object:
        try:
            return json.loads(text, parse_constant=lambda _: None, object_pairs_hook=unique)
        except (ValueError, RecursionError) as error:
            raise DatabaseError(f"The table {table}{where} is not JSON: {error}.") from error

    def unique(pairs: list[tuple[str, object]]) -> dict[str, object]:
        if len(found := dict(pairs)) < len(pairs):
            twice = [key for key, count in Counter(key for key, _ in pairs).items() if count > 1]
            raise ValueError(f"an object has the key '{twice[0]}' twice")
        return found

    whole: object
    if suffix_of(table.name) in LINES_SUFFIXES or _SECOND_OBJECT.match(text):
        lines = [(f"line {number}", line) for number, line in enumerate(text.split("\n"), 1) if line.strip()]
        places, whole = [place for place, _ in lines], [parse(line, f", {place},") for place, line in lines]
    else:
        whole = parse(text)
        if isinstance(whole, dict):
            lists = [value for value in whole.values() if value and _is_list_of_objects(value)]
            whole = lists[0] if len(lists) == 1 else None
        places = [f"entry {number}" for number in range(1, len(whole) + 1)] if isinstance(whole, list) else []
    if not _is_list_of_objects(whole):
        raise OtherContentError(
            f'The table {table} is not a list of objects: [{{"file": "a.off", "label": "cup"}}, ...], as pandas '
            'writes it with orient="records".',
            [text],
        )
    return list(zip(places, whole, strict=True))


def check_cells(table: Path, count: int) -> None:
    """Refuse a table of too many cells. Raises ``DatabaseError``."""
    if count > MOST_CELLS:
        raise DatabaseError(
            f"The table {table} has more than {MOST_CELLS:,} cells; leave out columns that say nothing of the shapes."
        )


def _is_list_of_objects(value: object) -> TypeGuard[list[dict[str, object]]]:
    return isinstance(value, list) and all(isinstance(entry, dict) for entry in value)


def plain_name(name: str) -> str:
    """The name of a column without what does not matter: case, spaces, ``_`` and ``-``."""
    return re.sub("[ _-]", "", clean(name)).lower()


def _columns(names: Sequence[str]) -> list[str]:
    """The columns as they are kept: that of the files is ``file``, that of the labels ``label``, in any case."""
    plain = [plain_name(name) for name in names]
    # the ids of shapes beside their features are no files
    known = FILE_COLUMNS[:-1] if any(map(_BIN.fullmatch, names)) else FILE_COLUMNS
    files = next((name for name in known if name in plain), None)
    special = {files: FILE_COLUMN, LABEL_COLUMN: LABEL_COLUMN}
    return [
        special.get(own, "" if NAMELESS.fullmatch(name) else clean(name)) for own, name in zip(plain, names)
    ]


def _check_names(columns: Sequence[str], names: Sequence[str], table: Path, place: str = "") -> None:
    """Raise ``DatabaseError`` where two columns with a name are one."""
    twice = next((column for column, count in Counter(columns).items() if column and count > 1), None)
    if twice is not None:
        where = f", {place}," if place else ""
        written = ", ".join(f"'{clean(name)}'" for column, name in zip(columns, names) if column == twice)
        raise DatabaseError(
            f"The table {table}{where} has two columns named '{twice}' (written {written}); rename one."
        )


def _as_text(value: object) -> str:
    if value is None:
        return ""
    return encodable(value) if isinstance(value, str) else json.dumps(value)


def _tidy(column: str, cell: str) -> str:
    """A cell as it is kept: empty where it says that there is no value."""
    if column == FILE_COLUMN:
        return cell.strip()
    text = clean(cell)
    return "" if text in NO_VALUES else text


def _row(place: str, cells: Mapping[str, str]) -> Row:
    """A row without the columns that have no name, as spreadsheets leave them behind."""
    kept = {column: cell for column, cell in cells.items() if column and column != FILE_COLUMN}
    return Row(place, cells.get(FILE_COLUMN, ""), kept)
