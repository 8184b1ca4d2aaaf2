"""Shading normals: smooth where the surface is, split where it is not."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from shapeviz_report.render.normals import split_at_creases
from shapeviz_report.types import Mesh


def as_mesh(shape: trimesh.Trimesh) -> Mesh:
    return Mesh(np.asarray(shape.vertices, np.float64), np.asarray(shape.faces, np.int32))


def folded_sheet(degrees: float) -> Mesh:
    """Two triangles that share an edge and meet at an angle; 0 is flat."""
    angle = np.radians(degrees)
    vertices = np.array([[0, 0, 0], [0, 1, 0], [-1, 0, 0], [np.cos(angle), 0, np.sin(angle)]], np.float64)
    return Mesh(vertices, np.array([[0, 1, 2], [1, 0, 3]], np.int32))


def test_a_cube_keeps_its_six_flat_faces():
    surface = split_at_creases(as_mesh(trimesh.creation.box()))
    corners = surface.positions[surface.faces]
    face_normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    face_normals /= np.linalg.norm(face_normals, axis=1, keepdims=True)
    assert len(surface.positions) == 24
    np.testing.assert_allclose(
        surface.normals[surface.faces], np.repeat(face_normals[:, None], 3, 1), atol=1e-12
    )


def test_a_sphere_is_smooth_and_not_split():
    sphere = as_mesh(trimesh.creation.icosphere(subdivisions=3))
    surface = split_at_creases(sphere)
    assert len(surface.positions) == len(sphere.vertices)
    np.testing.assert_allclose(surface.normals, surface.positions, atol=0.01)


@pytest.mark.parametrize(("degrees", "split"), [(30, False), (50, True)])
def test_an_edge_is_split_above_forty_degrees_only(degrees: float, split: bool):
    assert len(split_at_creases(folded_sheet(degrees)).positions) == (6 if split else 4)


def test_a_face_wound_the_other_way_shades_like_its_neighbours():
    sphere = trimesh.creation.icosphere(subdivisions=3)
    faces = np.array(sphere.faces, np.int32)
    faces[7] = faces[7, ::-1]
    surface = split_at_creases(Mesh(np.asarray(sphere.vertices), faces))
    along = np.einsum("fcx,fcx->fc", surface.normals[surface.faces], surface.positions[surface.faces])
    np.testing.assert_allclose(np.delete(along, 7, axis=0), 1.0, atol=0.01)
    np.testing.assert_allclose(along[7], -1.0, atol=0.01)


def test_every_shaded_vertex_names_the_vertex_it_lies_on():
    mesh = as_mesh(trimesh.creation.cylinder(radius=1, height=2))
    surface = split_at_creases(mesh)
    np.testing.assert_array_equal(surface.positions, mesh.vertices[surface.source])
    np.testing.assert_array_equal(surface.source[surface.faces], mesh.faces)


def test_faces_without_area_are_left_out_and_disturb_nothing():
    flat = folded_sheet(0)
    spoiled = Mesh(flat.vertices, np.vstack([flat.faces, [[0, 0, 1], [2, 0, 3]]]).astype(np.int32))
    surface = split_at_creases(spoiled)
    assert len(surface.faces) == 2
    np.testing.assert_allclose(np.abs(surface.normals[:, 2]), 1.0)
