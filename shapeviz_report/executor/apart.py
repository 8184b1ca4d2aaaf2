"""Reading a stranger's file in a process of its own."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar, TypeVarTuple, Unpack

from shapeviz_report.executor.local import LocalExecutor
from shapeviz_report.executor.memory import memory_share

MOST_SECONDS = 300.0
"""That reading a file may take."""

_Arguments = TypeVarTuple("_Arguments")
_T = TypeVar("_T")


def call_apart(function: Callable[[Unpack[_Arguments]], _T], *arguments: *_Arguments) -> _T:
    """What a function gives, called in a worker process: what a file does to a library in C ends that process and not
    this one.

    Parameters
    ----------
    function : callable
        Of a module, as for :meth:`Executor.run`; its exceptions are raised here.
    *arguments
        Its arguments.

    Raises
    ------
    ValueError
        The process crashed, took more than ``MOST_SECONDS``, or more memory than there is.
    """
    with LocalExecutor(1, MOST_SECONDS, memory_share(1)) as executor:
        (outcome,) = executor.run(function, [arguments])
    if outcome.reason is not None:
        # Without the advice, which is on meshes and the limits of a build.
        raise ValueError(outcome.reason.partition(":")[0].partition(";")[0])
    value: _T = outcome.value
    return value
