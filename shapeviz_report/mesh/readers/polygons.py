"""Polygons of any size, and how they become triangles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import combinations

import manifold3d
import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.paint import Paint
from shapeviz_report.mesh.readers.limits import check_corners
from shapeviz_report.types import FloatArray, UpAxis

Indices = npt.NDArray[np.int64]
Triangle = tuple[int, int, int]

_LEAST_HEIGHT = 1e-6
"""A triangle as flat as this, as a fraction of its longest side, has its corners on a line but for rounding."""
_ONLY_FANS = 5
"""Corners of the largest polygon of which every cut into triangles is a fan."""
_MOST_FANS = 64
"""Corners of the largest polygon of which all fans are tried: they have s^2 triangles."""


@dataclass(frozen=True)
class PolygonMesh:
    """A mesh as a file has it.

    Attributes
    ----------
    vertices : (n, 3) float64 array
    corners : (k,) int64 array
        The vertices of all polygons, one polygon after the other.
    sizes : (m,) int64 array
        Number of corners of each polygon; sums to ``k``.
    up : {"x", "y", "z"} or None
        The axis that points up, if the file or its format says so.
    paint : callable or None
        Gives the :class:`~shapeviz_report.mesh.paint.Paint` of all corners: whoever wants no colours need not have them
        read. None if the file has none.
    """

    vertices: FloatArray
    corners: Indices
    sizes: Indices
    up: UpAxis | None = None
    paint: Callable[[], Paint] | None = None

    @classmethod
    def of_triangles(cls, vertices: FloatArray, faces: Indices, up: UpAxis | None = None) -> PolygonMesh:
        """A mesh of vertices (n, 3) and triangles (m, 3)."""
        return cls(vertices, faces.ravel(), np.full(len(faces), 3, dtype=np.int64), up)


def cut_strip(corners: Indices) -> Indices:
    """(s - 2, 3) triangles of a strip of s corners, every second one turned round."""
    faces = np.column_stack([corners[:-2], corners[1:-1], corners[2:]])
    faces[1::2] = faces[1::2][:, [0, 2, 1]]
    return faces


def cut_fan(corners: Indices) -> Indices:
    """(s - 2, 3) triangles of a fan of s corners around the first."""
    first = np.broadcast_to(corners[:1], max(len(corners) - 2, 0))
    return np.column_stack([first, corners[1:-1], corners[2:]])


def cut_with_holes(vertices: FloatArray, corners: Indices, loops: list[Indices]) -> Indices:
    """Triangles between an outline and the holes in it, in the plane of the outline's Newell normal.

    Parameters
    ----------
    vertices : (n, 3) float64 array
    corners : (k,) int64 array
        Of vertices.
    loops : list of (s,) int64 arrays
        Places in ``corners``: the outline, whose orientation the triangles have, then the holes, however they are
        turned. A corner that is repeated at once counts once; loops of fewer than three corners vanish.

    Returns
    -------
    (m, 3) int64 array
        Places in ``corners``.

    Raises
    ------
    MeshError
        If the holes do not lie within the outline, apart from each other: then the triangles cover another area.
    """
    loops = [loop[corners[loop] != np.roll(corners[loop], -1)] for loop in loops]
    if len(loops[0]) < 3:
        return np.empty((0, 3), np.int64)
    places = [vertices[corners[loop]] - vertices[corners[loops[0][0]]] for loop in loops]
    size = float(np.abs(np.concatenate(places)).max(initial=0))
    if not size < np.inf:
        raise MeshError("a polygon of it with holes has corners without a value")
    normal = np.cross(places[0] / (size or 1), np.roll(places[0], -1, axis=0) / (size or 1)).sum(axis=0)
    length = np.linalg.norm(normal)
    if not length:
        return np.empty((0, 3), np.int64)
    turned: list[Indices] = []
    outlines: list[FloatArray] = []
    areas: list[float] = []
    for loop, place in zip(loops, places, strict=True):
        if len(loop) > 2:
            flat = _project(place / size, normal / length)
            (x, y), (next_x, next_y) = flat.T, np.roll(flat, -1, axis=0).T
            area = float((x * next_y - y * next_x).sum()) / 2
            # an outline is counter-clockwise, a hole clockwise
            backward = bool(turned) and area > 0
            turned.append(loop[::-1] if backward else loop)
            outlines.append(flat[::-1] if backward else flat)
            areas.append(abs(area))
    cut = np.asarray(manifold3d.triangulate(outlines), np.int64).reshape(-1, 3)
    a, b, c = (np.concatenate(outlines)[cut[:, corner]] for corner in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    covered = float(np.abs(ux * vy - uy * vx).sum()) / 2
    if abs(covered - areas[0] + sum(areas[1:])) > 1e-6 * areas[0]:
        raise MeshError("a polygon of it has holes that do not lie within its outline, or overlap")
    return np.concatenate(turned)[cut]


def whole_numbers(values: npt.NDArray[np.generic]) -> Indices:
    """Indices that were read as numbers. Raises ``MeshError`` if one is not whole, or beyond all counting."""
    with np.errstate(invalid="ignore"):
        indices = values.astype(np.int64)
    wrong = values[indices != values]
    if len(wrong):
        if np.isfinite(wrong[0]) and abs(float(wrong[0])) >= 2.0**53:
            raise MeshError(
                f"a face refers to a vertex by a number that no file can reach: {float(wrong[0]):.3g}"
            )
        raise MeshError("a face refers to a vertex by a number that is not whole")
    return indices


def check_indices(vertices: FloatArray, indices: Indices) -> None:
    """Refuse indices of vertices that are not there. Raises ``MeshError``."""
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise MeshError("its vertices do not have three coordinates")
    if len(indices) and not (indices.min() >= 0 and indices.max() < len(vertices)):
        worst = indices.max() if indices.min() >= 0 else indices.min()
        raise MeshError(
            f"a face refers to vertex {worst} (counted from 0), but there are {len(vertices)} vertices"
        )


def triangulate(mesh: PolygonMesh) -> Indices:
    """The vertices (t, 3) of the triangles of :func:`cut_corners`."""
    return mesh.corners[cut_corners(mesh)]


def cut_corners(mesh: PolygonMesh) -> Indices:
    """Cut every polygon into triangles, in the order of the polygons.

    A polygon becomes a fan from its first corner, or from the corner that gives the least flat triangles if the first
    folds over or has a triangle without area: a concave corner, or a straight one. Where no fan will do, the polygon
    is triangulated in the plane of its Newell normal. A corner that is repeated at once counts once; polygons of
    fewer than three corners vanish.

    Parameters
    ----------
    mesh : PolygonMesh
        Its corners are valid indices of its vertices.

    Returns
    -------
    (t, 3) int64 array
        Places in ``mesh.corners``, with the orientation of the polygons.
    """
    kept, sizes = _drop_repeated(mesh.corners, mesh.sizes)
    check_corners(int(sizes.max(initial=0)))
    starts = np.cumsum(sizes) - sizes
    triangles = [np.empty((0, 3), np.int64)]
    owners = [np.empty(0, np.int64)]
    for size in np.unique(sizes[sizes >= 3]):
        which = np.flatnonzero(sizes == size)
        polygons = kept[starts[which, None] + np.arange(size)]
        triangles.append(_cut(mesh.vertices, mesh.corners, polygons).reshape(-1, 3))
        owners.append(np.repeat(which, size - 2))
    if len(owners) == 2:
        return triangles[1]
    order = np.argsort(np.concatenate(owners), kind="stable")
    return np.concatenate(triangles)[order]


def _drop_repeated(corners: Indices, sizes: Indices) -> tuple[Indices, Indices]:
    """Places of the corners without those, of polygons of more than three, that are the same as the next; and how many
    each polygon keeps."""
    if not (sizes > 3).any():
        return np.arange(len(corners)), sizes
    following = np.roll(corners, -1)
    filled = sizes > 0
    last = np.cumsum(sizes)[filled] - 1
    following[last] = corners[last - sizes[filled] + 1]
    repeated = (corners == following) & np.repeat(sizes > 3, sizes)
    owners = np.repeat(np.arange(len(sizes)), sizes)
    return np.flatnonzero(~repeated), np.bincount(owners[~repeated], minlength=len(sizes))


def _cut(vertices: FloatArray, corners: Indices, polygons: Indices) -> Indices:
    """Triangles (p, s - 2, 3) of p polygons (p, s) of one size, places in ``corners``."""
    size = polygons.shape[1]
    if size == 3:
        return polygons[:, None, :]
    triangles = np.empty((len(polygons), size - 2, 3), np.int64)
    # in pieces: the coordinates of all polygons at once may take more memory than the mesh
    step = max(1, 2**20 // size)
    for first in range(0, len(polygons), step):
        piece = slice(first, first + step)
        triangles[piece] = _cut_piece(vertices[corners[polygons[piece]]], polygons[piece])
    return triangles


def _cut_piece(points: FloatArray, polygons: Indices) -> Indices:
    size = polygons.shape[1]
    fan = _fan(size)
    cuts = np.broadcast_to(fan, (len(polygons), size - 2, 3)).copy()
    # what is not finite compares false below, and is cut as if it were convex
    with np.errstate(all="ignore"):
        points = points - points[:, :1]
        points = points / np.abs(points).max(axis=(1, 2), keepdims=True)
        normals = np.cross(points, np.roll(points, -1, axis=1)).sum(axis=1)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        flatness = _least_height(points, normals, cuts)
        folded = np.flatnonzero(flatness < _LEAST_HEIGHT)
        points, normals, flatness = points[folded], normals[folded], flatness[folded]
        for first in range(1, size) if size <= _MOST_FANS else ():
            turned = np.broadcast_to((fan + first) % size, (len(folded), size - 2, 3))
            heights = _least_height(points, normals, turned)
            better = heights > flatness
            cuts[folded[better]], flatness[better] = turned[better], heights[better]
        if size > _ONLY_FANS:
            for place in np.flatnonzero(flatness < _LEAST_HEIGHT):
                cut = _cut_in_plane(points[place], normals[place], float(flatness[place]))
                if cut is not None:
                    cuts[folded[place]] = cut
    return np.take_along_axis(polygons, cuts.reshape(len(polygons), -1), axis=1).reshape(cuts.shape)


def _cut_in_plane(points: FloatArray, normal: FloatArray, least: float) -> Indices | None:
    """Triangles (s - 2, 3) of one polygon (s, 3), if the flattest is less flat than ``least``."""
    planar = np.asarray(manifold3d.triangulate([_project(points, normal)]), np.int64)
    if len(planar) != len(points) - 2:
        return None
    planar = _flip_flat(points, normal, planar)
    return planar if _least_height(points, normal, planar) > least else None


def _least_height(points: FloatArray, normal: FloatArray, cuts: Indices) -> FloatArray:
    """The height of the flattest triangle as a fraction of its longest side, negative if one is turned over.

    Points (..., s, 3), normals (..., 3) of length 1, cuts (..., t, 3).
    """
    if points.ndim == 3:
        a, b, c = (np.take_along_axis(points, cuts[..., corner, None], axis=1) for corner in range(3))
        normal = normal[:, None, :]
    else:
        a, b, c = (points[cuts[..., corner]] for corner in range(3))
    u, v = b - a, c - a
    areas = (np.cross(u, v) * normal).sum(axis=-1)
    longest = np.maximum(np.maximum((u * u).sum(-1), (v * v).sum(-1)), ((c - b) ** 2).sum(-1))
    return np.where(longest > 0, areas / longest, 0.0).min(axis=-1)


def _flip_flat(points: FloatArray, normal: FloatArray, triangles: Indices) -> Indices:
    """Exchange the diagonal that a flat triangle shares with its neighbour, where that makes the flatter one less flat.

    A flat triangle has one corner between the two others; the side across is never a side of the polygon, which
    goes through that corner.
    """

    places, (nx, ny, nz) = points.tolist(), normal.tolist()

    def height(corners: Triangle) -> float:
        # as `_least_height`, which takes ten times as long for one
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (places[corner] for corner in corners)
        ux, uy, uz, vx, vy, vz, wx, wy, wz = (
            bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az, cx - bx, cy - by, cz - bz,
        )  # fmt: skip
        area = (uy * vz - uz * vy) * nx + (uz * vx - ux * vz) * ny + (ux * vy - uy * vx) * nz
        longest = max(ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz, wx * wx + wy * wy + wz * wz)
        return area / longest if longest > 0 else 0.0

    cut: list[Triangle] = [(a, b, c) for a, b, c in triangles.tolist()]
    heights = _least_height(points, normal, triangles[:, None]).tolist()
    beside: dict[frozenset[int], set[int]] = {}
    for index, triangle in enumerate(cut):
        for side in combinations(triangle, 2):
            beside.setdefault(frozenset(side), set()).add(index)
    # the first flat triangle first; one that gained nothing is tried again only where a neighbour has changed
    waiting = [index for index, value in enumerate(heights) if value < _LEAST_HEIGHT]
    flips = 0
    while waiting and flips < 4 * len(cut):
        index = heappop(waiting)
        if heights[index] >= _LEAST_HEIGHT or (flipped := _flip(cut, heights, beside, index, height)) is None:
            continue
        other, pair = flipped
        changed = set()
        for place, triangle in zip((index, other), pair):
            for side in combinations(cut[place], 2):
                beside[frozenset(side)].discard(place)
            cut[place], heights[place] = triangle, height(triangle)
            for side in combinations(triangle, 2):
                beside.setdefault(frozenset(side), set()).add(place)
        for side in (side for triangle in pair for side in combinations(triangle, 2)):
            changed |= beside[frozenset(side)]
        for place in changed:
            if heights[place] < _LEAST_HEIGHT:
                heappush(waiting, place)
        flips += 1
    return np.array(cut, np.int64)


def _flip(
    cut: list[Triangle],
    heights: list[float],
    beside: dict[frozenset[int], set[int]],
    index: int,
    height: Callable[[Triangle], float],
) -> tuple[int, tuple[Triangle, Triangle]] | None:
    """The neighbour with which a triangle gains most by exchanging their diagonal, and the two that then are."""
    best, gain = None, heights[index]
    for turn in range(3):
        a, b, c = (cut[index][(turn + corner) % 3] for corner in range(3))
        for other in sorted(beside[frozenset((a, c))] - {index}):
            (d,) = set(cut[other]) - {a, c} or (b,)
            pair = ((a, b, d), (b, c, d))
            least = min(height(pair[0]), height(pair[1]))
            if d != b and least > min(gain, heights[other]):
                best, gain = (other, pair), least
    return best


def _fan(size: int) -> Indices:
    """Triangles (s - 2, 3) from corner 0 of a polygon."""
    following = np.arange(1, size - 1)
    return np.stack([np.zeros(size - 2, np.int64), following, following + 1], axis=1)


def _project(points: FloatArray, normal: FloatArray) -> FloatArray:
    """Coordinates (s, 2) in the plane across a normal, counter-clockwise as seen against it."""
    axis = np.zeros(3)
    axis[np.argmin(np.abs(normal))] = 1
    right = np.cross(axis, normal)
    right /= np.linalg.norm(right)
    up = np.cross(normal, right)
    up /= np.linalg.norm(up)
    return points @ np.column_stack([right, up])
