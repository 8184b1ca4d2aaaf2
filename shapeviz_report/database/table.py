"""A table that lists the meshes, their labels and whatever else is known of them."""

from __future__ import annotations

import csv
import io
import json
import os
import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import zip_longest
from pathlib import Path

from shapeviz_report.database.base import Layout, database_name, shape_ids, shape_names, sorted_shapes
from shapeviz_report.database.formats import MESH_FORMATS, is_read, suffix_of, why_not_read
from shapeviz_report.database.text import clean, decode, encodable, readable
from shapeviz_report.errors import DatabaseError
from shapeviz_report.types import Database, Failure, ShapeEntry

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
NO_VALUES = frozenset({"nan", "null", "none", "n/a", "#n/a", "<na>"})
"""Cells (in lower case) with which programs write that there is no value."""
DELIMITERS = (",", ";", "\t", "|")
TABLE_SUFFIXES = (".csv", ".tsv", ".json")
MOST_CLASSES = 100
FEWEST_SHAPES_A_CLASS = 3

_EXCEL_DELIMITER = re.compile(r'"?sep=(.)"?')
_csv_reader = partial(csv.reader, skipinitialspace=True)


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
class Listed:
    """A file that a table lists, and the rows that do."""

    path: Path
    rows: list[Row]


class Table(Layout):
    """A CSV or JSON table with a column ``file``, a column ``label``, and any further columns as metadata.

    Cells of CSV may be separated by commas, semicolons or tabs; JSON is a list of objects. Paths are relative
    to the table's folder. A metadata column is a further labeling where it plainly names groups: it has at
    least 2 and at most ``MOST_CLASSES`` different values, and on average ``FEWEST_SHAPES_A_CLASS`` shapes or
    more to a value.
    """

    name = "table"
    description = (
        "a CSV or JSON table with the columns file, label and any metadata, or the folder it lies in"
    )

    def recognises(self, path: Path) -> bool:
        if path.is_dir():
            return bool(_tables_in(path))
        return suffix_of(path.name) in TABLE_SUFFIXES

    def read(self, path: Path) -> Database:
        table = _the_table(path)
        rows, warnings = _read_rows(table)
        if not rows:
            raise DatabaseError(f"The table {table} names columns, but lists no files.")
        root = table.parent
        listed, failures = _sort_out(rows, table)
        if repeated := sorted(relative for relative, file in listed.items() if len(file.rows) > 1):
            warnings.append(
                f"{len(repeated)} files stand in {table.name} more than once with the same values and are "
                f"taken once: {', '.join(repeated[:5])}{', ...' if len(repeated) > 5 else ''}."
            )
        relatives = sorted(listed)
        columns = dict.fromkeys(column for relative in relatives for column in listed[relative].rows[0].cells)
        ids = shape_ids(relatives)
        cells = [listed[relative].rows[0].filled for relative in relatives]
        labels = [cell.pop(LABEL_COLUMN, "") for cell in cells]
        groups = [column for column in columns if _names_groups([cell.get(column) for cell in cells])]
        if groups and not any(labels):
            warnings.append(
                f"{table.name} has no labels; the shapes are grouped by its column '{groups[0]}'."
            )
        return Database(
            name=database_name(root),
            root=root,
            layout=self.name,
            shapes=sorted_shapes(
                ShapeEntry(
                    id,
                    listed[relative].path,
                    name,
                    labels={
                        **({LABEL_COLUMN: label} if label else {}),
                        **{column: cell[column] for column in groups if column in cell},
                    },
                    metadata=cell,
                )
                for id, name, relative, cell, label in zip(ids, shape_names(ids), relatives, cells, labels)
            ),
            labelings=(*((LABEL_COLUMN,) if any(labels) else ()), *groups),
            failures=failures,
            warnings=tuple(warnings),
        )


def _the_table(path: Path) -> Path:
    if not path.is_dir():
        return path
    tables = _tables_in(path)
    if len(tables) == 1:
        return tables[0]
    if tables:
        names = ", ".join(table.name for table in tables)
        raise DatabaseError(
            f"{path} holds several tables ({names}). Name the one to read instead of the folder."
        )
    raise DatabaseError(
        f"{path} holds no table: no {', '.join(TABLE_SUFFIXES)} file in it has a column '{FILE_COLUMN}'."
    )


def _tables_in(folder: Path) -> list[Path]:
    """The tables that lie in a folder, without those that cannot be read or list no mesh that is there."""
    return [table for table in _candidates(folder) if _why_no_table(table) is None]


