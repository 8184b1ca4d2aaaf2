"""Which groups of shapes a score is to tell apart (paper, 4.3, separation control)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
import numpy.typing as npt

from shapeviz_report.order import classes_of
from shapeviz_report.scorers.base import Scorer
from shapeviz_report.types import FloatArray

MOST_SCORED = 5000
"""Most shapes by which a build scores the bins of a class: 110 MB of values."""


@dataclass(frozen=True)
class Contest:
    """One group of shapes against another.

    Attributes
    ----------
    positive, negative : arrays of row indices
        Rising; neither is empty, no row is in both.
    """

    positive: npt.NDArray[np.intp]
    negative: npt.NDArray[np.intp]

    def __post_init__(self) -> None:
        if len(self.positive) == 0 or len(self.negative) == 0:
            raise ValueError("a contest needs two groups with at least one row each")
        if np.intersect1d(self.positive, self.negative).size:
            raise ValueError("a row cannot be in both groups of a contest")


def as_one_group(
    labels: Sequence[str | None], classes: Iterable[str], others: Iterable[str] | None = None
) -> list[Contest]:
    """All shapes of some classes together against all shapes of others together.

    Parameters
    ----------
    labels : n labels
        None for a shape without one; it is in no group.
    classes : names of the classes to separate
    others : names of the classes to separate them from
        None: the rest, every class not in ``classes``.

    Returns
    -------
    list of Contest
        One. :func:`each_from_each` has several.

    Raises
    ------
    ValueError
        A group has no shape, or a class is in both.
    """
    classes = set(classes)
    return [Contest(_rows(labels, classes), _rows(labels, _others(labels, classes, others)))]


def each_from_each(
    labels: Sequence[str | None], classes: Iterable[str], others: Iterable[str] | None = None
) -> list[Contest]:
    """Every one of some classes against every one of others: a contest for each pair of different classes.

    Parameters and errors are those of :func:`as_one_group`, except that a class may be in both: with the same
    classes twice, each is separated from each other.
    """
    classes = set(classes)
    distinct: dict[frozenset[str], tuple[str, str]] = {}
    for pair in product(classes_of(classes), classes_of(_others(labels, classes, others))):
        if pair[0] != pair[1]:
            distinct.setdefault(frozenset(pair), pair)  # a pair and its reverse are one contest
    return [Contest(_rows(labels, {one}), _rows(labels, {other})) for one, other in distinct.values()]


def score_separation(
    scorer: Scorer, values: FloatArray, contests: Sequence[Contest], *, seed: int = 0
) -> FloatArray:
    """Relative scores: how well each column separates the groups of all contests.

    The scores of each contest are divided by their largest, so that every contest counts equally, and averaged.

    Parameters
    ----------
    scorer : Scorer
    values : (n, d) float array
        Compared values; finite.
    contests : sequence of Contest
        At least one.
    seed : int

    Returns
    -------
    (d,) float64 array
        In [0, 1]. With a single contest the best column has 1, unless none separates at all.

    Raises
    ------
    ValueError
        There is no contest.
    """
    if not contests:
        raise ValueError("nothing to separate: there is no contest")
    total = np.zeros(values.shape[1])
    for contest in contests:
        rows = np.concatenate([contest.positive, contest.negative])
        scores = scorer.score(values[rows], np.arange(len(rows)) < len(contest.positive), seed=seed)
        highest = scores.max(initial=0.0)
        if highest > 0:
            total += scores / highest
    return total / len(contests)


def _others(labels: Sequence[str | None], classes: set[str], others: Iterable[str] | None) -> set[str]:
    if others is None:
        return {label for label in labels if label is not None} - classes
    return set(others)


def _rows(labels: Sequence[str | None], classes: set[str]) -> npt.NDArray[np.intp]:
    return np.array([row for row, label in enumerate(labels) if label in classes], dtype=np.intp)
