"""How well similar shapes are found: the measures of the Princeton Shape Benchmark (Shilane et al., SMI 2004).

Every labelled shape is a query. All others are ranked by their distance from it; those of its class are relevant. A
shape without a label is relevant to no query. Shapes that are equally far have no order: every measure is what a random
order of them gives on average. ``docs/method/retrieval.md`` has the definitions, and what was measured.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel
from shapeviz_report.order import classes_of
from shapeviz_report.quality import TIE
from shapeviz_report.types import FloatArray, IntArray, Rating, Retrieval


@dataclass(frozen=True)
class Measure:
    """A way to say in one number how good a ranking is, in [0, 1]; 1 where all relevant shapes come first.

    Attributes
    ----------
    name : str
        In files.
    title : str
        As people write it.
    explanation : str
        A sentence for a reader who does not know it.
    """

    name: str
    title: str
    explanation: str


PAGE = 32
"""Shapes that the E-measure looks at: what fits one page of results."""

MEASURES = (
    Measure(
        "nearest_neighbour", "Nearest neighbour", "How often the most similar shape is of the same class."
    ),
    Measure(
        "first_tier",
        "First tier",
        "What share of its class a shape finds among as many most similar shapes as the class has others.",
    ),
    Measure("second_tier", "Second tier", "The same among twice as many."),
    Measure(
        "e_measure",
        "E-measure",
        f"The harmonic mean of precision and recall within the first {PAGE}: what fits one page of results.",
    ),
    Measure(
        "dcg",
        "DCG",
        "Discounted cumulative gain: a shape of the class counts the less, the later it comes.",
    ),
    Measure(
        "average_precision",
        "Average precision",
        "The share of the class among all shapes up to each one of it, averaged: the area below the curve.",
    ),
)

RECALL_LEVELS = tuple(level / 20 for level in range(1, 21))
"""Shares of the class that are found, at which precision is stated."""


def highest_e_measures(queries: IntArray, others: int) -> FloatArray:
    """The E-measure of a perfect order for classes of so many shapes among ``others`` + 1: below 1 for all that do not
    just fill the page."""
    page, relevant = min(PAGE, others), np.asarray(queries) - 1
    return 2 * np.minimum(relevant, page) / (page + relevant)


def query_classes(labels: Sequence[str | None]) -> tuple[tuple[str, ...], IntArray]:
    """The classes whose shapes can be queries, and the class of each shape.

    Parameters
    ----------
    labels : n labels
        None for a shape without one.

    Returns
    -------
    classes : tuple of str
        Those of at least two shapes, in natural order.
    codes : (n,) int32 array
        Place among the classes; -1 for a shape of none of them.
    """
    names = [label for label in labels if label is not None]
    classes = tuple(name for name in classes_of(names) if names.count(name) > 1)
    number = {name: place for place, name in enumerate(classes)}
    return classes, np.array([-1 if label is None else number.get(label, -1) for label in labels], np.int32)


def rate(squared: npt.NDArray[np.floating], codes: IntArray) -> Rating:
    """Rate the rankings that some distances give.

    Parameters
    ----------
    squared : (n, n) float array
        Distances of all pairs, or their squares.
    codes : (n,) int32 array
        As :func:`query_classes` gives them; each class has two shapes or more.

    Returns
    -------
    Rating
    """
    sizes = np.bincount(codes[codes >= 0])
    scores = np.zeros((len(sizes), len(MEASURES)))
    precision = np.zeros((len(sizes), len(RECALL_LEVELS)))
    ranks = np.arange(1, len(codes) + 1)
    # The first two places count fully, then less and less.
    discounts = 1 / np.log2(np.maximum(ranks, 2))
    _rate(squared, codes, sizes, np.concatenate([[0.0], np.cumsum(discounts)]), scores, precision)
    return Rating(scores / sizes[:, None], precision / sizes[:, None])


def rate_chance(codes: IntArray) -> Rating:
    """What a random order reaches on average: the rating where all shapes are equally far."""
    return rate(np.zeros((len(codes), len(codes)), np.float32), codes)


def rate_subsets(squared: FloatArray, codes: IntArray, subsets: Sequence[int]) -> list[Rating]:
    """Rate what some subsets of the features find: the work of a report, in pieces of any size.

    Parameters
    ----------
    squared : (f, m, m) float32 array
        Squared distances by each feature, as in :class:`~shapeviz_report.search.SearchSpace`.
    codes : (m,) int32 array
    subsets : whole numbers from 1 to 2^f - 1
        Their binary digits say which features they have, the first feature lowest.
    """
    ratings = []
    for subset in subsets:
        distances = np.zeros(squared.shape[1:])
        for block, squares in enumerate(squared):
            if subset >> block & 1:
                distances += squares
        ratings.append(rate(distances, codes))
    return ratings


def best_subset(retrieval: Retrieval) -> int:
    """The row of ``Retrieval.members`` with the highest mean average precision over shapes; of equal ones, the smallest
    subset."""
    place = [measure.name for measure in MEASURES].index("average_precision")
    means = [retrieval.over_shapes(rating.scores)[place] for rating in retrieval.subsets]
    sizes = retrieval.members.sum(axis=1)
    return min(range(len(means)), key=lambda row: (-means[row], sizes[row]))


@kernel()
def _rate(
    squared: FloatArray,
    codes: IntArray,
    sizes: IntArray,
    gains: FloatArray,
    scores: FloatArray,
    precision: FloatArray,
) -> None:
    """Add the measures of every query to the sums of its class.

    Walks through each ranking in groups of equally far shapes. In a group of ``tied`` shapes of which ``own`` are
    relevant, each place holds a relevant shape with probability ``own / tied``, which is all that measures need that
    are sums over places.

    Parameters
    ----------
    squared : (n, n) float array
    codes : (n,) int32 array
    sizes : (c,) int array
    gains : (n + 1,) float64 array
        What the first 0, 1, 2, ... places add to DCG.
    scores : (c, 6) float64 array
    precision : (c, l) float64 array
        Both are added to.
    """
    others = len(codes) - 1
    levels = precision.shape[1]
    for query in range(len(codes)):
        code = codes[query]
        if code < 0:
            continue
        relevant = sizes[code] - 1
        page = min(PAGE, others)
        order = np.argsort(squared[query])
        order = order[order != query]
        at = np.empty(relevant)
        nearest = first = second = paged = gain = average = 0.0
        start = found = 0
        while start < others and found < relevant:
            limit = squared[query, order[start]] * (1 + TIE)
            end = start + 1
            own = 1 if codes[order[start]] == code else 0
            while end < others and squared[query, order[end]] <= limit:
                own += 1 if codes[order[end]] == code else 0
                end += 1
            tied = end - start
            share = own / tied
            if start == 0:
                nearest = share
            first += share * max(0, min(end, relevant) - start)
            second += share * max(0, min(end, 2 * relevant) - start)
            paged += share * max(0, min(end, page) - start)
            gain += share * (gains[end] - gains[start])
            if own > 0:
                # If a place holds a relevant shape, each place of the group before it does with this probability.
                before = (own - 1) / (tied - 1) if tied > 1 else 0.0
                for place in range(tied):
                    average += share * (found + 1 + place * before) / (start + 1 + place)
                for number in range(1, own + 1):
                    # The others of the group fall into own + 1 gaps between the relevant ones, as many into each.
                    wrong = start - found + number * (tied - own) / (own + 1)
                    at[found + number - 1] = (found + number) / (found + number + wrong)
            found += own
            start = end
        scores[code, 0] += nearest
        scores[code, 1] += first / relevant
        scores[code, 2] += second / relevant
        scores[code, 3] += 2 * paged / (page + relevant)
        scores[code, 4] += gain / gains[relevant]
        scores[code, 5] += average / relevant
        # Interpolated: the best precision with at least that share found.
        best = 0.0
        needed = relevant
        for level in range(levels, 0, -1):
            least = (level * relevant + levels - 1) // levels
            while needed >= least:
                best = max(best, at[needed - 1])
                needed -= 1
            precision[code, level - 1] += best
