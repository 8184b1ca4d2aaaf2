"""The Object File Format (Geomview), as the field's benchmarks use it and bend it."""

from __future__ import annotations

import re

import numpy as np

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import PolygonMesh, whole_numbers

# ModelNet has headers such as "OFF1568 1546 0"; the keyword itself is optional by the format's definition
_HEADER = re.compile(r"\s*(?:(?:ST)?C?N?(?P<dimensions>4?n?)OFF\s*(?P<binary>BINARY)?)?")
# the number of edges is often missing
_COUNTS = re.compile(r"\s*(\d+)\s+(\d+)(?:\s+\d+(?=\s*\n))?")
_COMMENT = re.compile(r"#[^\n]*")


def read_off(data: bytes) -> PolygonMesh:
    """Read OFF: also with a glued header, comments, polygons, colours, normals and texture coordinates.

    Raises
    ------
    MeshError, ValueError
        If it is anything else.
    """
    text = data.decode("latin-1").replace("\r", "\n")
    if "#" in text:
        text = _COMMENT.sub("", text)
    header = _HEADER.match(text)
    assert header is not None  # it matches the empty string
    counts = _COUNTS.match(text, header.end())
    if header["dimensions"]:
        raise MeshError("it is an OFF file of other than three dimensions")
    if header["binary"]:
        raise MeshError("it is a binary OFF file; only the text form is read")
    if counts is None:
        raise MeshError("it does not begin with OFF and the numbers of vertices and faces")
    vertex_count, face_count = int(counts[1]), int(counts[2])
    body = text[counts.end() :]
    return _read_triangles(body, vertex_count, face_count) or _read_lines(body, vertex_count, face_count)


def _read_triangles(body: str, vertex_count: int, face_count: int) -> PolygonMesh | None:
    """The quick way, for plain triangles however they are broken into lines; None if there is more to it."""
    numbers = np.fromstring(body, sep=" ")
    if numbers.size != 3 * vertex_count + 4 * face_count:
        return None
    faces = numbers[3 * vertex_count :].reshape(-1, 4)
    if not (faces[:, 0] == 3).all():
        return None
    return PolygonMesh(
        vertices=numbers[: 3 * vertex_count].reshape(-1, 3),
        corners=whole_numbers(faces[:, 1:].ravel()),
        sizes=np.full(face_count, 3, dtype=np.int64),
    )


def _read_lines(body: str, vertex_count: int, face_count: int) -> PolygonMesh:
    """Line by line: what follows a vertex's position or a face's corners is colour and the like."""
    lines = [line for line in body.split("\n") if line and not line.isspace()]
    if len(lines) < vertex_count + face_count:
        raise MeshError(
            f"it announces {vertex_count} vertices and {face_count} faces, and has only {len(lines)} lines"
        )
    sizes: list[int] = []
    corners: list[str] = []
    for line in lines[vertex_count : vertex_count + face_count]:
        size, *fields = line.split()
        sizes.append(int(size))
        if not 0 <= sizes[-1] <= len(fields):
            raise MeshError(f"a face announces {size} corners, but its line has {len(fields)}")
        corners.extend(fields[: sizes[-1]])
    rows = lines[:vertex_count]
    return PolygonMesh(
        vertices=np.loadtxt(rows, usecols=(0, 1, 2), ndmin=2, comments=None) if rows else np.empty((0, 3)),
        corners=np.array(corners, dtype=np.int64),
        sizes=np.array(sizes, dtype=np.int64),
    )
