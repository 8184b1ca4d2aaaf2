"""The browser's scorers give the scores that Python's give."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.stats import spearmanr
from scorer_groups import read_groups

from shapeviz_report.scorers import SCORERS, Contest, score_separation
from shapeviz_report.writing.joiner import join

TOLERANCE = {scorer.name: 1e-8 for scorer in SCORERS} | {"relief": 1e-4}
"""Of relative scores. Relief adds up in single precision in Python."""

methods = pytest.mark.parametrize("scorer", SCORERS, ids=lambda s: s.name)


def scores(page, scorer, contests, columns, seed=0) -> np.ndarray:
    contests = [
        {"positive": np.array(positive), "negative": np.array(negative)} for positive, negative in contests
    ]
    answer = page.run("score", method=scorer.name, contests=contests, columns=np.array(columns), seed=seed)
    return answer["scores"]


def histograms(rows: int = 60, columns: int = 200) -> np.ndarray:
    """Roots of fractions, of which a third of the rows has its own kind."""
    random = np.random.default_rng(8)
    values = random.dirichlet(np.full(10, 0.5), (rows, columns // 10)).reshape(rows, columns)
    values[: rows // 3, ::4] *= np.linspace(0.2, 1, len(values[0, ::4]))
    return np.sqrt(values).astype(np.float32).astype(np.float64)


@methods
@pytest.mark.parametrize("group", read_groups(), ids=lambda g: g["name"])
def test_as_python(engine_page, scorer, group) -> None:
    rows, columns = group["values"].shape
    engine_page.start(group["values"])
    negative = np.setdiff1d(np.arange(rows), group["positive"])
    found = scores(engine_page, scorer, [(group["positive"], negative)], range(columns), group["seed"])
    np.testing.assert_allclose(found, group["scores"][scorer.name], rtol=0, atol=TOLERANCE[scorer.name])


@methods
def test_the_same_columns_rank_highest(engine_page, scorer) -> None:
    # Methods that draw random numbers see the rows and columns in another order here than in Python.
    values = histograms()
    engine_page.start(values)
    positive, negative = np.arange(20), np.arange(20, 60)
    found = scores(engine_page, scorer, [(positive, negative)], range(200))
    expected = score_separation(scorer, values, [Contest(positive, negative)])
    top = [set(np.argsort(-one, kind="stable")[:30]) for one in (found, expected)]
    if scorer.exact:
        np.testing.assert_allclose(found, expected, rtol=0, atol=TOLERANCE[scorer.name])
    assert len(top[0] & top[1]) >= 25
    # Most columns say nothing, so their order is a matter of chance.
    assert spearmanr(found, expected).statistic > 0.75


@methods
def test_contests_count_equally_whatever_the_order_of_rows(engine_page, scorer) -> None:
    engine_page.start(histograms(columns=40))
    columns = range(1, 40, 2)
    first, second = (range(20), range(20, 60)), (range(20, 30), range(30, 60))
    both = scores(engine_page, scorer, [first, second], columns)
    single = [scores(engine_page, scorer, [contest], columns) for contest in (first, second)]
    assert [one.max() for one in single] == [1, 1]
    np.testing.assert_allclose(both, (single[0] + single[1]) / 2, atol=1e-12)
    backwards = [(list(positive)[::-1], list(negative)[::-1]) for positive, negative in (first, second)]
    assert np.array_equal(scores(engine_page, scorer, backwards, columns), both)


@methods
def test_nothing_varies(engine_page, scorer) -> None:
    values = histograms(rows=9, columns=10)
    values[:6] = values[0]
    engine_page.start(values)
    assert scores(engine_page, scorer, [(range(3), range(3, 6))], range(10)).tolist() == [0] * 10


@methods
def test_progress_rises_in_small_steps(engine_page, scorer) -> None:
    values = histograms(columns=300)
    engine_page.page.evaluate(join(Path(__file__).parent / "scoring.js"))
    contest = {"positive": list(range(20)), "negative": list(range(20, 60))}
    answer = engine_page.page.evaluate(
        "([table, parameters]) => walkScore(table, parameters)",
        [
            {"values": values.T.ravel().tolist(), "rows": 60, "columns": 300},
            {"method": scorer.name, "contests": [contest] * 2, "columns": list(range(300)), "seed": 0},
        ],
    )
    progress = np.array(answer["progress"])
    assert np.all(np.diff(progress) >= 0)
    assert progress[-1] == 1
    # A reader who cancels does not wait for a whole contest.
    assert len(progress) >= 4
