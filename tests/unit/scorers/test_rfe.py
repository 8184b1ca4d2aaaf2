"""Recursive elimination: against scikit-learn's, by hand, and columns that cannot be told apart."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.base import BaseEstimator
from sklearn.feature_selection import RFE as Elimination
from sklearn.linear_model import RidgeClassifier

from shapeviz_report.scorers.balance import balanced_weights, standardise
from shapeviz_report.scorers.rfe import ONE_BY_ONE, PENALTY, RFE, SHARE, coefficients


class Classifier(BaseEstimator):
    """scikit-learn's, with the penalty that we use for so many rows and columns."""

    def fit(self, values, positive):
        # Its balanced weights add up to the number of rows, ours to 1.
        self.coef_ = (
            RidgeClassifier(alpha=PENALTY * values.shape[1], class_weight="balanced")
            .fit(values, positive)
            .coef_
        )
        return self


def groups(seed: int, first: int, second: int, width: int) -> tuple[np.ndarray, np.ndarray]:
    """Values in no particular order whose columns hang together, and separate the groups more or less."""
    random = np.random.default_rng(seed)
    positive = random.permutation(first + second) < first
    values = random.normal(size=(first + second, width)) @ random.normal(size=(width, width))
    return values + positive[:, None] * random.exponential(2, width), positive


def ranking_of(scores: np.ndarray) -> list[int]:
    """1 for the column that left last, as scikit-learn has it."""
    return (len(scores) + 1 - np.rint(scores * len(scores))).astype(int).tolist()


@pytest.mark.slow
@settings(max_examples=10, deadline=None)
@given(st.integers(0, 10**6), st.integers(3, 20), st.integers(3, 40), st.integers(2, ONE_BY_ONE))
def test_as_scikit_learn_one_by_one(seed, first, second, width) -> None:
    values, positive = groups(seed, first, second, width)
    scaled = standardise(values, balanced_weights(positive))
    theirs = Elimination(Classifier(), n_features_to_select=1, step=1).fit(scaled, positive)
    assert ranking_of(RFE.score(values, positive)) == theirs.ranking_.tolist()


def test_as_scikit_learn_by_shares() -> None:
    values, positive = groups(3, 9, 21, 150)
    places = np.rint(RFE.score(values, positive) * 150)
    left = np.arange(150)
    while len(left) > ONE_BY_ONE:
        leaving = int(SHARE * len(left))
        scaled = standardise(values[:, left], balanced_weights(positive))
        round_ = Elimination(Classifier(), n_features_to_select=len(left) - leaving, step=leaving)
        stays = round_.fit(scaled, positive).support_
        assert sorted(places[left[~stays]]) == list(range(151 - len(left), 151 - len(left) + leaving))
        left = left[stays]


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6), st.integers(2, 30), st.integers(1, 30), st.floats(1e-3, 1e3))
def test_both_systems_of_equations_have_the_optimum(seed, count, width, penalty) -> None:
    random = np.random.default_rng(seed)
    columns, target = random.normal(size=(count, width)), random.normal(size=count)
    found = coefficients(columns, target, penalty)
    gradient = columns.T @ (columns @ found - target) + penalty * found
    assert gradient == pytest.approx(np.zeros(width), abs=1e-9 * np.abs(columns.T @ target).max() + 1e-12)


def test_a_column_that_only_helps_another_stays() -> None:
    """What no score of single columns can see: the second is the noise of the first."""
    random = np.random.default_rng(0)
    positive = np.arange(400) < 160
    noise = random.normal(size=400)
    values = random.normal(size=(400, 30))
    values[:, 0] = 2 * positive + noise
    values[:, 1] = noise
    assert set(np.argsort(-RFE.score(values, positive))[:2]) == {0, 1}


def test_copies_leave_together() -> None:
    values, positive = groups(1, 10, 14, 70)
    copied = np.column_stack([values, 2 * values[:, :5] + 1])
    order = np.random.default_rng(0).permutation(75)
    scores = np.empty(75)
    scores[order] = RFE.score(copied[:, order], positive)
    assert scores[:5] == pytest.approx(scores[70:], abs=0)
    assert scores == pytest.approx(RFE.score(copied, positive), abs=0)
    assert scores.sum() * 75 == pytest.approx(75 * 76 / 2)


def test_without_any_difference_all_are_equal() -> None:
    values = np.array([[0.0, 1.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]])
    assert RFE.score(values, np.array([True, True, False, False])) == pytest.approx([0.75, 0.75])
