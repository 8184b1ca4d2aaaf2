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
)
from shapeviz_report.types import BinSelection, BinStep, FloatArray

LIMIT = 51
"""Most bins of a selection: as many as the paper's expert took (4.4 B)."""

CLIMB_MAPS = 300
"""Maps that the climb may make: 15 CPU seconds for 280 shapes. docs/method/bins-search.md says what more
would bring."""

SPREAD_SEEDS = 5
"""Maps of the result with other seeds than the climb's."""

_GAIN = 1e-9
"""NH counts hits, so that real differences exceed this and rounding does not."""

Path = list[tuple[list[int], float]]
"""Chosen bins, and NH_s in their space."""


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
    can leave without loss leaves, until no bin raises it. Then NH_s of the map decides: every bin is tried to leave
    or to join, in the order of the NH_s that the space of the bins would then have, and the first change that
    raises it is made, until none does or ``CLIMB_MAPS`` maps are made.

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
    classes, codes = encode(space, labels)
    k = min(k, len(codes) - 1)
    back = np.argsort(space.rows)
    steps: list[BinStep] = []
    maps: list[FloatArray] = []
    by_seed = np.empty(0)
    if len(classes) > 1 and k >= 1:
        labelled = codes >= 0
        climbed = grow(space, codes, k, limit)
        climbed += climb(space, codes, k, limit, seed, climbed[-1][0])
        before: list[int] = []
        for bins, nh_space in climbed:
            xy = lay_out(space.squared(bins), seed)
            maps.append(turn_towards(xy, maps[-1]) if maps else xy)
            steps.append(
                BinStep(
                    bins=space.named(bins),
                    added=space.named(set(bins) - set(before)),
                    removed=space.named(set(before) - set(bins)),
                    nh_space=nh_space,
                    nh_s=float(hits_on(xy, codes, k)[labelled].mean()),
                    xy=maps[-1][back].astype(np.float32),
                )
            )
            before = bins
        squared = space.squared(before)
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


def grow(space: BinSpace, codes: Codes, k: int, limit: int) -> Path:
    """Add and remove bins as long as NH_s rises in their space, or stays with fewer of them.

    Among bins that raise it equally the first one joins. At least one bin is chosen; none joins once NH_s is what
    no space exceeds.
    """
    rows = np.flatnonzero(codes >= 0)
    squared = np.zeros((len(codes),) * 2)
    bins: list[int] = []
    path: Path = []
    best, highest = 0.0, float(highest_hits(codes, k)[rows].mean())
    while len(bins) < limit and not (bins and best > highest - _GAIN):
        scores = hits_of_additions(space.columns, squared, rows, codes, k).mean(axis=1)
        scores[bins] = -1
        joining = int(scores.argmax())
        if path and scores[joining] <= best + _GAIN:
            break
        bins = [*bins, joining]
        squared += space.squared_by(joining)
        best = float(scores[joining])
        path.append((bins, best))
        while len(bins) > 2:
            left = _scores_without(space, squared, bins[:-1], rows, codes, k)
            leaving = int(left.argmax())
            if left[leaving] < best - _GAIN:
                break
            squared -= space.squared_by(bins[leaving])
            bins = bins[:leaving] + bins[leaving + 1 :]
            best = float(left[leaving])
            path.append((bins, best))
    return path


def climb(space: BinSpace, codes: Codes, k: int, limit: int, seed: int, start: list[int]) -> Path:
    """Change one bin at a time as long as NH_s of the map rises, or stays with fewer bins; without ``start``.

    Once NH_s is what no map exceeds, bins are only tried to leave.
    """
    rows = np.flatnonzero(codes >= 0)
    bins, squared = start, space.squared(start)

    def score_map(distances: FloatArray) -> float:
        return float(hits_on(lay_out(distances, seed), codes, k)[rows].mean())

    best, made = score_map(squared), 1
    highest = float(highest_hits(codes, k)[rows].mean())
    tried = {frozenset(bins)}
    path: Path = []
    improved = True
    while improved and made < CLIMB_MAPS:
        improved = False
        most = limit if best < highest - _GAIN else 0
        for score, leaves, b in _changes(space, squared, bins, rows, codes, k, most):
            changed = [other for other in bins if other != b] if leaves else [*bins, b]
            if made == CLIMB_MAPS or frozenset(changed) in tried:
                continue
            tried.add(frozenset(changed))
            step = space.squared_by(b)
            moved = squared - step if leaves else squared + step
            value, made = score_map(moved), made + 1
            if value > best + _GAIN or (leaves and value >= best - _GAIN):
                bins, squared, best, improved = changed, moved, value, True
                path.append((bins, score))
                break
    return path


def _changes(
    space: BinSpace,
    squared: FloatArray,
    bins: list[int],
    rows: np.ndarray,
    codes: Codes,
    k: int,
    limit: int,
) -> list[tuple[float, bool, int]]:
    """What the climb tries, best first: NH_s in the space of the bins, whether the bin leaves, and which it is."""
    changes: list[tuple[float, bool, int]] = []
    if len(bins) > 1:
        left = _scores_without(space, squared, bins, rows, codes, k)
        changes += [(float(score), True, b) for score, b in zip(left, bins)]
    if len(bins) < limit:
        joined = hits_of_additions(space.columns, squared, rows, codes, k).mean(axis=1)
        changes += [(float(score), False, b) for b, score in enumerate(joined) if b not in bins]
    # Rounded, so that of equal ones those with fewer bins come first.
    return sorted(changes, key=lambda change: (-round(change[0], 9), not change[1], change[2]))


def _scores_without(
    space: BinSpace, squared: FloatArray, bins: Sequence[int], rows: np.ndarray, codes: Codes, k: int
) -> FloatArray:
    """NH_s in the space of the bins if each of some chosen ones left."""
    return np.array([hits_of(squared - space.squared_by(b), rows, codes, k).mean() for b in bins])
