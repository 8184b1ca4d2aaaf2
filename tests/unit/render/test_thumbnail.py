"""Thumbnails: what is in the picture, and that it reads on any page."""

from __future__ import annotations

import hashlib
import io
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from PIL import Image

from shapeviz_report.render import choose_view, render_thumbnail
from shapeviz_report.types import Mesh


def as_mesh(shape: trimesh.Trimesh) -> Mesh:
    return Mesh(np.asarray(shape.vertices, np.float64), np.asarray(shape.faces, np.int32))


CUBE = as_mesh(trimesh.creation.box())
SPHERE = as_mesh(trimesh.creation.icosphere(subdivisions=4))
TORUS = as_mesh(trimesh.creation.torus(major_radius=0.7, minor_radius=0.25))
TRIANGLE = Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float64), np.array([[0, 1, 2]], np.int32))
SHEET = Mesh(
    np.array([[-1, 0, -0.7], [1, 0, -0.7], [1, 0, 0.7], [-1, 0, 0.7]], np.float64),
    np.array([[0, 1, 2], [0, 2, 3]], np.int32),
)


def pixels(mesh: Mesh, size: int = 160) -> np.ndarray:
    """(size, size, 4) float array of what a browser shows."""
    image = Image.open(io.BytesIO(render_thumbnail(mesh, choose_view(mesh), size=size)))
    assert (image.format, image.mode, image.size) == ("WEBP", "RGBA", (size, size))
    return np.asarray(image, np.float64)


def luminance(picture: np.ndarray) -> np.ndarray:
    return picture[..., :3] @ [0.2126, 0.7152, 0.0722]


@pytest.mark.parametrize(
    "mesh", [CUBE, SPHERE, TORUS, TRIANGLE, SHEET], ids=["cube", "sphere", "torus", "triangle", "sheet"]
)
def test_the_shape_is_opaque_centred_and_fills_the_picture(mesh: Mesh):
    alpha = pixels(mesh)[..., 3]
    rows, columns = np.nonzero(alpha > 127)
    assert abs(rows.min() + rows.max() - 159) <= 2
    assert abs(columns.min() + columns.max() - 159) <= 2
    assert 0.89 < max(np.ptp(rows), np.ptp(columns)) / 160 < 0.94
    assert (alpha[:4] == 0).all()
    assert (alpha[:, :4] == 0).all()
    assert (alpha == 255).sum() > 0.85 * (alpha > 0).sum()


def test_a_sphere_is_a_disc_with_a_smooth_edge():
    alpha = pixels(SPHERE)[..., 3] / 255.0
    diameter = 160 * 0.92
    assert alpha.sum() == pytest.approx(np.pi / 4 * diameter**2, rel=0.02)
    edge = alpha[(alpha > 0) & (alpha < 1)]
    assert len(np.unique(edge)) > 8, "shades of the edge"


def test_a_cube_shows_three_faces_in_three_shades():
    picture = pixels(CUBE)
    # Well inside of the outline, three shades hold nearly everything.
    shades = luminance(picture)[picture[..., 3] == 255]
    counts, bounds = np.histogram(shades, bins=np.arange(0, 256, 4))
    peaks = [int(bounds[k]) for k in np.argsort(counts)[::-1][:3]]
    assert min(np.diff(sorted(peaks))) >= 12, "distinct"
    assert np.sort(counts)[::-1][:9].sum() > 0.8 * len(shades), "flat faces"


@pytest.mark.parametrize(
    "mesh", [CUBE, SPHERE, TORUS, TRIANGLE, SHEET], ids=["cube", "sphere", "torus", "triangle", "sheet"]
)
def test_it_reads_on_white_and_on_near_black(mesh: Mesh):
    picture = pixels(mesh)
    shades = luminance(picture)[picture[..., 3] == 255]
    assert 105 < shades.mean() < 205
    assert np.percentile(shades, 2) > 60, "does not sink into a dark page"
    assert np.percentile(shades, 98) < 235, "does not dissolve into a white page"


def test_the_outline_has_no_fringe():
    picture = pixels(SPHERE, size=320)
    alpha = picture[..., 3]
    shades = luminance(picture)
    near = alpha == 255
    for row in range(40, 280, 20):
        inside = np.nonzero(near[row])[0]
        edge = np.nonzero((alpha[row] > 60) & (alpha[row] < 255))[0]
        for column in edge:
            neighbour = inside[np.argmin(abs(inside - column))]
            assert abs(shades[row, column] - shades[row, neighbour]) < 25


def test_an_inside_out_surface_looks_the_same():
    inverted = Mesh(TORUS.vertices, TORUS.faces[:, ::-1].copy())
    # Normals differ in their last digits, and WebP makes more of single pixels.
    apart = abs(pixels(TORUS) - pixels(inverted))
    assert apart.mean() < 0.2
    assert np.quantile(apart, 0.999) <= 6


@pytest.mark.slow
def test_the_same_mesh_gives_the_same_bytes_in_another_process():
    code = """
import sys, numpy as np, trimesh
from shapeviz_report.render import choose_view, render_thumbnail
from shapeviz_report.types import Mesh
shape = trimesh.creation.torus(major_radius=0.7, minor_radius=0.25)
mesh = Mesh(np.asarray(shape.vertices, np.float64), np.asarray(shape.faces, np.int32))
import hashlib
print(hashlib.sha256(render_thumbnail(mesh, choose_view(mesh))).hexdigest())
"""
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    here = render_thumbnail(TORUS, choose_view(TORUS))
    assert result.stdout.strip() == hashlib.sha256(here).hexdigest(), result.stderr


def test_parts_that_do_not_touch_are_all_in_the_picture():
    apart = trimesh.util.concatenate(
        [trimesh.creation.icosphere(radius=0.3).apply_translation((x, 0, 0)) for x in (-0.7, 0.7)]
    )
    alpha = pixels(as_mesh(apart))[..., 3]
    columns = (alpha > 127).any(axis=0)
    assert np.count_nonzero(np.diff(columns.astype(int)) == 1) == 2


@pytest.mark.parametrize("renderer", ["osmesa", "zbuffer"])
def test_a_shape_is_drawn_in_its_colours_unless_clay_is_asked_for(renderer) -> None:
    view = choose_view(TORUS)
    blue = replace(TORUS, colors=np.tile(np.array([30, 60, 230], np.uint8), (len(TORUS.vertices), 1)))
    plain = render_thumbnail(TORUS, view, size=64, renderer=renderer)
    assert render_thumbnail(blue, view, size=64, renderer=renderer, clay=True) == plain
    drawn = np.asarray(Image.open(io.BytesIO(render_thumbnail(blue, view, size=64, renderer=renderer))), int)
    clay = np.asarray(Image.open(io.BytesIO(plain)), int)
    inside = clay[..., 3] > 250
    assert (np.abs(drawn[..., 3] - clay[..., 3]) <= 1).all()
    red, _, light = drawn[inside][:, :3].T
    assert (light > red).all()
    assert (clay[inside][:, 0] > clay[inside][:, 2]).mean() > 0.9
