"""Contests between groups, and relative scores."""

from __future__ import annotations

import numpy as np
import pytest

from shapeviz_report.scorers import Contest, as_one_group, each_from_each, score_separation
from shapeviz_report.scorers.anova import ANOVA

LABELS = ["ant", "bird", None, "ant", "cup", "bird"]


def listed(contests: list[Contest]) -> list[tuple[list[int], list[int]]]:
    return [(contest.positive.tolist(), contest.negative.tolist()) for contest in contests]


def test_the_rest_is_every_other_class() -> None:
    assert listed(as_one_group(LABELS, ["ant"])) == [([0, 3], [1, 4, 5])]
    assert listed(as_one_group(LABELS, ["bird", "ant"])) == [([0, 1, 3, 5], [4])]


def test_group_against_group() -> None:
    assert listed(as_one_group(LABELS, ["ant"], ["cup"])) == [([0, 3], [4])]
    assert listed(as_one_group(LABELS, ["ant"], ["cup", "bird"])) == [([0, 3], [1, 4, 5])]


def test_each_from_each() -> None:
    assert listed(each_from_each(LABELS, ["ant"])) == [([0, 3], [1, 5]), ([0, 3], [4])]
    everything = ["cup", "bird", "ant"]
    assert listed(each_from_each(LABELS, everything, everything)) == [
        ([0, 3], [1, 5]),
        ([0, 3], [4]),
        ([1, 5], [4]),
    ]


@pytest.mark.parametrize("group", [(["ant"], ["ant"]), (["dog"], None), (["ant"], ["dog"])])
def test_groups_that_cannot_be(group) -> None:
    with pytest.raises(ValueError, match="group"):
        as_one_group(LABELS, *group)


def test_every_contest_counts_equally() -> None:
    # Column 0 separates ants from birds a little, column 1 ants from cups very well; column 2 is constant.
    values = np.array([[1, 1, 1], [2, 5, 1], [9, 9, 1], [0, 0, 1], [0.6, 99, 1], [1, 3, 1]], dtype=float)
    contests = each_from_each(LABELS, ["ant"])
    scores = score_separation(ANOVA, values, contests)
    single = [score_separation(ANOVA, values, [contest]) for contest in contests]
    assert [s.max() for s in single] == [1, 1]
    assert scores == pytest.approx((single[0] + single[1]) / 2)
    assert scores[2] == 0


def test_nothing_separates() -> None:
    assert score_separation(ANOVA, np.ones((6, 2)), as_one_group(LABELS, ["ant"])).tolist() == [0, 0]


def test_no_contest() -> None:
    with pytest.raises(ValueError, match="no contest"):
        score_separation(ANOVA, np.ones((6, 2)), each_from_each(["ant", None], ["ant"]))
