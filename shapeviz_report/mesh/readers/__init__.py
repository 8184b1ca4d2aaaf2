"""One reader a format of mesh files."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from shapeviz_report.mesh.readers.collada import read_collada
from shapeviz_report.mesh.readers.gltf import read_gltf
from shapeviz_report.mesh.readers.obj import read_obj
from shapeviz_report.mesh.readers.off import read_off
from shapeviz_report.mesh.readers.ply import read_ply
from shapeviz_report.mesh.readers.polygons import PolygonMesh
from shapeviz_report.mesh.readers.stl import read_stl
from shapeviz_report.mesh.readers.threemf import read_3mf

READERS: dict[str, Callable[[bytes], PolygonMesh]] = {
    ".off": read_off,
    ".stl": read_stl,
    ".3mf": read_3mf,
}
"""Suffix -> what reads the content of such a file. Those parts of which may be in other files have a signature of their
own."""

READERS_OF_SEVERAL: dict[str, Callable[[bytes, Mapping[str, bytes]], PolygonMesh]] = {
    ".obj": read_obj,
    ".ply": read_ply,
    ".dae": read_collada,
    ".gltf": read_gltf,
    ".glb": read_gltf,
}
"""Suffix -> what reads the content of such a file, and of others by their names in it."""
