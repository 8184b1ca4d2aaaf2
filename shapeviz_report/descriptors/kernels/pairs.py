"""Point pairs in neighbourhoods: the angles of Eq. 5 and their histograms."""

import numpy as np
from numba import njit

TAN_36 = np.tan(np.pi / 5)
TAN_72 = np.tan(2 * np.pi / 5)


@njit(cache=True, error_model="numpy")
def _relate(vertices, normals, i, j):  # pragma: no cover - compiled
    """What both directions of a pair need: m . d / |d|, n . d / |d|, m . n, (m x n) . d / |d|.

    d leads from vertex i with normal m to vertex j with normal n.
    """
    dx, dy, dz = (
        vertices[j, 0] - vertices[i, 0],
        vertices[j, 1] - vertices[i, 1],
        vertices[j, 2] - vertices[i, 2],
    )
    mx, my, mz = normals[i, 0], normals[i, 1], normals[i, 2]
    nx, ny, nz = normals[j, 0], normals[j, 1], normals[j, 2]
    length = np.sqrt(dx * dx + dy * dy + dz * dz)
    inverse = 1.0 / length if length > 0.0 else 0.0
    dx, dy, dz = dx * inverse, dy * inverse, dz * inverse
    volume = (my * nz - mz * ny) * dx + (mz * nx - mx * nz) * dy + (mx * ny - my * nx) * dz
    along_m = mx * dx + my * dy + mz * dz
    along_n = nx * dx + ny * dy + nz * dz
    return along_m, along_n, mx * nx + my * ny + mz * nz, volume


@njit(cache=True, error_model="numpy")
def _angles(along_m, along_n, agreement, volume):  # pragma: no cover - compiled
    """alpha, and the first argument of theta's arctangent; the second is ``agreement``, phi is ``along_m``.

    With u = m, v = d x m / |d x m| and w = m x v (Eq. 4), |d x m|^2 = 1 - (m . d)^2 for unit d, and
    alpha = v . n = (m x n) . d / |d x m|, w . n = (n . d - (m . d)(m . n)) / |d x m|. Where d is parallel to m, or
    zero, v is taken as zero. From j to i, -n . d and -m . d change places and the rest stays.
    """
    squared = 1.0 - along_m * along_m
    scale = 1.0 / np.sqrt(squared) if squared > 1e-12 else 0.0
    return volume * scale, (along_n - along_m * agreement) * scale


@njit(cache=True, error_model="numpy")
def _cell(along_m, along_n, agreement, volume):  # pragma: no cover - compiled
    """The cell of PFH for one direction of a pair: ``25 * alpha + 5 * phi + theta``, fifths of each."""
    alpha, y = _angles(along_m, along_n, agreement, volume)
    a = np.int32(min(4.0, max(0.0, (alpha + 1.0) * 2.5)))
    p = np.int32(min(4.0, max(0.0, (along_m + 1.0) * 2.5)))
    # Fifths of the circle by comparing with tangents: no arctangent, and no branch to guess.
    height = abs(y)
    beyond_first = np.int32(height >= agreement * TAN_36)
    beyond_second = np.int32(height <= -agreement * TAN_72)
    t = np.int32(2) + (beyond_first + beyond_second) * (np.int32(2) * np.int32(y > 0.0) - np.int32(1))
    return np.int32(25) * a + np.int32(5) * p + t


@njit(cache=True, error_model="numpy")
def count_pfh(vertices, normals, neighbours):  # pragma: no cover - compiled
    """Share of the ordered pairs of each neighbourhood in 5 x 5 x 5 cells of (alpha, phi, theta).

    Alpha and phi over [-1, 1], theta over [-pi, pi].
    """
    count, size = neighbours.shape
    result = np.zeros((count, 125), np.float32)
    points = np.empty((size, 3))
    directions = np.empty((size, 3))
    forward = np.empty(size, np.int32)
    backward = np.empty(size, np.int32)
    tally = np.empty(125, np.int32)
    for i in range(count):
        for s in range(size):
            j = neighbours[i, s]
            for x in range(3):
                points[s, x] = vertices[j, x]
                directions[s, x] = normals[j, x]
        for cell in range(125):
            tally[cell] = 0
        for s in range(size):
            for t in range(s):
                along_m, along_n, agreement, volume = _relate(points, directions, s, t)
                forward[t] = _cell(along_m, along_n, agreement, volume)
                backward[t] = _cell(-along_n, -along_m, agreement, volume)
            for t in range(s):
                tally[forward[t]] += 1
                tally[backward[t]] += 1
        for cell in range(125):
            result[i, cell] = tally[cell] / (size * (size - 1))
    return result


@njit(cache=True, error_model="numpy")
def count_spfh(vertices, normals, neighbours):  # pragma: no cover - compiled
    """Share of the pairs (vertex, neighbour) in 11 bins each of alpha, phi and theta: (n, 33)."""
    count, size = neighbours.shape
    result = np.zeros((count, 33), np.float32)
    one = np.float32(1.0)
    for i in range(count):
        for s in range(size):
            phi, along_n, agreement, volume = _relate(vertices, normals, i, neighbours[i, s])
            alpha, y = _angles(phi, along_n, agreement, volume)
            theta = np.arctan2(y, agreement)
            result[i, min(10, max(0, int((alpha + 1.0) * 5.5)))] += one
            result[i, 11 + min(10, max(0, int((phi + 1.0) * 5.5)))] += one
            result[i, 22 + min(10, max(0, int((theta / np.pi + 1.0) * 5.5)))] += one
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
