"""Measures of retrieval against their definitions, written down plainly, over every order that ties allow."""

from __future__ import annotations

from itertools import pairwise, permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.metrics import average_precision_score

from shapeviz_report.retrieval import (
    MEASURES,
    PAGE,
    RECALL_LEVELS,
    highest_e_measures,
    query_classes,
    rate,
    rate_chance,
    rate_subsets,
)

NAMES = [measure.name for measure in MEASURES]


def measures_of(hits: list[bool]) -> list[float]:
    """The six measures of one ranking without ties, as the benchmark defines them."""
    relevant, page = sum(hits), min(PAGE, len(hits))

    def recall(count: int) -> float:
        return sum(hits[:count]) / relevant

    both = sum(hits[:page]) / page, recall(page)
    gain = sum(hit / (np.log2(rank) if rank > 1 else 1) for rank, hit in enumerate(hits, start=1))
    ideal = sum(1 / (np.log2(rank) if rank > 1 else 1) for rank in range(1, relevant + 1))
    precisions = [sum(hits[:rank]) / rank for rank, hit in enumerate(hits, start=1) if hit]
    return [
        float(hits[0]),
        recall(relevant),
        recall(2 * relevant),
        0.0 if sum(both) == 0 else 2 * both[0] * both[1] / sum(both),
        gain / ideal,
        float(np.mean(precisions)),
    ]


def ranks_of(hits: list[bool]) -> list[int]:
    return [rank for rank, hit in enumerate(hits, start=1) if hit]


def curve_of(ranks: np.ndarray) -> list[float]:
    """Interpolated precision at each level, from the rank at which each relevant shape comes."""
    found = np.arange(1, len(ranks) + 1)
    precision, recall = found / ranks, found / len(ranks)
    return [precision[recall >= level - 1e-12].max() for level in RECALL_LEVELS]


