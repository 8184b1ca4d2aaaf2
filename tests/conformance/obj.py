"""Wavefront OBJ: polygonal geometry, and the free-form statements that are none."""

from __future__ import annotations

import codecs

from conformance.cases import BOX, BOX_QUADS, BOX_TRIANGLES, TWO_BOXES, Case, box
from conformance.off import VERTICES

V = [f"v {vertex}" for vertex in VERTICES]
F = ["f " + " ".join(str(corner + 1) for corner in face) for face in BOX_QUADS]
PLAIN = "\n".join([*V, *F, ""])


def faces(pattern: str) -> list[str]:
    """The box's sides, every corner (counted from 1) written by a pattern."""
    return ["f " + " ".join(pattern.format(corner + 1) for corner in face) for face in BOX_QUADS]


def text(*lines: str) -> str:
    return "\n".join([*lines, ""])


def reads(name: str, content: str | bytes) -> Case:
    data = content.encode("latin-1") if isinstance(content, str) else content
    return Case(name, "mesh.obj", {"mesh.obj": data}, 52, 24, BOX, 1)


def refuses(name: str, content: str, reason: str) -> Case:
    return Case(name, "mesh.obj", {"mesh.obj": content.encode("latin-1")}, refused=reason)


def with_lines(*lines: str) -> str:
    """The box with lines between vertices and faces."""
    return text(*V, *lines, *F)


TWO = text(*V, *F, *(f"v {x + 10:g} {y:g} {z:g}" for x, y, z in box()), *(
    "f " + " ".join(str(corner - 8) for corner in face) for face in BOX_QUADS))  # fmt: skip
STRAIGHT = text(
    "v 0 0 0", "v 1 0 0", "v 2 0 0", "v 2 2 0", "v 0 2 0", "v 0 0 2", "v 1 0 2", "v 2 0 2", "v 2 2 2", "v 0 2 2",
    "f 5 4 3 2 1", "f 6 7 8 9 10", "f 1 2 7 6", "f 2 3 8 7", "f 3 4 9 8", "f 4 5 10 9", "f 5 1 6 10",
)  # fmt: skip
L_SHAPE = text(
    *(f"v {x} {y} {z}" for z in (0, 1) for x, y in ((0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3))),
    "f 6 5 4 3 2 1", "f 7 8 9 10 11 12",
    *(f"f {a + 1} {b + 1} {b + 7} {a + 7}" for a, b in ((0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0))),
)  # fmt: skip

CASES = [
    reads("polygons", PLAIN),
    reads("triangles", text(*V, *("f " + " ".join(str(corner + 1) for corner in face) for face in BOX_TRIANGLES))),
    reads("texture coordinates", text(*V, "vt 0 0", *faces("{}/1"))),
    reads("normals", text(*V, "vn 0 0 1", *faces("{}//1"))),
    reads("texture coordinates and normals", text(*V, "vt 0 0 0", "vn 0 0 1", *faces("{}/1/1"))),
    reads("colours of vertices", text(*(f"{v} 0.5 0.25 1" for v in V), *F)),
    reads("weights of vertices", text(*(f"{v} 1.0" for v in V), *F)),
    Case("indices from the end", "mesh.obj", {"mesh.obj": TWO.encode()}, 104, 48, TWO_BOXES, 2),
    reads("faces before their vertices", text(*F, *V)),
    reads("lines continued by a backslash", PLAIN.replace("f 1 2", "f 1 \\\n 2 \\\r\n")),
    reads("names that end with a backslash", text("mtllib C:\\looks\\", *V, "o C:\\parts\\", *F)),
    reads("comments that end with a backslash", text("# C:\\parts\\", *V, *F)),
    reads("comments behind values", text(*(f"{v} # corner" for v in V), *(f"{f}# side" for f in F))),
    reads("groups, objects and smoothing", with_lines("g a b", "o 1 2 3", "s 1", "s off", "mg 1 0.5", "g")),
    reads("names of any characters", with_lines("o \xff\xa0 v 0 0 0", "g f 1 2 3", "usemtl #1")),
    reads("materials", "mtllib none.mtl\n" + with_lines("usemtl red", "usemap x", "maplib y", "d_interp on", "lod 2")),
    reads("lines and points", with_lines("l 1 2 3", "l 1/1 2/2", "p 1 2 3")),
    reads("curves", with_lines("cstype bezier", "deg 3", "curv 0 1 1 2 3 4", "parm u 0 1", "end", "vp 0 1")),
    reads("faces of two corners", with_lines("f 1 2")),
    reads("faces as fo", text(*V, *(f.replace("f", "fo") for f in F))),
    reads("keywords in capitals", PLAIN.upper()),
    reads("repeated corners", PLAIN.replace("f 1 2 4 3", "f 1 1 2 4 3 1")),
    reads("indented lines", PLAIN.replace("\n", "\n \t")),
    reads("vertices that no face uses", with_lines("v 9 9 9")),
    reads("vertices without a value that no face uses", with_lines("v -nan(ind) nan(snan) 1.#QNAN", "v 1.#INF -1.#IND inf")),
    reads("Fortran's exponents", PLAIN.replace("v 2", "v 0.2D+01")),
    reads("byte order mark", codecs.BOM_UTF8 + PLAIN.encode()),
    reads("byte order mark and vertices that no face uses", codecs.BOM_UTF8 + text(*V, *F, "v 9 9 9").encode()),
    reads("UTF-16", PLAIN.encode("utf-16")),
    reads("lines ended by CR", PLAIN.replace("\n", "\r")),
    reads("lines ended by CR LF", PLAIN.replace("\n", "\r\n")),
    reads("commands", with_lines("csh touch here")),
    Case("polygons that begin at a straight corner", "mesh.obj", {"mesh.obj": STRAIGHT.encode()}, 24, 8, (2, 2, 2), 1),
    Case("concave polygons", "mesh.obj", {"mesh.obj": L_SHAPE.encode()}, 22, 5, (3, 3, 1), 1),
    refuses("free-form surfaces", with_lines("cstype bspline", "deg 1 1", "surf 0 1 0 1 1 2 3 4", "end"), "free-form"),
    refuses("patches of old versions", with_lines("bzp 1 2 3 4 5 6 7 8 1 2 3 4 5 6 7 8"), "free-form"),
    refuses("geometry in another file", with_lines("call other.obj"), "another file"),
    refuses("lines of numbers without a keyword", with_lines("vertex 1 2 3"), "does not know"),
    refuses("decimal commas", PLAIN.replace("v 2 3", "v 2,0 3"), "decimal comma"),
    refuses("vertices of two coordinates", PLAIN.replace("v 2 3 4", "v 2 3"), "fewer than 3"),
    refuses("vertex 0", PLAIN.replace("f 1 2", "f 0 2"), "counts from 1"),
    refuses("corners without a vertex", PLAIN.replace("f 1 2 ", "f 1 2 /2 "), "'/2'"),
    refuses("index of no vertex", PLAIN.replace("f 1 2", "f 9 2"), "vertex 8 "),
]  # fmt: skip
