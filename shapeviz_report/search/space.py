"""What is searched: the squared distances of every feature, and the map of any sum of them.

Squared distances of feature blocks add up, so a subset costs one sum of small matrices instead of a pass over
thousands of columns. A subset is a whole number whose binary digits say which features it has, the first feature
lowest.
"""

from __future__ import annotations

import hashlib
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt
from threadpoolctl import threadpool_limits

from shapeviz_report.projections import PROJECTIONS, arrange, canonical_order, squared_distances
from shapeviz_report.types import FeatureTable, FloatArray, IntArray

SAMPLE_LIMIT = 1000
"""Most shapes that a search takes; of larger databases, a stratified sample. At this size a t-SNE map costs 0.7 CPU
seconds, all 255 three minutes."""


@dataclass(frozen=True)
class SearchSpace:
    """The input of a search.

    Attributes
    ----------
    features : tuple of str
    rows : (m,) int32 array
        The shapes that take part, as rows of the feature table.
    shape_count : int
        Of the table.
    local : int
        How many of the features, the first, are histograms of local descriptors: those of the paper.
    squared : (f, m, m) float32 array
        Squared distances by each feature: 4 f m^2 bytes, 2.5 MB for eight features of 280 shapes, 32 MB at
        ``SAMPLE_LIMIT``.

    The shapes stand in an order that their values alone decide, so that the order of files cannot matter.
    """

    features: tuple[str, ...]
    rows: IntArray
    shape_count: int
    local: int
    squared: npt.NDArray[np.float32]

    @cached_property
    def key(self) -> str:
        """A name for the distances: what the maps of subsets depend on, besides method and seed."""
        return hashlib.sha256(self.squared.tobytes() + repr(self.squared.shape).encode()).hexdigest()

    @property
    def everything(self) -> int:
        """The subset of all features."""
        return (1 << len(self.features)) - 1

    def distances(self, subset: int) -> FloatArray:
        """(m, m) squared distances of the shapes by a subset."""
        return add_squares(self.squared, subset)

    def names(self, subset: int) -> tuple[str, ...]:
        """The features of a subset."""
        return tuple(name for i, name in enumerate(self.features) if subset >> i & 1)


@dataclass(frozen=True)
class SubsetMaps:
    """Maps of some subsets.

    Attributes
    ----------
    xy : (S, m, 2) float32 array
        As :func:`shapeviz_report.projections.arrange` gives them, shapes in the order of the space.
    cpu_seconds : (S,) float64 array
    """

    xy: npt.NDArray[np.float32]
    cpu_seconds: FloatArray


def make_space(
    table: FeatureTable,
    scaled: FloatArray,
    labels: Sequence[str | None],
    *,
    seed: int = 0,
    limit: int = SAMPLE_LIMIT,
) -> SearchSpace:
    """Prepare a search.

    Parameters
    ----------
    table : FeatureTable
        At least one row.
    scaled : (n, w) float array
        Its values as projections compare them.
    labels : n labels
        Decide the sample, each class in proportion; shapes without a label count as a class.
    seed : int
        Of the sample.
    limit : int
        Most shapes to take.
    """
    order = canonical_order(scaled)
    if len(order) > limit:
        order = order[stratified_sample([labels[i] for i in order], limit, seed)]
    chosen = scaled[order]
    with threadpool_limits(limits=1):
        squared = np.stack(
            [squared_distances(chosen[:, table.slice_of(b.name)]).astype(np.float32) for b in table.blocks]
        )
    names = tuple(block.name for block in table.blocks)
    local = sum(block.bins > 1 for block in table.blocks)
    return SearchSpace(names, order.astype(np.int32), len(scaled), local, squared)


def stratified_sample(labels: Sequence[str | None], size: int, seed: int) -> npt.NDArray[np.intp]:
    """Rising indices of ``size`` labels in which each class has its share, rounded."""
    random = np.random.default_rng(seed)
    # With the places of a class spread evenly over [0, 1), any threshold cuts all classes in proportion.
    place = np.empty(len(labels))
    for label in sorted(set(labels), key=lambda name: (name is None, name)):
        own = np.flatnonzero([other == label for other in labels])
        place[random.permutation(own)] = (np.arange(len(own)) + random.random()) / len(own)
    return np.sort(np.argsort(place, kind="stable")[:size])


def map_subsets(
    squared: npt.NDArray[np.float32], method: str, seed: int, subsets: Sequence[int]
) -> SubsetMaps:
    """Lay out some subsets of the features: the work of a search, in pieces of any size.

    Neither labels nor k have part in it. Needs 12 m^2 bytes for m shapes besides the distances.

    Parameters
    ----------
    squared : (f, m, m) float32 array
        The distances of a :class:`SearchSpace`.
    method : str
        The name of a projection.
    seed : int
    subsets : whole numbers from 1 to 2^f - 1
    """
    projection = next(m for m in PROJECTIONS if m.name == method)
    xy = np.empty((len(subsets), squared.shape[1], 2), np.float32)
    seconds = np.empty(len(subsets))
    with threadpool_limits(limits=1):
        for i, subset in enumerate(subsets):
            start = time.process_time()
            xy[i] = arrange(projection, add_squares(squared, subset), seed)
            seconds[i] = time.process_time() - start
    return SubsetMaps(xy, seconds)


def add_squares(squared: npt.NDArray[np.float32], subset: int) -> FloatArray:
    """(m, m) the squared distances by some of the features, added up."""
    distances = np.zeros(squared.shape[1:])
    for block, squares in enumerate(squared):
        if subset >> block & 1:
            distances += squares
    return distances
