"""Depth views (Dep): the shape seen along its main axes, with depth (after DESIRE, Vranic 2005)."""

from __future__ import annotations

import numpy as np

from shapeviz_report.global_descriptors.base import GlobalDescriptor
from shapeviz_report.global_descriptors.posed_shape import WAVES_ACROSS, PosedShape
from shapeviz_report.types import FloatArray


def compute(shape: PosedShape) -> FloatArray:
    r"""Spectra of depth images along each axis, from both sides.

    .. math:: \sqrt{S_f + S_b}, \; \sqrt{|S_f - S_b|}

    of the images from the front f and from behind b: what both have, and in what they differ, whichever is the front.

    Returns
    -------
    (150,) float64 array
        At least 0; axis by axis, the longest first, sums before differences, rows of 5 frequencies up by 5 across.
    """
    both, change, _ = shape.views
    return np.sqrt(np.stack([both, change], axis=1)).ravel()


DEPTH_VIEWS = GlobalDescriptor(
    name="Dep",
    title="Depth views",
    measures="What is seen along the three main axes, with its depth: the relief of the front, the side and the top.",
    width=6 * WAVES_ACROSS[0] * WAVES_ACROSS[1],
    compute=compute,
)