def passed_over(folder: Path) -> list[str]:
    """What to tell of the CSV and JSON files in a folder that no layout has read; companions of meshes apart."""
    try:
        stems = {os.path.splitext(name)[0] for name in os.listdir(folder) if is_read(name)}
    except OSError:
        return []
    return [
        f"{table.name} lies in the folder and is not used. "
        + (_why_no_table(table) or "Name it instead of the folder to read it.")
        for table in _candidates(folder)
        if table.stem not in stems
    ]


def _candidates(folder: Path) -> list[Path]:
    try:
        names = sorted(
            entry.name
            for entry in os.scandir(folder)
            if suffix_of(entry.name) in TABLE_SUFFIXES and not entry.name.startswith(".") and entry.is_file()
        )
    except OSError:
        return []
    return [folder / name for name in names]


def _why_no_table(table: Path) -> str | None:
    """Why a file is not the table of its folder; None if it is.

    A column ``file`` makes it one. Other names say so only if meshes stand in the column: many tables of other things
    have a ``model`` or an ``id``.
    """
    try:
        text, _ = _read_text(table)
        is_json = suffix_of(table.name) == ".json"
        rows = _json_rows(text, table) if is_json else None
        if rows is None:
            delimiter, _, above = _csv_columns(text, table)
            header = next(_csv_reader(text.splitlines()[above:], delimiter=delimiter), [])
            plain = FILE_COLUMN in [clean(cell).lower() for cell in header]
        else:
            plain = any(key.lower() == FILE_COLUMN for entry in json.loads(text) for key in entry)
        if plain or any(
            os.path.isfile(path) and is_read(path.name)
            for row in rows or _csv_rows(text, table)
            if row.file and (path := _mesh_path(table.parent, row.file))
        ):
            return None
    except DatabaseError as error:
        return str(error)
    return "No mesh that its rows name is there."


def _read_text(table: Path) -> tuple[str, bool]:
    try:
        return decode(table.read_bytes())
    except OSError as error:
        raise DatabaseError(f"The table {table} cannot be read: {error.strerror}.") from error


def _read_rows(table: Path) -> tuple[list[Row], list[str]]:
    """The rows of a table, and warnings about it."""
    text, certain = _read_text(table)
    warnings = [] if certain else [f"{table.name} is not UTF-8; it was read as Windows-1252."]
    rows = _json_rows(text, table) if suffix_of(table.name) == ".json" else _csv_rows(text, table)
    return rows, warnings


def _csv_columns(text: str, table: Path) -> tuple[str, list[str], int]:
    """The delimiter, which is the one that makes a column of files appear, the columns, and the line below them."""
    first, _, rest = text.partition("\n")
    told = _EXCEL_DELIMITER.fullmatch(first.strip())
    for delimiter in (told[1],) if told else DELIMITERS:
        try:
            header = next(
                _csv_reader(io.StringIO(rest if told else text, newline=""), delimiter=delimiter), []
            )
        except csv.Error as error:
            raise DatabaseError(f"The table {table} is not CSV: {error}.") from error
        columns = _columns(header)
        if FILE_COLUMN in columns:
            return delimiter, columns, int(told is not None)
    raise DatabaseError(
        f"The table {table} has no column '{FILE_COLUMN}'. Its first line must name the columns, "
        f"for instance: file,label."
    )


def _csv_rows(text: str, table: Path) -> list[Row]:
    delimiter, columns, above = _csv_columns(text, table)
    if twice := sorted({column for column in columns if column and columns.count(column) > 1}):
        raise DatabaseError(f"The table {table} has two columns named '{twice[0]}'; rename one.")
    reader = _csv_reader(io.StringIO(text, newline=""), delimiter=delimiter)
    for _ in range(above + 1):
        next(reader)
    rows = []
    try:
        for cells in reader:
            if any(cell.strip() for cell in cells[len(columns) :]):
                raise DatabaseError(
                    f"{table}, line {reader.line_num}: there are more cells than the {len(columns)} columns. "
                    f"A cell that contains '{delimiter}' belongs in double quotes."
                )
            if any(cell.strip() for cell in cells):
                rows.append(_row(f"line {reader.line_num}", dict(zip_longest(columns, cells, fillvalue=""))))
    except csv.Error as error:
        raise DatabaseError(f"{table}, line {reader.line_num}: this is not CSV: {error}.") from error
    return rows


