"""Surflet pairs (Sfl): how pairs of points far apart lie to each other (after Wahl et al. 2003)."""

from __future__ import annotations

from functools import cache

import numpy as np

from shapeviz_report.global_descriptors.base import GlobalDescriptor
from shapeviz_report.global_descriptors.kernels.surflets import count_pairs
from shapeviz_report.global_descriptors.posed_shape import POINTS, PosedShape
from shapeviz_report.types import FloatArray, IntArray

EVERY = 4
"""Of so many points, one takes part."""

SHIFTS = np.arange(38, 446, 37, dtype=np.int32)
"""Each point pairs with those so many places on: twelve partners."""

FARTHEST = 4.0
"""The largest distance, in units of the posed shape."""

DISTANCES = 10
"""Its bins."""

ANGLES = 4
"""Bins of each angle."""


@cache
def shuffle() -> IntArray:
    """A fixed order of the points: they follow each other along the faces, and partners are to lie anywhere."""
    return np.random.default_rng(0).permutation(POINTS // EVERY).astype(np.int32)


def compute(shape: PosedShape) -> FloatArray:
    r"""Square roots of the shares of point pairs by distance and angles.

    Ten distances up to 4 units, the last taking what is beyond; four ranges of :math:`|n_1 \cdot n_2|`; and the ten
    unordered pairs of four ranges of :math:`|n_1 \cdot d|` and :math:`|n_2 \cdot d|`. Which way faces are oriented
    plays no part, so that soups can be compared; Euclidean distance of the roots is the Hellinger distance of the
    shares.

    Returns
    -------
    (400,) float64 array
        In [0, 1]; the squares add up to 1.
    """
    order = EVERY * shuffle()
    points, normals = shape.points[order], shape.normals[order]
    return np.sqrt(count_pairs(points, normals, SHIFTS, FARTHEST, DISTANCES, ANGLES)).ravel()


SURFLETS = GlobalDescriptor(
    name="Sfl",
    title="Surflet pairs",
    measures="How any two places of the surface lie to each other: their distance, and how they are turned.",
    width=DISTANCES * ANGLES * (ANGLES * (ANGLES + 1) // 2),
    compute=compute,
)
