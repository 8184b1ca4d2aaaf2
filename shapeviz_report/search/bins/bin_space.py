"""What is searched: the bins that differ between shapes, on a grid on which squared distances are exact sums.

Few bins make many equal distances, and rounding must not decide between them: whoever came first in the folder would,
and folders are sorted by class. On the grid distances are whole multiples of one number, below 2^53 times it, so that
equal ones are equal to the bit, whatever bins were added and removed before.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import sha256

import numpy as np
import numpy.typing as npt
from threadpoolctl import threadpool_limits

from shapeviz_report.bins import scale_bins
from shapeviz_report.order import classes_of
from shapeviz_report.presets import Preset
from shapeviz_report.projections import MAIN_PROJECTION, arrange, canonical_order
from shapeviz_report.quality import kth_smallest, neighbour_weights, neighbourhood_hits
from shapeviz_report.search.bins.kernels.neighbour_hits import hits_with_each
from shapeviz_report.search.space import stratified_sample
from shapeviz_report.types import FeatureTable, FloatArray, IntArray

SAMPLE_LIMIT = 1000
"""Most shapes that choose bins for all classes; of larger databases, a stratified sample. Time grows as its square."""

SAMPLE_LIMIT_OF_CLASS = 500
"""Most shapes among which bins are sought for one class, a search for each class."""

GRID_BITS = 20
"""Values are rounded to this many binary digits of the largest one. Squares of differences then take 42, and sums of
up to 1000 bins fit the 53 of double precision."""

Codes = npt.NDArray[np.int64]


@dataclass(frozen=True)
class BinSpace:
    """The input of a search for bins.

    Attributes
    ----------
    names : (b,) tuple of str
        The bins that are not the same for all shapes; of several with the same values, the first.
    rows : (m,) int32 array
        The shapes that take part, as rows of the feature table, in an order that their values alone decide.
    shape_count : int
        Of the table.
    columns : (b, m) float64 array
        Each bin as maps of chosen bins compare it, on the grid.
    """

    names: tuple[str, ...]
    rows: IntArray
    shape_count: int
    columns: FloatArray

    @cached_property
    def content(self) -> str:
        """A name for the values."""
        return sha256(self.columns.tobytes()).hexdigest()

    def squared(self, bins: Sequence[int]) -> FloatArray:
        """Squared distances (m, m) by some bins; exact."""
        total = np.zeros((len(self.rows),) * 2)
        for b in bins:
            total += self.squared_by(b)
        return total

    def squared_by(self, b: int) -> FloatArray:
        """Squared distances (m, m) by one bin; exact."""
        return np.square(self.columns[b][:, None] - self.columns[b])

    def keep(self, shapes: npt.NDArray[np.intp]) -> BinSpace:
        """The same bins for some of the shapes only, given by their places in ``rows``."""
        chosen = np.sort(shapes)
        return replace(self, rows=self.rows[chosen], columns=np.ascontiguousarray(self.columns[:, chosen]))

    def named(self, bins: Collection[int]) -> tuple[str, ...]:
        """The names of some bins, in the order of the columns."""
        return tuple(self.names[b] for b in sorted(bins))


def make_bin_space(
    table: FeatureTable,
    preset: Preset,
    labels: Sequence[str | None],
    *,
    seed: int = 0,
    limit: int = SAMPLE_LIMIT,
) -> BinSpace:
    """Prepare a search.

    Parameters
    ----------
    table : FeatureTable
        At least one row.
    preset : Preset
        How bins are compared (:func:`shapeviz_report.bins.scale_bins`): each divided by its standard deviation over
        all shapes of the table, or plain.
    labels : n labels
        Decide the sample, each class in proportion; shapes without a label count as a class.
    seed : int
        Of the sample.
    limit : int
        Most shapes to take.
    """
    scaled = scale_bins(table, preset, table.columns)
    order = canonical_order(scaled)
    if len(order) > limit:
        order = order[stratified_sample([labels[i] for i in order], limit, seed)]
    columns = scaled[order].T
    step = 2.0 ** (np.ceil(np.log2(max(np.abs(columns).max(initial=0.0), 1e-300))) - GRID_BITS)
    columns = np.round(columns / step) * step
    varied = np.flatnonzero((columns != columns[:, :1]).any(axis=1))
    _, first = np.unique(columns[varied], axis=0, return_index=True)
    chosen = varied[np.sort(first)]
    return BinSpace(
        names=tuple(table.columns[i] for i in chosen),
        rows=order.astype(np.int32),
        shape_count=len(scaled),
        columns=np.ascontiguousarray(columns[chosen]),
    )


def encode(space: BinSpace, labels: Sequence[str | None]) -> tuple[tuple[str, ...], Codes]:
    """The classes in natural order, and the class of each shape of a space as a number, -1 without a label.

    Parameters
    ----------
    space : BinSpace
    labels : labels of all shapes of the table
    """
    own = [labels[row] for row in space.rows]
    classes = classes_of(own)
    numbers = {label: number for number, label in enumerate(classes)}
    return classes, np.array([-1 if label is None else numbers[label] for label in own], dtype=np.int64)


def places_of(codes: Codes, k: int) -> Codes:
    """How many neighbours of each shape the search counts: as many as its class has others, at least 1, at most ``k``.

    So a class of any size can be kept together wholly. NH with the same k for all could not tell the best space from
    a poor one where classes are smaller: that the k nearest of a shape hold the few others of its class says little.
    """
    sizes = np.bincount(codes[codes >= 0], minlength=1)
    return np.where(codes >= 0, np.clip(sizes[codes] - 1, 1, k), k)


def hits_of_additions(
    columns: FloatArray, squared: FloatArray, rows: npt.NDArray[np.intp], codes: Codes, k: int | Codes
) -> FloatArray:
    """NH of the shapes ``rows`` if each of ``columns`` (c, m) joined distances ``squared`` (m, m); (c, len(rows)).

    ``k`` is one for all shapes or (m,), one for each.
    """
    own = squared[rows]
    # Distances are not negative: this makes each shape its own first.
    own[np.arange(len(rows)), rows] = -1
    others = np.argsort(own, axis=1, kind="stable")[:, 1:]
    own = np.take_along_axis(own, others, axis=1)
    places = np.broadcast_to(k, len(codes))[rows].astype(np.int64)
    return hits_with_each(own, others.astype(np.int32), rows.astype(np.int64), columns, codes, places)


def hits_of(squared: FloatArray, rows: npt.NDArray[np.intp], codes: Codes, k: int | Codes) -> FloatArray:
    """NH of the shapes ``rows`` by distances ``squared`` (m, m); (len(rows),).

    ``k`` is one for all shapes or (m,), one for each.
    """
    own = squared[rows]
    own[np.arange(len(rows)), rows] = np.inf
    k = np.broadcast_to(k, len(codes))[rows]
    last = kth_smallest(own, k)
    same = codes[rows][:, None] == codes
    nearer, tied = own < last, own == last
    places = k - nearer.sum(axis=1)
    return ((nearer & same).sum(axis=1) + places * (tied & same).sum(axis=1) / tied.sum(axis=1)) / k


def lay_out(squared: FloatArray, seed: int) -> FloatArray:
    """The map (m, 2) of shapes by squared distances (m, m)."""
    with threadpool_limits(limits=1):
        return arrange(MAIN_PROJECTION, squared, seed)


def hits_on(xy: FloatArray, codes: Codes, k: int | Codes) -> FloatArray:
    """NH (m,) of every shape on a map (m, 2); of no meaning for shapes without a label.

    ``k`` is one for all shapes or (m,), one for each.
    """
    return neighbourhood_hits(neighbour_weights(xy, k), codes)
