"""OFF, as Geomview defines it and as benchmarks bend it."""

from __future__ import annotations

import codecs

from conformance.cases import BOX, BOX_QUADS, BOX_TRIANGLES, Case, box

VERTICES = [" ".join(f"{value:g}" for value in corner) for corner in box()]
TRIANGLES = ["3 " + " ".join(map(str, face)) for face in BOX_TRIANGLES]
QUADS = ["4 " + " ".join(map(str, face)) for face in BOX_QUADS]
PLAIN = "\n".join(["OFF", "8 12 18", *VERTICES, *TRIANGLES, ""])


def text(header: str, vertices: list[str], faces: list[str]) -> str:
    return "\n".join([header, *vertices, *faces, ""])


def reads(name: str, content: str | bytes) -> Case:
    data = content.encode("latin-1") if isinstance(content, str) else content
    return Case(name, "mesh.off", {"mesh.off": data}, 52, 24, BOX, 1)


def refuses(name: str, content: str, reason: str) -> Case:
    return Case(name, "mesh.off", {"mesh.off": content.encode("latin-1")}, refused=reason)


CASES = [
    reads("triangles", PLAIN),
    reads("polygons", text("OFF\n8 6 0", VERTICES, QUADS)),
    reads("triangles and polygons", text("OFF\n8 7 0", VERTICES, [*QUADS[1:], *TRIANGLES[:2]])),
    reads("faces of two corners", text("OFF\n8 13 0", VERTICES, [*TRIANGLES, "2 0 7"])),
    reads("colours of faces", text("OFF\n8 12 0", VERTICES, [f"{face} 255 0 0" for face in TRIANGLES])),
    reads("colours of some faces", text("OFF\n8 6 0", VERTICES, [QUADS[0] + " 0.5 0 0 1", *QUADS[1:]])),
    reads("COFF: colours of vertices", text("COFF\n8 12 0", [f"{v} 0 0 255 255" for v in VERTICES], TRIANGLES)),
    reads("NOFF: normals", text("NOFF\n8 12 0", [f"{v} 0 0 1" for v in VERTICES], TRIANGLES)),
    reads("CNOFF: normals and colours", text("CNOFF\n8 6 0", [f"{v} 0 0 1 255 0 0 255" for v in VERTICES], QUADS)),
    reads("NCOFF, in small letters", text("ncoff\n8 6 0", [f"{v} 0 0 1 1 0 0 1" for v in VERTICES], QUADS)),
    reads("nOFF of three dimensions", text("nOFF\n3\n8 12 0", VERTICES, TRIANGLES)),
    reads("colours of faces as one number", text("OFF 8 6 12", VERTICES, [f"{face} 3" for face in QUADS])),
    reads("numbers of corners as 4.0", text("OFF\n8 6 0", VERTICES, [face.replace("4", "4.0", 1) + " 1" for face in QUADS])),
    reads("STOFF: texture coordinates", text("STOFF\n8 12 0", [f"{v} 0 1" for v in VERTICES], TRIANGLES)),
    reads("keyword glued to the counts", text("OFF8 12 18", VERTICES, TRIANGLES)),
    reads("keyword in small letters", PLAIN.lower()),
    reads("keyword missing", PLAIN.removeprefix("OFF\n")),
    reads("number of edges missing", text("OFF\n8 12", VERTICES, TRIANGLES)),
    reads("counts on three lines", text("OFF\n8\n12\n18", VERTICES, TRIANGLES)),
    reads("comments and empty lines", text("# a box\nOFF # it is\n\n8 12 0", [*VERTICES, "", "# faces"], TRIANGLES)),
    reads("all on one line", PLAIN.replace("\n", " ")),
    reads("faces broken into lines", PLAIN.replace(" ", "\n")),
    reads("polygons broken into lines", text("OFF\n8 6 0", VERTICES, [face.replace(" ", "\n") for face in QUADS])),
    reads("byte order mark", codecs.BOM_UTF8 + PLAIN.encode()),
    reads("UTF-16", PLAIN.encode("utf-16")),
    reads("UTF-16 without a mark", PLAIN.encode("utf-16-be")),
    reads("UTF-32", PLAIN.encode("utf-32")),
    reads("lines ended by CR", PLAIN.replace("\n", "\r")),
    reads("lines ended by CR LF", PLAIN.replace("\n", "\r\n")),
    reads("tabs and form feeds", PLAIN.replace(" ", "\t").replace("\n3\t", "\f\n3\t")),
    reads("NULs at the end", PLAIN + "\0" * 8),
    reads("Fortran's exponents", text("OFF\n8 12 0", [v.replace("4", "0.4D+01") for v in VERTICES], TRIANGLES)),
    reads("vertices without a value that no face uses", text("OFF\n9 12 0", [*VERTICES, "-1.#IND nan(0x1) -nan"], TRIANGLES)),
    refuses("4OFF: four coordinates", text("4OFF\n8 12 0", [f"{v} 1" for v in VERTICES], TRIANGLES), "four coordinates"),
    refuses("nOFF of other dimensions", text("nOFF 4\n8 12 0", [f"{v} 1" for v in VERTICES], TRIANGLES), "three dimensions"),
    refuses("OFF BINARY", "OFF BINARY\n\0\0\0\x08", "binary OFF"),
    refuses("decimal commas", text("OFF\n8 12 0", [v.replace("3", "3,0") for v in VERTICES], TRIANGLES), "decimal comma"),
    refuses("cut off", PLAIN[:-20], "lines"),
    refuses("more lines than announced", PLAIN + "3 0 1 2\n", "21 lines"),
    refuses("counts that no file could hold", PLAIN.replace("8 12", "8 999999999999"), "only 20 lines"),
    refuses("index of no vertex", PLAIN.replace("3 0 1 3", "3 0 1 8"), "vertex 8 "),
]  # fmt: skip
