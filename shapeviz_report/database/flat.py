"""A flat folder of meshes without labels."""

from __future__ import annotations

from pathlib import Path

from shapeviz_report.database.base import Layout, database_name, shape_ids, shape_names, sorted_shapes
from shapeviz_report.database.folder import scan_folder
from shapeviz_report.types import Database, ShapeEntry


class FlatFolder(Layout):
    """``*.off``: every mesh lies in the folder itself; there are no labels."""

    name = "flat"
    description = "a folder of meshes without labels: *.off"

    def recognises(self, path: Path, outside: bool) -> bool:
        return path.is_dir() and bool(scan_folder(path, outside).paths)

    def read(self, path: Path, outside: bool) -> Database:
        """Read it. Chosen by name, it also takes meshes in deeper folders, whatever those are called."""
        found = scan_folder(path, outside)
        ids = shape_ids([file.relative for file in found.files])
        return Database(
            name=database_name(path),
            root=path,
            layout=self.name,
            shapes=sorted_shapes(
                ShapeEntry(id, file.path, name) for id, name, file in zip(ids, shape_names(ids), found.files)
            ),
            failures=found.failures,
        )
