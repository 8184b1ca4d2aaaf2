"""Normal diameter (Nd), paper 3.3."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.kernels.rays import cast_inward
from shapeviz_report.descriptors.surface import Surface
from shapeviz_report.mesh.boxes import LEAF, along_curve, box_faces
from shapeviz_report.types import FloatArray

SAME_PLACE = 1e-6
"""Faces nearer than this along the ray are copies of the vertex's own place, left by cutting the surface."""


def compute(surface: Surface) -> FloatArray:
    """Thickness below every vertex: the way along its reversed normal to the next face.

    The ray starts at the vertex itself, and the faces around the vertex are left out by their indices rather
    than by an offset that could jump over a near wall. Faces are met from either side.

    Returns
    -------
    (n, 1) float64 array
        In units of the normalised shape (radius 1), in [0, 2]. A ray that meets nothing, as on an open sheet
        or a folded face, gives 0: there is no thickness to measure.
    """
    vertices, normals = surface.vertices, surface.normals
    a, b, c = (vertices[corner] for corner in surface.faces.T)
    order = along_curve(a + b + c)
    faces = surface.faces[order]
    corners = vertices[faces]
    # Rays that begin near each other meet the same boxes, which then are at hand.
    thickness = cast_inward(
        vertices, normals, surface.curve, faces, corners, box_faces(corners), LEAF, SAME_PLACE
    )
    return np.nan_to_num(thickness, nan=0.0)[:, None]


NORMAL_DIAMETER = Descriptor(
    name="Nd",
    title="Normal diameter",
    measures="How thick the shape is below a point: thin sheets and limbs against full bodies.",
    dimensions=1,
    edges=tuple(float(x) for x in np.linspace(0.0, 1.0, 11)),
    compute=compute,
)
