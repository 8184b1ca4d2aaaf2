"""Reading one mesh file.

OFF, OBJ and PLY are read by modules of their own, which keep the file's vertices as they are and take
polygons of any size; STL, glTF, 3MF and COLLADA by trimesh. No reader executes anything, uses the network, or
opens a file outside the mesh's own folder.
"""

from __future__ import annotations

import hashlib
import logging
import re
import warnings
from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from trimesh.exchange.dae import load_collada
from trimesh.exchange.gltf import load_glb, load_gltf
from trimesh.exchange.stl import load_stl
from trimesh.exchange.threemf import load_3MF

from shapeviz_report.database.formats import MESH_FORMATS, suffix_of, why_not_read
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh import gltf
from shapeviz_report.mesh.obj import read_obj
from shapeviz_report.mesh.off import read_off
from shapeviz_report.mesh.ply import read_ply
from shapeviz_report.mesh.polygons import Indices, PolygonMesh, triangulate
from shapeviz_report.types import FloatArray, Mesh

_POLYGON_READERS: dict[str, Callable[[bytes], PolygonMesh]] = {
    ".off": read_off,
    ".obj": read_obj,
    ".ply": read_ply,
}
_PLACE = re.compile(r"\b(?:line|row) \d")
"""What a parser says where it also names the place, which helps to find it."""

# Trimesh logs tracebacks of what it takes for no error; without a handler they would go to the terminal.
logging.getLogger("trimesh").addHandler(logging.NullHandler())

_EXTERNAL_INSTANCE = re.compile(rb"""<instance_(?:geometry|node)\b[^>]*\burl\s*=\s*["'](?!\#)""")


def read_mesh(path: Path) -> Mesh:
    """Read the triangles of a mesh file.

    Polygons are triangulated, and the parts of a scene are put together where their transformations place
    them. Nothing else is done: no vertex is merged or removed, and nothing is validated except that every
    face refers to vertices that exist. Vertices that are not finite may occur; cleaning comes with preparing.

    Parameters
    ----------
    path : Path
        A file with one of the suffixes in ``database.MESH_FORMATS``, in any case.

    Returns
    -------
    Mesh
        At least one face.

    Raises
    ------
    MeshError
        With the reason, without the path: the file cannot be opened, is empty, is of another format than its
        suffix says, is cut off or otherwise broken, has no faces, or has faces without vertices.
    """
    suffix = suffix_of(path.name)
    if suffix not in MESH_FORMATS:
        raise MeshError(why_not_read(path.name))
    data = _read_bytes(path)
    if not data.strip():
        raise MeshError("the file is empty")
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            # numpy stops at text that is no number and only warns; half a mesh is not a mesh
            warnings.filterwarnings("error", message="string or file could not be read")
            if suffix in _POLYGON_READERS:
                polygons = _POLYGON_READERS[suffix](data)
                _check_indices(polygons.vertices, polygons.corners)
                vertices, faces = polygons.vertices, triangulate(polygons)
            else:
                vertices, faces = _read_scene(data, suffix, path)
    except MeshError:
        raise
    except (
        Exception
    ) as error:  # a broken file can make a parser fail in any way; none of them may end a build
        raise MeshError(
            f"it is damaged, cut off, or not {MESH_FORMATS[suffix]} at all{_explanation(error)}; "
            "open it in the program it comes from, and export it anew"
        ) from error
    if not len(faces):
        raise MeshError("it has vertices, but no faces" if len(vertices) else "it has no faces")
    return Mesh(
        vertices=np.ascontiguousarray(vertices, dtype=np.float64), faces=np.ascontiguousarray(faces, np.int32)
    )


def _explanation(error: Exception) -> str:
    """What a parser's exception tells the owner of a file; most speak of the parser's own insides."""
    if isinstance(error, MemoryError):
        return " (it announces more than fits into memory)"
    if "string or file could not be read" in str(error):  # numpy's words; a warning in older versions
        return " (something else stands where a number belongs)"
    detail = " ".join(str(error).split()).rpartition("Error: ")[2]
    return f" ({detail[:200]})" if _PLACE.search(detail) else ""


