"""Drawing: what is nearest, how far it is, and what happens without the library."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from solids import ball, lump, tube

from shapeviz_report.render import check_renderer
from shapeviz_report.render.camera import frame
from shapeviz_report.render.normals import split_at_creases
from shapeviz_report.render.rasteriser import rasterise

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float64)
TWO_TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def run_python(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=120,
    )


RENDERERS = pytest.mark.parametrize("renderer", ["osmesa", "zbuffer"])


@RENDERERS
@pytest.mark.parametrize("faces", [TWO_TRIANGLES, TWO_TRIANGLES[:, ::-1]], ids=["front", "back"])
def test_a_square_is_drawn_from_either_side_with_its_values_in_place(faces: np.ndarray, renderer: str):
    values = (SQUARE + 1.0) / 2.0 * [1.0, 1.0, 0.0]
    camera = frame(SQUARE, np.eye(3), 100)
    buffers = rasterise(SQUARE, faces, values, camera, renderer)
    distance = camera.eye[2]
    np.testing.assert_allclose(buffers.depth[5:95, 5:95], distance, rtol=1e-4)
    assert (buffers.depth[:3] == 0).all()
    assert (buffers.depth[:, -3:] == 0).all()
    along = (np.arange(100) + 0.5 - 50) / camera.focal_length * distance / 2.0 + 0.5
    np.testing.assert_allclose(buffers.values[50, 5:95, 0], along[5:95], atol=0.01)
    np.testing.assert_allclose(buffers.values[5:95, 50, 1], 1.0 - along[5:95], atol=0.01)


@RENDERERS
def test_the_nearer_surface_hides_the_farther(renderer: str):
    behind = SQUARE - [0, 0, 0.5]
    positions = np.vstack([SQUARE * 0.5, behind])
    faces = np.vstack([TWO_TRIANGLES, TWO_TRIANGLES + 4]).astype(np.int32)
    values = np.repeat([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], 4, axis=0)
    buffers = rasterise(positions, faces, values, frame(positions, np.eye(3), 60), renderer)
    np.testing.assert_allclose(buffers.values[30, 30], [1, 0, 0])
    np.testing.assert_allclose(buffers.values[5, 30], [0, 0, 1])


@pytest.mark.parametrize("mesh", [ball(3), lump(), tube()], ids=["ball", "lump", "tube"])
def test_all_renderers_see_the_same_but_for_pixels_at_edges(mesh):
    surface = split_at_creases(mesh)
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    camera = frame(surface.positions, turn, 200)
    values = (surface.normals + 1.0) / 2.0
    one, other = (
        rasterise(surface.positions, surface.faces, values, camera, renderer)
        for renderer in ("osmesa", "zbuffer")
    )
    there = one.depth > 0
    assert there.mean() > 0.1
    assert (there != (other.depth > 0)).sum() <= 0.002 * there.sum()
    both = there & (other.depth > 0)
    # A fold may be seen or hidden in the middle of a pixel.
    assert np.quantile(np.abs(one.depth - other.depth)[both], 0.995) < 2e-3
    assert np.quantile(np.abs(one.values - other.values)[both], 0.99) < 0.01


@pytest.mark.slow
def test_drawing_many_pictures_keeps_no_memory():
    code = """
import numpy as np
from shapeviz_report.render.camera import frame
from shapeviz_report.render.rasteriser import rasterise

def resident():
    return int(open("/proc/self/statm").read().split()[1]) * 4096

square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0]], float)
camera = frame(square, np.eye(3), 64)
def draw(times):
    for _ in range(times):
        rasterise(square, np.array([[0, 1, 2]], np.int32), (square + 1) / 2, camera, "osmesa")
draw(20)
before = resident()
draw(60)
print((resident() - before) / 60)
"""
    result = run_python(code)
    assert result.returncode == 0, result.stderr
    assert float(result.stdout) < 200_000, "bytes a picture"


@pytest.mark.slow
def test_importing_the_package_does_not_load_the_graphics_library():
    code = "import sys, shapeviz_report.render; print('pyrender' in sys.modules, 'OpenGL' in sys.modules)"
    assert run_python(code).stdout.split() == ["False", "False"]


@pytest.mark.slow
def test_a_machine_with_osmesa_passes_the_check_and_ends_quietly():
    check_renderer("osmesa")
    result = run_python(
        "from shapeviz_report.render import check_renderer; check_renderer('osmesa'); check_renderer('osmesa')"
    )
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")


@pytest.mark.slow
def test_without_osmesa_the_error_says_what_to_install(tmp_path: Path):
    # Empty files hide the library from the dynamic linker as if it were not installed.
    for suffix in ("", *(f".{version}" for version in range(10))):
        (tmp_path / f"libOSMesa.so{suffix}").touch()
    code = """
from shapeviz_report.errors import RenderError
from shapeviz_report.render import check_renderer
for _ in range(2):
    try:
        check_renderer('osmesa')
    except RenderError as error:
        print(error)
"""
    result = run_python(code, LD_LIBRARY_PATH=str(tmp_path))
    assert result.returncode == 0, result.stderr
    lines = result.stdout.splitlines()
    assert len(lines) == 2, "the second call fails as clearly as the first"
    assert all("apt install libosmesa6" in line for line in lines)
