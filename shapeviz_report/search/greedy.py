"""Algorithm 1 of the paper: near-optimal features from few maps."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

from shapeviz_report.types import FloatArray


@dataclass(frozen=True)
class Trace:
    """What the algorithm did, on subsets as whole numbers (see :mod:`shapeviz_report.search.space`).

    Attributes
    ----------
    path : tuple of (int, float)
        The best subset after each pass and its score; the score rises.
    evaluated : frozenset of int
        The subsets whose score it asked for.
    considered : int
        How often it asked.
    """

    path: tuple[tuple[int, float], ...]
    evaluated: frozenset[int]
    considered: int


def climb(
    feature_count: int,
    s: int,
    scores_of: Callable[[Sequence[int]], Sequence[float] | FloatArray],
    highest: float = float("inf"),
) -> Trace:
    """Change up to ``s`` features at a time, always to the best neighbour, until none is better, or none can be.

    Starts from the empty set, which has no map and loses against any. Among equals the change of fewer, then of
    earlier features wins.

    Parameters
    ----------
    feature_count : int
    s : int
        From 1 to ``feature_count``.
    scores_of : callable
        The scores of some subsets; higher is better. The passes ask for all neighbours at once.
    highest : float
        What no score exceeds but by rounding: who reaches it looks no further.
    """
    changes = [
        sum(1 << i for i in chosen)
        for size in range(1, s + 1)
        for chosen in combinations(range(feature_count), size)
    ]
    current, current_score = 0, float("-inf")
    path: list[tuple[int, float]] = []
    evaluated: set[int] = set()
    considered = 0
    while True:
        neighbours = [current ^ change for change in changes if current != change]
        scores = list(scores_of(neighbours))
        evaluated.update(neighbours)
        considered += len(neighbours)
        best = max(range(len(neighbours)), key=scores.__getitem__, default=None)
        if best is None or not scores[best] > current_score:
            return Trace(tuple(path), frozenset(evaluated), considered)
        current, current_score = neighbours[best], float(scores[best])
        path.append((current, current_score))
        if current_score > highest - 1e-9:
            return Trace(tuple(path), frozenset(evaluated), considered)
