"""Panorama of slants (PanS): how the outer surface slants around each main axis (after Papadakis et al. 2010)."""

from __future__ import annotations

import numpy as np

from shapeviz_report.global_descriptors.base import GlobalDescriptor
from shapeviz_report.global_descriptors.posed_shape import WAVES_AROUND, PosedShape
from shapeviz_report.types import FloatArray


def compute(shape: PosedShape) -> FloatArray:
    r"""Spectra of :math:`|n \cdot r|` over height and azimuth around each axis.

    n is the normal and r the direction from the axis; a cell has the mean over the surface at most 0.1 units below its
    farthest point, nearer ones counting less: one point alone would not be steady.

    Returns
    -------
    (105,) float64 array
        At least 0; ordered as :mod:`~shapeviz_report.global_descriptors.panorama` has them.
    """
    return np.sqrt(shape.panoramas[1]).ravel()


PANORAMA_SLANT = GlobalDescriptor(
    name="PanS",
    title="Panorama of slants",
    measures="Whether the outside of the shape faces away from its main axes or lies along them: walls or lids.",
    width=3 * WAVES_AROUND[0] * WAVES_AROUND[1],
    compute=compute,
)
