"""Corner angles: angle sums and angle-weighted normals of vertices."""

import numpy as np
from numba import njit


@njit(cache=True)
def gather_angles(vertices, faces):  # pragma: no cover - compiled
    """Per vertex: the sum of its corner angles (n,), and its unit normal (n, 3).

    The normal is the sum of unit face normals weighted by corner angle (paper, Eq. 3). Where that sum
    vanishes it is the normal of the vertex's largest face, or (0, 0, 1) without any face that has an area.
    """
    count = len(vertices)
    sums = np.zeros(count)
    normals = np.zeros((count, 3))
    largest = np.zeros(count)
    fallback = np.zeros((count, 3))
    fallback[:, 2] = 1.0
    for f in range(len(faces)):
        a, b, c = vertices[faces[f, 0]], vertices[faces[f, 1]], vertices[faces[f, 2]]
        normal = np.cross(b - a, c - a)
        twice_area = np.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
        if twice_area == 0.0:
            continue
        normal /= twice_area
        for corner in range(3):
            vertex = faces[f, corner]
            here = vertices[vertex]
            left = vertices[faces[f, (corner + 1) % 3]] - here
            right = vertices[faces[f, (corner + 2) % 3]] - here
            dot = left[0] * right[0] + left[1] * right[1] + left[2] * right[2]
            # atan2 of cross and dot is exact for slivers, where arccos loses half its digits.
            angle = np.arctan2(twice_area, dot)
            sums[vertex] += angle
            normals[vertex] += angle * normal
            if twice_area > largest[vertex]:
                largest[vertex] = twice_area
                fallback[vertex] = normal
    for vertex in range(count):
        length = np.sqrt(normals[vertex, 0] ** 2 + normals[vertex, 1] ** 2 + normals[vertex, 2] ** 2)
        if length > 1e-12:
            normals[vertex] /= length
        else:
            normals[vertex] = fallback[vertex]
    return sums, normals
