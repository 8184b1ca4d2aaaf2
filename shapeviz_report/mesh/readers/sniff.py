"""What a file is by its first bytes, for the owner of one whose suffix says something else."""

from __future__ import annotations

import re

from shapeviz_report.mesh.readers.text import decode

_SIGNATURES = (
    (
        b"version https://git-lfs.github.com/",
        "a Git LFS pointer, not the file itself; fetch it with 'git lfs pull'",
    ),
    (b"\x1f\x8b", "compressed with gzip; unpack it first"),
    (b"BZh", "compressed with bzip2; unpack it first"),
    (b"\xfd7zXZ\0", "compressed with xz; unpack it first"),
    (b"\x28\xb5\x2f\xfd", "compressed with Zstandard; unpack it first"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive; unpack it first"),
    (b"Rar!", "a RAR archive; unpack it first"),
    (b"glTF", "binary glTF"),
    (b"Kaydara FBX", "FBX"),
    (b"BLENDER", "a Blender file"),
    (b"#binvox", "binvox"),
    (b"ISO-10303-21", "STEP"),
    (b"PXR-USDC", "USD"),
    (b"#usda", "USD"),
    (b"#VRML", "VRML"),
    (b"DRACO", "Draco"),
    (b"%PDF", "a PDF document"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
)
_TEXTS = (
    (re.compile(r"(?:<!doctype html|<html)"), "a web page, perhaps the error page of a download"),
    (re.compile(r"<\?xml.{0,2000}?<collada\b|<collada\b", re.DOTALL), "COLLADA"),
    (re.compile(r"<\?xml.{0,2000}?<x3d\b|<x3d\b", re.DOTALL), "X3D"),
    (re.compile(r"<\?xml.{0,2000}?<amf\b|<amf\b", re.DOTALL), "AMF"),
    (re.compile(r"ply[ \t]*\n"), "PLY"),
    (re.compile(r"(?:st)?c?n?off\b"), "OFF"),
    (re.compile(r"solid\b[^\n]*\n?\s*facet\s+normal\b"), "STL"),
    (re.compile(r"\{\s*\"(?:[^{]|\{)*?\"(?:asset|meshes|accessors)\""), "glTF"),
    (re.compile(r"(?:(?:#[^\n]*|mtllib[^\n]*|[og][ \t][^\n]*)?\n)*v[ \t]+[-+.\d]"), "OBJ"),
)


def what_it_seems(data: bytes) -> str | None:
    """The format, or what else it is, in words that follow "it seems to be"; None if nothing tells."""
    for signature, name in _SIGNATURES:
        if data.startswith(signature):
            return name
    if data.startswith(b"PK\x03\x04"):
        return "3MF" if b"3D/" in data or b"3d/" in data else "a ZIP archive; unpack it first"
    if len(data) >= 84 and len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        return "STL"
    text = decode(data[:8192]).lstrip().lower()
    return next((name for pattern, name in _TEXTS if pattern.match(text)), None)
