"""The automatic selection finds what was planted, whoever comes first, and nothing beyond its limit."""

from __future__ import annotations

import numpy as np
import pytest
from planted_bins import PLANTED, make_table

from shapeviz_report.presets import PRESETS
from shapeviz_report.quality import score
from shapeviz_report.search.bins import automatic, encode, make_bin_space, select_bins
from shapeviz_report.types import BinSelection, FeatureBlock, FeatureTable


@pytest.fixture(scope="module")
def selection(planted) -> BinSelection:
    return select_bins(planted.space, planted.labels, limit=6)


def test_planted_bins_are_found(selection) -> None:
    # Three bins tell four classes apart.
    assert len(set(selection.bins) & set(PLANTED)) >= 3
    assert selection.nh_s > 0.97
    assert selection.nh_s_other_seeds.mean() > 0.95


def test_the_path_leads_from_one_bin_to_the_result(selection) -> None:
    bins: set[str] = set()
    for step in selection.path:
        assert not bins & set(step.added)
        assert set(step.removed) <= bins
        bins = (bins | set(step.added)) - set(step.removed)
        assert bins == set(step.bins)
        assert len(step.added) + len(step.removed) == 1
    assert len(selection.path[0].bins) == 1
    assert selection.path[-1].nh_s > selection.path[0].nh_s


def test_every_step_states_the_hits_of_its_own_map(planted, selection) -> None:
    assert selection.rows.tolist() == list(range(48))
    for step in selection.path:
        assert score(step.xy, planted.labels).nh_s == pytest.approx(step.nh_s, abs=0.005)


def test_the_order_of_shapes_does_not_matter(planted, selection) -> None:
    order = np.random.default_rng(1).permutation(48)
    labels = [planted.labels[i] for i in order]
    space = make_bin_space(make_table(planted.table.values[order]), PRESETS["default"], labels)
    other = select_bins(space, labels, limit=6)
    assert [step.bins for step in other.path] == [step.bins for step in selection.path]
    assert [step.nh_s for step in other.path] == [step.nh_s for step in selection.path]
    assert (other.path[-1].xy == selection.path[-1].xy[order]).all()


def test_the_limit_holds(planted) -> None:
    found = select_bins(planted.space, planted.labels, limit=2)
    assert max(len(step.bins) for step in found.path) == 2


def test_shapes_without_a_label_count_as_misses(planted) -> None:
    labels = [None if i % 12 == 0 else label for i, label in enumerate(planted.labels)]
    found = select_bins(planted.space, labels, limit=4)
    # Of the eleven neighbours from a class one has no label: ten are taken, of which a miss is one in eleven.
    assert found.nh_s == pytest.approx(10 / 11, abs=0.03)


@pytest.mark.parametrize("label", ["ant", None])
def test_without_two_classes_nothing_is_selected(planted, label) -> None:
    found = select_bins(planted.space, [label] * 48)
    assert found.bins == ()
    assert np.isnan(found.nh_s)


def test_small_classes_are_kept_together_each_and_not_in_crowds() -> None:
    """Sixteen classes of three: in a space of crowds of twelve, four classes each, NH of ten neighbours is as high as
    in one in which every class lies apart."""
    classes = np.repeat(np.arange(16), 3)
    crowds, apart = classes // 4 / 4, classes / 16
    values = np.column_stack([crowds, apart]) + np.random.default_rng(0).random((48, 2)) / 1024
    labels = [f"{c:02}" for c in classes]
    table = FeatureTable(tuple(labels), (FeatureBlock("x", 1, 2),), values)
    space = make_bin_space(table, PRESETS["default"], labels)
    found = select_bins(space, labels)
    assert len(found.path[0].bins) == 1
    assert found.path[0].bins == (space.names[1],)
    assert found.nh_s == pytest.approx(0.2)


def test_above_the_limit_no_map_decides(planted, monkeypatch) -> None:
    monkeypatch.setattr(automatic, "CLIMB_LIMIT", 47)
    found = select_bins(planted.space, planted.labels, limit=6)
    _, codes = encode(planted.space, planted.labels)
    grown = automatic.grow(planted.space, codes, 10, 6)
    assert [set(step.bins) for step in found.path] == [set(planted.space.named(bins)) for bins in grown]
    spaces = [step.nh_space for step in found.path]
    assert spaces == sorted(spaces)
