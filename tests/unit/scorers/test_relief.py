"""Iterative Relief: by its equations, and what it is for: bins that separate together."""

from __future__ import annotations

import numpy as np
import pytest

from shapeviz_report.scorers.anova import ANOVA
from shapeviz_report.scorers.relief import KERNEL, RELIEF, ROWS, SETTLED


def next_weights(weights: np.ndarray, values: np.ndarray, positive: np.ndarray) -> np.ndarray:
    """The docstring's sums, one row at a time."""
    values = (values - values.min(axis=0)) / np.ptp(values, axis=0)
    count, width = values.shape
    apart = np.abs(values[:, None] - values)
    distances = apart @ weights
    nearness = np.exp(-distances / (KERNEL * distances.sum() / (count * (count - 1))))
    total = np.zeros(width)
    for n in range(count):
        hits = np.flatnonzero((positive == positive[n]) & (np.arange(count) != n))
        misses = np.flatnonzero(positive != positive[n])
        hit, miss = nearness[n, hits], nearness[n, misses]
        no_outlier = hit.mean() / (hit.mean() + miss.mean())
        margin = miss / miss.sum() @ apart[n, misses] - hit / hit.sum() @ apart[n, hits]
        total += no_outlier * margin / (positive == positive[n]).sum()
    total = np.maximum(total, 0)
    return total / np.linalg.norm(total)


@pytest.mark.parametrize("seed", range(4))
def test_the_equations_give_the_weights_back(seed) -> None:
    random = np.random.default_rng(seed)
    values, positive = random.random((25, 9)), np.arange(25) < 8
    values[:, :3] += 0.4 * positive[:, None]
    weights = RELIEF.score(values, positive)
    assert np.linalg.norm(next_weights(weights, values, positive) - weights) < 1.01 * SETTLED
    assert np.linalg.norm(weights - 1 / 3) > 0.1


def test_columns_that_separate_only_together() -> None:
    # Exclusive or: the means agree in every column, the neighbours tell the first two.
    random = np.random.default_rng(0)
    values = random.random((200, 6))
    positive = (values[:, 0] > 0.5) != (values[:, 1] > 0.5)
    scores = RELIEF.score(values, positive)
    assert set(np.argsort(-scores)[:2]) == {0, 1}
    assert scores[:2].min() > 3 * scores[2:].max()
    # They need each other equally, and do not take turns.
    assert scores[0] == pytest.approx(scores[1], rel=0.2)
    assert set(np.argsort(-ANOVA.score(values, positive))[:2]) != {0, 1}


def test_no_unit_matters() -> None:
    random = np.random.default_rng(1)
    values, positive = random.random((30, 5)), np.arange(30) < 10
    other_units = values * [1, 1000, 0.01, 3, 1] + [0, 5, -7, 0, 1]
    assert RELIEF.score(other_units, positive) == pytest.approx(RELIEF.score(values, positive), abs=1e-4)


def test_the_larger_group_does_not_count_more() -> None:
    random = np.random.default_rng(2)
    values, positive = random.random((60, 5)), np.arange(60) < 10
    values[:, 0] += positive
    assert RELIEF.score(values, positive) == pytest.approx(RELIEF.score(values, ~positive), abs=1e-6)


def test_more_rows_than_are_compared() -> None:
    random = np.random.default_rng(4)
    count = 3 * ROWS
    values, positive = random.random((count, 5)), np.arange(count) < 30
    values[:, 2] += positive
    scores = RELIEF.score(values, positive)
    order = random.permutation(count)
    assert np.argmax(scores) == 2
    assert RELIEF.score(values[order], positive[order]) == pytest.approx(scores, abs=1e-5)


def test_length() -> None:
    random = np.random.default_rng(3)
    scores = RELIEF.score(random.random((20, 7)), np.arange(20) < 9)
    assert (scores**2).sum() == pytest.approx(1)
