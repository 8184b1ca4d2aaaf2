"""Which shapes are most similar to one, and which features make them so.

The distance of two shapes is the Euclidean distance of the values that projections compare:
:func:`shapeviz_report.presets.scale` for a choice of features, :func:`shapeviz_report.bins.scale_bins` for a choice of
bins. Both only shift and stretch columns by what the whole database is like, so a shape that is not in the database is
compared by the same stretches. ``docs/method/retrieval.md`` says more; ``site/scripts/database/similarity.js`` does the
same in the browser.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from shapeviz_report.presets import Preset, compared_values
from shapeviz_report.types import FeatureBlock, FeatureTable, FloatArray

TIE = 1e-9
"""Distances that differ by less than this fraction are equal."""

NOTHING = 1e-12
"""Spread below which a feature or bin is the same for all shapes, and tells nothing."""


@dataclass(frozen=True)
class SimilarShape:
    """A shape that was found for another one.

    Attributes
    ----------
    row : int
        Of the feature table.
    distance : float
        By the chosen features or bins; 0 for a shape that they cannot tell from the query.
    closer : (f,) float64 array
        For each feature of the table alone, the share of all other shapes that are farther from the query than this
        one, those equally far counted half: 1 for the nearest, 0 for the farthest of all, 0.5 where the feature tells
        nothing. The query has no part in it. These are the reasons: where the share is high, the feature makes the
        two alike, where it is low, unlike, whether it was chosen or not.
    """

    row: int
    distance: float
    closer: FloatArray


def rank_similar(
    table: FeatureTable,
    preset: Preset,
    query: FloatArray,
    *,
    features: Sequence[str] | None = None,
    bins: Sequence[str] | None = None,
    member: int | None = None,
    count: int = 10,
) -> tuple[SimilarShape, ...]:
    """The shapes that are most similar to one.

    Parameters
    ----------
    table : FeatureTable
        Of the database.
    preset : Preset
        How its values are compared.
    query : (w,) float array
        The features of a shape, as a row of the table.
    features, bins : sequence of str, optional
        What to compare, by one of the two; all features by default.
    member : int, optional
        The row of the query where it is a shape of the database, which then is not found itself.
    count : int
        Most shapes to find.

    Returns
    -------
    tuple of SimilarShape
        By rising distance; of equal ones, the shape first that comes first in the table.

    Raises
    ------
    KeyError
        A feature or bin that the table does not have.
    """
    compared = compared_values(table, preset)
    wanted = compared_values(replace(table, shape_ids=("",), values=np.asarray(query, float)[None]), preset)[
        0
    ]
    squared = squared_by_feature(table, preset, compared, wanted)
    if bins is not None:
        place = {column: index for index, column in enumerate(table.columns)}
        columns = [place[name] for name in bins]
        distances = (compared[:, columns] - wanted[columns]) ** 2 @ bin_weights(preset, compared[:, columns])
    else:
        chosen = {block.name: number for number, block in enumerate(table.blocks)}
        numbers = range(len(table.blocks)) if features is None else [chosen[name] for name in features]
        distances = squared[:, list(numbers)].sum(axis=1)

    others = np.delete(np.arange(len(compared)), [] if member is None else member)
    nearest = others[np.argsort(distances[others], kind="stable")[:count]]
    closer = np.column_stack([_share_farther(column[others], column[nearest]) for column in squared.T])
    return tuple(
        SimilarShape(int(row), float(np.sqrt(distances[row])), shares) for row, shares in zip(nearest, closer)
    )


def typical_distance(
    table: FeatureTable,
    preset: Preset,
    *,
    features: Sequence[str] | None = None,
    bins: Sequence[str] | None = None,
) -> float:
    """How far two shapes of a database are apart, as a root mean square over all pairs; 0 for one shape.

    What to compare is chosen as for :func:`rank_similar`. Balanced values make it nearly the square root of twice the
    number of features or bins, whatever the database.
    """
    compared = compared_values(table, preset)
    if bins is not None:
        place = {column: index for index, column in enumerate(table.columns)}
        values = compared[:, [place[name] for name in bins]]
        spread = float(values.var(axis=0) @ bin_weights(preset, values))
    else:
        spread = 0.0
        for block in table.blocks:
            if features is None or block.name in features:
                values = compared[:, table.slice_of(block.name)]
                spread += float(values.var(axis=0).sum()) * feature_weight(block, preset, values)
    # The mean over pairs of different shapes: the spread over all pairs without the pairs of a shape with itself.
    return float(np.sqrt(2 * spread * len(compared) / max(len(compared) - 1, 1)))


def squared_by_feature(
    table: FeatureTable, preset: Preset, compared: FloatArray, wanted: FloatArray
) -> FloatArray:
    """Squared distances of all shapes from one, by each feature alone; (n, f).

    Those of a choice of features add up.

    Parameters
    ----------
    table : FeatureTable
    preset : Preset
    compared : (n, w) float array
        Its :func:`~shapeviz_report.presets.compared_values`.
    wanted : (w,) float array
        The same of one shape.
    """
    squared = np.empty((len(compared), len(table.blocks)))
    for number, block in enumerate(table.blocks):
        columns = table.slice_of(block.name)
        differences = compared[:, columns] - wanted[columns]
        squared[:, number] = np.einsum("ij,ij->i", differences, differences)
        squared[:, number] *= feature_weight(block, preset, compared[:, columns])
    return squared


def feature_weight(block: FeatureBlock, preset: Preset, compared: FloatArray) -> float:
    """What a squared difference in the compared values (n, w) of a feature counts, as
    :func:`~shapeviz_report.presets.scale` has it."""
    return weight_of_size(block, preset, float(compared.var(axis=0).sum()))


def weight_of_size(block: FeatureBlock, preset: Preset, size: float) -> float:
    """The same of a feature whose values have the mean squared distance ``size`` from their mean."""
    if not preset.balanced:
        return 1.0
    return block.weight / size if size > NOTHING**2 else 0.0


def bin_weights(preset: Preset, compared: FloatArray) -> FloatArray:
    """What a squared difference in each of the compared values (n, b) of some bins counts, as
    :func:`~shapeviz_report.bins.scale_bins` has it; (b,)."""
    if not preset.balanced:
        return np.ones(compared.shape[1])
    spread = compared.std(axis=0)
    return np.divide(1, spread**2, out=np.zeros_like(spread), where=spread > NOTHING)


def _share_farther(distances: FloatArray, found: FloatArray) -> npt.NDArray[np.float64]:
    """The share of the other distances that exceed each of those ``found``, equal ones counted half."""
    ranked = np.sort(distances)
    below = np.searchsorted(ranked, found * (1 - TIE), side="left")
    above = len(ranked) - np.searchsorted(ranked, found * (1 + TIE), side="right")
    tied = len(ranked) - below - above - 1
    others = len(ranked) - 1
    return (above + tied / 2) / others if others else np.full(len(found), 0.5)
