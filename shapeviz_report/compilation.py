"""Compiled loops whose machine code is kept, under a key of the sources it was made from.

Numba keeps machine code beside a module and makes it anew when that module's file changes. It does not look at the
modules whose functions it has built in: after a change there, the old code would answer.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from numba import config, njit

from shapeviz_report.cache import default_root, make_key
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


@contextmanager
def kept_for(*libraries: str) -> Iterator[None]:
    """Inside, numba keeps what functions of other libraries compile to under a key of the versions of these libraries
    and of all that they require."""
    with _kept_under(make_key(*library_versions(libraries))[:16]):
        yield


@contextmanager
def _kept_under(key: str) -> Iterator[None]:
    """Inside, caching is switched on for a folder of that name. Numba reads the setting when a function is set up."""
    before: str = vars(config)["CACHE_DIR"]
    vars(config)["CACHE_DIR"] = str(Path(before or _root()) / key)
    try:
        yield
    finally:
        vars(config)["CACHE_DIR"] = before


def _root() -> Path:
    """Beside the modules, as numba does it, so that an installation takes its compiled code with it; where that cannot
    be written, with the other results."""
    folder = Path(__file__).parent
    return folder / "__pycache__" / "kernels" if os.access(folder, os.W_OK) else default_root() / "kernels"
