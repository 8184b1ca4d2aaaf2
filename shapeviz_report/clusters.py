"""Groups of shapes that the features alone make: for databases without labels, and beside the labels of others.

``docs/clusters.md`` says why they are found as they are, and how well they meet labels where there are some.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import cdist, pdist, squareform
from threadpoolctl import threadpool_limits

from shapeviz_report.bins import word_conditions, word_whole
from shapeviz_report.features import Preset, compared_values
from shapeviz_report.projections import canonical_order
from shapeviz_report.types import Cluster, Clusters, FeatureTable, FloatArray, IntArray, ShapeEntry

SMALLEST = 8
"""Fewer shapes are seen at a glance, and no number of groups among them could be told from chance."""

SAMPLE_LIMIT = 2000
"""Most shapes of which the tree is made; of larger databases, a sample. Time grows with their square."""

MOST = 60
"""Most clusters; more would be no help to a reader."""

MEAN_SIZE = 4
"""There are at least this many times as many shapes as clusters."""

TYPICAL = 3
"""Sentences about a cluster."""

WORTH_SAYING = 0.02
"""The least difference of a share of the surface that a sentence tells of."""


@dataclass(frozen=True)
class Partition:
    """Shapes in groups.

    Attributes
    ----------
    of : (n,) int32 array
        The group of each shape, from 0 without gaps: the groups by falling size, equally large ones by their first
        shape.
    silhouette : float
        As in :class:`~shapeviz_report.types.Clusters`.
    """

    of: IntArray
    silhouette: float


def part(scaled: FloatArray, *, seed: int = 0, limit: int = SAMPLE_LIMIT) -> Partition | None:
    """Part shapes into groups that are close in themselves, as many as suit them best.

    Ward's tree joins the two groups whose union spreads least beyond them, again and again (J. H. Ward 1963); it is cut
    where the mean silhouette (P. J. Rousseeuw 1987) is highest. Beyond ``limit`` shapes the tree is of a sample, and
    every other shape joins the group whose mean is nearest.

    Parameters
    ----------
    scaled : (n, w) float array
        Features as projections compare them.
    seed : int
        Of the sample.
    limit : int
        Most shapes in the tree.

    Returns
    -------
    Partition or None
        The same whatever the order of the shapes. None for fewer than ``SMALLEST`` shapes, and where all are alike.
    """
    if len(scaled) < SMALLEST:
        return None
    order = canonical_order(scaled)
    if len(order) > limit:
        order = order[np.sort(np.random.default_rng(seed).permutation(len(order))[:limit])]
    sample = scaled[order]
    with threadpool_limits(limits=1):
        distances = pdist(sample)
        if distances.max() == 0:
            return None
        tree, square = linkage(distances, "ward"), squareform(distances)
        best: tuple[float, IntArray] | None = None
        for count in range(2, min(MOST, len(sample) // MEAN_SIZE) + 1):
            codes = fcluster(tree, count, "maxclust").astype(np.int32) - 1
            score = float(silhouettes(square, codes).mean())
            # Sums in another order may differ in their last digits: more clusters must be clearly better.
            if best is None or score > best[0] + 1e-9:
                best = score, codes
        assert best is not None
        silhouette, codes = best
        of = np.empty(len(scaled), np.int32)
        if len(sample) < len(scaled):
            means = np.stack([sample[codes == code].mean(axis=0) for code in range(codes.max() + 1)])
            of[:] = cdist(scaled, means, "sqeuclidean").argmin(axis=1)
        of[order] = codes
    sizes = np.bincount(of)
    first = [int((of == code).argmax()) for code in range(len(sizes))]
    rank = np.argsort(np.lexsort((first, -sizes))).astype(np.int32)
    return Partition(rank[of], silhouette)


def silhouettes(distances: FloatArray, codes: IntArray) -> FloatArray:
    """How much closer every shape is to its own group than to the next one, in [-1, 1]; 0 where it is alone.

    Parameters
    ----------
    distances : (n, n) float array
    codes : (n,) int array
        The groups, from 0; at least two, none empty.
    """
    sizes = np.bincount(codes)
    member = codes[:, None] == np.arange(len(sizes))
    sums = distances @ member.astype(float)
    own = sums[member] / np.maximum(sizes[codes] - 1, 1)
    other = np.where(member, np.inf, sums / sizes).min(axis=1)
    scale = np.maximum(own, other)
    result = np.divide(other - own, scale, out=np.zeros_like(own), where=scale > 0)
    result[sizes[codes] == 1] = 0
    return result


def describe_clusters(
    partition: Partition,
    shapes: Sequence[ShapeEntry],
    table: FeatureTable,
    scaled: FloatArray,
    edges: FloatArray,
    preset: Preset,
    *,
    stand_in: bool,
) -> Clusters:
    """Give groups their names, their most central shapes, and what is typical of them.

    Parameters
    ----------
    partition : Partition
    shapes : n ShapeEntry
    table : FeatureTable
    scaled : (n, w) float array
        Features as projections compare them.
    edges : (d, 11) float array
        As in :class:`~shapeviz_report.types.Report`.
    preset : Preset
        Of the features.
    stand_in : bool
        As in :class:`~shapeviz_report.types.Clusters`.
    """
    rows = [np.flatnonzero(partition.of == code) for code in range(partition.of.max() + 1)]
    central = [_find_central(scaled, own) for own in rows]
    names = _name([shapes[row] for row in central])
    typical = _word_typical(rows, table, edges, preset)
    clusters = (
        Cluster(name, row, len(own), words) for name, row, own, words in zip(names, central, rows, typical)
    )
    return Clusters(tuple(clusters), partition.of, partition.silhouette, stand_in)


def _find_central(scaled: FloatArray, rows: np.ndarray) -> int:
    """The shape nearest to the mean of some."""
    offsets = scaled[rows] - scaled[rows].mean(axis=0)
    return int(rows[np.square(offsets).sum(axis=1).argmin()])


def _name(central: Sequence[ShapeEntry]) -> list[str]:
    """A name for the cluster of each of some shapes; with the shape's id where its name alone is not enough."""
    counts = Counter(shape.name for shape in central)
    return [
        f"like {shape.name}" if counts[shape.name] == 1 else f"like {shape.name} ({shape.id})"
        for shape in central
    ]


