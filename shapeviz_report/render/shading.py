"""Light and material of the pictures: soft studio light on warm grey clay.

The lights are fixed to the camera, because every picture is taken with the shape upright: what faces up is
bright and what faces down is dim, whatever the shape. Two conditions set the levels: the darkest parts
must not sink into a near-black page, and the outline must not dissolve into a white one.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel
from shapeviz_report.render.camera import Camera
from shapeviz_report.types import Float32Array, Int64Array

CLAY = (0.56, 0.505, 0.44)  # linear reflectance

# Directions to the lights are (right, up, towards the viewer), unit length; colours are linear.
_KEY_DIRECTION = (-0.48, 0.62, 0.62)
_KEY_COLOUR = (0.93, 0.89, 0.83)
_KEY_WRAP = 0.25  # how far past the terminator a large, soft source reaches
_FILL_DIRECTION = (0.80, 0.10, 0.59)
_FILL_COLOUR = (0.12, 0.14, 0.17)
_SKY_COLOUR = (0.23, 0.245, 0.27)
_GROUND_COLOUR = (0.10, 0.095, 0.09)
_RIM_COLOUR = (0.12, 0.13, 0.14)
_GLOSS, _GLOSS_EXPONENT = 0.05, 24

_OCCLUSION_RADIUS = 0.12  # of the picture's width, how far a surface darkens another
_OCCLUSION_STRENGTH = 1.25
_OCCLUSION_BIAS = 0.03  # of the radius: a surface does not darken itself
_OCCLUSION_SAMPLES = 10

_DARKEST, _BRIGHTEST = 0.03, 0.72
"""What black and white reflect: so much that light and shade are seen on either, and both on any page."""


def reflect(colors: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
    """Linear reflectance of sRGB colours in [0, 1], between that of black and that of white things (IEC 61966-2-1)."""
    linear = np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)
    return (_DARKEST + (_BRIGHTEST - _DARKEST) * linear).astype(np.float32)


def shade(
    depth: npt.NDArray[np.float32],
    normals: npt.NDArray[np.float32],
    albedo: npt.NDArray[np.float32],
    camera: Camera,
) -> npt.NDArray[np.float32]:
    """Light what a camera sees.

    Parameters
    ----------
    depth : (h, w) float32 array
        As :attr:`shapeviz_report.render.rasteriser.Buffers.depth`.
    normals : (h, w, 3) float32 array
        In camera axes (right, up, towards the viewer), of any length. Either side of the surface will do:
        both are the same material, and the one that is seen is lit.
    albedo : (h, w, 3) float32 array
        Linear reflectance. Arrays broadcast from one colour are welcome.
    camera : Camera

    Returns
    -------
    (h, w, 4) float32 array
        Linear colour in [0, 1], and 1 where there is a surface. All zero where there is none.
    """
    return _light_pixels(
        depth,
        normals,
        albedo,
        _spiral(_OCCLUSION_RADIUS * camera.size),
        camera.focal_length,
        camera.centre[0],
        camera.centre[1],
    )


def _spiral(radius: float) -> npt.NDArray[np.int64]:
    """Where to look for what darkens a pixel: (4, samples, 2) offsets in pixels.

    One spiral is dealt out to the four pixels of a 2 x 2 block in turn. Each alone is coarse; averaged into one
    pixel they leave no noise.
    """
    steps = np.arange(4 * _OCCLUSION_SAMPLES)
    radii = radius * (steps + 0.5) / len(steps)
    angles = steps * np.pi * (3.0 - np.sqrt(5.0))
    offsets = radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    offsets = np.round(offsets).astype(np.int64).reshape(_OCCLUSION_SAMPLES, 4, 2)
    return np.ascontiguousarray(offsets.swapaxes(0, 1))


@kernel()
def _position(
    column: int, row: int, z: float, focal_length: float, centre_x: float, centre_y: float
) -> tuple[float, float, float]:
    """The point seen in the middle of a pixel at distance ``z``, in camera axes."""
    return (column + 0.5 - centre_x) * z / focal_length, (centre_y - row - 0.5) * z / focal_length, -z


@kernel()
def _openness(
    depth: Float32Array,
    spiral: Int64Array,
    row: int,
    column: int,
    point: tuple[float, float, float],
    normal: Float32Array,
    focal_length: float,
    centre_x: float,
    centre_y: float,
) -> float:
    """Ambient light that reaches a point, from the depths around it, in [0, 1].

    The estimator of McGuire, Osman, Bukowski and Hennessy, "The Alchemy screen-space ambient obscurance
    algorithm" (2011), Eq. 10.
    """
    height, width = depth.shape
    reach = _OCCLUSION_RADIUS * width * -point[2] / focal_length
    bias = _OCCLUSION_BIAS * reach
    softness = 0.01 * reach * reach
    furthest = 4.0 * reach * reach
    member = row % 2 * 2 + column % 2
    occlusion = 0.0
    for sample in range(_OCCLUSION_SAMPLES):
        other_row = row + spiral[member, sample, 1]
        other_column = column + spiral[member, sample, 0]
        if not (0 <= other_row < height and 0 <= other_column < width):
            continue
        z = depth[other_row, other_column]
        if z == 0.0:
            continue
        other = _position(other_column, other_row, z, focal_length, centre_x, centre_y)
        x, y, z = other[0] - point[0], other[1] - point[1], other[2] - point[2]
        above = x * normal[0] + y * normal[1] + z * normal[2] - bias
        squared = x * x + y * y + z * z
        if above > 0.0 and squared < furthest:
            occlusion += above / (squared + softness)
    return max(0.0, 1.0 - _OCCLUSION_STRENGTH * occlusion * reach / _OCCLUSION_SAMPLES)


@kernel()
def _light_pixels(
    depth: Float32Array,
    normals: Float32Array,
    albedo: Float32Array,
    spiral: Int64Array,
    focal_length: float,
    centre_x: float,
    centre_y: float,
) -> Float32Array:
    height, width = depth.shape
    picture = np.zeros((height, width, 4), np.float32)
    for row in range(height):
        for column in range(width):
            if depth[row, column] == 0.0:
                continue
            point = _position(column, row, depth[row, column], focal_length, centre_x, centre_y)
            distance = math.sqrt(point[0] ** 2 + point[1] ** 2 + point[2] ** 2)
            viewer = (-point[0] / distance, -point[1] / distance, -point[2] / distance)
            x, y, z = normals[row, column, 0], normals[row, column, 1], normals[row, column, 2]
            length = max(math.sqrt(x * x + y * y + z * z), 1e-6)
            facing = (x * viewer[0] + y * viewer[1] + z * viewer[2]) / length
            if facing < 0.0:
                length, facing = -length, -facing
            normal = (x / length, y / length, z / length)

            key_cosine = (
                normal[0] * _KEY_DIRECTION[0] + normal[1] * _KEY_DIRECTION[1] + normal[2] * _KEY_DIRECTION[2]
            )
            key = max(0.0, (key_cosine + _KEY_WRAP) / (1.0 + _KEY_WRAP))
            fill = max(
                0.0,
                normal[0] * _FILL_DIRECTION[0]
                + normal[1] * _FILL_DIRECTION[1]
                + normal[2] * _FILL_DIRECTION[2],
            )
            sky = 0.5 + 0.5 * normal[1]
            rim = (1.0 - min(facing, 1.0)) ** 3 * sky
            half = (
                viewer[0] + _KEY_DIRECTION[0],
                viewer[1] + _KEY_DIRECTION[1],
                viewer[2] + _KEY_DIRECTION[2],
            )
            half_length = math.sqrt(half[0] ** 2 + half[1] ** 2 + half[2] ** 2)
            half_cosine = (normal[0] * half[0] + normal[1] * half[1] + normal[2] * half[2]) / half_length
            gloss = _GLOSS * max(0.0, half_cosine) ** _GLOSS_EXPONENT if key_cosine > 0.0 else 0.0

            openness = _openness(depth, spiral, row, column, point, normal, focal_length, centre_x, centre_y)
            # Obscured places lose all light of the sky, but only part of the lamps'.
            lamps = 0.45 + 0.55 * openness
            for channel in range(3):
                light = (
                    lamps * (key * _KEY_COLOUR[channel] + fill * _FILL_COLOUR[channel])
                    + openness * (sky * _SKY_COLOUR[channel] + (1.0 - sky) * _GROUND_COLOUR[channel])
                    + openness * rim * _RIM_COLOUR[channel]
                )
                colour = albedo[row, column, channel] * light + gloss * openness
                picture[row, column, channel] = min(colour, 1.0)
            picture[row, column, 3] = 1.0
    return picture
