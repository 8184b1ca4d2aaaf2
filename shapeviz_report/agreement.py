"""How much each feature counts, by how far its neighbours are those of all others: a rule that needs no labels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from threadpoolctl import threadpool_limits

from shapeviz_report.presets import Preset, scale
from shapeviz_report.projections import canonical_order, squared_distances
from shapeviz_report.quality import share_places
from shapeviz_report.types import FeatureTable

NEIGHBOURS = 10
"""Nearest shapes that are compared."""

SAMPLE_LIMIT = 1000
"""Most shapes that are asked: 8 MB of distances a feature."""


def weigh(table: FeatureTable, preset: Preset) -> FeatureTable:
    r"""The table with a weight for each feature, where the preset wants them; 1 on average.

    .. math:: w_f \propto \max(0, a_f - c), \quad
              a_f = \frac{1}{n k} \sum_m |N_f(m) \cap N_{-f}(m)|, \quad c = \frac{k}{n - 1}

    :math:`N_f(m)` are the k = 10 nearest shapes of m by feature f alone, :math:`N_{-f}(m)` those by all other features
    together, each with equal weight, and c is what a feature of noise would agree in. Shapes that are equally far at
    the k-th place count with the same fraction. Of databases with few shapes, or where nothing agrees, all features
    count alike.

    Parameters
    ----------
    table : FeatureTable
    preset : Preset
    """
    if not preset.whole or len(table.blocks) < 2:
        return table
    scaled = scale(replace(table, blocks=tuple(replace(block, weight=1.0) for block in table.blocks)), preset)
    order = canonical_order(scaled)
    count = min(len(order), SAMPLE_LIMIT)
    rows = order[np.arange(count) * len(order) // count]
    k = min(NEIGHBOURS, (len(rows) - 1) // 2)
    if k < 1:
        return table
    with threadpool_limits(limits=1):
        squared = [squared_distances(scaled[rows][:, table.slice_of(block.name)]) for block in table.blocks]
    total = np.sum(squared, axis=0)
    agreed = []
    for own in squared:
        others = total - own
        for distances in (own, others):
            np.fill_diagonal(distances, np.inf)
        agreed.append(float((share_places(own, k) * share_places(others, k)).sum()) / (len(rows) * k))
    weights = np.maximum(np.array(agreed) - k / (len(rows) - 1), 0)
    # Rounding is no agreement.
    if weights.max() < 1e-6:
        return table
    weights *= len(weights) / weights.sum()
    return replace(
        table,
        blocks=tuple(
            replace(block, weight=float(weight)) for block, weight in zip(table.blocks, weights, strict=True)
        ),
    )
