"""Local frames and the counts of shape contexts."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import Float32Array, FloatArray, IntArray

BESIDE = np.float32(1e-5)
"""What is less than this in front of a plane counts as behind it, lest rounding decide on flat surfaces."""


@kernel()
def frame_vertices(
    vertices: FloatArray, normals: FloatArray, neighbours: IntArray, centre: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """A local frame a vertex: two tangents (n, 3) each; the third axis is the normal.

    The first tangent is the dominant eigenvector of the covariance of the neighbourhood within the tangent
    plane. Both tangents point towards ``centre``, which fixes the signs that eigenvectors lack.
    """
    count = len(vertices)
    first = np.empty((count, 3))
    second = np.empty((count, 3))
    for i in range(count):
        nx, ny, nz = normals[i, 0], normals[i, 1], normals[i, 2]
        # Any basis of the tangent plane; Duff et al. 2017.
        sign = 1.0 if nz >= 0.0 else -1.0
        a = -1.0 / (sign + nz)
        b = nx * ny * a
        ux, uy, uz = 1.0 + sign * nx * nx * a, sign * b, -sign * nx
        vx, vy, vz = b, sign + ny * ny * a, -ny
        size = neighbours.shape[1]
        mean_u = mean_v = uu = uv = vv = 0.0
        for s in range(size):
            j = neighbours[i, s]
            dx, dy, dz = (
                vertices[j, 0] - vertices[i, 0],
                vertices[j, 1] - vertices[i, 1],
                vertices[j, 2] - vertices[i, 2],
            )
            p = dx * ux + dy * uy + dz * uz
            q = dx * vx + dy * vy + dz * vz
            mean_u += p
            mean_v += q
            uu += p * p
            uv += p * q
            vv += q * q
        uu -= mean_u * mean_u / size
        uv -= mean_u * mean_v / size
        vv -= mean_v * mean_v / size
        angle = 0.5 * np.arctan2(2.0 * uv, uu - vv)
        cos, sin = np.cos(angle), np.sin(angle)
        px, py, pz = cos * ux + sin * vx, cos * uy + sin * vy, cos * uz + sin * vz
        qx, qy, qz = cos * vx - sin * ux, cos * vy - sin * uy, cos * vz - sin * uz
        ax, ay, az = vertices[i, 0] - centre[0], vertices[i, 1] - centre[1], vertices[i, 2] - centre[2]
        turn_first = -1.0 if px * ax + py * ay + pz * az > 0.0 else 1.0
        turn_second = -1.0 if qx * ax + qy * ay + qz * az > 0.0 else 1.0
        first[i, 0], first[i, 1], first[i, 2] = turn_first * px, turn_first * py, turn_first * pz
        second[i, 0], second[i, 1], second[i, 2] = turn_second * qx, turn_second * qy, turn_second * qz
    return first, second


@kernel(error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def count_contexts(
    vertices: Float32Array,
    first: Float32Array,
    second: Float32Array,
    normals: Float32Array,
    seen: Float32Array,
    limits: Float32Array,
) -> Float32Array:
    """Share of the points ``seen`` in each octant and distance shell around each vertex.

    Column ``8 * shell + octant``; an octant is 1 if in front along the first tangent, plus 2 along the second,
    plus 4 along the normal. ``limits`` are the two inner shell radii. A vertex does not see itself.

    All in float32: (n, 3) arrays and seen (3, s); the result is (n, 24).
    """
    count, size = len(vertices), seen.shape[1]
    result = np.empty((count, 24), np.float32)
    codes = np.empty(size, np.uint8)
    tally = np.empty((4, 256), np.int64)
    inner, outer = limits[0] * limits[0], limits[1] * limits[1]
    xs, ys, zs = seen[0], seen[1], seen[2]
    for i in range(count):
        x, y, z = vertices[i, 0], vertices[i, 1], vertices[i, 2]
        ax, ay, az = first[i, 0], first[i, 1], first[i, 2]
        bx, by, bz = second[i, 0], second[i, 1], second[i, 2]
        cx, cy, cz = normals[i, 0], normals[i, 1], normals[i, 2]
        zero = np.float32(0.0)
        for j in range(size):
            dx, dy, dz = xs[j] - x, ys[j] - y, zs[j] - z
            squared = dx * dx + dy * dy + dz * dz
            code = np.uint8(ax * dx + ay * dy + az * dz > BESIDE)
            code |= np.uint8(bx * dx + by * dy + bz * dz > BESIDE) << np.uint8(1)
            code |= np.uint8(cx * dx + cy * dy + cz * dz > BESIDE) << np.uint8(2)
            code += np.uint8(squared > inner) << np.uint8(3)
            code += np.uint8(squared > outer) << np.uint8(3)
            codes[j] = code + (np.uint8(squared == zero) << np.uint8(5))
        tally[:] = 0
        # Four tallies in turn: consecutive equal codes would wait for each other in one.
        for j in range(0, size - 3, 4):
            tally[0, codes[j]] += 1
            tally[1, codes[j + 1]] += 1
            tally[2, codes[j + 2]] += 1
            tally[3, codes[j + 3]] += 1
        for j in range(size - size % 4, size):
            tally[0, codes[j]] += 1
        others = 0
        for cell in range(24):
            tally[0, cell] += tally[1, cell] + tally[2, cell] + tally[3, cell]
            others += tally[0, cell]
        share = 1.0 / others if others > 0 else 0.0
        for cell in range(24):
            result[i, cell] = tally[0, cell] * share
    return result
