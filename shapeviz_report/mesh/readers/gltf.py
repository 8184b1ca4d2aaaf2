"""glTF, by trimesh: which other files it needs, and what of it can be read."""

from __future__ import annotations

import json
from collections.abc import Mapping
from io import BytesIO
from pathlib import PurePosixPath
from typing import Any
from urllib.parse import unquote, urlsplit

from trimesh.exchange.gltf import load_glb, load_gltf

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import PolygonMesh
from shapeviz_report.mesh.readers.scene import join_scene

_BINARY_MAGIC = b"glTF"
_COMPRESSIONS = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")
_TRIANGLE_FAN = 6


def read_gltf(data: bytes, files: Mapping[str, bytes], *, binary: bool) -> PolygonMesh:
    """Read glTF.

    Parameters
    ----------
    data : bytes
        The ``.gltf`` or (binary) ``.glb`` file.
    files : mapping of str to bytes
        Path below the file's folder -> content, for every file that :func:`buffer_files` names.
    binary : bool

    Raises
    ------
    MeshError, or what its parser raises, if it is anything else.
    """
    header = read_header(data, binary=binary)
    check(header)
    buffers = {uri: files[name] for uri, name in buffer_files(header).items()}
    load = load_glb if binary else load_gltf
    return join_scene(load(BytesIO(data), resolver=buffers, skip_materials=True))


def read_header(data: bytes, *, binary: bool) -> dict[str, Any]:
    """The JSON of a ``.gltf`` or (binary) ``.glb`` file. Raises ``MeshError`` if there is none."""
    if binary:
        if not data.startswith(_BINARY_MAGIC):
            raise MeshError("it is not binary glTF")
        length = int.from_bytes(data[12:16], "little")
        data = data[20 : 20 + length]
    try:
        header = json.loads(data)
    except json.JSONDecodeError as error:
        raise MeshError(f"it is not glTF, or cut off: its JSON is broken ({error})") from error
    except (UnicodeError, RecursionError) as error:
        raise MeshError("it is not glTF, or damaged: its JSON is broken") from error
    if not isinstance(header, dict):
        raise MeshError("it is not glTF: its JSON is not an object")
    return header


def buffer_files(header: Mapping[str, Any]) -> dict[str, str]:
    """The files that hold a glTF's geometry: URI, as it is written -> path below the file's folder. Embedded buffers
    need none.

    Raises
    ------
    MeshError
        If a buffer is not a file in the folder or below it. Nothing is ever fetched, and nothing outside the
        folder is opened, whatever a file asks for.
    """
    files = {}
    for buffer in header.get("buffers", []):
        uri = buffer.get("uri")
        if uri is None or uri.startswith("data:"):
            continue
        path = PurePosixPath(unquote(uri))
        if urlsplit(uri).scheme or urlsplit(uri).netloc or path.is_absolute() or ".." in path.parts:
            raise MeshError(f"it refers to {uri[:100]!r}, which is not a file in its own folder")
        files[uri] = path.as_posix()
    return files


def check(header: Mapping[str, Any]) -> None:
    """Refuse what trimesh would silently leave out or fill with zeros. Raises ``MeshError``."""
    for extension in header.get("extensionsRequired", []):
        if extension in _COMPRESSIONS:
            raise MeshError(f"its geometry is compressed with {extension}, which is not read")
    accessors = header.get("accessors", [])
    for mesh in header.get("meshes", []):
        for primitive in mesh["primitives"]:
            if primitive.get("mode") == _TRIANGLE_FAN:
                raise MeshError("it has triangle fans, which are not read")
            used = [primitive["attributes"]["POSITION"], primitive.get("indices")]
            for index in used:
                if index is not None and (
                    "sparse" in accessors[index] or "bufferView" not in accessors[index]
                ):
                    raise MeshError("its positions are sparse or compressed, which is not read")
