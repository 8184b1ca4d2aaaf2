"""The descriptors by other means: slow, in plain numpy and scipy, each from the paper's equation."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

from shapeviz_report.descriptors.kernels.contexts import BESIDE
from shapeviz_report.types import FloatArray, IntArray, Mesh

CHUNK = 200
"""Vertices handled at a time: a matrix of this many rows and a column a vertex or face fits any memory."""


def edges_of(faces: IntArray) -> tuple[IntArray, IntArray]:
    """The distinct edges (e, 2), lower vertex first, and how many faces each has."""
    sides = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return np.unique(sides, axis=0, return_counts=True)


def euler_characteristic(mesh: Mesh) -> int:
    """Vertices - edges + faces: 2 for a ball, 0 for a ring."""
    return len(np.unique(mesh.faces)) - len(edges_of(mesh.faces)[0]) + len(mesh.faces)


def curvature(mesh: Mesh) -> FloatArray:
    """Gc: 2 pi (on a boundary pi) less the angles around a vertex, by the law of cosines (Eq. 1); (n,)."""
    corners = mesh.vertices[mesh.faces]
    # Squared sides, each opposite to the corner of its index.
    sides = ((np.roll(corners, -1, axis=1) - np.roll(corners, -2, axis=1)) ** 2).sum(axis=2)
    here, left, right = sides, np.roll(sides, -1, axis=1), np.roll(sides, -2, axis=1)
    angles = np.arccos(np.clip((left + right - here) / (2 * np.sqrt(left * right)), -1, 1))
    edges, counts = edges_of(mesh.faces)
    full = np.full(len(mesh.vertices), 2 * np.pi)
    full[edges[counts == 1]] = np.pi
    return full - np.bincount(mesh.faces.ravel(), angles.ravel(), len(mesh.vertices))


def line_graph(mesh: Mesh) -> csr_matrix:
    """(n, n) lengths of the edges, and of the lines across one edge or two with the faces laid flat.

    By the angles around a corner that all faces of such a strip share, where the descriptor uses coordinates.
    """
    edges, _ = edges_of(mesh.faces)
    links = {tuple(edge): float(np.linalg.norm(np.subtract(*mesh.vertices[edge]))) for edge in edges.tolist()}
    opposite: dict[tuple[int, int], list[int]] = {}
    for face in mesh.faces.tolist():
        for k in range(3):
            a, b, c = face[k], face[(k + 1) % 3], face[(k + 2) % 3]
            opposite.setdefault((a, b), []).append(c)
            opposite.setdefault((b, a), []).append(c)

    def draw(corner: int, *strip: int) -> None:
        """The line from the first to the last of a fan of vertices around a corner."""
        ways = mesh.vertices[list(strip)] - mesh.vertices[corner]
        lengths = np.linalg.norm(ways, axis=1)
        cosines = (ways[1:] * ways[:-1]).sum(axis=1) / (lengths[1:] * lengths[:-1])
        angles = np.append(0, np.cumsum(np.arccos(np.clip(cosines, -1, 1))))
        whole, first, last = angles[-1], lengths[0], lengths[-1]
        if whole > np.pi:
            return
        # How far from the corner the line meets each side in between.
        meets = first * last * np.sin(whole)
        meets /= first * np.sin(angles[1:-1]) + last * np.sin(whole - angles[1:-1])
        if (meets <= lengths[1:-1]).all():
            ends = min(strip[0], strip[-1]), max(strip[0], strip[-1])
            length = float(np.sqrt(first**2 + last**2 - 2 * first * last * np.cos(whole)))
            links[ends] = min(length, links.get(ends, np.inf))

    for (a, b), tips in opposite.items():
        if len(tips) != 2:
            continue
        if a < b:
            draw(a, tips[0], b, tips[1])
        # The second edge is that from a to either tip.
        for tip, other in (tips, tips[::-1]):
            beyond = [c for c in opposite[a, tip] if c != b]
            if len(opposite[a, tip]) == 2 and beyond and b < tip:
                draw(a, other, b, tip, beyond[0])
    ends = np.array(list(links)).T
    return csr_matrix((list(links.values()), ends), (len(mesh.vertices),) * 2)


def geodesic_distance(graph: csr_matrix, sources: IntArray) -> FloatArray:
    """Agd: the mean distance from each source to all vertices, Dijkstra from every one of them (Eq. 2)."""
    chunks = np.array_split(sources, max(1, len(sources) // CHUNK))
    return np.concatenate([dijkstra(graph, directed=False, indices=chunk).mean(axis=1) for chunk in chunks])


def normal_diameter(mesh: Mesh, normals: FloatArray, chosen: IntArray, nearest: float) -> FloatArray:
    """Nd: reversed normals against every face that does not contain their vertex; 0 where none is met.

    In Pluecker coordinates a line passes a triangle where it winds around its three sides in the same sense;
    each side is computed once, so that neighbouring triangles agree on it. Hits below ``nearest`` are passed.
    """
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    planes = np.cross(b - a, c - a)
    edges, index = np.unique(
        np.sort(mesh.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_inverse=True
    )
    sense = np.where(mesh.faces < np.roll(mesh.faces, -1, axis=1), 1.0, -1.0)
    low, high = mesh.vertices[edges[:, 0]], mesh.vertices[edges[:, 1]]
    index = index.reshape(-1, 3)
    result = np.zeros(len(chosen))
    for start in range(0, len(chosen), CHUNK):
        rows = chosen[start : start + CHUNK]
        origins, directions = mesh.vertices[rows], -normals[rows]
        windings = directions @ np.cross(low, high).T + np.cross(origins, directions) @ (high - low).T
        around = windings[:, index] * sense
        # A line through an edge or a corner has a winding of 0 up to rounding: that counts as a hit.
        hit = (around >= -1e-13).all(axis=2) | (around <= 1e-13).all(axis=2)
        for row, candidates in enumerate(hit):
            near = np.flatnonzero(candidates)
            near = near[(mesh.faces[near] != rows[row]).all(axis=1)]
            slope = planes[near] @ directions[row]
            near, slope = near[slope != 0], slope[slope != 0]
            ways = ((a[near] - origins[row]) * planes[near]).sum(axis=1) / slope
            ways = ways[ways > nearest]
            result[start + row] = ways.min() if len(ways) else 0.0
    return result


def normal_diameter_trimesh(mesh: Mesh, normals: FloatArray, chosen: IntArray, nearest: float) -> FloatArray:
    """Nd by trimesh's ray casting; the faces around a vertex are taken out of its hits."""
    import trimesh

    caster = trimesh.ray.ray_triangle.RayMeshIntersector(
        trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    )
    faces, rays, places = caster.intersects_id(
        mesh.vertices[chosen], -normals[chosen], multiple_hits=True, return_locations=True
    )
    origins = chosen[rays]
    ways = np.linalg.norm(places - mesh.vertices[origins], axis=1)
    counted = (mesh.faces[faces] != origins[:, None]).all(axis=1) & (ways > nearest)
    result = np.full(len(chosen), np.inf)
    np.minimum.at(result, rays[counted], ways[counted])
    return np.where(np.isfinite(result), result, 0.0)


