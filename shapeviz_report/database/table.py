"""A table that lists the meshes, their labels and whatever else is known of them."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from shapeviz_report.arrow import frame_table, require_pyarrow, table_texts
from shapeviz_report.database.base import Layout, database_name, shape_ids, shape_names, sorted_shapes
from shapeviz_report.database.finder import Finder, spellings
from shapeviz_report.database.folder import leads_outside, scan_folder
from shapeviz_report.database.formats import MESH_SUFFIXES, is_read, split_name, suffix_of, why_not_read
from shapeviz_report.database.rows import (
    CLASS_COLUMNS,
    FILE_COLUMN,
    LABEL_COLUMN,
    TABLE_SUFFIXES,
    Content,
    OtherContentError,
    Row,
    check_cells,
    column_rows,
    plain_name,
    read_rows,
)
from shapeviz_report.database.text import readable
from shapeviz_report.errors import DatabaseError
from shapeviz_report.types import Database, Failure, ShapeEntry

MOST_CLASSES = 100
FEWEST_SHAPES_A_CLASS = 3

_MESH_NAME = re.compile(
    rf"[^\"\n,;|\t]{{1,1000}}({'|'.join(map(re.escape, MESH_SUFFIXES))})(?![\w.])", re.IGNORECASE
)
"""What may be the name of a mesh in a text of any kind."""


@dataclass(frozen=True)
class Listed:
    """A file that a table lists, and the rows that do."""

    path: Path
    rows: list[Row]


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
        check_cells(told, found.num_rows * found.num_columns)
        content = column_rows(table_texts(found), told)
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
        database = self.read_content(read_rows(table), table, outside)
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
            files = "1 file stands" if len(repeated) == 1 else f"{len(repeated)} files stand"
            verb = "is" if len(repeated) == 1 else "are"
            warnings.append(
                f"{files} in {table.name} more than once with the same values and {verb} taken once: "
                f"{', '.join(repeated[:5])}{', ...' if len(repeated) > 5 else ''}."
            )
        relatives = sorted(listed)
        columns = dict.fromkeys(column for relative in relatives for column in listed[relative].rows[0].cells)
        ids = shape_ids(relatives)
        cells = [listed[relative].rows[0].filled for relative in relatives]
        labels = [cell.pop(LABEL_COLUMN, "") for cell in cells]
        groups = [column for column in columns if _names_groups(column, [cell.get(column) for cell in cells])]
        groups.sort(key=lambda column: plain_name(column) not in CLASS_COLUMNS)
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
        content = read_rows(table)
    except OtherContentError as error:
        named = (found[0].strip() for text in error.texts for found in _MESH_NAME.finditer(text))
        return Verdict(False, False, str(error) if _find_mesh(table, named) else "")
    except DatabaseError as error:
        return Verdict(False, False, str(error))
    if _find_mesh(table, (row.file for row in content.rows if row.file)):
        return Verdict(True, content.plain, "Name it instead of the folder to read it.")
    classes = any(
        plain_name(column) in (LABEL_COLUMN, *CLASS_COLUMNS) for row in content.rows for column in row.cells
    )
    tells = content.plain or classes
    return Verdict(False, content.plain, "No mesh that its rows name is there." if tells else "")


def _find_mesh(table: Path, names: Iterable[str]) -> bool:
    """Whether one of the files that a table names is a mesh that is there."""
    finder = Finder(table.parent, suffixes=MESH_SUFFIXES)
    found = map(finder.find, names)
    return any(path is not None and is_read(path.name) and path.is_file() for path in found)


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
    if plain_name(column) in CLASS_COLUMNS:
        return classes > 0
    return 2 <= classes <= MOST_CLASSES and len(present) >= FEWEST_SHAPES_A_CLASS * classes
