"""A sample of a large database for what a browser computes: each class in proportion, always the same shapes."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from shapeviz_report.types import IntArray

#: More shapes than this are too many for a map or a score while a reader waits. To the letter as ``MOST_SHAPES`` in
#: ``database/sample.js``.
MOST_SAMPLED = 3000


def sample_rows(groups: IntArray, most: int = MOST_SAMPLED) -> IntArray:
    """The rows of a sample, rising; to the letter as ``sampled`` in ``database/sample.js``.

    The members of a class stand in an order that has nothing to do with where they stand in the database. The i-th of
    a class of n, from 0, has the rank i / n, and those of the lowest ranks are taken: the first of each class, so that
    none is left out as long as there are no more classes than places, and of each as many as its share.

    Parameters
    ----------
    groups : (n,) int array
        The class of every shape, -1 without one.
    most : int
        Shapes in the sample; all where there are no more.
    """
    if len(groups) <= most:
        return np.arange(len(groups), dtype=np.int32)
    scattered = scatter(len(groups))
    order = np.lexsort((scattered, groups))
    _, first, sizes = np.unique(groups[order], return_index=True, return_counts=True)
    ranks = np.empty(len(groups))
    ranks[order] = (np.arange(len(groups)) - np.repeat(first, sizes)) / np.repeat(sizes, sizes)
    return np.sort(np.lexsort((scattered, ranks))[:most]).astype(np.int32)


def scatter(count: int) -> npt.NDArray[np.uint32]:
    """A different number for each of so many rows, which has nothing to do with where it stands."""
    mixed = (np.arange(count, dtype=np.uint32) + np.uint32(1)) * np.uint32(0x9E3779B1)
    mixed = (mixed ^ (mixed >> np.uint32(15))) * np.uint32(0x85EBCA6B)
    return mixed ^ (mixed >> np.uint32(13))
