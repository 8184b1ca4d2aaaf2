"""Similar shapes: the distances of projections, the reasons, and shapes that are not in the database."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reports import make_report, with_external
from similar_cases import similar_cases

from shapeviz_report.bins import scale_bins
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.similarity import rank_similar

REPORT = with_external(make_report(["ant", "bird"], 9, features=("Gc", "Sc", "PFH")))
TABLE = REPORT.features


def distances_from(values, row):
    return np.linalg.norm(values - values[row], axis=1)


@pytest.mark.parametrize("preset", PRESETS.values(), ids=str)
def test_distances_are_those_of_projections(preset):
    found = rank_similar(TABLE, preset, TABLE.values[4], member=4, count=99)
    expected = distances_from(scale(TABLE, preset), 4)
    assert [shape.row for shape in found] == [row for row in np.argsort(expected) if row != 4]
    assert [shape.distance for shape in found] == pytest.approx([expected[shape.row] for shape in found])


@pytest.mark.parametrize("preset", PRESETS.values(), ids=str)
def test_distances_by_some_features_are_those_of_their_columns(preset):
    columns = np.r_[TABLE.slice_of("Sc"), TABLE.slice_of("own")]
    expected = distances_from(scale(TABLE, preset)[:, columns], 0)
    for shape in rank_similar(TABLE, preset, TABLE.values[0], features=["own", "Sc"], member=0, count=5):
        assert shape.distance == pytest.approx(expected[shape.row])


@pytest.mark.parametrize("preset", PRESETS.values(), ids=str)
def test_distances_by_bins_are_those_of_their_maps(preset):
    bins = ["Gc:3", "PFH:10", "own[1]"]
    expected = distances_from(scale_bins(TABLE, preset, bins), 7)
    for shape in rank_similar(TABLE, preset, TABLE.values[7], bins=bins, member=7, count=5):
        assert shape.distance == pytest.approx(expected[shape.row])


def test_a_shape_of_the_database_finds_itself_first_unless_told_not_to():
    itself, *rest = rank_similar(TABLE, PRESETS["default"], TABLE.values[3], count=4)
    assert (itself.row, itself.distance) == (3, 0)
    assert [s.row for s in rank_similar(TABLE, PRESETS["default"], TABLE.values[3], member=3, count=3)] == [
        s.row for s in rest
    ]


def test_a_reason_is_the_share_of_the_other_shapes_that_are_farther():
    preset = PRESETS["default"]
    scaled = scale(TABLE, preset)
    for shape in rank_similar(TABLE, preset, TABLE.values[2], features=["Gc"], member=2, count=99):
        others = [row for row in range(len(scaled)) if row not in (2, shape.row)]
        for number, block in enumerate(TABLE.blocks):
            own = distances_from(scaled[:, TABLE.slice_of(block.name)], 2)
            assert shape.closer[number] == np.mean(own[others] > own[shape.row])


def test_equal_distances_give_equal_reasons():
    twins = replace(TABLE, values=TABLE.values[[0, 1, 1, 2, *range(4, 18)]])
    found = {s.row: s for s in rank_similar(twins, PRESETS["default"], twins.values[0], member=0, count=99)}
    assert np.array_equal(found[1].closer, found[2].closer)
    assert found[1].distance == found[2].distance


def test_a_feature_that_is_the_same_for_all_tells_nothing():
    values = TABLE.values.copy()
    values[:, TABLE.slice_of("Sc")] = 0.1
    found = rank_similar(replace(TABLE, values=values), PRESETS["default"], values[0], member=0, count=3)
    assert [shape.closer[1] for shape in found] == [0.5] * 3
    everywhere = rank_similar(
        replace(TABLE, values=values), PRESETS["default"], values[0], features=["Sc"], member=0
    )
    assert {shape.distance for shape in everywhere} == {0}


def test_the_only_other_shape_has_nothing_to_be_compared_with():
    pair = replace(TABLE, shape_ids=TABLE.shape_ids[:2], values=TABLE.values[:2])
    (found,) = rank_similar(pair, PRESETS["default"], pair.values[0], member=0)
    assert found.row == 1
    assert set(found.closer) == {0.5}
    alone = replace(TABLE, shape_ids=TABLE.shape_ids[:1], values=TABLE.values[:1])
    assert rank_similar(alone, PRESETS["default"], alone.values[0], member=0) == ()


def test_a_query_does_not_change_how_the_database_is_compared():
    """However far away it is, a new shape is measured with the stretches of the database."""
    far = TABLE.values[0].copy()
    far[TABLE.slice_of("own")] = 1000.0
    found = rank_similar(TABLE, PRESETS["default"], far, features=["own"], count=1)[0]
    own = TABLE.values[:, TABLE.slice_of("own")]
    size = np.sqrt(((own - own.mean(axis=0)) ** 2).sum(axis=1).mean() / TABLE.blocks[-1].weight)
    assert found.distance == pytest.approx(np.linalg.norm(own - 1000, axis=1).min() / size)


def test_cases_for_the_browser_cover_every_kind_of_choice():
    cases = similar_cases(REPORT)
    assert {(case["features"] is None, case["bins"] is None) for case in cases} == {
        (True, True),
        (False, True),
        (True, False),
    }
    assert all(len(case["found"]) == len(TABLE.values) - 1 for case in cases)
