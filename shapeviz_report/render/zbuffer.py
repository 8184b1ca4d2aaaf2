"""What a camera sees, by a depth buffer of our own: for machines without a graphics library.

As OpenGL draws: a pixel shows what lies in its middle and is nearest, values are interpolated in perspective.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel
from shapeviz_report.render.camera import Camera
from shapeviz_report.types import Float32Array, FloatArray, IntArray


def draw(
    positions: FloatArray, faces: IntArray, values: FloatArray, camera: Camera
) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """Depth (h, w) and values (h, w, 3) of the nearest surface; see
    :func:`shapeviz_report.render.rasteriser.rasterise`."""
    right, up, away = ((positions - camera.eye) @ camera.rotation.T * (1.0, 1.0, -1.0)).T
    pixels = np.stack(
        [
            camera.centre[0] + camera.focal_length * right / away,
            camera.centre[1] - camera.focal_length * up / away,
            1.0 / away,
        ],
        axis=1,
    )
    return _draw(pixels, np.ascontiguousarray(faces), np.ascontiguousarray(values), camera.size)


@kernel(error_model="numpy")
def _draw(
    pixels: FloatArray, faces: IntArray, values: FloatArray, size: int
) -> tuple[Float32Array, Float32Array]:
    """``pixels`` are (n, 3): column, row, and one over the distance, which is linear on the picture."""
    nearness = np.zeros((size, size))
    shown = np.zeros((size, size, 3), np.float32)
    for face in range(len(faces)):
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        ax, ay, bx, by, cx, cy = (
            pixels[a, 0],
            pixels[a, 1],
            pixels[b, 0],
            pixels[b, 1],
            pixels[c, 0],
            pixels[c, 1],
        )
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if area == 0.0:
            continue
        first_row = max(0, int(np.ceil(min(ay, by, cy) - 0.5)))
        last_row = min(size - 1, int(np.floor(max(ay, by, cy) - 0.5)))
        first_column = max(0, int(np.ceil(min(ax, bx, cx) - 0.5)))
        last_column = min(size - 1, int(np.floor(max(ax, bx, cx) - 0.5)))
        # The shares of two corners are linear on the picture; that of the third is the rest.
        a_right, a_down = (by - cy) / area, (cx - bx) / area
        b_right, b_down = (cy - ay) / area, (ax - cx) / area
        a_near, b_near, c_near = pixels[a, 2], pixels[b, 2], pixels[c, 2]
        for row in range(first_row, last_row + 1):
            down = row + 0.5 - cy
            for column in range(first_column, last_column + 1):
                right = column + 0.5 - cx
                of_a = right * a_right + down * a_down
                of_b = right * b_right + down * b_down
                of_c = 1.0 - of_a - of_b
                if of_a < 0.0 or of_b < 0.0 or of_c < 0.0:
                    continue
                near = of_a * a_near + of_b * b_near + of_c * c_near
                if near <= nearness[row, column]:
                    continue
                nearness[row, column] = near
                of_a, of_b, of_c = of_a * a_near / near, of_b * b_near / near, of_c * c_near / near
                for channel in range(3):
                    shown[row, column, channel] = (
                        of_a * values[a, channel] + of_b * values[b, channel] + of_c * values[c, channel]
                    )
    depth = np.zeros((size, size), np.float32)
    for row in range(size):
        for column in range(size):
            if nearness[row, column] > 0.0:
                depth[row, column] = 1.0 / nearness[row, column]
    return depth, shown
