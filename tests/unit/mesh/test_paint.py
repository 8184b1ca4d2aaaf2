"""Colours: what readers find of them, where they end on a prepared mesh, and what cannot harm it."""

from __future__ import annotations

import io
import json
import re
import struct
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from shapeviz_report.mesh import collect_files, parse_mesh, parse_painted, prepare
from shapeviz_report.mesh.paint import MOST_PIXELS, Paint, Picture, as_bytes, bake, from_light, read_picture
from shapeviz_report.types import Mesh

BOX = trimesh.creation.box(extents=(1, 2, 3))
RED, GREEN = (220, 30, 30), (30, 160, 60)


def png(pixels: np.ndarray) -> bytes:
    file = io.BytesIO()
    Image.fromarray(pixels.astype(np.uint8)).save(file, "PNG")
    return file.getvalue()


LEFT_OUT = "materials or pictures of its colours left out, which are missing or cannot be used"

HALVES = png(np.array([[RED, RED, GREEN, GREEN]] * 4))
"""Red on the left, green on the right."""


def off(colors: list[str]) -> bytes:
    lines = ["OFF", f"{len(BOX.vertices)} {len(BOX.faces)} 0"]
    lines += [" ".join(f"{x:g}" for x in vertex) for vertex in BOX.vertices]
    lines += [f"3 {a} {b} {c} {color}" for (a, b, c), color in zip(BOX.faces, colors)]
    return "\n".join(lines).encode()


def by_side(mesh: Mesh) -> dict[tuple[int, int], np.ndarray]:
    """The mean colour of each side of a prepared box, its ridges left out."""
    size = np.ptp(mesh.vertices, axis=0)
    middle = (mesh.vertices.max(axis=0) + mesh.vertices.min(axis=0)) / 2
    place = (mesh.vertices - middle) / size * 2
    assert mesh.colors is not None
    found = {}
    for axis in range(3):
        others = [other for other in range(3) if other != axis]
        inner = (np.abs(place[:, others]) < 0.8).all(axis=1)
        for sign in (-1, 1):
            rows = inner & (place[:, axis] * sign > 0.95)
            found[axis, sign] = mesh.colors[rows].mean(axis=0)
    return found


def sides_of_faces() -> list[tuple[int, int]]:
    axes = np.abs(BOX.face_normals).argmax(axis=1)
    return [(int(axis), int(np.sign(normal[axis]))) for axis, normal in zip(axes, BOX.face_normals)]


def test_colours_of_faces_are_on_their_sides() -> None:
    palette = {
        side: (40 * number + 20, 200 - 30 * number, 90)
        for number, side in enumerate(sorted(set(sides_of_faces())))
    }
    content = off([" ".join(map(str, palette[side])) for side in sides_of_faces()])
    mesh, facts = prepare({"box.off": content}, 0.03)
    for side, color in by_side(mesh).items():
        np.testing.assert_allclose(color, palette[side], atol=2)
    assert facts.repairs.keys() <= {"vertices welded"}


@pytest.mark.parametrize("kind", ["uchar", "float"])
@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_colours_of_vertices_of_ply(kind, encoding) -> None:
    ball = trimesh.creation.icosphere(3)
    colors = np.round((ball.vertices + 1) / 2 * 255)
    stored = colors if kind == "uchar" else colors / 255
    kinds = [(axis, "<f4") for axis in "xyz"] + [
        (c, "u1" if kind == "uchar" else "<f4") for c in ("red", "green", "blue")
    ]
    written = {"ascii": "ascii", "binary": "binary_little_endian"}[encoding]
    head = f"ply\nformat {written} 1.0\nelement vertex {len(colors)}\n"
    head += "".join(f"property {'float' if name in 'xyz' else kind} {name}\n" for name, _ in kinds)
    head += f"element face {len(ball.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    if encoding == "ascii":
        rows = [" ".join(f"{v:g}" for v in (*vertex, *color)) for vertex, color in zip(ball.vertices, stored)]
        body = "\n".join(rows + [f"3 {a} {b} {c}" for a, b, c in ball.faces]).encode()
    else:
        table = np.zeros(len(colors), kinds)
        for column, (name, _) in enumerate(kinds):
            table[name] = np.column_stack([ball.vertices, stored])[:, column]
        faces = np.zeros(len(ball.faces), [("count", "u1"), ("corners", "<i4", 3)])
        faces["count"], faces["corners"] = 3, ball.faces
        body = table.tobytes() + faces.tobytes()
    mesh, _ = prepare({"ball.ply": head.encode() + body}, 0.04)
    assert mesh.colors is not None
    directions = mesh.vertices / np.linalg.norm(mesh.vertices, axis=1, keepdims=True)
    assert np.abs(mesh.colors - (directions + 1) / 2 * 255).max() < 12


