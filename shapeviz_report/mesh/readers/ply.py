"""PLY, text and binary, with polygons of any size in one file.

Trimesh reads binary PLY only where all polygons have the same number of corners; so PLY is read here.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.paint import Paint, Pictures, as_bytes
from shapeviz_report.mesh.readers.polygons import Indices, PolygonMesh, whole_numbers
from shapeviz_report.mesh.readers.text import decode, in_utf8, parse_numbers, without_mark

Values = npt.NDArray[np.generic]
Column = tuple[Indices, Values]
"""What a property has in each row: the number of its values, and all values one after the other."""

_KINDS = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "int64": "i8", "uint64": "u8",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
_BYTE_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
_FIRST_LINE = re.compile(rb"ply[ \t]*(\r\n|\r|\n)", re.IGNORECASE)
_MOST_HEADER = 2**20
"""Bytes within which a header ends."""
_CORNER_NAMES = ("vertex_indices", "vertex_index")
_COLOR_NAMES = (("red", "green", "blue"), ("r", "g", "b"), ("diffuse_red", "diffuse_green", "diffuse_blue"))
_PLACE_NAMES = (("texture_u", "texture_v"), ("s", "t"), ("u", "v"))
_TEXTURE = re.compile(r"[ \t]*comment[ \t]+texturefile[ \t]+(.+)", re.IGNORECASE)
_STRIP_NAMES = ("tristrips", "tristrip")


@dataclass(frozen=True)
class Property:
    """A property of an element; ``count_kind`` is the type of a list's length, None where it is one value."""

    name: str
    kind: str
    count_kind: str | None


@dataclass(frozen=True)
class Element:
    """What a header says of one kind of row."""

    name: str
    count: int
    properties: list[Property] = field(default_factory=list)


@dataclass
class TextBody:
    """The numbers of a text PLY, from a position on."""

    numbers: npt.NDArray[np.float64]
    position: int = 0

    def take(self, kind: str, count: int) -> Values:
        """The next ``count`` values. Raises ``MeshError`` if there are not as many."""
        values = self.numbers[self.position : self.position + count]
        if count < 0 or values.size < count:
            raise MeshError("it ends before all of its elements; it is cut off")
        self.position += count
        return values

    def rest(self) -> int:
        """How many numbers are left."""
        return self.numbers.size - self.position

    def take_rows(self, columns: list[tuple[str, int]], count: int) -> list[Values]:
        """The next ``count`` rows of columns of a kind and a width, as one array (count, width) a column."""
        widths = [width for _, width in columns]
        rows = self.take("", count * sum(widths)).reshape(count, sum(widths))
        return np.split(rows, np.cumsum(widths)[:-1], axis=1)


@dataclass
class BinaryBody:
    """The bytes of a binary PLY, from a position on."""

    data: bytes
    order: str
    position: int = 0

    def take(self, kind: str, count: int) -> Values:
        """The next ``count`` values. Raises ``MeshError`` if there are not as many."""
        dtype = np.dtype(self.order + kind)
        end = self.position + count * dtype.itemsize
        if count < 0 or end > len(self.data):
            raise MeshError("it ends before all of its elements; it is cut off")
        values = np.frombuffer(self.data, dtype, count, self.position)
        self.position = end
        return values

    def rest(self) -> int:
        """How many bytes are left."""
        return len(self.data) - self.position

    def take_rows(self, columns: list[tuple[str, int]], count: int) -> list[Values]:
        """The next ``count`` rows of columns of a kind and a width, as one array (count, width) a column."""
        dtype = np.dtype([(str(i), self.order + kind, (width,)) for i, (kind, width) in enumerate(columns)])
        end = self.position + count * dtype.itemsize
        if end > len(self.data):
            raise MeshError("it ends before all of its elements; it is cut off")
        rows = np.frombuffer(self.data, dtype, count, self.position)
        self.position = end
        return [rows[name] for name in dtype.names or ()]


