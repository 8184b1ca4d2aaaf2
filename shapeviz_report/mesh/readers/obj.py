"""Wavefront OBJ: its vertices and polygons, and the colours of vertices or materials. Normals, lines and points are
passed over.

Trimesh splits vertices where texture coordinates or materials change, and takes relative indices from the end
of the file instead of from where they stand; so OBJ is read here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.paint import MISSING, Paint, Pictures, as_bytes
from shapeviz_report.mesh.readers.mtl import WHITE, Material, list_libraries, plain_name, read_materials
from shapeviz_report.mesh.readers.polygons import Indices, PolygonMesh
from shapeviz_report.mesh.readers.text import (
    Characters,
    count_words,
    decode,
    not_numbers,
    parse_columns,
    parse_indices,
    strip_comments,
)

Mask = npt.NDArray[np.bool_]

_USE = re.compile(r"usemtl[^\n]*")
_HASH = "\x01"
"""What stands for ``#`` in names of materials while comments are taken off."""
_CONTINUED = re.compile(r"\\[ \t]*\n")
_TEXTURE_AND_NORMAL = re.compile(r"(?<=\d)/\S*")
_POINTED = re.compile(r"[^\s/]+(?:/([-+]?\d+))?\S*")
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


def read_obj(data: bytes, files: Mapping[str, bytes]) -> PolygonMesh:
    """Read OBJ.

    Parameters
    ----------
    data : bytes
    files : mapping of str to bytes
        By the names in it: those of its materials and pictures that were found.

    Raises
    ------
    MeshError, ValueError
        If a vertex or a face is not written as it should be, or there is geometry that is not read.
    """
    text = _USE.sub(lambda use: use[0].replace("#", _HASH), decode(data))
    text = _join_continued(strip_comments(text)) + "\n"
    characters = np.frombuffer(bytearray(text, "latin-1", "replace"), np.uint8)
    ends = np.flatnonzero(characters == ord("\n"))
    starts = np.concatenate([[0], ends[:-1] + 1])
    is_vertex, is_face = _find_rows(text, characters, starts, ends)
    lengths = ends + 1 - starts
    vertex_rows, face_rows = (
        characters[np.repeat(is_row, lengths)].tobytes().decode("latin-1") for is_row in (is_vertex, is_face)
    )
    pointed = face_rows
    if "/" in face_rows:
        face_rows = _TEXTURE_AND_NORMAL.sub("", face_rows)
    numbers, sizes = parse_indices(face_rows), count_words(face_rows)
    if numbers.size != sizes.sum():
        raise not_numbers(face_rows)
    if (numbers == 0).any():
        raise MeshError("a face refers to vertex 0, but OBJ counts from 1")
    # -1 is the last vertex before the face
    relative = np.repeat(np.cumsum(is_vertex)[is_face], sizes) + numbers
    corners = np.where(numbers > 0, numbers - 1, relative)

    def paint() -> Paint:
        found = _paint_materials(lines, libraries, np.flatnonzero(is_face), pointed, sizes, files)
        # some programs write a material that says nothing beside the colours of vertices
        return (
            replace(_paint_vertices(vertex_rows, corners), lost=found.lost)
            if of_vertices and found.is_plain
            else found
        )

    lines = _Lines(text, starts, ends)
    libraries = list_libraries(data)
    width = count_words(vertex_rows[: vertex_rows.find("\n") + 1])
    of_vertices = len(width) == 1 and width[0] in (6, 7)
    painted = bool(libraries) or of_vertices
    return PolygonMesh(
        vertices=parse_columns(vertex_rows, 3), corners=corners, sizes=sizes, paint=paint if painted else None
    )


@dataclass(frozen=True)
class _Lines:
    """Where the lines of a text are."""

    text: str
    starts: Indices
    ends: Indices

    def find(self, keyword: str) -> Iterator[tuple[int, str]]:
        """Number and rest of the lines that begin so."""
        pattern = re.compile(rf"^[ \t]*{keyword}(?:[ \t]+(.*))?$", re.MULTILINE | re.IGNORECASE)
        for match in pattern.finditer(self.text):
            yield int(np.searchsorted(self.ends, match.start())), (match[1] or "").strip()


def _paint_vertices(rows: str, corners: Indices) -> Paint:
    """Colours that stand behind the positions of vertices, as parts of 1; some programs write them up to 255."""
    return Paint(as_bytes(parse_columns(rows, 6)[:, 3:])[corners])


