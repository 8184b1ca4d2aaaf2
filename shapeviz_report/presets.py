"""Which features there are, and how maps compare them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapeviz_report.features import BLOCKS
from shapeviz_report.global_descriptors.registry import ALL_GLOBAL_DESCRIPTORS
from shapeviz_report.types import FeatureBlock, FeatureTable, FloatArray

GLOBAL_BLOCKS = tuple(FeatureBlock(d.name, d.width, 1) for d in ALL_GLOBAL_DESCRIPTORS)
"""The features of whole shapes, whose values are compared as they are."""


@dataclass(frozen=True)
class Preset:
    """How descriptor values become features.

    Attributes
    ----------
    name : str
    explanation : str
    fixed_ranges : bool
        Whether histogram ranges come from the descriptors' definitions, or from quantiles of all shapes.
    by_area : bool
        Whether a vertex counts with its area, or as one.
    balanced : bool
        Whether projections see square roots, each feature divided by its size, or the plain fractions.
    whole : bool
        Whether there are features of whole shapes beside those of Table 1, and features count by how far they agree
        (:func:`shapeviz_report.agreement.weigh`) instead of all alike.
    """

    name: str
    explanation: str
    fixed_ranges: bool
    by_area: bool
    balanced: bool
    whole: bool

    @property
    def blocks(self) -> tuple[FeatureBlock, ...]:
        """The features that are measured, in the order of their columns."""
        return (*BLOCKS, *GLOBAL_BLOCKS) if self.whole else BLOCKS


PRESETS = {
    preset.name: preset
    for preset in (
        Preset(
            "default",
            "Features of whole shapes stand beside the paper's eight. Histogram ranges come from each descriptor's "
            "definition, vertices count with their area, and projections compare square roots (Hellinger distance); "
            "a feature counts the more, the better its neighbours agree with those of the others.",
            fixed_ranges=True,
            by_area=True,
            balanced=True,
            whole=True,
        ),
        Preset(
            "local",
            "The paper's eight features alone, all with equal weight; else as by default.",
            fixed_ranges=True,
            by_area=True,
            balanced=True,
            whole=False,
        ),
        Preset(
            "paper",
            "Histogram ranges run from the 1st to the 99th percentile of all shapes, vertices count equally, "
            "and projections compare the plain fractions.",
            fixed_ranges=False,
            by_area=False,
            balanced=False,
            whole=False,
        ),
    )
}


def compared_values(table: FeatureTable, preset: Preset) -> FloatArray:
    """The values of a table before any weight; (n, w).

    Balanced: square roots of the fractions, whose Euclidean distance is the Hellinger distance of the histograms;
    external features as they are. Otherwise the plain values.
    """
    if not preset.balanced:
        return table.values
    is_fraction = np.repeat(
        [block.bins > 1 for block in table.blocks], [block.width for block in table.blocks]
    )
    return np.sqrt(table.values, where=is_fraction, out=table.values.copy())


def scale(table: FeatureTable, preset: Preset) -> FloatArray:
    """The values that projections compare, by Euclidean distance; (n, w).

    Balanced: every feature of :func:`compared_values` is centred and divided by its root mean square norm over the
    database, so that every feature contributes its weight to the mean squared distance. A feature that is the same for
    all shapes becomes zero.
    """
    compared = compared_values(table, preset)
    if not preset.balanced:
        return compared
    scaled = np.empty_like(compared)
    for block in table.blocks:
        columns = table.slice_of(block.name)
        values = compared[:, columns]
        centred = values - values.mean(axis=0)
        size = np.sqrt((centred**2).sum(axis=1).mean())
        scaled[:, columns] = centred * (np.sqrt(block.weight) / size) if size > 1e-12 else 0.0
    return scaled
