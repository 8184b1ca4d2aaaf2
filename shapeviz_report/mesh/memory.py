"""Meshes that are in memory, as the files that they would be: so all that is done to files is done to them."""

from __future__ import annotations

from typing import Any

import numpy as np

from shapeviz_report.errors import MeshError

_HEADER = """\
ply
format binary_little_endian 1.0
element vertex {vertices}
property double x
property double y
property double z
element face {faces}
property list uint int64 vertex_indices
end_header
"""


def encode_mesh(mesh: Any) -> dict[str, bytes]:
    """A mesh in memory as :func:`~shapeviz_report.mesh.read.collect_files` would find it.

    Parameters
    ----------
    mesh : pair of arrays, or object
        Vertices (n, 3) and faces (m, k), where every face has k corners; or what has ``vertices`` and ``faces``, as a
        ``trimesh.Trimesh``, or puts its parts together by ``to_mesh()``, as a ``trimesh.Scene``.

    Returns
    -------
    dict of str to bytes
        A binary PLY, which keeps every digit.

    Raises
    ------
    MeshError
        It is none of these.
    """
    if hasattr(mesh, "to_mesh"):
        mesh = mesh.to_mesh()
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        mesh = mesh.vertices, mesh.faces
    if not isinstance(mesh, tuple | list) or len(mesh) != 2:
        raise MeshError(
            f"a mesh is the path of a file, a pair of vertices and faces, or an object that has both; this is of type "
            f"{type(mesh).__name__}"
        )
    if np.iscomplexobj(mesh[0]):
        raise MeshError("its vertices are complex numbers; give x, y and z")
    if any(np.ma.is_masked(part) for part in mesh):
        raise MeshError("its vertices or faces are masked in part; leave out what does not count")
    try:
        vertices, faces = np.asarray(mesh[0], "<f8"), np.asarray(mesh[1])
    except (TypeError, ValueError) as error:
        raise MeshError(f"its vertices or faces are no arrays of numbers: {error}") from error
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise MeshError(f"its vertices must be an array (n, 3), and not {vertices.shape}")
    if faces.ndim != 2 or faces.shape[1] < 3 or faces.dtype.kind not in "iu":
        raise MeshError(
            f"its faces must be an array (m, 3) of whole numbers, and not {faces.shape} of {faces.dtype}"
        )
    rows = np.empty(len(faces), [("size", "<u4"), ("corners", "<i8", faces.shape[1])])
    rows["size"], rows["corners"] = faces.shape[1], faces
    header = _HEADER.format(vertices=len(vertices), faces=len(faces)).encode()
    return {"mesh.ply": header + vertices.tobytes() + rows.tobytes()}
