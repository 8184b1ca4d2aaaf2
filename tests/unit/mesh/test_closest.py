"""The closest point of a surface, against all of its faces."""

from __future__ import annotations

import numpy as np
import pytest

from shapeviz_report.mesh.boxes import LEAF, along_curve, box_faces
from shapeviz_report.mesh.closest import find_closest, largest_distance


def gaps(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """The distance of each point from each face, (n, m): from its plane above the face, else from its sides."""
    found = np.full((len(points), len(corners)), np.inf)
    for column, triangle in enumerate(corners):
        for start, end in zip(triangle, np.roll(triangle, -1, axis=0)):
            side = end - start
            along = np.clip((points - start) @ side / (side @ side), 0, 1)
            found[:, column] = np.minimum(
                found[:, column], np.linalg.norm(points - start - along[:, None] * side, axis=1)
            )
        edges = triangle[1:] - triangle[0]
        weights = np.linalg.lstsq(edges.T, (points - triangle[0]).T, rcond=None)[0]
        above = np.linalg.norm(points - triangle[0] - weights.T @ edges, axis=1)
        within = (weights >= 0).all(axis=0) & (weights.sum(axis=0) <= 1)
        found[within, column] = np.minimum(found[within, column], above[within])
    return found


@pytest.mark.parametrize("count", [1, 2, 4, 5, 9, 64, 300])
@pytest.mark.parametrize("kind", ["soup", "needles", "flat", "tiny"])
def test_no_face_is_nearer(kind: str, count: int) -> None:
    random = np.random.default_rng(count)
    corners = random.random((count, 3, 3))
    if kind == "needles":
        corners[:, 2] = corners[:, 1] + 1e-3 * random.random((count, 3))
    elif kind == "flat":
        corners[..., 2] = 0.5
    elif kind == "tiny":
        corners = corners[:, :1] + 1e-3 * corners
    corners = corners[along_curve(corners.mean(axis=1))]
    # Near and far, on corners, edges and faces.
    points = np.concatenate([2 * random.random((40, 3)) - 0.5, corners[:5, 0], corners[:5].mean(axis=1)])
    closest, places = find_closest(points, corners, box_faces(corners), LEAF)
    found = np.linalg.norm(closest - points, axis=1)
    every = gaps(points, corners)
    np.testing.assert_allclose(found, every.min(axis=1), atol=1e-9)
    np.testing.assert_allclose(every[np.arange(len(points)), places], found, atol=1e-9)
    farthest = largest_distance(points, corners, box_faces(corners), LEAF)
    assert farthest == pytest.approx(every.min(axis=1).max(), abs=1e-9)
