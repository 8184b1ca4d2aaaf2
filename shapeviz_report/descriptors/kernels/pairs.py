"""Point pairs in neighbourhoods: the angles of Eq. 5 and their histograms.

Angles are compared with the limits of the bins by products and square roots alone, in float32 and without
branches, so that a processor does many pairs at once. Rounding may move a pair within 1e-5 of a limit into the
bin next to it.
"""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import Float32Array, FloatArray, IntArray

WIDTH = 16
"""Pairs are treated in rows of a multiple of this many, which fill vector registers."""

SMALLEST = np.float32(1e-5)
"""Sines below this count as this: where d is parallel to u there is no v, and alpha becomes 0.

Also the least (w . n) |d x m| that counts as positive: opposite normals have theta = -pi, whatever the rounding."""

FIFTH = np.tan(np.pi * np.arange(1, 5, 2) / 5).astype(np.float32)
"""Tangents of the limits between fifths of the circle: 36 and 108 degrees."""

ELEVENTH = np.tan(np.pi * np.arange(1, 11, 2) / 11).astype(np.float32)
"""Tangents of the limits between elevenths of the circle: 16.4, 49.1, 81.8, 114.5 and 147.3 degrees."""


@kernel(error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _relate(
    dx: np.float32,
    dy: np.float32,
    dz: np.float32,
    mx: np.float32,
    my: np.float32,
    mz: np.float32,
    nx: np.float32,
    ny: np.float32,
    nz: np.float32,
) -> tuple[np.float32, np.float32, np.float32, np.float32, np.float32, np.float32]:
    """What the angles of a pair are made of, from d between its points and their normals m and n.

    With d of length one, or zero: m . d, n . d, m . n, (d x m) . n, |d x m|, |d x n|. With u = m,
    v = d x m / |d x m| and w = m x v (Eq. 4)

        alpha = v . n = (d x m) . n / |d x m|
        phi   = m . d
        theta = arctan2(w . n, m . n),  w . n = (n . d - (m . d)(m . n)) / |d x m|

    From the other end -n . d and -m . d take the places of m . d and n . d, and the rest stays.
    """
    squared = dx * dx + dy * dy + dz * dz
    inverse = np.float32(1.0) / np.sqrt(squared) if squared > np.float32(0.0) else np.float32(0.0)
    dx, dy, dz = dx * inverse, dy * inverse, dz * inverse
    cx, cy, cz = dy * mz - dz * my, dz * mx - dx * mz, dx * my - dy * mx
    ex, ey, ez = dy * nz - dz * ny, dz * nx - dx * nz, dx * ny - dy * nx
    return (
        mx * dx + my * dy + mz * dz,
        nx * dx + ny * dy + nz * dz,
        mx * nx + my * ny + mz * nz,
        cx * nx + cy * ny + cz * nz,
        max(SMALLEST, np.sqrt(cx * cx + cy * cy + cz * cz)),
        max(SMALLEST, np.sqrt(ex * ex + ey * ey + ez * ez)),
    )


@kernel(error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _fifth(value: np.float32, whole: np.float32) -> np.int32:
    """Which fifth of [-whole, whole] a value lies in, 0 to 4."""
    outer, inner = np.float32(0.6) * whole, np.float32(0.2) * whole
    return (
        np.int32(value >= -outer)
        + np.int32(value >= -inner)
        + np.int32(value > inner)
        + np.int32(value > outer)
    )


@kernel(error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def _cell(
    along_m: np.float32, along_n: np.float32, agreement: np.float32, volume: np.float32, sine: np.float32
) -> np.int32:
    """The cell of PFH for one direction of a pair: ``25 * alpha + 5 * phi + theta``, fifths of each."""
    y, x = along_n - along_m * agreement, agreement * sine
    beyond = np.int32(abs(y) >= x * FIFTH[0]) + np.int32(abs(y) <= x * FIFTH[1])
    side = np.int32(2) * np.int32(y > SMALLEST) - np.int32(1)
    theta = np.int32(2) + side * beyond
    alpha, phi = _fifth(volume, sine), _fifth(along_m, np.float32(1.0))
    return np.int32(25) * alpha + np.int32(5) * phi + theta


@kernel(error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def count_pfh(vertices: Float32Array, normals: Float32Array, neighbours: IntArray) -> Float32Array:
    """Share of the ordered pairs of each neighbourhood in 5 x 5 x 5 cells of (alpha, phi, theta).

    Alpha and phi over [-1, 1], theta over [-pi, pi]. (n, 125) float32.
    """
    count, size = neighbours.shape
    width = -(-size // WIDTH) * WIDTH
    result = np.empty((count, 125), np.float32)
    # The neighbourhood twice over: its pairs are then each row of points with a later row.
    x, y, z = (
        np.empty(2 * width, np.float32),
        np.empty(2 * width, np.float32),
        np.empty(2 * width, np.float32),
    )
    u, v, w = (
        np.empty(2 * width, np.float32),
        np.empty(2 * width, np.float32),
        np.empty(2 * width, np.float32),
    )
    forward, backward = np.empty(width, np.int32), np.empty(width, np.int32)
    tally = np.empty((4, 125), np.int32)
    share = 1.0 / (size * (size - 1))
    for i in range(count):
        for s in range(2 * width):
            j = neighbours[i, s % size]
            x[s], y[s], z[s] = (
                vertices[j, 0] - vertices[i, 0],
                vertices[j, 1] - vertices[i, 1],
                vertices[j, 2] - vertices[i, 2],
            )
            u[s], v[s], w[s] = normals[j, 0], normals[j, 1], normals[j, 2]
        for cell in range(125):
            tally[0, cell] = tally[1, cell] = tally[2, cell] = tally[3, cell] = 0
        for apart in range(1, size // 2 + 1):
            for s in range(width):
                t = s + apart
                along_m, along_n, agreement, volume, sine_m, sine_n = _relate(
                    x[t] - x[s], y[t] - y[s], z[t] - z[s], u[s], v[s], w[s], u[t], v[t], w[t]
                )
                forward[s] = _cell(along_m, along_n, agreement, volume, sine_m)
                backward[s] = _cell(-along_n, -along_m, agreement, volume, sine_n)
            # Four tallies in turn: consecutive equal cells would wait for each other in one.
            pairs = size if 2 * apart < size else apart
            for s in range(0, pairs - 1, 2):
                tally[0, forward[s]] += 1
                tally[1, backward[s]] += 1
                tally[2, forward[s + 1]] += 1
                tally[3, backward[s + 1]] += 1
            if pairs % 2:
                tally[0, forward[pairs - 1]] += 1
                tally[1, backward[pairs - 1]] += 1
        for cell in range(125):
            pairs = tally[0, cell] + tally[1, cell] + tally[2, cell] + tally[3, cell]
            result[i, cell] = pairs * share
    return result


@kernel(error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def count_spfh(vertices: Float32Array, normals: Float32Array, neighbours: IntArray) -> Float32Array:
    """Share of the pairs (vertex, neighbour) in 11 bins each of alpha, phi and theta: (n, 33) float32."""
    count, size = neighbours.shape
    result = np.empty((count, 33), np.float32)
    bins = np.empty((3, size), np.int32)
    x, y, z = np.empty(size, np.float32), np.empty(size, np.float32), np.empty(size, np.float32)
    u, v, w = np.empty(size, np.float32), np.empty(size, np.float32), np.empty(size, np.float32)
    share = np.float32(1.0 / size)
    half, one, last = np.float32(5.5), np.float32(1.0), np.float32(10.0)
    for i in range(count):
        for s in range(size):
            j = neighbours[i, s]
            x[s], y[s], z[s] = (
                vertices[j, 0] - vertices[i, 0],
                vertices[j, 1] - vertices[i, 1],
                vertices[j, 2] - vertices[i, 2],
            )
            u[s], v[s], w[s] = normals[j, 0], normals[j, 1], normals[j, 2]
        p, q, r = np.float32(normals[i, 0]), np.float32(normals[i, 1]), np.float32(normals[i, 2])
        for s in range(size):
            phi, along_n, agreement, volume, sine, _ = _relate(x[s], y[s], z[s], p, q, r, u[s], v[s], w[s])
            height, side = along_n - phi * agreement, agreement * sine
            beyond = np.int32(abs(height) >= side * ELEVENTH[0]) + np.int32(abs(height) >= side * ELEVENTH[1])
            beyond += np.int32(abs(height) >= side * ELEVENTH[2]) + np.int32(
                abs(height) <= side * ELEVENTH[3]
            )
            beyond += np.int32(abs(height) <= side * ELEVENTH[4])
            turn = np.int32(2) * np.int32(height > SMALLEST) - np.int32(1)
            bins[0, s] = np.int32(min(last, (volume / sine + one) * half))
            bins[1, s] = np.int32(11) + np.int32(min(last, (phi + one) * half))
            bins[2, s] = np.int32(27) + turn * beyond
        for b in range(33):
            result[i, b] = np.float32(0.0)
        for s in range(size):
            for group in range(3):
                result[i, bins[group, s]] += share
    return result


@kernel(error_model="numpy", fastmath={"contract", "nsz", "arcp"})
def average_spfh(
    spfh: Float32Array, neighbours: IntArray, distances: FloatArray, floor: float
) -> Float32Array:
    """Eq. 6: each SPFH plus the mean of its neighbours', weighted by one over their distance.

    Distances below ``floor`` count as ``floor``.
    """
    count, size = neighbours.shape
    result = np.empty((count, 33), np.float32)
    for i in range(count):
        for b in range(33):
            result[i, b] = spfh[i, b]
        for s in range(size):
            weight = np.float32(1.0 / (size * max(distances[i, s], floor)))
            j = neighbours[i, s]
            for b in range(33):
                result[i, b] += weight * spfh[j, b]
    return result
