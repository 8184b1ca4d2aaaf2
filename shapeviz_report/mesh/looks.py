"""The files that a mesh's colours are in, beside it: materials and pictures.

They may be missing, too large or elsewhere without harm: then they are not among what is found, and the surface is
shown without them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from shapeviz_report.database.finder import Finder
from shapeviz_report.files import read_regular
from shapeviz_report.mesh.readers.collada import list_images
from shapeviz_report.mesh.readers.gltf import GLTF, list_pictures
from shapeviz_report.mesh.readers.limits import MOST_LOOKS
from shapeviz_report.mesh.readers.mtl import list_materials, read_materials
from shapeviz_report.mesh.readers.ply import list_textures

MOST_FILES = 1024
"""Names that are looked for."""

MOST_LETTERS = 1000
"""Of a name."""

MOST_PARTS = 3
"""Of the end of a name: folders, and the file in them."""

Read = Callable[[str, int], bytes | None]
"""Gives the content of a file by its name, if it is there and has no more than so many bytes."""


def collect_looks(suffix: str, data: bytes, read: Read) -> dict[str, bytes]:
    """The files of the colours of a mesh.

    Parameters
    ----------
    suffix : str
        Of the mesh file.
    data : bytes
        Its content.
    read : callable
        For names as they stand in the mesh, and ends of these, ``/`` between folders, none of them absolute.

    Returns
    -------
    dict of str to bytes
        By their names in the mesh or its materials.
    """
    files: dict[str, bytes] = {}
    if suffix in GLTF:
        _add(files, read, list_pictures(data))
    elif suffix == ".dae":
        _add(files, read, list_images(data))
    elif suffix == ".ply":
        _add(files, read, list_textures(data))
    elif suffix == ".obj":
        _add(files, read, list_materials(data))
        _add(files, read, (name for file, text in list(files.items()) for name in _pictures(text, file)))
    return files


def read_beside(folder: Path, root: Path) -> Read:
    """What reads files by their names in a mesh of a folder: none outside of ``root``, links resolved, is opened."""
    finder = Finder(folder, within=root)

    def read(name: str, most: int) -> bytes | None:
        try:
            found = finder.find(name)
            return None if found is None else read_regular(found, most)
        except (OSError, RuntimeError, ValueError):  # too large, a circle of links, or no name of a file
            return None

    return read


def _pictures(text: bytes, file: str) -> Iterator[str]:
    return (material.picture for material in read_materials(text, file).values() if material.picture)


def _add(files: dict[str, bytes], read: Read, names: Iterable[str]) -> None:
    tried: set[str] = set()
    for name in names:
        if name in tried or len(name) > MOST_LETTERS:
            continue
        if len(tried) == MOST_FILES:
            break
        tried.add(name)
        left = MOST_LOOKS - sum(map(len, files.values()))
        content = next((found for way in _ways(name) if (found := read(way, left)) is not None), None)
        if content is not None:
            files[name] = content


def _ways(name: str) -> Iterator[str]:
    """A name and its ends, as it stands and without percent signs: a file often lay elsewhere, or on another machine,
    when it was named, and lies beside the mesh now."""
    for written in dict.fromkeys((name, unquote(name))):
        if not PurePosixPath(written).is_absolute() and ":" not in written:
            yield written
        parts = [part for part in written.rpartition(":")[2].split("/") if part not in ("", ".", "..")]
        for count in range(min(len(parts), MOST_PARTS), 0, -1):
            yield "/".join(parts[-count:])
