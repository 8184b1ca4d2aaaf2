"""From a mesh file to the mesh that is measured: read, clean, remesh, normalise, check."""

from shapeviz_report.mesh.clean import clean
from shapeviz_report.mesh.prepare import deviation, normalise, prepare, read_paint
from shapeviz_report.mesh.read import collect_files, content_hash, parse_mesh, parse_painted, read_mesh
from shapeviz_report.mesh.remesh import remesh, surface_size

__all__ = [
    "clean",
    "collect_files",
    "content_hash",
    "deviation",
    "normalise",
    "parse_mesh",
    "parse_painted",
    "prepare",
    "read_mesh",
    "read_paint",
    "remesh",
    "surface_size",
]
