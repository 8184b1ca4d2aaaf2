"""Reading a shape database: where its meshes are, and what is known of them. Meshes are not opened here."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator
from dataclasses import replace
from pathlib import Path

from shapeviz_report.database.base import Layout, display_names
from shapeviz_report.database.class_folders import ClassFolders
from shapeviz_report.database.flat import FlatFolder
from shapeviz_report.database.formats import MESH_FORMATS, is_read
from shapeviz_report.database.modelnet import ModelNet
from shapeviz_report.database.princeton import Princeton
from shapeviz_report.database.rows import TABLE_SUFFIXES
from shapeviz_report.database.table import Listing, Table, passed_over
from shapeviz_report.errors import DatabaseError
from shapeviz_report.types import Database

__all__ = ["LAYOUTS", "MESH_FORMATS", "Layout", "Listing", "read_database"]

LAYOUTS: tuple[Layout, ...] = (Princeton(), Table(), ModelNet(), ClassFolders(), FlatFolder())
"""Ours, in the order in which they are tried: the first that recognises a database reads it."""


def read_database(
    source: Path | Listing,
    *,
    layout: str | None = None,
    labeling: str | None = None,
    name: str | None = None,
    outside: bool = True,
    besides: Collection[Path] = (),
) -> Database:
    """Read a shape database.

    Parameters
    ----------
    source : Path or Listing
        A folder, a table, or a Princeton ``.cla`` file; or a data frame.
    layout : str, optional
        Name of one of ours or of a plug-in; by default the first that recognises the path.
    labeling : str, optional
        The labeling to put first, that is to use.
    name : str, optional
        Title of the database; by default the name of its folder.
    outside : bool, optional
        Whether links in the database are followed to folders, tables and classifications that are not in it.
    besides : collection of Path
        Files in the folder that are no tables of shapes, whatever they look like.

    Returns
    -------
    Database
        Not empty: it has shapes, or failures that say why it has none.

    Raises
    ------
    DatabaseError
        If there is nothing to read at the path, or no such layout or labeling.
    """
    path = Path(source)
    if isinstance(source, Listing):
        if layout not in (None, Table.name):
            raise DatabaseError(f"A data frame has the layout '{Table.name}', not '{layout}'.")
        database = Table().read_content(source.content, source.root / source.name, outside)
    elif not os.path.exists(path):
        raise DatabaseError(f"There is no shape database at {path}: no such file or folder.")
    else:
        database = _choose_layout(path, layout, outside, besides).read(path, outside)
        if database.layout != Table.name and path.is_dir():
            database = replace(database, warnings=(*database.warnings, *passed_over(path, outside, besides)))
    if not database.shapes and not database.failures:
        raise DatabaseError(*_nothing_found(path))
    if labeling is not None:
        if labeling not in database.labelings:
            existing = ", ".join(f"'{existing}'" for existing in database.labelings) or "none"
            raise DatabaseError(
                f"The database {path} has no labeling '{labeling}'. Its labelings: {existing}."
            )
        others = tuple(other for other in database.labelings if other != labeling)
        database = replace(database, labelings=(labeling, *others))
    active = database.labelings[0] if database.labelings else None
    called = display_names(
        [shape.name for shape in database.shapes],
        [None if active is None else shape.labels.get(active) for shape in database.shapes],
    )
    shapes = tuple(replace(shape, name=own) for shape, own in zip(database.shapes, called))
    return replace(database, shapes=shapes, name=database.name if name is None else name)


def _choose_layout(path: Path, name: str | None, outside: bool, besides: Collection[Path]) -> Layout:
    layouts = [Table(besides) if isinstance(layout, Table) else layout for layout in _all_layouts()]
    if name is not None:
        for layout in layouts:
            if layout.name == name:
                return layout
        names = ", ".join(f"'{layout.name}'" for layout in layouts)
        raise DatabaseError(f"There is no layout '{name}'. The layouts: {names}.")
    for layout in layouts:
        if layout.recognises(path, outside):
            return layout
    raise DatabaseError(*_nothing_found(path))


def _all_layouts() -> tuple[Layout, ...]:
    # when they are asked for: plug-ins, which bring more, import this package themselves
    from shapeviz_report.database.registry import ALL_LAYOUTS

    return ALL_LAYOUTS


def _nothing_found(path: Path) -> Iterator[str]:
    """The lines of a message."""
    if not path.is_dir() and is_read(path.name):
        yield f"{path} is a mesh, not a database; give the folder that it lies in."
        return
    if not path.is_dir():
        yield f"{path} is neither a folder, nor a table ({', '.join(TABLE_SUFFIXES)}), nor a .cla file."
        return
    yield f"No shapes were found in {path}. Looked for meshes ({', '.join(MESH_FORMATS)}) laid out as one of:"
    yield from (f"  {layout.name}: {layout.description}" for layout in _all_layouts())
