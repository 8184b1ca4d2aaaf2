"""The point of a surface that is closest to another point, by a tree of bounding boxes."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.mesh.boxes import DEPTH
from shapeviz_report.types import FloatArray, Int64Array

SAMPLED = 64
"""Of so many points, one belongs to the sample by which :func:`largest_distance` begins."""

FLAT = 1e-28
"""A face of less squared area than this, relative to its sides, is the line between two of its corners."""


@kernel(error_model="numpy")
def _outside(boxes: FloatArray, node: int, x: float, y: float, z: float) -> float:
    """The squared distance of a point from a box; infinite for one that nothing meets."""
    dx = max(boxes[node, 0] - x, 0.0, x - boxes[node, 3])
    dy = max(boxes[node, 1] - y, 0.0, y - boxes[node, 4])
    dz = max(boxes[node, 2] - z, 0.0, z - boxes[node, 5])
    return dx * dx + dy * dy + dz * dz


@kernel(error_model="numpy")
def _dot(a: tuple[float, float, float], b: tuple[float, float, float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel(error_model="numpy")
def _weigh_lines(triangle: FloatArray, x: float, y: float, z: float) -> tuple[float, float]:
    """What :func:`_weigh` gives, of the three sides alone."""
    weights = np.zeros(3)
    least = np.inf
    for start in range(3):
        a, b = triangle[start], triangle[(start + 1) % 3]
        ab, ap = (b[0] - a[0], b[1] - a[1], b[2] - a[2]), (x - a[0], y - a[1], z - a[2])
        square = _dot(ab, ab)
        along = min(max(_dot(ab, ap) / square, 0.0), 1.0) if square > 0.0 else 0.0
        gap = (ap[0] - along * ab[0], ap[1] - along * ab[1], ap[2] - along * ab[2])
        if _dot(gap, gap) < least:
            least = _dot(gap, gap)
            weights[:] = 0.0
            weights[start], weights[(start + 1) % 3] = 1.0 - along, along
    return weights[1], weights[2]


@kernel(error_model="numpy")
def _weigh(triangle: FloatArray, x: float, y: float, z: float) -> tuple[float, float]:
    """Weights of the second and the third corner in the point of a triangle that is closest to another (Ericson,
    Real-Time Collision Detection, 2005, 5.1.5)."""
    a, b, c = triangle[0], triangle[1], triangle[2]
    ab = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    ac = (c[0] - a[0], c[1] - a[1], c[2] - a[2])
    normal = (
        ab[1] * ac[2] - ab[2] * ac[1],
        ab[2] * ac[0] - ab[0] * ac[2],
        ab[0] * ac[1] - ab[1] * ac[0],
    )
    if _dot(normal, normal) <= FLAT * _dot(ab, ab) * _dot(ac, ac):
        return _weigh_lines(triangle, x, y, z)
    ap = (x - a[0], y - a[1], z - a[2])
    d1, d2 = _dot(ab, ap), _dot(ac, ap)
    if d1 <= 0.0 and d2 <= 0.0:
        return 0.0, 0.0
    bp = (x - b[0], y - b[1], z - b[2])
    d3, d4 = _dot(ab, bp), _dot(ac, bp)
    if d3 >= 0.0 and d4 <= d3:
        return 1.0, 0.0
    over_c = d1 * d4 - d3 * d2
    if over_c <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        return d1 / (d1 - d3), 0.0
    cp = (x - c[0], y - c[1], z - c[2])
    d5, d6 = _dot(ab, cp), _dot(ac, cp)
    if d6 >= 0.0 and d5 <= d6:
        return 0.0, 1.0
    over_b = d5 * d2 - d1 * d6
    if over_b <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        return 0.0, d2 / (d2 - d6)
    over_a = d3 * d6 - d5 * d4
    if over_a <= 0.0 and d4 >= d3 and d5 >= d6:
        along = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return 1.0 - along, along
    whole = over_a + over_b + over_c
    return over_b / whole, over_c / whole


@kernel(error_model="numpy")
def _reach(triangle: FloatArray, x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """The squared distance of a point from a triangle, and the closest point of it."""
    second, third = _weigh(triangle, x, y, z)
    first = 1.0 - second - third
    px = first * triangle[0, 0] + second * triangle[1, 0] + third * triangle[2, 0]
    py = first * triangle[0, 1] + second * triangle[1, 1] + third * triangle[2, 1]
    pz = first * triangle[0, 2] + second * triangle[1, 2] + third * triangle[2, 2]
    return (px - x) ** 2 + (py - y) ** 2 + (pz - z) ** 2, px, py, pz


@kernel(error_model="numpy")
def _search(
    x: float,
    y: float,
    z: float,
    corners: FloatArray,
    boxes: FloatArray,
    leaf: int,
    enough: float,
    stack: Int64Array,
    gaps: FloatArray,
) -> tuple[float, int, float, float, float]:
    """The squared distance of a point from a surface, the face, and the closest point on it; as soon as the distance
    is at most ``enough``, any such."""
    count, first_leaf = len(corners), len(boxes) // 2
    best, owner, cx, cy, cz = np.inf, 0, 0.0, 0.0, 0.0
    stack[0], gaps[0] = 1, 0.0
    depth = 1
    while depth > 0 and best > enough:
        depth -= 1
        if gaps[depth] >= best:
            continue
        node = stack[depth]
        if node < first_leaf:
            near, far = 2 * node, 2 * node + 1
            near_gap, far_gap = _outside(boxes, near, x, y, z), _outside(boxes, far, x, y, z)
            if far_gap < near_gap:
                near, far, near_gap, far_gap = far, near, far_gap, near_gap
            if far_gap < best:
                stack[depth], gaps[depth] = far, far_gap
                depth += 1
            if near_gap < best:
                stack[depth], gaps[depth] = near, near_gap
                depth += 1
            continue
        start = (node - first_leaf) * leaf
        for place in range(start, min(start + leaf, count)):
            gap, px, py, pz = _reach(corners[place], x, y, z)
            if gap < best:
                best, owner, cx, cy, cz = gap, place, px, py, pz
    return best, owner, cx, cy, cz


@kernel(error_model="numpy")
def find_closest(
    points: FloatArray, corners: FloatArray, boxes: FloatArray, leaf: int
) -> tuple[FloatArray, Int64Array]:
    """The closest point of a surface to each of some points.

    Parameters
    ----------
    points : (n, 3) float64 array
    corners : (m, 3, 3) float64 array
        Of the faces, in the order of the tree's leaves.
    boxes, leaf
        As :func:`~shapeviz_report.mesh.boxes.box_faces` makes them.

    Returns
    -------
    closest : (n, 3) float64 array
    place : (n,) int64 array
        The face each lies on, in the order of ``corners``.
    """
    closest, owner = np.empty((len(points), 3)), np.zeros(len(points), np.int64)
    stack, gaps = np.empty(DEPTH, np.int64), np.empty(DEPTH)
    for number in range(len(points)):
        x, y, z = points[number, 0], points[number, 1], points[number, 2]
        _, place, px, py, pz = _search(x, y, z, corners, boxes, leaf, -1.0, stack, gaps)
        owner[number] = place
        closest[number, 0], closest[number, 1], closest[number, 2] = px, py, pz
    return closest, owner


@kernel(error_model="numpy")
def largest_distance(points: FloatArray, corners: FloatArray, boxes: FloatArray, leaf: int) -> float:
    """How far the farthest of some points is from a surface; the arguments are those of :func:`find_closest`.

    A point is left as soon as it is known to be no farther than another (Taha and Hanbury 2015): most of them by the
    faces around the last one found. So points should come in an order in which near ones follow each other.
    """
    stack, gaps = np.empty(DEPTH, np.int64), np.empty(DEPTH)
    largest, owner = 0.0, 0
    # A sample of the points first, so that most of the others end early.
    for number in range(0, len(points), SAMPLED):
        x, y, z = points[number, 0], points[number, 1], points[number, 2]
        largest = max(largest, _search(x, y, z, corners, boxes, leaf, largest, stack, gaps)[0])
    for number in range(len(points)):
        x, y, z = points[number, 0], points[number, 1], points[number, 2]
        found = _reach(corners[owner], x, y, z)[0] <= largest
        if not found:
            for place in range(max(owner - leaf, 0), min(owner + leaf + 1, len(corners))):
                if _reach(corners[place], x, y, z)[0] <= largest:
                    owner, found = place, True
                    break
        if not found:
            gap, owner, _, _, _ = _search(x, y, z, corners, boxes, leaf, largest, stack, gaps)
            largest = max(largest, gap)
    return np.sqrt(largest)
