"""Exact t-SNE: its affinities and its optimum against scikit-learn, and inputs without spread."""

from __future__ import annotations

import numpy as np
import pytest
from sklearn.manifold import TSNE
from threadpoolctl import threadpool_limits

from shapeviz_report.projections import squared_distances, tsne
from shapeviz_report.projections.base import classical_scaling
from shapeviz_report.projections.kernels.exact_tsne import affinities, descend
from shapeviz_report.quality import score

SEEDS = range(3)


@pytest.fixture(scope="module")
def groups() -> tuple[np.ndarray, list[str]]:
    """Six groups of 20 that overlap."""
    random = np.random.default_rng(3)
    values = np.repeat(random.normal(size=(6, 8)), 20, axis=0) + 0.9 * random.normal(size=(120, 8))
    return values, [f"class {i // 20}" for i in range(120)]


def shares_of(values: np.ndarray, perplexity: float) -> np.ndarray:
    return affinities(squared_distances(values).astype(np.float32), perplexity, len(values) - 1).astype(float)


def divergence(shares: np.ndarray, xy: np.ndarray) -> float:
    """The KL divergence of a map, as the paper defines it."""
    kernel = 1 / (1 + squared_distances(np.asarray(xy, dtype=np.float64)))
    np.fill_diagonal(kernel, 0)
    kernel /= kernel.sum()
    there = shares > 0
    return float((shares[there] * np.log(shares[there] / kernel[there])).sum())


@pytest.mark.parametrize("perplexity", [5.0, 30.0])
def test_affinities_by_bisection(groups, perplexity) -> None:
    squared = squared_distances(groups[0])
    count = len(squared)
    expected = np.zeros((count, count))
    for i in range(count):
        others = np.delete(np.arange(count), i)
        low, high = -10.0, 5.0
        for _ in range(60):
            middle = (low + high) / 2
            weights = np.exp(-np.exp(middle) * squared[i, others])
            p = weights / weights.sum()
            entropy = -(p * np.log(np.maximum(p, 1e-300))).sum()
            low, high = (middle, high) if entropy > np.log(perplexity) else (low, middle)
        expected[i, others] = p
    expected = (expected + expected.T) / (2 * count)
    assert shares_of(groups[0], perplexity) == pytest.approx(expected, abs=1e-4 * expected.max())


@pytest.mark.slow
def test_as_good_as_scikit_learn(groups) -> None:
    values, labels = groups
    perplexity = tsne.perplexity_of(len(values))
    shares = shares_of(values, perplexity)
    squared = squared_distances(values)
    ours = [tsne.arrange(squared, seed) for seed in SEEDS]
    with threadpool_limits(limits=1):
        theirs = [
            TSNE(perplexity=perplexity, init="random", random_state=s).fit_transform(values) for s in SEEDS
        ]
    our_kl, their_kl = ([divergence(shares, xy) for xy in maps] for maps in (ours, theirs))
    our_nh, their_nh = ([score(xy, labels).nh_s for xy in maps] for maps in (ours, theirs))
    assert np.mean(our_kl) < np.mean(their_kl) + 0.02
    assert np.mean(our_nh) == pytest.approx(np.mean(their_nh), abs=0.03)


def test_the_gradient_has_vanished(groups) -> None:
    shares = shares_of(groups[0], tsne.perplexity_of(len(groups[0])))
    xy = tsne.arrange(squared_distances(groups[0]), 0).astype(np.float64)
    apart = xy[:, None] - xy[None]
    kernel = 1 / (1 + (apart**2).sum(axis=2))
    np.fill_diagonal(kernel, 0)
    pull = 4 * ((shares * kernel)[..., None] * apart).sum(axis=1)
    push = 4 * ((kernel**2 / kernel.sum())[..., None] * apart).sum(axis=1)
    assert np.linalg.norm(pull - push) < 0.01 * np.linalg.norm(pull)


def test_a_run_repeats_to_the_bit(groups) -> None:
    squared = squared_distances(groups[0])
    assert (tsne.arrange(squared, 4) == tsne.arrange(squared, 4)).all()


def test_equal_distances_have_equal_shares() -> None:
    shares = affinities((1 - np.eye(8)).astype(np.float32), 2.0, 7)
    assert shares[~np.eye(8, dtype=bool)] == pytest.approx(1 / 56)
    assert (np.diag(shares) == 0).all()


def test_more_twins_than_the_perplexity_asks_for() -> None:
    values = np.concatenate([np.zeros((20, 2)), np.random.default_rng(0).random((10, 2)) + 1])
    shares = shares_of(values, 5.0)
    assert shares.sum() == pytest.approx(1, abs=1e-5)
    assert np.isfinite(shares).all()
    xy = tsne.arrange(squared_distances(values), 0)
    assert np.isfinite(xy).all()


def test_the_start_of_rows_without_clear_groups_is_not_lost() -> None:
    """Exaggeration may pull all rows together; their differences must outlive it."""
    random = np.random.default_rng(3)
    values = np.repeat(random.normal(size=(14, 50)), 20, axis=0) + 1.6 * random.normal(size=(280, 50))
    squared = squared_distances(values).astype(np.float32)
    shares = affinities(squared, 30.0, 90)
    start = tsne._start(classical_scaling(squared), 3).astype(np.float32)
    quality = score(
        descend(shares, start, np.float32(4), np.float32(50)).astype(float),
        [f"{i // 20}" for i in range(280)],
    )
    assert quality.nh_s > 0.7
    assert quality.null_mean < 0.1


def test_only_the_nearest_have_a_share(groups) -> None:
    squared = squared_distances(groups[0]).astype(np.float32)
    shares = affinities(squared, 10.0, 30)
    np.fill_diagonal(squared, np.inf)
    nearest = squared.argsort(axis=1)[:, :30]
    near = np.zeros(squared.shape, dtype=bool)
    np.put_along_axis(near, nearest, True, axis=1)
    assert (shares[~(near | near.T)] == 0).all()
    assert (shares[near & near.T] > 0).all()
    assert shares.sum() == pytest.approx(1, abs=1e-5)
