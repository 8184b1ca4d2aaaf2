"""What a layout is: one way in which people arrange a shape database on disk."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import ClassVar

from shapeviz_report.types import Database, ShapeEntry


class Layout(ABC):
    """A reader of one arrangement of files.

    ``name`` is what ``--layout`` takes; ``description`` one line for the help text and for error messages.
    A layout never opens a mesh: reading a database stays fast with 100,000 files.
    """

    name: ClassVar[str]
    description: ClassVar[str]

    @abstractmethod
    def recognises(self, path: Path) -> bool:
        """Whether this existing file or folder is arranged so. Never raises for what is in it."""

    @abstractmethod
    def read(self, path: Path) -> Database:
        """Read it.

        Raises
        ------
        DatabaseError
            If it is not arranged so, or cannot be read as a whole. What is wrong with one file is a
            ``Failure`` of the database instead.
        """


def database_name(root: Path) -> str:
    """The title of a database that was given none: the name of its folder."""
    return root.resolve().name or "shapes"


def shape_ids(relative_paths: Sequence[str]) -> list[str]:
    """One unique id a path, in the order of the paths.

    The id is the path without its suffix. It keeps the suffix where the shorter form would name two files, or
    is the whole name of another one. Paths that are equal as text, as names that are not UTF-8 can become,
    are numbered.

    Parameters
    ----------
    relative_paths : sequence of str
        With ``/`` between folders.
    """
    stems = [os.path.splitext(path)[0] for path in relative_paths]
    times = Counter(stems)
    times.update(set(relative_paths))
    taken: Counter[str] = Counter()
    ids = []
    for stem, path in zip(stems, relative_paths, strict=True):
        candidate = stem if times[stem] == 1 else path
        taken[candidate] += 1
        ids.append(candidate if taken[candidate] == 1 else f"{candidate} ({taken[candidate]})")
    return ids


def sorted_shapes(shapes: Iterable[ShapeEntry]) -> tuple[ShapeEntry, ...]:
    """Shapes in the order that a database has them in."""
    return tuple(sorted(shapes, key=lambda shape: shape.id))