LOW = [sign < 0 for _, sign in sides_of_faces()]
"""Of every face, whether it is on one of three sides."""

CUBE = (
    "".join(f"v {x} {y} {z}\n" for x, y, z in BOX.vertices)
    + "vt 0 0\nvt 1 0\nvt 0.5 1\nusemtl half\n"
    + "".join(f"f {a + 1}/1 {b + 1}/1 {c + 1}/-3\n" for a, b, c in BOX.faces[LOW])
    + "usemtl plain\n"
    + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in BOX.faces[np.invert(LOW)])
)


def write_obj(folder: Path, picture: str = "pictures/two colours.png", kd: str = "0 0 0") -> Path:
    """A box of two materials, the first with the lower left corner of a picture all over."""
    (folder / "box.obj").write_text("mtllib box.mtl\n" + CUBE)
    (folder / "box.mtl").write_text(
        f"newmtl half\nKd {kd}\nmap_Kd -s 1 1 1 {picture}\n\nnewmtl plain # the rest\nKd 0.5 0.25 1\n"
    )
    return folder / "box.obj"


def colors_of_faces(files: dict[str, bytes]) -> tuple[list[np.ndarray], dict[str, int]]:
    """The colour of each side of the box, in the order of its faces, and what was noted."""
    mesh, facts = prepare(files, 0.03)
    return [by_side(mesh)[side] for side in sides_of_faces()], dict(facts.repairs)


def test_materials_and_pictures_of_obj(tmp_path) -> None:
    path = write_obj(tmp_path)
    (tmp_path / "pictures").mkdir()
    (tmp_path / "pictures" / "two colours.png").write_bytes(HALVES)
    files = collect_files(path, tmp_path)
    assert list(files) == ["box.obj", "box.mtl", "pictures/two colours.png"]
    colors, noted = colors_of_faces(files)
    # at its corner a picture that is repeated meets itself
    corner = from_light(np.mean(lights(RED, GREEN), axis=0))
    for color, low in zip(colors, LOW):
        np.testing.assert_allclose(color, corner if low else (128, 64, 255), atol=2)
    assert "colours" not in " ".join(noted)


def test_materials_with_tabs_between_their_words() -> None:
    files = {
        "box.obj": b"mtllib\tbox.mtl\n" + CUBE.encode(),
        "box.mtl": b"newmtl\tplain\n\tKd\t0.5  0.25\t1\n",
    }
    colors, _ = colors_of_faces(files)
    np.testing.assert_allclose(colors[LOW.index(False)], (128, 64, 255), atol=1)


def test_materials_that_are_not_there_are_noted() -> None:
    mesh, facts = prepare({"box.obj": b"mtllib my box.mtl\n" + CUBE.encode()}, 0.03)
    assert mesh.colors is None
    assert facts.repairs[LEFT_OUT] == 1


@pytest.mark.parametrize("material", [b"", b"newmtl half\nKd 1 1 1\nnewmtl plain\nKd 1 1 1\n"])
def test_colours_of_vertices_beside_a_material_that_says_nothing(material) -> None:
    text = re.sub("^v (.*)$", r"v \1 0.2 0.4 0.6", CUBE, flags=re.MULTILINE)
    colors, _ = colors_of_faces({"box.obj": b"mtllib box.mtl\n" + text.encode(), "box.mtl": material})
    np.testing.assert_allclose(colors, np.tile((51, 102, 153), (len(colors), 1)), atol=1)


@pytest.mark.filterwarnings("error")
def test_colours_beyond_all_bounds() -> None:
    assert as_bytes(np.array([1e308, -1e308, np.nan]), most=1).tolist() == [255, 0, 0]
    assert as_bytes(np.array([np.inf, -1e308, np.nan])).tolist() == [255, 0, 0]
    assert as_bytes(np.empty((0, 3))).shape == (0, 3)


