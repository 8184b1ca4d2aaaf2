"""Running one function over many inputs in worker processes that may hang or crash.

A worker is a Python process of its own, started by command rather than forked: native code that brings it
down takes one task with it and nothing else, and a caller's script is not imported again.
"""

from __future__ import annotations

import os
import pickle
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Any, Protocol

from shapeviz_report.errors import ShapevizError


@dataclass(frozen=True)
class Outcome:
    """What became of one task.

    Attributes
    ----------
    index : int
        Its place among the inputs.
    value : object
        What the function returned; None if ``reason`` is set.
    reason : str or None
        Why there is no value, in words for the owner of the input.
    cpu_seconds : float
        CPU time that its worker spent since the task before, start-up included; 0 if the worker did not live
        to tell.
    """

    index: int
    value: Any
    reason: str | None
    cpu_seconds: float


class Executor(Protocol):
    """Something that runs tasks: local processes here."""

    def run(self, function: Callable[..., Any], tasks: Sequence[tuple[Any, ...]]) -> Iterator[Outcome]:
        """Call ``function(*task)`` for each task; outcomes as they come, in any order.

        ``function`` must be importable by name. A :class:`ShapevizError` that it raises, a crash and a task
        over the time limit become outcomes with a reason; any other exception is a bug and is raised here.
        """
        ...


class LocalExecutor:
    """Worker processes on this machine, reused from call to call. Use it as a context manager.

    Parameters
    ----------
    jobs : int
        Number of processes.
    time_limit : float
        Seconds that one task may take before its worker is stopped.
    """

    def __init__(self, jobs: int, time_limit: float) -> None:
        self.jobs = jobs
        self.time_limit = time_limit
        self._workers: list[_Worker] = []

    def __enter__(self) -> LocalExecutor:
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self._workers:
            worker.stop()
        self._workers.clear()

    def run(self, function: Callable[..., Any], tasks: Sequence[tuple[Any, ...]]) -> Iterator[Outcome]:
        """See :meth:`Executor.run`."""
        waiting = iter(range(len(tasks)))
        idle = list(self._workers)
        busy: dict[Connection, tuple[_Worker, int, float]] = {}
        try:
            while True:
                while len(busy) < self.jobs and (index := next(waiting, None)) is not None:
                    worker = idle.pop() if idle else self._start()
                    worker.connection.send((function, tasks[index]))
                    busy[worker.connection] = (worker, index, time.monotonic() + self.time_limit)
                if not busy:
                    return
                soonest = min(deadline for _, _, deadline in busy.values())
                ready = wait(list(busy), timeout=max(0.0, soonest - time.monotonic()))
                now = time.monotonic()
                late = [c for c, (_, _, deadline) in busy.items() if deadline <= now and c not in ready]
                for connection in [*ready, *late]:
                    worker, index, _ = busy.pop(connection)
                    if connection in late:
                        worker.stop()
                        self._workers.remove(worker)
                        yield Outcome(index, None, f"it took longer than {self.time_limit:g} seconds", 0.0)
                        continue
                    try:
                        value, error, cpu = connection.recv()
                    except (EOFError, ConnectionError):
                        worker.stop()
                        self._workers.remove(worker)
                        yield Outcome(index, None, f"the process working on it ended ({worker.fate})", 0.0)
                        continue
                    idle.append(worker)
                    if isinstance(error, ShapevizError):
                        yield Outcome(index, None, str(error), cpu)
                    elif error is not None:
                        raise error
                    else:
                        yield Outcome(index, value, None, cpu)
        finally:
            # A caller that stops half-way must not find old answers in the pipes next time.
            for worker, _, _ in busy.values():
                worker.stop()
                self._workers.remove(worker)

    def _start(self) -> _Worker:
        worker = _Worker()
        self._workers.append(worker)
        return worker


class _Worker:
    """One process and the pipe to it."""

    def __init__(self) -> None:
        ours, theirs = socket.socketpair()
        with theirs:
            # The same modules as here, whatever put them on the path; one thread each, for there is one
            # process a core.
            environment = os.environ | {"PYTHONPATH": os.pathsep.join(p or os.getcwd() for p in sys.path)}
            for variable in (
                "OMP_NUM_THREADS",
                "OPENBLAS_NUM_THREADS",
                "MKL_NUM_THREADS",
                "NUMBA_NUM_THREADS",
            ):
                environment[variable] = "1"
            self.process = subprocess.Popen(
                [sys.executable, "-m", "shapeviz_report.executor", str(theirs.fileno())],
                pass_fds=[theirs.fileno()],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
            )
        self.connection = Connection(ours.detach())

    @property
    def fate(self) -> str:
        """How the process ended."""
        code = self.process.returncode
        if code is not None and code < 0:
            return f"signal {-code}" + (", out of memory?" if code == -9 else "")
        return f"exit code {code}"

    def stop(self) -> None:
        """End the process."""
        self.connection.close()
        try:
            # An idle worker sees the closed pipe and goes.
            self.process.wait(timeout=0.2)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


def _serve(descriptor: int) -> None:
    """The life of a worker: take a task, answer with (value, error, CPU seconds), until the pipe closes."""
    import signal

    # Ctrl-C reaches every process of the terminal; the parent alone decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    connection = Connection(descriptor)
    reported = 0.0
    while True:
        try:
            function, task = connection.recv()
        except (EOFError, ConnectionError):
            return
        value, error = None, None
        try:
            value = function(*task)
        except Exception as exception:
            error = _portable(exception)
        spent = time.process_time()
        try:
            connection.send((value, error, spent - reported))
        except ConnectionError:
            return
        reported = spent


def _portable(exception: Exception) -> Exception:
    """An exception as it can travel, with its traceback as a note."""
    import traceback

    if not isinstance(exception, ShapevizError):
        exception.add_note("".join(traceback.format_exception(exception)))
    try:
        pickle.loads(pickle.dumps(exception))
    except Exception:
        return RuntimeError("".join(traceback.format_exception(exception)))
    return exception


if __name__ == "__main__":
    _serve(int(sys.argv[1]))
