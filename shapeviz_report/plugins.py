"""Parts that other packages bring along: found by their entry points, checked, and called so that a failure names them.

A package says in its metadata what it brings, a group for each kind of part (:data:`GROUPS`). Only what is installed
counts: nothing of the current folder, nor of a database. Packages come by their names, and the parts of one by theirs,
so that the order is the same everywhere.
"""

from __future__ import annotations

import functools
import inspect
import re
import sys
import unicodedata
from collections.abc import Callable, Mapping
from contextlib import redirect_stdout
from copy import deepcopy
from dataclasses import dataclass
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from numbers import Integral, Real
from types import UnionType
from typing import Any, ClassVar, TypeVar, get_args, get_origin, get_type_hints

import numpy as np

from shapeviz_report.ending import is_asked
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


_LARGEST = 1e30
"""Of the numbers that a plug-in gives: surfaces and painted bins have them with 32 bits."""


_WHAT_TO_DO = "mend, update or uninstall the package"


class Unfit(Exception):
    """What a plug-in gave cannot be used; the message says why."""


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
            with redirect_stdout(sys.stderr):
                return self.entry.load()
        except BaseException as error:  # whatever it does when it is imported
            if is_asked(error):
                raise
            raise PluginError(
                f"{self.words} cannot be loaded ({type(error).__name__}: {error}); {_WHAT_TO_DO}"
            ) from error


@cache
def find_plugins() -> tuple[Plugin, ...]:
    """All that is installed, group by group as in :data:`GROUPS`.

    Raises
    ------
    PluginError
        A package has no name or version, as where it was half removed: results could not be told from those of others.
    """
    found = []
    for group, (kind, _) in GROUPS.items():
        own = []
        for entry in entry_points(group=group):
            if entry.dist is None:
                continue
            # What is missing is None to one reader of metadata and an error to another, which may take its place.
            said = entry.dist.metadata
            name, version = (said.get_all(field, [""])[0] for field in ("Name", "Version"))
            if not (name and version):
                raise PluginError(
                    f"the package of the {kind} {entry.name!r} ({entry.value}) has no name or no version: install it "
                    "anew, or remove what is left of it"
                )
            own.append(Plugin(group, entry.name, _normal(name), version, entry))
        found += sorted(own, key=lambda plugin: (plugin.package, plugin.name))
    return tuple(found)


def load_plugins(group: str, kinds: type[T] | tuple[type[T], ...]) -> tuple[tuple[Plugin, T], ...]:
    """The parts of a group, each of one of some kinds.

    Raises
    ------
    PluginError
        One cannot be loaded, or is something else.
    """
    wanted = kinds if isinstance(kinds, tuple) else (kinds,)
    loaded = []
    for plugin in find_plugins():
        if plugin.group == group:
            part = plugin.load()
            kind = next((each for each in wanted if isinstance(part, each)), type(None))
            names = " or ".join(each.__name__ for each in wanted)
            require(plugin, isinstance(part, kind), f"it is of the type {type(part).__name__}, not {names}")
            wrong = _wrong_field(part, kind)
            require(plugin, not wrong, wrong)
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
        One is not as it should be, says nothing of itself, or has a name that is taken.
    """
    brought = []
    taken = {same_name(part.name): "one of shapeviz-report itself" for part in own}  # type: ignore[attr-defined]
    texts = [name for name, declared in get_type_hints(kind).items() if declared in (str, ClassVar[str])]
    for plugin, part in load_plugins(group, kind):
        for text in texts:
            says = any(letter.isalnum() for letter in getattr(part, text))
            require(plugin, says, f"its {text!r} has no letter, and is read on pages or in lists")
        name = part.name
        if (same := same_name(name)) in taken:
            raise PluginError(
                f"{plugin.words} has the name {name!r}, which is taken by {taken[same]} (capitals do not tell names "
                "apart, nor do they in files everywhere): uninstall one of them"
            )
        taken[same] = plugin.words
        brought.append(prepare(plugin, part))
    return (*brought, *own) if first else (*own, *brought)


def same_name(name: str) -> str:
    """What a name has in common with all that a file system may take for it."""
    return unicodedata.normalize("NFKC", name).casefold()


def require(plugin: Plugin, holds: bool, what: str) -> None:
    """Refuse a plug-in that is not as it should be. Raises :class:`PluginError`."""
    if not holds:
        raise PluginError(f"{plugin.words} cannot be used: {what}; {_WHAT_TO_DO}")


def guarded(plugin: Plugin, function: Callable[..., Any], take: Callable[..., T]) -> Callable[..., T]:
    """A function of a plug-in whose failures name the package.

    It works on copies: what it is given is for others too. What it prints is no answer of the command, and goes to the
    standard error.

    Parameters
    ----------
    plugin : Plugin
    function : callable
    take : callable
        Gets what the function gave and its arguments, and gives it as it is to be used, or raises :class:`Unfit`.
    """

    @functools.wraps(function)
    def call(*arguments: Any) -> T:
        try:
            with redirect_stdout(sys.stderr):
                found = function(*deepcopy(arguments))
            return take(found, *arguments)
        except (MemoryError, ShapevizError):
            raise
        except Unfit as error:
            raise PluginError(f"{plugin.words} failed: {error}; {_WHAT_TO_DO}") from error
        except BaseException as error:
            if is_asked(error):
                raise
            told = f"{plugin.words} failed ({type(error).__name__}: {error}); {_WHAT_TO_DO}"
            raise PluginError(told) from error

    return call


def take_numbers(found: Any, size: tuple[int, ...], what: str, lowest: float = -_LARGEST) -> np.ndarray:
    """What a plug-in gave as an array of numbers.

    Parameters
    ----------
    found : any
    size : tuple of int
        That it is to have.
    what : str
        What the numbers are, as a sentence about them begins: "its values".
    lowest : float, optional

    Raises
    ------
    Unfit
        It is no array of that size, or has what is no number, or not finite or out of bounds.
    """
    values = np.asarray(found)
    if values.shape != size:
        raise Unfit(f"{what} are an array {values.shape}, and not {size}")
    if values.dtype.kind not in "biuf":
        raise Unfit(f"{what} are of the type {values.dtype}, and no real numbers")
    if not np.isfinite(values).all():
        raise Unfit(f"not all of {what} are finite")
    if values.size and not (values.min() >= lowest and values.max() <= _LARGEST):
        raise Unfit(f"{what} are not all from {lowest:g} to {_LARGEST:g}")
    return values.astype(np.float64, copy=False)


def _wrong_field(part: Any, kind: type) -> str:
    """What is wrong with the first field of a record that is not of its declared type; nothing if all are."""
    told = inspect.get_annotations(kind)
    for name, declared in get_type_hints(kind).items():
        if not hasattr(part, name):
            return f"it has no {name!r}"
        if not _is_of(value := getattr(part, name), declared):
            return f"its {name!r} is of the type {type(value).__name__}, not {told[name]}"
    return ""


def _is_of(value: Any, declared: Any) -> bool:
    """Whether a value is of a declared type, as far as the records of plug-ins need it."""
    origin, inner = get_origin(declared) or declared, get_args(declared)
    if origin in (ClassVar, UnionType):
        return any(_is_of(value, each) for each in inner)
    if origin is Callable:
        return callable(value)
    if origin is tuple:
        return isinstance(value, tuple) and all(_is_of(part, inner[0]) for part in value)
    return isinstance(value, {int: Integral, float: Real}.get(origin, origin))


def _normal(name: str) -> str:
    """The name of a distribution, as all that compare them have it."""
    return re.sub(r"[-_.]+", "-", name).lower()
