"""Running one function over many inputs on a running Dask cluster.

Dask only carries tasks to other machines and back. There a :class:`LocalExecutor` runs them, so that time
limits, crashes and messages are the same everywhere, and a mesh that brings down native code does not bring down
the cluster's worker.
"""

from __future__ import annotations

import os
import queue
import time
import warnings
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import suppress
from functools import cache
from itertools import islice
from threading import Lock
from typing import Any

from shapeviz_report.errors import ClusterError, ConfigError
from shapeviz_report.executor.base import Outcome
from shapeviz_report.executor.local import LocalExecutor
from shapeviz_report.executor.memory import memory_share

ANSWER_TIME = 15.0
"""Seconds that a scheduler has to answer."""

PATIENCE = 60.0
"""Seconds to wait for a worker when a cluster has none."""

TASKS_A_THREAD = 2
"""Tasks that a thread of the cluster has at hand: one to do while the next is on its way."""

_GONE = (
    "The Dask scheduler has gone. What was computed is kept: start it and its workers again, then the same command "
    "continues."
)


class DaskExecutor:
    """The workers of a running Dask cluster. Use it as a context manager; the cluster outlives it.

    Parameters
    ----------
    address : str
        Of the scheduler, such as ``tcp://host:8786``.
    time_limit : float
        Seconds that one task may take before it is stopped.
    memory_limit : int or None
        Bytes of memory that one task may take; None for a core's share of what its machine has.
    fingerprint : callable
        Without arguments; returns a text that is the same here and on every worker that may take part.
    check : callable
        Without arguments; raises a :class:`ShapevizError` on a worker that lacks something. Both are called
        before a worker's first task.

    Raises
    ------
    ConfigError
        Dask is not installed.
    ClusterError
        The scheduler does not answer.
    """

    near = False

    def __init__(
        self,
        address: str,
        time_limit: float,
        memory_limit: int | None,
        fingerprint: Callable[[], str],
        check: Callable[[], Any],
    ) -> None:
        try:
            from distributed import Client
        except ImportError as error:
            raise ConfigError(
                "a Dask cluster needs Dask here as well: pip install 'shapeviz-report[dask]'"
            ) from error
        self.limits = (time_limit, memory_limit)
        self._expected = (fingerprint, fingerprint(), check)
        try:
            self._client = Client(address, timeout=ANSWER_TIME, set_as_default=False)
        except (OSError, ValueError, TypeError, MemoryError, ImportError) as error:
            # Dask says so of schemes that it knows and cannot use here; another service's answer is read as a size
            raise ClusterError(
                f"The Dask scheduler at {address!r} does not answer: {error}. Start one with 'dask scheduler', or "
                "leave out --scheduler to compute on this machine."
            ) from error

    def __enter__(self) -> DaskExecutor:
        return self

    def __exit__(self, *_: object) -> None:
        # What the scheduler's end leaves undone ends with the workers.
        with suppress(OSError, TimeoutError):
            if self._client.status == "running":
                self._client.run(_release, on_error="ignore")
        with suppress(OSError, TimeoutError):
            self._client.close()

    def run(
        self, function: Callable[..., Any], tasks: Iterable[tuple[Any, ...]], patience: float = 1.0
    ) -> Iterator[Outcome]:
        """See :meth:`Executor.run`.

        Raises
        ------
        ClusterError
            The cluster lost its scheduler or has had no worker for a minute, or a worker lacks something.
        """
        from distributed import KilledWorker
        from distributed.comm import CommClosedError

        waiting = enumerate(tasks)
        time_limit, memory_limit = self.limits
        limits = time_limit * patience, memory_limit
        done: queue.SimpleQueue[Any] = queue.SimpleQueue()
        running: dict[Any, int] = {}
        try:
            while True:
                room = TASKS_A_THREAD * self._threads() - len(running)
                for index, task in islice(waiting, max(0, room)):
                    with warnings.catch_warnings():
                        # Dask would have what is large scattered beforehand, where it is lost with a worker.
                        warnings.filterwarnings("ignore", message="Sending large graph")
                        future = self._client.submit(
                            _run_there, self._expected, limits, function, task, pure=False
                        )
                    running[future] = index
                    future.add_done_callback(done.put)
                if not running:
                    return
                future = self._next(done)
                index = running.pop(future)
                try:
                    outcome = future.result()
                except KilledWorker as error:
                    reason = (
                        f"{error.allowed_failures + 1} workers of the cluster ended while they worked on it"
                    )
                    yield Outcome(index, None, reason, 0.0)
                    continue
                except CancelledError as error:
                    raise ClusterError(_GONE) from error
                except ModuleNotFoundError as error:
                    if (error.name or "").partition(".")[0] != __package__.partition(".")[0]:
                        raise
                    raise ClusterError(
                        "A worker of the Dask cluster cannot import shapeviz_report. Install the same version of "
                        "shapeviz-report[dask] where the workers run."
                    ) from error
                yield Outcome(index, outcome.value, outcome.reason, outcome.cpu_seconds)
        except CommClosedError as error:
            raise ClusterError(_GONE) from error
        finally:
            with suppress(OSError):
                for future in running:
                    future.cancel()

    def _threads(self) -> int:
        """Threads that the cluster has now; waits for the first one."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            try:
                threads = sum(self._client.nthreads().values())
            except OSError as error:
                raise ClusterError(_GONE) from error
            if threads:
                return threads
            time.sleep(0.5)
        raise ClusterError(
            f"The Dask cluster has had no worker for {PATIENCE:g} seconds. What was computed is kept: start workers "
            "('dask worker ADDRESS'), then the same command continues."
        )

    def _next(self, done: queue.SimpleQueue[Any]) -> Any:
        """The next future that is done; meanwhile sees to it that there is somebody who works."""
        while True:
            try:
                return done.get(timeout=5.0)
            except queue.Empty:
                self._threads()


# One for each thread of this worker that has run a task, kept for the next one.
_idle: list[LocalExecutor] = []
_lock = Lock()
_checked: set[str] = set()


def _run_there(
    expected: tuple[Callable[[], str], str, Callable[[], Any]],
    limits: tuple[float, int | None],
    function: Callable[..., Any],
    task: tuple[Any, ...],
) -> Outcome:
    """Run one task in a process of its own on the machine of a cluster's worker."""
    time_limit, memory_limit = limits
    if memory_limit is None:
        memory_limit = _share()
    with _lock:
        executor = _idle.pop() if _idle else LocalExecutor(1, time_limit, memory_limit)
    executor.time_limit, executor.memory_limit = time_limit, memory_limit
    try:
        _check(executor, *expected)
        (outcome,) = executor.run(function, [task])
        return outcome
    finally:
        with _lock:
            _idle.append(executor)


@cache
def _share() -> int:
    """Bytes that one task may take on this machine, whose cores may belong to several workers of the cluster."""
    return memory_share(os.cpu_count() or 1)


def _check(
    executor: LocalExecutor, fingerprint: Callable[[], str], wanted: str, check: Callable[[], Any]
) -> None:
    """Refuse to work where the results would be others. Raises :class:`ClusterError`."""
    from distributed import get_worker

    if wanted in _checked:
        return
    address = get_worker().address
    (outcome,) = executor.run(fingerprint, [()])
    if outcome.value != wanted:
        raise ClusterError(
            f"The worker {address} has other versions of shapeviz-report, of its plug-ins or of its libraries than "
            "this machine, so its results would differ. Install the same ones on both, with the same constraints file."
        )
    (outcome,) = executor.run(check, [()])
    if outcome.reason is not None:
        raise ClusterError(f"The worker {address} cannot take part: {outcome.reason}")
    _checked.add(wanted)


def _release() -> None:
    """End the processes that wait for a next task."""
    with _lock:
        while _idle:
            _idle.pop().__exit__()
