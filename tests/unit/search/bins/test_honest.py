"""Selections on shapes that had no say in them, and on labels that mean nothing."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.projections import squared_distances
from shapeviz_report.search.bins import encode, hold_out, shuffle_labels
from shapeviz_report.search.bins.bin_space import hits_on, lay_out
from shapeviz_report.search.bins.honest import MAP_SEEDS, affordable_deals, recognise
from shapeviz_report.search.certainty import deal_folds
from shapeviz_report.types import HeldOutBins

LIMIT = 6
"""Twice what is needed; a climb among more would make more maps."""


@pytest.fixture(scope="module")
def everything(planted) -> np.ndarray:
    """Squared distances by all features."""
    return squared_distances(scale(planted.table, PRESETS["default"])[planted.space.rows])


def folds_of(planted, labels, everything) -> list[HeldOutBins]:
    folds = deal_folds(encode(planted.space, labels)[1], 0)
    return [hold_out(planted.space, labels, fold, everything, limit=LIMIT) for fold in folds]


@pytest.mark.slow
def test_what_is_real_holds_on_held_out_shapes(planted, everything) -> None:
    folds = folds_of(planted, planted.labels, everything)
    assert sum(fold.shapes for fold in folds) == 48
    assert np.mean([fold.knn_accuracy for fold in folds]) > 0.95
    assert np.mean([fold.nh_space for fold in folds]) > 0.9
    assert np.mean([fold.nh_s for fold in folds]) > 0.9
    # All shapes in turn are scored on the same maps of all features.
    codes = encode(planted.space, planted.labels)[1]
    alone = np.mean([hits_on(lay_out(everything, seed), codes, 10).mean() for seed in range(MAP_SEEDS)])
    assert np.average(
        [fold.nh_s_all for fold in folds], weights=[fold.shapes for fold in folds]
    ) == pytest.approx(alone)


@pytest.mark.slow
def test_labels_without_meaning_are_not_found_again(planted, everything) -> None:
    labels = shuffle_labels(planted.space, planted.labels, 0)
    folds = folds_of(planted, labels, everything)
    # By chance 11 of 47 neighbours are hits, and every fourth guess.
    assert np.mean([fold.nh_s for fold in folds]) == pytest.approx(11 / 47, abs=0.1)
    assert np.mean([fold.knn_accuracy for fold in folds]) == pytest.approx(1 / 4, abs=0.2)
    # Although the selection fitted those it saw.
    assert np.mean([fold.nh_s_seen for fold in folds]) > np.mean([fold.nh_s for fold in folds]) + 0.05


def test_labels_of_held_out_shapes_do_not_choose(planted, everything) -> None:
    fold = deal_folds(encode(planted.space, planted.labels)[1], 0)[0]
    labels = list(planted.labels)
    for row in planted.space.rows[fold]:
        labels[row] = "ant"
    assert (
        hold_out(planted.space, labels, fold, everything, limit=LIMIT).bins
        == hold_out(planted.space, planted.labels, fold, everything, limit=LIMIT).bins
    )


def test_votes_and_ties_are_shared() -> None:
    line = np.array([0.0, 1, -1, 5, 6])[:, None]
    squared = (line - line.T) ** 2
    fold = np.array([0])
    assert recognise(squared, np.array([0, 0, 0, 1, 1]), fold, 3) == 1
    # One neighbour of each class, equally near.
    assert recognise(squared, np.array([0, 0, 1, 1, 1]), fold, 2) == 0.5
    assert recognise(squared, np.array([0, 0, 1, 1, 1]), fold, 1) == 0.5
    assert recognise(squared, np.array([0, -1, 1, 0, 0]), fold, 1) == 0


def test_shuffled_labels_keep_the_classes_and_forget_the_shapes(planted) -> None:
    labels = [None, *planted.labels[1:]]
    shuffled = shuffle_labels(planted.space, labels, 3)
    assert shuffled[0] is None
    assert Counter(shuffled) == Counter(labels)
    assert np.mean([a == b for a, b in zip(shuffled[1:], labels[1:])]) < 0.5
    swapped = [None, *reversed(planted.labels[1:])]
    assert Counter(swapped) == Counter(labels)
    assert shuffle_labels(planted.space, swapped, 3) == shuffled


def test_few_shapes_are_dealt_more_often() -> None:
    deals = [affordable_deals(count) for count in (0, 4, 60, 112, 168, 280, 500)]
    assert deals == [10, 10, 10, 4, 2, 1, 1]
