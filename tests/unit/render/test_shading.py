"""Light: from above, on both sides of a surface, and less of it in corners."""

from __future__ import annotations

import numpy as np
import pytest

from shapeviz_report.render.camera import frame
from shapeviz_report.render.rasteriser import rasterise
from shapeviz_report.render.shading import CLAY, shade

SIZE = 64
CAMERA = frame(np.array([[-1, -1, 0], [1, 1, 0]], np.float64), np.eye(3), SIZE)
DISTANCE = np.float32(CAMERA.eye[2])


def wall(normal: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Depths and normals of a wall that faces the camera, shaded as if it faced elsewhere."""
    depth = np.full((SIZE, SIZE), DISTANCE)
    return depth, np.broadcast_to(np.float32(normal), (SIZE, SIZE, 3))


def light(depth: np.ndarray, normals: np.ndarray) -> np.ndarray:
    albedo = np.broadcast_to(np.float32(CLAY), normals.shape)
    return shade(depth, normals, albedo, CAMERA)


def brightness(normal: tuple[float, float, float]) -> float:
    """Of one small piece of surface with nothing around it."""
    depth, normals = wall(normal)
    alone = np.zeros_like(depth)
    alone[SIZE // 2, SIZE // 2] = DISTANCE
    return float(light(alone, normals)[SIZE // 2, SIZE // 2, :3].mean())


@pytest.mark.slow
def test_what_faces_up_is_brighter_than_what_faces_down():
    assert brightness((0, 0.8, 0.6)) > 1.1 * brightness((0, 0, 1))
    assert 0.02 < brightness((0, -0.8, 0.6)) < 0.5 * brightness((0, 0, 1))


def test_both_sides_of_a_surface_look_the_same():
    depth, normals = wall((0.3, 0.5, 0.81))
    np.testing.assert_allclose(light(depth, normals), light(depth, -normals), atol=1e-6)


def test_the_length_of_a_normal_does_not_matter():
    depth, normals = wall((0.3, 0.5, 0.81))
    np.testing.assert_allclose(light(depth, normals), light(depth, 0.9 * normals), atol=1e-6)


def test_nothing_is_drawn_where_there_is_no_surface():
    depth, normals = wall((0, 0, 1))
    depth[:, 40:] = 0.0
    picture = light(depth, normals)
    assert (picture[:, 40:] == 0.0).all()
    assert (picture[:, :40, 3] == 1.0).all()
    assert (picture[:, :40, :3] > 0.0).all()


def test_the_foot_of_a_step_is_darker_than_open_ground():
    depth, normals = wall((0, 0, 1))
    depth[:, :20] -= np.float32(0.2)
    picture = light(depth, normals)[..., :3].mean(axis=2).mean(axis=0)
    assert picture[22] < 0.92 * picture[50]
    assert picture[10] > 0.95 * picture[50], "the top of the step is open"


@pytest.mark.slow
def test_the_material_scales_the_light_it_sends_back():
    depth, normals = wall((0, -0.8, 0.6))  # away from the key light: no gloss
    dark = shade(depth, normals, np.full((SIZE, SIZE, 3), 0.2, np.float32), CAMERA)
    bright = shade(depth, normals, np.full((SIZE, SIZE, 3), 0.6, np.float32), CAMERA)
    np.testing.assert_allclose(bright[..., :3], 3.0 * dark[..., :3], rtol=1e-4)


def test_the_positions_that_light_is_computed_at_are_where_the_rasteriser_drew():
    tilted = np.array([[-1, -1, -0.5], [1, -1, -0.5], [1, 1, 0.5], [-1, 1, 0.5]], np.float64)
    normal = np.cross(tilted[1] - tilted[0], tilted[3] - tilted[0])
    normal /= np.linalg.norm(normal)
    camera = frame(tilted, np.eye(3), SIZE)
    faces = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    buffers = rasterise(tilted, faces, np.tile((normal + 1) / 2, (4, 1)), camera, "osmesa")
    albedo = np.full((SIZE, SIZE, 3), 0.5, np.float32)
    picture = shade(buffers.depth, buffers.values * 2 - 1, albedo, camera)
    inside = picture[10:-10, 10:-10, :3]
    assert inside.min() > 0.97 * inside.max(), "a plane does not darken itself"
