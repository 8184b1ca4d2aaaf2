"""Neighbourhood hit: by hand, against brute force, with ties, and the null."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_matrix

from shapeviz_report.quality import (
    MOST_PAIRED,
    hit_range,
    neighbour_weights,
    score,
    share_of_range,
    share_places,
)
from shapeviz_report.types import HitRange


def test_by_hand() -> None:
    # Two tight groups on a line and one stray a among the b.
    xy = np.array([[0, 0], [1, 0], [2.1, 0], [10, 0], [11, 0], [12.1, 0], [10.4, 0]])
    quality = score(xy, ["a", "a", "a", "b", "b", "b", "a"], k=2)
    assert quality.nh.tolist() == [1, 1, 1, 0.5, 0.5, 0.5, 0]
    assert quality.nh_c == {"a": 0.75, "b": 0.5}
    assert list(quality.nh_c) == ["a", "b"]
    assert quality.nh_s == pytest.approx(4.5 / 7)


@pytest.mark.slow
@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6), st.integers(3, 60), st.integers(1, 12))
def test_against_sorting(seed, count, k) -> None:
    random = np.random.default_rng(seed)
    xy, labels = random.random((count, 2)), random.choice(["x", "y", "z"], count)
    used = min(k, count - 1)
    expected = []
    for i in range(count):
        order = np.argsort(np.linalg.norm(xy - xy[i], axis=1))
        expected.append(np.mean(labels[order[1 : used + 1]] == labels[i]))
    assert score(xy, labels.tolist(), k=k).nh == pytest.approx(np.array(expected))


@pytest.mark.slow
@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6))
def test_the_order_of_shapes_does_not_matter_even_with_ties(seed) -> None:
    random = np.random.default_rng(seed)
    xy = random.integers(0, 3, (40, 2)).astype(float)
    labels = np.sort(random.choice(["x", "y"], 40))
    order = random.permutation(40)
    first, second = score(xy, labels.tolist(), k=5), score(xy[order], labels[order].tolist(), k=5)
    assert second.nh == pytest.approx(first.nh[order])
    assert second.nh_s == pytest.approx(first.nh_s)
    assert (second.null_mean, second.null_std) == pytest.approx((first.null_mean, first.null_std))


def test_points_in_one_place_share_the_hit() -> None:
    # Sorting by index would give each shape neighbours of its own class.
    labels = ["a"] * 10 + ["b"] * 10
    quality = score(np.zeros((20, 2)), labels, k=5)
    assert quality.nh == pytest.approx(9 / 19)


def test_null_is_what_random_labels_reach() -> None:
    random = np.random.default_rng(1)
    xy = random.random((90, 2))
    labels = ["a"] * 60 + ["b"] * 30
    quality = score(xy, labels)
    expected = (60 * 59 + 30 * 29) / (90 * 89)
    assert quality.null_mean == pytest.approx(expected, abs=0.01)
    assert abs(quality.nh_s - expected) < 4 * quality.null_std


def test_shapes_without_labels_are_left_out() -> None:
    xy = np.array([[0, 0], [1, 0], [2.1, 0], [3.3, 0]])
    quality = score(xy, ["a", "a", None, "b"], k=1)
    assert np.isnan(quality.nh[2])
    assert quality.nh[[0, 1, 3]].tolist() == [1, 1, 0]
    assert quality.nh_s == pytest.approx(2 / 3)


@pytest.mark.parametrize("labels", [[None, None], ["a"], []])
def test_nothing_to_score(labels) -> None:
    quality = score(np.zeros((len(labels), 2)), labels)
    assert quality.nh_s is None
    assert quality.null_mean is None
    assert quality.nh_c == {}
    assert np.isnan(quality.nh).all()


def test_weights_add_up() -> None:
    points = np.random.default_rng(0).integers(0, 2, (30, 3)).astype(float)
    weights = neighbour_weights(points, 7)
    assert np.asarray(weights.sum(axis=1)).ravel() == pytest.approx(1)
    assert (weights.diagonal() == 0).all()


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["scattered", "on a grid", "in heaps"])
def test_weights_on_a_large_map_are_those_of_all_distances(kind) -> None:
    count = MOST_PAIRED + 96
    random = np.random.default_rng(0)
    points = {
        "scattered": random.normal(size=(count, 2)),
        "on a grid": np.stack(np.divmod(np.arange(count), 64), axis=1).astype(float),
        "in heaps": random.normal(size=(count // 64, 2))[np.arange(count) % (count // 64)],
    }[kind]
    squared = ((points[:, None] - points[None]) ** 2).sum(axis=2)
    np.fill_diagonal(squared, np.inf)
    weights = neighbour_weights(points, 10)
    assert weights.shape == (count, count)
    assert abs(weights - csr_matrix(share_places(squared, 10) / 10)).max() < 1e-12


@pytest.mark.slow
@settings(max_examples=30, deadline=None)
@given(st.lists(st.sampled_from(["a", "b", "c", None]), min_size=2, max_size=30), st.integers(1, 12))
def test_no_map_exceeds_the_maximum_and_one_reaches_it(labels, k) -> None:
    # All of a class in one place, classes far apart: nothing keeps classes together better.
    groups = sorted({label for label in labels if label is not None})
    xy = np.array([[100.0 * groups.index(x), 0] if x else [1e6, 1e4 * i] for i, x in enumerate(labels)])
    best = score(xy, labels, k=k)
    random = score(np.random.default_rng(0).random((len(labels), 2)), labels, k=k)
    if not groups:
        assert best.range == HitRange({}, {}, None, None)
        return
    used = min(k, len(labels) - 1)
    for label in groups:
        size = labels.count(label)
        assert best.range.highest_of_class[label] == pytest.approx(min(used, size - 1) / used)
        assert best.nh_c[label] == pytest.approx(best.range.highest_of_class[label])
        assert best.range.chance_of_class[label] == pytest.approx((size - 1) / (len(labels) - 1))
        assert random.nh_c[label] <= random.range.highest_of_class[label] + 1e-9
    assert best.nh_s == pytest.approx(best.range.highest)


def test_classes_of_eight_reach_seven_tenths_and_classes_of_one_nothing() -> None:
    eight = hit_range([f"class {i // 8}" for i in range(112)])
    assert eight.highest == pytest.approx(0.7)
    assert set(eight.highest_of_class.values()) == {0.7}
    assert eight.chance == pytest.approx(7 / 111)
    assert hit_range(["a", "b", "c"]).highest == 0
    assert hit_range(["a"] * 11 + ["b"] * 30).highest == 1


@pytest.mark.parametrize(
    ("labels", "k", "tells"),
    [
        ("aabb", 3, False),
        ("aabb", 2, True),
        ("aaaaaa", 3, False),
        # Labels are dealt among shapes that have one.
        (["a", "a", "a", None, None], 2, False),
        ("abcdef", 3, False),
        ([None, None, None], 2, False),
        ("a", 1, False),
    ],
)
def test_no_map_of_one_class_or_of_neighbours_that_are_all_others_can_tell(labels, k, tells):
    assert hit_range(list(labels), k).tells is tells


def test_a_class_of_few_shapes_cannot_fill_all_places():
    assert hit_range(["a"] * 10 + ["b"] * 30).highest_of_class == {"a": 0.9, "b": 1.0}


def test_the_share_of_what_lies_between_chance_and_maximum() -> None:
    assert share_of_range(0.7, 0.1, 0.7) == 1
    assert share_of_range(0.1, 0.1, 0.7) == 0
    assert share_of_range(0.4, 0.1, 0.7) == pytest.approx(0.5)
    # One class, classes of one shape, or all others are neighbours: every map reaches the same.
    for labels, k in ((["a"] * 5, 3), (["a", "b", "c"], 1), (["a", "a", "b", "b"], 10)):
        found = hit_range(labels, k)
        assert share_of_range(found.highest, found.chance, found.highest) is None
    assert share_of_range(None, None, None) is None
