"""Shapes of a database that are the same shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from shapeviz_report.types.arrays import FloatArray, IntArray

IDENTICAL_FILE = "identical file"
IDENTICAL_GEOMETRY = "identical geometry"
SAME_SURFACE = "same surface"


@dataclass(frozen=True)
class Match:
    """How well one surface lies on another, after the best motion, scaling and reflection.

    Attributes
    ----------
    kind : str
        ``IDENTICAL_FILE``: the same bytes. ``IDENTICAL_GEOMETRY``: the same triangles, up to rounding, in any order.
        ``SAME_SURFACE``: other triangles on the same surface.
    distance, largest : float
        The root mean square and the maximum of the distances from points of each to the other, as fractions of the
        size of the shape (the diagonal of its bounding box).
    scale : float
        How many times as large the second is.
    mirrored : bool
        Whether only the mirror image of one lies on the other.
    """

    kind: str
    distance: float = 0.0
    largest: float = 0.0
    scale: float = 1.0
    mirrored: bool = False

    @property
    def words(self) -> str:
        """The evidence as a reader finds it; begins with the kind."""
        said = [self.kind]
        if self.kind == SAME_SURFACE:
            said[0] += f" within {100 * self.distance:.2g} % of its size, {100 * self.largest:.2g} % at most"
        if self.mirrored:
            said.append("mirrored")
        if abs(self.scale - 1) > 1e-3:
            said.append(f"scaled by {self.scale:.4g}")
        return ", ".join(said)


@dataclass(frozen=True)
class Copy:
    """Two shapes that are the same shape, and what says so.

    Attributes
    ----------
    first, second : str
        Their ids; ``first`` comes first in the database.
    match : Match
    """

    first: str
    second: str
    match: Match


def copies_of(copies: Sequence[Copy], shape: str) -> list[tuple[str, Match]]:
    """The other shape of each pair that a shape, by id, is in, and how that one lies on it."""
    found = []
    for copy in copies:
        if shape == copy.first:
            found.append((copy.second, copy.match))
        elif shape == copy.second:
            found.append((copy.first, replace(copy.match, scale=1 / copy.match.scale)))
    return found


@dataclass(frozen=True)
class WithoutCopies:
    """Figures of a database in which the first of each group of copies stands for all of it.

    Attributes
    ----------
    copies : int
        Shapes that are left out; at least one.
    nh_s : mapping of str to (float or None)
        Of the same maps, by method, with neighbours among the shapes that are left.
    nh_max : float or None
        What none of these can exceed; the classes are smaller than with copies.
    retrieval : mapping of str to (6,) float64 array
        :data:`shapeviz_report.retrieval.MEASURES` on average over shapes: by ``everything``, and by ``bins`` where some
        were rated. Empty where no class has two shapes left.
    """

    copies: int
    nh_s: Mapping[str, float | None]
    nh_max: float | None
    retrieval: Mapping[str, FloatArray]


def group_copies(copies: Sequence[Copy], ids: Sequence[str]) -> IntArray:
    """The group of copies of each shape: a number (n,) that shapes share exactly if a chain of copies joins them.

    Groups are numbered by their first shape, which stands for them; a shape without a copy is a group of its own.
    """
    place = {shape: row for row, shape in enumerate(ids)}
    pairs = [(place[c.first], place[c.second]) for c in copies if c.first in place and c.second in place]
    joined = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    graph = coo_matrix((np.ones(joined.shape[1], np.int8), (joined[0], joined[1])), (len(ids),) * 2)
    _, group = connected_components(graph, directed=False)
    _, first, of = np.unique(group, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[of].astype(np.int32)


def representatives(groups: IntArray) -> IntArray:
    """The first shape of each group, as rising rows."""
    return np.sort(np.unique(groups, return_index=True)[1])