def read_ply(data: bytes, files: Mapping[str, bytes]) -> PolygonMesh:
    """Read PLY, text or binary of either byte order.

    Parameters
    ----------
    data : bytes
    files : mapping of str to bytes
        By the names that :func:`list_textures` gives: those of its pictures that were found.

    Raises
    ------
    MeshError, ValueError
        If the header cannot be followed, or the rest is not what it announces.
    """
    data = without_mark(data)
    header, start = _split_header(data)
    encoding, elements = _read_header(header)
    body: TextBody | BinaryBody
    if encoding == "ascii":
        body = TextBody(parse_numbers(decode(data[start:])))
    else:
        body = BinaryBody(data, _BYTE_ORDERS[encoding], start)
    contents: dict[str, dict[str, Column]] = {}
    for element in elements:
        if element.count and element.properties:
            begin = body.position
            contents[element.name] = _read_element(body, element)
            _check_rest(body, (body.position - begin) / element.count if element is elements[-1] else None)
    try:
        vertices = np.column_stack([contents["vertex"][axis][1] for axis in "xyz"]).astype(np.float64)
    except KeyError as error:
        raise MeshError("it has no vertices with x, y and z") from error
    polygons = [_polygons(contents["face"])] if "face" in contents else []
    polygons += [_strips(contents[name]) for name in _STRIP_NAMES if name in contents]
    if not polygons and "range_grid" in contents:
        raise MeshError("it is a range scan (range_grid) without faces, which is not read")
    for name in contents.keys() - {"vertex", "face", "range_grid", *_STRIP_NAMES}:
        if any(contents[name][key][0].max() > 2 for key in contents[name].keys() & set(_CORNER_NAMES)):
            raise MeshError(f"its element {name[:40]} lists corners of faces, which are not read")
    all_corners = np.concatenate([np.empty(0, np.int64), *(corners for _, corners in polygons)])
    all_sizes = np.concatenate([np.empty(0, np.int64), *(sizes for sizes, _ in polygons)])
    kinds = {listed.name: listed.kind for element in elements for listed in element.properties}

    of_vertices = _color_names(contents["vertex"])
    # strips have no faces whose colours there could be
    of_faces = _color_names(contents["face"]) if len(polygons) == 1 and "face" in contents else ()

    textures = _textures(header)

    def paint() -> Paint:
        found = Paint(np.full((len(all_corners), 3), 255, np.uint8))
        if of_vertices:
            found = Paint(_colors(contents["vertex"], of_vertices, kinds)[all_corners])
        # some programs write white vertices beside the colours of faces
        if of_faces and found.is_plain:
            found = Paint(np.repeat(_colors(contents["face"], of_faces, kinds), all_sizes, axis=0))
        face = contents.get("face", {}) if len(polygons) == 1 else {}
        return _with_pictures(found, textures, files, contents["vertex"], face, all_corners, all_sizes)

    painted = of_vertices or of_faces or textures
    return PolygonMesh(vertices, all_corners, all_sizes, paint=paint if painted else None)


def list_textures(data: bytes) -> list[str]:
    """The pictures that a PLY names; none of what has no header."""
    try:
        return _textures(_split_header(without_mark(data))[0])
    except MeshError:
        return []


def _textures(header: str) -> list[str]:
    """The pictures that comments name, as MeshLab writes them: others count them from 0."""
    found = (_TEXTURE.match(line) for line in header.split("\n"))
    return [in_utf8(match[1].strip()).replace("\\", "/") for match in found if match]


