"""The nearest rows of each row of a table that has too many for all pairwise distances at once."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import keep_compiled
from shapeviz_report.types import FloatArray, IntArray

EXACT_LIMIT = 20_000
"""Up to this many rows every distance is looked at; beyond, the nearest are found by descent over a graph, which finds
99 of 100 of them in a time that grows little faster than the rows."""

_BLOCK = 20_000_000
"""Distances at a time."""


def nearest_rows(values: FloatArray, count: int, seed: int) -> tuple[IntArray, npt.NDArray[np.float32]]:
    """The nearest other rows of every row, nearest first, and their Euclidean distances.

    Parameters
    ----------
    values : (n, w) float array
        Of more than ``count`` rows.
    count : int
        How many to find for each.
    seed : int
        Of the descent (Dong, Moses and Li 2011, by ``pynndescent``) above :data:`EXACT_LIMIT` rows.

    Returns
    -------
    rows : (n, count) int32 array
    distances : (n, count) float32 array
    """
    centred = np.ascontiguousarray(values - values.mean(axis=0), dtype=np.float32)
    if len(centred) <= EXACT_LIMIT:
        return _nearest_of_all(centred, count)
    return _nearest_by_descent(centred, count, seed)


def _nearest_of_all(values: npt.NDArray[np.float32], count: int) -> tuple[IntArray, npt.NDArray[np.float32]]:
    rows = np.empty((len(values), count), np.int32)
    distances = np.empty((len(values), count), np.float32)
    norms = np.einsum("ij,ij->i", values, values)
    step = max(1, _BLOCK // len(values))
    for start in range(0, len(values), step):
        block = np.arange(start, min(start + step, len(values)))
        squared = norms[block, None] + norms - 2 * values[block] @ values.T
        squared[block - start, block] = np.inf
        nearest = np.argpartition(squared, count - 1, axis=1)[:, :count]
        found = np.maximum(np.take_along_axis(squared, nearest, axis=1), 0)
        order = np.lexsort((nearest, found))
        rows[block] = np.take_along_axis(nearest, order, axis=1)
        distances[block] = np.sqrt(np.take_along_axis(found, order, axis=1))
    return rows, distances


def _nearest_by_descent(
    values: npt.NDArray[np.float32], count: int, seed: int
) -> tuple[IntArray, npt.NDArray[np.float32]]:
    # It takes seconds to import, and few databases need it.
    import pynndescent

    # What takes another function as an argument is compiled again all the same; a third of the time is saved.
    keep_compiled("pynndescent", pynndescent.distances, pynndescent.rp_trees, pynndescent.utils)
    found, distances = pynndescent.NNDescent(
        values, n_neighbors=count + 1, random_state=seed, n_jobs=1, max_candidates=60
    ).neighbor_graph
    # A row finds itself, among equal ones not always first; one that does not loses its farthest.
    own = found == np.arange(len(values))[:, None]
    own[~own.any(axis=1), count] = True
    return (
        found[~own].reshape(len(values), count).astype(np.int32),
        distances[~own].reshape(len(values), count).astype(np.float32),
    )
