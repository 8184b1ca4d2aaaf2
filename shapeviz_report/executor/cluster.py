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
from dataclasses import dataclass
from functools import cache
from itertools import islice
from threading import Lock
from typing import Any

from shapeviz_report.errors import ClusterError, ConfigError
from shapeviz_report.executor.base import Outcome
from shapeviz_report.executor.local import LocalExecutor
from shapeviz_report.executor.memory import memory_share

ANSWER_TIME = 15.0
"""Seconds that a scheduler has to answer at the beginning, and the workers at the end."""

PATIENCE = 60.0
"""Seconds to wait for a worker when a cluster has none."""

TASKS_A_THREAD = 2
"""Tasks that a thread of the cluster has at hand: one to do while the next is on its way."""

LOOK_AGAIN = 5.0
"""Seconds without an answer until somebody looks what the workers do."""

LATE = 4.0
"""A task is late after so many times what the slowest one took, when no other one waits."""

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
            import dask
            from distributed import Client
        except ImportError as error:
            raise ConfigError(
                "a Dask cluster needs Dask here as well: pip install 'shapeviz-report[dask]'"
            ) from error
        self.limits = (time_limit, memory_limit)
        self._expected = (fingerprint, fingerprint(), check)
        try:
            # A client keeps its last messages for developers, a thousand of up to a megabyte: ours hold mesh files.
            with dask.config.set({"distributed.admin.low-level-log-length": 0}):
                self._client = _connect(Client, address)
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
                # a frozen worker never answers
                self._client.run(_release, on_error="ignore", callback_timeout=ANSWER_TIME)
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
        running: dict[Any, _Sent] = {}
        longest: float | None = None

        def send(index: int, task: tuple[Any, ...], workers: list[str] | None = None) -> None:
            with warnings.catch_warnings():
                # Dask would have what is large scattered beforehand, where it is lost with a worker.
                warnings.filterwarnings("ignore", message="Sending large graph")
                future = self._client.submit(
                    _run_there, self._expected, limits, function, task, pure=False, workers=workers
                )
            running[future] = _Sent(index, task, time.monotonic(), second=workers is not None)
            future.add_done_callback(done.put)

        try:
            while True:
                room = TASKS_A_THREAD * self._threads() - len(running)
                for index, task in islice(waiting, max(0, room)):
                    send(index, task)
                    room -= 1
                if not running:
                    return
                try:
                    future = done.get(timeout=LOOK_AGAIN)
                except queue.Empty:
                    # With room left no task waits: threads that have nothing else to do take over what is late.
                    if room > 0 and longest is not None:
                        for late, others in self._late(running, LATE * longest)[:room]:
                            send(late.index, late.task, others)
                    continue
                if future not in running:
                    continue
                sent = running.pop(future)
                index = sent.index
                longest = max(longest or 0.0, time.monotonic() - sent.begun)
                for other in [other for other, same in running.items() if same.index == index]:
                    del running[other]
                    other.cancel()
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

    def _late(self, running: dict[Any, _Sent], after: float) -> list[tuple[_Sent, list[str]]]:
        """Tasks that were sent once and longer ago than so many seconds, and the workers that do not have them."""
        now = time.monotonic()
        twice = {sent.index for sent in running.values() if sent.second}
        late = {f.key: s for f, s in running.items() if now - s.begun > after and s.index not in twice}
        if not late:
            return []
        workers = self._client.processing()
        found = []
        for key, sent in late.items():
            others = [worker for worker, keys in workers.items() if key not in keys]
            if 0 < len(others) < len(workers):
                found.append((sent, others))
        return found


def _connect(client_class: Any, address: str) -> Any:
    """A Dask client of a scheduler; one that does not come about is closed, or Python's end waits for it."""
    client = client_class.__new__(client_class)
    try:
        client.__init__(address, timeout=ANSWER_TIME, set_as_default=False)
    except BaseException:
        with suppress(OSError):
            client.close()
        raise
    return client


@dataclass(frozen=True)
class _Sent:
    """A task on its way, when it left, and whether another worker has it already."""

    index: int
    task: tuple[Any, ...]
    begun: float
    second: bool


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
