"""The whole search on a small database: complete, frugal, independent of the order, honest about limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shapeviz_report.quality import score
from shapeviz_report.search import make_space, map_subsets, planned_runs, search_features
from shapeviz_report.types import FeatureBlock, FeatureTable

LABELS = [f"class {i // 12}" for i in range(36)]


def table_of(values: np.ndarray, widths: tuple[int, ...]) -> FeatureTable:
    blocks = tuple(FeatureBlock(f"F{i}", width, 1) for i, width in enumerate(widths))
    return FeatureTable(tuple(f"s{i}" for i in range(len(values))), blocks, values)


@pytest.fixture(scope="module")
def values() -> np.ndarray:
    """F0 knows class 0, F1 class 2, F2 nothing."""
    random = np.random.default_rng(0)
    values = random.normal(size=(36, 6))
    values[:12, 0:2] += 6
    values[24:, 2:4] += 6
    values[:, 4:] *= 2
    return values


class Counting:
    """Makes maps and remembers which."""

    def __init__(self, space) -> None:
        self.space, self.asked = space, []

    def __call__(self, seed, subsets):
        self.asked += [(seed, s) for s in subsets]
        return map_subsets(self.space.squared, "tsne", seed, subsets)


@pytest.fixture(scope="module")
def searched(values):
    space = make_space(table_of(values, (2, 2, 2)), values, LABELS)
    evaluate = Counting(space)
    return search_features(space, LABELS, "tsne", evaluate=evaluate, rounds=2, k=8), evaluate


def test_no_map_is_made_twice_and_all_were_announced(searched) -> None:
    _, evaluate = searched
    assert len(evaluate.asked) == len(set(evaluate.asked)) <= planned_runs(3, "tsne", rounds=2)


def test_all_subsets_are_there(searched) -> None:
    result, _ = searched
    subsets = result.subsets
    assert result.exhaustive
    assert result.refusal is None
    assert (subsets.members @ [1, 2, 4]).tolist() == list(range(1, 8))
    assert subsets.xy.shape == (7, 36, 2)
    assert np.abs(subsets.xy).max(axis=(1, 2)) == pytest.approx(1)


def test_scores_are_those_of_the_maps(searched) -> None:
    result, _ = searched
    for xy, nh, nh_s, nh_c in zip(*(getattr(result.subsets, n) for n in ("xy", "nh", "nh_s", "nh_c"))):
        quality = score(xy.astype(float), LABELS, k=8)
        assert nh == pytest.approx(quality.nh, abs=1e-6)
        assert nh_s == pytest.approx(quality.nh_s)
        assert dict(zip(result.classes, nh_c)) == pytest.approx(quality.nh_c)


def test_it_finds_the_features_that_know_something(searched) -> None:
    result, _ = searched
    assert result.subsets.members[result.subsets.nh_s.argmax()].tolist() == [True, True, False]
    assert [g.path[-1].features for g in result.greedy] == [("F0", "F1")] * 3
    assert result.spread[0].features == ("F0", "F1")
    effects = {e.feature: e for e in result.effects}
    assert min(effects["F0"].added, effects["F1"].added) > 0.1 > effects["F2"].added
    assert effects["F0"].mean_with > effects["F0"].mean_without
    assert [fold.features for fold in result.held_out] == [("F0", "F1")] * 50
    assert result.null_best.max() < result.subsets.nh_s.max()


def test_table_2(searched) -> None:
    result, _ = searched
    rows = [(row.round, row.method, row.s) for row in result.table]
    expected = [("exhaustive", None), ("greedy", 1), ("greedy", 2), ("greedy", 3)]
    assert rows == [(round_, *method) for round_ in (1, 2) for method in expected]
    first = result.table[:4]
    assert first[0].runs == first[3].runs == 7
    assert first[0].nh_s == result.subsets.nh_s.max()
    assert first[0].cpu_seconds == pytest.approx(result.subsets.cpu_seconds.sum())
    assert all(row.nh_s <= first[0].nh_s and row.cpu_seconds <= first[0].cpu_seconds for row in first)
    assert result.greedy[0].runs == first[1].runs


def test_the_order_of_shapes_does_not_matter(searched, values) -> None:
    result, _ = searched
    order = np.random.default_rng(2).permutation(36)
    labels = [LABELS[i] for i in order]
    again = search_features(
        make_space(table_of(values[order], (2, 2, 2)), values[order], labels), labels, "tsne", rounds=2, k=8
    )
    assert (again.subsets.xy == result.subsets.xy[:, order]).all()
    assert (again.subsets.nh == result.subsets.nh[:, order]).all()
    assert [f.nh_s for f in again.held_out] == [f.nh_s for f in result.held_out]
    assert (again.null_best == result.null_best).all()


def test_many_features_are_searched_greedily(values, monkeypatch) -> None:
    monkeypatch.setattr("shapeviz_report.search.run.GREEDY_SIZES", (1, 2))
    monkeypatch.setattr("shapeviz_report.search.run.NEIGHBOUR_LIMIT", 20)
    wide = np.concatenate([values, np.random.default_rng(1).normal(size=(36, 5))], axis=1)
    space = make_space(table_of(wide, (1,) * 11), wide, LABELS)
    evaluate = Counting(space)
    result = search_features(space, LABELS, "tsne", evaluate=evaluate, rounds=1)
    assert not result.exhaustive
    assert "11 features have 2,047 subsets" in result.refusal
    # The 66 subsets that s = 2 looks at are too many for the limit set here.
    assert {(row.method, row.s) for row in result.table} == {("greedy", 1)}
    assert len(set(evaluate.asked)) == len(evaluate.asked)
    # What a feature adds, it adds to all others.
    everything = result.subsets.nh_s[result.subsets.members.all(axis=1)][0]
    for i, effect in enumerate(result.effects):
        without = ~np.eye(11, dtype=bool)[i]
        assert effect.mean_with == everything
        assert effect.mean_without == result.subsets.nh_s[(result.subsets.members == without).all(axis=1)][0]
        assert effect.added == effect.mean_with - effect.mean_without
    assert result.effects[0].alone == result.subsets.nh_s[result.subsets.members.sum(axis=1) == 1][0]
    assert planned_runs(11, "tsne") is None


def test_of_many_features_all_subsets_of_the_papers_are_evaluated(values, monkeypatch) -> None:
    monkeypatch.setattr("shapeviz_report.search.run.GREEDY_SIZES", (1,))
    wide = np.concatenate([values, np.random.default_rng(1).normal(size=(36, 7))], axis=1)
    table = table_of(wide, (1,) * 13)
    blocks = (*(FeatureBlock(f"h{i}", 1, 2) for i in range(3)), *table.blocks[6:])
    space = make_space(replace(table, blocks=blocks), wide, LABELS)
    assert space.local == 3
    result = search_features(space, LABELS, "tsne", rounds=1)
    assert result.exhaustive
    more = (*blocks, *(FeatureBlock(f"more{i}", 1, 1) for i in range(4)))
    wider = np.concatenate([wide, np.random.default_rng(2).normal(size=(36, 4))], axis=1)
    space = make_space(replace(table, blocks=more, values=wider), wider, LABELS)
    result = search_features(space, LABELS, "tsne", rounds=1)
    assert not result.exhaustive
    assert "14 features have 16,383 subsets. Evaluated are all 7 of the paper's 3" in result.refusal
    of_paper = result.subsets.members[~result.subsets.members[:, 3:].any(axis=1)]
    assert len(of_paper) == 7


def test_without_labels_there_are_maps_only(values) -> None:
    labels = [None] * 36
    result = search_features(make_space(table_of(values, (2, 2, 2)), values, labels), labels, "tsne")
    assert len(result.subsets.xy) == 7
    assert np.isnan(result.subsets.nh_s).all()
    assert result.classes == result.greedy == result.table == result.spread == result.held_out == ()


@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_shapes(values, count) -> None:
    labels = LABELS[:count]
    table = table_of(values[:count], (2, 2, 2))
    result = search_features(make_space(table, values[:count], labels), labels, "tsne", rounds=1)
    assert result.subsets.xy.shape == (7, count, 2)
    assert np.isnan(result.subsets.nh_s).all() == (count == 1)


def test_one_feature_alone(values) -> None:
    result = search_features(make_space(table_of(values, (6,)), values, LABELS), LABELS, "tsne", rounds=1)
    assert result.table[0].features == ("F0",)
    assert result.effects[0].added is None


def test_a_sample_says_so(values) -> None:
    space = make_space(table_of(values, (2, 2, 2)), values, LABELS, limit=24)
    result = search_features(space, LABELS, "tsne", rounds=1)
    assert result.shape_count == 36
    assert len(result.rows) == 24
    assert (np.diff(result.rows) > 0).all()
    best = result.subsets.nh_s.argmax()
    quality = score(result.subsets.xy[best].astype(float), [LABELS[i] for i in result.rows])
    assert result.subsets.nh_s[best] == pytest.approx(quality.nh_s)


def test_umap(values, monkeypatch) -> None:
    monkeypatch.setattr("shapeviz_report.search.run.SPREAD_SEEDS", 2)
    space = make_space(table_of(values, (4, 2)), values, LABELS)
    result = search_features(space, LABELS, "umap", rounds=1)
    assert result.method == "umap"
    assert result.subsets.members.tolist() == [[True, False], [False, True], [True, True]]
    assert result.subsets.nh_s[0] > 0.9 > 0.6 > result.subsets.nh_s[1]
    assert {row.round for row in result.table} == {1}


def test_dearer_methods_have_fewer_rounds() -> None:
    # 255 subsets in each round; 12 finalists and all features for the rest of ten seeds.
    assert planned_runs(8, "tsne") == 3 * 255 + 7 * 13
    assert planned_runs(8, "umap") == 255 + 9 * 13


@pytest.mark.slow
def test_held_out_shapes_are_rated_without_copies_as_if_there_were_none(values) -> None:
    """Where every shape is there twice, one of each is held out with the other, and rated among the others' firsts."""
    twice = np.repeat(values, 2, axis=0)
    labels = [label for label in LABELS for _ in range(2)]
    space = make_space(table_of(twice, (2, 2, 2)), twice, labels)
    groups = np.arange(36).repeat(2)
    found = search_features(space, labels, "tsne", rounds=1, k=8, groups=groups)
    everything = np.flatnonzero(found.subsets.members.all(axis=1))[0]
    xy = found.subsets.xy[everything].astype(np.float64)
    alone = score(xy[::2], LABELS, k=8).nh
    # Each fold is of whole pairs; over all folds of a deal each shape counts once.
    first = [fold for fold in found.held_out if fold.deal == 1]
    assert sum(fold.shapes for fold in first) == 72
    assert all(fold.shapes % 2 == 0 for fold in found.held_out)
    mean = np.average([fold.nh_s_all_distinct for fold in first], weights=[fold.shapes for fold in first])
    assert mean == pytest.approx(alone.mean())
    assert all(
        fold.nh_s_distinct is None for fold in search_features(space, labels, "tsne", rounds=1, k=8).held_out
    )