def _json_rows(text: str, table: Path) -> list[Row]:
    try:
        entries = json.loads(text, parse_constant=lambda _: None)
    except (ValueError, RecursionError) as error:
        raise DatabaseError(f"The table {table} is not JSON: {error}.") from error
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise DatabaseError(
            f'The table {table} is not a list of objects: [{{"file": "a.off", "label": "cup"}}, ...].'
        )
    keys = list(dict.fromkeys(key for entry in entries for key in entry))
    names = dict(zip(keys, _columns(keys)))
    rows = [
        _row(f"entry {number}", {names[key]: _as_text(value) for key, value in entry.items()})
        for number, entry in enumerate(entries, start=1)
    ]
    if not any(row.file for row in rows):
        raise DatabaseError(f"The table {table} has no key '{FILE_COLUMN}' in its objects.")
    return rows


def _columns(names: Sequence[str]) -> list[str]:
    """The columns as they are kept: that of the files is ``file``, that of the labels ``label``, in any case."""
    columns = [clean(name) for name in names]
    plain = [re.sub("[ _-]", "", column).lower() for column in columns]
    files = next((plain.index(name) for name in FILE_COLUMNS if name in plain), None)
    return [
        FILE_COLUMN
        if place == files or column.lower() == FILE_COLUMN
        else LABEL_COLUMN
        if column.lower() == LABEL_COLUMN
        else column
        for place, column in enumerate(columns)
    ]


def _as_text(value: object) -> str:
    if value is None:
        return ""
    return encodable(value) if isinstance(value, str) else json.dumps(value)


def _row(place: str, cells: Mapping[str, str]) -> Row:
    """A row without the columns that have no name, as spreadsheets leave them behind."""
    kept = {
        column: "" if clean(cell).lower() in NO_VALUES else clean(cell)
        for column, cell in cells.items()
        if column and column != FILE_COLUMN
    }
    return Row(place, cells.get(FILE_COLUMN, "").strip(), kept)


def _sort_out(rows: Sequence[Row], table: Path) -> tuple[dict[str, Listed], tuple[Failure, ...]]:
    """What can be taken, by its path below the table's folder, and the failures."""
    root = table.parent
    by_file: dict[str, Listed] = {}
    failures = []
    for row in rows:
        if row.file:
            path = _mesh_path(root, row.file)
            relative = readable(os.path.relpath(path, root)).replace(os.sep, "/")
            by_file.setdefault(relative, Listed(path, [])).rows.append(row)
        else:
            failures.append(
                Failure(f"{table.name}, {row.place}", "read", f"its column '{FILE_COLUMN}' is empty")
            )
    taken = {}
    for relative, listed in by_file.items():
        places = ", ".join(row.place for row in listed.rows)
        # Unlike Path.is_file, this bears names that are longer than a file's can be.
        if not os.path.isfile(listed.path):
            kind = "a folder, not a mesh" if os.path.isdir(listed.path) else "not there"
            reason = f"{table.name} lists it ({places}), but it is {kind}"
        elif not is_read(listed.path.name):
            reason = why_not_read(listed.path.name)
        elif any(row.filled != listed.rows[0].filled for row in listed.rows):
            times = len(listed.rows)
            reason = f"{table.name} lists it {times} times with different values ({places}); keep one"
        else:
            taken[relative] = listed
            continue
        failures.append(Failure(relative, "read", reason))
    return taken, tuple(sorted(failures, key=lambda failure: (failure.path, failure.reason)))


def _mesh_path(root: Path, file: str) -> Path:
    """Where a listed file is.

    A path that does not exist as written is also tried with Windows' separators turned, and in the other
    Unicode normal forms, which tables and file systems exchange behind their users' backs; each also with the
    suffixes of meshes.
    """
    spellings = (file, file.replace("\\", "/"))
    forms = (unicodedata.normalize(form, spelling) for spelling in spellings for form in ("NFC", "NFD"))
    for candidate in (*spellings, *forms):
        path = os.path.normpath(os.path.join(root, candidate))
        for suffix in ("", *MESH_FORMATS):
            if os.path.isfile(path + suffix):
                return Path(path + suffix)
        if os.path.lexists(path):
            return Path(path)
    return Path(os.path.normpath(os.path.join(root, file)))


def _names_groups(values: Sequence[str | None]) -> bool:
    present = [value for value in values if value]
    classes = len(set(present))
    return 2 <= classes <= MOST_CLASSES and len(present) >= FEWEST_SHAPES_A_CLASS * classes
