"""One reader a format of mesh files."""

from __future__ import annotations

from collections.abc import Callable

from shapeviz_report.mesh.readers.collada import read_collada
from shapeviz_report.mesh.readers.obj import read_obj
from shapeviz_report.mesh.readers.off import read_off
from shapeviz_report.mesh.readers.ply import read_ply
from shapeviz_report.mesh.readers.polygons import PolygonMesh
from shapeviz_report.mesh.readers.stl import read_stl
from shapeviz_report.mesh.readers.threemf import read_3mf

READERS: dict[str, Callable[[bytes], PolygonMesh]] = {
    ".off": read_off,
    ".obj": read_obj,
    ".ply": read_ply,
    ".stl": read_stl,
    ".3mf": read_3mf,
    ".dae": read_collada,
}
"""Suffix -> what reads the content of such a file. glTF, which may have its buffers in other files, has a signature of
its own: :func:`shapeviz_report.mesh.readers.gltf.read_gltf`."""
