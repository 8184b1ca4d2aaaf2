"""A table that lists the meshes, their labels and whatever else is known of them."""

from __future__ import annotations

import csv
import json
import os
import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import zip_longest
from pathlib import Path
from typing import Any, TypeGuard

from shapeviz_report.arrow import Columns, frame_table, parquet_texts, require_pyarrow, table_texts
from shapeviz_report.cells import part_cells
from shapeviz_report.database.base import Layout, database_name, shape_ids, shape_names, sorted_shapes
from shapeviz_report.database.finder import Finder, spellings
from shapeviz_report.database.folder import leads_outside, scan_folder
from shapeviz_report.database.formats import MESH_SUFFIXES, is_read, split_name, suffix_of, why_not_read
from shapeviz_report.database.text import clean, decode, encodable, readable
from shapeviz_report.errors import ConfigError, DatabaseError
from shapeviz_report.executor import call_apart
from shapeviz_report.files import read_regular
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
MOST_CLASSES = 100
FEWEST_SHAPES_A_CLASS = 3

_SECOND_OBJECT = re.compile(r"\s*\{.*\}[ \t\r]*\n\s*\{")
"""An object that ends on its line and another below, without a comma: JSON lines, whatever the file is called."""
_INDEX = re.compile(r"__index_level_\d+__")
"""What the index of a data frame is called in a table when it has no name: mere numbers of rows."""


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


@dataclass(frozen=True)
class Content:
    """What a table says: its rows, warnings, and whether it plainly is one of meshes, with a column ``file``."""

    rows: list[Row]
    warnings: list[str]
    plain: bool


class Listing:
    """A data frame that lists meshes, in place of the path of a table. Its own path is the database's folder: the
    deepest one that holds all files.

    Parameters
    ----------
    frame : object
        A data frame of pandas, Polars or pyarrow, with the columns of a table; paths start at the current folder.

    Raises
    ------
    TypeError
        It is no data frame.
    ConfigError, DatabaseError
        pyarrow is not installed; the frame cannot be understood.
    """

    name = "the data frame"

    def __init__(self, frame: Any) -> None:
        require_pyarrow("a data frame as a database", "or write it to a CSV table and give its path")
        try:
            found = frame_table(frame)
        except ValueError as error:
            raise DatabaseError(
                f"The data frame cannot be read: {error}. Columns hold text, numbers or dates; paths as text."
            ) from error
        told = Path(f"of {self.name}")  # "The table of the data frame has ..."
        _check_cells(told, found.num_rows * found.num_columns)
        content = _column_rows(table_texts(found), told)
        files = [os.path.abspath(row.file) for row in content.rows if row.file]
        if not files:
            raise DatabaseError("The data frame lists no files.")
        try:
            self.root = Path(os.path.commonpath([os.path.dirname(file) for file in files]))
        except ValueError as error:
            raise DatabaseError(
                "The data frame lists files of several drives; they need a common folder."
            ) from error
        rows = [replace(row, file=os.path.abspath(row.file) if row.file else "") for row in content.rows]
        self.content = replace(content, rows=rows)

    def __fspath__(self) -> str:
        return os.fspath(self.root)


class OtherContentError(DatabaseError):
    """A table has neither a column of files nor one of classes: it is not about shapes at all."""


