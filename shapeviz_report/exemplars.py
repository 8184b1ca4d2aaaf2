"""Which shapes and classes show best what a bin tells apart."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial.distance import cdist

from shapeviz_report.order import classes_of
from shapeviz_report.quality import neighbour_weights
from shapeviz_report.types import BinSearch, FeatureTable, FloatArray

PAIRS = 4_000_000
"""Most pairs of points whose distances are held at once."""


def find_centres(scaled: FloatArray, labels: Sequence[str | None]) -> dict[str, int]:
    """The most central shape of every class: the one nearest to the mean of the class, as a row.

    Parameters
    ----------
    scaled : (n, w) float array
        Features as projections compare them.
    labels : n labels
    """
    centres = {}
    for label in classes_of(labels):
        rows = np.flatnonzero([other == label for other in labels])
        offsets = scaled[rows] - scaled[rows].mean(axis=0)
        centres[label] = int(rows[np.square(offsets).sum(axis=1).argmin()])
    return centres


def find_rivals(xy: FloatArray, labels: Sequence[str | None], k: int) -> dict[str, str]:
    """The class that every class is most confused with on a map.

    It is the one to which most of its shapes' k nearest neighbours of other classes belong; for a class whose
    neighbours are all its own, the one that lies nearest, by the mean distance of the shapes.

    Parameters
    ----------
    xy : (n, 2) float array
    labels : n labels
        Of at least two classes.
    k : int
        At least 1; less where there are fewer other shapes.
    """
    k = min(k, len(xy) - 1)
    classes = classes_of(labels)
    members = np.array([[label == name for label in labels] for name in classes], dtype=float)
    shares = members @ neighbour_weights(xy, k) @ members.T
    np.fill_diagonal(shares, -1)
    rivals = {}
    for number, name in enumerate(classes):
        if shares[number].max() > 0:
            nearest = shares[number].argmax()
        else:
            distances = _mean_distances(xy[members[number] > 0], xy, members)
            distances[number] = np.inf
            nearest = distances.argmin()
        rivals[name] = classes[int(nearest)]
    return rivals


def _mean_distances(own: FloatArray, xy: FloatArray, members: FloatArray) -> FloatArray:
    """The mean distances of some points (m, 2) from groups (c, n) of all points (n, 2); (c,)."""
    total = np.zeros(len(members))
    # Not all pairs at once: of 10,000 points they would take 800 MB.
    step = max(1, PAIRS // len(xy))
    for start in range(0, len(own), step):
        total += members @ cdist(own[start : start + step], xy).sum(axis=0)
    return total / len(own) / members.sum(axis=1)


def choose_exemplars(
    found: BinSearch,
    table: FeatureTable,
    labels: Sequence[str | None],
    scaled: FloatArray,
    xy: FloatArray,
    k: int,
) -> dict[str, tuple[int, ...]]:
    """The shapes on which every bin that a search found is to be seen, as rows of the table.

    A bin that separates a class is seen on the centre of this class and on that of its rival; one of the automatic
    selection on the centres of the class with most and of the class with least of it, by the mean.

    Parameters
    ----------
    found : BinSearch
    table : FeatureTable
    labels : n labels
    scaled, xy, k
        As for :func:`find_centres` and :func:`find_rivals`.

    Returns
    -------
    dict of str to tuple of int
        By bin, in the order of the columns. Without external features, of which no surface is known.
    """
    centres, rivals = find_centres(scaled, labels), find_rivals(xy, labels, k)
    pairs: dict[str, list[str]] = {}
    for separated in found.minimal:
        for column in (column for chosen in separated.sets for column in chosen.bins):
            pairs.setdefault(column, []).extend((separated.label, rivals[separated.label]))
    columns = {column: place for place, column in enumerate(table.columns)}
    means = {label: table.values[[other == label for other in labels]].mean(axis=0) for label in centres}
    for column in found.automatic.bins:
        amounts = {label: values[columns[column]] for label, values in means.items()}
        pairs.setdefault(column, []).extend(
            (max(amounts, key=amounts.__getitem__), min(amounts, key=amounts.__getitem__))
        )
    histograms = {column for block in table.blocks if block.bins > 1 for column in block.columns}
    return {
        column: tuple(sorted({centres[label] for label in pairs[column]}))
        for column in sorted(pairs.keys() & histograms, key=columns.__getitem__)
    }
