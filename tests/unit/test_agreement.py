"""How much features count: by agreement with the others, against chance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shapeviz_report.agreement import weigh
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.types import FeatureBlock, FeatureTable

DEFAULT = PRESETS["default"]


def table_of(*blocks: np.ndarray) -> FeatureTable:
    named = tuple(FeatureBlock(f"f{i}", values.shape[1], 1) for i, values in enumerate(blocks))
    return FeatureTable(tuple(map(str, range(len(blocks[0])))), named, np.hstack(blocks))


def weights_of(table: FeatureTable) -> list[float]:
    return [block.weight for block in weigh(table, DEFAULT).blocks]


@pytest.fixture(scope="module")
def blocks() -> list[np.ndarray]:
    """Two features that see eight groups, one that sees half of it, and noise."""
    random = np.random.default_rng(0)
    centres = random.normal(size=(8, 6)) * 5
    place = np.repeat(centres, 15, axis=0)
    return [
        place + random.normal(size=(120, 6)),
        place @ random.normal(size=(6, 6)) + random.normal(size=(120, 6)),
        place + 12 * random.normal(size=(120, 6)),
        random.normal(size=(120, 6)),
    ]


def test_against_a_slow_count(blocks) -> None:
    table = table_of(*blocks)
    scaled = scale(table, DEFAULT)
    expected = []
    for block in table.blocks:
        own = np.zeros(len(table.columns), bool)
        own[table.slice_of(block.name)] = True
        shared = 0
        for row in range(120):
            sets = []
            for columns in (own, ~own):
                distances = ((scaled[:, columns] - scaled[row, columns]) ** 2).sum(axis=1)
                distances[row] = np.inf
                sets.append(set(np.argsort(distances)[:10]))
            shared += len(sets[0] & sets[1])
        expected.append(max(shared / 1200 - 10 / 119, 0))
    assert weights_of(table) == pytest.approx(np.array(expected) * 4 / sum(expected))


def test_what_agrees_counts_and_noise_hardly_does(blocks) -> None:
    good, other, blurred, noise = weights_of(table_of(*blocks))
    assert min(good, other) > 2 * blurred > 4 * max(noise, 0.01)
    assert noise < 0.15


def test_the_order_of_shapes_decides_nothing(blocks) -> None:
    order = np.random.default_rng(1).permutation(120)
    assert weights_of(table_of(*(b[order] for b in blocks))) == pytest.approx(weights_of(table_of(*blocks)))


def test_the_scaled_size_of_a_feature_is_its_weight(blocks) -> None:
    table = weigh(table_of(*blocks), DEFAULT)
    scaled = scale(table, DEFAULT)
    for block in table.blocks:
        spread = scaled[:, table.slice_of(block.name)].var(axis=0).sum()
        assert spread == pytest.approx(block.weight)


def test_ties_count_by_fractions() -> None:
    """Of two features that only tell two halves apart alike, each row shares nine places among nine or ten equals."""
    halves = np.repeat([[0.0], [1.0]], 12, axis=0)
    assert weights_of(table_of(halves, halves, np.random.default_rng(0).random((24, 2))))[0] > 1
    constant = np.ones((24, 1))
    assert weights_of(table_of(halves, halves, constant)) == pytest.approx([1.5, 1.5, 0])


@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_shapes_and_nothing_that_agrees_leave_all_alike(count) -> None:
    assert set(weights_of(table_of(np.ones((count, 2)), np.ones((count, 2))))) == {1.0}


def test_presets_of_the_papers_features_weigh_nothing(blocks) -> None:
    for name in ("local", "paper"):
        assert {b.weight for b in weigh(table_of(*blocks), PRESETS[name]).blocks} == {1.0}


def test_weights_that_a_table_brings_are_made_anew(blocks) -> None:
    table = table_of(*blocks)
    heavy = replace(table, blocks=tuple(replace(block, weight=9.0) for block in table.blocks))
    assert weights_of(heavy) == weights_of(table)
