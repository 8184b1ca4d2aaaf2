"""Distances that know their neighbourhood, against their definition and on cases with known answers."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from shapeviz_report.diffusion import diffuse, links
from shapeviz_report.neighbours import find_related
from shapeviz_report.retrieval import rate


def uneven(count: int = 20, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """A wide group and a dense one beside it, so that the wide one's shapes are nearer to the dense than to most of
    their own."""
    random = np.random.default_rng(seed)
    wide, dense = random.normal(size=(count, 10)), random.normal(0, 0.1, (count, 10))
    dense[:, 0] += 2
    return np.concatenate([wide, dense]), np.repeat([0, 1], count).astype(np.int32)


def slow(squared: np.ndarray) -> np.ndarray:
    """The definition, a pair at a time, chains added up step by step."""
    count = len(squared)
    near = [sorted(squared[i, j] ** 0.5 for j in range(count) if j != i) for i in range(count)]
    affinity = np.array(
        [
            [np.exp(-squared[i, j] / (near[i][6] * near[j][6])) if i != j else 0.0 for j in range(count)]
            for i in range(count)
        ]
    )
    kept = [set(np.argsort(-affinity[i])[: round(count**0.5 / 1.5)].tolist()) for i in range(count)]
    for i in range(count):
        for j in range(count):
            if j not in kept[i] or i not in kept[j]:
                affinity[i, j] = 0.0
    degrees = affinity.sum(axis=1)
    degrees[degrees == 0] = 1.0
    step = affinity / np.sqrt(degrees[:, None] * degrees)
    chains, power = np.zeros((count, count)), np.eye(count)
    for _ in range(600):
        chains += power
        power = 0.9 * power @ step
    parts = np.zeros((2, count, count))
    for i in range(count):
        for j in range(count):
            if i != j:
                parts[0, i, j] = squared[i, j] / (np.mean(near[i][:10]) * np.mean(near[j][:10]))
                parts[1, i, j] = 2 - 2 * chains[i, j] / (chains[i, i] * chains[j, j]) ** 0.5
    pairs = count * (count - 1)
    return sum(part / (part.sum() / pairs) for part in parts)


def test_the_definition():
    points = np.random.default_rng(3).normal(size=(40, 5))
    squared = cdist(points, points, "sqeuclidean")
    assert diffuse(squared) == pytest.approx(slow(squared), abs=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_a_dense_group_draws_no_others_in(seed):
    points, codes = uneven(seed=seed)
    squared = cdist(points, points, "sqeuclidean")
    plain, diffused = (rate(distances, codes).scores[:, 5] for distances in (squared, diffuse(squared)))
    assert plain[0] < 0.6
    assert (diffused > 0.99).all()


def test_the_scale_of_distances_does_not_matter():
    points, _ = uneven()
    squared = cdist(points, points, "sqeuclidean")
    assert diffuse(1e-12 * squared) == pytest.approx(diffuse(squared))


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_few_shapes(count):
    points = np.random.default_rng(0).normal(size=(count, 3))
    diffused = diffuse(cdist(points, points, "sqeuclidean"))
    assert np.isfinite(diffused).all()
    assert (diffused[~np.eye(count, dtype=bool)] > 0).all()
    assert find_related(points, 48).shape == (count, count - 1)


def test_copies_and_strangers():
    """A dozen copies of one shape, three of another, and one that is far from all."""
    points = np.concatenate([np.zeros((12, 10)), np.ones((3, 10)), np.full((1, 10), 1e6), uneven()[0]])
    squared = cdist(points, points, "sqeuclidean")
    diffused = diffuse(squared)
    assert np.isfinite(diffused).all()
    assert ((diffused == 0) == (squared == 0)).all()
    assert (diffused == diffused.T).all()
    assert diffused[15, np.arange(len(points)) != 15].min() > diffused[12, 20]


def test_shapes_that_are_all_alike():
    assert (diffuse(np.zeros((9, 9))) == 0).all()


def test_the_order_of_rows_does_not_matter():
    points, _ = uneven()
    order = np.random.default_rng(1).permutation(len(points))
    found = find_related(points, 20)
    place = np.argsort(order)
    assert (find_related(points[order], 20) == place[found[order]]).all()


def test_related_shapes_come_by_their_distances():
    points, codes = uneven()
    squared = cdist(points, points, "sqeuclidean")
    diffused = diffuse(squared)
    found = find_related(points, 10)
    for row, others in enumerate(found):
        assert row not in others
        assert (np.diff(diffused[row, others]) > -1e-6).all()
    assert (codes[found] == codes[:, None]).mean() > 0.99


def test_links_grow_with_the_root():
    assert [links(count) for count in (1, 20, 120, 280, 4000)] == [3, 3, 7, 11, 42]
