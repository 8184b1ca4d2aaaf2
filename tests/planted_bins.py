"""Generated shapes in which some bins mean something and the others nothing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapeviz_report.presets import PRESETS
from shapeviz_report.search.bins import BinSpace, make_bin_space
from shapeviz_report.types import FeatureBlock, FeatureTable

CLASSES = ("ant", "bear", "crab", "duck")
SIZE = 12
PLANTED = ("A:2", "A:7", "B[1]:5", "B[2]:9")
"""The bin of each class: only its shapes have much of it."""


@dataclass(frozen=True)
class Planted:
    """Shapes by class, and what is searched."""

    table: FeatureTable
    labels: list[str | None]
    space: BinSpace


def make_table(values: np.ndarray) -> FeatureTable:
    """A feature of one dimension and one of three, ten bins each."""
    blocks = (FeatureBlock("A", 1, 10), FeatureBlock("B", 3, 10))
    return FeatureTable(tuple(f"shape {i:03}" for i in range(len(values))), blocks, values)


def planted_values() -> np.ndarray:
    """Noise of which a third is empty, and in each class's bin a lot."""
    random = np.random.default_rng(5)
    values = (
        random.random((SIZE * len(CLASSES), 40)) * (random.random((SIZE * len(CLASSES), 40)) > 1 / 3) / 10
    )
    columns = make_table(values).columns
    for i, name in enumerate(PLANTED):
        own = slice(SIZE * i, SIZE * (i + 1))
        values[own, columns.index(name)] = 0.6 + 0.1 * random.random(SIZE)
    return values


def plant() -> Planted:
    """Four classes of twelve, sorted as folders are."""
    table = make_table(planted_values())
    labels: list[str | None] = list(np.repeat(CLASSES, SIZE).tolist())
    return Planted(table, labels, make_bin_space(table, PRESETS["default"], labels))
