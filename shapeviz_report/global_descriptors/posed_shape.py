"""A shape in its own frame, and how it looks from there: what global descriptors share, computed once."""

from __future__ import annotations

from functools import cached_property
from itertools import product

import numpy as np

from shapeviz_report.global_descriptors.kernels.depths import draw_depths
from shapeviz_report.global_descriptors.kernels.panoramas import unroll
from shapeviz_report.global_descriptors.kernels.sampling import spread_points
from shapeviz_report.types import FloatArray, IntArray, Mesh

POINTS = 2**16
"""Points on the surface. With a quarter of them, and cells four times as large, panoramas of a file that was turned
moved twice as far; docs/notes/features.md."""

REACH = 2.5
"""Half the side of what is looked at, in units of the root mean square distance of the surface from its centre."""

PANORAMA = (64, 128)
"""Cells of a panorama: along the axis and around it."""

SKIN = 0.1
"""Depth below the farthest point in which a panorama averages how the surface slants, in the same units."""

PIXELS = 128
"""Side of a depth image."""

WAVES_AROUND = (5, 7)
"""Frequencies of panoramas that are kept, from 0: along the axis and around it. With (9, 11), and 9 by 9 of depth
images, no database was told apart better; docs/notes/features.md."""

WAVES_ACROSS = (5, 5)
"""Frequencies of depth images that are kept, from 0."""

SURE = 0.03
"""How many radians an axis is taken to be off by, times the relative gap of the eigenvalues of the two axes of a
plane: perturbation theory has the angle as the change over the gap."""

TURNS = 4
"""Turns in half a circle by which two axes that are nearly equal are blended."""

NEGLIGIBLE = 0.01
"""Turns that would count less than this against the main pose are left out."""


class PosedShape:
    """A prepared mesh moved, scaled and turned into the frame of its principal axes.

    The centre is that of the surface, the unit its root mean square distance from there, and the axes are the
    eigenvectors of the second moments of the surface, the longest first. Their signs are arbitrary: what is measured
    here does not depend on them.

    Parameters
    ----------
    mesh : Mesh
        As :func:`shapeviz_report.mesh.prepare` returns it.

    Attributes
    ----------
    points, normals : (65536, 3) float64 arrays
        Spread evenly over the surface, and the unit normals of the faces there.
    vertices : (n, 3) float64 array
    faces : (m, 3) int32 array
    moments : (3,) float64 array
        Eigenvalues, falling; they add up to 1.
    """

    def __init__(self, mesh: Mesh) -> None:
        vertices = np.ascontiguousarray(mesh.vertices, dtype=np.float64)
        self.faces: IntArray = np.ascontiguousarray(mesh.faces, dtype=np.int32)
        points, normals = spread_points(vertices, self.faces, POINTS)
        centre = points.mean(axis=0)
        points -= centre
        unit = float(np.sqrt(np.square(points).sum(axis=1).mean()))
        scale = 1 / unit if unit > 0 else 0.0
        moments, axes = np.linalg.eigh(points.T @ points * (scale**2 / POINTS))
        self.moments: FloatArray = moments[::-1].clip(0)
        axes = axes[:, ::-1]
        self.points: FloatArray = points @ axes * scale
        self.normals: FloatArray = normals @ axes
        self.vertices: FloatArray = (vertices - centre) @ axes * scale

    def turns(self) -> list[tuple[float, FloatArray]]:
        r"""Poses that the shape is looked at in, with weights that add up to 1: (weight, rotation (3, 3)).

        Where two moments are nearly equal, as of a cup or a ball, noise decides the axes of their plane, so features
        of one pose would jump. Poses turned in that plane count too,

        .. math:: w(\theta) \propto e^{-\theta^2 / 2 \sigma^2}, \quad
                  \sigma = 0.03 \frac{\lambda_i + \lambda_j}{\lambda_i - \lambda_j},

        all alike where the moments are equal; of clear axes, the pose itself is all that counts.
        """
        angles = np.arange(TURNS) * np.pi / TURNS
        angles[angles > np.pi / 2] -= np.pi
        planes = []
        for i, j in ((0, 1), (1, 2)):
            total = self.moments[i] + self.moments[j]
            gap = (self.moments[i] - self.moments[j]) / total if total > 0 else 0.0
            weights = np.exp(-0.5 * np.square(angles * gap / SURE))
            planes.append(
                [(w, _rotation(i, j, a)) for w, a in zip(weights, angles, strict=True) if w > NEGLIGIBLE]
            )
        poses = [(float(v * w), first @ second) for (v, first), (w, second) in product(*planes)]
        whole = sum(weight for weight, _ in poses)
        return [(weight / whole, rotation) for weight, rotation in poses]

    @cached_property
    def panoramas(self) -> tuple[FloatArray, FloatArray]:
        """Spectra (3, 5, 7) of how far the surface reaches from each axis, and of how it slants there."""
        turns = self.turns()
        reach, slant = np.zeros((2, 3, *WAVES_AROUND))
        # What many poses average needs fewer points in each.
        share = min(len(turns), 4)
        for number, (weight, rotation) in enumerate(turns):
            own = slice(number % share, None, share)
            points, normals = self.points[own] @ rotation, self.normals[own] @ rotation
            for axis in range(3):
                farthest, cosine = unroll(points, normals, axis, *PANORAMA, REACH, SKIN)
                reach[axis] += weight * spectrum(farthest, WAVES_AROUND)
                slant[axis] += weight * spectrum(cosine, WAVES_AROUND)
        return reach, slant

    @cached_property
    def views(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Spectra (3, 5, 5) of what is seen along each axis: the sum of the depths from both sides, the magnitude of
        their difference, and the silhouette."""
        both, change, outline = np.zeros((3, 3, *WAVES_ACROSS))
        for weight, rotation in self.turns():
            vertices = self.vertices @ rotation
            for axis in range(3):
                images = draw_depths(vertices, self.faces, axis, PIXELS, REACH)
                front, behind = (spectrum(image, WAVES_ACROSS) for image in images)
                both[axis] += weight * (front + behind)
                change[axis] += weight * np.abs(front - behind)
                outline[axis] += weight * spectrum((images[0] > 0).astype(np.float64), WAVES_ACROSS)
        return both, change, outline


def spectrum(image: FloatArray, waves: tuple[int, int]) -> FloatArray:
    r"""Magnitudes of the lowest frequencies of an image, mirrored ones added.

    .. math:: S(l, k) = \frac{|F(l, k)| + |F(-l, k)|}{\text{pixels}}

    They stay when the image is shifted around or mirrored.
    """
    magnitudes = np.abs(np.fft.rfft2(image))[:, : waves[1]] / image.size
    rows = np.arange(waves[0])
    return magnitudes[rows] + magnitudes[-rows]


def _rotation(i: int, j: int, angle: float) -> FloatArray:
    """The rotation by an angle in the plane of two axes."""
    rotation = np.eye(3)
    rotation[i, i] = rotation[j, j] = np.cos(angle)
    rotation[i, j], rotation[j, i] = -np.sin(angle), np.sin(angle)
    return rotation
