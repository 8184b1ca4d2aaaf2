"""The contract of a scorer, and what all of them share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from shapeviz_report.types import BoolArray, FloatArray


@dataclass(frozen=True)
class Scorer:
    """A way of telling how well each column of a table separates two groups of rows.

    Attributes
    ----------
    name : str
        As in options and files.
    title : str
        As people write it.
    explanation : str
        What a high score means, in a sentence for readers.
    source : str
        The publication that the method is from.
    range : str
        Which scores there can be.
    exact : bool
        Whether the scores follow from the values alone. Others draw random numbers: their scores have a spread from
        seed to seed.
    measure : callable
        ``(values (n, d), positive (n,), seed) -> (d,)``: the method itself, for columns that all vary. It is
        called by :meth:`score` only.
    """

    name: str
    title: str
    explanation: str
    source: str
    range: str
    exact: bool
    measure: Callable[[FloatArray, BoolArray, int], FloatArray]

    def score(self, values: FloatArray, positive: BoolArray, *, seed: int = 0) -> FloatArray:
        """How well each column tells the rows of one group from those of the other.

        The scores do not depend on the order of rows or columns, beyond rounding: a method that draws random
        numbers sees them in an order which their values alone decide, and columns with the same values get their
        mean.

        Parameters
        ----------
        values : (n, d) float array
            Finite.
        positive : (n,) bool array
            The rows of one group; the others are the other group. Each has at least one.
        seed : int
            For methods that are not exact.

        Returns
        -------
        (d,) float64 array
            Finite, at least 0, higher separates better; 0 for a constant column.

        Raises
        ------
        ValueError
            A group is empty, or ``positive`` does not have an entry for every row.
        """
        values = np.asarray(values, dtype=np.float64)
        positive = np.asarray(positive, dtype=bool)
        if positive.shape != values.shape[:1] or positive.all() or not positive.any():
            raise ValueError("a score needs two groups with at least one row each")
        scores = np.zeros(values.shape[1])
        varying = np.flatnonzero(np.ptp(values, axis=0) > 0)
        if len(varying) == 0:
            return scores
        values = values[:, varying]
        if self.exact:
            scores[varying] = self.measure(values, positive, seed)
        else:
            rows, columns, copies = _canonical_order(values, positive)
            found = np.empty(len(varying))
            found[columns] = self.measure(values[np.ix_(rows, columns)], positive[rows], seed)
            means = np.bincount(copies, weights=found) / np.bincount(copies)
            scores[varying] = means[copies]
        return scores


def _canonical_order(
    values: FloatArray, positive: BoolArray
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Orders of rows and of columns that the values and groups alone decide, and which columns are the same.

    Sorting the rows by their values would not do, as that depends on the order of the columns. So both are sorted
    by fingerprints, which are sums of scrambled integers and thus the same in any order.

    Returns
    -------
    rows : (n,) indices
    columns : (d,) indices
    copies : (d,) numbers from 0 on, equal for columns with equal values
    """
    bits = np.ascontiguousarray(values + 0.0).view(
        np.uint64
    )  # + 0.0: there are two zeros, with different bits
    of_rows = _scramble(_scramble(bits).sum(axis=1) + positive)
    of_columns = _scramble(bits ^ of_rows[:, None]).sum(axis=0)
    copies = np.unique(of_columns, return_inverse=True)[1]
    return np.argsort(of_rows, kind="stable"), np.argsort(of_columns, kind="stable"), copies


def _scramble(bits: npt.NDArray[np.uint64]) -> npt.NDArray[np.uint64]:
    """Integers that look random (the finaliser of SplitMix64; Steele, Lea and Flood 2014)."""
    bits = (bits ^ (bits >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    bits = (bits ^ (bits >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return bits ^ (bits >> np.uint64(31))
