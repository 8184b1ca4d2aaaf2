"""Normal angle (Na), paper 3.3."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.surface import Surface
from shapeviz_report.types import FloatArray


def compute(surface: Surface) -> FloatArray:
    r"""Direction of the surface relative to the axis in which the shape spreads most.

    .. math:: Na(x) = |e_1 \cdot n(x)|

    with the dominant eigenvector :math:`e_1` of the covariance of the vertices. The absolute value is taken
    since an eigenvector has no sign.

    Returns
    -------
    (n, 1) float64 array
        In [0, 1]: 0 where the surface runs along the axis, 1 where it faces along it. A shape that spreads
        equally in two directions (a ball, a square plate) has no definite axis; then so are its values.
    """
    return np.abs(surface.normals @ surface.main_axis)[:, None]


NORMAL_ANGLE = Descriptor(
    name="Na",
    title="Normal angle",
    measures="Whether the surface runs along the shape's longest direction or faces its ends.",
    dimensions=1,
    edges=tuple(float(x) for x in np.linspace(0.0, 1.0, 11)),
    compute=compute,
)