def slow_rating(squared: np.ndarray, codes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The means over queries of each class, over every order of the shapes that agrees with the distances."""
    scores, curves = [], []
    for code in range(codes.max() + 1):
        own_scores, own_curves = [], []
        for query in np.flatnonzero(codes == code):
            others = [other for other in range(len(codes)) if other != query]
            orders = [
                order
                for order in permutations(others)
                if all(squared[query, one] <= squared[query, next_] for one, next_ in pairwise(order))
            ]
            hits = [[bool(codes[other] == code) for other in order] for order in orders]
            own_scores.append(np.mean([measures_of(ranking) for ranking in hits], axis=0))
            own_curves.append(curve_of(np.mean([ranks_of(ranking) for ranking in hits], axis=0)))
        scores.append(np.mean(own_scores, axis=0))
        curves.append(np.mean(own_curves, axis=0))
    return np.array(scores), np.array(curves)


def symmetric(values: np.ndarray) -> np.ndarray:
    return np.triu(values, 1) + np.triu(values, 1).T


@settings(max_examples=12, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([[0, 0, 1, 1], [0, 0, 0, 1, 1, -1], [0, 1, 0, 1, 0, 1]]),
    st.integers(1, 4),
)
def test_every_measure_is_its_definition_averaged_over_the_orders_of_ties(seed, codes, kinds) -> None:
    """Few kinds of distances make many ties."""
    codes = np.array(codes, np.int32)
    random = np.random.default_rng(seed)
    squared = symmetric(random.integers(0, kinds, (len(codes),) * 2).astype(float))
    scores, precision = slow_rating(squared, codes)
    found = rate(squared, codes)
    assert found.scores == pytest.approx(scores, abs=1e-12)
    assert found.precision == pytest.approx(precision, abs=1e-12)


def points(count: int, classes: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    codes = np.arange(count, dtype=np.int32) % classes
    values = random.normal(0, 1, (count, 5)) + 1.2 * random.normal(0, 1, (classes, 5))[codes]
    return ((values[:, None] - values) ** 2).sum(axis=2), codes


def test_without_ties_a_larger_database_agrees_with_the_definitions_and_with_scikit_learn() -> None:
    squared, codes = points(90, 4)
    expected = [[] for _ in range(4)]
    precise = []
    for query, code in enumerate(codes):
        order = [other for other in np.argsort(squared[query]) if other != query]
        expected[code].append(measures_of([bool(codes[other] == code) for other in order]))
        others = np.arange(90) != query
        precise.append(average_precision_score(codes[others] == code, -squared[query, others]))
    found = rate(squared, codes).scores
    assert found == pytest.approx(np.array([np.mean(rows, axis=0) for rows in expected]))
    assert np.average(
        found[:, NAMES.index("average_precision")], weights=np.bincount(codes)
    ) == pytest.approx(np.mean(precise))


def test_classes_apart_are_found_whole_and_classes_mixed_are_not() -> None:
    codes = np.repeat(np.arange(3, dtype=np.int32), 40)
    apart = (codes[:, None] != codes) * 1.0 + symmetric(np.random.default_rng(0).random((120, 120))) / 10
    best = rate(apart, codes)
    # The page of the E-measure is shorter than the class, so that it cannot find it all.
    perfect = [1, 1, 1, 2 * (PAGE / 39) / (1 + PAGE / 39), 1, 1]
    assert best.scores == pytest.approx(np.tile(perfect, (3, 1)))
    assert (best.precision == 1).all()
    worst = rate(2 - apart, codes)
    assert (worst.scores[:, :4] == 0).all()
    assert (worst.precision < 0.5).all()


def test_the_order_of_the_shapes_has_no_say() -> None:
    squared, codes = points(60, 5)
    coarse = np.round(squared / 4)
    order = np.random.default_rng(1).permutation(60)
    first, second = rate(coarse, codes), rate(coarse[np.ix_(order, order)], codes[order])
    assert second.scores == pytest.approx(first.scores)
    assert second.precision == pytest.approx(first.precision)


def test_chance_is_what_random_orders_reach() -> None:
    codes = np.repeat(np.arange(2, dtype=np.int32), [4, 12])
    random = np.random.default_rng(0)
    drawn = [rate(symmetric(random.random((16, 16))), codes).scores for _ in range(600)]
    chance = rate_chance(codes)
    assert chance.scores == pytest.approx(np.mean(drawn, axis=0), abs=0.02)
    assert chance.scores[:, 0] == pytest.approx([3 / 15, 11 / 15])
    assert chance.scores[:, 1] == pytest.approx([3 / 15, 11 / 15])


def test_a_shape_without_a_class_is_in_the_way_and_no_query() -> None:
    on_a_line = np.array([0.0, 1.0, 2.0])
    squared = (on_a_line[:, None] - on_a_line) ** 2
    nearest = NAMES.index("nearest_neighbour")
    with_stranger = rate(squared, np.array([0, -1, 0], np.int32))
    assert with_stranger.scores.shape == (1, len(MEASURES))
    assert with_stranger.scores[0, nearest] == 0
    assert with_stranger.scores[0, NAMES.index("second_tier")] == 1


def test_classes_of_one_shape_ask_nothing() -> None:
    classes, codes = query_classes(["b", "a", None, "b", "c", "c"])
    assert classes == ("b", "c")
    assert codes.tolist() == [0, -1, -1, 0, 1, 1]
    assert query_classes(["a", "b", None])[0] == ()


def test_a_subset_is_rated_by_the_sum_of_its_features() -> None:
    squared, codes = points(30, 3)
    other, _ = points(30, 3, seed=5)
    both = np.stack([squared, other]).astype(np.float32)
    ratings = rate_subsets(both, codes, [1, 2, 3])
    for rating, distances in zip(ratings, (both[0], both[1], both[0].astype(float) + both[1])):
        assert np.array_equal(rating.scores, rate(distances, codes).scores)


@pytest.mark.parametrize(("relevant", "others"), [(1, 1), (7, 111), (19, 279), (32, 200), (50, 200), (5, 20)])
def test_the_highest_e_measure_is_that_of_a_perfect_order(relevant, others) -> None:
    perfect = [True] * relevant + [False] * (others - relevant)
    expected = measures_of(perfect)[NAMES.index("e_measure")]
    assert highest_e_measures(np.array([relevant + 1]), others) == pytest.approx([expected])
