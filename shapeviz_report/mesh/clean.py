"""Cleaning: any indexed triangles become an oriented 2-manifold, possibly with boundary."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from shapeviz_report.compilation import kernel
from shapeviz_report.errors import MeshError
from shapeviz_report.types import BoolArray, FloatArray, Int64Array, IntArray, Mesh

WELD_DISTANCE = 1e-6
"""Vertices closer than this fraction of the bounding-box diagonal become one."""

RESOLUTION = 1e-12
"""A mesh that is smaller than this fraction of its distance from the origin is refused."""

NEGLIGIBLE_AREA = 1e-14
"""Faces of less area than this, in units of the squared diagonal, carry no direction and are dropped."""


def clean(mesh: Mesh) -> tuple[Mesh, dict[str, int]]:
    """Mend a mesh as it was read so that every later step can trust it.

    In order: faces with non-finite vertices are dropped; vertices closer than ``WELD_DISTANCE`` are welded;
    empty and duplicate faces are dropped; faces are given a common winding where neighbours allow it, closed
    parts facing outward; and the surface is cut along edges that more than two faces share, and at vertices
    where parts only touch, so that what is left is a 2-manifold.

    Parameters
    ----------
    mesh : Mesh
        As read: indices are valid, coordinates may be anything.

    Returns
    -------
    mesh : Mesh
        From the lowest corner of its bounding box, in units of its diagonal. Every vertex is used; every edge
        has one or two faces.
    repairs : dict of str to int
        What was mended and how often; only what happened.

    Raises
    ------
    MeshError
        No face with an area is left.
    """
    repairs: dict[str, int] = {}

    def note(what: str, count: int) -> None:
        if count:
            repairs[what] = int(count)

    scaled, kept, used = in_diagonals(mesh)
    faces = np.asarray(mesh.faces, dtype=np.int64)[kept]
    note("faces with non-finite coordinates dropped", (~kept).sum())

    faces, welded = _weld(scaled, faces, used)
    note("vertices welded", welded)

    a, b, c = scaled[faces[:, 0]], scaled[faces[:, 1]], scaled[faces[:, 2]]
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    solid = area > NEGLIGIBLE_AREA
    note("empty faces dropped", (~solid).sum())
    faces = faces[solid]
    if len(faces) == 0:
        raise MeshError("none of its faces has an area")

    _, first = _find_copies(np.sort(faces, axis=1))
    note("duplicate faces dropped", len(faces) - len(first))
    faces = faces[np.sort(first)]

    pairs, shared_by_more = _manifold_pairs(faces)
    note("edges of more than two faces cut", shared_by_more)
    flips, parts = _orient(faces.astype(np.int32), pairs)
    flips = _face_outward(scaled, faces, flips, parts, pairs)
    note("faces turned round", flips.sum())
    faces[flips] = faces[flips][:, ::-1]
    # In a face turned round, its first two half-edges have changed places.
    corner = pairs % 3
    pairs = np.where(flips[pairs // 3] & (corner < 2), pairs + 1 - 2 * corner, pairs)

    starts = faces.ravel()[pairs]
    agree = starts[:, 0] != starts[:, 1]
    note("edges of one-sided surfaces cut", (~agree).sum())
    parted, origin = _split_corners(faces, pairs[agree])
    note("touching vertices parted", len(origin) - len(np.unique(origin)))
    return Mesh(scaled[origin], parted), repairs


def is_watertight(faces: IntArray) -> bool:
    """Whether every edge of ``faces`` (m, 3) belongs to exactly two faces."""
    edges = _sorted_edges(faces.astype(np.int64))
    _, counts = np.unique(edges[:, 0] * (int(faces.max()) + 1) + edges[:, 1], return_counts=True)
    return bool((counts == 2).all())


def count_components(vertex_count: int, faces: IntArray) -> int:
    """Number of connected parts among ``vertex_count`` vertices joined by ``faces`` (m, 3)."""
    edges = _sorted_edges(faces.astype(np.int64))
    graph = coo_matrix(
        (np.ones(len(edges), np.int8), (edges[:, 0], edges[:, 1])), (vertex_count, vertex_count)
    )
    return int(connected_components(graph, directed=False)[0])


def _sorted_edges(faces: Int64Array) -> Int64Array:
    return np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)


def bounding_diagonal(mesh: Mesh) -> float:
    """The diagonal of the bounding box of all faces with finite coordinates, in which :func:`clean` measures."""
    corners = mesh.vertices[mesh.faces]
    extent = np.ptp(corners[np.isfinite(corners).all(axis=(1, 2))].reshape(-1, 3), axis=0)
    return float(extent.max() * np.linalg.norm(extent / extent.max()))


def in_diagonals(mesh: Mesh) -> tuple[FloatArray, BoolArray, BoolArray]:
    """The vertices of a mesh as it was read where :func:`clean` has them, which of its faces are finite, and which
    vertices these use; of the others nothing is known.

    Raises
    ------
    MeshError
        No face is finite, or the mesh is too large or too small.
    """
    vertices = np.asarray(mesh.vertices, dtype=np.float64)
    usable: BoolArray = np.all(np.isfinite(vertices), axis=1)
    kept: BoolArray = np.all(usable[mesh.faces], axis=1)
    if not kept.any():
        raise MeshError("no face has finite coordinates")
    used = np.zeros(len(vertices), dtype=bool)
    used[mesh.faces[kept]] = True
    scaled = np.zeros_like(vertices)
    scaled[used] = _in_diagonals(vertices[used])
    return scaled, kept, used


def _in_diagonals(vertices: FloatArray) -> FloatArray:
    """Measure positions (n, 3) from the lowest corner of their bounding box, in units of its diagonal.

    Whatever its unit and wherever its origin, later steps compute with numbers of one size.
    """
    low = vertices.min(axis=0)
    with np.errstate(over="ignore"):
        extent = vertices.max(axis=0) - low
    longest = float(extent.max())
    farthest = float(np.abs(vertices).max())
    if not np.isfinite(longest):
        raise MeshError(
            f"its coordinates, up to {farthest:.0e}, exceed what can be computed with; scale it down"
        )
    if longest == 0:
        raise MeshError("all its vertices lie in one point")
    if longest <= RESOLUTION * farthest:
        raise MeshError(
            f"it is {farthest / longest:.0e} times as far from the origin as it is large, so that its coordinates "
            "hardly tell its vertices apart; move it to the origin before it is exported"
        )
    # In two steps, for the square of a very large or small extent would be out of range.
    scaled = (vertices - low) / longest
    return scaled / np.linalg.norm(extent / longest)


def _weld(scaled: FloatArray, faces: Int64Array, used: BoolArray) -> tuple[Int64Array, int]:
    """Point faces at one representative of each cluster of close vertices; how many vertices that saved."""
    index = np.flatnonzero(used)
    place, first = _find_copies(scaled[index])
    points = scaled[index[first]]
    close = cKDTree(points).query_pairs(WELD_DISTANCE, output_type="ndarray")
    links = coo_matrix((np.ones(len(close), np.int8), (close[:, 0], close[:, 1])), (len(points),) * 2)
    count, cluster = connected_components(links, directed=False)
    # The lowest original index stands for its cluster, so the result keeps the file's order.
    of_vertex = cluster[place]
    representative = np.full(count, len(scaled), dtype=np.int64)
    np.minimum.at(representative, of_vertex, index)
    target = np.zeros(len(scaled), dtype=np.int64)
    target[index] = representative[of_vertex]
    return target[faces], len(index) - count


def _find_copies(rows: np.ndarray) -> tuple[IntArray, Int64Array]:
    """Which rows (n, 3) are the same: a number for each row, and for each number the first row that has it."""
    order = np.lexsort(rows.T)
    ordered = rows[order]
    new = np.append(True, (ordered[1:] != ordered[:-1]).any(axis=1))
    number = np.empty(len(rows), dtype=np.int32)
    number[order] = np.cumsum(new) - 1
    return number, order[new]


def _manifold_pairs(faces: Int64Array) -> tuple[IntArray, int]:
    """Half-edge pairs of edges with exactly two faces.

    Returns
    -------
    pairs : (p, 2) int array
        Half-edges ``3 * face + corner``, each starting at that corner of its face.
    shared_by_more : int
        Number of edges with more than two faces.
    """
    starts, ends = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    edges = np.minimum(starts, ends) * (int(faces.max()) + 1) + np.maximum(starts, ends)
    order = np.argsort(edges, kind="stable")
    begin = np.flatnonzero(np.diff(edges[order], prepend=-1))
    counts = np.diff(np.append(begin, len(order)))
    twos = begin[counts == 2]
    return np.stack([order[twos], order[twos + 1]], axis=1).astype(np.int32), int((counts > 2).sum())


@kernel()
def _orient(faces: IntArray, pairs: IntArray) -> tuple[BoolArray, IntArray]:
    """Give neighbours a common winding by a breadth-first walk over manifold edges.

    Returns which faces to flip and the part of each face. On one-sided surfaces some neighbours must differ.
    """
    face_count = len(faces)
    degree = np.zeros(face_count + 1, np.int64)
    for p in range(len(pairs)):
        degree[pairs[p, 0] // 3 + 1] += 1
        degree[pairs[p, 1] // 3 + 1] += 1
    offset = np.cumsum(degree)
    fill = offset.copy()
    neighbour = np.empty(offset[-1], np.int32)
    through = np.empty(offset[-1], np.int32)
    for p in range(len(pairs)):
        f, g = pairs[p, 0] // 3, pairs[p, 1] // 3
        neighbour[fill[f]] = g
        through[fill[f]] = p
        fill[f] += 1
        neighbour[fill[g]] = f
        through[fill[g]] = p
        fill[g] += 1
    flip = np.zeros(face_count, np.bool_)
    part = np.full(face_count, -1, np.int32)
    queue = np.empty(face_count, np.int32)
    parts = 0
    for seed in range(face_count):
        if part[seed] >= 0:
            continue
        part[seed] = parts
        queue[0] = seed
        head, tail = 0, 1
        while head < tail:
            f = queue[head]
            head += 1
            for e in range(offset[f], offset[f + 1]):
                g = neighbour[e]
                p = through[e]
                # Two faces agree when they run along their common edge in opposite directions.
                same = faces[pairs[p, 0] // 3, pairs[p, 0] % 3] == faces[pairs[p, 1] // 3, pairs[p, 1] % 3]
                wanted = flip[f] != same
                if part[g] < 0:
                    part[g] = parts
                    flip[g] = wanted
                    queue[tail] = g
                    tail += 1
        parts += 1
    return flip, part


def _face_outward(
    points: FloatArray, faces: Int64Array, flips: BoolArray, parts: IntArray, pairs: IntArray
) -> np.ndarray:
    """Choose, part by part, the winding that faces outward.

    A closed part encloses a positive volume. An open part has no inside; it keeps the winding that most of
    its faces came with, unless that leaves it facing its own centre.
    """
    a, b, c = (points[faces[:, i]] for i in range(3))
    count = int(parts.max()) + 1
    cross = np.cross(b - a, c - a)
    middle = (a + b + c) / 3
    weight = np.linalg.norm(cross, axis=1)
    total = np.bincount(parts, weight, count)
    centre = np.stack([np.bincount(parts, weight * middle[:, i], count) / total for i in range(3)], axis=1)
    signed = np.where(flips, -1.0, 1.0) * np.einsum("ij,ij->i", middle - centre[parts], cross)
    outward = np.bincount(parts, signed, count)
    majority = np.bincount(parts, np.where(flips, -weight, weight), count)
    manifold = (
        np.bincount(parts[pairs[:, 0] // 3], minlength=count) * 2 == np.bincount(parts, minlength=count) * 3
    )
    # How strongly a part faces away from its own centre: 1 for a ball, 0 for a flat sheet.
    reach = np.bincount(parts, weight * np.linalg.norm(middle - centre[parts], axis=1), count)
    decided = manifold | (np.abs(outward) > 0.2 * reach)
    reverse = np.where(decided, outward < 0, majority < 0)
    return flips ^ reverse[parts]


def _split_corners(faces: Int64Array, pairs: IntArray) -> tuple[IntArray, Int64Array]:
    """Rebuild the vertices so that corners are one vertex only where ``pairs`` joins them.

    Cuts non-manifold edges and vertices alike: a corner is reached from another only by walking over edges
    of two faces that agree on the winding.

    Returns the new faces and, for each new vertex, the old one it is a copy of.
    """
    following = np.where(pairs % 3 == 2, pairs - 2, pairs + 1)
    # Agreeing half-edges run against each other: each starts where the other ends.
    joins = np.concatenate(
        [
            np.stack([pairs[:, 0], following[:, 1]], axis=1),
            np.stack([following[:, 0], pairs[:, 1]], axis=1),
        ]
    )
    size = 3 * len(faces)
    links = coo_matrix((np.ones(len(joins), np.int8), (joins[:, 0], joins[:, 1])), (size, size))
    count, vertex = connected_components(links, directed=False)
    origin = np.empty(count, dtype=np.int64)
    origin[vertex] = faces.ravel()
    # Numbered as in the input, copies side by side: the remesher's result follows the order of vertices.
    order = np.argsort(origin, kind="stable")
    rank = np.empty(count, dtype=np.int32)
    rank[order] = np.arange(count, dtype=np.int32)
    return rank[vertex].reshape(-1, 3), origin[order]
