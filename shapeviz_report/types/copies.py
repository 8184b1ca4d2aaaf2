"""Shapes of a database that are the same shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from shapeviz_report.types.arrays import FloatArray, IntArray

IDENTICAL_FILE = "identical file"
IDENTICAL_GEOMETRY = "identical geometry"
SAME_SURFACE = "same surface"
NEARLY_SAME_SURFACE = "nearly the same surface"
_KINDS = (IDENTICAL_FILE, IDENTICAL_GEOMETRY, SAME_SURFACE, NEARLY_SAME_SURFACE)


@dataclass(frozen=True)
class Match:
    """How well one surface lies on another, after the best motion, scaling and reflection.

    Attributes
    ----------
    kind : str
        ``IDENTICAL_FILE``: the same bytes. ``IDENTICAL_GEOMETRY``: the same triangles, up to rounding, in any order.
        ``SAME_SURFACE``: other triangles on the same surface. ``NEARLY_SAME_SURFACE``: so many triangles fewer, or
        so much of the surface moved, that the two can be told apart.
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
        said = [self.grade]
        if self.mirrored:
            said.append("mirrored")
        if self.is_scaled:
            said.append(f"scaled by {self.scale:.4g}")
        return ", ".join(said)

    @property
    def grade(self) -> str:
        """How much the two are the same, in words, wherever they lie."""
        if self.kind not in (SAME_SURFACE, NEARLY_SAME_SURFACE):
            return self.kind
        return f"{self.kind}, {_percent(self.distance)} of its size apart ({_percent(self.largest)} at most)"

    @property
    def is_scaled(self) -> bool:
        return abs(self.scale - 1) > 1e-3


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


@dataclass(frozen=True)
class CopyGroup:
    """Shapes that a chain of copies joins.

    Attributes
    ----------
    shapes : tuple of str
        Their ids, in the order of the database; two at least.
    copies : tuple of Copy
        The pairs among them that were laid on each other; not all need have been.
    """

    shapes: tuple[str, ...]
    copies: tuple[Copy, ...]

    @property
    def words(self) -> str:
        """The evidence as a reader finds it: that of the only pair, or the best and the worst of several."""
        if len(self.copies) == 1:
            return self.copies[0].match.words
        matches = sorted(
            (copy.match for copy in self.copies), key=lambda match: (_KINDS.index(match.kind), match.distance)
        )
        best, worst = matches[0].grade, matches[-1].grade
        said = [best if best == worst else f"from {best} to {worst}"]
        if any(match.mirrored for match in matches):
            said.append("some mirrored")
        if any(match.is_scaled for match in matches):
            said.append("of several sizes")
        return ", ".join(said)


def _percent(length: float) -> str:
    """A fraction of the size of a shape; less than coordinates of files are good for is not spelled out."""
    return "<0.001\u00a0%" if length < 1e-5 else f"{100 * length:.2g}\u00a0%"


#: Of each shape, by id, the shapes that were laid on it, with what it is of them.
Beside = Mapping[str, Mapping[str, Match]]


def copies_beside(copies: Sequence[Copy]) -> Beside:
    """Pairs of copies by shape."""
    beside: dict[str, dict[str, Match]] = {}
    for copy in copies:
        beside.setdefault(copy.first, {})[copy.second] = replace(copy.match, scale=1 / copy.match.scale)
        beside.setdefault(copy.second, {})[copy.first] = copy.match
    return beside


def copies_of(beside: Beside, shape: str) -> list[tuple[str, Match | str]]:
    """All shapes of the group of copies that a shape, by id, is in, the nearest in the chain first.

    Returns
    -------
    list of (str, Match or str)
        The other's id and what the shape is of it, such as ten times as large; where the two were not laid on each
        other, the id of the shape through which one is a copy of the other.
    """
    found: dict[str, Match | str] = dict(beside.get(shape, {}))
    waiting = list(found)
    for other in waiting:
        for farther in beside[other]:
            if farther != shape and farther not in found:
                found[farther] = other
                waiting.append(farther)
    return list(found.items())


@dataclass(frozen=True)
class WithoutCopies:
    """Figures of a database in which one of each group of copies stands for all of it.

    Attributes
    ----------
    copies : int
        Shapes that are left out; at least one.
    nh_s : mapping of str to (float or None)
        Of the same maps, by method, with neighbours among the shapes that are left.
    nh_max : float or None
        What none of these can exceed; the classes are smaller than with copies.
    bins : float or None
        NH_s of the map of the automatic selection of bins, in the same way; None where there is none.
    best : float or None
        The same of the subset of features whose map is best with copies.
    retrieval : mapping of str to (6,) float64 array
        :data:`shapeviz_report.retrieval.MEASURES` on average over shapes: by ``everything``, and by ``bins`` where some
        were rated. Empty where no class has two shapes left.
    """

    copies: int
    nh_s: Mapping[str, float | None]
    nh_max: float | None
    bins: float | None
    best: float | None
    retrieval: Mapping[str, FloatArray]


def group_copies(copies: Sequence[Copy], ids: Sequence[str]) -> IntArray:
    """The group of copies of each shape: a number (n,) that shapes share exactly if a chain of copies joins them.

    Groups are numbered by their first shape; a shape without a copy is a group of its own.
    """
    place = {shape: row for row, shape in enumerate(ids)}
    pairs = [(place[c.first], place[c.second]) for c in copies if c.first in place and c.second in place]
    joined = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    graph = coo_matrix((np.ones(joined.shape[1], np.int8), (joined[0], joined[1])), (len(ids),) * 2)
    _, group = connected_components(graph, directed=False)
    _, first, of = np.unique(group, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[of].astype(np.int32)


def list_groups(copies: Sequence[Copy], ids: Sequence[str]) -> list[CopyGroup]:
    """The groups of copies among shapes, by ids, without those of a single shape, by their first shapes."""
    group = dict(zip(ids, group_copies(copies, ids).tolist()))
    shapes: dict[int, list[str]] = {}
    for shape, number in group.items():
        shapes.setdefault(number, []).append(shape)
    pairs: dict[int, list[Copy]] = {}
    for copy in copies:
        if copy.first in group and copy.second in group:
            pairs.setdefault(group[copy.first], []).append(copy)
    return [CopyGroup(tuple(shapes[number]), tuple(pairs[number])) for number in sorted(pairs)]


def representatives(groups: IntArray, labelled: npt.NDArray[np.bool_]) -> IntArray:
    """The shape that stands for each group, the first that has a label, or the first; as rising rows."""
    order = np.argsort(~labelled, kind="stable")
    return np.sort(order[np.unique(groups[order], return_index=True)[1]])


def distinct_rows(groups: IntArray, labelled: npt.NDArray[np.bool_]) -> IntArray | None:
    """The representatives; None where no shape has a copy, and where a single shape would be left."""
    kept = representatives(groups, labelled)
    return kept if 1 < len(kept) < len(groups) else None
