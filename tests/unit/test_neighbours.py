"""Nearest neighbours, and how well a shape fits its class."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from shapeviz_report import neighbours
from shapeviz_report.neighbours import KIN, find_fits, find_nearest, order_classes


def clouds(count: int = 12, dimensions: int = 6, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Four groups of points, the first two near to each other."""
    random = np.random.default_rng(seed)
    centres = random.normal(0, 3, (4, dimensions))
    centres[1] = centres[0] + 0.5
    codes = np.repeat(np.arange(4), count)
    return centres[codes] + random.normal(0, 1, (len(codes), dimensions)), codes


def slow_fit(points: np.ndarray, codes: np.ndarray, row: int) -> tuple[float, int]:
    """The definition, one shape at a time."""
    distances = cdist(points[row : row + 1], points)[0]
    distances[row] = np.inf
    means = {
        code: np.mean(sorted(distances[(codes == code) & np.isfinite(distances)])[:KIN])
        for code in set(codes) - {-1}
    }
    own = means.pop(codes[row])
    rival = min(means, key=means.get)
    return (means[rival] - own) / max(means[rival], own), rival


@pytest.mark.parametrize("dimensions", [2, 6])
def test_the_nearest_are_found_in_their_order(dimensions):
    points, _ = clouds(dimensions=dimensions)
    distances = cdist(points, points)
    np.fill_diagonal(distances, np.inf)
    assert (find_nearest(points, 7) == np.argsort(distances, axis=1)[:, :7]).all()


@pytest.mark.parametrize("dimensions", [2, 5])
def test_no_shape_is_its_own_neighbour_where_all_are_equal(dimensions):
    nearest = find_nearest(np.zeros((9, dimensions)), 4)
    assert nearest.shape == (9, 4)
    assert not (nearest == np.arange(9)[:, None]).any()
    assert all(len(set(row)) == 4 for row in nearest.tolist())


def test_a_single_shape_has_no_neighbours():
    assert find_nearest(np.zeros((1, 5)), 0).shape == (1, 0)


@pytest.mark.parametrize("block", [8_000_000, 200])
def test_the_fit_is_the_silhouette_of_the_nearest(monkeypatch, block):
    monkeypatch.setattr(neighbours, "_BLOCK", block)
    points, codes = clouds()
    found = find_fits(points, codes)
    for row in range(len(codes)):
        fit, rival = slow_fit(points, codes, row)
        assert found.fit[row] == pytest.approx(fit)
        assert found.rival[row] == rival
    assert ((found.fit >= -1) & (found.fit <= 1)).all()


def test_a_swapped_label_is_the_worst_fit():
    points, codes = clouds()
    codes = codes.copy()
    codes[30] = 0
    found = find_fits(points, codes)
    assert found.fit.argmin() == 30
    assert found.fit[30] < 0
    assert found.rival[30] == 2


def test_shapes_without_label_and_alone_have_no_fit():
    points, codes = clouds()
    codes = codes.copy()
    codes[:3] = -1
    codes[36:] = -1
    codes[40] = 3
    found = find_fits(points, codes)
    undefined = [0, 1, 2, *range(36, 48)]
    assert np.isnan(found.fit[undefined]).all()
    assert (found.rival[undefined] == -1).all()
    assert np.isfinite(np.delete(found.fit, undefined)).all()
    # A shape without a label is no class to be like.
    assert found.rival.max() <= 3


def test_one_class_gives_no_fit():
    points, codes = clouds()
    found = find_fits(points, np.zeros_like(codes))
    assert np.isnan(found.fit).all()


def test_equal_shapes_lie_between_their_classes():
    found = find_fits(np.ones((8, 3)), np.repeat([0, 1], 4))
    assert found.fit.tolist() == [0.0] * 8


def test_similar_classes_stand_beside_each_other():
    points, codes = clouds()
    order = order_classes(points, codes)
    assert sorted(order) == [0, 1, 2, 3]
    assert abs(order.index(0) - order.index(1)) == 1


def test_of_many_shapes_some_stand_for_their_class(monkeypatch):
    points, codes = clouds(400, seed=3)
    exact = find_fits(points, codes)
    monkeypatch.setattr(neighbours, "EXACT_LIMIT", 1000)
    monkeypatch.setattr(neighbours, "FITTED", 800)
    found = find_fits(points, codes)
    # Of fewer, the nearest are farther off, in all classes alike.
    assert np.corrcoef(found.fit, exact.fit)[0, 1] > 0.97
    assert (found.rival == exact.rival).mean() > 0.97
    assert np.abs(found.fit - exact.fit).mean() < 0.08
    order = np.random.default_rng(0).permutation(len(points))
    again = find_fits(points[order], codes[order])
    assert again.fit == pytest.approx(found.fit[order])
