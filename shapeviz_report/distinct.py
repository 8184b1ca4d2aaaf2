"""The figures of a database in which every shape counts once, however many copies of it there are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from shapeviz_report.quality import hit_range, score
from shapeviz_report.retrieval import query_classes, rate
from shapeviz_report.types import (
    BinSelection,
    FeatureSearch,
    FloatArray,
    IntArray,
    WithoutCopies,
    representatives,
)


def rate_without_copies(
    groups: IntArray,
    labels: Sequence[str | None],
    maps: Mapping[str, FloatArray],
    k: int,
    rows: IntArray,
    distances: Mapping[str, FloatArray],
    search: FeatureSearch | None = None,
    automatic: BinSelection | None = None,
) -> WithoutCopies | None:
    """Rate the same maps and the same distances among one shape of each group of copies.

    Parameters
    ----------
    groups : (n,) int array
        As :func:`~shapeviz_report.types.group_copies` gives them.
    labels : n labels
        None for a shape without one.
    maps : mapping of str to (n, 2) float64 array
        By method.
    k : int
        Neighbours that the neighbourhood hit counts.
    rows : (m,) int array
        The shapes that retrieval took, as rising rows.
    distances : mapping of str to (m, m) float array
        Squared distances of these, by what is compared.
    search, automatic
        Whose best maps are rated, too.

    Returns
    -------
    WithoutCopies or None
        None where no shape has a copy.
    """
    labelled = np.array([label is not None for label in labels])
    kept = representatives(groups, labelled)
    if len(kept) == len(groups):
        return None
    own = [labels[row] for row in kept]
    queried = representatives(groups[rows], labelled[rows])
    classes, codes = query_classes([labels[row] for row in rows[queried]])
    retrieval = {}
    if classes:
        weights = np.bincount(codes[codes >= 0])
        for name, squared in distances.items():
            scores = rate(squared[np.ix_(queried, queried)], codes).scores
            retrieval[name] = np.average(scores, axis=0, weights=weights)

    def hit(xy: npt.NDArray[np.floating], shown: npt.NDArray[np.signedinteger], k: int) -> float | None:
        """NH_s of a map of some rows."""
        own = representatives(groups[shown], labelled[shown])
        return score(xy[own].astype(np.float64), [labels[row] for row in shown[own]], k=k).nh_s

    best = None
    if search is not None and not np.isnan(search.subsets.nh_s).any():
        best = hit(search.subsets.xy[int(search.subsets.nh_s.argmax())], search.rows, search.k)
    return WithoutCopies(
        copies=len(groups) - len(kept),
        nh_s={method: hit(xy, np.arange(len(labels)), k) for method, xy in maps.items()},
        nh_max=hit_range(own, k).highest,
        bins=hit(automatic.path[-1].xy, automatic.rows, automatic.k)
        if automatic and automatic.path
        else None,
        best=best,
        retrieval=retrieval,
    )
