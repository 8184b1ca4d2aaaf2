"""One folder a class, the layout that most databases come in."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from shapeviz_report.database.base import Layout, database_name, shape_ids, shape_names, sorted_shapes
from shapeviz_report.database.folder import scan_folder
from shapeviz_report.database.text import clean
from shapeviz_report.types import Database, ShapeEntry


class ClassFolders(Layout):
    """``CLASS/*.off``: the top folder is the class.

    Deeper folders (``CLASS/SUB/*.off``) make a second, finer labeling ``folder`` whose classes are written
    ``CLASS/SUB`` and have a hierarchy, unless they merely hold one shape each. A mesh beside the class
    folders has no label.
    """

    name = "class-folders"
    description = "one folder a class: CLASS/*.off"

    def recognises(self, path: Path, outside: bool) -> bool:
        return path.is_dir() and any("/" in found for found in scan_folder(path, outside).paths)

    def read(self, path: Path, outside: bool) -> Database:
        found = scan_folder(path, outside)
        folders = [tuple(clean(folder) for folder in file.folders) for file in found.files]
        labels = [{"class": parts[0]} if parts and parts[0] else {} for parts in folders]
        parents: dict[str, str] = {}
        if _deeper_folders_group(folders):
            for label, parts in zip(labels, folders):
                if parts:
                    label["folder"] = "/".join(parts)
                for depth in range(2, len(parts) + 1):
                    parents["/".join(parts[:depth])] = "/".join(parts[: depth - 1])
        ids = shape_ids([file.relative for file in found.files])
        return Database(
            name=database_name(path),
            root=path,
            layout=self.name,
            shapes=sorted_shapes(
                ShapeEntry(id, file.path, name, label)
                for id, name, file, label in zip(ids, shape_names(ids), found.files, labels)
            ),
            labelings=tuple(name for name in ("class", "folder") if any(name in label for label in labels)),
            parents={"folder": parents} if parents else {},
            failures=found.failures,
        )


def _deeper_folders_group(folders: Sequence[tuple[str, ...]]) -> bool:
    """Whether folders below the class folders say more than which file is which.

    Many databases give every shape a folder of its own (``CLASS/0017/model.obj``): those are no classes.
    Deeper folders count as such when they hold two shapes or more on average.
    """
    deeper = [parts for parts in folders if len(parts) > 1]
    return bool(deeper) and len(deeper) >= 2 * len(set(deeper))
