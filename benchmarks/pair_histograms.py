"""PFH and FPFH in plain numpy, with the choices in which implementations differ as arguments.

Every pair of points (Eq. 4, 5 of the paper; Rusu et al. 2009) starts from one of the two, its source:

``first``
    The point named first: the paper.
``flatter``
    The one whose normal makes the smaller angle with the line between them: Rusu et al., the Point Cloud
    Library and Open3D.
``both``
    Each in turn, two entries a pair: the paper's N x N.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from shapeviz_report.descriptors.kernels.pairs import SMALLEST
from shapeviz_report.types import FloatArray, IntArray

Source = Literal["first", "flatter", "both"]

CHUNK = 500
"""Vertices whose pairs are held at a time."""


def pair_angles(
    points: FloatArray, normals: FloatArray, first: IntArray, second: IntArray, source: Source
) -> FloatArray:
    """alpha, phi, theta of pairs, each scaled to [0, 1]; (3, ...), twice as long in the last axis for ``both``.

    A pair at one place, or along its source's normal, counts as 0, 0, 0: the middle.
    """
    if source == "both":
        ways = ((first, second), (second, first))
        return np.concatenate([pair_angles(points, normals, *way, "first") for way in ways], axis=-1)
    if source == "flatter":
        line = points[second] - points[first]
        here = np.abs((normals[first] * line).sum(axis=-1))
        there = np.abs((normals[second] * line).sum(axis=-1))
        first, second = np.where(there > here, second, first), np.where(there > here, first, second)
    line = points[second] - points[first]
    length = np.linalg.norm(line, axis=-1, keepdims=True)
    line = line / np.where(length > 0, length, 1)
    u, other = normals[first], normals[second]
    v = np.cross(line, u)
    width = np.linalg.norm(v, axis=-1, keepdims=True)
    v = v / np.where(width > 0, width, 1)
    w = np.cross(u, v)
    alpha, phi = (v * other).sum(axis=-1), (u * line).sum(axis=-1)
    height = (w * other).sum(axis=-1)
    theta = np.arctan2(height, (u * other).sum(axis=-1))
    if source == "first":
        # Opposite normals turn by pi or by -pi, as rounding has it: ours take the latter.
        theta = np.where(height * width[..., 0] > SMALLEST, theta, -np.abs(theta))
    scaled = np.stack([(alpha + 1) / 2, (phi + 1) / 2, (theta / np.pi + 1) / 2])
    return np.where(width[..., 0] > 0, scaled, 0.5)


def cut(values: FloatArray, bins: int) -> IntArray:
    """Which of ``bins`` equal parts of [0, 1] each value lies in."""
    return np.clip(np.floor(values * bins), 0, bins - 1).astype(np.int32)


def pfh(points: FloatArray, normals: FloatArray, neighbourhoods: IntArray, source: Source) -> FloatArray:
    """Shares of the pairs within each neighbourhood in cells ``25 alpha + 5 phi + theta``; (n, 125)."""
    one, other = np.triu_indices(neighbourhoods.shape[1], k=1)
    rows = []
    for start in range(0, len(neighbourhoods), CHUNK):
        near = neighbourhoods[start : start + CHUNK]
        # The Point Cloud Library takes the later of two points first, which decides where both are as flat.
        alpha, phi, theta = cut(pair_angles(points, normals, near[:, other], near[:, one], source), 5)
        rows.append(share(25 * alpha + 5 * phi + theta, 125))
    return np.concatenate(rows)


def spfh(points: FloatArray, normals: FloatArray, neighbours: IntArray, source: Source) -> FloatArray:
    """Shares of the pairs (vertex, neighbour) in 11 bins each of alpha, phi, theta; (n, 3, 11)."""
    own = np.broadcast_to(np.arange(len(neighbours))[:, None], neighbours.shape)
    angles = cut(pair_angles(points, normals, own, neighbours, source), 11)
    return np.stack([share(angle, 11) for angle in angles], axis=1)


def share(cells: IntArray, count: int) -> FloatArray:
    """Histogram of each row as fractions; (n, count)."""
    rows = np.arange(len(cells))[:, None] * count
    tally = np.bincount((rows + cells).ravel(), minlength=len(cells) * count)
    return tally.reshape(len(cells), count) / cells.shape[1]


def average(
    histograms: FloatArray,
    neighbours: IntArray,
    distances: FloatArray,
    *,
    power: int,
    own: Literal["added", "left out", "half"],
) -> FloatArray:
    """FPFH from SPFH, each group of 11 as fractions; (n, 3, 11).

    Parameters
    ----------
    histograms : (n, 3, 11) array
    neighbours, distances : (n, k) arrays
        Without the vertex itself; no distance 0.
    power : int
        A neighbour counts with one over its distance to this power.
    own : str
        What the vertex's own SPFH counts: ``added`` to the mean over k neighbours (Eq. 6), ``left out``, or
        ``half`` of the result.
    """
    weights = distances ** -float(power)
    near = np.stack(
        [np.einsum("nk,nkb->nb", weights, histograms[:, group][neighbours]) for group in range(3)], axis=1
    )
    if own == "added":
        near = near / neighbours.shape[1] + histograms
    near = near / near.sum(axis=2, keepdims=True)
    return (near + histograms) / 2 if own == "half" else near
