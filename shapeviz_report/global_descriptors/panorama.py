"""Panorama (Pan): how far the surface reaches from each main axis, all around (after Papadakis et al. 2010)."""

from __future__ import annotations

import numpy as np

from shapeviz_report.global_descriptors.base import GlobalDescriptor
from shapeviz_report.global_descriptors.posed_shape import WAVES_AROUND, PosedShape
from shapeviz_report.types import FloatArray


def compute(shape: PosedShape) -> FloatArray:
    r"""Spectra of the distance from each axis to the farthest surface, over height and azimuth.

    .. math:: \sqrt{S_a(l, k)}, \quad a = 1, 2, 3, \; l = 0, ..., 4, \; k = 0, ..., 6

    with S of :func:`~shapeviz_report.global_descriptors.posed_shape.spectrum`: l waves along the axis, k around it.

    Returns
    -------
    (105,) float64 array
        At least 0; axis by axis, the longest first.
    """
    return np.sqrt(shape.panoramas[0]).ravel()


PANORAMA = GlobalDescriptor(
    name="Pan",
    title="Panorama",
    measures="How far the shape reaches from its main axes, all around: slim or bulky, round or winged.",
    width=3 * WAVES_AROUND[0] * WAVES_AROUND[1],
    compute=compute,
)
