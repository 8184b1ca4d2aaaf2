"""All layouts: ours, and those of plug-ins."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from shapeviz_report.database import LAYOUTS, Layout
from shapeviz_report.plugins import Plugin, guarded, require, with_plugins
from shapeviz_report.types import Database


class _Brought(Layout):
    """A layout of a plug-in."""

    def __init__(self, plugin: Plugin, layout: Layout) -> None:
        self.name = layout.name  # type: ignore[misc]
        self.description = layout.description  # type: ignore[misc]
        self._recognises = guarded(plugin, layout.recognises, lambda *_: "")
        self._read = guarded(plugin, layout.read, _is_database)

    def recognises(self, path: Path, outside: bool) -> bool:
        return bool(self._recognises(path, outside))

    def read(self, path: Path, outside: bool) -> Database:
        return self._read(path, outside)


def _is_database(found: Any, *_: object) -> str:
    return (
        ""
        if isinstance(found, Database)
        else f"what it gives is of the type {type(found).__name__}, not Database"
    )


def _prepare(plugin: Plugin, layout: Layout) -> Layout:
    require(plugin, bool(layout.description), "it has no description")
    return _Brought(plugin, layout)


ALL_LAYOUTS = with_plugins("shapeviz_report.layouts", LAYOUTS, Layout, _prepare, first=True)
"""In the order in which they are tried. Those of plug-ins come first, for ours take any folder of meshes."""
