"""Which surface each pixel sees, by whatever draws on this machine.

Light and colour are computed from that in :mod:`shapeviz_report.render.shading`, which lights both sides of a surface.
So a renderer is asked for depth and a value a pixel alone, and all give the same pictures but for pixels at edges.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from shapeviz_report.render import gl, zbuffer
from shapeviz_report.render.camera import Camera
from shapeviz_report.types import FloatArray, IntArray

Renderer = Literal["osmesa", "zbuffer"]

RENDERERS: tuple[Renderer, ...] = ("osmesa", "zbuffer")
"""What may draw, in the order in which they are tried: pyrender by OSMesa, and a depth buffer of our own, which needs
no library of the system."""


@dataclass(frozen=True)
class Buffers:
    """What a camera sees.

    Attributes
    ----------
    depth : (h, w) float32 array
        Distance along the camera's axis; 0 where there is nothing.
    values : (h, w, 3) float32 array
        The vertex values interpolated over the nearest surface, in steps of 1/255 by pyrender. Only defined where
        ``depth`` is positive.
    """

    depth: npt.NDArray[np.float32]
    values: npt.NDArray[np.float32]


def check_renderer(renderer: Renderer) -> None:
    """Make sure that this process can draw with a renderer.

    Raises
    ------
    RenderError
        If its library is missing or gives no context, with what to install.
    """
    if renderer != "zbuffer":
        gl.check()


def rasterise(
    positions: FloatArray, faces: IntArray, values: FloatArray, camera: Camera, renderer: Renderer
) -> Buffers:
    """Draw a mesh without light.

    Parameters
    ----------
    positions : (n, 3) float64 array
    faces : (m, 3) int32 array
        Both sides are drawn.
    values : (n, 3) float64 array
        One value a vertex, in [0, 1].
    camera : Camera
    renderer : Renderer

    Raises
    ------
    RenderError
        As :func:`check_renderer`.
    """
    if renderer == "zbuffer":
        return Buffers(*zbuffer.draw(positions, faces, values, camera))
    return Buffers(*gl.draw(positions, faces, values, camera))
