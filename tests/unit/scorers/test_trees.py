"""Randomised trees: against scikit-learn's, by hand, and how far a seed changes them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import spearmanr
from sklearn.ensemble import ExtraTreesClassifier

from shapeviz_report.scorers.trees import COUNT, TREES


def groups(seed: int = 0, count: int = 60, width: int = 40) -> tuple[np.ndarray, np.ndarray]:
    """Values of which the first columns separate the groups, the more the earlier."""
    random = np.random.default_rng(seed)
    positive = np.arange(count) < count // 3
    shift = np.maximum(2 - np.arange(width) / 6, 0)
    return random.normal(size=(count, width)) + positive[:, None] * shift, positive


@pytest.mark.slow
def test_as_scikit_learn() -> None:
    values, positive = groups()
    ours = TREES.score(values, positive)
    theirs = ExtraTreesClassifier(COUNT, random_state=0).fit(values, positive).feature_importances_
    assert ours.sum() == pytest.approx(1)
    # Two runs of either differ as much.
    assert spearmanr(ours, theirs).statistic > 0.95
    assert ours == pytest.approx(theirs, abs=0.01)
    assert set(np.argsort(-ours)[:5]) == set(np.argsort(-theirs)[:5])


def test_a_column_that_separates_alone_has_all() -> None:
    values = np.zeros((12, 3))
    values[:4, 1] = 1
    assert TREES.score(values, np.arange(12) < 4) == pytest.approx([0, 1, 0])


def test_equal_columns_share() -> None:
    values, positive = groups(width=9)
    doubled = TREES.score(np.column_stack([values, values[:, 0]]), positive)
    assert doubled[0] == doubled[9]
    assert doubled[0] < TREES.score(values, positive)[0]


def test_another_seed_draws_other_trees() -> None:
    values, positive = groups()
    first, second = TREES.score(values, positive), TREES.score(values, positive, seed=1)
    assert not np.array_equal(first, second)
    assert second == pytest.approx(first, abs=0.01)


def test_groups_that_no_cut_can_tell_apart() -> None:
    # Two values, each as often in one group as in the other.
    values = np.array([[0.0], [1.0], [0.0], [1.0]])
    assert TREES.score(values, np.array([True, True, False, False])) == pytest.approx([0])
