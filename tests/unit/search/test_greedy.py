"""Algorithm 1 on scores that are known: its path by hand, brute force, and what it counts."""

from __future__ import annotations

import numpy as np
import pytest

from shapeviz_report.search.greedy import climb


def scored(scores):
    return lambda subsets: [scores[subset] for subset in subsets]


def test_the_path_by_hand() -> None:
    # One feature: 2 is best alone; joined by 1 better; then 4 joins, and 2 has become a burden.
    scores = {1: 0.2, 2: 0.5, 4: 0.3, 3: 0.6, 6: 0.4, 7: 0.7, 5: 0.9}
    trace = climb(3, 1, scored(scores))
    assert trace.path == ((2, 0.5), (3, 0.6), (7, 0.7), (5, 0.9))
    assert trace.evaluated == {1, 2, 3, 4, 5, 6, 7}
    # 3 from nothing, 2 from one feature (without the way back to none), 3, 3, and 3 in vain.
    assert trace.considered == 3 + 2 + 3 + 3 + 3


def test_larger_changes_leave_a_local_optimum() -> None:
    scores = {1: 0.5, 2: 0.1, 3: 0.4, 4: 0.1, 5: 0.4, 6: 0.9, 7: 0.4}
    assert climb(3, 1, scored(scores)).path[-1] == (1, 0.5)
    assert climb(3, 2, scored(scores)).path[-1] == (6, 0.9)


@pytest.mark.parametrize("seed", range(20))
def test_all_changes_at_once_are_exhaustive(seed) -> None:
    scores = dict(enumerate(np.random.default_rng(seed).random(31), start=1))
    trace = climb(5, 5, scored(scores))
    assert trace.path[-1][0] == max(scores, key=scores.__getitem__)
    assert len(trace.evaluated) == 31


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("s", [1, 2])
def test_the_result_has_no_better_neighbour(seed, s) -> None:
    scores = dict(enumerate(np.random.default_rng(seed).random(63), start=1))
    trace = climb(6, s, scored(scores))
    result, value = trace.path[-1]
    assert [v for _, v in trace.path] == sorted(v for _, v in trace.path)
    near = [x for x in scores if 1 <= (x ^ result).bit_count() <= s]
    assert all(scores[x] <= value for x in near)
    assert {*near, result} <= trace.evaluated


def test_equal_scores_end_the_search_at_the_first_feature() -> None:
    trace = climb(4, 2, lambda subsets: [0.5] * len(subsets))
    assert trace.path == ((1, 0.5),)


def test_one_feature() -> None:
    assert climb(1, 1, scored({1: 0.3})).path == ((1, 0.3),)
