"""Point pairs in neighbourhoods: the angles of Eq. 5 and their histograms."""

import numpy as np
from numba import njit

TAN_36 = np.tan(np.pi / 5)
TAN_72 = np.tan(2 * np.pi / 5)


@njit(cache=True, error_model="numpy")
def _pair(px, py, pz, mx, my, mz, qx, qy, qz, nx, ny, nz):  # pragma: no cover - compiled
    """alpha, phi, and the two arguments of theta's arctangent, for source p with normal m and target q with n.

    The frame is u = m, v = (q - p) x u / |.|, w = u x v (Eq. 4). Where q - p is parallel to u, v is taken as
    zero, hence alpha = 0 and theta = atan2(0, u . n).
    """
    dx, dy, dz = qx - px, qy - py, qz - pz
    length = np.sqrt(dx * dx + dy * dy + dz * dz)
    if length == 0.0:
        return 0.0, 0.0, 0.0, mx * nx + my * ny + mz * nz
    phi = (mx * dx + my * dy + mz * dz) / length
    vx, vy, vz = dy * mz - dz * my, dz * mx - dx * mz, dx * my - dy * mx
    size = np.sqrt(vx * vx + vy * vy + vz * vz)
    if size > 1e-12 * length:
        vx, vy, vz = vx / size, vy / size, vz / size
    else:
        vx, vy, vz = 0.0, 0.0, 0.0
    wx, wy, wz = my * vz - mz * vy, mz * vx - mx * vz, mx * vy - my * vx
    alpha = vx * nx + vy * ny + vz * nz
    return alpha, phi, wx * nx + wy * ny + wz * nz, mx * nx + my * ny + mz * nz


@njit(cache=True, error_model="numpy")
def count_pfh(vertices, normals, neighbours):  # pragma: no cover - compiled
    """Share of the ordered pairs of each neighbourhood in 5 x 5 x 5 cells of (alpha, phi, theta).

    Cell ``25 * a + 5 * p + t``; alpha and phi over [-1, 1], theta over [-pi, pi].
    """
    count, size = neighbours.shape
    result = np.zeros((count, 125), np.float32)
    points = np.empty((size, 6))
    for i in range(count):
        for s in range(size):
            j = neighbours[i, s]
            for x in range(3):
                points[s, x] = vertices[j, x]
                points[s, x + 3] = normals[j, x]
        for s in range(size):
            for t in range(size):
                if s == t:
                    continue
                alpha, phi, y, x = _pair(
                    points[s, 0], points[s, 1], points[s, 2], points[s, 3], points[s, 4], points[s, 5],
                    points[t, 0], points[t, 1], points[t, 2], points[t, 3], points[t, 4], points[t, 5],
                )  # fmt: skip
                a = min(4, max(0, int((alpha + 1.0) * 2.5)))
                p = min(4, max(0, int((phi + 1.0) * 2.5)))
                # Fifths of the circle by comparing with tangents: no arctangent needed.
                if abs(y) < x * TAN_36:
                    c = 2
                elif x >= 0.0 or abs(y) > -x * TAN_72:
                    c = 3 if y > 0.0 else 1
                else:
                    c = 4 if y > 0.0 else 0
                result[i, 25 * a + 5 * p + c] += np.float32(1.0)
        for cell in range(125):
            result[i, cell] /= np.float32(size * (size - 1))
    return result


@njit(cache=True, error_model="numpy")
def count_spfh(vertices, normals, neighbours):  # pragma: no cover - compiled
    """Share of the pairs (vertex, neighbour) in 11 bins each of alpha, phi and theta: (n, 33)."""
    count, size = neighbours.shape
    result = np.zeros((count, 33), np.float32)
    for i in range(count):
        for s in range(size):
            j = neighbours[i, s]
            alpha, phi, y, x = _pair(
                vertices[i, 0], vertices[i, 1], vertices[i, 2], normals[i, 0], normals[i, 1], normals[i, 2],
                vertices[j, 0], vertices[j, 1], vertices[j, 2], normals[j, 0], normals[j, 1], normals[j, 2],
            )  # fmt: skip
            theta = np.arctan2(y, x)
            result[i, min(10, max(0, int((alpha + 1.0) * 5.5)))] += np.float32(1.0)
            result[i, 11 + min(10, max(0, int((phi + 1.0) * 5.5)))] += np.float32(1.0)
            result[i, 22 + min(10, max(0, int((theta / np.pi + 1.0) * 5.5)))] += np.float32(1.0)
        for b in range(33):
            result[i, b] /= np.float32(size)
    return result


@njit(cache=True, error_model="numpy")
def average_spfh(spfh, neighbours, distances, floor):  # pragma: no cover - compiled
    """Eq. 6: each SPFH plus the mean of its neighbours', weighted by one over their distance.

    Distances below ``floor`` count as ``floor``.
    """
    count, size = neighbours.shape
    result = spfh.copy()
    for i in range(count):
        for s in range(size):
            weight = np.float32(1.0 / (size * max(distances[i, s], floor)))
            for b in range(spfh.shape[1]):
                result[i, b] += weight * spfh[neighbours[i, s], b]
    return result
