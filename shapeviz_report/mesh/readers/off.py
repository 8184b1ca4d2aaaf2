"""The Object File Format (Geomview), as the field's benchmarks use it and bend it."""

from __future__ import annotations

import re

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.paint import Paint, as_bytes
from shapeviz_report.mesh.readers.polygons import PolygonMesh, whole_numbers
from shapeviz_report.mesh.readers.text import decode, parse_columns, parse_numbers, strip_comments
from shapeviz_report.types import FloatArray

# ModelNet has headers such as "OFF1568 1546 0"; the keyword itself is optional by the format's definition
_HEADER = re.compile(r"\s*(?:(?P<prefix>(?:ST|[CN4])*)OFF\s*(?P<binary>BINARY)?)?", re.IGNORECASE)
_DIMENSIONS = re.compile(r"\s*(\d+)(?=\s)")
# the number of edges is often missing; it ends its line, or stands in one with the two others
_COUNTS = re.compile(r"\s*(\d+)\s+(\d+)(?:\s+\d+(?=\s*\n)|[ \t]+\d+(?=\s))?(?=\s|$)")


def read_off(data: bytes) -> PolygonMesh:
    """Read OFF: also with a glued header, comments, polygons, colours, normals and texture coordinates.

    Raises
    ------
    MeshError, ValueError
        If it is anything else.
    """
    text = strip_comments(decode(data))
    header = _HEADER.match(text)
    assert header is not None  # it matches the empty string
    prefix, end = header["prefix"] or "", header.end()
    if header["binary"]:
        raise MeshError("it is a binary OFF file; only the text form is read")
    if "4" in prefix:
        raise MeshError("its vertices have four coordinates (4OFF); export it in three dimensions")
    # a capital N is for normals, a small one for any number of dimensions; all in small letters, it is for normals
    if "n" in prefix and not header[0].strip().islower():
        dimensions = _DIMENSIONS.match(text, end)
        if dimensions is None or int(dimensions[1]) != 3:
            raise MeshError("it is an OFF file of other than three dimensions (nOFF)")
        end = dimensions.end()
    counts = _COUNTS.match(text, end)
    if counts is None:
        raise MeshError("it does not begin with OFF and the numbers of vertices and faces")
    vertex_count, face_count = int(counts[1]), int(counts[2])
    body = text[counts.end() :]
    lines = [line for line in body.split("\n") if line and not line.isspace()]
    if not prefix and (len(lines) != vertex_count + face_count):
        stream = _read_stream(parse_numbers(body), vertex_count, face_count)
        return stream or _read_lines(lines, vertex_count, face_count, prefix)
    return _read_triangles(body, vertex_count, face_count) or _read_lines(
        lines, vertex_count, face_count, prefix
    )


def _read_triangles(body: str, vertex_count: int, face_count: int) -> PolygonMesh | None:
    """The quick way, for plain triangles; None if there is more to it."""
    numbers = parse_numbers(body)
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


def _read_stream(numbers: FloatArray, vertex_count: int, face_count: int) -> PolygonMesh | None:
    """Vertices and polygons however they are broken into lines; None if they do not end with the file."""
    if numbers.size < 3 * vertex_count + face_count:
        return None
    rest = numbers[3 * vertex_count :]
    values = rest.tolist()
    sizes: list[int] = []
    position = 0
    while len(sizes) < face_count and position < len(values):
        size = values[position]
        if not 0 <= size <= len(values) or size != int(size):
            return None
        sizes.append(int(size))
        position += 1 + int(size)
    if len(sizes) != face_count or position != len(values):
        return None
    counted = np.array(sizes, dtype=np.int64)
    return PolygonMesh(
        vertices=numbers[: 3 * vertex_count].reshape(-1, 3),
        corners=whole_numbers(np.delete(rest, np.cumsum(counted + 1) - counted - 1)),
        sizes=counted,
    )


def _read_lines(lines: list[str], vertex_count: int, face_count: int, prefix: str) -> PolygonMesh:
    """Line by line: what follows a vertex's position or a face's corners is colour and the like."""
    announced = f"it announces {vertex_count} vertices and {face_count} faces, and has"
    if len(lines) < vertex_count + face_count:
        raise MeshError(f"{announced} only {len(lines)} lines")
    if len(lines) > vertex_count + face_count:
        raise MeshError(f"{announced} {len(lines)} lines: its header is wrong, or something was appended")
    sizes: list[int] = []
    corners: list[str] = []
    rests: list[list[str]] = []
    for line in lines[vertex_count:]:
        size, *fields = line.split()
        number = float(size)
        if not (number.is_integer() and 0 <= number <= len(fields)):
            raise MeshError(f"a face announces {size} corners, but its line has {len(fields)}")
        sizes.append(int(number))
        corners.extend(fields[: sizes[-1]])
        rests.append(fields[sizes[-1] :])
    places = whole_numbers(parse_numbers(" ".join(corners)))
    counted = np.array(sizes, dtype=np.int64)

    def paint() -> Paint:
        if "C" in prefix.upper():
            # colours come after a vertex's position and its normal, if it has one
            first = 3 + 3 * ("N" in prefix.upper())
            texts = [line.split()[first : first + 3] for line in lines[:vertex_count]]
            return Paint(_read_colors(texts)[places])
        return Paint(np.repeat(_read_colors([rest[:3] for rest in rests]), counted, axis=0))

    painted = "C" in prefix.upper() or any(len(rest) >= 3 for rest in rests)
    return PolygonMesh(
        vertices=parse_columns("".join(f"{line}\n" for line in lines[:vertex_count]), 3),
        corners=places,
        sizes=counted,
        paint=paint if painted else None,
    )


def _read_colors(texts: list[list[str]]) -> npt.NDArray[np.uint8]:
    """Colours (n, 3), white where there is none."""
    there = np.array([len(text) == 3 for text in texts])
    colors = np.full((len(texts), 3), 255, np.uint8)
    colors[there] = as_bytes(np.array([text for text in texts if len(text) == 3], np.float64))
    return colors
