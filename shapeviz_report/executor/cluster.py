"""Running one function over many inputs on a running Dask cluster.

Dask only carries tasks to other machines and back. There a :class:`LocalExecutor` runs them, so that time
limits, crashes and messages are the same everywhere, and a mesh that brings down native code does not bring down
the cluster's worker.
"""

from __future__ import annotations

import asyncio
import logging
import os
import queue
import time
import warnings
from collections import Counter
from collections.abc import Callable, Coroutine, Iterable, Iterator, Mapping
from concurrent.futures import CancelledError, Future
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import islice
from threading import Lock, Thread
from typing import Any

from shapeviz_report.errors import ClusterError, ConfigError
from shapeviz_report.executor.base import Outcome
from shapeviz_report.executor.local import LocalExecutor
from shapeviz_report.executor.memory import memory_share
from shapeviz_report.executor.vetting import Vetting

logger = logging.getLogger(__name__)

ANSWER_TIME = 15.0
"""Seconds that a scheduler has to answer at the beginning, and the workers at the end."""

PARTING_TIME = 2.0
"""The same at an end that somebody waits for, or that a failure brings."""

STARTING_TIME = 300.0
"""Seconds in which a worker can say what it is, though it may have to compile first."""

SILENCE = 30.0
"""Seconds without an answer of the scheduler after which the build says so. It waits on."""

PATIENCE = 60.0
"""Seconds to wait for a worker when a cluster has none."""

TASKS_A_THREAD = 2
"""Tasks that a thread of the cluster has at hand: one to do while the next is on its way."""

LOOK_AGAIN = 5.0
"""Seconds without an answer until somebody looks what the workers do."""

LATE = 4.0
"""A task is late after so many times what the slowest one took, when no other one waits."""

