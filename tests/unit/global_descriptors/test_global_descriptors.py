"""Global descriptors: known shapes, what motion and meshing leave, and what is degenerate."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from solids import ball, from_trimesh, lump, sheet, torus

from shapeviz_report.global_descriptors import GLOBAL_DESCRIPTORS, PosedShape
from shapeviz_report.global_descriptors.kernels.depths import draw_depths
from shapeviz_report.global_descriptors.kernels.panoramas import unroll
from shapeviz_report.global_descriptors.kernels.sampling import spread_points
from shapeviz_report.global_descriptors.kernels.surflets import count_pairs
from shapeviz_report.global_descriptors.posed_shape import spectrum
from shapeviz_report.types import Mesh

BY_NAME = {descriptor.name: descriptor for descriptor in GLOBAL_DESCRIPTORS}


def describe(mesh: Mesh) -> dict[str, np.ndarray]:
    shape = PosedShape(mesh)
    return {descriptor.name: descriptor.compute(shape) for descriptor in GLOBAL_DESCRIPTORS}


def turned(mesh: Mesh, seed: int = 3) -> Mesh:
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return Mesh(mesh.vertices @ (q * np.linalg.det(q)).T * 5 + [2.0, -1.0, 7.0], mesh.faces)


def apart(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.linalg.norm(one - other))


class TestPose:
    def test_a_box_lies_along_its_axes_and_has_the_moments_of_its_surface(self) -> None:
        sides = np.array([3.0, 2.0, 1.0])
        shape = PosedShape(turned(from_trimesh(trimesh.creation.box(sides))))
        assert np.square(shape.points).sum(axis=1).mean() == pytest.approx(1)
        extents = np.ptp(shape.vertices, axis=0)
        assert extents / extents[0] == pytest.approx(sides / sides[0], abs=1e-3)
        # Second moments of the six faces of a box about its centre.
        a, b, c = sides
        areas = np.array([b * c, a * c, a * b])
        own = [
            2 * areas[i] * (sides[i] / 2) ** 2 + 2 * sides[i] ** 2 / 12 * (areas.sum() - areas[i])
            for i in range(3)
        ]
        assert shape.moments == pytest.approx(own / np.sum(own), abs=1e-3)

    def test_points_are_spread_by_area(self) -> None:
        vertices = np.array([[0, 0, 0], [3, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]], float)
        points, normals = spread_points(vertices, np.array([[0, 1, 2], [3, 4, 5]], np.int32), 4000)
        first = points[:, 0] < 4
        assert first.sum() == 3000
        assert points[first].mean(axis=0) == pytest.approx([1, 1 / 3, 0], abs=0.01)
        assert points[~first].mean(axis=0) == pytest.approx([16 / 3, 1 / 3, 0], abs=0.01)
        assert (normals == [0, 0, 1]).all()

    def test_clear_axes_have_one_pose_and_equal_ones_all_turns_alike(self) -> None:
        assert len(PosedShape(from_trimesh(trimesh.creation.box([3.0, 2.0, 1.0]))).turns()) == 1
        weights = [weight for weight, _ in PosedShape(ball()).turns()]
        assert len(weights) == 16
        assert weights == pytest.approx([1 / 16] * 16, rel=0.01)
        tube = PosedShape(from_trimesh(trimesh.creation.cylinder(0.3, 3.0, sections=64))).turns()
        assert len(tube) == 4
        assert sum(weight for weight, _ in tube) == pytest.approx(1)


class TestKernels:
    def test_the_panorama_of_a_tube_about_its_axis_is_flat(self) -> None:
        angle, height = np.random.default_rng(0).random((2, 40000))
        around = np.stack([np.cos(2 * np.pi * angle), np.sin(2 * np.pi * angle)])
        points = np.column_stack([height * 2 - 1, *(0.5 * around)])
        farthest, slant = unroll(points, np.column_stack([0 * height, *around]), 0, 8, 16, 2.0, 0.1)
        inside = np.zeros((8, 1), bool)
        inside[2:6] = True
        assert farthest == pytest.approx(np.where(inside, 0.25, 0) * np.ones((8, 16)))
        assert slant == pytest.approx(np.where(inside, 1.0, 0) * np.ones((8, 16)))
        # Seen from within a plane through the axis, a slant of 60 degrees counts as its cosine.
        tilted = np.column_stack([np.full(len(points), np.sqrt(0.75)), *(0.5 * around)])
        assert unroll(points, tilted, 0, 8, 16, 2.0, 0.1)[1][2:6] == pytest.approx(0.5 * np.ones((4, 16)))

    def test_depths_of_a_square_in_front_of_another(self) -> None:
        square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], float)
        vertices = np.concatenate(
            [np.column_stack([square[:, :0], np.full(4, z), square / s]) for z, s in ((0.5, 2), (-0.5, 1))]
        )
        faces = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]], np.int32)
        front, behind = draw_depths(vertices, faces, 0, 16, 2.0)
        assert np.unique(front).tolist() == [0, 0.375, 0.625]
        assert np.unique(behind).tolist() == [0, 0.625]
        # The edges lie between the centres of pixels, and corners are drawn as points: one pixel more on two sides.
        assert (front == 0.625).sum() == pytest.approx(16, abs=5)
        assert (behind > 0).sum() == pytest.approx(64, abs=5)

    def test_a_thin_needle_leaves_a_mark(self) -> None:
        needle = np.array([[0, -1, 0.001], [0, 1, 0.001], [0, 0, 0.002]], float)
        assert (draw_depths(needle, np.array([[0, 1, 2]], np.int32), 0, 16, 2.0)[0] > 0).sum() >= 3

    def test_pairs_against_a_slow_count(self) -> None:
        random = np.random.default_rng(1)
        points, normals = random.normal(size=(2, 50, 3))
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        shifts = np.array([1, 7], np.int32)
        counted = count_pairs(points, normals, shifts, 4.0, 10, 4)
        expected = np.zeros((10, 4, 10))
        for shift in shifts:
            for i in range(50):
                j = (i + shift) % 50
                d = points[j] - points[i]
                far = np.linalg.norm(d)
                cosines = sorted([abs(normals[i] @ d) / far, abs(normals[j] @ d) / far])
                small, large = (min(int(4 * c), 3) for c in cosines)
                turn = min(int(4 * abs(normals[i] @ normals[j])), 3)
                expected[min(int(far / 0.4), 9), turn, large * (large + 1) // 2 + small] += 1 / 100
        assert counted == pytest.approx(expected, abs=1e-12)

    def test_spectra_stay_when_an_image_is_mirrored_or_goes_round(self) -> None:
        image = np.random.default_rng(2).random((32, 48))
        own = spectrum(image, (5, 7))
        for other in (image[::-1], image[:, ::-1], np.roll(image, 5, axis=1), np.roll(image, 3, axis=0)):
            assert spectrum(other, (5, 7)) == pytest.approx(own, abs=1e-12)
        assert own[0, 0] == pytest.approx(2 * image.mean())
        full = np.abs(np.fft.fft2(image)) / image.size
        assert own[2, 3] == pytest.approx(full[2, 3] + full[-2, 3])


@pytest.mark.parametrize("name", BY_NAME)
class TestEach:
    def test_motion_and_size_change_nothing(self, name) -> None:
        one, same, other = (BY_NAME[name].compute(PosedShape(m)) for m in (lump(), turned(lump()), torus()))
        assert apart(one, same) < 1e-6 * apart(one, other)

    def test_orientation_of_faces_and_a_mirror_change_nothing(self, name) -> None:
        mesh = lump()
        one = BY_NAME[name].compute(PosedShape(mesh))
        inside_out = BY_NAME[name].compute(PosedShape(Mesh(mesh.vertices, mesh.faces[:, ::-1])))
        mirrored = BY_NAME[name].compute(PosedShape(Mesh(mesh.vertices * [1, 1, -1], mesh.faces)))
        scale = apart(one, BY_NAME[name].compute(PosedShape(torus())))
        assert apart(one, inside_out) < 0.03 * scale
        assert apart(one, mirrored) < 0.03 * scale

    def test_the_turn_of_a_ball_decides_nothing(self, name) -> None:
        # Its axes are those of rounding.
        one, same, other = (BY_NAME[name].compute(PosedShape(m)) for m in (ball(), turned(ball()), lump()))
        assert apart(one, same) < 0.1 * apart(one, other)

    @pytest.mark.parametrize(
        "mesh",
        [
            Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), np.array([[0, 1, 2]], np.int32)),
            Mesh(np.array([[0, 0, 0], [1, 0, 0], [0.5, 1e-9, 0]], float), np.array([[0, 1, 2]], np.int32)),
            Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]], np.int32)),
            sheet(2),
        ],
        ids=["one triangle", "a line", "a point", "a sheet"],
    )
    def test_what_is_degenerate_is_finite(self, name, mesh) -> None:
        values = BY_NAME[name].compute(PosedShape(mesh))
        assert values.shape == (BY_NAME[name].width,)
        assert np.isfinite(values).all()
        assert (values >= 0).all()


def test_a_cloud_of_specks_is_like_the_surface_it_lies_on() -> None:
    """Soups have gaps: of a ball cut into specks, depths and outlines stay near those of the ball."""
    whole = ball(5)
    corners = whole.vertices[whole.faces]
    middle = corners.mean(axis=1, keepdims=True)
    specks = (middle + 0.8 * (corners - middle)).reshape(-1, 3)
    cut = Mesh(specks, np.arange(len(specks), dtype=np.int32).reshape(-1, 3))
    one, other, far = describe(whole), describe(cut), describe(lump())
    for name in BY_NAME:
        assert apart(one[name], other[name]) < 0.15 * apart(one[name], far[name]), name


def test_surflets_are_the_roots_of_shares() -> None:
    assert np.square(describe(lump())["Sfl"]).sum() == pytest.approx(1)
