"""STL, text and binary, and the colours of facets of the latter.

Trimesh drops what follows the last ``endsolid`` of a text, and takes any three vertices for a triangle; so STL is read
here.
"""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.paint import Paint
from shapeviz_report.mesh.readers.limits import check_faces
from shapeviz_report.mesh.readers.polygons import Indices, PolygonMesh
from shapeviz_report.mesh.readers.text import decode, parse_numbers
from shapeviz_report.types import FloatArray

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER_SIZE = 84
_FLAG = 0x8000
"""The first bit of what is left free in a facet."""
_MAGICS = re.compile(rb"COLOR=(...)", re.DOTALL)
_FACET = re.compile(r"\bfacet\s+normal\s+[-+.\dni]")
# Numbers in the place of keywords, so that one pass reads all; near the largest double, where no coordinate is.
_FACET_MARK, _VERTEX_MARK = "9e307", "8e307"


def read_stl(data: bytes) -> PolygonMesh:
    """Read STL.

    Raises
    ------
    MeshError
        If it is cut off, or announces other than it has.
    """
    if len(data) == _HEADER_SIZE + _RECORD.itemsize * _announced(data):
        return _read_binary(data)
    if decode(data[:65536]).lstrip()[:5].lower() in ("solid", "facet"):
        text = decode(data).lower()
        if _FACET.search(text) or "endsolid" in text:
            return _read_text(text)
    return _read_binary(data)


def _announced(data: bytes) -> int:
    return int.from_bytes(data[80:84], "little")


def _read_binary(data: bytes) -> PolygonMesh:
    """Triangles of a binary STL. What follows them is passed over, unless it may be triangles too."""
    count = _announced(data)
    rest = data[_HEADER_SIZE + _RECORD.itemsize * count :]
    whole = (len(data) - _HEADER_SIZE) // _RECORD.itemsize
    if len(data) < _HEADER_SIZE or len(data) < _HEADER_SIZE + _RECORD.itemsize * count:
        raise MeshError(
            "it is neither text STL, nor binary STL of the length that it announces; it may be cut off"
            + (f" (it announces {count:,} triangles, and has {whole:,})" if whole > 0 else "")
        )
    if rest.strip(b"\0"):
        if len(rest) % _RECORD.itemsize == 0:
            raise MeshError(f"it announces {count:,} triangles, and has {whole:,}; export it anew")
        if len(rest) >= _HEADER_SIZE and len(rest) == _HEADER_SIZE + _RECORD.itemsize * _announced(rest):
            raise MeshError("a second STL file follows in it, which is not read; store the two as one mesh")
    check_faces(count)
    records = np.frombuffer(data, _RECORD, count, _HEADER_SIZE)
    mesh = _separate(records["corners"].reshape(-1, 3).astype(np.float64), np.full(count, 3, dtype=np.int64))
    of_whole, words = _MAGICS.search(data, 0, 80), records["attribute"].copy()
    painted = of_whole is not None or (count > 0 and bool((words & _FLAG).all()))
    return replace(
        mesh, paint=partial(_paint, words, None if of_whole is None else of_whole[1]) if painted else None
    )


def _paint(words: npt.NDArray[np.uint16], whole: bytes | None) -> Paint:
    """Colours of facets in the 16 bits that the format leaves free.

    Where all have the first bit, they are colours as VisCAM and SolidView write them. Where the header names one of the
    whole, as Materialise Magics does, facets without that bit have one of their own; if none says anything, none has.

    Parameters
    ----------
    words : (m,) uint16 array
    whole : bytes or None
        Red, green and blue of the whole.
    """
    red, green, blue = ((words >> shift & 31).astype(np.float64) * 255 / 31 for shift in (10, 5, 0))
    if whole is None:
        colors = np.column_stack([red, green, blue])
    else:
        own = (words & _FLAG == 0) & words.any()
        colors = np.where(own[:, None], np.column_stack([blue, green, red]), list(whole))
    return Paint(np.repeat(np.round(colors).astype(np.uint8), 3, axis=0))


def _read_text(text: str) -> PolygonMesh:
    """Polygons of a text STL in small letters: one a facet, of as many corners as it has vertices."""
    body, ended, rest = _strip_names(text)
    facets = body.count("facet") - body.count("endfacet")
    check_faces(facets)
    ends = body.count("endfacet")
    if facets != ends:
        raise MeshError(
            f"it is cut off, or a facet is not ended: it begins {facets:,} facets, and ends {ends:,}"
        )
    if (loops := body.count("endloop")) != facets:
        raise MeshError(f"it has {facets:,} facets, but ends {loops:,} loops of vertices")
    if ended and rest:
        raise MeshError(f"something else follows its last solid: {rest[:40]!r}")
    if not ended:
        raise MeshError("it may be cut off: its last solid does not end with 'endsolid'")
    for keyword, mark in (
        ("endfacet", ""),
        ("endloop", ""),
        ("facet", _FACET_MARK),
        ("normal", ""),
        ("outer", ""),
        ("loop", ""),
        ("vertex", _VERTEX_MARK),
    ):
        body = body.replace(keyword, mark)
    numbers = parse_numbers(body)
    starts = np.flatnonzero(numbers == float(_FACET_MARK))
    corners = np.flatnonzero(numbers == float(_VERTEX_MARK))
    # where the next keyword's number stands, behind each vertex
    behind = np.append(corners[1:], numbers.size)
    following = np.append(starts, numbers.size)[np.searchsorted(starts, corners)]
    if (np.minimum(behind, following) - corners != 4).any() or (
        len(corners) and (not len(starts) or corners[0] < starts[0])
    ):
        raise MeshError("a vertex of a facet has other than three coordinates")
    sizes = np.diff(np.append(np.searchsorted(corners, starts), len(corners)))
    if (sizes < 3).any():
        raise MeshError(f"a facet has {sizes.min()} vertices")
    return _separate(numbers[corners[:, None] + [1, 2, 3]], sizes)


def _strip_names(text: str) -> tuple[str, bool, str]:
    """The facets of all solids; whether the last is ended, and what follows it. A name may have any word in it."""
    pieces: list[str] = []
    position, ended = 0, True
    while (found := text.find("solid", position)) >= 0:
        closing = text.startswith("end", max(found - 3, position)) and found - 3 >= position
        start = found - 3 if closing else found
        end = text.find("\n", found)
        end = len(text) if end < 0 else end
        facet = _FACET.search(text, found, end)
        end = facet.start() if facet else end
        # "endsolid a solid b facet ..." on one line
        ended = closing and not facet
        pieces.append(text[position:start])
        position = end
    rest = text[position:]
    pieces.append(rest)
    if position == 0 or _FACET.search(rest):  # facets without a solid, at the beginning or behind the last
        return " ".join(pieces), position == 0, ""
    return " ".join(pieces), ended, rest.strip()


def _separate(vertices: FloatArray, sizes: Indices) -> PolygonMesh:
    """Polygons that share no vertex: STL knows none that are shared."""
    return PolygonMesh(vertices, np.arange(len(vertices), dtype=np.int64), sizes)