def _with_pictures(
    paint: Paint,
    names: Sequence[str],
    files: Mapping[str, bytes],
    vertex: dict[str, Column],
    face: dict[str, Column],
    corners: Indices,
    sizes: Indices,
) -> Paint:
    """A paint with pictures in place of its colours where there are some, at the places of corners of faces or else of
    vertices."""
    pictures = Pictures()
    numbers = [pictures.place(name, name, partial(files.get, name)) for name in names]
    if not pictures.images:
        return replace(paint, lost=tuple(pictures.lost))
    faces = np.repeat(np.arange(len(sizes)), sizes)
    places = np.full((len(corners), 2), np.nan)
    of_vertices = next((pair for pair in _PLACE_NAMES if vertex.keys() >= set(pair)), None)
    if "texcoord" in face:
        lengths, values = face["texcoord"]
        begins = np.cumsum(lengths) - lengths
        there = (lengths == 2 * sizes)[faces]
        first = (begins[faces] + 2 * (np.arange(len(corners)) - (np.cumsum(sizes) - sizes)[faces]))[there]
        places[there] = values[first[:, None] + [0, 1]]
    elif of_vertices is not None:
        places = np.column_stack([vertex[name][1] for name in of_vertices]).astype(np.float64)[corners]
    which = face["texnumber"][1].astype(np.int64)[faces] if "texnumber" in face else np.zeros_like(corners)
    used = np.isfinite(places).all(axis=1) & (which >= 0) & (which < len(names))
    shown = np.where(used, np.array(numbers, np.int16)[np.where(used, which, 0)], np.int16(-1))
    for number, name in enumerate(names):
        if numbers[number] >= 0 and numbers[number] not in shown:
            pictures.miss_places(name)
    return Paint(
        np.where((shown >= 0)[:, None], np.uint8(255), paint.colors),
        (np.where(used[:, None], places, 0) * [1, -1] + [0, 1]).astype(np.float32),
        shown,
        tuple(pictures.images),
        tuple(pictures.lost),
    )


def _color_names(columns: dict[str, Column]) -> tuple[str, ...]:
    """What the colours of an element are called: the first names that are there, if any."""
    return next((names for names in _COLOR_NAMES if columns.keys() >= set(names)), ())


def _colors(columns: dict[str, Column], names: Sequence[str], kinds: dict[str, str]) -> npt.NDArray[np.uint8]:
    """The colours (n, 3) of an element's rows."""
    bytes_only = kinds[names[0]] == "u1"
    return as_bytes(np.column_stack([columns[name][1] for name in names]), most=255 if bytes_only else None)


def _check_rest(body: TextBody | BinaryBody, row: float | None) -> None:
    """Refuse a file that goes on after its last element by what may be rows of it. Raises ``MeshError``."""
    rest = body.rest() if row else 0
    if row and rest and (isinstance(body, TextBody) or rest % row == 0):
        raise MeshError("it has more rows than its PLY header announces")


def _split_header(data: bytes) -> tuple[str, int]:
    """The header's text, and where what follows it begins.

    Lines may end in any way, but a line feed behind a header of lone carriage returns is a byte of the first row.
    """
    first = _FIRST_LINE.match(data)
    ends = rb"\r" if first and first[1] == b"\r" else rb"\r\n|\r|\n"
    end = re.compile(rb"[\r\n][ \t]*end_header[ \t]*(?:" + ends + rb"|\Z)", re.IGNORECASE).search(
        data, 0, _MOST_HEADER
    )
    if first is not None and end is None and len(data) > _MOST_HEADER:
        raise MeshError(f"its PLY header does not end within {_MOST_HEADER:,} bytes")
    if first is None or end is None:
        raise MeshError("it has no PLY header")
    return decode(data[: end.start()]), end.end()


def _polygons(face: dict[str, Column]) -> tuple[Indices, Indices]:
    """Sizes and corners of the element ``face``. Raises ``MeshError`` if it has none."""
    for name in _CORNER_NAMES:
        if name in face:
            sizes, corners = face[name]
            return sizes, whole_numbers(corners)
    raise MeshError(f"its faces have no list {_CORNER_NAMES[0]}, only {', '.join(face)[:100]}")


def _strips(strips: dict[str, Column]) -> tuple[Indices, Indices]:
    """Sizes and corners of the triangles of strips, each of which a negative number or the end of its list ends."""
    lengths, values = _polygons(strips)
    strip = np.repeat(np.arange(len(lengths)), lengths) * (len(values) + 1) + np.cumsum(values < 0)
    inside = values >= 0
    values, strip = values[inside], strip[inside]
    begins = np.flatnonzero(np.diff(strip, prepend=-1)) if len(strip) else np.empty(0, np.int64)
    place = np.arange(len(values)) - np.repeat(begins, np.diff(np.append(begins, len(values))))
    first = np.flatnonzero(strip[2:] == strip[:-2])
    odd = place[first] % 2 == 1
    # every second triangle of a strip is turned over
    triangles = values[np.stack([first + odd, first + 1 - odd, first + 2], axis=1)]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]  # the others only join strips
    return np.full(len(triangles), 3, np.int64), triangles.ravel()


