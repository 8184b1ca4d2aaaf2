"""From values at vertices to one row of features a shape (paper, 3.4)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
import numpy.typing as npt

from shapeviz_report.descriptors import Descriptor, Surface
from shapeviz_report.descriptors.kernels.histograms import add_up
from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
from shapeviz_report.types import FeatureBlock, FloatArray, Mesh

BINS = 10
"""Bins a dimension (paper, 3.4)."""

QUANTILES = (0.01, 0.99)
"""Ends of the data-driven histogram ranges: wide enough for the values, closed to stray ones."""

ROUNDING = 1e-6
"""What rounding may move a continuous value by, as a part of it; as it stands, where it is a difference of values."""

SHARE_ROUNDING = 1e-7
"""What rounding may move a share by: it is a quotient of two numbers, rounded once to float32."""

LEAST = 1e-3
"""Rounding moves continuous values smaller than this as much as this one: they are differences of larger ones."""

BLOCKS = tuple(FeatureBlock(d.name, d.dimensions, BINS) for d in ALL_DESCRIPTORS)
"""Those of the paper's Table 1, and of plug-ins: a histogram of ``BINS`` columns for each of the D dimensions of all
descriptors."""


def fixed_edges() -> FloatArray:
    """The (D, 11) bin edges of every dimension that the descriptors define, clear of the values they take."""
    return clear_edges(np.concatenate([np.tile(d.edges, (d.dimensions, 1)) for d in ALL_DESCRIPTORS]))


def quantile_edges(samples: Sequence[FloatArray]) -> FloatArray:
    """The (D, 11) bin edges from values at some vertices of every shape, each shape of equal weight.

    Parameters
    ----------
    samples : sequence of (s, D) arrays
        As :func:`sample_values` gives them.
    """
    low, high = np.quantile(np.concatenate(samples).astype(np.float64), QUANTILES, axis=0)
    # Where all values agree any width does: they all fall into one bin. Rounding is no difference.
    high = np.where(high - low > BINS * ROUNDING, high, low + 1)
    return clear_edges(low[:, None] + (high - low)[:, None] * np.linspace(0, 1, BINS + 1))


def clear_edges(edges: FloatArray) -> FloatArray:
    r"""Move the inner edges off the values that descriptors take, so that rounding does not choose the bin.

    A value at an edge belongs above it. Many vertices have such a value exactly, but rounding puts it on either
    side. So an edge on a value goes below it. Shares of :math:`t \in T` things (:attr:`Descriptor.totals`) are

    .. math:: V = \{m / t : t \in T, 0 \le m \le t\}, \quad
              e' = \tfrac{1}{2} (v_{j-1} + v_j) \;\text{if}\; |e - v_j| \le 10^{-7}

    with :math:`v_j` the least value from :math:`e - 10^{-7}` up: down by half a step of the lattice, which is at
    least 1.7e-6 for PFH (870 pairs, fewer on tiny meshes) and 1.2e-7 for Sc (up to 2000 points). Other edges of
    shares stay. Values that vary continuously are round ones on flat and regular shapes (0, 1/2, 0.6): all of
    their edges go down, by :math:`10^{-6} \max(|e|, 10^{-3})`.

    Parameters
    ----------
    edges : (D, 11) array
        Rising along each row.

    Returns
    -------
    (D, 11) float64 array
        The first and last edges, which no value is compared with, stay.
    """
    cleared, start = edges.astype(np.float64), 0
    for descriptor in ALL_DESCRIPTORS:
        rows = slice(start, start + descriptor.dimensions)
        inner = cleared[rows, 1:-1]
        if descriptor.totals:
            values = _shares(descriptor)
            place = np.searchsorted(values, inner - SHARE_ROUNDING).clip(1, len(values) - 1)
            below, at = values[place - 1], values[place]
            cleared[rows, 1:-1] = np.where(np.abs(inner - at) <= SHARE_ROUNDING, (below + at) / 2, inner)
        else:
            cleared[rows, 1:-1] -= ROUNDING * np.maximum(np.abs(inner), LEAST)
        start = rows.stop
    return cleared


@cache
def _shares(descriptor: Descriptor) -> FloatArray:
    """All values that a descriptor of shares can take, rising."""
    return np.unique(np.concatenate([np.arange(total + 1) / total for total in descriptor.totals]))


def sample_values(mesh: Mesh, count: int) -> FloatArray:
    """Values of all descriptors at ``count`` vertices spread over a mesh's numbering; (count, D) float32."""
    surface = Surface(mesh)
    chosen = ((np.arange(count) + 0.5) / count * len(surface.vertices)).astype(int)
    return np.concatenate([d.compute(surface)[chosen].astype(np.float32) for d in ALL_DESCRIPTORS], axis=1)


