"""How far a build is, and what it takes."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
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
