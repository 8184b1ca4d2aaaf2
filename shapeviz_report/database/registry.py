"""All layouts: ours, and those of plug-ins."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

from shapeviz_report.database import LAYOUTS, Layout
from shapeviz_report.database.base import sorted_shapes
from shapeviz_report.plugins import Plugin, Unfit, guarded, require, with_plugins
from shapeviz_report.types import Database


class _Brought(Layout):
    """A layout of a plug-in."""

    def __init__(self, plugin: Plugin, layout: Layout) -> None:
        self.name = layout.name  # type: ignore[misc]
        self.description = layout.description  # type: ignore[misc]
        self._recognises = guarded(plugin, layout.recognises, lambda found, *_: bool(found))
        self._read = guarded(plugin, layout.read, _take)

    def recognises(self, path: Path, outside: bool) -> bool:
        return self._recognises(path, outside)

    def read(self, path: Path, outside: bool) -> Database:
        return self._read(path, outside)


def _take(found: Any, path: Path, outside: bool) -> Database:
    if not isinstance(found, Database):
        raise Unfit(f"what it gives is of the type {type(found).__name__}, not Database")
    for shape in found.shapes:
        told = (shape.id, shape.name, *shape.labels, *shape.labels.values(), *shape.metadata,
                *shape.metadata.values())  # fmt: skip
        if not (shape.id and all(isinstance(text, str) for text in told)):
            raise Unfit(f"of the shape {shape.id!r} the id, the name, a label or metadata is no text")
        if not isinstance(shape.path, Path):
            raise Unfit(f"the path of the shape {shape.id!r} is of the type {type(shape.path).__name__}")
    for shape_id, times in Counter(shape.id for shape in found.shapes).items():
        if times > 1:
            raise Unfit(f"{times:,} shapes have the id {shape_id!r}")
    return replace(found, shapes=sorted_shapes(found.shapes))


def _prepare(plugin: Plugin, layout: Layout) -> Layout:
    require(plugin, bool(layout.description), "it has no description")
    return _Brought(plugin, layout)


ALL_LAYOUTS = with_plugins("shapeviz_report.layouts", LAYOUTS, Layout, _prepare, first=True)
"""In the order in which they are tried. Those of plug-ins come first, for ours take any folder of meshes."""
