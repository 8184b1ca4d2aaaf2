"""PLY, text and binary of either byte order."""

from __future__ import annotations

import codecs
import struct
from collections.abc import Sequence

from conformance.cases import BOX, BOX_QUADS, BOX_TRIANGLES, TWO_BOXES, Case, box

Row = Sequence[tuple[str, Sequence[float]]]
"""Of one element: struct's letter of a type, and the values of it."""

XYZ = "property float x\nproperty float y\nproperty float z\n"
LIST = "property list uchar int vertex_indices\n"
CORNERS: list[Row] = [[("f", corner)] for corner in box()]
TRIANGLES: list[Row] = [[("B", [3]), ("i", face)] for face in BOX_TRIANGLES]
QUADS: list[Row] = [[("B", [4]), ("i", face)] for face in BOX_QUADS]
MIXED: list[Row] = [*QUADS[1:], *TRIANGLES[:2]]


def ply(encoding: str, *elements: tuple[str, str, list[Row]], before: str = "") -> bytes:
    """A file of elements (name, properties, rows); what their headers say of the types is up to them."""
    header = f"ply\nformat {encoding} 1.0\n{before}"
    for name, properties, rows in elements:
        header += f"element {name} {len(rows)}\n{properties}"
    header += "end_header\n"
    rows = [row for _, _, rows in elements for row in rows]
    if encoding == "ascii":
        lines = [" ".join(f"{value:g}" for _, values in row for value in values) for row in rows]
        return (header + "\n".join(lines) + "\n").encode()
    order = "<" if "little" in encoding else ">"
    return header.encode() + b"".join(
        struct.pack(order + letter * len(values), *values) for row in rows for letter, values in row
    )


def strips(faces: Sequence[Sequence[int]]) -> list[Row]:
    values = [index for face in faces for index in (*face, -1)][:-1]
    return [[("i", [len(values)]), ("i", values)]]


def reads(name: str, content: bytes) -> Case:
    return Case(name, "mesh.ply", {"mesh.ply": content}, 52, 24, BOX, 1)


def refuses(name: str, content: bytes, reason: str) -> Case:
    return Case(name, "mesh.ply", {"mesh.ply": content}, refused=reason)


def vertices_of(kind: str, letter: str) -> tuple[str, str, list[Row]]:
    return "vertex", XYZ.replace("float", kind), [[(letter, [int(v) for v in c])] for c in box()]


def indices_of(count: str, kind: str, letters: str) -> tuple[str, str, list[Row]]:
    rows: list[Row] = [[(letters[0], [3]), (letters[1], face)] for face in BOX_TRIANGLES]
    return "face", LIST.replace("uchar int", f"{count} {kind}"), rows


VERTEX, FACE = ("vertex", XYZ, CORNERS), ("face", LIST, TRIANGLES)
ASCII, LITTLE, BIG = "ascii", "binary_little_endian", "binary_big_endian"
PLAIN, BINARY = ply(ASCII, VERTEX, FACE), ply(LITTLE, VERTEX, FACE)
STRIP_LIST = "property list int int vertex_indices\n"
LOOSE: list[Row] = [[("B", [2]), ("h", [7, 8])], [("B", [0])], [("B", [1]), ("h", [9])]]
TEXTURED = LIST + "property list uchar float texcoord\nproperty int texnumber\n"
UV = [0.5, 0.25, 1, 0, 0.125, 1]
STRIP_BOX = [[0, 1, 2, 3, 6, 7, 4, 5, 0, 1], [1, 5, 3, 7], [0, 2, 4, 6]]

