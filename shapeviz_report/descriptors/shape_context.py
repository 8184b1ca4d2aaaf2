"""Shape context (Sc), paper 3.3, after Belongie et al. 2001."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.kernels.contexts import count_contexts, frame_vertices
from shapeviz_report.descriptors.surface import Surface

SHELLS = (0.1, 0.3)
"""Inner limits of the distance set T = [0, 0.1, 0.3, 1], as fractions of the largest possible distance, 2."""

SEEN = 2_000
"""At most this many vertices are counted: every second, third, ... of a larger mesh, along a curve through space.

Against counting all, that moves a share by 0.0007 on average (meshes of 3,600 to 17,000 vertices)."""


def compute(surface: Surface) -> np.ndarray:
    """Share of the other vertices in each octant and distance shell of a local frame.

    The frame of a vertex is its normal and the eigenvectors of the covariance of its 30 nearest neighbours
    in the tangent plane. Both tangents are turned towards the barycentre: that gives them the signs that
    eigenvectors lack, and gives a shape and its mirror image the same values. The shells are (0, 0.1],
    (0.1, 0.3] and (0.3, 1] of the diameter of the normalised shape.

    Returns
    -------
    (n, 24) float32 array
        In [0, 1], each row adds up to 1. Dimension ``8 * shell + octant``; the octant is 1 for what lies along
        the first tangent, plus 2 along the second, plus 4 along the normal. Zero for a vertex that is alone.
        Where the neighbourhood spreads equally in all tangent directions the frame, hence the split between
        octants of one side, is arbitrary.
    """
    vertices, normals = surface.vertices, surface.normals
    tangents = frame_vertices(vertices, normals, surface.neighbours, surface.barycentre)
    seen = np.ascontiguousarray(vertices[surface.curve[:: -(-len(vertices) // SEEN)]].T, dtype=np.float32)
    limits = np.array(SHELLS, dtype=np.float32) * np.float32(2)
    frames = [np.ascontiguousarray(axis, dtype=np.float32) for axis in (*tangents, normals)]
    return count_contexts(vertices.astype(np.float32), *frames, seen, limits)


SHAPE_CONTEXT = Descriptor(
    name="Sc",
    title="Shape context",
    measures="How the rest of the shape lies around a point: how much of it is near or far, in front or behind.",
    dimensions=24,
    edges=tuple(float(x) for x in np.linspace(0.0, 0.8, 11) ** 2),
    compute=compute,
    totals=tuple(range(1, SEEN + 1)),
)
