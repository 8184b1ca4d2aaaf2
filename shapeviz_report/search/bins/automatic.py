"""From no bins to a set that separates all classes (paper, 4.4, Fig. 7), without a person at the tool."""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np

from shapeviz_report.projections import turn_towards
from shapeviz_report.quality import NEIGHBOURS, highest_hits
from shapeviz_report.search.bins.bin_space import (
    BinSpace,
    Codes,
    encode,
    hits_of,
    hits_of_additions,
    hits_on,
    lay_out,
    places_of,
)
from shapeviz_report.types import BinSelection, BinStep, FloatArray

LIMIT = 51
"""Most bins of a selection: as many as the paper's expert took (4.4 B)."""

CLIMB_LIMIT = 500
"""Most shapes whose maps decide. A map of more takes seconds, and what is grown only is as good on shapes that it never
saw (docs/method/bins-search.md)."""

CLIMB_MAPS = 300
"""Maps that the climb may make: 15 CPU seconds for 280 shapes. docs/method/bins-search.md says what more
would bring."""

SPREAD_SEEDS = 5
"""Maps of the result with other seeds than the climb's."""

_GAIN = 1e-9
"""NH counts hits, so that real differences exceed this and rounding does not."""


def select_bins(
    space: BinSpace,
    labels: Sequence[str | None],
    *,
    k: int = NEIGHBOURS,
    limit: int = LIMIT,
    seed: int = 0,
) -> BinSelection:
    """A small set of bins whose t-SNE map separates all classes.

    First NH_s in the space of the bins decides, which needs no map: the bin that raises it most joins, then whatever
    can leave without loss leaves, until no bin raises it. Up to ``CLIMB_LIMIT`` shapes NH_s of the map then decides:
    every bin is tried to leave or to join, in the order of the NH_s that the space of the bins would then have, and the
    first change that raises it is made, until none does or ``CLIMB_MAPS`` maps are made. For these decisions as many
    neighbours of a shape count as its class has others, if these are fewer than ``k``
    (:func:`~shapeviz_report.search.bins.bin_space.places_of`); the values that are returned have ``k`` for all.

    Parameters
    ----------
    space : BinSpace
    labels : labels of all shapes of the table
    k : int
        Of the neighbourhood hit; less where there are fewer other shapes.
    limit : int
        Most bins.
    seed : int
        Of the maps.

    Returns
    -------
    BinSelection
        Without a step if there are not two classes to separate.
    """
    start = time.process_time()
    codes = encode(space, labels)[1]
    k = min(k, len(codes) - 1)
    labelled, back = np.flatnonzero(codes >= 0), np.argsort(space.rows)
    steps: list[BinStep] = []
    maps: list[FloatArray] = []
    by_seed = np.empty(0)
    before: list[int] = []
    for bins in choose(space, codes, k, limit, seed):
        squared = space.squared(bins)
        xy = lay_out(squared, seed)
        maps.append(turn_towards(xy, maps[-1]) if maps else xy)
        steps.append(
            BinStep(
                bins=space.named(bins),
                added=space.named(set(bins) - set(before)),
                removed=space.named(set(before) - set(bins)),
                nh_space=float(hits_of(squared, labelled, codes, k).mean()),
                nh_s=float(hits_on(xy, codes, k)[labelled].mean()),
                xy=maps[-1][back].astype(np.float32),
            )
        )
        before = bins
    if steps:
        others = range(seed + 1, seed + 1 + SPREAD_SEEDS)
        by_seed = np.array([hits_on(lay_out(squared, s), codes, k)[labelled].mean() for s in others])
    return BinSelection(
        seed=seed,
        k=max(k, 0),
        rows=space.rows[back],
        shape_count=space.shape_count,
        path=tuple(steps),
        nh_s_other_seeds=by_seed,
        cpu_seconds=time.process_time() - start,
    )


def choose(space: BinSpace, codes: Codes, k: int, limit: int, seed: int) -> list[list[int]]:
    """The bins of every step of :func:`select_bins`; none if there are not two classes."""
    if len(np.unique(codes[codes >= 0])) < 2 or k < 1:
        return []
    path = grow(space, codes, k, limit)
    if len(codes) <= CLIMB_LIMIT:
        path += climb(space, codes, k, limit, seed, path[-1])
    return path