class Table(Layout):
    """A CSV, JSON or Parquet table with a column ``file``, a column ``label``, and any further columns as metadata.

    Cells of CSV may be separated by commas, semicolons, tabs or ``|``; JSON is a list of objects, alone or under a key
    of an object, or one object a line. Paths are relative to the table's folder. A metadata column is a labeling too
    where it is called so or plainly names groups: it has at least 2 and at most ``MOST_CLASSES`` different values, and
    on average ``FEWEST_SHAPES_A_CLASS`` shapes or more to a value.

    Parameters
    ----------
    besides : collection of Path
        Files that are known to be something else, as features with a row a shape are.
    """

    name = "table"
    description = (
        "a CSV, JSON or Parquet table with the columns file, label and any metadata, or the folder it lies in"
    )

    def __init__(self, besides: Collection[Path] = ()) -> None:
        self.besides = frozenset(os.path.realpath(path) for path in besides)

    def recognises(self, path: Path, outside: bool) -> bool:
        if path.is_dir():
            return bool(_tables_in(path, outside, self.besides))
        return suffix_of(path.name) in TABLE_SUFFIXES

    def read(self, path: Path, outside: bool) -> Database:
        table = _the_table(path, outside, self.besides)
        database = self.read_content(_read(table), table, outside)
        if not path.is_dir():
            return database
        passed = passed_over(path, outside, (*self.besides, table))
        return replace(database, warnings=(*database.warnings, *passed))

    def read_content(self, content: Content, table: Path, outside: bool) -> Database:
        """The database that a table lists, which lies, or would lie, at a path."""
        rows, warnings = content.rows, list(content.warnings)
        if not rows:
            raise DatabaseError(f"The table {table} names columns, but lists no files.")
        root = table.parent
        finder = Finder(root, suffixes=MESH_SUFFIXES)
        listed, failures = _sort_out(rows, table, finder)
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
        groups = [column for column in columns if _names_groups(column, [cell.get(column) for cell in cells])]
        groups.sort(key=lambda column: _plain(column) not in CLASS_COLUMNS)
        if groups and not any(labels):
            warnings.append(
                f"{table.name} has no labels; the shapes are grouped by its column '{groups[0]}'."
            )
        if left_out := _count_unlisted(root, rows, finder, outside):
            files = "1 mesh file" if left_out == 1 else f"{left_out} mesh files"
            verb = "is" if left_out == 1 else "are"
            warnings.append(f"{files} below {root} {verb} not in {table.name} and {verb} left out.")
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


def _the_table(path: Path, outside: bool, besides: Collection[str]) -> Path:
    if not path.is_dir():
        return path
    tables = _tables_in(path, outside, besides)
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


def _tables_in(folder: Path, outside: bool, besides: Collection[str]) -> list[Path]:
    """The tables of a folder: those that list meshes that are there, else those that at least say that they do."""
    judged = {table: _judge(table, outside) for table in _candidates(folder, besides)}
    found = [table for table, verdict in judged.items() if verdict.finds]
    return found or [table for table, verdict in judged.items() if verdict.plain]


def passed_over(folder: Path, outside: bool, used: Collection[str | Path]) -> list[str]:
    """What to tell of the tables in a folder other than those that are ``used``, if they look meant for it.

    That is: they list meshes, have a column of classes, or have a slip, so that nobody can say what they are.
    Companions of meshes and tables of other things are passed over in silence.
    """
    try:
        stems = {split_name(name)[0] for name in os.listdir(folder) if is_read(name)}
    except OSError:
        return []
    judged = {
        table: _judge(table, outside)
        for table in _candidates(folder, {os.path.realpath(path) for path in used})
        if table.stem not in stems
    }
    return [
        f"{table.name} lies in the folder and is not used. {verdict.reason}"
        for table, verdict in judged.items()
        if verdict.reason
    ]


@dataclass(frozen=True)
class Verdict:
    """Whether a file is the table of its folder.

    Attributes
    ----------
    finds : bool
        A mesh that it lists is there.
    plain : bool
        It has a column ``file``.
    reason : str
        What to tell where it is not used; empty for a table of other things.
    """

    finds: bool
    plain: bool
    reason: str


