"""The contract of an executor."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Protocol, Self


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
    """Something that runs tasks, on this machine or on others. A context manager, which ends what it started.

    Attributes
    ----------
    near : bool
        Whether results come from this machine, so that large ones cost little.
    """

    near: bool

    def __enter__(self) -> Self: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...

    def run(
        self, function: Callable[..., Any], tasks: Iterable[tuple[Any, ...]], patience: float = 1.0
    ) -> Iterator[Outcome]:
        """Call ``function(*task)`` for each task; outcomes as they come, in any order.

        Tasks are drawn only as workers become free for them, so their inputs need not all be in memory at
        once. ``function`` must be importable by name, and must find all it needs in its arguments: the worker
        may be on a machine that has neither our files nor our cache. A :class:`ShapevizError` that it raises, a
        crash and a task over the time limit or the bound of memory become outcomes with a reason; any other exception
        is a bug and is raised here. A task may take ``patience`` times the time limit.
        """
        ...