def grow(space: BinSpace, codes: Codes, k: int, limit: int) -> list[list[int]]:
    """Add and remove bins as long as NH_s rises in their space, or stays with fewer of them.

    Among bins that raise it equally the first one joins. At least one bin is chosen; none joins once NH_s is what
    no space exceeds. Neighbours are counted by :func:`~shapeviz_report.search.bins.bin_space.places_of`.
    """
    rows, places = np.flatnonzero(codes >= 0), places_of(codes, k)
    squared = np.zeros((len(codes),) * 2)
    bins: list[int] = []
    path: list[list[int]] = []
    best, highest = 0.0, _highest(codes)
    while len(bins) < limit and not (bins and best > highest - _GAIN):
        scores = hits_of_additions(space.columns, squared, rows, codes, places).mean(axis=1)
        scores[bins] = -1
        joining = int(scores.argmax())
        if path and scores[joining] <= best + _GAIN:
            break
        bins = [*bins, joining]
        squared += space.squared_by(joining)
        best = float(scores[joining])
        path.append(bins)
        while len(bins) > 2:
            left = _scores_without(space, squared, bins[:-1], rows, codes, places)
            leaving = int(left.argmax())
            if left[leaving] < best - _GAIN:
                break
            squared -= space.squared_by(bins[leaving])
            bins = bins[:leaving] + bins[leaving + 1 :]
            best = float(left[leaving])
            path.append(bins)
    return path


def climb(space: BinSpace, codes: Codes, k: int, limit: int, seed: int, start: list[int]) -> list[list[int]]:
    """Change one bin at a time as long as NH_s of the map rises, or stays with fewer bins; without ``start``.

    Once NH_s is what no map exceeds, bins are only tried to leave.
    """
    rows, places = np.flatnonzero(codes >= 0), places_of(codes, k)
    bins, squared = start, space.squared(start)

    def score_map(distances: FloatArray) -> float:
        return float(hits_on(lay_out(distances, seed), codes, places)[rows].mean())

    best, made = score_map(squared), 1
    highest = _highest(codes)
    tried = {frozenset(bins)}
    path: list[list[int]] = []
    improved = True
    while improved and made < CLIMB_MAPS:
        improved = False
        most = limit if best < highest - _GAIN else 0
        for leaves, b in _changes(space, squared, bins, rows, codes, places, most):
            changed = [other for other in bins if other != b] if leaves else [*bins, b]
            if made == CLIMB_MAPS or frozenset(changed) in tried:
                continue
            tried.add(frozenset(changed))
            step = space.squared_by(b)
            moved = squared - step if leaves else squared + step
            value, made = score_map(moved), made + 1
            if value > best + _GAIN or (leaves and value >= best - _GAIN):
                bins, squared, best, improved = changed, moved, value, True
                path.append(bins)
                break
    return path


def _highest(codes: Codes) -> float:
    """What no space exceeds where as many neighbours count as a class has others: 1, and 0 for a shape alone."""
    return float(highest_hits(codes, 1)[codes >= 0].mean())


def _changes(
    space: BinSpace,
    squared: FloatArray,
    bins: list[int],
    rows: np.ndarray,
    codes: Codes,
    places: Codes,
    limit: int,
) -> list[tuple[bool, int]]:
    """What the climb tries, by falling NH_s in the space of the bins: whether the bin leaves, and which it is."""
    changes: list[tuple[float, bool, int]] = []
    if len(bins) > 1:
        left = _scores_without(space, squared, bins, rows, codes, places)
        changes += [(float(score), True, b) for score, b in zip(left, bins)]
    if len(bins) < limit:
        joined = hits_of_additions(space.columns, squared, rows, codes, places).mean(axis=1)
        changes += [(float(score), False, b) for b, score in enumerate(joined) if b not in bins]
    # Rounded, so that of equal ones those with fewer bins come first.
    changes.sort(key=lambda change: (-round(change[0], 9), not change[1], change[2]))
    return [(leaves, b) for _, leaves, b in changes]


def _scores_without(
    space: BinSpace, squared: FloatArray, bins: Sequence[int], rows: np.ndarray, codes: Codes, places: Codes
) -> FloatArray:
    """NH_s in the space of the bins if each of some chosen ones left."""
    return np.array([hits_of(squared - space.squared_by(b), rows, codes, places).mean() for b in bins])
