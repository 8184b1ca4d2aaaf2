"""What seeds, held-out shapes and random labels tell."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import vstack

from shapeviz_report.quality import neighbour_weights, score
from shapeviz_report.search.certainty import (
    best_by_chance,
    compare_spreads,
    deal_folds,
    measure_gain,
    seen_scores,
)
from shapeviz_report.types import HeldOutFold


def test_equal_subsets_are_not_told_apart_and_worse_ones_are() -> None:
    random = np.random.default_rng(0)
    good = random.binomial(10, 0.9, (10, 200)) / 10
    alike = random.binomial(10, 0.9, (10, 200)) / 10
    worse = random.binomial(10, 0.7, (10, 200)) / 10
    spreads = compare_spreads([("worse",), ("good",), ("alike",)], np.array([worse, good, alike]))
    assert [s.features for s in spreads][-1] == ("worse",)
    assert [s.told_apart for s in spreads] == [False, False, True]
    assert spreads[0].behind == spreads[0].margin == 0
    assert spreads[2].mean == pytest.approx(worse.mean())
    assert spreads[2].std == pytest.approx(worse.mean(axis=1).std(ddof=1))


def test_a_lead_that_a_few_shapes_make_is_not_told_apart() -> None:
    # The same with every seed, so seeds alone would call it certain.
    first, second = np.full((10, 30), 0.5), np.full((10, 30), 0.5)
    first[:, 0] = 1.0
    spreads = compare_spreads([("first",), ("second",)], np.array([first, second]))
    assert spreads[1].behind == pytest.approx(0.5 / 30)
    assert not spreads[1].told_apart


def test_folds_share_out_every_class() -> None:
    codes = np.array([0] * 20 + [1] * 10 + [-1] * 5 + [2] * 3)
    folds = deal_folds(codes, 0)
    dealt = np.concatenate(folds)
    assert sorted(dealt) == [i for i in range(38) if codes[i] >= 0]
    for fold in folds:
        assert (codes[fold] == 0).sum() == 4
        assert (codes[fold] == 1).sum() == 2


def test_seen_scores_ignore_what_is_held_out() -> None:
    line = np.array([[0.0, 0], [1, 0], [2.1, 0], [3.3, 0]])
    weights = neighbour_weights(line, 2)
    codes = np.array([0, 0, 1, 0])
    # Of 0: 1 is a hit; of 1: 0 is a hit; of 3: only 1 is seen, a hit. Shape 2 is unseen.
    assert seen_scores(weights, codes, np.array([2])).tolist() == [1]
    other = codes.copy()
    other[2] = 0
    assert seen_scores(weights, other, np.array([2])).tolist() == [1]
    assert seen_scores(weights, codes, np.array([], dtype=int)) == pytest.approx([1.5 / 4])


def test_the_best_by_chance_exceeds_the_mean_by_chance() -> None:
    random = np.random.default_rng(0)
    maps = [random.random((60, 2)) for _ in range(20)]
    codes = np.repeat(np.arange(3), 20)
    weights = vstack([neighbour_weights(xy, 10) for xy in maps], format="csr")
    best = best_by_chance(weights, codes, 0)
    single = score(maps[0], [f"class {c}" for c in codes])
    assert (np.diff(best) >= 0).all()
    assert single.null_mean + single.null_std < best.mean() < single.null_mean + 5 * single.null_std
    assert best_by_chance(vstack([weights[:60]], format="csr"), codes, 0).mean() == pytest.approx(
        single.null_mean, abs=0.01
    )


def folds_of(*deals: list[tuple[int, float]]) -> list[HeldOutFold]:
    """Folds of some shapes with a gain, by deal."""
    return [
        HeldOutFold(number, 0, ("F",), shapes, 0.9, 0.5 + gain, 0.5, 1.0)
        for number, folds in enumerate(deals, start=1)
        for shapes, gain in folds
    ]


def test_a_gain_by_hand() -> None:
    gain = measure_gain(folds_of([(30, 0.1), (10, 0.3)], [(20, 0.0), (20, 0.1)]))
    # Deals of 0.15 and 0.05; each shape counts once a deal.
    assert gain.mean == pytest.approx(0.1)
    assert gain.deals == 2
    by_fold = np.std([0.1, 0.3, 0.0, 0.1], ddof=1) / np.sqrt(2)
    assert gain.spread == pytest.approx(max(by_fold, np.std([0.15, 0.05], ddof=1)))
    assert gain.is_sure == (gain.mean > gain.spread)


def test_a_gain_within_its_spread_is_none() -> None:
    assert not measure_gain(folds_of([(10, 0.2), (10, -0.1)])).is_sure
    assert measure_gain(folds_of([(10, 0.2), (10, 0.21)])).is_sure
    assert measure_gain(folds_of([(10, -0.2), (10, -0.21)])).is_sure
    # Folds of a deal that agree say nothing of deals that do not.
    assert not measure_gain(folds_of([(10, 0.1)] * 5, [(10, -0.09)] * 5)).is_sure
    alone = measure_gain(folds_of([(3, 0.2)]))
    assert alone.spread is None
    assert not alone.is_sure


def test_the_spread_covers_what_another_deal_gives() -> None:
    """Gains that chance makes: a single deal lies within two spreads of the mean of others nearly always."""
    random = np.random.default_rng(0)
    covered = 0
    for _ in range(200):
        noise = random.normal(0.02, 0.05, (20, 5)) + random.normal(0, 0.01, (20, 1))
        first = measure_gain(folds_of(*[[(20, g) for g in row] for row in noise[:10]]))
        covered += abs(noise[10].mean() - first.mean) < 2 * first.spread
    assert covered > 180
