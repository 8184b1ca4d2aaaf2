"""How sure is a search? Seeds, shapes whose labels it has not seen, and labels without meaning."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_matrix

from shapeviz_report.quality import neighbourhood_hits
from shapeviz_report.types import FloatArray, Gain, HeldOutBins, HeldOutFold, SeedSpread

Codes = npt.NDArray[np.intp]

DEALS = 10
"""How often shapes are dealt into folds, where that makes no map."""

FOLDS = 5
"""Parts of the shapes that are held out in turn."""

PERMUTATIONS = 200
"""Random labelings behind the best NH_s that chance finds."""

NORMAL_95 = 1.96
"""Standard errors on either side of a mean that hold 95 % of a normal distribution."""


def compare_spreads(names: Sequence[tuple[str, ...]], hits: FloatArray) -> tuple[SeedSpread, ...]:
    """Which subsets are as good as the best, as far as seeds and shapes can tell.

    The difference to the best subset has two sources of chance: another seed, and other shapes of the same kind.
    Its standard error adds up both: the variance over seeds of the two NH_s, and the variance over shapes of the
    difference of their NH, each shape compared with itself.

    Parameters
    ----------
    names : the features of c subsets
    hits : (c, seeds, m) float array
        NH of every labelled shape.

    Returns
    -------
    tuple of SeedSpread
        By falling mean.
    """
    by_seed = hits.mean(axis=2)
    by_shape = hits.mean(axis=1)
    seeds, shapes = hits.shape[1:]
    variances = by_seed.var(axis=1, ddof=1) if seeds > 1 else np.zeros(len(hits))
    means = by_seed.mean(axis=1)
    best = int(means.argmax())
    spreads = []
    for i in np.argsort(-means, kind="stable"):
        differences = by_shape[best] - by_shape[i]
        over_shapes = differences.var(ddof=1) / shapes if shapes > 1 else 0.0
        over_seeds = (variances[best] + variances[i]) / seeds if i != best else 0.0
        behind = float(means[best] - means[i])
        margin = float(NORMAL_95 * np.sqrt(over_shapes + over_seeds))
        spreads.append(
            SeedSpread(
                features=names[i],
                nh_s=by_seed[i],
                mean=float(means[i]),
                std=float(np.sqrt(variances[i])),
                behind=behind,
                margin=margin,
                told_apart=behind > margin,
            )
        )
    return tuple(spreads)


def deal_folds(codes: Codes, seed: int, groups: npt.NDArray[np.integer] | None = None) -> tuple[Codes, ...]:
    """Part the labelled shapes into folds in which each class has its share; indices.

    Classes are dealt out one after the other, so that the folds differ by at most one shape where no shapes belong
    together. Of those that do, the first is dealt, and the others follow it.

    Parameters
    ----------
    codes : (m,) int array
        -1 for a shape without a label.
    seed : int
    groups : (m,) int array, optional
        Shapes of one number, such as copies of each other, come into the same fold.
    """
    random = np.random.default_rng(seed)
    labelled = np.flatnonzero(codes >= 0)
    own = labelled if groups is None else np.asarray(groups)[labelled]
    _, first, of = np.unique(own, return_index=True, return_inverse=True)
    leaders = np.sort(labelled[first])
    classes = range(codes.max(initial=-1) + 1)
    dealt = np.concatenate([random.permutation(leaders[codes[leaders] == c]) for c in classes])
    fold = np.empty(len(codes), dtype=np.intp)
    fold[dealt] = np.arange(len(dealt)) % FOLDS
    fold[labelled] = fold[labelled[first]][of]
    return tuple(labelled[fold[labelled] == i] for i in range(min(FOLDS, len(dealt))))


def measure_gain(
    folds: Sequence[HeldOutFold | HeldOutBins], value: str = "nh_s", without: str = "nh_s_all"
) -> Gain:
    """What choosing gains on held-out shapes, and how far another deal may lie from that.

    Deals differ by chance in how they part the shapes, and in the seed of their maps; the folds of a deal also in their
    shapes, of which other shapes of the kind would make others.

    Parameters
    ----------
    folds : of one deal or more; at least one
    value, without : str
        The fields that hold what a fold's shapes reach with the choice and without it.
    """
    deals = np.array([fold.deal for fold in folds])
    shapes = np.array([fold.shapes for fold in folds])
    gains = np.array([getattr(fold, value) - getattr(fold, without) for fold in folds])
    by_deal = np.array(
        [np.average(gains[deals == deal], weights=shapes[deals == deal]) for deal in np.unique(deals)]
    )
    spreads = []
    if len(folds) > 1:
        spreads.append(gains.std(ddof=1) / np.sqrt(len(folds) / len(by_deal)))
    if len(by_deal) > 1:
        spreads.append(by_deal.std(ddof=1))
    return Gain(float(by_deal.mean()), float(max(spreads)) if spreads else None, len(by_deal))


def measure_distinct_gain(folds: Sequence[HeldOutFold | HeldOutBins]) -> Gain | None:
    """The same where one shape of each group of copies stands for all of it; None where there are no copies."""
    if not folds or folds[0].nh_s_distinct is None:
        return None
    return measure_gain(folds, "nh_s_distinct", "nh_s_all_distinct")


def choosing_pays(folds: Sequence[HeldOutBins]) -> bool:
    """Whether shapes that had no say are surely better off with chosen bins than with all features: on the map, or in
    being recognised by their neighbours."""
    gains = (measure_gain(folds), measure_gain(folds, "knn_accuracy", "knn_accuracy_all"))
    return any(gain.is_sure and gain.mean > 0 for gain in gains)


def seen_scores(weights: csr_matrix, codes: Codes, held_out: Codes) -> FloatArray:
    """NH_s of each map as it looks without the labels of some shapes.

    Held-out shapes are neither scored nor counted as neighbours, since nobody knows whether they would be hits. A
    shape with held-out neighbours only has no part in the mean.

    Parameters
    ----------
    weights : (S m, m) sparse matrix
        The neighbours on S maps, one map below the other.
    codes : (m,) int array
        -1 for a shape without a label.
    held_out : int array
        Indices of shapes.

    Returns
    -------
    (S,) float64 array
        0 where no shape can be scored.
    """
    seen = np.ones(len(codes), dtype=bool)
    seen[held_out] = False
    kept = weights.copy()
    kept.data = weights.data * seen[weights.indices]
    hits = neighbourhood_hits(kept, codes).reshape(-1, len(codes))
    known = np.add.reduceat(kept.data, kept.indptr[:-1]).reshape(hits.shape)
    counts = (known > 0) & seen & (codes >= 0)
    shares = np.divide(hits, known, out=np.zeros_like(hits), where=counts)
    return shares.sum(axis=1) / np.maximum(counts.sum(axis=1), 1)


def best_by_chance(weights: csr_matrix, codes: Codes, seed: int) -> FloatArray:
    """The best NH_s over S maps for labels dealt out anew, ``PERMUTATIONS`` times; sorted.

    Maps do not depend on labels, so that the whole search is repeated by counting alone. Parameters as for
    :func:`seen_scores`.
    """
    random = np.random.default_rng(seed)
    labelled = np.flatnonzero(codes >= 0)
    # Sorted, so that the names of the classes alone matter and not which shape had which.
    labels = np.sort(codes[labelled])
    shuffled = codes.copy()
    best = np.empty(PERMUTATIONS)
    for i in range(PERMUTATIONS):
        shuffled[labelled] = random.permutation(labels)
        hits = neighbourhood_hits(weights, shuffled).reshape(-1, len(codes))
        best[i] = hits[:, labelled].mean(axis=1).max()
    return np.sort(best)
