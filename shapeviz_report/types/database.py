"""A shape database as it was read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class ShapeEntry:
    """One shape of a database: where its mesh is and what is known of it.

    Attributes
    ----------
    id : str
        Unique in the database: the path of the file below the database's root, ``/`` between folders,
        without its suffix (with it where two files differ by the suffix alone). Any Unicode text.
    path : Path
        The mesh file.
    name : str
        What people call it; need not be unique.
    labels : mapping of str to str
        Labeling -> class. A labeling that does not name this shape has no entry here.
    metadata : mapping of str to str
        Further columns of a table, as text, in the table's order.
    """

    id: str
    path: Path
    name: str
    labels: Mapping[str, str] = field(default_factory=dict)
    metadata: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Failure:
    """A file that did not make it: which, at which stage, and why, in words for its owner."""

    path: str
    stage: str
    reason: str


@dataclass(frozen=True)
class Database:
    """A shape database as it was read.

    Attributes
    ----------
    name : str
        Title of the database.
    root : Path
        The folder that ``ShapeEntry.id`` and ``Failure.path`` are relative to.
    layout : str
        Name of the reader that recognised it.
    shapes : tuple of ShapeEntry
        Sorted by id.
    labelings : tuple of str
        The labelings there are; the first is the one to use when none is chosen. Empty without labels.
    parents : mapping
        Labeling -> class -> parent class, for labelings with a hierarchy. A top class has no entry.
    failures : tuple of Failure
        Files that belong to the database but cannot be taken: unknown format, listed but missing.
    warnings : tuple of str
        What its owner should know although nothing failed.
    """

    name: str
    root: Path
    layout: str
    shapes: tuple[ShapeEntry, ...]
    labelings: tuple[str, ...] = ()
    parents: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    failures: tuple[Failure, ...] = ()
    warnings: tuple[str, ...] = ()
