"""PLY, text and binary, with polygons of any size in one file.

Trimesh reads binary PLY only where all polygons have the same number of corners; so PLY is read here.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import Indices, PolygonMesh, whole_numbers

Values = npt.NDArray[np.generic]
Column = tuple[Indices, Values]
"""What a property has in each row: the number of its values, and all values one after the other."""

_KINDS = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "int64": "i8", "uint64": "u8",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
_BYTE_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
_END_OF_HEADER = re.compile(rb"[\r\n][ \t]*end_header[ \t]*(?:\r\n|\r|\n|$)")
_CORNER_NAMES = ("vertex_indices", "vertex_index")


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

    def take_rows(self, columns: list[tuple[str, int]], count: int) -> list[Values]:
        """The next ``count`` rows of columns of a kind and a width, as one array (count, width) a column."""
        dtype = np.dtype([(str(i), self.order + kind, (width,)) for i, (kind, width) in enumerate(columns)])
        end = self.position + count * dtype.itemsize
        if end > len(self.data):
            raise MeshError("it ends before all of its elements; it is cut off")
        rows = np.frombuffer(self.data, dtype, count, self.position)
        self.position = end
        return [rows[name] for name in dtype.names or ()]


def read_ply(data: bytes) -> PolygonMesh:
    """Read PLY, text or binary of either byte order.

    Raises
    ------
    MeshError, ValueError
        If the header cannot be followed, or the rest is not what it announces.
    """
    end = _END_OF_HEADER.search(data)
    if not data.startswith(b"ply") or end is None:
        raise MeshError("it has no PLY header")
    encoding, elements = _read_header(data[: end.start()].decode("latin-1"))
    body: TextBody | BinaryBody
    if encoding == "ascii":
        body = TextBody(np.fromstring(data[end.end() :].decode("latin-1"), sep=" "))
    else:
        body = BinaryBody(data, _BYTE_ORDERS[encoding], end.end())
    contents = {}
    for element in elements:
        if element.count and element.properties:
            contents[element.name] = _read_element(body, element)
    try:
        vertices = np.column_stack([contents["vertex"][axis][1] for axis in "xyz"]).astype(np.float64)
    except KeyError as error:
        raise MeshError("it has no vertices with x, y and z") from error
    faces = contents.get("face", {})
    for name in _CORNER_NAMES:
        if name in faces:
            sizes, corners = faces[name]
            return PolygonMesh(vertices, whole_numbers(corners), sizes)
    return PolygonMesh(vertices, np.empty(0, np.int64), np.empty(0, np.int64))


def _read_header(header: str) -> tuple[str, list[Element]]:
    encoding = ""
    elements: list[Element] = []
    for line in header.splitlines()[1:]:
        match line.split():
            case ["format", name, _]:
                encoding = name
            case ["element", name, count]:
                elements.append(Element(name, int(count)))
            case ["property", "list", count_kind, kind, name] if elements:
                elements[-1].properties.append(Property(name, _KINDS[kind], _KINDS[count_kind]))
            case ["property", kind, name] if elements:
                elements[-1].properties.append(Property(name, _KINDS[kind], None))
            case ["comment" | "obj_info", *_] | []:
                pass
            case _:
                raise MeshError(f"its PLY header has a line that means nothing: {line.strip()[:60]!r}")
    if encoding != "ascii" and encoding not in _BYTE_ORDERS:
        raise MeshError(f"its PLY header names no known encoding, but {encoding!r}")
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
            size = int(body.take(listed.count_kind, 1)[0])
            columns.append((listed.count_kind, 1))
        columns.append((listed.kind, size))
        body.take(listed.kind, size)
    body.position = start
    try:
        return _equal_rows(body, element, columns)
    except MeshError:  # lists of different lengths, or the file is cut off: reading row by row tells
        body.position = start
        return _ragged_rows(body, element)


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
            size = int(body.take(listed.count_kind, 1)[0]) if listed.count_kind else 1
            sizes[listed.name].append(size)
            values[listed.name].append(body.take(listed.kind, size))
    return {name: (np.array(sizes[name], np.int64), np.concatenate(values[name])) for name in sizes}
