"""Pictures of a shape with a bin painted on it: which values it has where, and which part falls into the bin."""

from __future__ import annotations

import numpy as np

from shapeviz_report.render.camera import frame
from shapeviz_report.render.normals import split_at_creases
from shapeviz_report.render.ramp import ramp_colors
from shapeviz_report.render.rasteriser import rasterise
from shapeviz_report.render.shading import CLAY, shade
from shapeviz_report.render.thumbnail import SUPERSAMPLING, encode_webp
from shapeviz_report.render.viewpoint import UpAxis, choose_view
from shapeviz_report.types import FloatArray, Mesh

MARKED = (0.80, 0.19, 0.02)
"""Linear reflectance of what falls into a bin: far from clay in lightness, hue and to colour-blind eyes."""


def value_colors(values: FloatArray, edges: FloatArray) -> FloatArray:
    """Colours of a descriptor's values by their place among its bins.

    Every bin takes a tenth of the ramp, however wide it is; values beyond the outer edges have the colours of the ends.

    Parameters
    ----------
    values : (n,) array
    edges : (11,) array
        Rising.

    Returns
    -------
    (n, 3) float64 array
        Linear reflectance.
    """
    return ramp_colors(np.interp(values, edges, np.linspace(0, 1, len(edges))))


def mark_colors(inside: FloatArray) -> FloatArray:
    """Colours of the vertices that fall into a bin and of those that do not.

    Parameters
    ----------
    inside : (n,) bool array

    Returns
    -------
    (n, 3) float64 array
        Linear reflectance.
    """
    return np.where(inside[:, None], MARKED, CLAY)


def render_painted(mesh: Mesh, colors: FloatArray, *, size: int = 320, up: UpAxis | None = None) -> bytes:
    """Draw a shape in the view of its thumbnail, its vertices in given colours, on nothing.

    Parameters
    ----------
    mesh : Mesh
        Not empty.
    colors : (n, 3) float64 array
        Linear reflectance of every vertex, in [0, 1].
    size, up
        As for :func:`shapeviz_report.render.render_thumbnail`.

    Returns
    -------
    bytes
        A WebP image with transparency.

    Raises
    ------
    RenderError
        If this machine cannot draw; see :func:`shapeviz_report.render.check_renderer`.
    """
    surface = split_at_creases(mesh)
    camera = frame(surface.positions, choose_view(mesh, up), size * SUPERSAMPLING)
    normals = (surface.normals @ camera.rotation.T + 1.0) / 2.0
    buffers = rasterise(surface.positions, surface.faces, normals, camera)
    albedo = rasterise(surface.positions, surface.faces, colors[surface.source], camera).values
    return encode_webp(shade(buffers.depth, buffers.values * 2.0 - 1.0, albedo, camera))
