"""STL, text and binary."""

from __future__ import annotations

import codecs
import struct

import numpy as np
from conformance.cases import BOX, BOX_QUADS, BOX_TRIANGLES, TWO_BOXES, Case, box

from shapeviz_report.types import FloatArray


def binary(triangles: FloatArray, header: bytes = b"", count: int | None = None, attribute: int = 0) -> bytes:
    records = np.zeros(
        len(triangles), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
    )
    records["corners"], records["attribute"] = triangles, attribute
    return (
        header.ljust(80, b"\0")
        + struct.pack("<I", len(records) if count is None else count)
        + records.tobytes()
    )


def facets(polygons: FloatArray, normal: str = "0 0 0") -> str:
    return "".join(
        f"  facet normal {normal}\n    outer loop\n"
        + "".join(f"      vertex {x:g} {y:g} {z:g}\n" for x, y, z in polygon)
        + "    endloop\n  endfacet\n"
        for polygon in polygons
    )


ONE, OTHER = box()[BOX_TRIANGLES], box(10)[BOX_TRIANGLES]
FACETS = facets(ONE)
PLAIN = f"solid box\n{FACETS}endsolid box\n"
SECOND = f"solid other\n{facets(OTHER)}endsolid other\n"


def reads(name: str, content: str | bytes) -> Case:
    data = content.encode("latin-1") if isinstance(content, str) else content
    return Case(name, "mesh.stl", {"mesh.stl": data}, 52, 24, BOX, 1)


def reads_two(name: str, content: str) -> Case:
    return Case(name, "mesh.stl", {"mesh.stl": content.encode()}, 104, 48, TWO_BOXES, 2)


def refuses(name: str, content: str | bytes, reason: str) -> Case:
    data = content.encode("latin-1") if isinstance(content, str) else content
    return Case(name, "mesh.stl", {"mesh.stl": data}, refused=reason)


CASES = [
    reads("binary", binary(ONE)),
    reads("binary: header that begins with solid", binary(ONE, b"solid box")),
    reads("binary: header that looks like text", binary(ONE, b"solid box\nfacet normal 0 0 0")),
    reads("binary: colours of facets", binary(ONE, b"COLOR=\xff\0\0\xff", attribute=0x7C1F)),
    reads("binary: other bytes behind the triangles", binary(ONE) + b"made by hand"),
    reads("binary: padded with zeros", binary(ONE) + bytes(100)),
    refuses("binary: cut off", binary(ONE)[:-1], "cut off"),
    refuses("binary: cut off at a triangle's end", binary(ONE)[:-50], "announces 12 triangles, and has 11"),
    refuses("binary: announces fewer", binary(ONE + 1, count=11), "announces 11 triangles, and has 12"),
    refuses("binary: announces none", binary(ONE + 1, count=0, attribute=1), "announces 0 triangles, and has 12"),
    refuses("binary: announces more than a file can hold", binary(ONE, count=2**32 - 1), "announces 4,294,967,295"),
    refuses("binary: a second file behind the first", binary(ONE) + binary(OTHER), "second STL"),
    refuses("binary: cut off in the header", b"\0" * 60 + b"x", "cut off"),
    reads("text", PLAIN),
    reads("text: several solids of one box", f"solid a\n{facets(ONE[:6])}endsolid a\nsolid b\n{facets(ONE[6:])}endsolid b"),
    reads_two("text: several solids", PLAIN + SECOND),
    reads_two("text: solids of the same name, unnamed", (PLAIN + SECOND).replace(" box", "").replace(" other", "")),
    reads_two("text: a first solid that is not ended", PLAIN.replace("endsolid box\n", "") + SECOND),
    reads("text: polygons as facets", f"solid\n{facets(box()[BOX_QUADS])}endsolid"),
    reads("text: names with keywords", PLAIN.replace("box", "endfacet vertex 1 2 3 endsolid facet")),
    reads("text: names that are not ASCII", PLAIN.replace("box", "Fl\xfcgel \xa0")),
    reads("text: names over whole paths", PLAIN.replace("box", r"C:\solid\endsolid.stl")),
    reads("text: without a name", PLAIN.replace(" box", "")),
    reads("text: all on one line", PLAIN.replace("\n", " ")),
    reads_two("text: several solids on one line", (PLAIN + SECOND).replace("\n", " ")),
    reads("text: in capitals", PLAIN.upper()),
    reads("text: exponents", PLAIN.replace(" 2 ", " 2.0E+00 ").replace(" 3 ", " +.3e1 ")),
    reads("text: Fortran's exponents", PLAIN.replace(" 2 ", " 0.2D+01 ")),
    reads("text: normals without a value", f"solid\n{facets(ONE, 'nan -nan(ind) 1.#QNAN')}endsolid"),
    reads("text: tabs, empty lines, blanks", PLAIN.replace("  ", "\t").replace("\n", " \n\n")),
    reads("text: lines ended by CR", PLAIN.replace("\n", "\r")),
    reads("text: lines ended by CR LF", PLAIN.replace("\n", "\r\n")),
    reads("text: byte order mark", codecs.BOM_UTF8 + PLAIN.encode()),
    reads("text: UTF-16", PLAIN.encode("utf-16")),
    refuses("text: cut off in a facet", PLAIN[: len(PLAIN) // 2], "cut off"),
    refuses("text: last solid not ended", PLAIN.replace("endsolid box", ""), "endsolid"),
    refuses("text: second solid not ended", PLAIN + SECOND.replace("endsolid other", ""), "endsolid"),
    refuses("text: second solid cut off", PLAIN + SECOND[:300], "cut off"),
    reads("text: a name longer than what is looked at first", PLAIN.replace("solid box", "solid " + "box " * 20000, 1)),
    reads("text: a solid without facets among others", "solid none\nendsolid none\n" + PLAIN),
    reads("text: the mark at which DOS ends a text", PLAIN + "\x1a"),
    refuses("text: no facets at all", "solid OpenSCAD_Model\nendsolid OpenSCAD_Model\n", "it has no faces"),
    refuses("text: other words behind the last solid", PLAIN + "made by hand\n", "follows its last solid: 'made by hand'"),
    refuses("text: loops that are not ended", PLAIN.replace("endloop", "", 1), "ends 11 loops"),
    refuses("text: facets of two vertices", PLAIN.replace("      vertex 0 0 0\n", "", 1), "2 vertices"),
    refuses("text: vertices of two coordinates", PLAIN.replace("vertex 0 0 0", "vertex 0 0", 1), "three coordinates"),
    refuses("text: decimal commas", PLAIN.replace(" 2 ", " 2,0 "), "decimal comma"),
    refuses("text: words among numbers", PLAIN.replace("vertex 2", "vertex two"), "where a number belongs"),
]  # fmt: skip
