"""Wavefront OBJ: its vertices and polygons. Materials, texture coordinates, normals, lines and points are passed over.

Trimesh splits vertices where texture coordinates or materials change, and takes relative indices from the end
of the file instead of from where they stand; so OBJ is read here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import PolygonMesh, whole_numbers
from shapeviz_report.mesh.readers.text import (
    decode,
    not_numbers,
    parse_columns,
    parse_numbers,
    strip_comments,
)

_TEXTURE_AND_NORMAL = re.compile(r"/\S*")
_FREE_FORM = frozenset({"surf", "bzp", "bsp", "cdp"})
_OF_NUMBERS = frozenset(
    {
        "v",
        "vt",
        "vn",
        "vp",
        "f",
        "fo",
        "l",
        "p",
        "s",
        "curv",
        "curv2",
        "parm",
        "trim",
        "hole",
        "scrv",
        "sp",
        "con",
    }
    | {"bmat", "deg", "step", "cstype", "cdc", "res", "lod", "mg", "ctech", "stech", "end"}
)
_INDEX_OR_NUMBER = re.compile(r"[-+.\d][-+.\de/]*", re.IGNORECASE)


def read_obj(data: bytes) -> PolygonMesh:
    """Read OBJ.

    Raises
    ------
    MeshError, ValueError
        If a vertex or a face is not written as it should be, or there is geometry that is not read.
    """
    vertex_rows: list[str] = []
    face_rows: list[str] = []
    vertices_before: list[int] = []
    for line in _lines(strip_comments(decode(data))):
        keyword, _, row = line.strip().replace("\t", " ").partition(" ")
        if keyword == "v":
            vertex_rows.append(row)
        elif keyword == "f":
            face_rows.append(row)
            vertices_before.append(len(vertex_rows))
        elif keyword not in ("vt", "vn", ""):
            keyword = keyword.lower()
            if keyword == "v":
                vertex_rows.append(row)
            elif keyword in ("f", "fo"):
                face_rows.append(row)
                vertices_before.append(len(vertex_rows))
            else:
                _check_passed_over(keyword, line)
    bare_rows = _TEXTURE_AND_NORMAL.sub("", "\n".join(face_rows))
    sizes = np.array([len(row.split()) for row in bare_rows.split("\n")], dtype=np.int64)
    if not face_rows:
        sizes = sizes[:0]
    numbers = whole_numbers(parse_numbers(bare_rows))
    if numbers.size != sizes.sum():
        raise not_numbers(bare_rows)
    if (numbers == 0).any():
        raise MeshError("a face refers to vertex 0, but OBJ counts from 1")
    # -1 is the last vertex before the face
    relative = np.repeat(np.array(vertices_before, dtype=np.int64), sizes) + numbers
    return PolygonMesh(
        vertices=parse_columns(vertex_rows, 3),
        corners=np.where(numbers > 0, numbers - 1, relative),
        sizes=sizes,
    )


def _lines(text: str) -> Iterator[str] | list[str]:
    """The lines, those that a backslash continues in one; a name may end with a backslash and continues nothing."""
    return _continued(text.split("\n")) if "\\" in text else text.split("\n")


def _continued(lines: list[str]) -> Iterator[str]:
    begun = ""
    for following in lines:
        line = begun + following
        bare = line.rstrip()
        begun = ""
        if bare.endswith("\\") and bare.split(maxsplit=1)[0].lower() in _OF_NUMBERS:
            begun = bare[:-1] + " "
        else:
            yield line
    yield begun


def _check_passed_over(keyword: str, line: str) -> None:
    """Refuse geometry that is not read. Raises ``MeshError``."""
    if keyword in _FREE_FORM:
        raise MeshError(f"it has free-form surfaces ({keyword}), which are not read; export it as polygons")
    if keyword == "call":
        raise MeshError(f"it refers to another file, which is not read: {line.strip()[:60]!r}")
    if keyword not in _OF_NUMBERS:
        words = line.split()
        if _INDEX_OR_NUMBER.fullmatch(keyword):
            words.insert(0, "")
        if len(words) > 3 and all(_INDEX_OR_NUMBER.fullmatch(word) for word in words[1:]):
            if keyword in ("g", "o", "usemtl", "mtllib", "usemap", "maplib", "csh"):
                return
            raise MeshError(f"it has a line of numbers that OBJ does not know: {line.strip()[:60]!r}")
