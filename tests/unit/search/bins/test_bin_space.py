"""Distances by chosen bins: exact, fair to ties, and the same in any order of the shapes."""

from __future__ import annotations

import numpy as np
import pytest

from shapeviz_report.bins import scale_bins
from shapeviz_report.presets import PRESETS
from shapeviz_report.projections import squared_distances
from shapeviz_report.quality import score
from shapeviz_report.search.bins import encode, make_bin_space
from shapeviz_report.search.bins.bin_space import hits_of, hits_of_additions, hits_on, places_of
from shapeviz_report.types import FeatureBlock, FeatureTable


def test_distances_are_those_of_maps_of_chosen_bins(planted) -> None:
    bins = ("A:2", "A:7", "B[0]:3")
    values = scale_bins(planted.table, PRESETS["default"], bins)[planted.space.rows]
    squared = planted.space.squared([planted.space.names.index(name) for name in bins])
    assert squared == pytest.approx(squared_distances(values), rel=1e-4, abs=1e-4)


def test_sums_do_not_depend_on_what_was_added_and_removed(planted) -> None:
    space = planted.space
    squared = space.squared([3, 1, 7])
    squared += space.squared_by(20)
    squared += space.squared_by(9)
    squared -= space.squared_by(3)
    assert (squared == space.squared([20, 9, 7, 1])).all()


@pytest.mark.parametrize("k", [1, 4, 10, 47])
@pytest.mark.parametrize("values", [2, 3, 1000])
def test_hits_are_those_of_the_quality(values, k) -> None:
    """With two or three different values a bin, nearly all distances are equal to others."""
    random = np.random.default_rng(values)
    table = FeatureTable(
        tuple(map(str, range(48))), (FeatureBlock("x", 1, 4),), random.integers(values, size=(48, 4)) / values
    )
    labels = ["a"] * 20 + ["b"] * 20 + [None] * 8
    space = make_bin_space(table, PRESETS["default"], labels)
    _, codes = encode(space, labels)
    rows = np.flatnonzero(codes >= 0)
    own = [labels[row] for row in space.rows]

    def expected(bins: list[int]) -> np.ndarray:
        return score(space.columns[bins].T, own, k=k).nh[rows]

    found = hits_of_additions(space.columns, space.squared([2]), rows, codes, k)
    for b in (0, 1, 3):
        assert found[b] == pytest.approx(expected([2, b]))
    assert hits_of(space.squared([0, 1, 3]), rows, codes, k) == pytest.approx(expected([0, 1, 3]))


def test_as_many_neighbours_count_as_a_class_has_others() -> None:
    codes = np.array([0, 0, 0, 0, 1, 1, 2, -1])
    assert places_of(codes, 10).tolist() == [3, 3, 3, 3, 1, 1, 1, 10]
    assert places_of(codes, 2).tolist() == [2, 2, 2, 2, 1, 1, 1, 2]


@pytest.mark.parametrize("values", [2, 1000])
def test_each_shape_may_have_its_own_number_of_neighbours(values) -> None:
    random = np.random.default_rng(values)
    columns = random.integers(values, size=(4, 30)) / 1024
    table = FeatureTable(tuple(map(str, range(30))), (FeatureBlock("x", 1, 4),), columns.T)
    labels = list("aaaabbbbbbbbbbccccccccccccccdd")
    space = make_bin_space(table, PRESETS["default"], labels)
    _, codes = encode(space, labels)
    rows = np.arange(30)
    places = places_of(codes, 10)
    squared = space.squared([0, 1])
    together = hits_of_additions(space.columns, squared, rows, codes, places)[2]
    alone = hits_of(space.squared([0, 1, 2]), rows, codes, places)
    on_map = hits_on(space.columns[:3].T, codes, places)
    for k in set(places.tolist()):
        own = places == k
        expected = hits_of_additions(space.columns, squared, rows, codes, k)[2][own]
        for found in (together, alone, on_map):
            assert found[own] == pytest.approx(expected)


def test_only_bins_that_differ_and_each_once() -> None:
    random = np.random.default_rng(0)
    values = random.random((12, 5))
    values[:, 1] = 0.3
    values[:, 3] = values[:, 0]
    table = FeatureTable(tuple(map(str, range(12))), (FeatureBlock("x", 1, 5),), values)
    assert make_bin_space(table, PRESETS["default"], [None] * 12).names == ("x:1", "x:3", "x:5")


def test_shapes_that_are_all_alike_leave_no_bin() -> None:
    table = FeatureTable(("a", "b", "c"), (FeatureBlock("x", 1, 5),), np.full((3, 5), 0.2))
    assert make_bin_space(table, PRESETS["default"], [None] * 3).names == ()


def test_a_large_database_is_sampled_by_class(planted) -> None:
    space = make_bin_space(planted.table, PRESETS["default"], planted.labels, limit=20)
    _, codes = encode(space, planted.labels)
    assert np.bincount(codes).tolist() == [5, 5, 5, 5]
    assert space.shape_count == 48
