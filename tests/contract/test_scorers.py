"""What every scorer must bring along, in Python and in the browser."""

from __future__ import annotations

import inspect
import json
from pathlib import Path

import numpy as np
import pytest

from shapeviz_report import scorers
from shapeviz_report.scorers import SCORERS, Contest, score_separation

from .test_registries import modules_of

ROOT = Path(__file__).parents[2]
ENGINE = ROOT / "site" / "scripts" / "engine"
GROUPS = ROOT / "tests" / "fixtures" / "scorers.json"
DOCS = (ROOT / "docs" / "method" / "scorers.md").read_text(encoding="utf-8")

every_scorer = pytest.mark.parametrize("scorer", SCORERS, ids=lambda s: s.name)


def groups(count: int = 30, width: int = 12) -> tuple[np.ndarray, np.ndarray]:
    """Values of which column 0 separates a third of the rows from the others; column 1 is constant."""
    random = np.random.default_rng(3)
    values, positive = random.random((count, width)), np.arange(count) < count // 3
    values[:, 0] += positive
    values[:, 1] = 0.5
    return values, positive


@every_scorer
def test_described(scorer) -> None:
    file = inspect.getmodule(scorer.measure).__name__.rpartition(".")[2]
    where = f"scorers/{file}.py"
    assert file == scorer.name, f"{where} holds the scorer {scorer.name!r}: call them alike"
    assert "Returns" in (inspect.getdoc(scorer.measure) or ""), f"{where}: say what `measure` returns"
    for end in (scorer.explanation.startswith("High"), scorer.explanation.endswith(".")):
        assert end, f"{where}: `explanation` says in a sentence what high values mean: 'High ... .'"
    assert f"## {scorer.title}" in DOCS, f"write a section '## {scorer.title}' in docs/method/scorers.md"
    assert scorer.source in DOCS, f"name the source in docs/method/scorers.md: {scorer.source}"


def test_one_file_a_scorer_and_the_same_in_the_browser() -> None:
    names = [scorer.name for scorer in SCORERS]
    for name in sorted(set(names) ^ (modules_of(scorers) - {"balance", "base", "registry", "separation"})):
        pytest.fail(f"scorers/{name}.py holds the Scorer of that name in SCORERS of scorers/__init__.py")
    for name in sorted(set(names) ^ {path.stem.removeprefix("score-") for path in ENGINE.glob("score-*.js")}):
        pytest.fail(f"site/scripts/engine/score-{name}.js takes the same steps as scorers/{name}.py")
    for group in json.loads(GROUPS.read_text(encoding="utf-8")):
        assert list(group["scores"]) == names, (
            "run `python tests/scorer_groups.py`: the browser is held to its scores"
        )
    task = (ENGINE / "scoring.js").read_text(encoding="utf-8")
    for name in names:
        assert f'["{name}", scoreBy' in task, f"name {name!r} in METHODS of site/scripts/engine/scoring.js"


@every_scorer
def test_what_separates_scores_highest_and_a_constant_column_nothing(scorer) -> None:
    values, positive = groups()
    scores = scorer.score(values, positive)
    assert scores.shape == (values.shape[1],)
    assert scores.dtype == np.float64
    assert np.argmax(scores) == 0
    assert scores[1] == 0
    assert (scores >= 0).all()


@every_scorer
def test_deterministic_whatever_the_order(scorer) -> None:
    values, positive = groups()
    random = np.random.default_rng(0)
    rows, columns = random.permutation(len(values)), random.permutation(values.shape[1])
    scores = scorer.score(values, positive, seed=5)
    assert np.array_equal(scorer.score(values, positive, seed=5), scores)
    shuffled = scorer.score(values[np.ix_(rows, columns)], positive[rows], seed=5)
    assert shuffled == pytest.approx(scores[columns], rel=1e-6, abs=1e-9)


@every_scorer
@pytest.mark.parametrize("sizes", [(1, 1), (1, 2), (2, 1), (2, 2), (1, 20), (20, 1)], ids=str)
def test_tiny_groups(scorer, sizes) -> None:
    values = np.random.default_rng(1).random((sum(sizes), 6))
    values[:, 4] = 0
    scores = scorer.score(values, np.arange(sum(sizes)) < sizes[0])
    assert np.isfinite(scores).all()
    assert (scores >= 0).all()


@every_scorer
@pytest.mark.parametrize("width", [0, 1, 3])
def test_nothing_varies(scorer, width) -> None:
    values = np.full((8, width), 0.25)
    assert scorer.score(values, np.arange(8) < 3).tolist() == [0] * width


@every_scorer
@pytest.mark.parametrize("positive", [[True] * 4, [False] * 4, [True, False]], ids=str)
def test_groups_that_cannot_be(scorer, positive) -> None:
    with pytest.raises(ValueError, match="two groups"):
        scorer.score(np.random.default_rng(0).random((4, 2)), np.array(positive))


@every_scorer
def test_relative_scores(scorer) -> None:
    values, positive = groups()
    contest = Contest(np.flatnonzero(positive), np.flatnonzero(~positive))
    scores = score_separation(scorer, values, [contest], seed=1)
    assert scores.max() == 1
    raw = scorer.score(values, positive, seed=1)
    assert scores == pytest.approx(raw / raw.max())
