"""Pictures of a shape with a bin painted on it: which values it has where, and which part falls into the bin."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapeviz_report.render.camera import frame
from shapeviz_report.render.normals import split_at_creases
from shapeviz_report.render.ramp import ramp_colors
from shapeviz_report.render.rasteriser import Renderer, rasterise
from shapeviz_report.render.shading import CLAY, shade
from shapeviz_report.render.thumbnail import SUPERSAMPLING, encode_webp
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


def render_painted(
    mesh: Mesh,
    view: FloatArray,
    colorings: Sequence[FloatArray],
    *,
    size: int = 320,
    renderer: Renderer = "osmesa",
) -> list[bytes]:
    """Draw a shape as its thumbnail shows it, once with each of several sets of colours on its vertices, on nothing.

    Parameters
    ----------
    mesh : Mesh
        Not empty.
    view : (3, 3) float64 array
        As for :func:`shapeviz_report.render.render_thumbnail`.
    colorings : sequence of (n, 3) float64 arrays
        Linear reflectance of every vertex, in [0, 1].
    size : int
        Width and height in pixels.
    renderer : {"osmesa", "zbuffer"}
        As for :func:`shapeviz_report.render.render_thumbnail`.

    Returns
    -------
    list of bytes
        WebP images with transparency.

    Raises
    ------
    RenderError
        If this machine cannot draw; see :func:`shapeviz_report.render.check_renderer`.
    """
    surface = split_at_creases(mesh)
    camera = frame(surface.positions, view, size * SUPERSAMPLING)
    normals = (surface.normals @ camera.rotation.T + 1.0) / 2.0
    buffers = rasterise(surface.positions, surface.faces, normals, camera, renderer)
    pictures = []
    for colors in colorings:
        albedo = rasterise(surface.positions, surface.faces, colors[surface.source], camera, renderer).values
        pictures.append(encode_webp(shade(buffers.depth, buffers.values * 2.0 - 1.0, albedo, camera)))
    return pictures
