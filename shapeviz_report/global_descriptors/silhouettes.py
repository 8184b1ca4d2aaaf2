"""Silhouettes (Sil): the outlines of the shape seen along its main axes (after DESIRE, Vranic 2005)."""

from __future__ import annotations

import numpy as np

from shapeviz_report.global_descriptors.base import GlobalDescriptor
from shapeviz_report.global_descriptors.posed_shape import WAVES_ACROSS, PosedShape
from shapeviz_report.types import FloatArray


def compute(shape: PosedShape) -> FloatArray:
    r"""Spectra :math:`\sqrt{S}` of the filled silhouette along each axis.

    Returns
    -------
    (75,) float64 array
        At least 0; axis by axis, the longest first, rows of 5 frequencies up by 5 across.
    """
    return np.sqrt(shape.views[2]).ravel()


SILHOUETTES = GlobalDescriptor(
    name="Sil",
    title="Silhouettes",
    measures="The shadow that the shape throws along each of its three main axes.",
    width=3 * WAVES_ACROSS[0] * WAVES_ACROSS[1],
    compute=compute,
)
