"""Groups that features alone make: those that are there are found, whatever the order, and are told in true words."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from reports import make_report, with_clusters
from scipy.sparse import csr_matrix
from sklearn.metrics import adjusted_rand_score, silhouette_samples

from shapeviz_report.clusters import (
    STEADY,
    _word_shares,
    describe_clusters,
    find_communities,
    part,
    silhouettes,
)
from shapeviz_report.presets import PRESETS
from shapeviz_report.types import FeatureBlock, FeatureTable, ShapeEntry
from shapeviz_report.wording import GLOBAL_WORDINGS, Dimension

PRESET = PRESETS["default"]


def blobs(*sizes: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Points around some far places in eight dimensions, shuffled, and the place of each."""
    random = np.random.default_rng(seed)
    truth = random.permutation(np.repeat(np.arange(len(sizes)), sizes))
    return 6 * np.eye(8)[truth] + random.normal(0, 0.7, (len(truth), 8)), truth


def entries(names: list[str]) -> list[ShapeEntry]:
    return [ShapeEntry(f"{row:03}", Path(f"{row:03}.off"), name) for row, name in enumerate(names)]


def test_groups_that_are_there_are_found_with_their_number() -> None:
    values, truth = blobs(30, 12, 20, 16)
    found = part(values)
    assert adjusted_rand_score(truth, found.of) == 1
    assert np.bincount(found.of).tolist() == [30, 20, 16, 12], "by falling size"
    assert found.silhouette == pytest.approx(silhouette_samples(values, truth).mean())


@pytest.mark.slow
def test_the_order_of_shapes_has_no_say() -> None:
    # Noise has no clear groups: here an order could decide.
    values = np.random.default_rng(3).normal(0, 1, (60, 6))
    order = np.random.default_rng(4).permutation(60)
    first, second = part(values), part(values[order])
    assert adjusted_rand_score(first.of[order], second.of) == 1
    assert second.silhouette == first.silhouette


def test_equal_shapes_are_in_one_group() -> None:
    values, _ = blobs(12, 12)
    copies = np.concatenate([values, np.repeat(values[:1], 40, axis=0)])
    assert set(part(copies).of[24:]) == {part(copies).of[0]}


def test_a_sample_decides_for_all() -> None:
    values, truth = blobs(*[40] * 5)
    found = part(values, limit=90)
    assert adjusted_rand_score(truth, found.of) == 1


@pytest.mark.parametrize(
    "values",
    [
        blobs(4, 3)[0],
        np.ones((50, 3)),
        np.repeat(blobs(4, 3)[0], 9, axis=0),
    ],
    ids=["seven shapes", "all alike", "seven kinds"],
)
def test_where_nothing_can_be_told_apart_there_are_no_groups(values) -> None:
    assert part(values) is None


def test_communities_of_a_graph_are_its_cliques() -> None:
    ties = np.kron(np.eye(3), np.ones((5, 5))) - np.eye(15)
    for one, other in ((4, 5), (9, 10)):
        ties[one, other] = ties[other, one] = 1
    codes = find_communities(csr_matrix(ties), seed=0)
    assert adjusted_rand_score(np.repeat([0, 1, 2], 5), codes) == 1
    assert set(codes) == {0, 1, 2}


@pytest.mark.slow
@pytest.mark.parametrize("sizes", [(90, 90), (70, 70, 70)])
def test_large_groups_are_not_cut_at_will(sizes) -> None:
    values, truth = blobs(*sizes)
    found = part(values)
    assert adjusted_rand_score(truth, found.of) == 1
    assert found.steadiness > STEADY


def test_cuts_through_noise_are_not_steady() -> None:
    found = part(np.random.default_rng(0).normal(0, 1, (60, 8)))
    assert found is None or (found.steadiness < STEADY and found.silhouette < 0.2)


def test_silhouettes_are_those_of_scikit_learn() -> None:
    values, truth = blobs(9, 5, 1)
    distances = np.linalg.norm(values[:, None] - values, axis=2)
    expected = silhouette_samples(values, truth)
    assert silhouettes(distances, truth) == pytest.approx(expected)
    assert silhouettes(distances, truth)[truth == 2] == 0, "alone in its group"


