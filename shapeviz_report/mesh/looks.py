"""The files that a mesh's colours are in, beside it: materials and pictures.

They may be missing, too large or elsewhere without harm: then they are not among what is found, and the surface is
shown without them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path, PurePosixPath

from shapeviz_report.files import read_regular
from shapeviz_report.mesh.readers.gltf import list_pictures
from shapeviz_report.mesh.readers.mtl import list_materials, read_materials
from shapeviz_report.mesh.readers.packed import GLTF

MOST_BYTES = 2**26
"""Of all files together."""

MOST_FILES = 512


def collect_looks(folder: Path, root: Path, suffix: str, data: bytes) -> dict[str, bytes]:
    """The files of the colours of a mesh.

    Parameters
    ----------
    folder : Path
        Of the mesh file; names are relative to it.
    root : Path
        What the files must lie in, links resolved: nothing outside of it is opened.
    suffix : str
        Of the mesh file.
    data : bytes
        Its content.

    Returns
    -------
    dict of str to bytes
        By their names in the mesh or its materials, ``/`` between folders.
    """
    files: dict[str, bytes] = {}
    if suffix in GLTF:
        _add(files, folder, root, list_pictures(data))
    elif suffix == ".obj":
        _add(files, folder, root, list_materials(data))
        _add(files, folder, root, [name for text in list(files.values()) for name in _pictures(text)])
    return files


def _pictures(text: bytes) -> Iterator[str]:
    return (material.picture for material in read_materials(text).values() if material.picture)


def _add(files: dict[str, bytes], folder: Path, root: Path, names: Iterable[str]) -> None:
    for name in names:
        left = MOST_BYTES - sum(map(len, files.values()))
        path = PurePosixPath(name)
        if name in files or len(files) >= MOST_FILES or path.is_absolute() or ":" in name:
            continue
        try:
            if (folder / path).resolve().is_relative_to(root.resolve()):
                files[name] = read_regular(folder / path, left)
        except (
            OSError,
            RuntimeError,
            ValueError,
        ):  # not there, too large, a circle of links, or no name of a file
            continue