def _judge(table: Path, outside: bool) -> Verdict:
    """Judge a file of unknown content.

    A mesh that is there makes it a table of shapes, or else a column ``file``. Other names of that column do not: many
    tables of other things have a ``model`` or an ``id``.
    """
    if not outside and leads_outside(table, table.parent):
        told = f"It is a link to {os.path.realpath(table)}, outside the folder; copy it, or use --outside."
        return Verdict(False, False, told)
    try:
        content = _read(table)
    except OtherContentError:
        return Verdict(False, False, "")
    except DatabaseError as error:
        return Verdict(False, False, str(error))
    finder = Finder(table.parent, suffixes=MESH_SUFFIXES)
    found = (finder.find(row.file) for row in content.rows if row.file)
    if any(path is not None and is_read(path.name) and path.is_file() for path in found):
        return Verdict(True, content.plain, "Name it instead of the folder to read it.")
    classes = any(
        _plain(column) in (LABEL_COLUMN, *CLASS_COLUMNS) for row in content.rows for column in row.cells
    )
    tells = content.plain or classes
    return Verdict(False, content.plain, "No mesh that its rows name is there." if tells else "")


def _candidates(folder: Path, besides: Collection[str]) -> list[Path]:
    try:
        names = sorted(
            entry.name
            for entry in os.scandir(folder)
            if suffix_of(entry.name) in TABLE_SUFFIXES and not entry.name.startswith(".") and entry.is_file()
        )
    except OSError:
        return []
    return [folder / name for name in names if os.path.realpath(folder / name) not in besides]


def _read_text(table: Path) -> tuple[str, bool]:
    try:
        return decode(read_regular(table, MOST_BYTES))
    except OSError as error:
        raise DatabaseError(f"The table {table} cannot be read: {error.strerror}.") from error


def _read(table: Path) -> Content:
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
    return _column_rows(found, table)


def _column_rows(found: Columns, table: Path) -> Content:
    """The rows of a table of columns with types."""
    texts = {}
    left_out = []
    found = [(name, cells) for name, cells in found if not _INDEX.fullmatch(name)]
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
            f"Columns of {table.name} hold lists or bytes and are left out: {', '.join(map(clean, left_out))}."
        )
    if FILE_COLUMN not in texts:
        raise _no_files(names, " ".join([f"The table {table} has no column '{FILE_COLUMN}'.", *warnings]))
    rows = [
        _row(f"row {number}", dict(zip(texts, cells)))
        for number, cells in enumerate(zip(*texts.values()), 1)
        if any(cells)
    ]
    return Content(rows, warnings, FILE_COLUMN in map(_plain, names))


def _no_files(names: Iterable[str], complaint: str) -> DatabaseError:
    """The error of a table without a column of files."""
    about_shapes = any(_plain(name) in (LABEL_COLUMN, *CLASS_COLUMNS) for name in names)
    return (DatabaseError if about_shapes else OtherContentError)(complaint)


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
        )
    delimiter, header, reader, above = parted
    _check_names(columns, header, table)
    rows: list[Row] = []
    try:
        for cells in reader:
            _check_cells(table, len(rows) * len(columns))
            place = f"line {reader.line_num + above}"
            if any(cell.strip() for cell in cells[len(columns) :]):
                raise DatabaseError(
                    f"{table}, {place}: there are more cells than the {len(columns)} columns. "
                    f"A cell that contains '{delimiter}' belongs in double quotes."
                )
            if any(cell.strip() for cell in cells):
                texts = zip_longest(columns, cells, fillvalue="")
                rows.append(_row(place, {column: _tidy(column, cell) for column, cell in texts}))
    except csv.Error as error:
        line = reader.line_num + above
        raise DatabaseError(f"{table}, line {line}: this is not CSV: {error}.") from error
    return rows, FILE_COLUMN in map(_plain, header)


