"""Space cut up: a grid of cells over points, and a tree of boxes over faces, both by sorting."""

from __future__ import annotations

import numpy as np

from shapeviz_report.types import FloatArray

LEAF = 4
"""Faces in a leaf of the tree: a power of two."""

DEPTH = 64
"""Deeper than any tree gets: its boxes are numbered by 32 bits."""


def along_curve(points: FloatArray) -> np.ndarray:
    """The order of points along Morton's curve: what is near on it is near in space.  (n,) int64."""
    low = points.min(axis=0)
    extent = (points.max(axis=0) - low).max()
    place = ((points - low) * (1023 / extent if extent > 0 else 0.0)).astype(np.uint32)
    # Two zeros between every two of the ten bits.
    for shift, mask in ((16, 0x30000FF), (8, 0x300F00F), (4, 0x30C30C3), (2, 0x9249249)):
        place = (place | place << np.uint32(shift)) & np.uint32(mask)
    return np.argsort(place[:, 0] | place[:, 1] << np.uint32(1) | place[:, 2] << np.uint32(2), kind="stable")


def box_faces(corners: FloatArray) -> FloatArray:
    """The boxes of a full binary tree over faces, ``LEAF`` of them a leaf.

    Parameters
    ----------
    corners : (m, 3, 3) float64 array
        Corners of faces in an order in which near ones follow each other; at least one.

    Returns
    -------
    (2 b, 6) float64 array
        Low and high corner of each node; the root is 1, the children of i are 2 i and 2 i + 1, the leaves
        b, b + 1, ... Leaves without faces have boxes that nothing meets.
    """
    count = 1 << (-(-len(corners) // LEAF) - 1).bit_length()
    boxes = np.empty((2 * count, 6))
    for side, extreme, nothing in ((slice(0, 3), np.minimum, np.inf), (slice(3, 6), np.maximum, -np.inf)):
        padded = np.full((count * LEAF, 3), nothing)
        padded[: len(corners)] = extreme(extreme(corners[:, 0], corners[:, 1]), corners[:, 2])
        level, size = padded, count * LEAF
        while size > 1:
            level, size = extreme(level[::2], level[1::2]), size // 2
            if size <= count:
                boxes[size : 2 * size, side] = level
    return boxes
