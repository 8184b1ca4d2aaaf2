"""Remeshing to an even edge length with Mmg (Dapogny, Dobrzynski, Frey 2014)."""

from __future__ import annotations

import numpy as np

from shapeviz_report.errors import MeshError
from shapeviz_report.types import Mesh

MAX_VERTICES = 100_000
"""Vertices that a surface may take; a ball takes 12,000 at edges of 1 %. Larger ones get longer edges."""

ATTEMPTS = (1.0, 0.99, 0.97, 0.94)
"""Shares of the edge length to try: Mmg may give up at one length, and come through at another hardly shorter."""

ROOM = 2**28
"""Bytes that Mmg may take for any mesh. It takes half of it before it begins."""

ROOM_PER_VERTEX = 2**9
"""Bytes that it may take for each vertex that it gets or makes. It takes some 300."""

_FAILED = (
    "it cannot be remeshed: perhaps all its parts are specks, far smaller than the space between them; "
    "remove what lies far off, and mend it in a 3D program"
)


def surface_size(mesh: Mesh) -> float:
    """How large a shape is, whichever way it is turned: the unit of the edge length.

    Four times the root mean square distance of the surface from its centroid. The diagonal of the bounding box,
    which the paper takes (3.2), changes by up to a half as a shape turns, and with it the whole mesh and every
    feature. Over shapes standing upright the two agree: the median of their ratio is 0.99 on the Princeton benchmark.

    Parameters
    ----------
    mesh : Mesh
        With some area.

    Returns
    -------
    float
        Above 0, in the unit of the vertices.
    """
    corners = mesh.vertices[mesh.faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    middles = corners.mean(axis=1)
    centroid = areas @ middles / areas.sum()
    # The second moment of a triangle of area A with corners p and middle m: A (sum |p|^2 + 9 |m|^2) / 12.
    squares = np.square(corners - centroid).sum(axis=(1, 2)) + 9 * np.square(middles - centroid).sum(axis=1)
    return 4 * float(np.sqrt(areas @ squares / 12 / areas.sum()))


def affordable_edge_length(mesh: Mesh, edge_length: float) -> float:
    """The wanted edge length, or the one at which a mesh takes ``MAX_VERTICES`` if that is longer.

    Only a surface folded or stacked many times over, such as a book of hundreds of leaves, needs it, or thousands of
    strips and needles, whose rims take vertices though they have hardly an area. What it takes to describe a shape is
    then bounded as well.

    Parameters
    ----------
    mesh : Mesh
    edge_length : float
        In the unit of the vertices, as the result.
    """
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2
    edges = np.sort(mesh.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).astype(np.int64)
    edges, times = np.unique(edges[:, 0] * len(mesh.vertices) + edges[:, 1], return_counts=True)
    starts, ends = np.divmod(edges[times == 1], len(mesh.vertices))
    rim = float(np.linalg.norm(mesh.vertices[ends] - mesh.vertices[starts], axis=1).sum())
    # Euler: an even triangulation has 2 faces a vertex, each of sqrt(3) / 4 squared edges. A rim has a vertex an edge.
    return max(edge_length, float(np.sqrt(area / (MAX_VERTICES * np.sqrt(3) / 2))), rim / MAX_VERTICES)


def remesh(mesh: Mesh, edge_length: float) -> Mesh:
    """Remesh a cleaned mesh to a constant edge length.

    Runs native code: call it in a process of its own, which it may hang or end.

    Parameters
    ----------
    mesh : Mesh
        As :func:`shapeviz_report.mesh.clean.clean` returns it.
    edge_length : float
        Target length of every edge, in the unit of the vertices.

    Returns
    -------
    Mesh
        In the coordinates of the input.

    Raises
    ------
    MeshError
        Mmg gives up on it.
    MemoryError
        Mmg gives up, and the memory that it may have needed is not there.
    """
    # Importing mmgpy costs 0.1 s and loads native libraries: only the processes that remesh pay.
    from mmgpy import MmgMeshS

    # Mmg judges some things by absolute size.
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    diagonal = float(np.linalg.norm(high - low))
    for share in ATTEMPTS:
        target = share * edge_length / diagonal
        surface = MmgMeshS()
        try:
            surface.set_mesh_size(vertices=len(mesh.vertices), triangles=len(mesh.faces))
            surface.set_vertices((mesh.vertices - low) / diagonal)
            surface.set_triangles(mesh.faces)
            # Moving vertices would take as long as all the rest, and the edges are as even as is needed without.
            surface.remesh(hsiz=target, hausd=target / 2, nomove=1, verbose=-1)
        except RuntimeError:
            continue
        vertices, faces = surface.get_vertices(), surface.get_triangles()
        if len(faces) > 0 and np.isfinite(vertices).all():
            return Mesh(vertices * diagonal + low, np.ascontiguousarray(faces, dtype=np.int32))
    # Mmg fails alike for want of memory and for what it cannot remesh. If what it would have taken is not to be had
    # now either, that is why, and the mesh may be well.
    del surface
    np.empty(ROOM + ROOM_PER_VERTEX * (len(mesh.vertices) + MAX_VERTICES), np.uint8)
    raise MeshError(_FAILED)