def main_axis(mesh: Mesh) -> FloatArray:
    """The direction of largest spread, from a singular value decomposition instead of a covariance."""
    return np.linalg.svd(mesh.vertices - mesh.vertices.mean(axis=0), full_matrices=False)[2][0]


def normal_angle(mesh: Mesh, normals: FloatArray) -> FloatArray:
    """Na; (n,)."""
    return np.abs(normals @ main_axis(mesh))


def point_angle(mesh: Mesh) -> FloatArray:
    """Pa; (n,)."""
    ways = mesh.vertices.mean(axis=0) - mesh.vertices
    return np.abs(ways @ main_axis(mesh)) / np.linalg.norm(ways, axis=1)


def shape_context(
    mesh: Mesh, normals: FloatArray, neighbours: IntArray, chosen: IntArray, limits: tuple[float, float]
) -> FloatArray:
    """Sc of chosen vertices: all others counted, with frames from an eigenvalue solver; (c, 24)."""
    vertices = mesh.vertices
    towards = vertices.mean(axis=0) - vertices[chosen]
    upward = normals[chosen]
    flatten = np.eye(3) - upward[:, :, None] * upward[:, None, :]
    patches = (vertices[neighbours[chosen]] - vertices[chosen, None]) @ flatten
    patches -= patches.mean(axis=1, keepdims=True)
    # Eigenvalues rise; that of the normal is 0.
    tangents = np.linalg.eigh(patches.transpose(0, 2, 1) @ patches)[1][:, :, [2, 1]]
    tangents *= np.where(np.einsum("nx,nxt->nt", towards, tangents) >= 0, 1.0, -1.0)[:, None]
    frames = np.concatenate([tangents, upward[:, :, None]], axis=2)
    result = np.empty((len(chosen), 24))
    for start in range(0, len(chosen), CHUNK):
        rows = chosen[start : start + CHUNK]
        ways = vertices - vertices[rows][:, None]
        shell = np.searchsorted(limits, np.linalg.norm(ways, axis=2) / 2)
        octant = (np.matmul(ways, frames[start : start + CHUNK]) > BESIDE) @ np.array([1, 2, 4])
        cells = 24 * np.arange(len(rows))[:, None] + 8 * shell + octant
        keep = np.arange(len(vertices)) != rows[:, None]
        tally = np.bincount(cells[keep], minlength=24 * len(rows)).reshape(-1, 24)
        result[start : start + CHUNK] = tally / (len(vertices) - 1)
    return result