@pytest.mark.parametrize("full", [1, 255, 65535])
@pytest.mark.parametrize("form", ["off", "coff", "obj", "ply"])
def test_what_a_full_colour_is_the_largest_number_tells(form, full) -> None:
    """Also where some rows have whole numbers only."""
    rows = [" ".join(f"{x:g}" for x in vertex) for vertex in BOX.vertices]
    colors = ["0 0 0", f"{full} 0 0", f"0 {full / 5:g} {full}", *[f"0 {full} 0"] * 9]
    faces = [f"3 {a} {b} {c}" for a, b, c in BOX.faces]
    colored = [f"{row} {color}" for row, color in zip(rows, colors)]
    head = "ply\nformat ascii 1.0\nelement vertex 8\n" + "".join(f"property float {axis}\n" for axis in "xyz")
    head += "".join(f"property float {name}\n" for name in ("red", "green", "blue"))
    texts = {
        "off": ["OFF\n8 12 0", *rows, *(f"{face} {color}" for face, color in zip(faces, colors))],
        "coff": ["COFF\n8 12 0", *colored, *faces],
        "obj": [*(f"v {row}" for row in colored), *(f"f {a + 1} {b + 1} {c + 1}" for a, b, c in BOX.faces)],
        "ply": [
            head + "element face 12\nproperty list uchar int vertex_indices\nend_header",
            *colored,
            *faces,
        ],
    }
    mesh, paint = parse_painted({f"a.{form.removeprefix('c')}": "\n".join(texts[form]).encode()})
    wanted = np.array([(0, 0, 0), (255, 0, 0), (0, 51, 255), *[(0, 255, 0)] * 9])
    wanted = np.repeat(wanted[:, None], 3, axis=1) if form == "off" else wanted[mesh.faces]
    np.testing.assert_array_equal(paint().colors, wanted)


def ply_of_faces(
    of_vertex: str, of_face: str, head: str = "", more: dict[str, str] | None = None
) -> dict[str, bytes]:
    """A box as PLY, with what its header says of vertices and faces besides, and these on every row."""
    kinds = {
        **dict.fromkeys(["red", "green", "blue"], "uchar"),
        "texnumber": "int",
        "texcoord": "list uchar float",
    }

    def told(words: str) -> str:
        return "".join(f"property {kinds.get(word, 'float')} {word}\n" for word in words.split())

    more = more or {}
    lines = [
        f"ply\nformat ascii 1.0\n{head}element vertex 8\n{told('x y z')}{told(of_vertex)}"
        f"element face 12\nproperty list uchar int vertex_indices\n{told(of_face)}end_header",
        *(
            " ".join([*map(str, vertex), *(more[word] for word in of_vertex.split())])
            for vertex in BOX.vertices
        ),
        *(" ".join(["3", *map(str, face), *(more[word] for word in of_face.split())]) for face in BOX.faces),
    ]
    return {"a.ply": "\n".join(lines).encode()}


def test_white_vertices_of_ply_say_nothing_over_colours_of_faces() -> None:
    white = dict.fromkeys(["red", "green", "blue"], "255")
    files = ply_of_faces("red green blue", "red green blue", more=white)
    files["a.ply"] = re.sub(rb"^(3 .*) 255 255 255$", rb"\1 10 200 30", files["a.ply"], flags=re.MULTILINE)
    np.testing.assert_array_equal(colors_of(files), (10, 200, 30))


@pytest.mark.parametrize(
    ("of_vertex", "of_face", "color"),
    [
        ("s t", "", GREEN),
        ("texture_u texture_v", "red green blue", GREEN),
        ("u v red green blue", "", GREEN),
        ("s t", "texcoord", RED),
        ("", "texcoord texnumber", (0, 0, 255)),
    ],
)
def test_pictures_of_ply(tmp_path, of_vertex, of_face, color) -> None:
    more = {"texcoord": "6 0.2 1 0.3 1 0.2 0.5", "texnumber": "1", "red": "9", "green": "99", "blue": "7"}
    more |= dict.fromkeys(["s", "u", "texture_u"], "0.75") | dict.fromkeys(["t", "v", "texture_v"], "0.5")
    head = "comment TextureFile Türen/two colours.png\ncomment TextureFile blue.png\n"
    (tmp_path / "a.ply").write_bytes(ply_of_faces(of_vertex, of_face, head, more)["a.ply"])
    (tmp_path / "Türen").mkdir()
    (tmp_path / "Türen" / "two colours.png").write_bytes(HALVES)
    (tmp_path / "blue.png").write_bytes(png(np.full((2, 2, 3), (0, 0, 255))))
    files = collect_files(tmp_path / "a.ply", tmp_path)
    np.testing.assert_allclose(colors_of(files), color, atol=1)
    unused = "Türen/two colours.png" if "texnumber" in of_face else "blue.png"
    assert parse_painted(files)[1]().lost == (
        f"{unused} has no place on the surface, which lacks texture coordinates",
    )
    assert len(parse_painted({"a.ply": files["a.ply"]})[1]().lost) == 2


