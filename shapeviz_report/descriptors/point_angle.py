"""Point angle (Pa), paper 3.3."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.surface import Surface
from shapeviz_report.types import FloatArray


def compute(surface: Surface) -> FloatArray:
    r"""Direction of the barycentre relative to the axis in which the shape spreads most.

    .. math:: Pa(x) = \left| e_1 \cdot \frac{c - x}{\|c - x\|} \right|

    with the dominant eigenvector :math:`e_1` of the covariance of the vertices and their mean :math:`c`. The
    absolute value is taken since an eigenvector has no sign.

    Returns
    -------
    (n, 1) float64 array
        In [0, 1]: 1 at the ends of the axis, 0 around the waist; 0 for a vertex at the barycentre.
    """
    towards = surface.barycentre - surface.vertices
    length = np.linalg.norm(towards, axis=1)
    length[length == 0] = 1
    return np.abs(towards @ surface.main_axis / length)[:, None]


POINT_ANGLE = Descriptor(
    name="Pa",
    title="Point angle",
    measures="Whether a point lies towards the ends of the shape's longest direction or around its waist.",
    dimensions=1,
    edges=tuple(float(x) for x in np.linspace(0.0, 1.0, 11)),
    compute=compute,
)
