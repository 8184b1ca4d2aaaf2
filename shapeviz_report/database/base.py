"""What a layout is: one way in which people arrange a shape database on disk."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import ClassVar

from shapeviz_report.database.formats import split_name
from shapeviz_report.order import natural
from shapeviz_report.types import Database, ShapeEntry


class Layout(ABC):
    """A reader of one arrangement of files.

    ``name`` is what ``--layout`` takes; ``description`` one line for the help text and for error messages.
    A layout never opens a mesh: reading a database stays fast with 100,000 files.
    """

    name: ClassVar[str]
    description: ClassVar[str]

    @abstractmethod
    def recognises(self, path: Path, outside: bool) -> bool:
        """Whether this existing file or folder is arranged so. Never raises for what is in it."""

    @abstractmethod
    def read(self, path: Path, outside: bool) -> Database:
        """Read it, with what links in it lead to ``outside`` of its folder or without.

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

    The id is the path without its suffix, ``.off`` or ``.off.gz``. It keeps the suffix where the shorter form would
    name two files, or is the whole name of another one. Paths that are equal as text, as names that are not UTF-8 can
    become, are numbered.

    Parameters
    ----------
    relative_paths : sequence of str
        With ``/`` between folders.
    """
    stems = [split_name(path)[0] for path in relative_paths]
    times = Counter(stems)
    times.update(set(relative_paths))
    taken: Counter[str] = Counter()
    ids = []
    for stem, path in zip(stems, relative_paths, strict=True):
        candidate = stem if times[stem] == 1 else path
        taken[candidate] += 1
        ids.append(candidate if taken[candidate] == 1 else f"{candidate} ({taken[candidate]})")
    return ids


def shape_names(ids: Sequence[str]) -> list[str]:
    """A name a shape that tells it from all others, and is no longer than that needs.

    The name is the last part of the id, the file's name. Shapes that share theirs have instead the last folders,
    and the file's name, as many as are needed. What tells none of those apart is left out: the file's name, where
    most of them lie alone in a folder, and folders that most of them share at the same depth.
    ``chair/1a04/models/model`` is ``1a04`` where every shape is called ``models/model`` in a folder of its own.

    Parameters
    ----------
    ids : sequence of str
        As :func:`shape_ids` returns them: no two are equal.
    """
    paths = [tuple(id.split("/")[::-1]) for id in ids]
    groups: dict[str, list[tuple[str, ...]]] = {}
    for path in paths:
        groups.setdefault(path[0], []).append(path)
    held = Counter(path[1:] for path in paths)
    kept: dict[tuple[str, ...], tuple[str, ...]] = {}
    for group in groups.values():
        if len(group) == 1:
            kept[group[0]] = group[0][:1]
        else:
            alone = sum(held[path[1:]] == 1 for path in group)
            kept |= _telling_parts(group, [0] if 2 * alone > len(group) else [])
    endings = Counter(name for parts in kept.values() for name in endings_of(parts))
    whole = set(ids)
    return [
        next(
            (
                name
                for name in endings_of(kept[path])
                if endings[name] == 1 and (name == id or name not in whole)
            ),
            id,
        )
        for id, path in zip(ids, paths, strict=True)
    ]


def display_names(names: Sequence[str], labels: Sequence[str | None]) -> list[str]:
    """What people call shapes: class and name, where a name alone is a mere number or begins with the class's folder.

    ``61`` and ``chair/03`` become ``airplane 61`` and ``chair 03``. A name stays where that would be another's.

    Parameters
    ----------
    names : sequence of str
        As :func:`shape_names` returns them: no two are equal.
    labels : sequence of str or None
        The class of each shape.
    """
    called = [_with_class(name, label) for name, label in zip(names, labels, strict=True)]
    times = Counter(called)
    times.update(name for name, own in zip(names, called) if name != own)
    return [own if times[own] == 1 else name for name, own in zip(names, called)]


def _with_class(name: str, label: str | None) -> str:
    if label is None or not label.strip():
        return name
    folder, slash, rest = name.partition("/")
    if slash and folder == label:
        return f"{label} {rest}"
    return f"{label} {name}" if _MERE_NUMBER.fullmatch(name) else name


_MERE_NUMBER = re.compile(r"[^\W\d_]?[\W\d_]*\d[\W\d_]*")
"""Digits, with at most one letter before them, as in ``m1204``."""


def _telling_parts(
    group: Sequence[tuple[str, ...]], left_out: list[int]
) -> dict[tuple[str, ...], tuple[str, ...]]:
    """What is kept of paths, given from their ends: all but the depths to leave out and those that tell none apart."""

    def without(depths: Sequence[int]) -> list[tuple[str, ...]]:
        return [tuple(part for depth, part in enumerate(path) if depth not in depths) for path in group]

    for depth in range(1, max(map(len, group))):
        _, times = Counter(path[depth] for path in group if depth < len(path)).most_common(1)[0]
        if 2 * times > len(group) and len(set(without([*left_out, depth]))) == len(group):
            left_out = [*left_out, depth]
    return dict(zip(group, without(left_out)))


def endings_of(parts: Sequence[str]) -> list[str]:
    """The endings of a path whose parts are given from its end, from the shortest on."""
    return ["/".join(parts[:end][::-1]) for end in range(1, len(parts) + 1)]


def sorted_shapes(shapes: Iterable[ShapeEntry]) -> tuple[ShapeEntry, ...]:
    """Shapes in the order that a database has them in: natural, by id."""
    return tuple(sorted(shapes, key=lambda shape: natural(shape.id)))
