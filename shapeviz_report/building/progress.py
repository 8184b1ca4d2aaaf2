"""How far a build is, and what it takes."""

from __future__ import annotations

import logging
import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from typing import Protocol

logger = logging.getLogger(__name__)


class Progress(Protocol):
    """Told how far a build is."""

    def stage(self, doing: str, total: int) -> AbstractContextManager[Callable[[], None]]:
        """Enter a stage, told in words, of ``total`` steps (0: unknown); the function it gives is called after each."""
        ...


class QuietProgress:
    """Progress as log records: one when a stage begins."""

    @contextmanager
    def stage(self, doing: str, total: int) -> Iterator[Callable[[], None]]:
        """See :class:`Progress`."""
        logger.info("%s (%d)", doing, total) if total else logger.info("%s", doing)
        yield lambda: None


class TimeLeft:
    """How long the rest of a stage takes, if it goes on as it went of late.

    The time before the first step counts for nothing: workers start and compile in it. What goes on as it went is the
    last tenth of the time, so that steps which were kept by an earlier build, and take none, soon tell nothing of
    those to come; at least ``WINDOW`` seconds, and at least ``LEAST`` steps, before which nothing is said.

    Parameters
    ----------
    total : int
        Steps of the stage.
    """

    WINDOW = 20.0
    LEAST = 8

    def __init__(self, total: int) -> None:
        self._left = total
        self._done: deque[float] = deque()
        self._first: float | None = None

    def step(self, now: float) -> None:
        """One is done, at a time in seconds."""
        self._left -= 1
        self._done.append(now)
        if self._first is None:
            self._first = now
        window = max(self.WINDOW, (now - self._first) / 10)
        while len(self._done) > self.LEAST + 1 and self._done[1] < now - window:
            self._done.popleft()

    def estimate(self, now: float) -> float | None:
        """Seconds; None while that cannot be told."""
        if self._left == 0:
            return 0.0
        steps, since = len(self._done) - 1, now - self._done[0] if self._done else 0.0
        if steps < self.LEAST or since < self.WINDOW / 4:
            return None
        return self._left * since / steps


def in_words(seconds: float) -> str:
    """A time as one would say it: to ten seconds, to a minute, or to half an hour above three."""
    if seconds < 90:
        return f"{max(10, round(seconds, -1)):.0f} s"
    if seconds < 3 * 3600:
        return f"{seconds / 60:.0f} min"
    return f"{round(seconds / 1800) / 2:g} h"


@dataclass
class Clock:
    """Wall-clock and CPU seconds a stage, in order of the stages."""

    progress: Progress
    seconds: dict[str, float] = field(default_factory=dict)
    cpu_seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, doing: str, total: int = 0) -> Iterator[Callable[[float], None]]:
        """Time a stage; the function it gives takes the CPU seconds of a worker, once for each step done."""
        wall, cpu, workers = time.perf_counter(), time.process_time(), 0.0
        with self.progress.stage(doing, total) as advance:

            def step(worker_cpu: float) -> None:
                nonlocal workers
                workers += worker_cpu
                advance()

            yield step
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - wall
        spent = time.process_time() - cpu + workers
        self.cpu_seconds[name] = self.cpu_seconds.get(name, 0.0) + spent

    @contextmanager
    def stages(
        self, names: Sequence[str], doing: str, total: int
    ) -> Iterator[Callable[[Mapping[str, float]], None]]:
        """Time several stages that are done together; the function it gives takes a worker's CPU seconds by stage.

        The time on the wall is shared out as the CPU seconds are.
        """
        wall, cpu = time.perf_counter(), time.process_time()
        workers = dict.fromkeys(names, 0.0)
        with self.progress.stage(doing, total) as advance:

            def step(worker_cpu: Mapping[str, float]) -> None:
                for name, seconds in worker_cpu.items():
                    workers[name] = workers.get(name, 0.0) + seconds
                advance()

            yield step
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        together = sum(workers.values())
        for name, seconds in workers.items():
            share = seconds / together if together else 1 / len(workers)
            self.seconds[name] = self.seconds.get(name, 0.0) + wall * share
            self.cpu_seconds[name] = self.cpu_seconds.get(name, 0.0) + seconds + cpu * share