@pytest.mark.parametrize("texcoord", ["0", "2 1 1", "6 nan nan 0 0 0 0"])
def test_places_in_pictures_of_ply_that_are_none(texcoord) -> None:
    more = {"texcoord": texcoord, "texnumber": "-1", "red": "9", "green": "99", "blue": "7"}
    for of_face in ("red green blue texcoord", "red green blue texcoord texnumber"):
        files = ply_of_faces("", of_face, "comment TextureFile halves.png\n", more) | {"halves.png": HALVES}
        mesh, _ = prepare(files, 0.03)
        assert mesh.colors is not None


def lights(*colors) -> list[np.ndarray]:
    """Linear light, to be exact where a picture is looked up between its pixels."""
    encoded = np.array(colors) / 255
    return list(np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4))


@pytest.mark.parametrize(
    "picture", ["missing.png", "../secret.png", "/etc/hostname", "//host/share/x.png", "C:/x.png", "link.png"]
)
def test_pictures_that_are_not_there_or_elsewhere_are_noted(tmp_path, picture) -> None:
    (tmp_path / "secret.png").write_bytes(HALVES)
    folder = tmp_path / "database"
    folder.mkdir()
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    files = collect_files(write_obj(folder, picture, "0.2 0.4 0.6"), folder)
    assert list(files) == ["box.obj", "box.mtl"]
    colors, noted = colors_of_faces(files)
    np.testing.assert_allclose(colors[LOW.index(True)], (51, 102, 153), atol=1)
    assert noted[LEFT_OUT] == 1


