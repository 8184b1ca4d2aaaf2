"""What is done for one shape, as one task: stages that take results of earlier ones, where these are.

A worker that has read a mesh file prepares it, draws it and measures it at one go, so that of all this only what is
kept travels.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from shapeviz_report.building.stages import Stage
from shapeviz_report.errors import MeshError

FILES = "files"
"""What the first stages of a chain take: a mesh file, with those that it names."""


@dataclass(frozen=True)
class Link:
    """A stage of a chain.

    Attributes
    ----------
    stage : Stage
    key : str
        Of its result, in the cache.
    inputs : tuple of str
        The first arguments of its function: :data:`FILES`, or folders of stages that come before.
    options : tuple
        Its other arguments.
    """

    stage: Stage[Any]
    key: str
    inputs: tuple[str, ...]
    options: tuple[Any, ...]


class Chain:
    """The stages of one shape, each after those whose results it takes.

    Parameters
    ----------
    identity : str
        What of the mesh file and those that it names decides how they are read.

    Attributes
    ----------
    links : dict of str to Link
        By the folder of each stage in the cache.
    """

    def __init__(self, identity: str) -> None:
        self.links: dict[str, Link] = {}
        self._identity = identity

    def add(self, stage: Stage[Any], inputs: Sequence[Stage[Any]] = (), *options: Any) -> None:
        """Add a stage that takes the results of others, or else the files, and some options.

        Options are part of its key, arrays by their bytes.
        """
        sources = [self.links[source.folder].key for source in inputs] or [self._identity]
        told = (getattr(option, "tobytes", lambda option=option: option)() for option in options)
        names = tuple(source.folder for source in inputs) or (FILES,)
        self.links[stage.folder] = Link(stage, stage.key(*sources, *told), names, options)

    def key(self, stage: Stage[Any]) -> str:
        """The key of a stage's result."""
        return self.links[stage.folder].key


Plan = tuple[Chain, Mapping[str, bytes]]
"""A chain, and the files that it begins with, as :func:`~shapeviz_report.mesh.collect_files` finds them."""


@dataclass(frozen=True)
class Done:
    """What a worker did of a chain.

    Attributes
    ----------
    results : dict of str to bytes
        Those that were wanted back, by the folder of their stage.
    cpu_seconds : dict of str to float
        By the folder of each stage that was begun.
    refused : (str, str) or None
        The folder of the stage that could not use the mesh, after which nothing was done, and why.
    """

    results: dict[str, bytes]
    cpu_seconds: dict[str, float]
    refused: tuple[str, str] | None


def work_through(
    given: Mapping[str, Any],
    links: Sequence[tuple[str, Callable[..., bytes], Sequence[str], Sequence[Any]]],
    back: Collection[str],
) -> Done:
    """Do some stages of a chain, one after the other; what a worker calls.

    Parameters
    ----------
    given : mapping of str to object
        What is there: the files, and results of stages.
    links : sequence of (name, function, names of inputs, options)
    back : names of the results to give back
    """
    there = dict(given)
    done = Done({}, {}, None)
    for name, function, inputs, options in links:
        begun = time.process_time()
        try:
            there[name] = function(*(there[source] for source in inputs), *options)
        except MeshError as error:
            return Done(done.results, done.cpu_seconds, (name, str(error)))
        finally:
            done.cpu_seconds[name] = time.process_time() - begun
        if name in back:
            done.results[name] = there[name]
    return done