def compute_histograms(mesh: Mesh, edges: FloatArray, *, by_area: bool) -> FloatArray:
    """The features of a shape: a histogram of 10 bins for every descriptor dimension.

    Parameters
    ----------
    mesh : Mesh
        Prepared.
    edges : (D, 11) array
        Rising along each row. Bin b takes ``edges[b] <= value < edges[b + 1]``; the first and last bin also take
        what lies beyond.
    by_area : bool
        Weight each vertex with its area instead of equally.

    Returns
    -------
    (D * BINS,) float64 array
        Fractions; each dimension's ten add up to 1.
    """
    return describe(mesh, edges, np.empty(0, np.int64), by_area=by_area)[0]


def describe(
    mesh: Mesh, edges: FloatArray, vertices: npt.NDArray[np.int64], *, by_area: bool
) -> tuple[FloatArray, npt.NDArray[np.uint8]]:
    """The features of a shape, and the bins into which some of its vertices fall.

    Parameters
    ----------
    mesh, edges, by_area
        As for :func:`compute_histograms`.
    vertices : (v,) int64 array
        Which of the mesh's.

    Returns
    -------
    histograms : (D * BINS,) float64 array
    bins : (D, v) uint8 array
        From 0, in every dimension.
    """
    surface = Surface(mesh)
    weights = surface.areas if by_area else np.ones(len(surface.vertices))
    limits = edges[:, 1:-1].astype(np.float32)
    totals, start = np.zeros(edges[:, 1:].shape), 0
    bins = np.empty((len(edges), len(vertices)), np.uint8)
    # One descriptor at a time: together they would take 1.5 kB a vertex.
    for descriptor in ALL_DESCRIPTORS:
        end = start + descriptor.dimensions
        values = descriptor.compute(surface).astype(np.float32, copy=False)
        add_up(values, limits[start:end], weights, totals[start:end])
        bins[start:end] = find_bins(values[vertices].T, edges[start:end])
        start = end
    return totals.ravel() / weights.sum(), bins


def find_bins(values: npt.NDArray[np.float32], edges: FloatArray) -> npt.NDArray[np.uint8]:
    """The bin from 0 of every value, as histograms count it.

    Parameters
    ----------
    values : (d, n) float32 array
    edges : (d, 11) array
        As for :func:`compute_histograms`.
    """
    limits = edges[:, 1:-1].astype(np.float32)
    # The sum over the few limits as a loop: along the values it is quick.
    bins = np.zeros(values.shape, np.uint8)
    for limit in limits.T:
        bins += values >= limit[:, None]
    return bins


def measure(mesh: Mesh, dimensions: Sequence[int]) -> npt.NDArray[np.float32]:
    """The values at every vertex in some of the D dimensions; (len(dimensions), n).

    Parameters
    ----------
    mesh : Mesh
        Prepared.
    dimensions : sequence of int
        From 0.
    """
    surface = Surface(mesh)
    values = np.empty((len(dimensions), len(surface.vertices)), np.float32)
    start = 0
    for descriptor in ALL_DESCRIPTORS:
        end = start + descriptor.dimensions
        own = [place for place, dimension in enumerate(dimensions) if start <= dimension < end]
        if own:
            values[own] = descriptor.compute(surface)[:, [dimensions[place] - start for place in own]].T
        start = end
    return values