def _json_rows(text: str, table: Path) -> tuple[list[Row], bool]:
    # by the characters that part values, before any is made
    _check_cells(table, text.count(",") + text.count("[") + text.count("{"))
    entries = _json_entries(text, table)
    keys = list(dict.fromkeys(key for _, entry in entries for key in entry))
    names = dict(zip(keys, _columns(keys)))
    if FILE_COLUMN not in names.values():
        raise _no_files(keys, f"The table {table} has no key '{FILE_COLUMN}' in its objects.")
    rows = []
    for place, entry in entries:
        _check_names([names[key] for key in entry], list(entry), table, place)
        cells = {names[key]: _as_text(value) for key, value in entry.items()}
        if any(len(cell) > MOST_LETTERS for cell in cells.values()):
            raise DatabaseError(f"{table}, {place}: a value is longer than {MOST_LETTERS:,} letters.")
        rows.append(_row(place, {column: _tidy(column, cell) for column, cell in cells.items()}))
    return rows, FILE_COLUMN in map(_plain, keys)


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
            f'The table {table} is not a list of objects: [{{"file": "a.off", "label": "cup"}}, ...].'
        )
    return list(zip(places, whole, strict=True))


def _check_cells(table: Path, count: int) -> None:
    """Refuse a table of too many cells. Raises ``DatabaseError``."""
    if count > MOST_CELLS:
        raise DatabaseError(
            f"The table {table} has more than {MOST_CELLS:,} cells; leave out columns that say nothing of the shapes."
        )


def _is_list_of_objects(value: object) -> TypeGuard[list[dict[str, object]]]:
    return isinstance(value, list) and all(isinstance(entry, dict) for entry in value)


def _plain(name: str) -> str:
    """The name of a column without what does not matter: case, spaces, ``_`` and ``-``."""
    return re.sub("[ _-]", "", clean(name)).lower()


def _columns(names: Sequence[str]) -> list[str]:
    """The columns as they are kept: that of the files is ``file``, that of the labels ``label``, in any case."""
    plain = [_plain(name) for name in names]
    # the ids of shapes beside their features are no files
    known = FILE_COLUMNS[:-1] if any(map(_BIN.fullmatch, names)) else FILE_COLUMNS
    files = next((name for name in known if name in plain), None)
    return [
        FILE_COLUMN if own == files else LABEL_COLUMN if own == LABEL_COLUMN else clean(name)
        for own, name in zip(plain, names)
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


def _sort_out(
    rows: Sequence[Row], table: Path, finder: Finder
) -> tuple[dict[str, Listed], tuple[Failure, ...]]:
    """What can be taken, by its path below the table's folder, and the failures."""
    root = table.parent
    by_file: dict[str, Listed] = {}
    failures = []
    on_another_machine = cache(lambda file: not spellings(file))

    @cache
    def locate(file: str) -> tuple[str, Path]:
        path = finder.find(file) or Path(os.path.normpath(os.path.join(root, file)))
        return readable(_from(root, path)), path

    for row in rows:
        if row.file and on_another_machine(row.file):
            reason = (
                f"{table.name} lists it ({row.place}), but it is on another machine; copy it into the folder"
            )
            failures.append(Failure(readable(row.file), "read", reason))
        elif row.file:
            relative, path = locate(row.file)
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


def _from(root: Path, path: Path) -> str:
    """A path as seen from a folder, ``/`` between; one of another drive as it is."""
    try:
        return Path(os.path.relpath(path, root)).as_posix()
    except ValueError:
        return path.as_posix()


def _count_unlisted(root: Path, rows: Sequence[Row], finder: Finder, outside: bool) -> int:
    """How many meshes below the table's folder none of its rows names; 0 for a folder that cannot be looked into."""
    files = {row.file for row in rows if row.file}
    named = {os.path.realpath(path) for file in files if (path := finder.find(file))}
    try:
        return sum(os.path.realpath(file.location) not in named for file in scan_folder(root, outside).files)
    except DatabaseError:
        return 0


def _names_groups(column: str, values: Sequence[str | None]) -> bool:
    present = [value for value in values if value]
    classes = len(set(present))
    if _plain(column) in CLASS_COLUMNS:
        return classes > 0
    return 2 <= classes <= MOST_CLASSES and len(present) >= FEWEST_SHAPES_A_CLASS * classes
