"""Distances that know their neighbourhood: near is what is near for both sides, and what chains of such shapes link."""

from __future__ import annotations

import numpy as np

from shapeviz_report.types import FloatArray

LOCAL = 10
"""Nearest shapes whose mean distance is the unit around a shape."""

BANDWIDTH = 7
"""The nearest shape whose distance is the width of a shape's affinities, as Zelnik-Manor and Perona (2004) have it."""

DAMPING = 0.9
"""What a step of a chain counts less than the one before."""


def links(count: int) -> int:
    """How many nearest shapes a shape may be linked with among so many: two thirds of the square root, at least 3."""
    return max(3, round(count**0.5 / 1.5))


def diffuse(squared: FloatArray) -> FloatArray:
    r"""Squared distances that know their neighbourhood, from squared distances :math:`d^2`.

    The sum of two, each divided by its mean over all pairs. *Local scaling* measures a distance by the mean distances
    m of both to their ten nearest: :math:`d_{ij}^2 / (m_i m_j)`. *Diffusion* adds up all chains between two shapes
    over the graph of those that are among each other's :func:`links` strongest affinities A (Zhou et al. 2004; Donoser
    and Bischof 2013), s being the distance to the seventh nearest (Zelnik-Manor and Perona 2004):

    .. math:: A_{ij} = e^{-d_{ij}^2 / (s_i s_j)}, \quad S = D^{-1/2} A D^{-1/2}, \quad
              K = \sum_t 0.9^t S^t = (I - 0.9\,S)^{-1}

    As a distance it is :math:`2 - 2 K_{ij} / \sqrt{K_{ii} K_{jj}}`. Scaling alone gains less, diffusion alone falls
    below plain distances where classes are small; docs/notes/features.md has the figures.

    Parameters
    ----------
    squared : (n, n) float array
        Symmetric.

    Returns
    -------
    (n, n) float64 array
        Symmetric, 0 on the diagonal and between shapes that nothing tells apart. The triangle inequality does not
        hold, and they are no sums over features.
    """
    squared = np.asarray(squared, np.float64)
    count = len(squared)
    if count < 2 or squared.max() == 0:
        return np.zeros_like(squared)
    others = squared.copy()
    np.fill_diagonal(others, np.inf)
    nearest = np.sqrt(np.sort(others, axis=1)[:, :-1])
    units = _positive(nearest[:, :LOCAL].mean(axis=1))
    scaled = squared / np.outer(units, units)
    widths = _positive(nearest[:, min(BANDWIDTH, count - 1) - 1])
    affinity = np.exp(-others / np.outer(widths, widths))
    least = np.sort(affinity, axis=1)[:, -min(links(count), count - 1), None]
    # Equal affinities are kept or left out together, so that no order of the shapes decides.
    linked = affinity >= least * (1 - 1e-9)
    affinity *= linked & linked.T
    degrees = affinity.sum(axis=1)
    roots = np.sqrt(np.where(degrees > 0, degrees, 1.0))
    chains = np.linalg.inv(np.eye(count) - DAMPING * affinity / np.outer(roots, roots))
    chains = (chains + chains.T) / 2
    lengths = np.sqrt(np.diag(chains))
    diffused = np.maximum(2 - 2 * chains / np.outer(lengths, lengths), 0.0)
    total = _by_mean(scaled) + _by_mean(diffused)
    total[squared == 0] = 0.0
    return (total + total.T) / 2


def _positive(lengths: FloatArray) -> FloatArray:
    """Lengths (n,) that can divide: where copies make one nothing, a small part of the usual."""
    usual = float(lengths.mean())
    return np.maximum(lengths, 1e-3 * usual) if usual > 0 else np.ones_like(lengths)


def _by_mean(squared: FloatArray) -> FloatArray:
    """Values (n, n) with 0 on the diagonal in units of their mean over pairs."""
    count = len(squared)
    np.fill_diagonal(squared, 0.0)
    mean = squared.sum() / (count * (count - 1))
    return squared / mean if mean > 0 else squared
