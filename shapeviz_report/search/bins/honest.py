"""What a selection of bins is worth on shapes it never saw, and what it makes of labels without meaning."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from shapeviz_report.quality import NEIGHBOURS, TIE, highest_hits, hits_among
from shapeviz_report.search.bins.automatic import LIMIT, choose
from shapeviz_report.search.bins.bin_space import BinSpace, Codes, encode, hits_of, hits_on, lay_out
from shapeviz_report.types import FloatArray, HeldOutBins

MAP_SEEDS = 5
"""Maps over which NH of held-out shapes is averaged. Against a selection they cost nothing."""

MOST_DEALS = 10
FULLY_DEALT = 240
"""A deal of as many shapes into folds costs 60 CPU seconds, and a build affords one; of fewer shapes, more."""


def affordable_deals(shape_count: int) -> int:
    """How often to deal shapes into folds and hold these out: the fewer there are, the more chance is in one deal, and
    the less it costs (time grows with the square of their number)."""
    return int(np.clip((FULLY_DEALT / max(shape_count, 1)) ** 2, 1, MOST_DEALS))


def hold_out(
    space: BinSpace,
    labels: Sequence[str | None],
    fold: npt.NDArray[np.intp],
    everything: FloatArray,
    *,
    k: int = NEIGHBOURS,
    limit: int = LIMIT,
    seed: int = 0,
    deal: int = 1,
    distinct: Sequence[int] | None = None,
) -> HeldOutBins:
    """Select bins without some shapes, then see how well these are separated and recognised.

    The selection knows neither their labels nor their values, but for the scale of each bin. They are then scored
    among all shapes by Eq. 7 with all labels, and recognised by the vote of the k nearest shapes that the selection
    saw.

    Parameters
    ----------
    space : BinSpace
    labels : labels of all shapes of the table
    fold : int array
        The held-out shapes, as places in ``space.rows`` (:func:`shapeviz_report.search.certainty.deal_folds` of the
        numbers that :func:`~shapeviz_report.search.bins.bin_space.encode` gives); all labelled.
    everything : (m, m) float array
        Squared distances of the space's shapes by all features: what is to be surpassed.
    k, limit, seed
        As in :func:`~shapeviz_report.search.bins.automatic.select_bins`.
    deal : int
        Which deal the fold is of.
    distinct : rows, optional
        Places of shapes of which none is a copy of another, one of each group of copies; without it there are none.
    """
    _, codes = encode(space, labels)
    seen = np.setdiff1d(np.arange(len(codes)), fold)
    known, own_codes = space.keep(seen), codes[seen]
    of_seen = min(k, len(seen) - 1)
    path = choose(known, own_codes, of_seen, limit, seed)
    bins, nh_s_seen = [], float("nan")
    if path:
        bins = path[-1]
        on_own = hits_on(lay_out(known.squared(bins), seed), own_codes, of_seen)
        nh_s_seen = float(on_own[own_codes >= 0].mean())
    squared = space.squared(bins)
    k = min(k, len(codes) - 1)
    seeds = range(seed, seed + MAP_SEEDS)
    own, whole = ([lay_out(distances, s) for s in seeds] for distances in (squared, everything))
    own_distinct, whole_distinct = None, None
    if distinct is not None:
        kept = np.array(distinct)
        own_distinct, whole_distinct = (
            float(np.mean([np.nanmean(hits_among(xy, codes, kept, k)[fold]) for xy in maps]))
            for maps in (own, whole)
        )
    return HeldOutBins(
        deal=deal,
        bins=space.named(bins),
        shapes=len(fold),
        nh_s_seen=nh_s_seen,
        nh_space=float(hits_of(squared, fold, codes, k).mean()),
        nh_s=float(np.mean([hits_on(xy, codes, k)[fold].mean() for xy in own])),
        nh_s_all=float(np.mean([hits_on(xy, codes, k)[fold].mean() for xy in whole])),
        nh_max=float(highest_hits(codes, k)[fold].mean()),
        knn_accuracy=recognise(squared, codes, fold, k),
        knn_accuracy_all=recognise(everything, codes, fold, k),
        nh_s_distinct=own_distinct,
        nh_s_all_distinct=whole_distinct,
    )


def recognise(squared: FloatArray, codes: Codes, fold: npt.NDArray[np.intp], k: int) -> float:
    """The share of held-out shapes whose class the k nearest labelled other shapes elect.

    Neighbours that tie for the last places share their votes, and classes that tie share the success: the mean over
    all ways to break ties.

    Parameters
    ----------
    squared : (m, m) float array
    codes : (m,) int array
        -1 without a label.
    fold : int array
        The held-out shapes, of which none votes.
    k : int
    """
    voters = np.setdiff1d(np.flatnonzero(codes >= 0), fold)
    k = min(k, len(voters))
    success = 0.0
    for shape in fold:
        distances = squared[shape, voters]
        last = np.partition(distances, k - 1)[k - 1]
        nearer = distances < last * (1 - TIE)
        tied = (distances <= last * (1 + TIE)) & ~nearer
        weights = nearer + tied * ((k - nearer.sum()) / tied.sum())
        votes = np.bincount(codes[voters], weights, codes.max() + 1)
        elected = np.flatnonzero(votes > votes.max() - 1e-9)
        success += (codes[shape] in elected) / len(elected)
    return success / len(fold)


def shuffle_labels(space: BinSpace, labels: Sequence[str | None], seed: int) -> list[str | None]:
    """Labels dealt out anew among the labelled shapes of a space; which shape had which has no effect."""
    random = np.random.default_rng(seed)
    shuffled = list(labels)
    rows = [int(row) for row in space.rows if labels[row] is not None]
    names = sorted(label for row in rows if (label := labels[row]) is not None)
    for row, name in zip(rows, random.permutation(len(names))):
        shuffled[row] = names[name]
    return shuffled
