"""Runs stages: what is kept is taken from the cache, the rest is computed by the executor and kept."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from shapeviz_report.building.progress import Clock
from shapeviz_report.building.stages import Stage
from shapeviz_report.building.workers import open_workers
from shapeviz_report.cache import Cache
from shapeviz_report.config import Config
from shapeviz_report.errors import DatabaseError, MeshError
from shapeviz_report.executor import Executor
from shapeviz_report.types import Database, Failure, ShapeEntry

Name = TypeVar("Name", bound=Hashable)
R = TypeVar("R")


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
class Result(Generic[R]):
    """What a stage found for one shape, and the key under which the cache has it."""

    key: str
    value: R


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
        stage: Stage[R],
        shapes: Iterable[str],
        plan: Callable[[str], Task],
    ) -> dict[str, Result[R]]:
        """The results of a stage for shapes; one that fails is a failure of that shape.

        Parameters
        ----------
        stage : Stage
        shapes : iterable of str
            Their ids.
        plan : callable
            The task of a shape; called when its turn comes. May raise :class:`MeshError`.

        Returns
        -------
        dict of str to Result
            By shape id, in the order of ``shapes``; those that failed are missing.
        """
        ids = list(shapes)
        results: dict[str, Result[R]] = {}
        failed: dict[str, str] = {}
        with self.clock.stage(stage.name, stage.doing, len(ids)) as step:

            def take(shape: str, key: str, content: bytes, cpu_seconds: float) -> None:
                try:
                    results[shape] = Result(key, stage.read(content))
                except MeshError as error:
                    failed[shape] = str(error)
                step(cpu_seconds)

            def drop(shape: str, reason: str, cpu_seconds: float) -> None:
                failed[shape] = reason
                step(cpu_seconds)

            self.find(stage, ids, plan, take, drop)
        # Workers finish in any order; the report must not show which.
        self._failures.extend(Failure(self._paths[i], stage.name, failed[i]) for i in ids if i in failed)
        return {shape: results[shape] for shape in ids if shape in results}

    def all(self, stage: Stage[R], tasks: Mapping[Name, Task]) -> dict[Name, R]:
        """The results of a stage for all tasks, each by its name; one that fails ends the build."""
        with self.clock.stage(stage.name, stage.doing, len(tasks)) as step:
            return self.answer(stage, tasks, lambda _, cpu_seconds: step(cpu_seconds))

    def answer(
        self, stage: Stage[R], tasks: Mapping[Name, Task], step: Callable[[Name, float], None]
    ) -> dict[Name, R]:
        """The results of some of a stage's tasks; one that fails ends the build.

        Parameters
        ----------
        stage : Stage
        tasks : mapping of names to Task
        step : callable
            Told of each task that is done, with the CPU seconds spent on it.

        Returns
        -------
        dict of names to values
            In the order of ``tasks``.

        Raises
        ------
        DatabaseError
        """
        found: dict[Name, R] = {}

        def take(name: Name, _: str, content: bytes, cpu_seconds: float) -> None:
            found[name] = stage.read(content)
            step(name, cpu_seconds)

        def drop(name: Name, reason: str, _: float) -> None:
            raise DatabaseError(stage.failing.format(task=name, reason=reason))

        self.find(stage, tasks, tasks.__getitem__, take, drop)
        return {name: found[name] for name in tasks}

    def find(
        self,
        stage: Stage[Any],
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

        for outcome in self.executor.run(stage.compute, open_tasks(), stage.patience):
            name, key = sent[outcome.index]
            if outcome.reason is None:
                self._cache.store(stage.folder, key, outcome.value)
                take(name, key, outcome.value, outcome.cpu_seconds)
            else:
                drop(name, outcome.reason, outcome.cpu_seconds)

    def recall(self, stage: Stage[Any], key: str, plan: Callable[[], Task]) -> bytes:
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
            (outcome,) = executor.run(stage.compute, [task.arguments()])
        if outcome.reason is not None:
            raise MeshError(outcome.reason)
        self._cache.store(stage.folder, key, outcome.value)
        return outcome.value


def _relative(shape: ShapeEntry, root: Path) -> str:
    try:
        return shape.path.relative_to(root).as_posix()
    except ValueError:
        return shape.path.as_posix()
