"""Compiled loops whose machine code is kept, under a key of the sources it was made from.

Numba keeps machine code beside a module and makes it anew when that module's file changes. It does not look at the
modules whose functions it has built in: after a change there, the old code would answer. Nor does it look at what it
reads: a damaged file would end every build, or answer wrong.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import ModuleType
from typing import Any

import numba
from numba import config, njit
from numba.core import dispatcher, event
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    UserProvidedCacheLocator,
)
from numba.core.serialize import dumps

from shapeviz_report.cache import Cache, default_root, make_key
from shapeviz_report.errors import CacheError
from shapeviz_report.executor.pauses import pause
from shapeviz_report.versions import library_versions, source_version


def kernel(**options: Any) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """A decorator that compiles a function of a module with ``numba.njit`` and keeps the machine code.

    Parameters
    ----------
    **options
        Of ``numba.njit``.
    """

    def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
        with _kept_under(source_version(function.__module__)):
            return njit(cache=True, **options)(function)

    return compiled


def keep_compiled(library: str, *modules: ModuleType) -> None:
    """Let numba keep what it compiles of some modules of a library, whose own way is to compile it in every process."""
    with kept_for(library):
        for module in modules:
            for function in vars(module).values():
                if isinstance(function, dispatcher.Dispatcher) and not function.signatures:
                    function.enable_caching()


@contextmanager
def kept_for(*libraries: str) -> Iterator[None]:
    """Inside, numba keeps what functions of other libraries compile to under a key of the versions of these libraries
    and of all that they require."""
    with _kept_under(make_key(*library_versions(libraries))[:16]):
        yield


@contextmanager
def _kept_under(key: str) -> Iterator[None]:
    """Inside, code is kept in a folder of that name. Numba looks for the place when a function is set up."""
    before: str = vars(config)["CACHE_DIR"]
    vars(config)["CACHE_DIR"] = str(Path(before or _root()) / key)
    vars(dispatcher)["FunctionCache"] = _KeptCode
    try:
        yield
    finally:
        vars(config)["CACHE_DIR"] = before
        vars(dispatcher)["FunctionCache"] = FunctionCache


def _root() -> Path:
    """Beside the modules, as numba does it, so that an installation takes its compiled code with it; where that cannot
    be written, with the other results."""
    folder = Path(__file__).parent
    return folder / "__pycache__" / "kernels" if os.access(folder, os.W_OK) else default_root() / "kernels"


class _Place(UserProvidedCacheLocator):
    """The folder that is named, and no other where that cannot be written: numba's own would have no such key."""

    @classmethod
    def from_function(cls, py_func: Callable[..., Any], py_file: str) -> _Place:
        return cls(py_func, py_file)


class _Content(CompileResultCacheImpl):
    _locator_classes = [_Place]  # noqa: RUF012 - as its base has it


class _Files(IndexDataCacheFile):
    """Numba's index of the code of a function, and the code, as entries of a :class:`~shapeviz_report.cache.Cache`."""

    def __init__(self, cache_path: str, filename_base: str, source_stamp: object) -> None:
        super().__init__(cache_path, filename_base, source_stamp)
        self._cache = Cache(Path(cache_path))

    def _key(self, name: str) -> str:
        return make_key(name, numba.__version__, self._source_stamp)

    def _load_index(self) -> dict[object, str]:
        index = self._load_data(self._index_name)
        return {} if index is None else index

    def _save_index(self, overloads: dict[object, str]) -> None:
        self._save_data(self._index_name, overloads)

    def _load_data(self, name: str) -> Any:
        content = self._cache.load("code", self._key(name))
        return None if content is None else pickle.loads(content)

    def _save_data(self, name: str, data: object) -> None:
        self._cache.store("code", self._key(name), dumps(data))


class _KeptCode(FunctionCache):
    """The kept code of a function: what was damaged is compiled anew, and what cannot be kept again next time."""

    _impl_class = _Content

    def __init__(self, py_func: Callable[..., Any]) -> None:
        super().__init__(py_func)
        locator = self._impl.locator
        self._cache_file = _Files(
            locator.get_cache_path(), self._impl.filename_base, locator.get_source_stamp()
        )

    def _save_overload(self, sig: object, data: object) -> None:
        with suppress(OSError, CacheError):
            super()._save_overload(sig, data)


class _Compiling(event.Listener):
    """Machine code is made for all tasks to come: the one that first needs it is not late for it."""

    def __init__(self) -> None:
        self._depth = 0

    def on_start(self, _: event.Event) -> None:
        if self._depth == 0:
            pause(True)
        self._depth += 1

    def on_end(self, _: event.Event) -> None:
        self._depth -= 1
        if self._depth == 0:
            pause(False)


event.register("numba:compile", _Compiling())
