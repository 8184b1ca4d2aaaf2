"""Scenes of several parts, as trimesh's loaders describe them."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from typing import Any

import numpy as np
import trimesh

from shapeviz_report.mesh.readers.limits import check_faces
from shapeviz_report.mesh.readers.polygons import Indices, PolygonMesh, check_indices
from shapeviz_report.types import FloatArray

# Trimesh logs tracebacks of what it takes for no error; without a handler they would go to the terminal.
logging.getLogger("trimesh").addHandler(logging.NullHandler())


def join_scene(contents: Mapping[str, Any]) -> PolygonMesh:
    """All triangles of what one of trimesh's loaders gives, the arguments of a scene or a mesh, where the scene places
    them. Raises ``MeshError``."""
    parts = contents.get("geometry", {"mesh": contents})
    parts = {name: _bare(part) for name, part in parts.items() if "faces" in part}
    scene = trimesh.load_scene(
        {"geometry": parts, "graph": contents.get("graph"), "base_frame": contents.get("base_frame", "world")}
    )
    vertices: list[FloatArray] = [np.empty((0, 3))]
    faces: list[Indices] = [np.empty((0, 3), np.int64)]
    count = 0
    placed = [scene.graph[node][1] for node in scene.graph.nodes_geometry]
    check_faces(sum(len(scene.geometry[name].faces) for name in placed if name in scene.geometry))
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        if name in scene.geometry:
            part = scene.geometry[name]
            check_indices(part.vertices, part.faces.ravel())
            vertices.append(trimesh.transform_points(part.vertices, transform))
            faces.append(part.faces + count)
            count += len(part.vertices)
    return PolygonMesh.of_triangles(np.concatenate(vertices), np.concatenate(faces))


def _bare(part: dict[str, Any]) -> dict[str, Any]:
    """The arguments of a ``Trimesh`` without its looks, and kept as it is."""
    return {"vertices": part["vertices"], "faces": part["faces"], "process": False}
