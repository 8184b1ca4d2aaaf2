"""3MF, by trimesh."""

from __future__ import annotations

from io import BytesIO

from trimesh.exchange.threemf import load_3MF

from shapeviz_report.mesh.readers.polygons import PolygonMesh
from shapeviz_report.mesh.readers.scene import join_scene


def read_3mf(data: bytes) -> PolygonMesh:
    """Read 3MF. Raises ``MeshError``, or what its parser raises, if it is anything else."""
    return join_scene(load_3MF(BytesIO(data)))
