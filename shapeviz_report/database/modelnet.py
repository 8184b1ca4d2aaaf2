"""ModelNet: class folders that are split into training and test shapes."""

from __future__ import annotations

from pathlib import Path

from shapeviz_report.database.base import Layout, database_name, shape_ids, shape_names, sorted_shapes
from shapeviz_report.database.folder import MeshFile, scan_folder
from shapeviz_report.database.text import clean
from shapeviz_report.errors import DatabaseError
from shapeviz_report.types import Database, ShapeEntry

SPLITS = ("train", "test")


class ModelNet(Layout):
    """``CLASS/{train,test}/*.off``: the top folder is the class, the split is metadata."""

    name = "modelnet"
    description = "class folders split into training and test shapes: CLASS/train/*.off, CLASS/test/*.off"

    def recognises(self, path: Path, outside: bool) -> bool:
        if not path.is_dir():
            return False
        files = scan_folder(path, outside).files
        return bool(files) and all(_is_split(file) for file in files)

    def read(self, path: Path, outside: bool) -> Database:
        found = scan_folder(path, outside)
        for file in found.files:
            if not _is_split(file):
                raise DatabaseError(
                    f"{file.path} is not in a folder CLASS/train or CLASS/test below {path}, as the layout "
                    f"'{self.name}' has it. Move it there, or choose the layout 'class-folders'."
                )
        ids = shape_ids([file.relative for file in found.files])
        return Database(
            name=database_name(path),
            root=path,
            layout=self.name,
            shapes=sorted_shapes(
                ShapeEntry(
                    id,
                    file.path,
                    name,
                    labels={"class": clean(file.folders[0])},
                    metadata={"split": file.folders[1].lower()},
                )
                for id, name, file in zip(ids, shape_names(ids), found.files)
            ),
            labelings=("class",) if found.files else (),
            failures=found.failures,
        )


def _is_split(file: MeshFile) -> bool:
    folders = file.folders
    return len(folders) > 1 and bool(clean(folders[0])) and folders[1].lower() in SPLITS
