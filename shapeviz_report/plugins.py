"""Parts that other packages bring along: found by their entry points, checked, and called so that a failure names them.

A package says in its metadata what it brings, a group for each kind of part (:data:`GROUPS`). Only what is installed
counts: nothing of the current folder, nor of a database. Packages come by their names, and the parts of one by theirs,
so that the order is the same everywhere.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any, TypeVar

from shapeviz_report.errors import PluginError, ShapevizError

T = TypeVar("T")

GROUPS: Mapping[str, tuple[str, str]] = {
    "shapeviz_report.descriptors": ("descriptor", "shapeviz_report.descriptors.registry"),
    "shapeviz_report.global_descriptors": (
        "global descriptor",
        "shapeviz_report.global_descriptors.registry",
    ),
    "shapeviz_report.wordings": ("wording", "shapeviz_report.wording.registry"),
    "shapeviz_report.scorers": ("scorer", "shapeviz_report.scorers.registry"),
    "shapeviz_report.projections": ("projection", "shapeviz_report.projections.registry"),
    "shapeviz_report.layouts": ("layout", "shapeviz_report.database.registry"),
}
"""Group of entry points -> what one of them is, and the module that takes them up."""


@dataclass(frozen=True)
class Plugin:
    """A part that a package brings along.

    Attributes
    ----------
    group, name : str
        Of its entry point.
    package, version : str
        Of the distribution that has it.
    entry : EntryPoint
    """

    group: str
    name: str
    package: str
    version: str
    entry: EntryPoint

    @property
    def words(self) -> str:
        """What it is and where it is from, as it stands in a sentence."""
        return f"the {GROUPS[self.group][0]} {self.name!r} of the package {self.package} {self.version}"

    def load(self) -> Any:
        """The object. Raises :class:`PluginError`."""
        try:
            return self.entry.load()
        except (Exception, SystemExit) as error:  # whatever it does when it is imported
            raise PluginError(
                f"{self.words} cannot be loaded ({type(error).__name__}: {error}): mend, update or uninstall the "
                "package"
            ) from error


@cache
def find_plugins() -> tuple[Plugin, ...]:
    """All that is installed, group by group as in :data:`GROUPS`."""
    found = []
    for group in GROUPS:
        own = [
            Plugin(group, entry.name, _normal(entry.dist.name), entry.dist.version, entry)
            for entry in entry_points(group=group)
            if entry.dist is not None
        ]
        found += sorted(own, key=lambda plugin: (plugin.package, plugin.name))
    return tuple(found)


def load_plugins(group: str, kinds: type[T] | tuple[type[T], ...]) -> tuple[tuple[Plugin, T], ...]:
    """The parts of a group, each of one of some kinds.

    Raises
    ------
    PluginError
        One cannot be loaded, or is something else.
    """
    loaded = []
    for plugin in find_plugins():
        if plugin.group == group:
            part = plugin.load()
            names = " or ".join(kind.__name__ for kind in (kinds if isinstance(kinds, tuple) else (kinds,)))
            require(plugin, isinstance(part, kinds), f"it is of the type {type(part).__name__}, not {names}")
            loaded.append((plugin, part))
    return tuple(loaded)


def with_plugins(
    group: str, own: tuple[T, ...], kind: type[Any], prepare: Callable[[Plugin, T], T], *, first: bool = False
) -> tuple[T, ...]:
    """Parts of ours with those that packages bring along.

    Parameters
    ----------
    group : str
    own : tuple of parts
        Ours; each has a ``name``.
    kind : type
        Of all of them.
    prepare : callable
        Checks a part that was brought along, and gives it as it is to be used; see :func:`guarded`.
    first : bool
        Whether those that were brought along stand before ours.

    Raises
    ------
    PluginError
        One is not as it should be, or has a name that is taken.
    """
    brought = []
    taken = {part.name: "one of shapeviz-report itself" for part in own}  # type: ignore[attr-defined]
    for plugin, part in load_plugins(group, kind):
        name = part.name
        if name in taken:
            raise PluginError(
                f"{plugin.words} has the name {name!r}, which is taken by {taken[name]}: uninstall one of them"
            )
        taken[name] = plugin.words
        brought.append(prepare(plugin, part))
    return (*brought, *own) if first else (*own, *brought)


def require(plugin: Plugin, holds: bool, what: str) -> None:
    """Refuse a plug-in that is not as it should be. Raises :class:`PluginError`."""
    if not holds:
        raise PluginError(f"{plugin.words} cannot be used: {what}; mend, update or uninstall the package")


def guarded(plugin: Plugin, function: Callable[..., T], check: Callable[..., str]) -> Callable[..., T]:
    """A function of a plug-in whose failures name the package.

    Parameters
    ----------
    plugin : Plugin
    function : callable
    check : callable
        Gets what the function gave and its arguments; says what is wrong with it, or nothing.
    """

    @functools.wraps(function)
    def call(*arguments: Any) -> T:
        try:
            value = function(*arguments)
        except (MemoryError, ShapevizError):
            raise
        except Exception as error:
            raise PluginError(f"{plugin.words} failed ({type(error).__name__}: {error})") from error
        wrong = check(value, *arguments)
        if wrong:
            raise PluginError(f"{plugin.words} failed: {wrong}")
        return value

    return call


def _normal(name: str) -> str:
    """The name of a distribution, as all that compare them have it."""
    return re.sub(r"[-_.]+", "-", name).lower()
