"""Runs stages: what is kept is taken from the cache, the rest is computed by the executor and kept."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from shapeviz_report.building.progress import Clock
from shapeviz_report.building.stages import Stage
from shapeviz_report.building.workers import open_workers
from shapeviz_report.cache import Cache
from shapeviz_report.config import Config
from shapeviz_report.errors import DatabaseError, MeshError
from shapeviz_report.executor import Executor
from shapeviz_report.types import Database, Failure, ShapeEntry

Name = TypeVar("Name", bound=Hashable)


@dataclass(frozen=True)
class Task:
    """What a stage has to do for one shape or question.

    Attributes
    ----------
    key : str
        Of the result, in the cache.
    arguments : callable
        Gives the arguments of the stage's function; called only if there is no result yet.
    """

    key: str
    arguments: Callable[[], tuple[Any, ...]]

    @classmethod
    def of(cls, key: str, *arguments: Any) -> Task:
        """One whose arguments are at hand."""
        return cls(key, lambda: arguments)


@dataclass(frozen=True)
class Result:
    """What a stage found for one shape, and the key under which the cache has it."""

    key: str
    value: Any


class Runner:
    """Runs stages for many shapes or questions, and keeps what it finds."""

    def __init__(
        self,
        executor: Executor,
        clock: Clock,
        cache: Cache,
        database: Database,
        failures: list[Failure],
        config: Config,
    ) -> None:
        self.executor = executor
        self._config = config
        self.clock = clock
        self._cache = cache
        self._paths = {s.id: _relative(s, database.root) for s in database.shapes}
        self._failures = failures

    def each(
        self,
        name: str,
        stage: Stage,
        shapes: Iterable[str],
        plan: Callable[[str], Task],
        read: Callable[[bytes], Any],
    ) -> dict[str, Result]:
        """The results of a stage for shapes; one that fails is a failure of that shape.

        Parameters
        ----------
        name : str
            Of the stage, as people see it.
        stage : Stage
        shapes : iterable of str
            Their ids.
        plan : callable
            The task of a shape; called when its turn comes. May raise :class:`MeshError`.
        read : callable
            Turns a kept result into a value. May raise :class:`MeshError`.

        Returns
        -------
        dict of str to Result
            By shape id, in the order of ``shapes``; those that failed are missing.
        """
        ids = list(shapes)
        results: dict[str, Result] = {}
        failed: dict[str, str] = {}
        with self.clock.stage(name, len(ids)) as step:

            def take(shape: str, key: str, content: bytes, cpu_seconds: float) -> None:
                try:
                    results[shape] = Result(key, read(content))
                except MeshError as error:
                    failed[shape] = str(error)
                step(cpu_seconds)

            def drop(shape: str, reason: str, cpu_seconds: float) -> None:
                failed[shape] = reason
                step(cpu_seconds)

            self.find(stage, ids, plan, take, drop)
        # Workers finish in any order; the report must not show which.
        self._failures.extend(Failure(self._paths[i], name, failed[i]) for i in ids if i in failed)
        return {shape: results[shape] for shape in ids if shape in results}

    def all(
        self,
        name: str,
        stage: Stage,
        tasks: Mapping[Name, Task],
        failing: Callable[[Name, str], str],
    ) -> dict[Name, bytes]:
        """The results of a stage for all tasks; see :meth:`answer`.

        Parameters
        ----------
        name : str
            Of the stage, as people see it.
        stage, tasks, failing
            As of :meth:`answer`.
        """
        with self.clock.stage(name, len(tasks)) as step:
            return self.answer(stage, tasks, failing, lambda _, cpu_seconds: step(cpu_seconds))

    def answer(
        self,
        stage: Stage,
        tasks: Mapping[Name, Task],
        failing: Callable[[Name, str], str],
        step: Callable[[Name, float], None],
    ) -> dict[Name, bytes]:
        """The results of all tasks; one that fails ends the build.

        Parameters
        ----------
        stage : Stage
        tasks : mapping of names to Task
        failing : callable
            What is said of a task that fails, by its name and the reason.
        step : callable
            Told of each task that is done, with the CPU seconds spent on it.

        Returns
        -------
        dict of names to bytes
            In the order of ``tasks``.

        Raises
        ------
        DatabaseError
        """
        found: dict[Name, bytes] = {}

        def take(name: Name, _: str, content: bytes, cpu_seconds: float) -> None:
            found[name] = content
            step(name, cpu_seconds)

        def drop(name: Name, reason: str, _: float) -> None:
            raise DatabaseError(failing(name, reason))

        self.find(stage, tasks, tasks.__getitem__, take, drop)
        return {name: found[name] for name in tasks}

    def find(
        self,
        stage: Stage,
        names: Iterable[Name],
        plan: Callable[[Name], Task],
        take: Callable[[Name, str, bytes, float], None],
        drop: Callable[[Name, str, float], None],
    ) -> None:
        """Find results in the cache or have them computed and kept, in any order.

        Parameters
        ----------
        stage : Stage
        names : iterable
            Of the tasks.
        plan : callable
            The task of a name; called when its turn comes. May raise :class:`MeshError`.
        take : callable
            Gets each name, key, result and CPU seconds spent on it.
        drop : callable
            Gets each name that has no result, the reason, and the CPU seconds spent on it.
        """
        sent: list[tuple[Name, str]] = []

        def open_tasks() -> Iterator[tuple[Any, ...]]:
            for name in names:
                try:
                    task = plan(name)
                except MeshError as error:
                    drop(name, str(error), 0.0)
                    continue
                except MemoryError:
                    drop(name, "it is larger than the memory that this machine has left", 0.0)
                    continue
                content = self._cache.load(stage.folder, task.key)
                if content is not None:
                    take(name, task.key, content, 0.0)
                    continue
                try:
                    arguments = [task.arguments()]
                except MeshError as error:
                    drop(name, str(error), 0.0)
                    continue
                sent.append((name, task.key))
                # they may be a gigabyte, and are not to be held while the next ones are made
                del task
                yield arguments.pop()

        for outcome in self.executor.run(stage.function, open_tasks()):
            name, key = sent[outcome.index]
            if outcome.reason is None:
                self._cache.store(stage.folder, key, outcome.value)
                take(name, key, outcome.value, outcome.cpu_seconds)
            else:
                drop(name, outcome.reason, outcome.cpu_seconds)

    def recall(self, stage: Stage, key: str, plan: Callable[[], Task]) -> bytes:
        """A result that was there a moment ago, computed anew if the cache has lost it.

        Parameters
        ----------
        stage : Stage
        key : str
        plan : callable
            Its task.

        Raises
        ------
        MeshError
            It cannot be had again: the mesh has changed or gone, or fails this time.
        """
        content = self._cache.load(stage.folder, key)
        if content is not None:
            return content
        task = plan()
        if task.key != key:
            raise MeshError("its file was changed while it was used; build again")
        # The executor may be in the middle of a stage, so this rare task has a worker of its own.
        with open_workers(self._config, 1) as executor:
            (outcome,) = executor.run(stage.function, [task.arguments()])
        if outcome.reason is not None:
            raise MeshError(outcome.reason)
        self._cache.store(stage.folder, key, outcome.value)
        return outcome.value


def _relative(shape: ShapeEntry, root: Path) -> str:
    try:
        return shape.path.relative_to(root).as_posix()
    except ValueError:
        return shape.path.as_posix()
