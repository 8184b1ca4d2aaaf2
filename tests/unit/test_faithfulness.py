"""How far maps show who is like whom: against definitions, scikit-learn, and maps at random."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from scipy.spatial.distance import cdist, pdist
from sklearn.isotonic import IsotonicRegression
from sklearn.manifold import trustworthiness

from shapeviz_report import faithfulness
from shapeviz_report.faithfulness import CELLS, rate_distances, rate_maps


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


def ranks_by_sorting(points: np.ndarray) -> np.ndarray:
    """(n, n) 1 for the nearest."""
    distances = cdist(points, points)
    np.fill_diagonal(distances, -1)
    return distances.argsort(axis=1).argsort(axis=1)


def test_false_and_missing_neighbours_of_every_shape(points) -> None:
    xy = points[:, :2]
    found = rate_maps(points, {"a": xy}, 7)["a"]
    ranks, shown = ranks_by_sorting(points), ranks_by_sorting(xy)
    most = sum(range(59, 59 - 7, -1)) - 7 * 7
    for row in range(60):
        near, seen = ranks[row], shown[row]
        false = sum(near[p] - 7 for p in range(60) if 1 <= seen[p] <= 7 < near[p])
        missing = sum(seen[p] - 7 for p in range(60) if 1 <= near[p] <= 7 < seen[p])
        assert found.false[row] == pytest.approx(false / most)
        assert found.missing[row] == pytest.approx(missing / most)
    assert found.trustworthiness == pytest.approx(1 - found.false.mean())
    assert found.continuity == pytest.approx(1 - found.missing.mean())


def test_two_sheets_on_top_of_each_other_are_false_and_a_torn_line_is_missing() -> None:
    line = np.column_stack([np.arange(40.0), np.zeros(40)])
    folded = np.column_stack([np.minimum(np.arange(40), 39 - np.arange(40)), np.zeros(40)])
    folded[:20, 1] += 1e-3
    torn = line + np.outer(np.arange(40) >= 20, [0, 100.0]) - np.outer(np.arange(40) >= 20, [20, 0])
    ends = rate_maps(line, {"folded": folded, "torn": torn}, 4)
    assert ends["folded"].false[0] > 0.5 > ends["folded"].false[19]
    assert ends["torn"].missing[20] > 0.3 > ends["torn"].missing[39] == 0


def test_stress_against_a_search_for_the_scale(points) -> None:
    xy = points[:, :2]
    found = rate_maps(points, {"a": xy, "b": xy * 17}, 7)
    apart, shown = pdist(points), pdist(xy)
    best = minimize_scalar(lambda scale: ((apart - scale * shown) ** 2).sum() / (apart**2).sum())
    assert found["a"].stress == pytest.approx(np.sqrt(best.fun))
    assert found["b"].stress == pytest.approx(found["a"].stress)
    random = np.random.default_rng(3)
    dealt = [rate_maps(points, {"a": xy[random.permutation(60)]}, 7)["a"].stress for _ in range(60)]
    assert np.mean(dealt) == pytest.approx(found["a"].random_stress, abs=0.005)


def test_a_shepard_diagram_counts_every_pair(points) -> None:
    xy = points[:, :2]
    found = rate_maps(points, {"a": xy}, 7)["a"].shepard
    apart, shown = pdist(points), pdist(xy)
    scale = (apart @ shown) / (shown @ shown)
    assert found.pairs.sum() == 60 * 59 / 2
    assert found.height == pytest.approx(scale * shown.max() / apart.max())
    cells, _, _ = np.histogram2d(
        apart / apart.max(), scale * shown / apart.max(), bins=CELLS, range=[[0, 1], [0, found.height]]
    )
    assert abs(found.pairs - cells).sum() <= 4
    rising = IsotonicRegression().fit_transform(apart, scale * shown) / apart.max()
    column = np.minimum((apart / apart.max() * CELLS).astype(int), CELLS - 1)
    for place in np.unique(column):
        assert found.fit[place] == pytest.approx(rising[column == place].mean())
    assert (np.isnan(found.fit) == (found.pairs.sum(axis=1) == 0)).all()
    known = found.fit[~np.isnan(found.fit)]
    assert (np.diff(known) >= -1e-9).all()


def test_a_diagram_of_many_shapes_is_of_a_sample(points, monkeypatch) -> None:
    monkeypatch.setattr(faithfulness, "DRAWN", 30)
    assert rate_maps(points, {"a": points[:, :2]}, 5)["a"].shepard.pairs.sum() == 30 * 29 / 2


def test_distances_say_the_same_as_points(points) -> None:
    xy = points[:, :2]
    one = rate_maps(points, {"a": xy}, 7)["a"]
    other = rate_distances(cdist(points, points, "sqeuclidean"), xy, 7)
    for name in ("kept", "false", "missing", "trustworthiness", "continuity", "stress", "random_stress"):
        assert getattr(other, name) == pytest.approx(getattr(one, name))


def test_shapes_equally_far_share_a_place() -> None:
    # From 0, both 1 and 2 are second on the map, and 3 is third in the features.
    points = np.array([[0.0], [1], [2], [3], [4], [5], [6]])
    xy = np.array([[0, 0], [0, 1], [2, 0], [0, 2], [9, 0], [0, 9], [9, 9.0]])
    found = rate_maps(points, {"a": xy}, 2)["a"]
    assert found.kept[0] == pytest.approx(0.75)
    assert found.false[0] == pytest.approx(0.5 * 1 / (2 * (14 - 6 - 1) / 2))
    assert found.missing[0] == pytest.approx(0.5 * 1 / (2 * (14 - 6 - 1) / 2))


def test_the_same_places_for_all_shapes_are_chance(points) -> None:
    found = rate_maps(points, {"a": np.zeros((60, 2))}, 7)["a"]
    assert found.kept.mean() == pytest.approx(found.chance)
    assert found.trustworthiness == pytest.approx(found.random)
    assert found.continuity == pytest.approx(found.random)
    assert (found.stress, found.random_stress, found.shepard) == (1, 1, None)
    equal = rate_maps(np.zeros((60, 3)), {"a": points[:, :2]}, 7)["a"]
    assert (equal.stress, equal.random_stress, equal.shepard) == (None, None, None)
    assert equal.kept.mean() == pytest.approx(equal.chance)


def test_few_shapes(points) -> None:
    assert rate_maps(points[:1], {"a": points[:1, :2]}, 10) == {}
    two = rate_maps(points[:2], {"a": points[:2, :2]}, 10)["a"]
    assert (two.k, two.kept.tolist(), two.chance, two.trustworthiness, two.false) == (
        1,
        [1, 1],
        1,
        None,
        None,
    )
    assert two.stress == pytest.approx(0, abs=1e-7)
    assert rate_distances(np.zeros((1, 1)), points[:1, :2], 10) is None


def test_of_many_shapes_some_are_asked(monkeypatch) -> None:
    random = np.random.default_rng(4)
    points = np.repeat(random.normal(size=(30, 8)) * 2, 60, axis=0) + random.normal(size=(1800, 8))
    maps = {"a": points[:, :2], "b": random.random((1800, 2))}
    exact = rate_maps(points, maps, 10)
    monkeypatch.setattr(faithfulness, "EXACT_LIMIT", 1000)
    monkeypatch.setattr(faithfulness, "RANKED", 600)
    found = rate_maps(points, maps, 10)
    for name in maps:
        assert found[name].kept == pytest.approx(exact[name].kept, abs=1e-12)
        assert (found[name].false, found[name].missing) == (None, None)
        for measure in ("trustworthiness", "continuity", "stress", "random_stress", "random", "chance"):
            assert getattr(found[name], measure) == pytest.approx(getattr(exact[name], measure), abs=0.01), (
                measure
            )
        assert found[name].shepard.height == pytest.approx(exact[name].shepard.height, rel=0.1)
