"""The first face a ray meets, by a tree of bounding boxes."""

import numpy as np
from numba import njit

LEAF_SIZE = 4
DEPTH = 64
"""Deeper than any tree gets: halving 2^31 faces down to leaves takes 29 levels."""


@njit(cache=True)
def build_tree(vertices, faces):  # pragma: no cover - compiled
    """A tree of axis-aligned boxes over faces, split at the median of the longest side.

    Returns
    -------
    boxes : (t, 6) float64 array
        Low and high corner of each node.
    ranges : (t, 2) int32 array
        First and end position in ``order`` for a leaf; (-1, right child) for an inner node, whose left child
        is the next node.
    order : (m,) int32 array
        Faces, leaf by leaf.
    """
    count = len(faces)
    centres = np.empty((count, 3))
    for f in range(count):
        for x in range(3):
            a, b, c = vertices[faces[f, 0], x], vertices[faces[f, 1], x], vertices[faces[f, 2], x]
            centres[f, x] = (a + b + c) / 3.0
    order = np.empty(count, np.int32)
    for f in range(count):
        order[f] = f
    boxes = np.empty((2 * count + 1, 6))
    ranges = np.empty((2 * count + 1, 2), np.int32)
    stack_start = np.empty(DEPTH, np.int64)
    stack_end = np.empty(DEPTH, np.int64)
    stack_parent = np.empty(DEPTH, np.int64)
    stack_start[0], stack_end[0], stack_parent[0] = 0, count, -1
    depth, node = 1, 0
    while depth > 0:
        depth -= 1
        start, end, parent = stack_start[depth], stack_end[depth], stack_parent[depth]
        if parent >= 0:
            ranges[parent, 1] = node
        axis, widest = 0, -1.0
        for x in range(3):
            low, high, centre_low, centre_high = np.inf, -np.inf, np.inf, -np.inf
            for position in range(start, end):
                f = order[position]
                for corner in range(3):
                    value = vertices[faces[f, corner], x]
                    low = min(low, value)
                    high = max(high, value)
                centre_low = min(centre_low, centres[f, x])
                centre_high = max(centre_high, centres[f, x])
            boxes[node, x] = low
            boxes[node, x + 3] = high
            if centre_high - centre_low > widest:
                axis, widest = x, centre_high - centre_low
        if end - start <= LEAF_SIZE:
            ranges[node, 0], ranges[node, 1] = start, end
        else:
            middle = (start + end) // 2
            _select(order, centres, axis, start, end - 1, middle)
            ranges[node, 0] = -1
            stack_start[depth], stack_end[depth], stack_parent[depth] = middle, end, node
            stack_start[depth + 1], stack_end[depth + 1], stack_parent[depth + 1] = start, middle, -1
            depth += 2
        node += 1
    return boxes[:node], ranges[:node], order


@njit(cache=True)
def _select(order, centres, axis, left, right, middle):  # pragma: no cover - compiled
    """Hoare's selection: reorder ``order[left:right + 1]`` so that ``middle`` separates low from high."""
    while left < right:
        pivot = centres[order[(left + right) // 2], axis]
        i, j = left, right
        while i <= j:
            while centres[order[i], axis] < pivot:
                i += 1
            while centres[order[j], axis] > pivot:
                j -= 1
            if i <= j:
                order[i], order[j] = order[j], order[i]
                i += 1
                j -= 1
        if middle <= j:
            right = j
        elif middle >= i:
            left = i
        else:
            return


@njit(cache=True)
def cast_inward(vertices, faces, normals, boxes, ranges, order, tolerance):  # pragma: no cover - compiled
    """Distance from each vertex along its reversed normal to the first face that does not contain it.

    Edges count as part of a face, so that a ray cannot slip between two faces. Faces nearer than
    ``tolerance`` are copies of the vertex's own place and are passed. NaN where no face is met.
    """
    count = len(vertices)
    result = np.full(count, np.nan)
    stack = np.empty(DEPTH, np.int32)
    inverse = np.empty(3)
    for v in range(count):
        ox, oy, oz = vertices[v, 0], vertices[v, 1], vertices[v, 2]
        dx, dy, dz = -normals[v, 0], -normals[v, 1], -normals[v, 2]
        for x in range(3):
            direction = -normals[v, x]
            if abs(direction) < 1e-300:
                direction = 1e-300
            inverse[x] = 1.0 / direction
        best = np.inf
        stack[0] = 0
        depth = 1
        while depth > 0:
            depth -= 1
            node = stack[depth]
            enter, leave = 0.0, best
            for x in range(3):
                near = (boxes[node, x] - vertices[v, x]) * inverse[x]
                far = (boxes[node, x + 3] - vertices[v, x]) * inverse[x]
                if near > far:
                    near, far = far, near
                # A box may be flat: leave room for rounding.
                enter = max(enter, near - 1e-12)
                leave = min(leave, far + 1e-12)
            if enter > leave:
                continue
            if ranges[node, 0] < 0:
                stack[depth] = ranges[node, 1]
                stack[depth + 1] = node + 1
                depth += 2
                continue
            for position in range(ranges[node, 0], ranges[node, 1]):
                f = order[position]
                p, q, r = faces[f, 0], faces[f, 1], faces[f, 2]
                if v in (p, q, r):
                    continue
                # Moeller and Trumbore 1997.
                e1x, e1y, e1z = (
                    vertices[q, 0] - vertices[p, 0],
                    vertices[q, 1] - vertices[p, 1],
                    vertices[q, 2] - vertices[p, 2],
                )
                e2x, e2y, e2z = (
                    vertices[r, 0] - vertices[p, 0],
                    vertices[r, 1] - vertices[p, 1],
                    vertices[r, 2] - vertices[p, 2],
                )
                hx, hy, hz = dy * e2z - dz * e2y, dz * e2x - dx * e2z, dx * e2y - dy * e2x
                determinant = e1x * hx + e1y * hy + e1z * hz
                if abs(determinant) < 1e-18:
                    continue
                sx, sy, sz = ox - vertices[p, 0], oy - vertices[p, 1], oz - vertices[p, 2]
                a = (sx * hx + sy * hy + sz * hz) / determinant
                if a < -1e-9 or a > 1.0 + 1e-9:
                    continue
                gx, gy, gz = sy * e1z - sz * e1y, sz * e1x - sx * e1z, sx * e1y - sy * e1x
                b = (dx * gx + dy * gy + dz * gz) / determinant
                if b < -1e-9 or a + b > 1.0 + 1e-9:
                    continue
                t = (e2x * gx + e2y * gy + e2z * gz) / determinant
                if tolerance < t < best:
                    best = t
        if best < np.inf:
            result[v] = best
    return result
