"""Distances of features: they add up, do not depend on the order of files, and sample classes in proportion."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from shapeviz_report.projections import PROJECTIONS, arrange, squared_distances
from shapeviz_report.search import make_space, map_subsets
from shapeviz_report.types import FeatureBlock, FeatureTable


def table_of(values: np.ndarray) -> FeatureTable:
    """Three features of 3, 2 and 1 columns."""
    blocks = (FeatureBlock("A", 3, 1), FeatureBlock("B", 2, 1), FeatureBlock("C", 1, 1))
    return FeatureTable(tuple(f"s{i}" for i in range(len(values))), blocks, values)


@pytest.fixture(scope="module")
def values() -> np.ndarray:
    return np.random.default_rng(0).normal(size=(40, 6))


def test_a_subset_is_the_map_of_its_columns(values) -> None:
    space = make_space(table_of(values), values, [None] * 40)
    assert space.names(5) == ("A", "C")
    columns = values[space.rows][:, [0, 1, 2, 5]]
    assert space.squared[[0, 2]].sum(axis=0) == pytest.approx(squared_distances(columns), rel=1e-5)
    made = map_subsets(space.squared, "tsne", 3, [5, 7])
    for xy, squared in zip(made.xy, (space.squared[[0, 2]], space.squared)):
        expected = arrange(PROJECTIONS[0], squared.sum(axis=0, dtype=np.float64), 3)
        assert (xy == expected.astype(np.float32)).all()
    assert (made.cpu_seconds > 0).all()


def test_pieces_make_the_same_maps(values) -> None:
    space = make_space(table_of(values), values, [None] * 40)
    whole = map_subsets(space.squared, "tsne", 0, [1, 2, 7])
    pieces = [map_subsets(space.squared, "tsne", 0, [s]).xy[0] for s in (1, 2, 7)]
    assert (whole.xy == np.array(pieces)).all()


def test_the_order_of_shapes_does_not_matter(values) -> None:
    order = np.random.default_rng(1).permutation(40)
    labels = [f"class {i % 3}" for i in range(40)]
    for limit in (100, 21):
        first = make_space(table_of(values), values, labels, limit=limit)
        second = make_space(table_of(values[order]), values[order], [labels[i] for i in order], limit=limit)
        assert first.key == second.key
        assert (order[second.rows] == first.rows).all()


def test_a_feature_that_is_the_same_for_all_lies_in_one_place(values) -> None:
    constant = values.copy()
    constant[:, 5] = 1
    space = make_space(table_of(constant), constant, [None] * 40)
    assert (map_subsets(space.squared, "tsne", 0, [4]).xy == 0).all()


def test_a_sample_has_its_share_of_each_class() -> None:
    values = np.random.default_rng(0).normal(size=(200, 6))
    labels = ["a"] * 120 + ["b"] * 60 + [None] * 20
    space = make_space(table_of(values), values, labels, limit=50)
    assert space.shape_count == 200
    counts = Counter(labels[i] for i in space.rows)
    assert sum(counts.values()) == 50
    assert counts["a"] == pytest.approx(30, abs=1)
    assert counts["b"] == pytest.approx(15, abs=1)
    assert counts[None] == pytest.approx(5, abs=1)
    assert len(set(space.rows.tolist())) == 50
