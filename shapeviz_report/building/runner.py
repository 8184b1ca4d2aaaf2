"""Runs stages: what is kept is taken from the cache, the rest is computed by the executor and kept."""

from __future__ import annotations

import logging
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any, TypeVar

from shapeviz_report.building.chains import FILES, Chain, Done, Plan, work_through
from shapeviz_report.building.progress import Clock
from shapeviz_report.building.stages import Stage
from shapeviz_report.building.workers import open_workers
from shapeviz_report.cache import Cache
from shapeviz_report.config import Config
from shapeviz_report.errors import DatabaseError, MeshError
from shapeviz_report.executor import Executor
from shapeviz_report.types import Database, Failure, ShapeEntry

logger = logging.getLogger(__name__)

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
class Made:
    """A result that was made.

    Attributes
    ----------
    shape : str
    key : str
        Of the result, in the cache.
    plan : callable
        Gives the chain that leads to it.
    """

    shape: str
    key: str
    plan: Callable[[], Plan]


class Runner:
    """Runs stages for many shapes or questions, and keeps what it finds.

    Parameters
    ----------
    executor : Executor
    clock : Clock
    cache : Cache
    files : mapping of str to str
        Shape id -> what failures call its file.
    failures : list of Failure
        To which those of shapes are added.
    config : Config
    """

    def __init__(
        self,
        executor: Executor,
        clock: Clock,
        cache: Cache,
        files: Mapping[str, str],
        failures: list[Failure],
        config: Config,
    ) -> None:
        self.executor = executor
        self._config = config
        self.clock = clock
        self._cache = cache
        self._files = files
        self._failures = failures

    def each(
        self,
        doing: str,
        shapes: Iterable[str],
        wanted: Sequence[Stage[Any]],
        plan: Callable[[str], Plan],
        take: Callable[[str, Chain, dict[Stage[Any], Any]], None],
    ) -> None:
        """The results of some stages for shapes, a task a shape; one that fails is a failure of that shape.

        Parameters
        ----------
        doing : str
            What people read meanwhile.
        shapes : iterable of str
            Their ids.
        wanted : sequence of Stage
            What is asked for; one that tells why a mesh cannot be used comes first.
        plan : callable
            The chain of a shape, with all that is wanted and what it takes; called when its turn comes. May raise
            :class:`MeshError`.
        take : callable
            Gets each shape, its chain and the values by stage, in any order.

        Raises
        ------
        DatabaseError
            One failed whose stage ends the build.
        """
        ids = list(shapes)
        failed: dict[str, tuple[Stage[Any], str]] = {}
        sent: dict[int, tuple[str, Chain, dict[str, bytes]]] = {}
        number = count()
        with self.clock.stages([stage.name for stage in wanted], doing, len(ids)) as step:

            def end(
                shape: str, chain: Chain, found: Mapping[str, bytes], spent: Mapping[str, float], reason: str
            ) -> None:
                values = {}
                for stage in wanted:
                    try:
                        if stage.folder not in found:
                            raise MeshError(reason)
                        values[stage] = stage.read(found[stage.folder])
                    except MeshError as error:
                        failed[shape] = (stage, str(error))
                        break
                else:
                    take(shape, chain, values)
                step(spent)

            def fail(shape: str, reason: str) -> None:
                failed[shape] = (wanted[0], reason)
                step({})

            def open_tasks() -> Iterator[tuple[Any, ...]]:
                for shape in ids:
                    try:
                        chain, files = plan(shape)
                    except MeshError as error:
                        fail(shape, str(error))
                        continue
                    except MemoryError:
                        fail(shape, "it is larger than the memory that this machine has left")
                        continue
                    found = self._look_up(chain, wanted)
                    task = self._task(chain, files, wanted, found)
                    # it may be a gigabyte, and is not to be held while the next one is made
                    del files
                    if task is None:
                        end(shape, chain, found, {}, "")
                        continue
                    sent[next(number)] = (shape, chain, found)
                    arguments = [task]
                    del task
                    yield arguments.pop()

            patience = max(stage.patience for stage in wanted)
            for outcome in self.executor.run(work_through, open_tasks(), patience):
                shape, chain, found = sent.pop(outcome.index)
                done = outcome.value or Done({}, {}, None)
                for name, content in done.results.items():
                    self._cache.store(name, chain.links[name].key, content)
                found |= done.results
                reason = outcome.reason or (done.refused[1] if done.refused else "")
                end(shape, chain, found, _by_stage(chain, done, outcome.cpu_seconds), reason)
        # Workers finish in any order; the report must not show which.
        for shape in (shape for shape in ids if shape in failed):
            stage, reason = failed[shape]
            if stage.failing:
                raise DatabaseError(stage.failing.format(task=shape, reason=reason))
            self._failures.append(Failure(self._files[shape], stage.name, reason))

    def _look_up(self, chain: Chain, wanted: Sequence[Stage[Any]]) -> dict[str, bytes]:
        """What the cache has of what is wanted, by the folder of each stage."""
        found = ((stage.folder, self._cache.load(stage.folder, chain.key(stage))) for stage in wanted)
        return {name: content for name, content in found if content is not None}

    def _task(
        self,
        chain: Chain,
        files: Mapping[str, bytes],
        wanted: Sequence[Stage[Any]],
        found: Mapping[str, bytes],
    ) -> tuple[Any, ...] | None:
        """The arguments of :func:`work_through` for what is wanted and not found; None where nothing is to be done."""
        missing = {stage.folder for stage in wanted} - found.keys()
        # Only the first may tell why, so that the words do not depend on what another command has kept.
        if not missing or _refuses(wanted[0], found.get(wanted[0].folder)):
            return None
        given: dict[str, Any] = {}
        needed = set(missing)
        for name, link in reversed(chain.links.items()):
            if name not in needed:
                continue
            for source in link.inputs:
                if source in given or source in needed:
                    continue
                if source == FILES:
                    given[FILES] = files
                    continue
                content = found.get(source) or self._cache.load(source, chain.links[source].key)
                if content is None:
                    needed.add(source)
                else:
                    given[source] = content
        links = [
            (name, link.stage.compute, link.inputs, link.options)
            for name, link in chain.links.items()
            if name in needed
        ]
        # What is far off does not send what only stands between, such as the prepared mesh.
        return given, links, needed if self.executor.near else missing

    def all(self, stage: Stage[R], tasks: Mapping[Name, Task], *, here: bool = False) -> dict[Name, R]:
        """The results of a stage for all tasks, each by its name; one that fails ends the build."""
        with self.clock.stage(stage.name, stage.doing, len(tasks)) as step:
            return self.answer(stage, tasks, lambda _, cpu_seconds: step(cpu_seconds), here=here)

    def answer(
        self,
        stage: Stage[R],
        tasks: Mapping[Name, Task],
        step: Callable[[Name, float], None],
        *,
        here: bool = False,
    ) -> dict[Name, R]:
        """The results of some of a stage's tasks; one that fails ends the build.

        Parameters
        ----------
        stage : Stage
        tasks : mapping of names to Task
        step : callable
            Told of each task that is done, with the CPU seconds spent on it.
        here : bool
            Whether it is done on this machine, for what it takes is too large to travel.

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

        if here and not self.executor.near:
            with open_workers(self._config, self._config.worker_count) as executor:
                self.find(stage, tasks, tasks.__getitem__, take, drop, executor)
        else:
            self.find(stage, tasks, tasks.__getitem__, take, drop)
        return {name: found[name] for name in tasks}

    def find(
        self,
        stage: Stage[Any],
        names: Iterable[Name],
        plan: Callable[[Name], Task],
        take: Callable[[Name, str, bytes, float], None],
        drop: Callable[[Name, str, float], None],
        executor: Executor | None = None,
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
        executor : Executor, optional
            Another than that of the build.
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

        for outcome in (executor or self.executor).run(stage.compute, open_tasks(), stage.patience):
            name, key = sent[outcome.index]
            if outcome.reason is None:
                self._cache.store(stage.folder, key, outcome.value)
                take(name, key, outcome.value, outcome.cpu_seconds)
            else:
                drop(name, outcome.reason, outcome.cpu_seconds)

    def find_together(
        self,
        stage: Stage[Any],
        function: Callable[..., list[bytes]],
        batches: Iterable[Sequence[Name]],
        key: Callable[[Name], str],
        gather: Callable[[Sequence[Name]], tuple[Any, ...]],
        take: Callable[[Name, str, bytes, float], None],
    ) -> list[Name]:
        """Find results in the cache or have them computed, several at one go, and kept, each for itself.

        Parameters
        ----------
        stage : Stage
        function : callable
            Computes a batch: the results of the stage's function, in order.
        batches : iterable of sequences of names
        key : callable
            Of the result of a name, in the cache.
        gather : callable
            The arguments of ``function`` for some names; called when their turn comes. May raise :class:`MeshError`.
        take : callable
            As :meth:`find` has it.

        Returns
        -------
        list of names
            Those of batches that failed, which one of them may have brought down.
        """
        failed: list[Name] = []
        sent: list[Sequence[Name]] = []

        def open_tasks() -> Iterator[tuple[Any, ...]]:
            for batch in batches:
                missing = []
                for name in batch:
                    content = self._cache.load(stage.folder, key(name))
                    if content is None:
                        missing.append(name)
                    else:
                        take(name, key(name), content, 0.0)
                if not missing:
                    continue
                try:
                    arguments = [gather(missing)]
                except (MeshError, MemoryError):
                    failed.extend(missing)
                    continue
                sent.append(missing)
                yield arguments.pop()

        for outcome in self.executor.run(function, open_tasks(), stage.patience):
            batch = sent[outcome.index]
            if outcome.reason is not None:
                failed += batch
                continue
            for name, content in zip(batch, outcome.value, strict=True):
                self._cache.store(stage.folder, key(name), content)
                take(name, key(name), content, outcome.cpu_seconds / len(batch))
        return failed

    def recall(self, stage: Stage[Any], made: Sequence[Made], place: int) -> bytes:
        """A result that was there a moment ago. What the cache has lost of it and of those that follow is made again.

        Parameters
        ----------
        stage : Stage
        made : sequence of Made
            Results of the stage, in the order in which they are asked for.
        place : int

        Raises
        ------
        MeshError
            It cannot be had again: the mesh has changed or gone, or fails this time.
        """
        content = self._cache.load(stage.folder, made[place].key)
        if content is None:
            content = self._make_again(stage, made[place:])
        return content

    def _make_again(self, stage: Stage[Any], made: Sequence[Made]) -> bytes:
        """The first of some results, of which the cache has lost this one and perhaps others; all of them are made."""
        logger.warning("Note: results have gone from the cache %s; they are made again.", self._cache.root)
        sent: list[Made] = []
        first = b""

        def refuse(one: Made, reason: str) -> MeshError:
            return MeshError(f"{self._files[one.shape]} cannot be used again: {reason}")

        def open_tasks() -> Iterator[tuple[Any, ...]]:
            for one in made:
                if sent and self._cache.holds(stage.folder, one.key):
                    continue
                try:
                    chain, files = one.plan()
                except MeshError as error:
                    raise refuse(one, str(error)) from error
                task = self._task(chain, files, [stage], {})
                assert task is not None
                sent.append(one)
                yield task

        # The executor may have been closed, or be in the middle of a stage.
        with open_workers(self._config, self._config.worker_count) as executor:
            for outcome in executor.run(work_through, open_tasks()):
                one = sent[outcome.index]
                reason = outcome.reason or (outcome.value.refused or ("", ""))[1]
                if reason:
                    raise refuse(one, reason)
                content = outcome.value.results[stage.folder]
                self._cache.store(stage.folder, one.key, content)
                if outcome.index == 0:
                    first = content
        return first


def _refuses(stage: Stage[Any], content: bytes | None) -> bool:
    """Whether a result says that the mesh cannot be used."""
    try:
        if content is not None:
            stage.read(content)
    except MeshError:
        return True
    return False


def _by_stage(chain: Chain, done: Done, cpu_seconds: float) -> dict[str, float]:
    """CPU seconds by the name of a stage; what a worker took beside its stages goes to the first."""
    spent: dict[str, float] = {}
    for name, seconds in done.cpu_seconds.items():
        stage = chain.links[name].stage.name
        spent[stage] = spent.get(stage, 0.0) + seconds
    first = next(iter(spent), next(iter(chain.links.values())).stage.name)
    spent[first] = spent.get(first, 0.0) + max(0.0, cpu_seconds - sum(spent.values()))
    return spent


def name_files(database: Database) -> dict[str, str]:
    """Shape id -> its file, below the folder of a database where it lies there."""
    return {shape.id: _relative(shape, database.root) for shape in database.shapes}


def _relative(shape: ShapeEntry, root: Path) -> str:
    try:
        return shape.path.relative_to(root).as_posix()
    except ValueError:
        return shape.path.as_posix()
