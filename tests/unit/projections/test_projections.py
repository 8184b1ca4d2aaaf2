"""Every projection: finds groups, is seeded, and does not depend on the order of the rows."""

from __future__ import annotations

import numpy as np
import pytest
from sklearn.decomposition import PCA

from shapeviz_report.projections import PROJECTIONS, align, arrange, project, squared_distances
from shapeviz_report.projections.base import classical_scaling, principal_components
from shapeviz_report.quality import score

STRAIGHT = {"pca"}
"""Methods that only look at the rows from the best side: they draw nothing, and part groups less."""

METHODS = pytest.mark.parametrize("method", PROJECTIONS, ids=lambda m: m.name)


@pytest.fixture(scope="module")
def groups() -> tuple[np.ndarray, list[str]]:
    """Five groups of 15 in 30 dimensions."""
    random = np.random.default_rng(0)
    centres = random.normal(size=(5, 30))
    values = np.repeat(centres, 15, axis=0) + 0.3 * random.normal(size=(75, 30))
    return values, [f"class {i // 15}" for i in range(75)]


@pytest.mark.slow
@METHODS
def test_groups_stay_together(method, groups) -> None:
    values, labels = groups
    projection = project(method, values, ("x",), 0)
    assert projection.xy.shape == (75, 2)
    assert np.abs(projection.xy).max() == pytest.approx(1)
    assert score(projection.xy, labels).nh_s > (0.8 if method.name in STRAIGHT else 0.97)


@METHODS
def test_the_order_of_rows_does_not_matter(method, groups) -> None:
    values, _ = groups
    order = np.random.default_rng(1).permutation(len(values))
    first, second = (project(method, v, (), 3).xy for v in (values, values[order]))
    assert (second == first[order]).all()


@METHODS
def test_the_seed_decides(method, groups) -> None:
    values, _ = groups
    first, same, other = (project(method, values, (), seed).xy for seed in (1, 1, 2))
    assert (first == same).all()
    assert (first == other).all() == (method.name in STRAIGHT), "STRAIGHT names the methods without chance"


@METHODS
@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6])
def test_few_shapes(method, count) -> None:
    values = np.random.default_rng(0).random((count, 8))
    xy = project(method, values, (), 0).xy
    assert xy.shape == (count, 2)
    assert np.isfinite(xy).all()
    assert len(np.unique(xy, axis=0)) == count


@METHODS
def test_shapes_that_are_all_alike(method) -> None:
    assert (project(method, np.ones((12, 4)), (), 0).xy == 0).all()


@METHODS
def test_some_shapes_alike(method, groups) -> None:
    values = np.concatenate([groups[0], groups[0][:20]])
    assert np.isfinite(project(method, values, (), 0).xy).all()


def test_principal_components_against_scikit_learn(groups) -> None:
    values, _ = groups
    expected = PCA(2).fit_transform(values)
    found = principal_components(values)
    assert np.abs(found) == pytest.approx(np.abs(expected))


def test_classical_scaling_finds_the_principal_components(groups) -> None:
    values, _ = groups
    assert classical_scaling(squared_distances(values)) == pytest.approx(
        principal_components(values), abs=1e-9
    )
    on_a_line = np.array([[0.0], [1], [2], [3], [4], [9]]) * [1, 2]
    found = classical_scaling(squared_distances(on_a_line))
    assert found == pytest.approx(principal_components(on_a_line), abs=1e-6)


@METHODS
def test_distances_that_are_all_zero(method) -> None:
    assert (arrange(method, np.zeros((9, 9)), 0) == 0).all()


@METHODS
def test_many_rows_are_laid_out_by_their_values(method, groups, monkeypatch) -> None:
    values, labels = groups
    monkeypatch.setattr("shapeviz_report.projections.base.PAIRWISE_LIMIT", 50)
    xy = project(method, values, (), 0).xy
    assert score(xy, labels).nh_s > (0.8 if method.name in STRAIGHT else 0.97)


def test_aligning_undoes_turns_and_mirrors(groups) -> None:
    reference = project(PROJECTIONS[2], groups[0], (), 0)
    turn = np.array([[np.cos(2), -np.sin(2)], [np.sin(2), np.cos(2)]]) @ np.diag([1, -1])
    turned = type(reference)("pca", (), 0, 3 * reference.xy @ turn)
    # The square that a map fits changes as it turns, and with it its place and size; its form does not.
    ours, theirs = (p.xy - p.xy.mean(axis=0) for p in (align(turned, reference), reference))
    assert ours / np.linalg.norm(ours) == pytest.approx(theirs / np.linalg.norm(theirs), abs=0.05)