def test_a_cluster_has_the_name_of_its_most_central_shape() -> None:
    values, truth = blobs(12, 10, 9)
    partition = part(values)
    table = FeatureTable(tuple(f"{i:03}" for i in range(31)), (FeatureBlock("own", 8, 1),), values)
    centres = [
        int(
            np.flatnonzero(truth == k)[
                np.linalg.norm(values[truth == k] - values[truth == k].mean(axis=0), axis=1).argmin()
            ]
        )
        for k in range(3)
    ]
    names = [f"thing {row}" for row in range(31)]
    found = describe_clusters(
        partition, entries(names), table, values, np.empty((0, 11)), PRESET, stand_in=False
    )
    assert [cluster.central for cluster in found.clusters] == centres
    assert [cluster.size for cluster in found.clusters] == [12, 10, 9]
    assert [cluster.name for cluster in found.clusters] == [f"like thing {row}" for row in centres]
    names[centres[0]] = names[centres[1]]
    found = describe_clusters(
        partition, entries(names), table, values, np.empty((0, 11)), PRESET, stand_in=False
    )
    # Two central shapes share a name: then ids tell all apart.
    assert [cluster.name for cluster in found.clusters] == [
        f"like {centres[0]:03}",
        f"like {centres[1]:03}",
        f"like {centres[2]:03}",
    ]


def test_what_is_typical_is_said_with_the_right_figures() -> None:
    values, truth = blobs(12, 10, 9)
    blocks = (FeatureBlock("Nd", 1, 10), FeatureBlock("Sc", 24, 10), FeatureBlock("own", 1, 1))
    random = np.random.default_rng(1)
    shares = random.uniform(0.95, 1.05, (31, 25, 10))
    # The first group is thick: nine tenths of its surface lie in the two upper bins, elsewhere two tenths.
    shares[truth == 0, 0] = [0.0125] * 8 + [0.45] * 2
    shares /= shares.sum(axis=2, keepdims=True)
    own = random.normal(0, 0.01, 31) + np.where(truth == 1, -3.0, 5.0)
    table = FeatureTable(
        tuple(f"{i:03}" for i in range(31)), blocks, np.column_stack([shares.reshape(31, -1), own])
    )
    edges = np.tile(np.linspace(0, 1, 11), (25, 1))
    found = describe_clusters(part(values), entries(["x"] * 31), table, values, edges, PRESET, stand_in=False)
    thick = found.clusters[0].typical
    assert thick[0] == (
        "Bodies are thicker: 90\u00a0% of the surface is thicker than 0.8 radii, in other shapes 20\u00a0%."
    )
    assert all("of the shape" not in sentence for sentence in thick)
    assert "Own is lower than in other shapes: −3 against 5." in found.clusters[1].typical
    assert any(sentence.startswith("Bodies are thinner: ") for sentence in found.clusters[2].typical)


def test_roots_of_shares_are_told_as_the_mean_of_the_shares() -> None:
    values, truth = blobs(12, 10, 9)
    block = FeatureBlock("Sfl", len(GLOBAL_WORDINGS["Sfl"].names), 1)
    roots = np.full((31, block.width), 0.05)
    # Shares of 16 and 36 % have a mean of 26 %, where the root of the mean root is 25 %.
    roots[truth == 0, 7] = np.tile([0.4, 0.6], 6)
    roots[truth != 0, 7] = 0.1
    table = FeatureTable(tuple(f"{i:03}" for i in range(31)), (block,), roots)
    edges = np.empty((0, 11))
    found = describe_clusters(part(values), entries(["x"] * 31), table, values, edges, PRESET, stand_in=False)
    assert (
        found.clusters[0]
        .typical[0]
        .endswith(" is higher than in other shapes: 26\u00a0% against 1.0\u00a0%.")
    )


