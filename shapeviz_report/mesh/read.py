"""Reading one mesh file. Nothing is executed, fetched, or opened outside the mesh's own folder."""

from __future__ import annotations

import hashlib
import re
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from shapeviz_report.database.finder import Finder
from shapeviz_report.database.formats import PACKED, format_of, is_read, split_name, suffix_of, why_not_read
from shapeviz_report.errors import MeshError
from shapeviz_report.files import MOST_BYTES, TooLargeError, read_regular
from shapeviz_report.mesh.looks import collect_looks, read_beside
from shapeviz_report.mesh.packed import unpack
from shapeviz_report.mesh.paint import Paint
from shapeviz_report.mesh.readers import READERS, READERS_OF_SEVERAL
from shapeviz_report.mesh.readers.gltf import GLTF, list_buffers
from shapeviz_report.mesh.readers.limits import check_faces
from shapeviz_report.mesh.readers.polygons import PolygonMesh, check_indices, cut_corners
from shapeviz_report.mesh.readers.sniff import what_it_seems
from shapeviz_report.places import holds
from shapeviz_report.types import Mesh

_PLACE = re.compile(r"\b(?:line|row) \d")
"""What a parser says where it also names the place, which helps to find it."""


def read_mesh(path: Path) -> Mesh:
    """Read the triangles of a mesh file; see :func:`parse_mesh`.

    Parameters
    ----------
    path : Path
        A file with one of the suffixes in ``database.MESH_FORMATS``, in any case, packed or not.

    Raises
    ------
    MeshError
        With the reason, without the path: also if the file, or one that it refers to, cannot be opened.
    """
    return parse_mesh(collect_files(path))


def collect_files(path: Path, within: Path | None = None) -> dict[str, bytes]:
    """The content of all files that make up a mesh: the mesh file, and the buffers of a glTF, which a packed one has in
    it.

    Parameters
    ----------
    path : Path
        The mesh file.
    within : Path, optional
        A folder that it must lie in, links resolved.

    Returns
    -------
    dict of str to bytes
        By path relative to the mesh file's folder, the mesh file first.

    Raises
    ------
    MeshError
        If a file cannot be opened, or lies outside ``within``, or a buffer outside the mesh file's folder, links
        resolved.
    """
    if not is_read(path.name):
        raise MeshError(why_not_read(path.name))
    if within is not None and not path.resolve().is_relative_to(within.resolve()):
        raise MeshError(
            f"it lies outside the database's folder, at {path.resolve()}; copy it into the folder, or have such files "
            "read by --outside"
        )
    files = {path.name: _read_bytes(path)}
    if split_name(path.name)[1] in GLTF and files[path.name].strip():
        finder = Finder(path.parent, within=path.parent)
        left = MOST_BYTES - len(files[path.name])
        for name in list_buffers(files[path.name]):
            if name in files:
                continue
            buffer = finder.find(name) or path.parent / name
            if not holds(path.parent, buffer):
                raise MeshError(f"it refers to {name[:100]!r}, which is not a file in its own folder")
            files[name] = _read_bytes(buffer, left)
            left -= len(files[name])
    beside = read_beside(path.parent, within or path.parent)
    looks = collect_looks(split_name(path.name)[1], files[path.name], beside)
    return files | {name: content for name, content in looks.items() if name not in files}


def parse_mesh(files: Mapping[str, bytes]) -> Mesh:
    """The triangles of a mesh; see :func:`parse_painted`."""
    return parse_painted(files)[0]


def parse_painted(files: Mapping[str, bytes]) -> tuple[Mesh, Callable[[], Paint] | None]:
    """The triangles of a mesh, and what reads the colours of their corners (m, 3), if it has any.

    Polygons are triangulated, and the parts of a scene are put together where their transformations place
    them. Nothing else is done: no vertex is merged or removed, and nothing is validated except that every
    face refers to vertices that exist. Vertices that are not finite may occur; cleaning comes with preparing.

    Parameters
    ----------
    files : mapping of str to bytes
        As :func:`collect_files` finds them.

    Returns
    -------
    mesh : Mesh
        At least one face.
    paint : callable or None

    Raises
    ------
    MeshError
        With the reason, without the path: the file is empty, is of another format than its suffix says, is cut off or
        otherwise broken, has no faces, has faces without vertices, or too many.
    """
    name, data = next(iter(files.items()))
    if not data.strip():
        raise MeshError("the file is empty")
    if suffix_of(name) in PACKED:
        files = unpack(name, data)
        name, data = next(iter(files.items()))
        if not data.strip():
            raise MeshError("the file in it is empty")
    suffix, format = suffix_of(name), format_of(name)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            # numpy stops at text that is no number and only warns; half a mesh is not a mesh
            warnings.filterwarnings("error", message="string or file could not be read")
            polygons = _read_polygons(suffix, data, files)
            check_indices(polygons.vertices, polygons.corners)
            check_faces(int(np.maximum(polygons.sizes - 2, 0).sum()))
            vertices, triangles = polygons.vertices, cut_corners(polygons)
            faces = polygons.corners[triangles]
        if not len(faces):
            raise MeshError("it has vertices, but no faces" if len(vertices) else "it has no faces")
    except (MemoryError, ImportError):  # the machine's fault, not the file's
        raise
    except (
        Exception
    ) as error:  # a broken file can make a parser fail in any way; none of them may end a build
        seems = what_it_seems(data)
        if seems is not None and not seems.endswith(format):
            raise MeshError(f"it is not {format}, but seems to be {seems}") from error
        if isinstance(error, MeshError):
            raise
        raise MeshError(
            f"it is damaged, cut off, or not {format} at all{_explanation(error)}; "
            "open it in the program it comes from, and export it anew"
        ) from error
    mesh = Mesh(
        vertices=np.ascontiguousarray(vertices, dtype=np.float64),
        faces=np.ascontiguousarray(faces, np.int32),
        up=polygons.up,
    )
    paint = polygons.paint
    return mesh, None if paint is None else lambda: paint().of(triangles)


def content_hash(files: Mapping[str, bytes]) -> str:
    """SHA-256, in hexadecimal, of what :func:`collect_files` found: of one file, that of its content."""
    digest = hashlib.sha256()
    for content in files.values():
        digest.update(content)
    return digest.hexdigest()


def _read_polygons(suffix: str, data: bytes, files: Mapping[str, bytes]) -> PolygonMesh:
    if suffix in READERS_OF_SEVERAL:
        return READERS_OF_SEVERAL[suffix](data, files)
    return READERS[suffix](data)


def _explanation(error: Exception) -> str:
    """What a parser's exception tells the owner of a file; most speak of the parser's own insides."""
    if "string or file could not be read" in str(error):  # numpy's words; a warning in older versions
        return " (something else stands where a number belongs)"
    detail = " ".join(str(error).split()).rpartition("Error: ")[2]
    return f" ({detail[:200]})" if _PLACE.search(detail) else ""


def _read_bytes(path: Path, most: int = MOST_BYTES) -> bytes:
    try:
        return read_regular(path, most)
    except TooLargeError as error:
        raise MeshError(
            f"it is larger than {MOST_BYTES / 2**20:,.0f} MiB, all its files together; simplify it before it is "
            "exported"
        ) from error
    except OSError as error:
        raise MeshError(f"{path.name} cannot be opened: {error.strerror}") from error
