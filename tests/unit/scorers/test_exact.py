"""Chi-squared and ANOVA F: against scikit-learn, by hand, and where scikit-learn has no answer."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.feature_selection import chi2, f_classif

from shapeviz_report.scorers.anova import ANOVA
from shapeviz_report.scorers.chi2 import CHI2


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6), st.integers(2, 20), st.integers(2, 40))
def test_against_scikit_learn(seed, first, second) -> None:
    random = np.random.default_rng(seed)
    positive = np.arange(first + second) < first
    # scikit-learn loses digits where a column's spread is small beside its values.
    values = random.random((first + second, 12)) * random.uniform(0.01, 1, 12)
    assert pytest.approx(chi2(values, positive)[0], rel=1e-9) == CHI2.score(values, positive)
    assert pytest.approx(f_classif(values, positive)[0], rel=1e-6) == ANOVA.score(values, positive)


def test_chi2_by_hand() -> None:
    # 8 of 10 where 5 were expected, in either group: 9/5 + 9/5.
    values = np.array([[5.0], [3.0], [2.0], [0.0]])
    assert CHI2.score(values, np.array([True, True, False, False])) == pytest.approx([3.6])


def test_chi2_of_negative_values_is_that_of_the_shifted_ones() -> None:
    values = np.random.default_rng(0).normal(size=(20, 5))
    positive = np.arange(20) < 7
    assert pytest.approx(chi2(values - values.min(axis=0), positive)[0]) == CHI2.score(values, positive)


def test_anova_by_hand() -> None:
    # Means 1 and 4, squares within 2 + 2, between 4 * 9 / 4.
    values = np.array([[0.0], [2.0], [3.0], [5.0]])
    assert ANOVA.score(values, np.array([True, True, False, False])) == pytest.approx([2 * 9 / 4])


def test_anova_without_spread_ranks_by_distance() -> None:
    values = np.array([[0.1, 0.2, 0.0], [0.1, 0.2, 0.4], [0.5, 0.9, 0.5], [0.5, 0.9, 0.9]])
    near, far, usual = ANOVA.score(values, np.array([True, True, False, False]))
    assert np.isfinite(far)
    assert far > near > 1e6 > usual
