"""COLLADA, by pycollada."""

from __future__ import annotations

import re
from io import BytesIO

from trimesh.exchange.dae import load_collada

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import PolygonMesh
from shapeviz_report.mesh.readers.scene import join_scene

_EXTERNAL_INSTANCE = re.compile(rb"""<instance_(?:geometry|node)\b[^>]*\burl\s*=\s*["'](?!\#)""")


def read_collada(data: bytes) -> PolygonMesh:
    """Read COLLADA. Raises ``MeshError``, or what its parser raises, if it is anything else."""
    _check_collada(data)
    return join_scene(load_collada(BytesIO(data)))


def _check_collada(data: bytes) -> None:
    """Refuse what COLLADA never needs, before a parser meets it that has no limits of its own."""
    text = data.replace(b"\0", b"")  # UTF-16 and UTF-32 as well
    if not text.lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n").startswith(b"<") or b"COLLADA" not in text:
        raise MeshError("it is not COLLADA")
    if b"<!DOCTYPE" in text:
        raise MeshError("it has a document type declaration, which COLLADA does not use")
    if _EXTERNAL_INSTANCE.search(text):
        raise MeshError("it refers to geometry in another file, which is not read")
