"""Randomised logistic regression: its optimum against scikit-learn's, and what stability selection is for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import expit
from scipy.stats import spearmanr
from sklearn.linear_model import LogisticRegression

from shapeviz_report.scorers.balance import balanced_weights, standardise
from shapeviz_report.scorers.kernels import stability
from shapeviz_report.scorers.logistic import LOGISTIC, STRENGTHS


def groups(
    seed: int = 0, first: int = 20, second: int = 40, width: int = 60
) -> tuple[np.ndarray, np.ndarray]:
    """Values of which the first five columns separate the groups."""
    random = np.random.default_rng(seed)
    positive = np.arange(first + second) < first
    values = random.normal(size=(first + second, width))
    values[:, :5] += 2 * positive[:, None]
    return values, positive


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6), st.integers(1, 12), st.integers(1, 25), st.integers(5, 40))
def test_conditions_of_the_optimum(seed, first, second, width) -> None:
    """The slope of the loss is the penalty where there is a coefficient, and no more where there is none."""
    values, positive = groups(seed, first, second, width)
    weights = balanced_weights(positive)
    values = standardise(values, weights)
    penalties = np.random.default_rng(seed).uniform(1, 2, width)
    columns = np.ascontiguousarray(values.T)
    found, intercepts = stability.follow_path(columns, first, penalties, STRENGTHS, 1e-9)
    highest = (np.abs((weights * (positive - 0.5)) @ values) / penalties).max()
    for strength, coefficients, intercept in zip(STRENGTHS * highest, found, intercepts):
        residuals = weights * (positive - expit(values @ coefficients + intercept))
        slopes = residuals @ values / penalties / strength
        assert residuals.sum() == pytest.approx(0, abs=1e-8)
        assert slopes[coefficients != 0] == pytest.approx(np.sign(coefficients[coefficients != 0]), abs=1e-6)
        assert np.abs(slopes).max() < 1 + 1e-6


def test_optimum_of_scikit_learn() -> None:
    values, positive = groups()
    weights = balanced_weights(positive)
    values = standardise(values, weights)
    penalties = np.random.default_rng(0).uniform(1, 2, values.shape[1])
    found, _ = stability.follow_path(np.ascontiguousarray(values.T), 20, penalties, STRENGTHS, 1e-9)
    highest = (np.abs((weights * (positive - 0.5)) @ values) / penalties).max()
    for step in (2, len(STRENGTHS) - 1):
        # liblinear penalises the intercept too; the larger the column for it, the less.
        theirs = LogisticRegression(
            C=1 / (STRENGTHS[step] * highest),
            l1_ratio=1,
            solver="liblinear",
            intercept_scaling=1e3,
            tol=1e-7,
            max_iter=10000,
        ).fit(values / penalties, positive, sample_weight=weights)
        assert found[step] == pytest.approx(theirs.coef_[0] / penalties, abs=1e-3)
        assert np.array_equal(found[step] != 0, theirs.coef_[0] != 0)


def test_with_the_weakest_penalties_first_columns_enter_by_their_slopes() -> None:
    values, positive = groups()
    values = standardise(values, balanced_weights(positive))
    slopes = np.abs((balanced_weights(positive) * np.where(positive, 1, -1)) @ values)
    best = slopes.argmax()
    second = np.sort(slopes)[-2] / slopes[best]
    strengths = np.array([(1 + second) / 2])
    found, _ = stability.follow_path(np.ascontiguousarray(values.T), 20, np.ones(60), strengths, 1e-6)
    assert np.flatnonzero(found[0]).tolist() == [best]


def test_what_separates_is_selected_and_noise_is_not() -> None:
    values, positive = groups()
    scores = LOGISTIC.score(values, positive)
    assert set(np.argsort(-scores)[:5]) == set(range(5))
    assert scores[5:].mean() < 0.05 < 0.5 < scores[:5].mean()
    assert ((scores >= 0) & (scores <= 1)).all()


def test_a_column_that_separates_alone_is_in_every_run() -> None:
    values = np.random.default_rng(0).normal(size=(30, 4)) / 100
    values[:10, 2] += 1
    scores = LOGISTIC.score(values, np.arange(30) < 10)
    assert scores[2] == 1
    assert np.delete(scores, 2).max() < 0.1


def test_equal_columns_share() -> None:
    values, positive = groups()
    doubled = LOGISTIC.score(np.column_stack([values, values[:, 0]]), positive)
    assert doubled[0] == doubled[60]
    assert doubled[0] < LOGISTIC.score(values, positive)[0]


def test_another_seed_draws_other_halves() -> None:
    values, positive = groups()
    first, second = LOGISTIC.score(values, positive), LOGISTIC.score(values, positive, seed=1)
    assert not np.array_equal(first, second)
    assert spearmanr(first[:5], second[:5]).statistic > 0.5
    assert second == pytest.approx(first, abs=0.12)


def test_both_halves_of_every_cut_are_runs() -> None:
    """Without random penalties, a column of even groups is in one half of each cut or in both."""
    values = np.zeros((1, 8))
    values[0, 0] = 1.0  # one row of the first group differs: it is in exactly one half
    counts = stability.selections(values, 4, 10, 9, np.array([0.5]), 1.0, 1e-6, 0)
    assert counts.tolist() == [10]


def test_of_a_large_group_a_run_has_fewer_rows() -> None:
    values = np.zeros((1, 80))
    values[0, 0] = 1.0
    counts = stability.selections(values, 40, 400, 5, np.array([0.5]), 1.0, 1e-6, 0)
    # 5 of 40 rows in each of 800 runs: the one that differs is in 100 of them.
    assert counts[0] == pytest.approx(100, abs=30)
