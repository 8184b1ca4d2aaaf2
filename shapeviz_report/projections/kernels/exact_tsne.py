"""Exact t-SNE on squared distances, for many small problems.

A database of hundreds of shapes needs no approximation: all pairs fit into the processor's cache, and the
inner loop over them compiles to vector instructions. Arrays in, arrays out; inputs are trusted.
"""

from __future__ import annotations

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import Float32Array

EARLY_STEPS, LATE_STEPS = 250, 500
"""Steps with and without exaggeration; 250 more lower the KL divergence by less than one percent."""

_SHORT_SEARCH = 1e-5
"""The entropy of a row is found to this precision (nats)."""


@kernel(error_model="numpy", fastmath=True)
def affinities(squared: Float32Array, perplexity: float, neighbours: int) -> Float32Array:
    """The symmetric probabilities of neighbours in the features' space.

    Each row is a Gaussian of the width whose entropy is log(perplexity), found by Newton steps on the
    logarithm of its precision inside a shrinking bracket: four or five where bisection takes twenty.

    Parameters
    ----------
    squared : (n, n) float32 array
        Squared distances.
    perplexity : float
        Below ``neighbours``.
    neighbours : int
        How many nearest rows have a share in a row, and those that are as far as the last; n - 1 for all.

    Returns
    -------
    (n, n) float32 array
        Symmetric, zero on the diagonal, adds up to 1. A row without any spread has equal shares.
    """
    count = len(squared)
    shares = np.zeros((count, count), np.float32)
    target = np.log(perplexity)
    chosen = np.empty(count, np.int64)
    excess = np.empty(count)
    weights = np.empty(count)
    for i in range(count):
        # The row itself is its own nearest.
        farthest = np.partition(squared[i], neighbours)[neighbours]
        size = 0
        nearest, mean = np.inf, 0.0
        for j in range(count):
            if j != i and squared[i, j] <= farthest:
                chosen[size] = j
                excess[size] = squared[i, j]
                nearest = min(nearest, excess[size])
                mean += excess[size]
                size += 1
        # Distances beyond the nearest, in units of their mean: neither can underflow the exponential.
        mean = mean / size - nearest
        spread = mean > 1e-6 * nearest and mean > 0
        for j in range(size):
            excess[j] = (excess[j] - nearest) / mean if spread else 0.0
        low, high, precision = 0.0, 1e30, 1.0
        total = 1.0
        for _ in range(60):
            total, first, second = 0.0, 0.0, 0.0
            for j in range(size):
                weight = np.exp(-precision * excess[j])
                weights[j] = weight
                total += weight
                first += weight * excess[j]
                second += weight * excess[j] * excess[j]
            first /= total
            surplus = np.log(total) + precision * first - target
            # More points at the nearest distance than the perplexity asks for: no precision is enough.
            if abs(surplus) < _SHORT_SEARCH or not spread or precision > 1e12:
                break
            if surplus > 0:
                low = precision
            else:
                high = precision
            slope = precision * precision * (second / total - first * first)
            step = surplus / slope if slope > 0 else 0.0
            moved = precision * np.exp(min(max(step, -2.0), 2.0))
            if not low < moved < high:
                moved = 4 * precision if high == 1e30 else (low + high) / 2
            precision = moved
        for j in range(size):
            shares[i, chosen[j]] = weights[j] / total
    for i in range(count):
        for j in range(i):
            share = (shares[i, j] + shares[j, i]) / (2 * count)
            shares[i, j] = share
            shares[j, i] = share
    return shares


@kernel(error_model="numpy", fastmath=True)
def descend(
    shares: Float32Array, start: Float32Array, early_factor: np.float32, rate: np.float32
) -> Float32Array:
    """Minimise the KL divergence between the affinities and those of the map, by gradient descent.

    Momentum 0.5, later 0.8, and a gain for every coordinate (van der Maaten and Hinton 2008). Single precision
    is as good as double (NH_s and KL divergence agree within the noise of seeds) and twice as fast.

    Parameters
    ----------
    shares : (n, n) float32 array
        As :func:`affinities` gives them.
    start : (n, 2) float32 array
        Where the points start; small against 1.
    early_factor : float32
        Factor on the affinities at first (exaggeration).
    rate : float32
        Learning rate.

    Returns
    -------
    (n, 2) float32 array
    """
    count = len(shares)
    one = np.float32(1)
    x, y = start[:, 0].copy(), start[:, 1].copy()
    speed_x, speed_y = np.zeros(count, np.float32), np.zeros(count, np.float32)
    gain_x, gain_y = np.ones(count, np.float32), np.ones(count, np.float32)
    pull_x, pull_y = np.empty(count, np.float32), np.empty(count, np.float32)
    push_x, push_y = np.empty(count, np.float32), np.empty(count, np.float32)
    smallest = _extent(x, y)
    for step in range(EARLY_STEPS + LATE_STEPS):
        early = step < EARLY_STEPS
        exaggeration = early_factor if early else one
        momentum = np.float32(0.5 if early else 0.8)
        normaliser = 0.0
        for i in range(count):
            row = shares[i]
            own_x, own_y = x[i], y[i]
            similarity = attract_x = attract_y = repel_x = repel_y = np.float32(0)
            # The one loop that counts. The point itself adds nothing but 1 to the similarity.
            for j in range(count):
                to_x, to_y = own_x - x[j], own_y - y[j]
                kernel = one / (one + to_x * to_x + to_y * to_y)
                similarity += kernel
                weight = row[j] * kernel
                attract_x += weight * to_x
                attract_y += weight * to_y
                kernel *= kernel
                repel_x += kernel * to_x
                repel_y += kernel * to_y
            normaliser += float(similarity)
            pull_x[i], pull_y[i] = attract_x, attract_y
            push_x[i], push_y[i] = repel_x, repel_y
        scale = np.float32(1 / max(normaliser - count, 1e-12))
        _move(x, speed_x, gain_x, pull_x, push_x, exaggeration, scale, momentum, rate)
        _move(y, speed_y, gain_y, pull_y, push_y, exaggeration, scale, momentum, rate)
        if early:
            # Exaggeration pulls rows without clear groups together until single precision cannot tell them from
            # their mean, and nothing parts them again. At this size forces are linear: scale means nothing.
            x -= x.mean()
            y -= y.mean()
            extent = _extent(x, y)
            if 0 < extent < smallest:
                growth = smallest / extent
                x *= growth
                y *= growth
                speed_x *= growth
                speed_y *= growth
    return np.stack((x, y), axis=1)


@kernel(error_model="numpy", fastmath=True)
def _extent(x: Float32Array, y: Float32Array) -> np.float32:
    """The larger root mean square of two coordinates."""
    return np.float32(np.sqrt(max((x * x).mean(), (y * y).mean())))


@kernel(error_model="numpy", fastmath=True)
def _move(
    position: Float32Array,
    speed: Float32Array,
    gain: Float32Array,
    pull: Float32Array,
    push: Float32Array,
    exaggeration: np.float32,
    scale: np.float32,
    momentum: np.float32,
    rate: np.float32,
) -> None:
    """One step of all points along one axis, in place."""
    for i in range(len(position)):
        gradient = np.float32(4) * (exaggeration * pull[i] - push[i] * scale)
        if speed[i] * gradient < 0:
            gain[i] += np.float32(0.2)
        else:
            gain[i] = max(gain[i] * np.float32(0.8), np.float32(0.01))
        speed[i] = momentum * speed[i] - rate * gain[i] * gradient
        position[i] += speed[i]
