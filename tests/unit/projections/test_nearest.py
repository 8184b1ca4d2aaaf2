"""The nearest rows are the nearest."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from shapeviz_report.projections.kernels import nearest


@pytest.fixture(scope="module")
def values():
    """A thousand rows in forty groups that overlap, the last twenty equal in pairs."""
    random = np.random.default_rng(0)
    rows = random.standard_normal((40, 60))[np.arange(1000) % 40] + 0.6 * random.standard_normal((1000, 60))
    rows[990:] = rows[980:990]
    return rows + 100.0


def test_every_distance_is_looked_at_where_rows_are_few(values, monkeypatch) -> None:
    monkeypatch.setattr(nearest, "_BLOCK", 70_000)
    rows, distances = nearest.nearest_rows(values, 30, 0)
    apart = cdist(values, values)
    np.fill_diagonal(apart, np.inf)
    assert rows.shape == distances.shape == (1000, 30)
    assert distances == pytest.approx(np.sort(apart, axis=1)[:, :30], abs=0.01)
    assert distances == pytest.approx(np.take_along_axis(apart, rows, axis=1), abs=0.01)
    assert (rows[980:, 0] == np.r_[990:1000, 980:990]).all()


def test_descent_finds_nearly_all_of_them(values, monkeypatch) -> None:
    exact, _ = nearest.nearest_rows(values, 30, 0)
    monkeypatch.setattr(nearest, "EXACT_LIMIT", 500)
    rows, distances = nearest.nearest_rows(values, 30, 0)
    found = np.mean([len(np.intersect1d(*pair)) / 30 for pair in zip(exact, rows)])
    assert found > 0.98
    assert (rows != np.arange(1000)[:, None]).all(), "no row is its own neighbour"
    assert (np.diff(distances, axis=1) >= 0).all()
    again, _ = nearest.nearest_rows(values, 30, 0)
    assert (again == rows).all()


def test_columns_beyond_the_first_decide_the_order_only_where_they_must() -> None:
    from shapeviz_report.projections import canonical_order

    random = np.random.default_rng(0)
    for values in (
        random.random((50, 90)),
        np.hstack([np.zeros((50, 70)), random.random((50, 20))]),
        np.zeros((4, 3)),
    ):
        assert (canonical_order(values) == np.lexsort(values.T[::-1])).all()
