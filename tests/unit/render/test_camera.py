"""Framing: the picture is filled, and the shape in its middle."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from shapeviz_report.render.camera import MARGIN, frame


def project(positions: np.ndarray, camera) -> np.ndarray:
    """Pixels from the left and the top, by the camera's own pose."""
    in_camera = np.column_stack([positions, np.ones(len(positions))]) @ np.linalg.inv(camera.pose).T
    x, y, z = in_camera[:, :3].T
    return np.column_stack(
        [camera.centre[0] - camera.focal_length * x / z, camera.centre[1] + camera.focal_length * y / z]
    )


@given(st.integers(0, 10_000))
def test_the_projection_fills_the_picture_up_to_the_margin_and_is_centred(seed: int):
    rng = np.random.default_rng(seed)
    positions = rng.normal(size=(20, 3)) * rng.uniform(0.1, 10.0, 3) + rng.normal(size=3)
    camera = frame(positions, Rotation.random(random_state=rng).as_matrix(), 200)
    pixels = project(positions, camera)
    low, high = pixels.min(axis=0), pixels.max(axis=0)
    np.testing.assert_allclose((low + high) / 2, 100, atol=1e-6)
    assert max(high - low) == pytest.approx(200 * (1 - 2 * MARGIN))


@given(st.integers(0, 10_000))
def test_the_shape_lies_between_the_clipping_planes(seed: int):
    rng = np.random.default_rng(seed)
    positions = rng.normal(size=(20, 3))
    camera = frame(positions, Rotation.random(random_state=rng).as_matrix(), 200)
    depths = (camera.eye - positions) @ camera.rotation[2]
    assert camera.near < depths.min()
    assert depths.max() < camera.far


def test_a_single_point_has_a_camera():
    camera = frame(np.zeros((1, 3)), np.eye(3), 64)
    np.testing.assert_allclose(project(np.zeros((1, 3)), camera), [[32, 32]])
