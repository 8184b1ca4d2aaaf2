"""Which shapes of a database are copies of each other."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from shapeviz_report.building.runner import Runner, Task
from shapeviz_report.building.stages import COMPARE, compare_all, identify
from shapeviz_report.copies import Outline, join_copies, pair_outlines
from shapeviz_report.errors import MeshError
from shapeviz_report.types import Copy, Match

logger = logging.getLogger(__name__)

PAIRS_A_TASK = 16
"""Pairs that a worker compares before it reports back, each in some hundredths of a second."""

BYTES_A_TASK = 4_000_000
"""Of the files of such pairs: what is large is compared alone, for a task has the time that a mesh has."""

Pair = tuple[str, str]
"""The ids of two shapes."""


def find_copies(
    run: Runner,
    read: Callable[[str], Mapping[str, bytes]],
    outlines: Mapping[str, Outline],
) -> tuple[Copy, ...]:
    """The shapes that are the same shape again; those whose comparison fails are taken for different."""
    certain, possible = pair_outlines(outlines)
    found: dict[Pair, Match | None] = {}
    with run.clock.stage(COMPARE.name, COMPARE.doing, len(possible)) as step:
        names: dict[str, str] = {}
        weights: dict[str, int] = {}
        for shape in sorted({shape for pair in possible for shape in pair}):
            try:
                files = read(shape)
            except (MeshError, MemoryError):
                continue  # its pairs are tried one by one, and say so
            names[shape], weights[shape] = identify(files), sum(map(len, files.values()))

        def take(pair: Pair, _: str, content: bytes, cpu_seconds: float) -> None:
            found[pair] = COMPARE.read(content)
            step(cpu_seconds)

        def drop(pair: Pair, reason: str, cpu_seconds: float) -> None:
            logger.warning("Whether %s and %s are copies is not known: %s", *pair, reason)
            step(cpu_seconds)

        def key(pair: Pair) -> str:
            return COMPARE.key(*(names[shape] for shape in pair))

        def gather(pairs: Sequence[Pair]) -> tuple[object, ...]:
            return {shape: read(shape) for shape in sorted({s for pair in pairs for s in pair})}, pairs

        def plan(pair: Pair) -> Task:
            first, second = map(read, pair)
            return Task(COMPARE.key(identify(first), identify(second)), lambda: (first, second))

        read_once = [pair for pair in possible if names.keys() >= set(pair)]
        alone = [pair for pair in possible if not names.keys() >= set(pair)]
        alone += run.find_together(COMPARE, compare_all, share_out(read_once, weights), key, gather, take)
        run.find(COMPARE, alone, plan, take, drop)
    return join_copies(certain, found, list(outlines))


def share_out(pairs: Sequence[Pair], weights: Mapping[str, int]) -> list[list[Pair]]:
    """Deal pairs out to tasks so that those of a task have shapes in common.

    Parameters
    ----------
    pairs : sequence of (str, str)
    weights : mapping of str to int
        Bytes of each shape's file.

    Returns
    -------
    list of list of (str, str)
        At most :data:`PAIRS_A_TASK` together, with files of at most :data:`BYTES_A_TASK`; a pair alone may have more.
    """
    ids = sorted({shape for pair in pairs for shape in pair})
    number = {shape: place for place, shape in enumerate(ids)}
    ends = np.array([[number[a], number[b]] for a, b in pairs], int).reshape(-1, 2)
    graph = coo_array((np.ones(len(ends)), tuple(ends.T)), shape=(len(ids), len(ids))).tocsr()
    # In this order shapes that are to be compared stand near each other (Cuthill and McKee, 1969).
    place = np.argsort(reverse_cuthill_mckee(graph + graph.T, symmetric_mode=True)) if ids else np.arange(0)
    places = np.sort(place[ends], axis=1)
    tasks: list[list[Pair]] = []
    there: set[str] = set()
    for row in np.lexsort(places.T[::-1]).tolist():
        pair = pairs[row]
        there = there | set(pair)
        if not tasks or len(tasks[-1]) == PAIRS_A_TASK or sum(weights[s] for s in there) > BYTES_A_TASK:
            tasks.append([])
            there = set(pair)
        tasks[-1].append(pair)
    return tasks