def test_clusters_stand_in_only_where_no_shape_has_a_label() -> None:
    labelled = with_clusters(make_report(classes=("ant", None), per_class=10))
    assert not labelled.clusters.stand_in
    assert labelled.labels[-1] is None, "a shape without a label keeps having none"
    plain = with_clusters(make_report(classes=(None, None, None), per_class=10))
    assert plain.clusters.stand_in
    assert plain.labeling == "clusters"
    assert plain.labels == tuple(plain.clusters.clusters[code].name for code in plain.clusters.of)
    few = make_report(classes=(None,), per_class=7)
    assert with_clusters(few) == replace(few)


@pytest.mark.parametrize("name", ["Pa", "Na", "Agd", "Gc"])
@pytest.mark.parametrize("step", range(9))
@pytest.mark.parametrize("more", [True, False])
def test_the_figure_is_of_what_the_sentence_begins_with(name, step, more) -> None:
    """Of less of something the smaller share is told, of what there is less of; else the larger one."""
    low, high = {"Pa": (0, 90), "Na": (0, 90), "Agd": (0, 2), "Gc": (-10, 10)}[name]
    block = FeatureBlock(name, 1, 10)
    dimension = Dimension(block, 0, np.linspace(low, high, 11))
    # Shares above the edge.
    here, there = (0.9, 0.8) if more else (0.2, 0.3)
    sentence = _word_shares(dimension, step, here, there, PRESET).replace("\u00a0", " ")
    own, others = (
        float(share) for share in re.findall(r"(\d+) % of the surface .*other shapes (\d+) %", sentence)[0]
    )
    edge = float(dimension.edges[step + 1])
    above = dimension.say(edge, None).clause in sentence
    assert above is not (dimension.say(None, edge).clause in sentence)
    assert (own, others) == ((100 * here, 100 * there) if above else (100 - 100 * here, 100 - 100 * there))
    assert (own < others) is sentence.startswith(("Less ", "There are fewer "))


def test_what_differs_by_hardly_anything_is_not_told() -> None:
    values, truth = blobs(12, 10, 9)
    block = FeatureBlock("Sfl", len(GLOBAL_WORDINGS["Sfl"].names), 1)
    roots = np.full((31, block.width), 0.05)
    # Shares of 0.1 % and of less: far apart in deviations, and nothing to see.
    roots[truth == 0, 7] = 0.03
    roots[truth != 0, 7] = 0.01
    table = FeatureTable(tuple(f"{i:03}" for i in range(31)), (block,), roots)
    found = describe_clusters(
        part(values), entries(["x"] * 31), table, values, np.empty((0, 11)), PRESET, stand_in=False
    )
    assert [cluster.typical for cluster in found.clusters] == [()] * 3


@pytest.mark.parametrize(("spread", "first"), [(0.1, "Bodies are thicker"), (0.6, "Share of pairs")])
def test_values_of_whole_shapes_lead_only_where_they_say_much_more(spread, first) -> None:
    values, truth = blobs(12, 10, 9)
    random = np.random.default_rng(2)
    thick = np.where(truth == 0, 0.6, 0.4) + random.normal(0, spread, 31) * 0.8
    shares = np.zeros((31, 10))
    shares[:, 9] = np.clip(thick, 0.05, 0.95)
    shares[:, 0] = 1 - shares[:, 9]
    roots = np.full((31, len(GLOBAL_WORDINGS["Sfl"].names)), 0.05)
    roots[:, 7] = np.where(truth == 0, 0.5, 0.1) + random.normal(0, 0.02, 31)
    blocks = (FeatureBlock("Sfl", roots.shape[1], 1), FeatureBlock("Nd", 1, 10))
    table = FeatureTable(tuple(f"{i:03}" for i in range(31)), blocks, np.hstack([roots, shares]))
    edges = np.linspace(0, 1, 11)[None]
    found = describe_clusters(part(values), entries(["x"] * 31), table, values, edges, PRESET, stand_in=False)
    assert found.clusters[0].typical[0].startswith(first)
