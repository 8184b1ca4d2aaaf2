"""The first face a ray meets, by a tree of bounding boxes."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.mesh.boxes import DEPTH
from shapeviz_report.types import FloatArray, IntArray

MARGIN = 1e-8
"""Boxes are wider than their faces by this on every side.

Faces reach beyond their edges by ``EDGE`` of a side, at most 2 long; and of a ray that runs within the side of a
box, with a direction component of zero, either side of that side would count as outside without it."""

EDGE = 1e-9
"""Faces reach beyond their edges by this fraction of a side, so that no ray slips between two of them."""

GRAZING = 1e-10
"""A ray at a smaller angle to a face (in radians) lies in its plane and does not meet it."""


@kernel(error_model="numpy")
def _cross(near: float, far: float, origin: float, inverse: float) -> tuple[float, float]:
    """Where along one axis a ray enters a box and leaves it; ``near`` is the side that it meets first."""
    margin = MARGIN if inverse > 0.0 else -MARGIN
    return (near - margin - origin) * inverse, (far + margin - origin) * inverse


@kernel(error_model="numpy")
def _enter(
    boxes: FloatArray, node: int, ox: float, oy: float, oz: float, ix: float, iy: float, iz: float
) -> float:
    """Where on a ray from o, with the inverse direction i, a box begins; infinite where it is not met."""
    near_x, near_y, near_z = 0 if ix > 0.0 else 3, 1 if iy > 0.0 else 4, 2 if iz > 0.0 else 5
    enter_x, leave_x = _cross(boxes[node, near_x], boxes[node, 3 - near_x], ox, ix)
    enter_y, leave_y = _cross(boxes[node, near_y], boxes[node, 5 - near_y], oy, iy)
    enter_z, leave_z = _cross(boxes[node, near_z], boxes[node, 7 - near_z], oz, iz)
    enter = max(0.0, max(enter_x, max(enter_y, enter_z)))
    leave = min(leave_x, min(leave_y, leave_z))
    return enter if enter <= leave else np.inf


@kernel(error_model="numpy")
def cast_inward(
    vertices: FloatArray,
    normals: FloatArray,
    rays: IntArray,
    faces: IntArray,
    corners: FloatArray,
    boxes: FloatArray,
    leaf: int,
    tolerance: float,
) -> FloatArray:
    """Distance from each vertex along its reversed normal to the first face that does not contain it.

    Edges count as part of a face, so that a ray cannot slip between two faces. Faces nearer than
    ``tolerance`` are copies of the vertex's own place and are passed. NaN where no face is met.

    Parameters
    ----------
    rays : (n,) int array
        The vertices in the order in which to cast.
    faces, corners : (m, 3) int32 and (m, 3, 3) float64 arrays
        In the order of the tree's leaves.
    boxes : (2 b, 6) float64 array
        Low and high corner of each node of a full binary tree: the root is 1, the children of i are 2 i and
        2 i + 1. The leaves, from b on, hold ``leaf`` faces each.
    """
    count, first_leaf = len(faces), len(boxes) // 2
    result = np.empty(len(vertices))
    stack, entries = np.empty(DEPTH, np.int64), np.empty(DEPTH)
    for v in rays:
        ox, oy, oz = vertices[v, 0], vertices[v, 1], vertices[v, 2]
        dx, dy, dz = -normals[v, 0], -normals[v, 1], -normals[v, 2]
        ix = 1.0 / (dx if abs(dx) > 1e-300 else 1e-300)
        iy = 1.0 / (dy if abs(dy) > 1e-300 else 1e-300)
        iz = 1.0 / (dz if abs(dz) > 1e-300 else 1e-300)
        best = np.inf
        stack[0], entries[0] = 1, 0.0
        depth = 1
        while depth > 0:
            depth -= 1
            if entries[depth] > best:
                continue
            node = stack[depth]
            if node < first_leaf:
                near, far = 2 * node, 2 * node + 1
                near_entry = _enter(boxes, near, ox, oy, oz, ix, iy, iz)
                far_entry = _enter(boxes, far, ox, oy, oz, ix, iy, iz)
                if far_entry < near_entry:
                    near, far, near_entry, far_entry = far, near, far_entry, near_entry
                if far_entry < best:
                    stack[depth], entries[depth] = far, far_entry
                    depth += 1
                if near_entry < best:
                    stack[depth], entries[depth] = near, near_entry
                    depth += 1
                continue
            start = (node - first_leaf) * leaf
            for place in range(start, min(start + leaf, count)):
                if faces[place, 0] == v or faces[place, 1] == v or faces[place, 2] == v:
                    continue
                # Moeller and Trumbore 1997.
                px, py, pz = corners[place, 0, 0], corners[place, 0, 1], corners[place, 0, 2]
                e1x, e1y, e1z = (
                    corners[place, 1, 0] - px,
                    corners[place, 1, 1] - py,
                    corners[place, 1, 2] - pz,
                )
                e2x, e2y, e2z = (
                    corners[place, 2, 0] - px,
                    corners[place, 2, 1] - py,
                    corners[place, 2, 2] - pz,
                )
                nx, ny, nz = e1y * e2z - e1z * e2y, e1z * e2x - e1x * e2z, e1x * e2y - e1y * e2x
                # Minus the cosine between ray and normal, times the length of the normal.
                determinant = -(dx * nx + dy * ny + dz * nz)
                if determinant * determinant <= GRAZING * GRAZING * (nx * nx + ny * ny + nz * nz):
                    continue
                sx, sy, sz = ox - px, oy - py, oz - pz
                t = (sx * nx + sy * ny + sz * nz) / determinant
                if t <= tolerance or t >= best:
                    continue
                hx, hy, hz = dy * e2z - dz * e2y, dz * e2x - dx * e2z, dx * e2y - dy * e2x
                a = (sx * hx + sy * hy + sz * hz) / determinant
                if a < -EDGE or a > 1.0 + EDGE:
                    continue
                gx, gy, gz = sy * e1z - sz * e1y, sz * e1x - sx * e1z, sx * e1y - sy * e1x
                b = (dx * gx + dy * gy + dz * gz) / determinant
                if b < -EDGE or a + b > 1.0 + EDGE:
                    continue
                best = t
        result[v] = best if best < np.inf else np.nan
    return result
