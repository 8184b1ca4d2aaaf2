"""Remeshing to an even edge length with Mmg (Dapogny, Dobrzynski, Frey 2014)."""

from __future__ import annotations

import numpy as np

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.flips import find_twins, flip_edges
from shapeviz_report.types import Mesh

MAX_VERTICES = 20_000
"""Vertices that a surface may take, about; a ball takes 13,000 at edges of 1 %. Larger ones get longer edges."""

MOST_VERTICES = 100_000
"""Vertices that a surface may take, about, that strays with fewer."""

RIDGE = 45.0
"""Degrees between two faces from which on Mmg keeps the edge between them; what is flatter it takes for a round surface
in coarse faces, and rounds it."""

ATTEMPTS = ((1.0, 0.5), (1.0, 0.01), (0.99, 0.5), (0.97, 0.5), (0.94, 0.5))
"""Shares of the edge length to try, and the least length of an edge as a share of that.

Mmg may give up at one length, and come through at another hardly shorter or with shorter edges; without a least length
it splits the edges of some faces a hundred times over."""

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


def affordable_edge_length(mesh: Mesh, edge_length: float, vertices: int = MAX_VERTICES) -> float:
    r"""The wanted edge length, or the one at which a mesh takes about so many vertices if that is longer.

    With area A, and R the length of all rims and ridges, which take vertices however narrow the surface beside them is,
    a surface takes at edges of length l about

    .. math:: n = 1.1 \frac{2 A}{\sqrt 3 l^2} + 1.4 \frac{R}{l}

    vertices: right to a fifth for nine in ten of 220 shapes. What it takes to describe a shape is then bounded too.

    Parameters
    ----------
    mesh : Mesh
        As :func:`shapeviz_report.mesh.clean.clean` returns it.
    edge_length : float
        In the unit of the vertices, as the result.
    vertices : int
        How many it may take.
    """
    corners = mesh.vertices[mesh.faces]
    crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    doubled = np.linalg.norm(crosses, axis=1)
    normals = crosses / np.maximum(doubled, 1e-300)[:, None]
    lengths = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).ravel()
    twins = find_twins(mesh.faces, len(mesh.vertices))
    first = np.flatnonzero(twins > np.arange(len(twins)))
    sharp = np.einsum("ij,ij->i", normals[first // 3], normals[twins[first] // 3]) < np.cos(np.radians(RIDGE))
    along = 1.4 * float(lengths[twins < 0].sum() + lengths[first[sharp]].sum())
    over = 1.1 * float(doubled.sum()) / np.sqrt(3)
    return max(edge_length, (along + float(np.sqrt(along**2 + 4 * over * vertices))) / (2 * vertices))


def remesh(mesh: Mesh, edge_length: float, ridge: float = RIDGE) -> Mesh:
    """Remesh a cleaned mesh to a constant edge length.

    Runs native code: call it in a process of its own, which it may hang or end.

    Parameters
    ----------
    mesh : Mesh
        As :func:`shapeviz_report.mesh.clean.clean` returns it.
    edge_length : float
        Target length of every edge, in the unit of the vertices.
    ridge : float
        Degrees between two faces from which on the edge between them is kept.

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
    for share, least in ATTEMPTS:
        target = share * edge_length / diagonal
        surface = MmgMeshS()
        try:
            surface.set_mesh_size(vertices=len(mesh.vertices), triangles=len(mesh.faces))
            surface.set_vertices((mesh.vertices - low) / diagonal)
            surface.set_triangles(mesh.faces)
            # Moving vertices would take as long as all the rest, and the edges are as even as is needed without. Edges
            # turned once, at the end, make faces as good as when Mmg turns them again and again, in half the time.
            surface.remesh(
                hsiz=target, hmin=least * target, hausd=target / 2, ar=ridge, nomove=1, noswap=1, verbose=-1
            )
        except RuntimeError:
            continue
        vertices, faces = surface.get_vertices(), surface.get_triangles()
        if len(faces) > 0 and np.isfinite(vertices).all():
            return flip_edges(Mesh(vertices * diagonal + low, np.ascontiguousarray(faces, dtype=np.int32)))
    # Mmg fails alike for want of memory and for what it cannot remesh. If what it would have taken is not to be had
    # now either, that is why, and the mesh may be well.
    del surface
    np.empty(ROOM + ROOM_PER_VERTEX * (len(mesh.vertices) + MOST_VERTICES), np.uint8)
    raise MeshError(_FAILED)
