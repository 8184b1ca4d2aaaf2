"""Running one function over many inputs in worker processes of this machine, which may hang or crash.

A worker is a Python process of its own, started by command rather than forked: native code that brings it
down takes one task with it and nothing else, and a caller's script is not imported again.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from multiprocessing.connection import Pipe, wait
from typing import Any, cast

from shapeviz_report.errors import ShapevizError, WorkerError
from shapeviz_report.executor.base import Outcome
from shapeviz_report.executor.channel import Channel
from shapeviz_report.imports import trusted_path
from shapeviz_report.system import LACKING_MEMORY, PipeEnd, bound_memory, fate, start_process

MOST_PAUSED = 300.0
"""Seconds that a task may pause at a stretch."""


class LocalExecutor:
    """Worker processes on this machine, reused from call to call. Use it as a context manager.

    Parameters
    ----------
    jobs : int
        Number of processes.
    time_limit : float
        Seconds that one task may take before its worker is stopped, without those that it pauses for
        (:mod:`shapeviz_report.executor.pauses`).
    memory_limit : int
        Bytes of memory that one worker may take.
    """

    near = True

    def __init__(self, jobs: int, time_limit: float, memory_limit: int) -> None:
        self.jobs = jobs
        self.time_limit = time_limit
        self.memory_limit = memory_limit
        self._workers: list[_Worker] = []

    def __enter__(self) -> LocalExecutor:
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self._workers:
            worker.stop()
        self._workers.clear()

    def run(
        self, function: Callable[..., Any], tasks: Iterable[tuple[Any, ...]], patience: float = 1.0
    ) -> Iterator[Outcome]:
        """See :meth:`Executor.run`."""
        # no `enumerate`, which holds the last of them while the next is made: a task may be a gigabyte
        waiting, count = iter(tasks), 0
        limit = self.time_limit * patience
        idle = list(self._workers)
        busy: dict[PipeEnd, tuple[_Worker, int, float]] = {}
        paused: dict[PipeEnd, float] = {}
        try:
            while True:
                while len(busy) < self.jobs and (task := next(waiting, None)) is not None:
                    worker = self._send((function, task), idle)
                    del task
                    busy[worker.connection] = (worker, count, time.monotonic() + limit)
                    count += 1
                if not busy:
                    return
                soonest = min(deadline for _, _, deadline in busy.values())
                ready = cast("list[PipeEnd]", wait(list(busy), timeout=max(0.0, soonest - time.monotonic())))
                now = time.monotonic()
                late = [c for c, (_, _, deadline) in busy.items() if deadline <= now and c not in ready]
                for connection in [*ready, *late]:
                    worker, index, deadline = busy.pop(connection)
                    left = paused.pop(connection, limit)
                    if connection in late:
                        worker.stop()
                        self._workers.remove(worker)
                        reason = f"it took longer than {limit:g} seconds; a larger time_limit may help"
                        yield Outcome(index, None, reason, 0.0)
                        continue
                    try:
                        answer: bool | tuple[Any, BaseException | None, float] = connection.recv()
                    except (EOFError, ConnectionError):
                        worker.stop()
                        self._workers.remove(worker)
                        reason = f"the process working on it ended ({worker.fate})"
                        if worker.process.returncode in LACKING_MEMORY:
                            reason += f", perhaps for want of memory: {self._advice}"
                        yield Outcome(index, None, reason, 0.0)
                        continue
                    if isinstance(answer, bool):
                        if answer:
                            paused[connection] = deadline - now
                        busy[connection] = (worker, index, now + (MOST_PAUSED if answer else left))
                        continue
                    value, error, cpu = answer
                    if isinstance(error, MemoryError):
                        # What native code left undone when it got no memory is not for the next task.
                        worker.stop()
                        self._workers.remove(worker)
                        yield Outcome(
                            index, None, f"it needs more memory than there is for it: {self._advice}", cpu
                        )
                        continue
                    idle.append(worker)
                    if isinstance(error, ShapevizError):
                        yield Outcome(index, None, str(error), cpu)
                    elif isinstance(error, OSError) and error.errno is not None:
                        # A task comes with all it needs: what cannot be opened or written is of the machine.
                        raise WorkerError(
                            f"A worker process cannot go on: {error.strerror}. What was computed is kept; see to the "
                            "machine (room on its disks, open files), and run the same command again."
                        ) from error
                    elif error is not None:
                        raise error
                    else:
                        yield Outcome(index, value, None, cpu)
        finally:
            # A caller that stops half-way must not find old answers in the pipes next time.
            for worker, _, _ in busy.values():
                worker.stop()
                self._workers.remove(worker)

    @property
    def _advice(self) -> str:
        return (
            f"one process may take {self.memory_limit / 2**30:.1f} GiB; simplify the mesh, or allow more with "
            "--memory-limit, on a full machine with fewer --jobs"
        )

    def _send(self, message: tuple[Any, ...], idle: list[_Worker]) -> _Worker:
        """Give a task to an idle worker, or to a new one."""
        while idle:
            worker = idle.pop()
            bound_memory(worker.process.pid, self.memory_limit)
            try:
                worker.send(message)
                return worker
            except ConnectionError:
                # It was killed while it had nothing to do, which is no fault of this task.
                worker.stop()
                self._workers.remove(worker)
        worker = _Worker()
        self._workers.append(worker)
        bound_memory(worker.process.pid, self.memory_limit)
        # If it ended or refused before it had read all, its answer or its end says so.
        with suppress(ConnectionError):
            worker.send(message)
        return worker


class _Worker:
    """One process and the pipe to it."""

    def __init__(self) -> None:
        self.connection, theirs = Pipe()
        with theirs:
            # The same modules as here, whatever put them on the path, but none of the current folder; one thread
            # each, for there is one process a core.
            environment = os.environ | {"PYTHONPATH": os.pathsep.join(trusted_path()), "PYTHONSAFEPATH": "1"}
            for variable in (
                "OMP_NUM_THREADS",
                "OPENBLAS_NUM_THREADS",
                "MKL_NUM_THREADS",
                "NUMBA_NUM_THREADS",
            ):
                environment[variable] = "1"
            try:
                # Standard input is its lifeline: it closes when this process ends, however that comes.
                self.process = start_process(
                    [sys.executable, "-P", "-m", "shapeviz_report.executor.worker"],
                    theirs,
                    env=environment,
                    # numba obeys a file of the current folder, and no task needs one of it
                    cwd=os.path.dirname(os.path.abspath(__file__)),
                    stdin=subprocess.PIPE,
                    stdout=subprocess.DEVNULL,
                )
            except OSError as error:
                self.connection.close()
                raise WorkerError(
                    f"A worker process cannot be started: {error.strerror}. End other programs, or use fewer --jobs."
                ) from error
        self._tasks = Channel(self.connection)

    def send(self, message: tuple[Any, ...]) -> None:
        """Send a task."""
        self._tasks.send(message)

    @property
    def fate(self) -> str:
        """How the process ended."""
        return fate(self.process.returncode)

    def stop(self) -> None:
        """End the process."""
        self.connection.close()
        try:
            # An idle worker sees the closed pipe and goes.
            self.process.wait(timeout=0.2)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        assert self.process.stdin is not None
        self.process.stdin.close()