def _paint_materials(
    lines: _Lines,
    libraries: Sequence[Sequence[str]],
    faces: Indices,
    rows: str,
    sizes: Indices,
    files: Mapping[str, bytes],
) -> Paint:
    """The colours and pictures of materials, by the corners of faces: the numbers of their lines, the lines without
    their keyword, and the numbers of their corners."""
    materials: dict[str, Material] = {}
    for name in (name for names in libraries for name in names):
        materials |= read_materials(files.get(name, b""), name)
    uses = [(line, plain_name(rest.replace(_HASH, "#"))) for line, rest in lines.find("usemtl")]
    uses.insert(0, (-1, ""))
    of_face = np.searchsorted([line for line, _ in uses], faces) - 1
    used = [materials.get(name, WHITE) for _, name in uses]
    colors = np.array([material.color for material in used])[of_face]
    found = Pictures()
    for names in libraries:
        if files.keys().isdisjoint(names):
            found.lose(names[0], MISSING)
    if materials:
        for _, name in (uses[use] for use in np.unique(of_face) if uses[use][1] not in ("", *materials)):
            found.lose(name, "is a material that its files of materials do not have")
    places_of = [
        found.place(name, name, partial(files.get, name), (material.wrap, material.wrap))
        if (name := material.picture)
        else -1
        for material in used
    ]
    if not found.images:
        return Paint(np.repeat(colors, sizes, axis=0), lost=tuple(found.lost))
    pictures = np.repeat(np.array(places_of, np.int16)[of_face], sizes)
    scales, offsets = (
        np.repeat(np.array(how)[of_face], sizes, axis=0)
        for how in ([material.scale for material in used], [material.offset for material in used])
    )
    written = list(lines.find("vt"))
    points = np.array([[float(word) for word in [*rest.split(), "0", "0"][:2]] for _, rest in written])
    before = np.searchsorted([line for line, _ in written], np.repeat(faces, sizes))
    told = np.array([int(match[1] or 0) for match in _POINTED.finditer(rows)], np.int64)
    # -1 is the last before the face, and 0 here none
    index = np.where(told < 0, before + told, told - 1)
    there = (index >= 0) & (index < len(points))
    places = np.zeros((len(index), 2), np.float32)
    places[there] = (points[index[there]] * scales[there] + offsets[there]) * [1, -1] + [0, 1]
    called = {place: material.picture for place, material in zip(places_of, used, strict=True)}
    for place in np.setdiff1d(pictures, [-1, *pictures[there]]).tolist():
        found.miss_places(called[place])
    pictures = np.where(there, pictures, np.int16(-1))
    return Paint(np.repeat(colors, sizes, axis=0), places, pictures, tuple(found.images), tuple(found.lost))


def _find_rows(text: str, characters: Characters, starts: Indices, ends: Indices) -> tuple[Mask, Mask]:
    """Which lines, of given starts and ends, are vertices and which are faces; their keywords become blanks.

    Lines as most programs write them are told by their first two characters, all at once; the others one by one.
    """
    first, second = characters[starts], characters[np.minimum(starts + 1, ends)]
    of_vertex, blank = first == ord("v"), (second == ord(" ")) | (second == ord("\t"))
    is_vertex, is_face = of_vertex & blank, (first == ord("f")) & blank
    passed_over = of_vertex & ((second == ord("t")) | (second == ord("n"))) | (starts == ends)
    characters[starts[is_vertex | is_face]] = ord(" ")
    for index in np.flatnonzero(~(is_vertex | is_face | passed_over)).tolist():
        line = text[starts[index] : ends[index]]
        keyword = next(iter(line.split(maxsplit=1)), "")
        place = starts[index] + line.index(keyword)
        match keyword.lower():
            case "v":
                is_vertex[index] = True
                characters[place] = ord(" ")
            case "f" | "fo":
                is_face[index] = True
                characters[place : place + len(keyword)] = ord(" ")
            case "" | "vt" | "vn":
                pass
            case other:
                _check_passed_over(other, line)
    return is_vertex, is_face


def _join_continued(text: str) -> str:
    """Lines that a backslash continues in one; a name may end with a backslash and continues nothing."""
    return "\n".join(_continued(text.split("\n"))) if _CONTINUED.search(text) else text


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