def _word_typical(
    rows: Sequence[np.ndarray], table: FeatureTable, edges: FloatArray, preset: Preset
) -> list[tuple[str, ...]]:
    """What tells each of some groups from the rest: of the features that do so most, the one bin that does.

    A bin tells by the distance of the two means of its compared values, in standard deviations within the groups.
    """
    compared = compared_values(table, preset)
    conditions, whole = word_conditions(table, edges), word_whole(preset.by_area)
    owner = np.repeat(np.arange(len(table.blocks)), [block.width for block in table.blocks])
    is_share = np.array([condition is not None for condition in conditions])
    count, sums, squares = len(compared), compared.sum(axis=0), np.square(compared).sum(axis=0)
    totals = table.values.sum(axis=0)
    result = []
    for own in rows:
        inside, size = compared[own], len(own)
        mean, rest = inside.mean(axis=0), (sums - inside.sum(axis=0)) / (count - size)
        within = squares - size * mean**2 - (count - size) * rest**2
        spread = np.sqrt(np.maximum(within, 0) / count)
        effect = np.divide(np.abs(mean - rest), spread, out=np.zeros_like(mean), where=spread > 1e-9)
        here = table.values[own].mean(axis=0)
        there = (totals - table.values[own].sum(axis=0)) / (count - size)
        effect[is_share & (np.abs(here - there) < WORTH_SAYING)] = 0
        strongest = [
            int(np.flatnonzero(owner == block)[effect[owner == block].argmax()])
            for block in range(len(table.blocks))
        ]
        chosen = sorted(strongest, key=lambda column: -effect[column])[:TYPICAL]
        result.append(
            tuple(
                _word_difference(
                    table.columns[column], conditions[column], whole, here[column], there[column]
                )
                for column in chosen
                if effect[column] > 0
            )
        )
    return result


def _word_difference(column: str, condition: str | None, whole: str, here: float, there: float) -> str:
    """That a group has more or less of a bin than the rest."""
    if condition is None:
        side = "larger" if here > there else "smaller"
        return f"{column} is {side} than in other shapes: {_number(here)} against {_number(there)}."
    side = "More" if here > there else "Less"
    amounts = f"{_number(100 * here)} % against {_number(100 * there)} %"
    return f"{side} of {whole} than in other shapes lies where {condition}: {amounts}."


def _number(value: float) -> str:
    """Two digits are enough to compare, and whole numbers from 10 on."""
    text = f"{value:.0f}" if abs(value) >= 10 else f"{value:.2g}"
    return text.replace("-", "−")