CASES = [
    *(
        reads(f"{encoding}: {name}", ply(encoding, VERTEX, ("face", LIST, rows)))
        for encoding in (ASCII, LITTLE, BIG)
        for name, rows in (("triangles", TRIANGLES), ("polygons", QUADS), ("polygons of several sizes", MIXED))
    ),
    *(
        reads(f"coordinates of type {kind}", ply(BIG, vertices_of(kind, letter), FACE))
        for kind, letter in (("char", "b"), ("uint8", "B"), ("int16", "h"), ("ushort", "H"), ("int", "i"),
                             ("uint32", "I"), ("double", "d"), ("float64", "d"))
    ),
    *(
        reads(f"lists of types {count} and {kind}", ply(LITTLE, VERTEX, indices_of(count, kind, letters)))
        for count, kind, letters in (("int", "uint", "iI"), ("ushort", "ushort", "HH"), ("uint8", "uchar", "BB"),
                                     ("char", "short", "bh"), ("float", "float", "ff"), ("uint", "int64", "Iq"))
    ),
    *(
        reads(f"{encoding}: texture coordinates of faces", ply(encoding, VERTEX, ("face", TEXTURED, [
            [("B", [3]), ("i", face), ("B", [6]), ("f", UV), ("i", [0])] for face in BOX_TRIANGLES])))
        for encoding in (ASCII, LITTLE)
    ),
    *(
        reads(f"{encoding}: texture coordinates of some faces", ply(encoding, VERTEX, ("face", TEXTURED, [
            [("B", [3]), ("i", face), ("B", [6 * (i % 2)]), ("f", UV[: 6 * (i % 2)]), ("i", [0])]
            for i, face in enumerate(BOX_TRIANGLES)])))
        for encoding in (ASCII, LITTLE)
    ),
    reads("lists before the corners", ply(BIG, VERTEX, (
        "face", "property uchar flags\nproperty list uchar short more\n" + LIST,
        [[("B", [1]), ("B", [2]), ("h", [5, 6]), *row] for row in TRIANGLES]))),
    reads("colours and normals of vertices", ply(LITTLE, (
        "vertex", "property uchar red\n" + XYZ + "property float nx\n",
        [[("B", [255]), *row, ("f", [1])] for row in CORNERS]), FACE)),
    reads("vertex_index", PLAIN.replace(b"vertex_indices", b"vertex_index")),
    reads("faces before vertices", ply(LITTLE, FACE, VERTEX)),
    reads("unknown elements", ply(ASCII, ("note", "property list uchar short n\n", LOOSE), VERTEX, FACE)),
    reads("unknown elements in between, binary", ply(BIG, VERTEX, ("note", "property list uchar short n\n", LOOSE), FACE)),
    reads("edges", ply(ASCII, VERTEX, FACE, ("edge", "property int vertex1\nproperty int vertex2\n", [[("i", [0, 7])]]))),
    reads("triangle strips", ply(LITTLE, VERTEX, ("tristrips", STRIP_LIST, strips(STRIP_BOX)))),
    reads("triangle strips, text", ply(ASCII, VERTEX, ("tristrips", STRIP_LIST, strips(STRIP_BOX)))),
    reads("several rows of strips", ply(BIG, VERTEX, (
        "tristrips", STRIP_LIST, [row for strip in STRIP_BOX for row in strips([strip])]))),
    reads("strips of one triangle", ply(BIG, VERTEX, ("tristrips", STRIP_LIST, strips(BOX_TRIANGLES.tolist())))),
    reads("strips joined by triangles without area", ply(LITTLE, VERTEX, (
        "tristrips", STRIP_LIST, strips([[*STRIP_BOX[0], 1, 1, *STRIP_BOX[1]], STRIP_BOX[2]])))),
    Case("faces and strips", "mesh.ply", {"mesh.ply": ply(
        ASCII, ("vertex", XYZ, [*CORNERS, *([("f", corner)] for corner in box(10))]),
        ("face", LIST, QUADS), ("tristrips", STRIP_LIST, strips([[i + 8 for i in s] for s in STRIP_BOX]))),
    }, 104, 48, TWO_BOXES, 2),
    reads("comments and obj_info", ply(ASCII, VERTEX, FACE, before="comment element vertex 9\nobj_info a b\ncomment\n")),
    reads("keywords in capitals", PLAIN.upper()),
    reads("header with lines ended by CR LF, binary", BINARY.replace(b"\n", b"\r\n", 10)),
    reads("header with lines ended by CR, binary", BINARY.replace(b"\n", b"\r", 10)),
    reads("lines ended by CR LF, text", PLAIN.replace(b"\n", b"\r\n")),
    reads("byte order mark", codecs.BOM_UTF8 + PLAIN),
    reads("byte order mark, binary", codecs.BOM_UTF8 + BINARY),
    reads("UTF-16, text", PLAIN.decode().encode("utf-16")),
    reads("rows broken into lines, text", PLAIN.replace(b"end_header\n0 0 0\n", b"end_header\n0\n0 0 ")),
    reads("Fortran's exponents, text", PLAIN.replace(b"\n2 3 4", b"\n0.2D1 .3d+01 4")),
    reads("other bytes at the end, binary", BINARY + b"end"),
    refuses("indices that are not whole", PLAIN.replace(b"3 0 1 3", b"3 0 1.5 3"), "not whole"),
    refuses("index of no vertex", PLAIN.replace(b"3 0 1 3", b"3 0 8 3"), "vertex 8 "),
    refuses("cut off, text", PLAIN[:-8], "cut off"),
    refuses("cut off, binary", BINARY[:-1], "cut off"),
    refuses("more rows than announced, text", PLAIN.replace(b"face 12", b"face 11"), "more rows"),
    refuses("more rows than announced, binary", BINARY.replace(b"face 12", b"face 11"), "more rows"),
    refuses("counts that no file could hold", BINARY.replace(b"face 12", b"face 99999999999"), "cut off"),
    refuses("lists that no file could hold", ply(LITTLE, VERTEX, ("face", STRIP_LIST, [[("i", [2**31 - 1])]])), "cut off"),
    refuses("lists of fewer than no entries, text", PLAIN.replace(b"\n3 0 1 3", b"\n-3 0 1 3"), "announces -3 entries"),
    refuses("lists of fewer than no entries, binary", ply(LITTLE, VERTEX, ("face", STRIP_LIST, [[("i", [-1])]])), "announces -1 entries"),
    refuses("lists of no whole number of entries", PLAIN.replace(b"\n3 0 1 3", b"\n3.5 0 1 3"), r"announces 3\.5 entries"),
    refuses("corners in an element of another name", ply(ASCII, VERTEX, FACE, ("polygon", LIST, QUADS)), "element polygon"),
    refuses("types that are not known", PLAIN.replace(b"float x", b"half x"), "half x"),
    refuses("encodings that are not known", PLAIN.replace(b"ascii", b"morse"), "morse"),
    refuses("faces without corners", PLAIN.replace(b"vertex_indices", b"corners"), "no list vertex_indices"),
    refuses("an element twice", ply(ASCII, VERTEX, FACE, FACE), "face twice"),
    refuses("range scans", ply(ASCII, VERTEX, ("range_grid", LIST, TRIANGLES)), "range scan"),
    refuses("point clouds", ply(ASCII, VERTEX), "no faces"),
    refuses("decimal commas", PLAIN.replace(b"\n2 3 4", b"\n2,0 3 4"), "decimal comma"),
]  # fmt: skip
