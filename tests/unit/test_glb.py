"""Binary glTF: valid by the validator of the Khronos Group, and read back by us and by others."""

from __future__ import annotations

import io
import json
import shutil
import struct
import subprocess
from pathlib import Path

import numpy as np
import pytest
import trimesh
from solids import ball

from shapeviz_report.errors import ConfigError
from shapeviz_report.glb import encode_glb, find_dimensions
from shapeviz_report.mesh import parse_mesh
from shapeviz_report.mesh.read import parse_painted
from shapeviz_report.types import Mesh

ROOT = Path(__file__).parents[2]
VALIDATE = """
require("gltf-validator").validateBytes(new Uint8Array(require("fs").readFileSync(0)))
  .then((report) => console.log(JSON.stringify(report.issues)));
"""
Y_UP = np.eye(3)
Z_UP = np.array([[1.0, 0, 0], [0, 0.3, 0.9], [0, -0.9, 0.3]])


def values_of(mesh: Mesh) -> dict[str, np.ndarray]:
    height = mesh.vertices[:, 2].astype(np.float32)
    return {"_GC": height, "_FPFH_0": height * 2, "_FPFH_1": np.zeros_like(height)}


def large() -> Mesh:
    """More vertices than 16 bits number."""
    side = np.arange(257)
    x, y = (part.ravel() for part in np.meshgrid(side, side))
    corner = (side[:-1, None] * 257 + side[:-1]).ravel()
    faces = np.concatenate(
        [
            np.stack([corner, corner + 1, corner + 257], 1),
            np.stack([corner + 1, corner + 258, corner + 257], 1),
        ]
    )
    return Mesh(np.stack([x, y, x * y / 100], 1) / 257.0, faces.astype(np.int32))


@pytest.fixture(params=["ball", "large"])
def mesh(request) -> Mesh:
    return ball(2) if request.param == "ball" else large()


@pytest.mark.skipif(
    shutil.which("node") is None or not (ROOT / "node_modules" / "gltf-validator").is_dir(),
    reason="the validator is not installed",
)
@pytest.mark.slow
@pytest.mark.parametrize("view", [Y_UP, Z_UP, -Y_UP])
def test_it_is_valid(mesh, view) -> None:
    def issues(content: bytes) -> dict[str, object]:
        told = subprocess.run(
            ["node", "-e", VALIDATE], input=content, capture_output=True, cwd=ROOT, check=True
        )
        return json.loads(told.stdout)

    colors = np.zeros((len(mesh.vertices), 3), np.uint8)
    content = encode_glb(mesh.vertices, mesh.faces, view, values_of(mesh), colors)
    found = issues(content)
    assert (found["numErrors"], found["numWarnings"], found["numInfos"]) == (0, 0, 0), found["messages"]
    broken = content.replace(b'"_GC"', b'"GC_"')
    assert issues(broken)["numErrors"] > 0, "the validator looks"


def test_we_read_it_back_upright(mesh) -> None:
    for view, turn in ((Y_UP, np.eye(3)), (Z_UP, [[1, 0, 0], [0, 0, 1], [0, -1, 0]])):
        content = encode_glb(mesh.vertices, mesh.faces, view, values_of(mesh))
        read = parse_mesh({"shape.glb": content})
        np.testing.assert_allclose(read.vertices, mesh.vertices @ np.transpose(turn), atol=1e-6)
        np.testing.assert_array_equal(read.faces, mesh.faces)
        assert read.up == "y"


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_what_is_up_in_the_picture_is_up_in_viewers(axis, sign) -> None:
    up = np.zeros(3)
    up[axis] = sign
    tilted = 0.8 * up + 0.6 * np.roll(up, 1)
    right = np.roll(up, 2)
    mesh = ball(1)
    content = encode_glb(
        mesh.vertices + up, mesh.faces, np.stack([right, tilted, np.cross(right, tilted)]), {}
    )
    read = parse_mesh({"shape.glb": content})
    np.testing.assert_allclose(read.vertices.mean(axis=0), [0, 1, 0], atol=1e-3)
    volumes = [trimesh.Trimesh(own.vertices, own.faces, process=False).volume for own in (mesh, read)]
    assert volumes[0] == pytest.approx(volumes[1]), "turned, not mirrored"


def test_others_read_it_with_its_values(mesh) -> None:
    content = encode_glb(mesh.vertices, mesh.faces, Y_UP, values_of(mesh))
    (read,) = trimesh.load_scene(io.BytesIO(content), file_type="glb", process=False).geometry.values()
    np.testing.assert_allclose(read.vertices, mesh.vertices, atol=1e-6)
    np.testing.assert_array_equal(read.faces, mesh.faces)
    for name, values in values_of(mesh).items():
        np.testing.assert_array_equal(np.ravel(read.vertex_attributes[name]), values)


def test_colours_come_back_as_they_were(mesh) -> None:
    colors = np.random.default_rng(0).integers(0, 256, (len(mesh.vertices), 3)).astype(np.uint8)
    content = encode_glb(mesh.vertices, mesh.faces, Y_UP, values_of(mesh), colors)
    _, paint = parse_painted({"shape.glb": content})
    assert paint is not None
    np.testing.assert_array_equal(paint().colors.reshape(-1, 3), colors[mesh.faces].reshape(-1, 3))


def test_indices_are_as_short_as_they_can_be() -> None:
    def kind(count: int) -> int:
        faces = np.array([[0, 1, count - 1]], np.int32)
        content = encode_glb(np.random.default_rng(0).random((count, 3)), faces, Y_UP, {})
        (length,) = struct.unpack_from("<I", content, 12)
        return json.loads(content[20 : 20 + length])["accessors"][0]["componentType"]

    # 65535 as an index would begin a new strip
    assert (kind(65_534), kind(65_535), kind(65_537)) == (5123, 5125, 5125)


def test_values_are_named_after_descriptors() -> None:
    assert find_dimensions(None) == {}
    assert find_dimensions("Agd") == {"_AGD": list(find_dimensions("all")).index("_AGD")}
    found = find_dimensions("FPFH, Agd")
    assert len(found) == 34
    assert {"_FPFH_0", "_FPFH_32", "_AGD"} < found.keys()
    with pytest.raises(
        ConfigError, match=r"'Panorama', which has no values at vertices; there are: Gc, .* and all"
    ):
        find_dimensions("Agd,Panorama")
