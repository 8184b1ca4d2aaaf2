"""A perspective camera that frames a shape tightly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapeviz_report.types import FloatArray

DISTANCE = (
    5.0  # of the eye from the middle of the shape, in radii of the shape: a long lens, mild perspective
)
MARGIN = 0.04  # empty border on each side, as a fraction of the picture


@dataclass(frozen=True)
class Camera:
    """Where a picture is taken from.

    Attributes
    ----------
    rotation : (3, 3) float64 array
        Rows: the world directions that point right, up and towards the viewer in the picture.
    eye : (3,) float64 array
    focal_length : float
        Pixels.
    centre : (float, float)
        Where the optical axis meets the picture, in pixels from its left and top.
    near, far : float
        Distances along the axis between which the shape lies.
    size : int
        Width and height of the picture in pixels.
    """

    rotation: FloatArray
    eye: FloatArray
    focal_length: float
    centre: tuple[float, float]
    near: float
    far: float
    size: int

    @property
    def pose(self) -> FloatArray:
        """(4, 4) camera-to-world transform, OpenGL convention (x right, y up, looking along -z)."""
        pose = np.eye(4)
        pose[:3, :3] = self.rotation.T
        pose[:3, 3] = self.eye
        return pose


def frame(positions: FloatArray, rotation: FloatArray, size: int) -> Camera:
    """Place a camera so that the picture is filled, and the silhouette's bounding box centred.

    The lens is shifted instead of turned towards the middle of the silhouette, so one projection settles it.

    Parameters
    ----------
    positions : (n, 3) float64 array
        All vertices that are drawn, n >= 1.
    rotation : (3, 3) float64 array
        As :attr:`Camera.rotation`.
    size : int
        Pixels.
    """
    middle = (positions.min(axis=0) + positions.max(axis=0)) / 2.0
    radius = max(float(np.linalg.norm(positions - middle, axis=1).max()), 1e-9)
    eye = middle + DISTANCE * radius * rotation[2]
    x, y, z = ((positions - eye) @ rotation.T * (1.0, -1.0, -1.0)).T  # picture axes: right, down, away
    tangents = np.stack([x / z, y / z])
    low, high = tangents.min(axis=1), tangents.max(axis=1)
    extent = max(float((high - low).max()), 1e-9)
    focal_length = size * (1.0 - 2.0 * MARGIN) / extent
    centre = size / 2.0 - focal_length * (low + high) / 2.0
    return Camera(
        rotation=rotation,
        eye=eye,
        focal_length=focal_length,
        centre=(float(centre[0]), float(centre[1])),
        near=(DISTANCE - 1.1) * radius,
        far=(DISTANCE + 1.1) * radius,
        size=size,
    )
