"""What a case of the conformance suite is, and the solids that most cases are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from shapeviz_report.types import FloatArray, IntArray

Extents = tuple[float, float, float]


@dataclass(frozen=True)
class Case:
    """One feature of a format in a file as small as can be, and what must come of it.

    Attributes
    ----------
    name : str
        The feature: the first cell of its row in ``docs/using/formats.md``.
    file_name : str
        Of the mesh file; its suffix says the format.
    files : mapping of str to bytes
        Path below the folder -> content, the mesh file among them.
    area : float
        Of the surface, in the file's units squared. This and what follows is idle in a case that is refused.
    volume : float or None
        Signed, positive if the faces look outwards; None for an open surface.
    extents : (float, float, float)
        Along x, y and z.
    parts : int
        Connected parts, coinciding vertices merged.
    refused : str or None
        A regular expression of the reason, if it is refused.
    precision : float
        Largest relative error of the numbers; more than rounding only where the format itself rounds.
    """

    name: str
    file_name: str
    files: Mapping[str, bytes]
    area: float = 0.0
    volume: float | None = None
    extents: Extents = (0.0, 0.0, 0.0)
    parts: int = 0
    refused: str | None = None
    precision: float = 1e-6


BOX = (2.0, 3.0, 4.0)
"""Sizes of the box that :func:`box` gives: area 52, volume 24."""

TWO_BOXES: Extents = (12.0, 3.0, 4.0)
"""Extents of the box and the same again 10 further along x: area 104, volume 48."""

BOX_QUADS: IntArray = np.array(
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]], np.int32
)
"""The six sides of :func:`box`, counter-clockwise seen from outside."""

BOX_TRIANGLES: IntArray = BOX_QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def box(x: float = 0.0) -> FloatArray:
    """The (8, 3) corners of the box from (x, 0, 0) to (x + 2, 3, 4), z running fastest."""
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], np.float64)
    return corners * BOX + [x, 0.0, 0.0]
