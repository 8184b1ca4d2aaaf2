"""The fewest bins that separate a class from the rest (paper, 4.4 A, Fig. 6)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapeviz_report.quality import NEIGHBOURS, highest_hits
from shapeviz_report.search.bins.bin_space import BinSpace, encode, hits_of_additions, hits_on, lay_out
from shapeviz_report.types import MinimalBins, MinimalSet

LARGEST = 3
"""Most bins of a minimal set, as in the paper's Fig. 6."""

BEAM = 10
"""Best sets of a size to which every other bin is added."""

FINALISTS = 4
"""Best sets of a size, in the space of the bins, of which maps are made."""


def find_minimal_bins(
    space: BinSpace,
    labels: Sequence[str | None],
    label: str,
    *,
    k: int = NEIGHBOURS,
    largest: int = LARGEST,
    seed: int = 0,
) -> MinimalBins:
    """For 1, 2, ... bins, the set that separates a class from the rest best.

    All single bins are looked at, and of larger sets those that add a bin to one of the ``BEAM`` best of the size
    below. NH_c in the space of the bins ranks them; of the ``FINALISTS`` best, that with the highest NH_c on its
    t-SNE map is taken. A size that reaches on both what no map exceeds (:func:`shapeviz_report.quality.highest_hits`)
    ends the search.

    Parameters
    ----------
    space : BinSpace
    labels : labels of all shapes of the table
    label : str
        The class.
    k : int
        Of the neighbourhood hit; less where there are fewer other shapes.
    largest : int
        Most bins of a set.
    seed : int
        Of the maps.

    Raises
    ------
    ValueError
        No shape of the space has this label, or there is no other shape.
    """
    classes, codes = encode(space, labels)
    k = min(k, len(codes) - 1)
    if label not in classes or k < 1:
        raise ValueError(f"there is nothing to separate {label!r} from")
    rows = np.flatnonzero(codes == classes.index(label))
    highest = highest_hits(codes, k)[rows[0]]
    back = np.argsort(space.rows)
    beam: list[tuple[int, ...]] = [()]
    sets: list[MinimalSet] = []
    for _ in range(min(largest, len(space.names))):
        scores: dict[tuple[int, ...], float] = {}
        for bins in beam:
            hits = hits_of_additions(space.columns, space.squared(bins), rows, codes, k).mean(axis=1)
            for b in np.argsort(-hits, kind="stable")[: BEAM + len(bins)]:
                if b not in bins:
                    scores[tuple(sorted((*bins, int(b))))] = float(hits[b])
        beam = sorted(scores, key=lambda chosen: (-round(scores[chosen], 9), chosen))[:BEAM]
        maps = [lay_out(space.squared(bins), seed) for bins in beam[:FINALISTS]]
        values = [float(hits_on(xy, codes, k)[rows].mean()) for xy in maps]
        best = int(np.argmax(np.round(values, 9)))
        sets.append(
            MinimalSet(
                bins=space.named(beam[best]),
                nh_c_space=scores[beam[best]],
                nh_c=values[best],
                xy=maps[best][back].astype(np.float32),
            )
        )
        if min(sets[-1].nh_c, sets[-1].nh_c_space) > highest - 1e-9:
            break
    return MinimalBins(label, space.rows[back], tuple(sets))