def bomb(side: int = int(MOST_PIXELS**0.5) + 1) -> bytes:
    """A PNG of a few bytes that announces more pixels than are unpacked."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    content = zlib.compress(bytes(1000))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", content) + chunk(b"IEND", b"")


@pytest.mark.parametrize(
    "content",
    [b"", b"no picture", HALVES[:40], b"%!PS-Adobe-3.0 EPSF-3.0\n", bomb(), bomb(9_500), bomb(30_000)],
    ids=range(7),
)
@pytest.mark.filterwarnings("error")
def test_pictures_that_cannot_be_read_are_none(content) -> None:
    why = (
        "has more than 67,108,864 pixels"
        if content.startswith(b"\x89PNG") and content != HALVES[:40]
        else "is no picture"
    )
    with pytest.raises(ValueError, match=why):
        read_picture(content)


def test_pictures_of_sixteen_bits() -> None:
    file = io.BytesIO()
    Image.fromarray(np.array([[0, 128 << 8, 180 * 257, 65535]], np.uint16)).save(file, "PNG")
    assert read_picture(file.getvalue())[0].tolist() == [[grey] * 3 for grey in (0, 128, 180, 255)]


def test_large_pictures_are_made_smaller() -> None:
    picture = read_picture(png(np.full((10, 3000, 3), 77)))
    assert picture.shape == (3, 1024, 3)
    assert (picture == 77).all()


def gltf(primitive: dict[str, object], **more: object) -> dict[str, bytes]:
    """A triangle and its mirror image, joined, as glTF with attributes of one colour a vertex."""
    points = BOX.vertices.astype("<f4").tobytes()
    faces = BOX.faces.astype("<u4").tobytes()
    colors = np.tile(np.array([1.0, 0.25, 0.0], "<f4"), (len(BOX.vertices), 1)).tobytes()
    places = np.tile(np.array([0.125, 0.5], "<f4"), (len(BOX.vertices), 1)).tobytes()
    parts = [points, faces, colors, places]
    starts = np.cumsum([0, *map(len, parts)])
    count = len(BOX.vertices)
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": "box.bin", "byteLength": int(starts[-1])}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": int(start), "byteLength": len(part)}
            for start, part in zip(starts, parts)
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 3 * len(BOX.faces), "type": "SCALAR"},
            {"bufferView": 2, "componentType": 5126, "count": count, "type": "VEC3"},
            {"bufferView": 3, "componentType": 5126, "count": count, "type": "VEC2"},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1} | primitive]}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [10, 0, 0], "scale": [-1, 1, 1]}],
    }
    return {"box.gltf": json.dumps(document | more).encode(), "box.bin": b"".join(parts)}


def colors_of(files: dict[str, bytes]) -> np.ndarray:
    mesh, _ = prepare(files, 0.03)
    assert mesh.colors is not None
    assert np.ptp(mesh.colors.astype(int), axis=0).max() <= 1
    return mesh.colors[0]


def test_colours_of_gltf_are_light_and_multiply() -> None:
    np.testing.assert_array_equal(
        colors_of(gltf({"attributes": {"POSITION": 0, "COLOR_0": 2}})), (255, 137, 0)
    )
    materials = [{"pbrMetallicRoughness": {"baseColorFactor": [0.25, 1, 0.5, 1]}}]
    files = gltf({"attributes": {"POSITION": 0, "COLOR_0": 2}, "material": 0}, materials=materials)
    np.testing.assert_array_equal(colors_of(files), (137, 137, 0))


def test_pictures_of_gltf(tmp_path) -> None:
    looks = {
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": "two%20colours.png"}],
    }
    files = gltf({"attributes": {"POSITION": 0, "TEXCOORD_0": 3}, "material": 0}, **looks)
    for name, content in (files | {"two colours.png": HALVES}).items():
        (tmp_path / name).write_bytes(content)
    found = collect_files(tmp_path / "box.gltf", tmp_path)
    assert list(found) == ["box.gltf", "box.bin", "two colours.png"]
    np.testing.assert_allclose(colors_of(found), RED, atol=1)
    (tmp_path / "two colours.png").unlink()
    mesh, facts = prepare(collect_files(tmp_path / "box.gltf", tmp_path), 0.03)
    assert mesh.colors is None
    assert facts.repairs[LEFT_OUT] == 1


@pytest.mark.parametrize(("wrap", "color"), [({}, RED), ({"wrapS": 33071}, GREEN), ({"wrapS": 33648}, GREEN)])
def test_pictures_of_gltf_end_as_they_are_told_to(wrap, color) -> None:
    texture = {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [1, 7]}}}
    looks = {
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": texture}}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [wrap],
        "images": [{"uri": "halves.png"}],
    }
    files = gltf({"attributes": {"POSITION": 0, "TEXCOORD_0": 3}, "material": 0}, **looks)
    np.testing.assert_allclose(colors_of(files | {"halves.png": HALVES}), color, atol=1)


@pytest.mark.parametrize("order", ["front", "back", "both"])
@pytest.mark.parametrize(
    "shape", [BOX, trimesh.creation.icosphere(3), trimesh.creation.torus(1, 0.3)], ids=range(3)
)
def test_a_surface_of_two_sides_has_the_colour_of_the_outer_one(shape, order) -> None:
    """As programs of architects write it, whose outer sides have materials."""
    outer = [(face, "200 30 30") for face in shape.faces]
    inner = [(face[::-1], "255 255 255") for face in shape.faces]
    faces = {
        "front": outer + inner,
        "back": inner + outer,
        "both": [x for two in zip(outer, inner) for x in two],
    }
    lines = ["OFF", f"{len(shape.vertices)} {2 * len(shape.faces)} 0"]
    lines += [" ".join(map(str, vertex)) for vertex in shape.vertices]
    lines += [f"3 {a} {b} {c} {color}" for (a, b, c), color in faces[order]]
    np.testing.assert_array_equal(colors_of({"a.off": "\n".join(lines).encode()}), (200, 30, 30))


def test_a_surface_that_is_turned_in_places_keeps_its_colours() -> None:
    colors = [f"{20 * number} 200 {255 - 20 * number}" for number in range(12)]
    mesh, _ = prepare({"a.off": off(colors)}, 0.03)
    turned = Mesh(BOX.vertices, np.where(np.arange(12)[:, None] % 3 == 0, BOX.faces[:, ::-1], BOX.faces))
    lines = off(colors).decode().split("\n")
    lines[-12:] = [f"3 {a} {b} {c} {color}" for (a, b, c), color in zip(turned.faces, colors)]
    other, _ = prepare({"a.off": "\n".join(lines).encode()}, 0.03)
    np.testing.assert_allclose(by_side(other)[0, 1], by_side(mesh)[0, 1], atol=2)
    np.testing.assert_allclose(by_side(other)[2, -1], by_side(mesh)[2, -1], atol=2)


def test_a_picture_goes_on_beyond_its_sides() -> None:
    """Red on the left of one pixel of green, along a strip with two copies on each side."""
    corners = np.array([[[-2.0, 0, 0], [3, 0, 0], [3, 1, 0]], [[-2, 0, 0], [3, 1, 0], [-2, 1, 0]]])
    pixels = np.array([[RED, GREEN]], np.uint8)
    middles = np.array([-0.75, -0.25, 0.25, 0.75, 1.25, 1.75])
    mesh = Mesh(np.column_stack([middles, np.full((6, 2), [0.5, 0])]), np.empty((0, 3), np.int32))
    wanted = {"repeat": "RGRGRG", "mirror": "GRRGGR", "clamp": "RRRGGG"}
    for wrap, letters in wanted.items():
        paint = Paint(
            np.full((2, 3, 3), 255, np.uint8), corners[..., :2].astype(np.float32), np.zeros((2, 3), np.int16),
            (Picture(pixels, (wrap, "repeat")),),
        )  # fmt: skip
        # faces without a size, so that a colour is taken at their vertices alone
        points = replace(mesh, faces=np.repeat(np.arange(6, dtype=np.int32)[:, None], 3, axis=1))
        assert bake(paint, corners, points).tolist() == [
            list({"R": RED, "G": GREEN}[letter]) for letter in letters
        ]


def colors_of_material(lines: str, place: str = "0.25 0.5", use: str = "m", **files: bytes) -> np.ndarray:
    """The colour of a box of one material all over, at one place of its picture."""
    faces = "".join(f"f {a + 1}/1 {b + 1}/1 {c + 1}/1\n" for a, b, c in BOX.faces)
    text = "".join(f"v {x} {y} {z}\n" for x, y, z in BOX.vertices)
    obj = f"mtllib box.mtl\n{text}vt {place}\nusemtl {use}\n{faces}"
    return colors_of({"box.obj": obj.encode(), "box.mtl": lines.encode(), "halves.png": HALVES})


@pytest.mark.parametrize(
    ("options", "place", "color"),
    [
        ("", "1.125 0.5", RED),
        ("-clamp on", "1.125 0.5", GREEN),
        ("-blendu off -clamp off -mm 0 1", "1.125 0.5", RED),
        ("-s 3 1 1 -bm 1.0", "0.25 0.5", GREEN),
        ("-o 0.5", "0.25 0.5", GREEN),
        ("-s 2 -o -.5 1e-1 0", "0.375 0.5", RED),
        ("-t 7", "0.125 0.5", RED),
    ],
)
def test_how_pictures_of_materials_lie(options, place, color) -> None:
    lines = f"newmtl m\nmap_Kd {options} halves.png\n"
    np.testing.assert_allclose(colors_of_material(lines, place), color, atol=1)


def test_names_of_materials_with_a_hash() -> None:
    lines = "# Kd 0 0 0\nnewmtl Material #1\nKd 1 0 0\nnewmtl Material #2 # the other\nKd 0 0 1 #blue\n"
    assert colors_of_material(lines, use="Material #2").tolist() == [0, 0, 255]
    assert colors_of_material(lines, use="Material #1 # this").tolist() == [255, 0, 0]


def test_materials_that_no_file_has_are_told() -> None:
    files = {"box.obj": b"mtllib box.mtl\n" + CUBE.encode(), "box.mtl": b"newmtl half\nKd 1 0 0\n"}
    _, paint = parse_painted(files)
    assert paint().lost == ("plain is a material that its files of materials do not have",)


@pytest.mark.parametrize(
    ("named", "there"),
    [
        ("wood.png", "looks/wood.png"),
        ("pictures/wood.png", "looks/pictures/wood.png"),
        ("wood.png", "wood.png"),
        ("pictures/wood.png", "pictures/wood.png"),
        (r"C:\Users\me\pictures\wood.png", "pictures/wood.png"),
        ("/home/me/wood.png", "wood.png"),
        ("../../elsewhere/wood.png", "wood.png"),
        ("my%20wood.png", "my wood.png"),
        ("wood#1.png", "wood#1.png"),
        ("Türholz.png", "Türholz.png"),
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "latin-1", "utf-16"])
def test_where_pictures_of_materials_are_looked_for(tmp_path, named, there, encoding) -> None:
    path = write_obj(tmp_path)
    path.write_text(path.read_text().replace("box.mtl", "looks/box.mtl"))
    (tmp_path / "looks").mkdir()
    (tmp_path / "looks" / "box.mtl").write_bytes(
        f"newmtl half\nmap_Kd {named}\nnewmtl plain\n".encode(encoding)
    )
    (tmp_path / there).parent.mkdir(exist_ok=True)
    (tmp_path / there).write_bytes(HALVES)
    _, paint = parse_painted(collect_files(path, tmp_path))
    assert paint().lost == ()
    assert len(paint().images) == 1


def test_files_of_colours_in_other_letters(tmp_path) -> None:
    path = write_obj(tmp_path, r"Pictures\Two colours.PNG")
    (tmp_path / "box.mtl").rename(tmp_path / "BOX.MTL")
    (tmp_path / "pictures").mkdir()
    (tmp_path / "pictures" / "two colours.png").write_bytes(HALVES)
    _, paint = parse_painted(collect_files(path, tmp_path))
    assert paint is not None
    assert paint().lost == ()
    assert len(paint().images) == 1
    # of two that are alike nobody can say which is meant
    (tmp_path / "Box.mtl").write_bytes(b"")
    (what,) = parse_painted(collect_files(path, tmp_path))[1]().lost
    assert what.startswith("box.mtl is not there")


TEXTURED = {
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}}],
    "textures": [{"source": 0}],
    "images": [{"uri": "halves.png"}],
}


def test_pictures_without_a_place_on_the_surface_are_told() -> None:
    told = "halves.png has no place on the surface, which lacks texture coordinates"
    files = gltf({"attributes": {"POSITION": 0, "TEXCOORD_0": 3}, "material": 0}, **TEXTURED)
    _, paint = parse_painted(files | {"halves.png": HALVES})
    assert paint().lost == (told,)
    files = {
        "box.obj": b"mtllib a.mtl\n" + CUBE.replace("/1", "").replace("/-3", "").encode(),
        "a.mtl": b"newmtl half\nmap_Kd halves.png\nnewmtl plain\n",
        "halves.png": HALVES,
    }
    _, paint = parse_painted(files)
    assert paint().lost == (told,)


def test_pictures_of_gltf_that_are_only_there_as_basis() -> None:
    looks = TEXTURED | {"textures": [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]}
    files = gltf({"attributes": {"POSITION": 0, "TEXCOORD_1": 3}, "material": 0}, **looks)
    _, paint = parse_painted(files)
    assert paint().lost == ("texture 0 is no picture that can be read",)


def test_broken_materials_fail_no_shape() -> None:
    files = gltf({"material": 0}, materials=[{"pbrMetallicRoughness": {"baseColorFactor": "red"}}])
    mesh, facts = prepare(files, 0.03)
    assert mesh.colors is None
    assert facts.repairs["colours that cannot be read left out"] == 1


@pytest.mark.parametrize("color", ["", "255 255 255", "0.8 0.8 0.8", "128 130 126"])
def test_no_colour_and_one_grey_are_clay(color) -> None:
    mesh, _ = prepare({"box.off": off([color] * len(BOX.faces))}, 0.03)
    assert mesh.colors is None


def test_the_surface_is_the_same_with_colours() -> None:
    plain = parse_mesh({"box.off": off([""] * 12)})
    colored = parse_mesh({"box.off": off(["1 2 3"] * 12)})
    np.testing.assert_array_equal(plain.vertices, colored.vertices)
    np.testing.assert_array_equal(plain.faces, colored.faces)


def test_a_ridge_has_the_mean_light_of_its_sides() -> None:
    corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [0, -1, 0], [1, 0, 0]]], float)
    paint = Paint(np.array([[RED] * 3, [GREEN] * 3], np.uint8))
    mesh = Mesh(
        np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0]], float),
        np.array([[0, 1, 2], [0, 3, 1]], np.int32),
    )
    mean = from_light(np.mean(lights(RED, GREEN), axis=0))
    np.testing.assert_array_equal(bake(paint, corners, mesh), [mean, mean, RED, GREEN])