def _read_header(header: str) -> tuple[str, list[Element]]:
    encoding = ""
    elements: list[Element] = []
    named: set[str] = set()
    for line in header.split("\n")[1:]:
        match line.lower().split():
            case ["format", name, *_]:
                encoding = name
            case ["element", name, _] if name in named:
                raise MeshError(f"its PLY header announces {name} twice")
            case ["element", name, count] if count.lstrip("-").isdecimal():
                elements.append(Element(name, int(count)))
                named.add(name)
            case ["property", "list", count_kind, kind, name] if (
                elements and {kind, count_kind} <= _KINDS.keys()
            ):
                elements[-1].properties.append(Property(name, _KINDS[kind], _KINDS[count_kind]))
            case ["property", kind, name] if elements and kind in _KINDS:
                elements[-1].properties.append(Property(name, _KINDS[kind], None))
            case ["comment" | "obj_info", *_] | []:
                pass
            case _:
                raise MeshError(f"its PLY header has a line that means nothing: {line.strip()[:60]!r}")
    if encoding != "ascii" and encoding not in _BYTE_ORDERS:
        raise MeshError(f"its PLY header names no known encoding, but {encoding!r}")
    if any(
        len({listed.name for listed in element.properties}) < len(element.properties) for element in elements
    ):
        raise MeshError("its PLY header announces a property twice")
    if any(element.count < 0 for element in elements):
        raise MeshError("its PLY header announces fewer than zero rows")
    return encoding, elements


def _read_element(body: TextBody | BinaryBody, element: Element) -> dict[str, Column]:
    """All rows of an element, property by property."""
    start = body.position
    columns: list[tuple[str, int]] = []
    for listed in element.properties:
        size = 1
        if listed.count_kind:
            size = _take_length(body, listed)
            columns.append((listed.count_kind, 1))
        columns.append((listed.kind, size))
        body.take(listed.kind, size)
    body.position = start
    try:
        return _equal_rows(body, element, columns)
    except MeshError:  # lists of different lengths, or the file is cut off: reading row by row tells
        body.position = start
        return _ragged_rows(body, element)


def _take_length(body: TextBody | BinaryBody, listed: Property) -> int:
    """How long the next list is. Raises ``MeshError`` if that is no number of entries."""
    length = float(body.take(str(listed.count_kind), 1)[0])
    if not (length >= 0 and length.is_integer()):
        raise MeshError(f"a list of {listed.name} announces {length:g} entries")
    return int(length)


def _equal_rows(
    body: TextBody | BinaryBody, element: Element, columns: list[tuple[str, int]]
) -> dict[str, Column]:
    """The quick way, for lists as long as in the first row. Raises ``MeshError`` if one is not."""
    rows = iter(zip(body.take_rows(columns, element.count), columns, strict=True))
    contents: dict[str, Column] = {}
    for listed in element.properties:
        counts, _ = next(rows) if listed.count_kind else (None, None)
        values, (_, width) = next(rows)
        if counts is not None and (counts != width).any():
            raise MeshError("its lists differ in length")
        contents[listed.name] = np.full(element.count, width, np.int64), values.ravel()
    return contents


def _ragged_rows(body: TextBody | BinaryBody, element: Element) -> dict[str, Column]:
    sizes: dict[str, list[int]] = {listed.name: [] for listed in element.properties}
    values: dict[str, list[Values]] = {listed.name: [] for listed in element.properties}
    for _ in range(element.count):
        for listed in element.properties:
            size = _take_length(body, listed) if listed.count_kind else 1
            sizes[listed.name].append(size)
            values[listed.name].append(body.take(listed.kind, size))
    return {name: (np.array(sizes[name], np.int64), np.concatenate(values[name])) for name in sizes}
