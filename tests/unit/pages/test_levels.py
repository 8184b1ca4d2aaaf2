"""The values of very many shapes in parts: each says what the table holds, to a level."""

from __future__ import annotations

import numpy as np
import pytest
from reports import make_report, with_external

from shapeviz_report.pages import base, levels
from shapeviz_report.pages.levels import LEVELS, level_parts, level_table, levels_chunk
from shapeviz_report.pages.shape import ShapePage
from shapeviz_report.presets import PRESETS, compared_values
from shapeviz_report.similarity import feature_weight, squared_by_feature

PRESET = PRESETS["default"]
CLASSES = ("ant", "bird", None, "cup")


@pytest.fixture(scope="module")
def report():
    return with_external(make_report(CLASSES, 40))


@pytest.fixture(scope="module")
def table(report):
    return level_table(report, PRESET)


@pytest.fixture(scope="module")
def parts(table):
    return {name: list(made) for name, made in level_parts(table).items()}


@pytest.fixture(scope="module")
def compared(report):
    return compared_values(report.features, PRESET)


def told(table, values):
    return table.low + (table.high - table.low) / LEVELS * np.asarray(values, float)


def steps(table):
    return (table.high - table.low) / LEVELS


def test_rows_and_columns_hold_the_compared_values_to_half_a_level(table, parts, compared):
    width = compared.shape[1]
    rows = np.frombuffer(b"".join(parts["rows"]), np.uint8).reshape(-1, width)
    assert np.all(np.abs(told(table, rows) - compared[table.order]) <= steps(table) / 2 + 1e-12)
    columns = np.frombuffer(b"".join(parts["columns"]), np.uint8).reshape(width, -1)
    np.testing.assert_array_equal(columns.T[table.order], rows)


def test_a_part_of_columns_is_of_one_feature(report, parts):
    sizes = [len(part) // len(report.shapes) for part in parts["columns"]]
    expected = [
        min(levels.COLUMNS_A_PART, block.width - start)
        for block in report.features.blocks
        for start in range(0, block.width, levels.COLUMNS_A_PART)
    ]
    assert sizes == expected
    assert min(sizes) < levels.COLUMNS_A_PART


def test_rows_lie_class_by_class_and_scattered_within(report, table):
    codes = base.class_codes(report)
    np.testing.assert_array_equal(codes[table.order], np.sort(codes))
    assert sorted(table.order.tolist()) == list(range(len(codes)))
    own = table.order[codes[table.order] == 1]
    assert np.any(np.diff(own) < 0)


def test_components_rank_as_the_features_do(report, table, parts, compared):
    """Few rows need no more components than there are here: what is lost is rounding."""
    for row in (0, 57, 159):
        exact = squared_by_feature(report.features, PRESET, compared, compared[row])
        for number, part in enumerate(parts["components"]):
            places = part["values"].reshape(-1, len(compared)).astype(float)
            found = ((places - places[:, [row]]) ** 2).sum(axis=0) * part["unit"]
            block = report.features.blocks[number]
            if block.width <= levels.COMPONENTS:
                np.testing.assert_allclose(np.sqrt(found), np.sqrt(exact[:, number]), atol=0.03)
            else:
                # Without the last components two shapes are nearer, but not much.
                assert np.all(np.sqrt(found) <= np.sqrt(exact[:, number]) + 0.03)
                assert np.corrcoef(found, exact[:, number])[0, 1] > 0.95


def test_few_components_find_the_most_similar(report, table, compared, monkeypatch):
    """Of the ten most similar shapes, nearly all are among the 48 that the components would have ranked anew."""
    monkeypatch.setattr(levels, "COMPONENTS", 4)
    places = [part for part in levels.component_parts(table)]
    kept = []
    for row in range(0, 160, 10):
        exact = squared_by_feature(report.features, PRESET, compared, compared[row]).sum(axis=1)
        found = sum(
            ((own - own[:, [row]]) ** 2).sum(axis=0) * part["unit"]
            for part in places
            for own in [part["values"].reshape(-1, len(compared)).astype(float)]
        )
        best, candidates = np.argsort(exact)[1:11], np.argsort(found)[1:49]
        kept.append(len(np.intersect1d(best, candidates)) / 10)
    assert np.mean(kept) > 0.9


def test_classes_count_their_levels(report, table, parts):
    codes = base.class_codes(report)
    assert len(parts["classes"]) == 4
    for code, part in enumerate(parts["classes"]):
        own = table.values if code == 3 else table.values[codes == code]
        assert part["shapes"] == len(own)
        np.testing.assert_allclose(part["means"], own.mean(axis=0), rtol=1e-5)
        np.testing.assert_allclose(part["variances"], own.var(axis=0), rtol=1e-4, atol=1e-4)
        shares = report.features.values if code == 3 else report.features.values[codes == code]
        for block in report.features.blocks:
            columns = report.features.slice_of(block.name)
            if block.bins == 1:
                assert not part["upTo"][columns].any()
                continue
            dimensions = shares[:, columns].reshape(len(own), -1, block.bins)
            np.testing.assert_allclose(
                np.sqrt(part["upTo"][columns]), dimensions.cumsum(axis=2).std(axis=0).ravel(), atol=0.01
            )
        cells = part["cells"].reshape(own.shape[1], levels.CELLS)
        for column in (0, 7, own.shape[1] - 1):
            np.testing.assert_array_equal(
                cells[column],
                np.bincount(own[:, column] // levels.LEVELS_A_CELL, minlength=levels.CELLS),
            )


def test_what_all_parts_share_is_of_all_shapes(report, table, compared):
    chunk = levels_chunk(table)
    np.testing.assert_allclose(chunk["variances"], compared.var(axis=0), rtol=1e-9, atol=1e-15)
    for block, weight in zip(report.features.blocks, chunk["weights"], strict=True):
        own = compared[:, report.features.slice_of(block.name)]
        assert weight == pytest.approx(feature_weight(block, PRESET, own), rel=1e-9)


def test_plain_fractions_weigh_alike(report):
    assert level_table(report, PRESETS["paper"]).weights.tolist() == [1.0] * len(report.features.blocks)


def test_a_database_of_one_class_or_none_has_its_spread_in_the_last_part():
    parts = level_parts(level_table(make_report((None,), 5), PRESET))
    (whole,) = parts["classes"]
    assert whole["shapes"] == 5


def test_a_value_that_all_shapes_share_is_level_zero():
    report = make_report(("ant", "bird"), 5)
    report.features.values[:, 3] = 0.25
    report.features.values[:, 10:] = 0.1
    table = level_table(report, PRESET)
    assert not table.values[:, 3].any()
    assert told(table, table.values)[0, 3] == pytest.approx(0.5)
    places = list(level_parts(table)["components"])
    assert places[1]["unit"] == 0
    assert np.ptp(places[1]["values"]) == 0


def test_only_a_large_site_has_them(report, monkeypatch):
    assert ShapePage().content(report).parts == {}
    monkeypatch.setattr(base, "MOST_IN_FULL", 50)
    content = ShapePage().content(report)
    assert content.chunks.keys() == {"levels"}
    assert content.parts.keys() == {"rows", "columns", "components", "classes"}


def test_the_same_report_gives_the_same_bytes(report, parts):
    again = level_parts(level_table(report, PRESET))
    for name, made in again.items():
        for one, other in zip(made, parts[name], strict=True):
            np.testing.assert_equal(one, other)