LOSSES = 3
"""Times that all workers which may have a task may end with it, as Dask has it of single ones."""

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
        Without arguments; returns versions by name, the same ones here and on every worker that may take part.
    check : callable
        Without arguments; raises a :class:`ShapevizError` on a worker that lacks something. Both are called
        before a worker's first task. One that may not take part is told of once, and gets none.

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
        fingerprint: Callable[[], Mapping[str, str]],
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
        self._address = address
        self._told: set[str] = set()
        self._vetting = Vetting(fingerprint(), partial(self._inquire, fingerprint, check))
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

    def __exit__(
        self,
        kind: type[BaseException] | None = None,
        error: BaseException | None = None,
        trace: object = None,
    ) -> None:
        # What the scheduler's end leaves undone ends with the workers; a frozen one, or a frozen worker, never answers.
        patience = ANSWER_TIME if kind is None else PARTING_TIME
        for answer in self._vetting.asked.values():
            answer.cancel()
        with suppress(OSError, TimeoutError):
            if self._client.status == "running":
                self._client.run(_release, on_error="ignore", callback_timeout=patience)
        with suppress(OSError, TimeoutError):
            self._client.close(timeout=patience)

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
        from distributed.client import ClosedClientError
        from distributed.comm import CommClosedError

        waiting = enumerate(tasks)
        time_limit, memory_limit = self.limits
        limits = time_limit * patience, memory_limit
        done: queue.SimpleQueue[Any] = queue.SimpleQueue()
        running: dict[Any, _Sent] = {}
        coming: dict[Any, Future[dict[str, Any]]] = {}
        longest: float | None = None

        def send(index: int, task: tuple[Any, ...], workers: Iterable[str], lost: int = 0) -> _Sent:
            sent = _Sent(index, task, time.monotonic(), tuple(workers), lost)
            with warnings.catch_warnings():
                # Dask would have what is large scattered beforehand, where it is lost with a worker.
                warnings.filterwarnings("ignore", message="Sending large graph")
                future = self._client.submit(
                    _run_there, limits, function, task, pure=False, workers=sent.workers
                )
            running[future] = sent
            future.add_done_callback(done.put)
            return sent

        def twins(index: int) -> list[Any]:
            return [future for future, sent in running.items() if sent.index == index]

        def fetch(future: Any) -> None:
            # Nobody waits for one result: it may be that of a worker which is frozen.
            coming[future] = self._begin(self._client.scheduler.gather(keys=[future.key]))
            coming[future].add_done_callback(lambda _: done.put(future))

        def forget(future: Any) -> None:
            del running[future]
            if future in coming:
                coming.pop(future).cancel()
            future.cancel()

        try:
            while True:
                threads = self._threads()
                for future, sent in list(running.items()):
                    # Dask would wait for one of just these to come back.
                    if threads.keys().isdisjoint(sent.workers):
                        forget(future)
                        if sent.lost == LOSSES:
                            yield _fatal(sent.index, LOSSES + 1)
                        else:
                            send(sent.index, sent.task, threads, sent.lost + 1)
                room = TASKS_A_THREAD * sum(threads.values()) - len(running)
                for index, task in islice(waiting, max(0, room)):
                    send(index, task, threads)
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
                if future.status == "finished" and future not in coming:
                    fetch(future)
                    continue
                sent = running.pop(future)
                index = sent.index
                longest = max(longest or 0.0, time.monotonic() - sent.begun)
                try:
                    outcome = _taken(future, coming.pop(future, None))
                except KilledWorker as error:
                    outcome = _fatal(index, error.allowed_failures + 1)
                except (CancelledError, OSError):
                    # A connection that was lost, as to a scheduler frozen for long, takes all tasks with it; a worker
                    # that goes takes its results.
                    self._reconnect()
                    if not twins(index):
                        send(index, sent.task, self._threads(), sent.lost)
                    continue
                for twin in twins(index):
                    forget(twin)
                yield replace(outcome, index=index)
        except (CommClosedError, ClosedClientError) as error:
            raise ClusterError(_GONE) from error
        finally:
            with suppress(OSError, ClosedClientError):
                for future in list(running):
                    forget(future)

    def _threads(self) -> dict[str, int]:
        """The workers that may be used now, with their threads; waits for the first one."""
        end = time.monotonic() + PATIENCE
        while True:
            found: dict[str, int] = self._ask("ncores", workers=None)
            pending = self._vetting.vet(found)
            threads = {worker: count for worker, count in found.items() if worker in self._vetting.accepted}
            if sum(threads.values()):
                for worker in self._vetting.refused.keys() - self._told:
                    self._told.add(worker)
                    logger.warning("%s Meanwhile it is not used.", self._vetting.refused[worker])
                return threads
            if pending:
                end = time.monotonic() + PATIENCE
            else:
                late = time.monotonic() >= end
                refusals = [why for worker, why in self._vetting.refused.items() if worker in found]
                if refusals and (late or not self._vetting.accepted):
                    raise ClusterError(refusals[0])
                if late:
                    raise ClusterError(
                        f"The Dask cluster has had no worker for {PATIENCE:g} seconds. What was computed is kept: "
                        "start workers ('dask worker ADDRESS'), then the same command continues."
                    )
            time.sleep(0.1 if pending else 0.5)

    def _inquire(
        self, fingerprint: Callable[[], Mapping[str, str]], check: Callable[[], Any], worker: str
    ) -> Future[dict[str, Any]]:
        """Ask a worker what it is, without waiting for it."""
        return self._begin(
            self._client.run(
                _tell,
                fingerprint,
                check,
                self.limits[1],
                workers=[worker],
                on_error="return",
                asynchronous=True,
            )
        )

    def _begin(self, asking: Coroutine[Any, Any, Any]) -> Future[Any]:
        """Ask something without waiting for it."""
        return asyncio.run_coroutine_threadsafe(asking, self._client.loop.asyncio_loop)

    def _reconnect(self) -> None:
        """Wait until the client has its connection again, which it sees to; the scheduler has gone if it gives up."""
        time.sleep(0.5)
        while self._client.status == "connecting":
            time.sleep(0.1)
        if self._client.status != "running":
            raise ClusterError(_GONE)

    def _ask(self, question: str, **about: Any) -> Any:
        """What the scheduler answers. Waits for it; where that is long, the user is told, once."""
        silent = 0
        while True:
            try:
                answer = self._client.sync(
                    getattr(self._client.scheduler, question), callback_timeout=SILENCE, **about
                )
            except TimeoutError:
                silent += 1
            except OSError:
                self._reconnect()
                continue
            else:
                if silent:
                    logger.warning("The Dask scheduler at %s answers again.", self._address)
                return answer
            if silent == 1:
                logger.warning(
                    "The Dask scheduler at %s has not answered for %g seconds. The build waits for it: see whether its "
                    "process is stopped and whether this machine still reaches it. Ctrl-C ends the build; what was "
                    "computed is kept.",
                    self._address,
                    SILENCE,
                )

    def _late(self, running: dict[Any, _Sent], after: float) -> list[tuple[_Sent, list[str]]]:
        """Tasks that were sent once and longer ago than so many seconds, and workers with neither them nor a result."""
        now = time.monotonic()
        times = Counter(sent.index for sent in running.values())
        late = {f.key: s for f, s in running.items() if now - s.begun > after and times[s.index] == 1}
        if not late:
            return []
        workers = {
            worker: keys
            for worker, keys in self._ask("processing", workers=None).items()
            if worker in self._vetting.accepted
        }
        holders = self._ask("who_has", keys=list(late))
        found = []
        for key, sent in late.items():
            others = [
                worker for worker, keys in workers.items() if key not in keys and worker not in holders[key]
            ]
            if 0 < len(others) < len(workers):
                found.append((sent, others))
        return found


