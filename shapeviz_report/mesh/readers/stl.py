"""STL, text and binary, by trimesh."""

from __future__ import annotations

from io import BytesIO

from trimesh.exchange.stl import load_stl

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import PolygonMesh
from shapeviz_report.mesh.readers.scene import join_scene


def read_stl(data: bytes) -> PolygonMesh:
    """Read STL. Raises ``MeshError``, or what its parser raises, if it is anything else."""
    return join_scene(load_stl(BytesIO(_decoded_stl(data))))


def _decoded_stl(data: bytes) -> bytes:
    """A binary STL as it is; a text STL, of which only names can be other than ASCII, as UTF-8."""
    if len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        return data
    if b"facet" not in data.lower():
        raise MeshError(
            "it is neither text STL, nor binary STL of the length that it announces; it may be cut off"
        )
    return data.decode("latin-1").encode()
