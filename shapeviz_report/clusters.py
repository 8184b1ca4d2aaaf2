"""Groups of shapes that the features alone make: for databases without labels, and beside the labels of others.

``docs/method/clusters.md`` says why they are found as they are, and how well they meet labels where there are some.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_matrix
from scipy.spatial.distance import cdist, pdist, squareform
from threadpoolctl import threadpool_limits

from shapeviz_report.presets import Preset
from shapeviz_report.projections import canonical_order
from shapeviz_report.types import (
    Cluster,
    Clusters,
    FeatureTable,
    FloatArray,
    IntArray,
    ShapeEntry,
)
from shapeviz_report.wording import (
    Dimension,
    agreed,
    call_bins,
    dimensions_of,
    word_whole,
)
from shapeviz_report.wording.base import percents
from shapeviz_report.wording.registry import all_global_wordings, all_wordings

SMALLEST = 8
"""Fewer shapes are seen at a glance, and no number of groups among them could be told from chance."""

SAMPLE_LIMIT = 2000
"""Most shapes that decide the groups; of larger databases, a sample. Time grows with their square."""

NEIGHBOURS = (5, 10, 20, 40, 80)
"""Nearest shapes to which every shape is tied, tried in turn: few give many small groups, many a few large ones. Where
there are few shapes, at most a quarter of them."""

STEADY = 0.7
"""Steadiness that is enough, so that groups are not made larger than they must be. Cuts through an even cloud stay
below (docs/method/clusters.md)."""

RUNS = 5
"""Times that groups are sought; the best are kept."""

TRIALS = 15
"""Parts of the database in which groups are sought again."""

PART = 0.8
"""Size of such a part."""

TYPICAL = 3
"""Sentences about a cluster."""

WORTH_SAYING = 0.02
"""The least difference of a share of the surface that a sentence tells of."""

ENOUGH = 3.0
"""Standard deviations by which means differ whose groups hardly overlap: larger differences say no more."""


@dataclass(frozen=True)
class Partition:
    """Shapes in groups.

    Attributes
    ----------
    of : (n,) int32 array
        The group of each shape, from 0 without gaps: the groups by falling size, equally large ones by their first
        shape.
    silhouette, steadiness : float
        As in :class:`~shapeviz_report.types.Clusters`.
    """

    of: IntArray
    silhouette: float
    steadiness: float


def part(scaled: FloatArray, *, seed: int = 0, limit: int = SAMPLE_LIMIT) -> Partition | None:
    """Part shapes into groups that are close in themselves, as many as suit them best.

    Every shape is tied to its nearest ones, and the groups are those in which the ties most exceed what chance would
    give: the modularity of this graph, sought by the method of V. D. Blondel et al. (2008), which needs no number of
    groups. With few ties it may cut a group at will; such cuts do not come out again in a part of the shapes, and then
    more ties are tried. Beyond ``limit`` shapes a sample decides, and every other shape joins the group whose mean is
    nearest.

    Parameters
    ----------
    scaled : (n, w) float array
        Features as projections compare them.
    seed : int
        Of the sample and of the search.
    limit : int
        Most shapes that decide.

    Returns
    -------
    Partition or None
        The same whatever the order of the shapes; equal shapes are in one group. None for fewer than ``SMALLEST``
        different shapes, and where they are all of one group.
    """
    order = canonical_order(scaled)
    is_new = np.append(True, (scaled[order[1:]] != scaled[order[:-1]]).any(axis=1))
    different = scaled[order[is_new]]
    if len(different) < SMALLEST:
        return None
    chosen = np.sort(np.random.default_rng(seed).permutation(len(different))[:limit])
    sample = different[chosen]
    with threadpool_limits(limits=1):
        distances = squareform(pdist(sample))
        codes, steadiness = _find_steady(distances, seed)
        if codes.max() == 0:
            return None
        silhouette = float(silhouettes(distances, codes).mean())
        means = np.stack([sample[codes == code].mean(axis=0) for code in range(codes.max() + 1)])
        joined = cdist(different, means, "sqeuclidean").argmin(axis=1).astype(np.int32)
    joined[chosen] = codes
    of = np.empty(len(scaled), np.int32)
    of[order] = joined[np.cumsum(is_new) - 1]
    sizes = np.bincount(of)
    first = np.array([(of == code).argmax() for code in range(len(sizes))])
    rank = np.argsort(np.lexsort((first, -sizes))).astype(np.int32)
    return Partition(rank[of], silhouette, steadiness)


def _find_steady(distances: FloatArray, seed: int) -> tuple[IntArray, float]:
    """The groups of the fewest ties with which they are steady, or the steadiest, and how steady they are."""
    # Imported where they are used: every worker imports this module, and few find groups.
    from sklearn.metrics import adjusted_rand_score

    random = np.random.default_rng(seed)
    count = len(distances)
    parts = [np.sort(random.permutation(count)[: int(PART * count)]) for _ in range(TRIALS)]
    best, steadiest = np.zeros(count, np.int32), 0.0
    for k in NEIGHBOURS:
        codes = find_communities(_tie(distances, min(k, count // 4)), seed, runs=RUNS)
        if codes.max() == 0:
            break
        agreements = []
        for kept in parts:
            again = find_communities(_tie(distances[np.ix_(kept, kept)], min(k, len(kept) // 4)), seed)
            agreements.append(adjusted_rand_score(codes[kept], again))
        steadiness = float(np.mean(agreements))
        if best.max() == 0 or steadiness > steadiest:
            best, steadiest = codes, steadiness
        if steadiness >= STEADY or k >= count // 4:
            break
    return best, steadiest


def _tie(distances: FloatArray, k: int) -> csr_matrix:
    """The graph of the k nearest neighbours: a symmetric (n, n) matrix with weights in (0, 1].

    A tie weakens with the distance, measured by how far each of the two has its last neighbour (L. Zelnik-Manor and
    P. Perona 2004), so that a loose group holds together as a dense one does.
    """
    count = len(distances)
    others = distances.copy()
    np.fill_diagonal(others, np.inf)
    nearest = np.argsort(others, axis=1, kind="stable")[:, :k]
    rows = np.repeat(np.arange(count), k)
    columns = nearest.ravel()
    reach = np.take_along_axis(others, nearest[:, -1:], axis=1)[:, 0]
    weights = np.exp(-np.square(distances[rows, columns]) / (reach[rows] * reach[columns]))
    graph = csr_matrix((weights, (rows, columns)), shape=(count, count))
    return (graph + graph.T) / 2


def find_communities(ties: csr_matrix, seed: int, *, runs: int = 1) -> IntArray:
    """The groups of a graph with the highest modularity that is found.

    Parameters
    ----------
    ties : (n, n) sparse matrix
        Symmetric weights, none negative.
    seed : int
        Of the orders in which nodes are tried.
    runs : int
        Number of orders; that with the highest modularity counts.

    Returns
    -------
    (n,) int32 array
        Codes from 0 without gaps.
    """
    import networkx

    graph = networkx.from_scipy_sparse_array(ties)
    seek, rate = networkx.community.louvain_communities, networkx.community.modularity
    found = [seek(graph, seed=seed * runs + run) for run in range(runs)]
    best = max(found, key=lambda groups: rate(graph, groups))
    codes = np.empty(len(graph), np.int32)
    for code, members in enumerate(best):
        codes[list(members)] = code
    return codes


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
    return Clusters(tuple(clusters), partition.of, partition.silhouette, partition.steadiness, stand_in)


def _find_central(scaled: FloatArray, rows: npt.NDArray[np.intp]) -> int:
    """The shape nearest to the mean of some."""
    offsets = scaled[rows] - scaled[rows].mean(axis=0)
    return int(rows[np.square(offsets).sum(axis=1).argmin()])


def _name(central: Sequence[ShapeEntry]) -> list[str]:
    """A name for the cluster of each of some shapes, made of their names, or of their ids where two share a name."""
    names = [shape.name for shape in central]
    if len(set(names)) < len(names):
        names = [shape.id for shape in central]
    return [f"like {name}" for name in names]


def _word_typical(
    rows: Sequence[npt.NDArray[np.intp]], table: FeatureTable, edges: FloatArray, preset: Preset
) -> list[tuple[str, ...]]:
    """What tells each of some groups from the rest: of the features that do so most, a sentence each.

    Of a feature it is the share of the surface above some value, or the value of an external one, whose means within
    and without the group are farthest apart in standard deviations within the two. What is easily pictured goes
    first, unless the rest says much more.
    """
    dimensions, calls = tuple(dimensions_of(table, edges)), call_bins(table, edges)
    found: list[list[tuple[float, float, str]]] = [[] for _ in rows]
    for block in table.blocks:
        own_dimensions = [dimension for dimension in dimensions if dimension.block == block]
        values = table.values[:, table.slice_of(block.name)]
        wording = all_wordings().get(block.name) or all_global_wordings().get(block.name)
        # What somebody brought along as one number has a name that says what it is.
        ease = (2.0 if block.width == 1 else 1.0) if wording is None else wording.ease
        # Values as they are told: shares of the surface, of whole shapes shares or numbers.
        in_percent = block.bins > 1 or (wording is not None and wording.rooted)
        if block.bins > 1:
            shares = values.reshape(len(values), block.dimensions, block.bins)
            # From the second bin on: the share that lies at or above each inner edge.
            values = shares[:, :, ::-1].cumsum(axis=2)[:, :, -2::-1].reshape(len(values), -1)
        sums, squares = values.sum(axis=0), np.square(values).sum(axis=0)
        for own, candidates in zip(rows, found):
            size, others = len(own), len(values) - len(own)
            here = values[own].mean(axis=0)
            there = (sums - size * here) / others
            within = np.maximum(squares - size * here**2 - others * there**2, 0) / len(values)
            gaps = np.abs(here - there)
            effects = np.divide(gaps, np.sqrt(within), out=np.zeros_like(gaps), where=within > 1e-18)
            told_gaps = gaps
            if in_percent and block.bins == 1:
                shown = np.square(values)
                told_gaps = np.abs(shown[own].mean(axis=0) - (squares - shown[own].sum(axis=0)) / others)
            if in_percent:
                effects[told_gaps < WORTH_SAYING] = 0
            best = int(effects.argmax())
            if effects[best] == 0:
                continue
            if block.bins > 1:
                number, step = divmod(best, block.bins - 1)
                sentence = _word_shares(own_dimensions[number], step, here[best], there[best], preset)
            else:
                called = calls[table.slice_of(block.name).start + best] or block.columns[best]
                shown = np.square(values[:, best]) if in_percent else values[:, best]
                mean = float(shown[own].mean())
                others_mean = float((shown.sum() - size * mean) / others)
                told = percents(mean, others_mean) if in_percent else (_number(mean), _number(others_mean))
                if told[0] == told[1]:
                    continue
                sentence = _word_values(called, mean > others_mean, *told)
            candidates.append((-ease * min(effects[best], ENOUGH), -effects[best], sentence))
    return [tuple(sentence for _, _, sentence in sorted(candidates)[:TYPICAL]) for candidates in found]


def _word_shares(dimension: Dimension, step: int, here: float, there: float, preset: Preset) -> str:
    """That more of a group's surface than of the rest's lies on one side of an inner edge; where one sees that there is
    less of something, how much of that there is."""
    edge = float(dimension.edges[step + 1])
    below, above = dimension.say(None, edge), dimension.say(edge, None)
    said, other = (above, below) if here > there else (below, above)
    clause = other.clause if said.fewer else said.clause
    if clause == below.clause:
        here, there = 1 - here, 1 - there
    said = agreed(said._replace(clause=clause), preset.by_area)
    trend = f"{said.trend[0].upper()}{said.trend[1:]}: " if said.trend else ""
    own, others = percents(here, there)
    return f"{trend}{own} of {word_whole(preset.by_area)} {said.clause}, in other shapes {others}."


def _word_values(called: str, higher: bool, here: str, there: str) -> str:
    """That a value of the whole shape, or one that was brought along, is larger or smaller."""
    side = "higher" if higher else "lower"
    words = f"{called[:1].upper()}{called[1:]} is {side} than in other shapes"
    return f"{words}: {here} against {there}."


def _number(value: float) -> str:
    """Two digits are enough to compare, and whole numbers from 10 on."""
    text = f"{value:.0f}" if abs(value) >= 10 else f"{value:.2g}"
    return text.replace("-", "−")