def _taken(future: Any, answer: Future[dict[str, Any]] | None) -> Outcome:
    """The outcome that was fetched; the task's error, or CancelledError where its result is lost."""
    if answer is None:
        if future.status == "error":
            future.result()
        raise CancelledError
    told = answer.result()
    if told["status"] != "OK":
        raise CancelledError
    return told["data"][future.key]


def _connect(client_class: Any, address: str) -> Any:
    """A Dask client of a scheduler; one that does not come about is closed, or Python's end waits for it."""
    client = client_class.__new__(client_class)
    failed: list[BaseException] = []

    def begin() -> None:
        try:
            client.__init__(address, timeout=ANSWER_TIME, set_as_default=False)
        except BaseException as error:
            failed.append(error)

    # Dask's own limit does not hold for a scheduler that takes a connection and then says nothing.
    beginning = Thread(target=begin, daemon=True)
    try:
        beginning.start()
        beginning.join(2 * ANSWER_TIME)
        if beginning.is_alive():
            raise TimeoutError(f"it takes connections and says nothing for {2 * ANSWER_TIME:g} seconds")
        if failed:
            raise failed[0]
    except BaseException:
        with suppress(OSError):
            client.close(timeout=PARTING_TIME)
        raise
    return client


@dataclass(frozen=True)
class _Sent:
    """A task on its way, when it left, the workers it may go to, and how often all such have ended with it."""

    index: int
    task: tuple[Any, ...]
    begun: float
    workers: tuple[str, ...]
    lost: int


def _fatal(index: int, workers: int) -> Outcome:
    """That of a task which brings workers down."""
    return Outcome(index, None, f"{workers} workers of the cluster ended while they worked on it", 0.0)


# One for each thread of this worker that has run a task, kept for the next one.
_idle: list[LocalExecutor] = []
_lock = Lock()
_releases = 0


def _run_there(
    limits: tuple[float, int | None], function: Callable[..., Any], task: tuple[Any, ...]
) -> Outcome:
    """Run one task in a process of its own on the machine of a cluster's worker."""
    with _kept_executor(*limits) as executor:
        (outcome,) = executor.run(function, [task])
        return outcome


async def _tell(
    fingerprint: Callable[[], Mapping[str, str]],
    check: Callable[[], Any],
    memory_limit: int | None,
) -> Outcome:
    """The versions that a worker has, or why it cannot take part."""

    def find() -> Outcome:
        with _kept_executor(STARTING_TIME, memory_limit) as executor:
            (versions,) = executor.run(fingerprint, [()])
            (checked,) = executor.run(check, [()])
            return replace(versions, reason=versions.reason or checked.reason)

    return await asyncio.to_thread(find)


@contextmanager
def _kept_executor(time_limit: float, memory_limit: int | None) -> Iterator[LocalExecutor]:
    """A process for a task, which waits for the next one unless its build has ended meanwhile."""
    if memory_limit is None:
        memory_limit = _share()
    with _lock:
        executor = _idle.pop() if _idle else LocalExecutor(1, time_limit, memory_limit)
        releases = _releases
    executor.time_limit, executor.memory_limit = time_limit, memory_limit
    try:
        yield executor
    finally:
        with _lock:
            if releases == _releases:
                _idle.append(executor)
            else:
                executor.__exit__()


@cache
def _share() -> int:
    """Bytes that one task may take on this machine, whose cores may belong to several workers of the cluster."""
    return memory_share(os.cpu_count() or 1)


def _release() -> None:
    """End the processes that wait for a next task, and those at work when they are done."""
    global _releases
    with _lock:
        _releases += 1
        while _idle:
            _idle.pop().__exit__()
