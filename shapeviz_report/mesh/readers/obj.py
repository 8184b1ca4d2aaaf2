"""Wavefront OBJ: its vertices and polygons. Materials, texture coordinates, normals are passed over.

Trimesh splits vertices where texture coordinates or materials change, and takes relative indices from the end
of the file instead of from where they stand; so OBJ is read here.
"""

from __future__ import annotations

import re

import numpy as np

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import PolygonMesh

_COMMENT = re.compile(r"#[^\n]*")
_TEXTURE_AND_NORMAL = re.compile(r"/\S*")


def read_obj(data: bytes) -> PolygonMesh:
    """Read OBJ.

    Raises
    ------
    MeshError, ValueError
        If a vertex or a face is not written as it should be.
    """
    text = data.decode("latin-1").replace("\r\n", "\n").replace("\r", "\n").replace("\\\n", " ")
    if "#" in text:
        text = _COMMENT.sub("", text)
    vertex_rows: list[str] = []
    face_rows: list[str] = []
    vertices_before: list[int] = []
    for line in text.split("\n"):
        keyword, _, row = line.strip().replace("\t", " ").partition(" ")
        if keyword == "v":
            vertex_rows.append(row)
        elif keyword in ("f", "fo"):
            face_rows.append(row)
            vertices_before.append(len(vertex_rows))
    bare_rows = _TEXTURE_AND_NORMAL.sub("", "\n".join(face_rows))
    sizes = np.array([len(row.split()) for row in bare_rows.split("\n")], dtype=np.int64)
    numbers = np.fromstring(bare_rows, dtype=np.int64, sep=" ")
    if not face_rows:
        sizes = sizes[:0]
    if numbers.size != sizes.sum():
        raise MeshError("a face refers to a vertex by something that is not a number")
    if (numbers == 0).any():
        raise MeshError("a face refers to vertex 0, but OBJ counts from 1")
    # -1 is the last vertex before the face
    relative = np.repeat(np.array(vertices_before, dtype=np.int64), sizes) + numbers
    return PolygonMesh(
        vertices=np.loadtxt(vertex_rows, usecols=(0, 1, 2), ndmin=2, comments=None)
        if vertex_rows
        else np.empty((0, 3)),
        corners=np.where(numbers > 0, numbers - 1, relative),
        sizes=sizes,
    )
