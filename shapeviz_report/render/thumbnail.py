"""The picture of a shape."""

from __future__ import annotations

import io

import numpy as np
import numpy.typing as npt
from PIL import Image

from shapeviz_report.compilation import kernel
from shapeviz_report.render.camera import frame
from shapeviz_report.render.normals import split_at_creases
from shapeviz_report.render.rasteriser import Renderer, rasterise
from shapeviz_report.render.shading import CLAY, reflect, shade
from shapeviz_report.types import FloatArray, Mesh

WEBP_QUALITY = 84
WEBP_METHOD = 2  # 4 would save a fifth of the bytes for three times the time

SUPERSAMPLING = 2
# Weights over four rows, then over four columns: edges in finer steps than a box of two would give.
_TENT = np.array([1 / 8, 3 / 8, 3 / 8, 1 / 8], np.float32)


def _encode_srgb() -> npt.NDArray[np.uint8]:
    """IEC 61966-2-1 in steps of 1/255, of 2**16 steps of linear light: finer than the darkest step."""
    linear = np.arange(2**16) / (2**16 - 1)
    curved = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.round(255 * curved).astype(np.uint8)


_SRGB = _encode_srgb()


def render_thumbnail(
    mesh: Mesh, view: FloatArray, *, size: int = 320, renderer: Renderer = "osmesa", clay: bool = False
) -> bytes:
    """Draw a shape on nothing, in its colours if it has some.

    The same mesh and view give the same bytes, in any process.

    Parameters
    ----------
    mesh : Mesh
        Not empty; closed or open, of any number of parts.
    view : (3, 3) float64 array
        As :func:`shapeviz_report.render.choose_view` finds it.
    size : int
        Width and height in pixels.
    renderer : {"osmesa", "zbuffer"}
        As :data:`~shapeviz_report.render.rasteriser.RENDERERS` has them; each gives bytes of its own.
    clay : bool
        Draw it as if it had no colours.

    Returns
    -------
    bytes
        A WebP image with transparency, for light and dark pages.

    Raises
    ------
    RenderError
        If this machine cannot draw; see :func:`shapeviz_report.render.check_renderer`.
    """
    surface = split_at_creases(mesh)
    camera = frame(surface.positions, view, size * SUPERSAMPLING)
    camera_normals = surface.normals @ camera.rotation.T
    buffers = rasterise(surface.positions, surface.faces, (camera_normals + 1.0) / 2.0, camera, renderer)
    albedo = np.broadcast_to(np.array(CLAY, np.float32), buffers.values.shape)
    if mesh.colors is not None and not clay:
        colors = mesh.colors[surface.source] / 255
        albedo = reflect(rasterise(surface.positions, surface.faces, colors, camera, renderer).values)
    return encode_webp(shade(buffers.depth, buffers.values * 2.0 - 1.0, albedo, camera))


def encode_webp(picture: npt.NDArray[np.float32]) -> bytes:
    """Reduce a supersampled picture and write it as WebP.

    Colours are averaged in linear light and over the surface alone, so that an outline has neither a light
    nor a dark fringe on any page.

    Parameters
    ----------
    picture : (h, w, 4) float32 array
        As :func:`shapeviz_report.render.shading.shade` gives it.
    """
    pixels = _reduce(picture, _TENT, _SRGB)
    file = io.BytesIO()
    Image.fromarray(pixels, "RGBA").save(file, "WEBP", quality=WEBP_QUALITY, method=WEBP_METHOD)
    return file.getvalue()


@kernel()
def _reduce(
    picture: npt.NDArray[np.float32], weights: npt.NDArray[np.float32], encoded: npt.NDArray[np.uint8]
) -> npt.NDArray[np.uint8]:
    """Halve a picture and encode it in sRGB; every colour counts as much as it covers."""
    height, width = picture.shape[0] // 2, picture.shape[1] // 2
    pixels = np.zeros((height, width, 4), np.uint8)
    for row in range(height):
        for column in range(width):
            red, green, blue, coverage = 0.0, 0.0, 0.0, 0.0
            for i in range(max(0, 1 - 2 * row), min(4, picture.shape[0] + 1 - 2 * row)):
                for j in range(max(0, 1 - 2 * column), min(4, picture.shape[1] + 1 - 2 * column)):
                    weight = weights[i] * weights[j] * picture[2 * row - 1 + i, 2 * column - 1 + j, 3]
                    if weight > 0.0:
                        red += weight * picture[2 * row - 1 + i, 2 * column - 1 + j, 0]
                        green += weight * picture[2 * row - 1 + i, 2 * column - 1 + j, 1]
                        blue += weight * picture[2 * row - 1 + i, 2 * column - 1 + j, 2]
                        coverage += weight
            if coverage > 0.0:
                scale = (len(encoded) - 1) / coverage
                pixels[row, column, 0] = encoded[round(min(red * scale, len(encoded) - 1.0))]
                pixels[row, column, 1] = encoded[round(min(green * scale, len(encoded) - 1.0))]
                pixels[row, column, 2] = encoded[round(min(blue * scale, len(encoded) - 1.0))]
                pixels[row, column, 3] = round(255.0 * coverage)
    return pixels
