"""A mesh, and what was measured of a shape."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from shapeviz_report.types.arrays import FloatArray, IntArray

UpAxis = Literal["x", "y", "z"]


@dataclass(frozen=True)
class Mesh:
    """A triangle mesh.

    Attributes
    ----------
    vertices : (n, 3) float64 array
        Positions; finite.
    faces : (m, 3) int32 array
        Vertex indices, counter-clockwise seen from outside.
    up : {"x", "y", "z"} or None
        The axis that points up, if the file that it was read from says so.
    colors : (n, 3) uint8 array or None
        sRGB of each vertex of a prepared mesh, if the file has colours.
    """

    vertices: FloatArray
    faces: IntArray
    up: UpAxis | None = None
    colors: npt.NDArray[np.uint8] | None = None


@dataclass(frozen=True)
class ShapeFacts:
    """What was measured of one prepared shape.

    Attributes
    ----------
    sha256 : str
        Of the mesh file's content.
    faces_read, vertices_read : int
        As the file has them.
    faces, vertices : int
        After remeshing.
    components : int
        Connected parts of the prepared mesh.
    watertight : bool
        Whether every edge of the cleaned mesh has two faces.
    repairs : mapping of str to int
        What was mended and how often, for instance ``{"duplicate faces removed": 4}``; empty if nothing was.
    deviation : float
        Largest distance found between the input surface and the prepared one, as a fraction of the
        bounding-box diagonal.
    area : float or None
        Of the cleaned surface, in the file's units squared; None if that is out of range.
    volume : float or None
        That it encloses, in the file's units cubed; None if it is not watertight, or out of range.
    extents : (float, float, float)
        Sizes of its bounding box along x, y and z, in the file's units.
    up : {"x", "y", "z"} or None
        The axis that points up, if the file says so.
    """

    sha256: str
    faces_read: int
    vertices_read: int
    faces: int
    vertices: int
    components: int
    watertight: bool
    repairs: Mapping[str, int]
    deviation: float
    area: float | None
    volume: float | None
    extents: tuple[float, float, float]
    up: UpAxis | None = None
