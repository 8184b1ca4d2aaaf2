"""How far maps show who is like whom: against definitions, scikit-learn, and maps at random."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import cdist
from sklearn.manifold import trustworthiness

from shapeviz_report import faithfulness
from shapeviz_report.faithfulness import rate_maps


@pytest.fixture(scope="module")
def points() -> np.ndarray:
    random = np.random.default_rng(0)
    return np.repeat(random.normal(size=(6, 8)) * 3, 10, axis=0) + random.normal(size=(60, 8))


def test_against_scikit_learn_and_sets(points) -> None:
    xy = points[:, :2]
    found = rate_maps(points, {"a": xy}, 7)["a"]
    assert found.k == 7
    assert found.trustworthiness == pytest.approx(trustworthiness(points, xy, n_neighbors=7))
    assert found.continuity == pytest.approx(trustworthiness(xy, points, n_neighbors=7))
    for row in range(60):
        sets = []
        for values in (points, xy):
            distances = cdist(values[row : row + 1], values)[0]
            distances[row] = np.inf
            sets.append(set(np.argsort(distances)[:7]))
        assert found.kept[row] == pytest.approx(len(sets[0] & sets[1]) / 7)


def test_the_features_themselves_are_kept_whole(points) -> None:
    found = rate_maps(points[:, :2], {"same": points[:, :2] * 4 + 1}, 10)["same"]
    assert (found.kept == 1).all()
    assert found.trustworthiness == found.continuity == 1


def test_maps_at_random_have_the_chance_that_is_told(points) -> None:
    random = np.random.default_rng(1)
    found = [rate_maps(points, {"r": random.random((60, 2))}, 5)["r"] for _ in range(60)]
    assert np.mean([one.kept.mean() for one in found]) == pytest.approx(found[0].chance, abs=0.01)
    assert np.mean([one.trustworthiness for one in found]) == pytest.approx(found[0].random, abs=0.01)
    assert np.mean([one.continuity for one in found]) == pytest.approx(found[0].random, abs=0.01)


def test_the_order_of_shapes_decides_nothing(points) -> None:
    order = np.random.default_rng(2).permutation(60)
    one = rate_maps(points, {"a": points[:, :2]}, 10)["a"]
    other = rate_maps(points[order], {"a": points[order, :2]}, 10)["a"]
    assert (other.kept == one.kept[order]).all()
    assert (other.trustworthiness, other.continuity) == (one.trustworthiness, one.continuity)


def test_many_shapes_are_asked_by_a_sample(points, monkeypatch) -> None:
    whole = rate_maps(points, {"a": points[:, :2]}, 5)["a"]
    monkeypatch.setattr(faithfulness, "RANKED", 30)
    some = rate_maps(points, {"a": points[:, :2]}, 5)["a"]
    assert (some.kept == whole.kept).all()
    assert some.trustworthiness == pytest.approx(whole.trustworthiness, abs=0.05)
    assert some.trustworthiness != whole.trustworthiness


def test_few_shapes(points) -> None:
    assert rate_maps(points[:1], {"a": points[:1, :2]}, 10) == {}
    two = rate_maps(points[:2], {"a": points[:2, :2]}, 10)["a"]
    assert (two.k, two.kept.tolist(), two.chance, two.trustworthiness) == (1, [1, 1], 1, None)
