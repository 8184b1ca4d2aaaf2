"""Which workers of a cluster may take part."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import CancelledError, Future
from math import inf
from typing import Any

from shapeviz_report.errors import ShapevizError
from shapeviz_report.executor.base import Outcome

VETTINGS = 3
"""Times that a worker is asked what it is before one that cannot say it, as without memory for a moment, is refused."""

VETTING_PAUSE = 5.0
"""Seconds until it is asked for the second time. Each pause is twice the one before, and a refused one is asked on."""

MOST_NAMED = 4
"""Differences of a worker that are named."""


class Vetting:
    """What is known of the workers of a cluster.

    Parameters
    ----------
    expected : mapping of str to str
        The versions that a worker must have.
    ask : callable
        Asks a worker, by its address, for an :class:`Outcome` by its address: the versions that it has, or why it
        cannot take part.

    Attributes
    ----------
    asked : dict of str to Future
        Answers that are on their way.
    accepted : set of str
    refused : dict of str to str
        Why, in a sentence.
    """

    def __init__(self, expected: Mapping[str, str], ask: Callable[[str], Future[dict[str, Any]]]) -> None:
        self._expected = expected
        self._ask = ask
        self.asked: dict[str, Future[dict[str, Any]]] = {}
        self.accepted: set[str] = set()
        self.refused: dict[str, str] = {}
        self._failed: Counter[str] = Counter()
        self._due: dict[str, float] = {}

    def vet(self, workers: Iterable[str]) -> bool:
        """Ask those workers that are new what they are, and hear what others answered; whether one has yet to answer.

        They are asked before they get a task: one without our package would end at that, and Dask counts such an end
        against the task.
        """
        pending = False
        for worker in workers:
            if worker in self.accepted:
                continue
            if self._due.get(worker, 0.0) > time.monotonic():
                pending = pending or worker not in self.refused
                continue
            if worker not in self.asked:
                self.asked[worker] = self._ask(worker)
            if self.asked[worker].done():
                self._judge(worker, self.asked.pop(worker))
            pending = pending or worker not in self.accepted | self.refused.keys()
        return pending

    def _judge(self, worker: str, answer: Future[dict[str, Any]]) -> None:
        """Accept or refuse a worker; one that went meanwhile, or fails for what may pass, is asked again later."""
        try:
            told = answer.result()[worker]
        except (OSError, LookupError, CancelledError):
            return
        if not isinstance(told, Exception) and told.reason is None and told.value == self._expected:
            self.refused.pop(worker, None)
            self.accepted.add(worker)
            return
        if isinstance(told, OSError | ShapevizError) or (isinstance(told, Outcome) and told.reason):
            self._failed[worker] += 1
            self._due[worker] = time.monotonic() + VETTING_PAUSE * 2 ** (self._failed[worker] - 1)
            if self._failed[worker] < VETTINGS:
                return
            why = f"cannot take part: {told.reason if isinstance(told, Outcome) else told}"
        elif isinstance(told, Exception):
            self._due[worker] = inf
            why = (
                f"has not this version of shapeviz-report ({told}). Install shapeviz-report[dask] there as it is here, "
                "with the same constraints file, and start it again."
            )
        else:
            self._due[worker] = inf
            why = (
                "has other versions of shapeviz-report, of its plug-ins or of its libraries than this machine, so its "
                f"results would differ: {_differences(told.value, self._expected)}. Install the same ones on both, "
                "with the same constraints file, and start it again."
            )
        self.refused[worker] = f"The worker {worker} {why}"


def _differences(there: Mapping[str, str], here: Mapping[str, str]) -> str:
    """What differs, in words."""
    found = [
        f"{name} {there.get(name, 'is missing')} (here {here.get(name, 'it is missing')})"
        for name in [*here, *sorted(there.keys() - here.keys())]
        if there.get(name) != here.get(name)
    ]
    more = len(found) - MOST_NAMED
    return ", ".join(found[:MOST_NAMED]) + (f" and {more} more" if more > 0 else "")
