"""Logistic regression with an L1 penalty on many random halves of the rows.

``site/scripts/engine/score-logistic.js`` takes the same steps with the same random numbers.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel
from shapeviz_report.scorers.kernels import random
from shapeviz_report.types import FloatArray

_SUMS = {"nnan", "ninf", "nsz", "reassoc", "contract"}
"""What the compiler may assume so that sums become vector instructions."""

_MOST_STEPS = 50
"""Newton steps for one strength; three are usual."""

_MOST_SWEEPS = 1000
"""Rounds over the coefficients in one Newton step."""


@kernel(error_model="numpy")
def selections(
    columns: FloatArray,
    hits: int,
    pairs: int,
    most: int,
    strengths: FloatArray,
    weakest: float,
    tolerance: float,
    seed: int,
) -> npt.NDArray[np.int64]:
    """How often each column has a coefficient, over all runs and strengths.

    Either group is cut at random into two halves, ``pairs`` times, and each half of the rows is a run; where a group
    has an odd number of rows, both halves have the one in the middle. Of a large group, a run has fewer than half.

    Parameters
    ----------
    columns : (d, n) float64 array
        Standardised, one row a column; the rows of the first group come first.
    hits : int
        Size of the first group.
    pairs : int
    most : int
        Rows of a group in a run.
    strengths : (k,) float64 array
        Falling, of :func:`follow_path`.
    weakest : float
        Each run divides the penalty of each column by a number drawn evenly from here to 1.
    tolerance : float
        Of :func:`follow_path`.
    seed : int

    Returns
    -------
    (d,) int64 array
        From 0 to 2 k ``pairs``.
    """
    width, count = columns.shape
    state = random.start(seed)
    total = np.zeros(width, np.int64)
    order = np.arange(count)
    misses = count - hits
    taken = min((hits + 1) // 2, most)
    size = taken + min((misses + 1) // 2, most)
    sample, penalties = np.empty((width, size)), np.empty(width)
    for _ in range(pairs):
        _shuffle(order[:hits], state)
        _shuffle(order[hits:], state)
        for half in range(2):
            first, second = (0, hits) if half == 0 else (hits - taken, count - (size - taken))
            for column in range(width):
                for place in range(taken):
                    sample[column, place] = columns[column, order[first + place]]
                for place in range(size - taken):
                    sample[column, taken + place] = columns[column, order[second + place]]
                penalties[column] = 1 / (weakest + (1 - weakest) * random.uniform(state))
            for coefficients in follow_path(sample, taken, penalties, strengths, tolerance)[0]:
                total += coefficients != 0
    return total


@kernel()
def _shuffle(order: npt.NDArray[np.int64], state: npt.NDArray[np.uint64]) -> None:
    for place in range(len(order)):
        pick = place + int(random.uniform(state) * (len(order) - place))
        order[place], order[pick] = order[pick], order[place]


@kernel(error_model="numpy", fastmath=_SUMS)
def follow_path(
    columns: FloatArray, hits: int, penalties: FloatArray, strengths: FloatArray, tolerance: float
) -> tuple[FloatArray, FloatArray]:
    r"""Logistic regressions with a falling L1 penalty, each started from the one before.

    .. math:: \min_{b, \beta} \sum_i s_i \log(1 + e^{-t_i (b + x_i \cdot \beta)}) + \lambda \sum_j p_j |\beta_j|

    with weights s that give either group one half, t of +1 and -1, and the strength times the least lambda at
    which all coefficients are zero. Newton steps, each by coordinate descent (Friedman, Hastie and Tibshirani 2010) on
    the columns that have wanted a coefficient so far; others join until none is left that wants one.

    Parameters
    ----------
    columns : (d, m) float64 array
        One row a column; the first group's rows come first.
    hits : int
        Size of the first group; from 1 to m - 1.
    penalties : (d,) float64 array
        p; above 0.
    strengths : (k,) float64 array
        Falling, below 1.
    tolerance : float
        By how much the conditions of the optimum may be violated, as a part of the largest lambda.

    Returns
    -------
    coefficients : (k, d) float64 array
    intercepts : (k,) float64 array
    """
    width, count = columns.shape
    # With weights that give either group one half, an intercept of 0 is best while there are no coefficients.
    intercept, coefficient = 0.0, np.zeros(width)
    linear, previous = np.zeros(count), np.empty(width)
    weights, residuals, curvatures = np.empty(count), np.empty(count), np.empty(count)
    for row in range(count):
        weights[row] = 0.5 / hits if row < hits else 0.5 / (count - hits)
        residuals[row] = 0.5 * weights[row] if row < hits else -0.5 * weights[row]
    gradient, bends = np.empty(width), np.empty(width)
    highest = 0.0
    for column in range(width):
        gradient[column] = _product(columns[column], residuals)
        highest = max(highest, abs(gradient[column]) / penalties[column])
    found, intercepts = np.zeros((len(strengths), width)), np.zeros(len(strengths))
    if highest < 1e-12:
        return found, intercepts
    within, active, size = np.zeros(width, np.bool_), np.empty(width, np.int64), 0
    allowed = tolerance * highest
    for step, strength in enumerate(strengths):
        now = strength * highest
        size = _join(gradient, now * penalties + allowed, within, active, size)
        while True:
            for _ in range(_MOST_STEPS):
                slope, bend = 0.0, 0.0
                for row in range(count):
                    share = 1 / (1 + np.exp(-linear[row]))
                    curvatures[row] = weights[row] * max(share * (1 - share), 1e-9)
                    residuals[row] = weights[row] * ((1.0 if row < hits else 0.0) - share)
                    slope += residuals[row]
                    bend += curvatures[row]
                violation = abs(slope)
                for place in range(size):
                    column = active[place]
                    slope = _product(columns[column], residuals)
                    limit = now * penalties[column]
                    if coefficient[column] == 0:
                        violation = max(violation, abs(slope) - limit)
                    else:
                        violation = max(violation, abs(slope - np.sign(coefficient[column]) * limit))
                if violation <= allowed:
                    break
                for place in range(size):
                    bends[place] = 0.0
                    previous[place] = coefficient[active[place]]
                origin = intercept
                # Coordinate descent on the second-order approximation; `residuals` become those of it. After the first
                # sweep only those go on that have a coefficient; the conditions above are checked for everyone.
                for sweep in range(_MOST_SWEEPS):
                    slope = 0.0
                    for row in range(count):
                        slope += residuals[row]
                    change, largest = slope / bend, abs(slope)
                    intercept += change
                    for row in range(count):
                        residuals[row] -= curvatures[row] * change
                    for place in range(size):
                        column = active[place]
                        old = coefficient[column]
                        if old == 0 and sweep > 0:
                            continue
                        values = columns[column]
                        pull = _product(values, residuals)
                        if old == 0 and abs(pull) <= now * penalties[column]:
                            continue
                        if bends[place] == 0:
                            for row in range(count):
                                bends[place] += curvatures[row] * values[row] * values[row]
                        pull += bends[place] * old
                        excess = abs(pull) - now * penalties[column]
                        change = (np.sign(pull) * excess / bends[place] if excess > 0 else 0.0) - old
                        if change != 0:
                            coefficient[column] = old + change
                            largest = max(largest, abs(change) * bends[place])
                            for row in range(count):
                                residuals[row] -= curvatures[row] * (values[row] * change)
                    if largest <= 0.1 * violation:
                        break
                for row in range(count):
                    linear[row] += intercept - origin
                for place in range(size):
                    change = coefficient[active[place]] - previous[place]
                    if change != 0:
                        values = columns[active[place]]
                        for row in range(count):
                            linear[row] += values[row] * change
            for column in range(width):
                gradient[column] = _product(columns[column], residuals)
            before = size
            size = _join(gradient, now * penalties + allowed, within, active, size)
            if size == before:
                break
        found[step] = coefficient
        intercepts[step] = intercept
    return found, intercepts


@kernel()
def _join(
    gradient: FloatArray,
    limits: FloatArray,
    within: npt.NDArray[np.bool_],
    active: npt.NDArray[np.int64],
    size: int,
) -> int:
    """Add columns to the ``size`` active ones whose slope is above their limit; returns how many there are then."""
    for column in range(len(gradient)):
        if not within[column] and abs(gradient[column]) > limits[column]:
            within[column] = True
            active[size] = column
            size += 1
    return size


@kernel(error_model="numpy", fastmath=_SUMS, inline="always")
def _product(one: FloatArray, other: FloatArray) -> float:
    total = 0.0
    for row in range(len(other)):
        total += one[row] * other[row]
    return total
