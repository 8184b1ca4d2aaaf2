"""How far classes are told apart: against scikit-learn, by hand, and with labels that mean nothing."""

from __future__ import annotations

import numpy as np
import pytest
from sklearn.metrics import silhouette_samples
from sklearn.neighbors import KNeighborsClassifier

from shapeviz_report import separation
from shapeviz_report.separation import rate_separation

SIZES = {"ant": 14, "bird": 9, "cup": 20, "fish": 6}


@pytest.fixture(scope="module")
def labels() -> list[str]:
    return [name for name, size in SIZES.items() for _ in range(size)]


@pytest.fixture(scope="module")
def points(labels) -> np.ndarray:
    random = np.random.default_rng(0)
    centres = {name: random.normal(size=6) for name in sorted(set(labels))}
    return np.array([centres[label] for label in labels]) + random.normal(0, 0.9, (len(labels), 6))


def left_out(points: np.ndarray, labels: list[str], k: int) -> dict[str, float]:
    """The share of each class that a classifier of scikit-learn gets right which knows all shapes but the one."""
    names, right = np.array(labels), []
    for row in range(len(names)):
        others = np.arange(len(names)) != row
        classifier = KNeighborsClassifier(k).fit(points[others], names[others])
        right.append(classifier.predict(points[row : row + 1])[0] == names[row])
    return {name: float(np.mean(np.array(right)[names == name])) for name in sorted(set(labels))}


def test_against_scikit_learn(points, labels) -> None:
    xy = points[:, :2]
    found = rate_separation(points, {"map": xy}, labels, 5)
    assert found.classes == tuple(SIZES)
    assert found.sizes.tolist() == list(SIZES.values())
    for rates, values in ((found.features, points), (found.maps["map"], xy)):
        assert rates.nearest == pytest.approx(list(left_out(values, labels, 1).values()))
        samples = silhouette_samples(values, labels)
        means = [samples[np.array(labels) == name].mean() for name in SIZES]
        assert rates.silhouette == pytest.approx(means)
        assert found.over_shapes(rates.silhouette) == pytest.approx(samples.mean())
    # Of classes that tie scikit-learn takes the first by name: three neighbours of two classes cannot tie.
    two = [label if label in ("ant", "cup") else None for label in labels]
    kept = [row for row, label in enumerate(two) if label]
    found = rate_separation(points, {}, two, 3)
    own = left_out(points[kept], [labels[row] for row in kept], 3)
    assert found.features.elected == pytest.approx([own["ant"], own["cup"]])


def test_a_tie_shares_the_success() -> None:
    # In the middle of two of its own and two others, all as far.
    points = np.array([[0.0, 0], [1, 0], [0, 1], [-1, 0], [0, -1]])
    found = rate_separation(points, {}, ["a", "a", "a", "b", "b"], 4)
    assert found.features.nearest[0] == pytest.approx((0.5 + 1 + 1) / 3)
    assert found.features.elected[0] == pytest.approx((0.5 + 0.5 + 0.5) / 3)


def test_what_a_class_is_mistaken_for() -> None:
    points = np.array([[0.0], [1.1], [1.0], [1.21], [9.0], [9.1]])
    found = rate_separation(points, {}, ["a", "a", "b", "b", "c", "c"], 1)
    assert [found.classes[place] if place >= 0 else None for place in found.mistaken] == ["b", "a", None]


def test_labels_at_random_are_at_chance(points) -> None:
    random = np.random.default_rng(1)
    labels = random.permutation([name for name, size in SIZES.items() for _ in range(size)]).tolist()
    found = rate_separation(points, {}, labels, 5)
    mean = found.over_shapes(found.features.silhouette)
    assert abs(mean - found.over_shapes(found.chance.silhouette)) < 3 * found.chance_spread
    assert found.over_shapes(found.features.nearest) == pytest.approx(
        found.over_shapes(found.chance.nearest), abs=0.2
    )


def test_shapes_without_a_class_have_no_part_and_single_ones_no_rate(points, labels) -> None:
    more = np.concatenate([points, points[:3] + 0.01, [[9.0] * 6]])
    found = rate_separation(more, {}, [*labels, None, None, None, "alone"], 5)
    assert found.classes == tuple(SIZES)
    assert found.shapes == len(labels) + 1
    samples = silhouette_samples(np.concatenate([points, [[9.0] * 6]]), [*labels, "alone"])
    assert found.over_shapes(found.features.silhouette) == pytest.approx(samples[:-1].mean())


def test_the_order_of_shapes_decides_nothing(points, labels) -> None:
    order = np.random.default_rng(2).permutation(len(labels))
    one = rate_separation(points, {}, labels, 5)
    other = rate_separation(points[order], {}, [labels[row] for row in order], 5)
    assert (one.features.silhouette == other.features.silhouette).all()
    assert (one.likely == other.likely).all()
    assert one.chance_spread == other.chance_spread


def test_a_sample_keeps_every_class(points, labels, monkeypatch) -> None:
    monkeypatch.setattr(separation, "MOST_SHAPES", 25)
    found = rate_separation(points, {}, labels, 5)
    assert found.shapes == 25
    assert found.shape_count == len(labels)
    assert found.classes == tuple(SIZES)


def test_nothing_to_tell_apart() -> None:
    points = np.eye(3)
    assert rate_separation(points, {}, ["a", "a", None], 1) is None
    assert rate_separation(points, {}, ["a", "b", None], 1) is None
    assert rate_separation(points, {}, [None] * 3, 1) is None
