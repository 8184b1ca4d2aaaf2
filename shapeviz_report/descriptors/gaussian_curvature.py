"""Gaussian curvature (Gc), paper Eq. 1."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.surface import Surface
from shapeviz_report.types import FloatArray


def compute(surface: Surface) -> FloatArray:
    r"""Angle defect of every vertex.

    .. math:: Gc(x) = 2\pi - \sum_{f \in F(x)} \theta_{x,f}

    The integral of Gaussian curvature over the vertex's share of the surface (Gauss-Bonnet): the values of a
    closed surface add up to :math:`2\pi\chi`. On a boundary :math:`\pi` takes the place of :math:`2\pi`, which
    keeps that theorem and makes a straight border flat.

    Returns
    -------
    (n, 1) float64 array
        Radians, at most 2 pi: positive on bumps and tips, 0 where flat, negative on saddles. It falls with the
        square of the edge length, hence remeshing to one edge length first. Vertices of no face: 2 pi.
    """
    full = np.where(surface.on_boundary, np.pi, 2 * np.pi)
    return (full - surface.angle_sums)[:, None]


GAUSSIAN_CURVATURE = Descriptor(
    name="Gc",
    title="Gaussian curvature",
    measures="How the surface bends at a point: like a bump or tip, flat or rolled, or like a saddle.",
    dimensions=1,
    # Zero in the middle of a bin: rounding must not deal out what is flat to two.
    edges=tuple(float(x) for x in np.linspace(-0.09, 0.11, 11)),
    compute=compute,
)