def collect_files(path: Path) -> dict[str, bytes]:
    """The content of all files that :func:`read_mesh` would read: the mesh file, and the buffers of a glTF.

    Returns
    -------
    dict of str to bytes
        By path relative to the mesh file's folder, the mesh file first. Written to another folder under these
        names, they are the same mesh.

    Raises
    ------
    MeshError
        If the file cannot be opened.
    """
    files = {path.name: _read_bytes(path)}
    if MESH_FORMATS.get(suffix_of(path.name)) == "glTF":
        try:
            header = gltf.read_header(files[path.name], binary=suffix_of(path.name) == ".glb")
            for buffer in gltf.buffer_files(header, path.parent).values():
                files[buffer.relative_to(path.parent.resolve()).as_posix()] = _read_bytes(buffer)
        except (
            Exception
        ):  # reading the mesh will say what is wrong with it; until then the file itself counts
            return {path.name: files[path.name]}
    return files


def content_hash(files: Mapping[str, bytes]) -> str:
    """SHA-256, in hexadecimal, of what :func:`collect_files` found: of one file, that of its content."""
    digest = hashlib.sha256()
    for content in files.values():
        digest.update(content)
    return digest.hexdigest()


def _read_bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise MeshError(f"{path.name} cannot be opened: {error.strerror}") from error


def _check_indices(vertices: FloatArray, indices: Indices) -> None:
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise MeshError("its vertices do not have three coordinates")
    if len(indices) and not (indices.min() >= 0 and indices.max() < len(vertices)):
        worst = indices.max() if indices.min() >= 0 else indices.min()
        raise MeshError(
            f"a face refers to vertex {worst} (counted from 0), but there are {len(vertices)} vertices"
        )


def _read_scene(data: bytes, suffix: str, path: Path) -> tuple[FloatArray, Indices]:
    """All triangles of a format that trimesh reads, where the scene places them."""
    contents = _load(data, suffix, path)
    parts = contents.get("geometry", {"mesh": contents})
    parts = {name: _bare(part) for name, part in parts.items() if "faces" in part}
    scene = trimesh.load_scene(
        {"geometry": parts, "graph": contents.get("graph"), "base_frame": contents.get("base_frame", "world")}
    )
    vertices: list[FloatArray] = [np.empty((0, 3))]
    faces: list[Indices] = [np.empty((0, 3), np.int64)]
    count = 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        if name in scene.geometry:
            part = scene.geometry[name]
            _check_indices(part.vertices, part.faces.ravel())
            vertices.append(trimesh.transform_points(part.vertices, transform))
            faces.append(part.faces + count)
            count += len(part.vertices)
    return np.concatenate(vertices), np.concatenate(faces)


def _bare(part: dict[str, Any]) -> dict[str, Any]:
    """The arguments of a ``Trimesh`` without its looks, and kept as it is."""
    return {"vertices": part["vertices"], "faces": part["faces"], "process": False}


def _load(data: bytes, suffix: str, path: Path) -> dict[str, Any]:
    """What trimesh's own loader makes of a file: the arguments of a scene or a mesh."""
    match suffix:
        case ".stl":
            return load_stl(BytesIO(_decoded_stl(data)))
        case ".3mf":
            return load_3MF(BytesIO(data))
        case ".dae":
            _check_collada(data)
            return load_collada(BytesIO(data))
        case _:
            binary = suffix == ".glb"
            header = gltf.read_header(data, binary=binary)
            gltf.check(header)
            buffers = {uri: _read_bytes(file) for uri, file in gltf.buffer_files(header, path.parent).items()}
            load = load_glb if binary else load_gltf
            return load(BytesIO(data), resolver=buffers, skip_materials=True)


def _decoded_stl(data: bytes) -> bytes:
    """A binary STL as it is; a text STL, of which only names can be other than ASCII, as UTF-8."""
    if len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        return data
    if b"facet" not in data.lower():
        raise MeshError(
            "it is neither text STL, nor binary STL of the length that it announces; it may be cut off"
        )
    return data.decode("latin-1").encode()


def _check_collada(data: bytes) -> None:
    """Refuse what COLLADA never needs, before a parser meets it that has no limits of its own."""
    text = data.replace(b"\0", b"")  # UTF-16 and UTF-32 as well
    if not text.lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n").startswith(b"<") or b"COLLADA" not in text:
        raise MeshError("it is not COLLADA")
    if b"<!DOCTYPE" in text:
        raise MeshError("it has a document type declaration, which COLLADA does not use")
    if _EXTERNAL_INSTANCE.search(text):
        raise MeshError("it refers to geometry in another file, which is not read")
