"""Colours of 3MF, COLLADA and STL: the values that their specifications give, and what cannot harm them."""

from __future__ import annotations

import io
import struct
import zipfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from shapeviz_report.mesh import collect_files, parse_painted, read_paint
from shapeviz_report.mesh.paint import MOST_PIXELS, Paint
from shapeviz_report.mesh.readers import limits, threemf
from shapeviz_report.types import Mesh

RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 128, 0), (0, 0, 255), (255, 255, 255)


def png(width: int = 2, height: int = 2) -> bytes:
    """Red in the upper left corner, blue elsewhere."""
    pixels = np.full((height, width, 3), BLUE, np.uint8)
    pixels[0, 0] = RED
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


def look(files: dict[str, bytes]) -> tuple[Mesh, Paint]:
    mesh, paint = parse_painted(files)
    assert paint is not None
    found = paint()
    assert found.colors.shape == (len(mesh.faces), 3, 3)
    return mesh, found


def lost(files: dict[str, bytes]) -> tuple[str, ...]:
    _, paint = parse_painted(files)
    assert paint is not None
    return read_paint(paint)[1]


def colors_at(mesh: Mesh, paint: Paint) -> dict[tuple[float, ...], set[tuple[int, ...]]]:
    """Place of a vertex -> the colours of the corners there."""
    found: dict[tuple[float, ...], set[tuple[int, ...]]] = {}
    for place, color in zip(mesh.vertices[mesh.faces].reshape(-1, 3), paint.colors.reshape(-1, 3)):
        found.setdefault(tuple(place.round(6).tolist()), set()).add(tuple(color.tolist()))
    return found


# 3MF

SPACE = "http://schemas.microsoft.com/3dmanufacturing/"
TETRAHEDRON = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
VERTICES = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in TETRAHEDRON)
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))


def threemf_of(
    resources: str,
    looks: Sequence[str] = ("",) * 4,
    of_object: str = "",
    items: str = '<item objectid="9"/>',
    pictures: dict[str, bytes] | None = None,
) -> dict[str, bytes]:
    """A tetrahedron, with what its object and its triangles say of their looks."""
    triangles = "".join(
        f'<triangle v1="{a}" v2="{b}" v3="{c}" {look}/>' for (a, b, c), look in zip(FACES, looks)
    )
    model = (
        f'<model unit="millimeter" xmlns="{SPACE}core/2015/02" xmlns:m="{SPACE}material/2015/02"><resources>{resources}'
        f'<object id="9" {of_object}><mesh><vertices>{VERTICES}</vertices><triangles>{triangles}</triangles></mesh>'
        f"</object></resources><build>{items}</build></model>"
    )
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(
            "_rels/.rels",
            '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
            f'<Relationship Target="/3D/a.model" Id="r" Type="{SPACE}2013/01/3dmodel"/></Relationships>',
        )
        archive.writestr("3D/a.model", model)
        for name, content in (pictures or {}).items():
            archive.writestr(name, content)
    return {"a.3mf": data.getvalue()}


BASES = (
    '<basematerials id="1"><base name="a" displaycolor="#FF0000"/><base name="b" displaycolor="#008000FF"/>'
    '<base name="c"/></basematerials>'
)
COLORS = (
    '<m:colorgroup id="2"><m:color color="#ff0000"/><m:color color="#008000"/><m:color color="#0000FF80"/>'
    "</m:colorgroup>"
)


def test_3mf_base_materials_of_object_and_triangles() -> None:
    looks = ["", 'pid="1" p1="0"', 'p1="0" p2="1" p3="1"', 'pid="1" p1="2"']
    _, paint = look(threemf_of(BASES, looks, 'pid="1" pindex="1"'))
    # a triangle has the material of its first corner; one without a colour is white
    assert paint.colors.tolist() == [[list(color)] * 3 for color in (GREEN, RED, RED, WHITE)]
    assert paint.lost == ()


def test_3mf_colours_of_corners_are_between_them_and_copies_have_them_too() -> None:
    looks = ['pid="2" p1="0" p2="1" p3="2"', 'pid="2" p1="1"', 'pid="7" p1="0"', 'pid="2" p1="99"']
    mirror = '<item objectid="9"/><item objectid="9" transform="-1 0 0 0 1 0 0 0 1 10 0 0"/>'
    mesh, paint = look(threemf_of(COLORS, looks, items=mirror))
    assert paint.colors[:4].tolist() == [
        [list(RED), list(GREEN), list(BLUE)], [list(GREEN)] * 3, [list(WHITE)] * 3, [list(WHITE)] * 3
    ]  # fmt: skip
    # the mirrored copy is turned round, and its colours with it: of each corner those of where it came from
    moved = Mesh(mesh.vertices * [-1, 1, 1] + [10, 0, 0], mesh.faces)
    assert colors_at(mesh, paint) == colors_at(moved, paint)


def test_3mf_pictures_of_the_package() -> None:
    resources = (
        '<m:texture2d id="4" path="/3D/Textures/Wood%20Oak.png" contenttype="image/png"/><m:texture2dgroup id="5" '
        'texid="4"><m:tex2coord u="0" v="1"/><m:tex2coord u="1" v="0.25"/></m:texture2dgroup>'
    )
    looks = ['pid="5" p1="0" p2="1" p3="0"', *['pid="5" p1="1"'] * 3]
    files = threemf_of(resources, looks, pictures={"3d/textures/wood oak.PNG": png()})
    _, paint = look(files)
    assert paint.lost == ()
    assert paint.places is not None
    assert paint.pictures is not None
    # v is counted from the bottom, places of paint from the top
    assert paint.places[0].tolist() == [[0, 0], [1, 0.75], [0, 0]]
    assert (paint.pictures == 0).all()
    assert (paint.colors == 255).all()
    np.testing.assert_array_equal(paint.images[0].pixels[0], [RED, BLUE])
    missing = "is not there, lies outside the folder or is too large"
    assert lost(threemf_of(resources, looks)) == (f"/3D/Textures/Wood%20Oak.png {missing}",)
    broken = threemf_of(resources, looks, pictures={"3D/Textures/Wood Oak.png": b"no picture"})
    assert lost(broken) == ("/3D/Textures/Wood%20Oak.png is no picture that can be read",)


def test_3mf_pictures_end_as_they_are_told_to() -> None:
    told = 'tilestyleu="mirror" tilestylev="clamp"'
    resources = "".join(
        f'<m:texture2d id="{4 + number}" path="x.png" {how}/><m:texture2dgroup id="{6 + number}" '
        f'texid="{4 + number}"><m:tex2coord u="0" v="1"/></m:texture2dgroup>'
        for number, how in enumerate((told, ""))
    )
    looks = ['pid="6" p1="0"', 'pid="7" p1="0"', "", ""]
    _, paint = look(threemf_of(resources, looks, pictures={"x.png": png()}))
    assert [image.wraps for image in paint.images] == [("mirror", "clamp"), ("repeat", "repeat")]
    assert paint.images[0].pixels is paint.images[1].pixels
    assert paint.pictures is not None
    assert paint.pictures[:, 0].tolist() == [0, 1, -1, -1]


@pytest.mark.parametrize("size", ["bytes", "pixels"])
def test_3mf_pictures_beyond_all_bounds(monkeypatch, size) -> None:
    monkeypatch.setattr(threemf, "MOST_LOOKS", 10_000)
    resources = (
        '<m:texture2d id="4" path="x.png"/><m:texture2dgroup id="5" texid="4"><m:tex2coord u="0" v="1"/>'
        "</m:texture2dgroup>"
    )
    huge = bytes(20_000) if size == "bytes" else huge_picture()
    (what,) = lost(threemf_of(resources, ['pid="5" p1="0"'] * 4, pictures={"x.png": huge}))
    assert ("too large" if size == "bytes" else "no picture") in what


def huge_picture() -> bytes:
    """The head of a PNG of more pixels than are unpacked."""
    content = bytearray(png())
    content[16:24] = struct.pack(">II", int(MOST_PIXELS**0.5) + 1, int(MOST_PIXELS**0.5) + 1)
    return bytes(content)


# STL


def stl(words: Sequence[int], header: bytes = b"") -> dict[str, bytes]:
    content = header.ljust(80, b" ") + struct.pack("<I", len(words))
    for face, word in zip(FACES, words, strict=True):
        corners = np.array([TETRAHEDRON[corner] for corner in face], "<f4")
        content += bytes(12) + corners.tobytes() + struct.pack("<H", word)
    return {"a.stl": content}


def test_stl_colours_of_facets_where_all_are_valid() -> None:
    # VisCAM and SolidView: bit 15 valid, then five bits each of red, green, blue
    _, paint = look(stl([0x8000 | 31 << 10, 0x8000 | 16 << 5, 0x8000 | 31, 0xFFFF]))
    assert paint.colors[:, 0].tolist() == [[255, 0, 0], [0, 132, 0], [0, 0, 255], [255, 255, 255]]
    assert (paint.colors == paint.colors[:, :1]).all()


@pytest.mark.parametrize("words", [[0] * 4, [1, 2, 3, 4], [0x8000 | 31, 0x8000 | 31, 0x8000 | 31, 31]])
def test_stl_bits_that_are_no_colours(words) -> None:
    assert parse_painted(stl(words))[1] is None


def test_stl_colours_as_magics_writes_them() -> None:
    header = b"Materialise Magics COLOR=\x10\x20\x30\xff,MATERIAL=" + bytes(12)
    # without bit 15 a facet has its own: five bits each of blue, green, red
    _, paint = look(stl([31, 31 << 10, 0x8000, 0xFFFF], header))
    assert paint.colors[:, 2].tolist() == [[255, 0, 0], [0, 0, 255], [16, 32, 48], [16, 32, 48]]
    _, paint = look(stl([0] * 4, header))
    assert (paint.colors == [16, 32, 48]).all()


# COLLADA

NUMBERS = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")


def source(name: str, values: np.ndarray, params: str) -> str:
    count, width = values.shape
    words = " ".join(f"{value:g}" for value in values.ravel())
    named = "".join(f'<param name="{param}" type="float"/>' for param in params)
    return (
        f'<source id="{name}"><float_array id="{name}-a" count="{values.size}">{words}</float_array><technique_common>'
        f'<accessor source="#{name}-a" count="{count}" stride="{width}">{named}</accessor></technique_common></source>'
    )


PLACES = np.array([[0, 1], [1, 0.25], [0.5, 0.5]])
CORNER_COLORS = np.array([[1, 0, 0], [0, 0.5, 0], [0, 0, 1]])
COLOR_INPUT = '<input semantic="COLOR" source="#colors" offset="1"/>'
PLACE_INPUT = '<input semantic="TEXCOORD" source="#places" offset="1" set="3"/>'
FOUR_CORNERS = " ".join(f"{vertex} {place}" for face in FACES for place, vertex in enumerate(face))


def effect(content: str, before: str = "", shader: str = "lambert", name: str = "e") -> str:
    return (
        f'<effect id="{name}"><profile_COMMON>{before}<technique sid="t"><{shader}>{content}</{shader}></technique>'
        "</profile_COMMON></effect>"
    )


def collada(
    effects: str = "",
    inputs: str = "",
    binding: str = '<instance_material symbol="m" target="#wood"/>',
    images: str = "",
    faces: str = "",
    nodes: str | None = None,
) -> dict[str, bytes]:
    """A tetrahedron of one material."""
    width = 2 if inputs else 1
    corners = FOUR_CORNERS if width == 2 else " ".join(str(vertex) for face in FACES for vertex in face)
    faces = faces or (
        f'<triangles count="4" material="m"><input semantic="VERTEX" source="#v" offset="0"/>{inputs}<p>{corners}</p>'
        "</triangles>"
    )
    shown = (
        f'<node><instance_geometry url="#g"><bind_material><technique_common>{binding}</technique_common>'
        "</bind_material></instance_geometry></node>"
    )
    return {
        "a.dae": (
            '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
            f"<up_axis>Z_UP</up_axis></asset><library_images>{images}</library_images><library_effects>{effects}</library_effects>"
            '<library_materials><material id="wood"><instance_effect url="#e"/></material><material id="other">'
            '<instance_effect url="#f"/></material></library_materials><library_geometries><geometry id="g"><mesh>'
            f"{source('p', np.array(TETRAHEDRON), 'XYZ')}{source('places', PLACES, 'ST')}"
            f'{source("colors", CORNER_COLORS, "RGB")}<vertices id="v"><input semantic="POSITION" source="#p"/>'
            f'</vertices>{faces}</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">'
            f"{shown if nodes is None else nodes}</visual_scene></library_visual_scenes><scene>"
            '<instance_visual_scene url="#s"/></scene></COLLADA>'
        ).encode()
    }


SIENNA = "<diffuse><color>0.5 0.25 1 1</color></diffuse>"


@pytest.mark.parametrize(
    ("content", "before", "shader"),
    [
        (SIENNA, "", "lambert"),
        (SIENNA, "", "phong"),
        (
            '<diffuse><param ref="d"/></diffuse>',
            '<newparam sid="d"><float4>0.5 0.25 1 1</float4></newparam>',
            "blinn",
        ),
        (f"<emission>{SIENNA[9:-10]}</emission>", "", "constant"),
    ],
)
def test_collada_colours_of_effects(content, before, shader) -> None:
    _, paint = look(collada(effect(content, before, shader)))
    assert (paint.colors == (128, 64, 255)).all()
    # pycollada, which has read the same file, gives the same colour
    if shader != "constant":
        read = trimesh.load(
            io.BytesIO(collada(effect(content, before, shader))["a.dae"]), file_type="dae", force="mesh"
        )
        assert read.visual.material.baseColorFactor[:3].tolist() in ([128, 64, 255], [127, 63, 255])


def test_collada_materials_are_those_that_the_instance_binds() -> None:
    two = effect(SIENNA) + effect("<diffuse><color>1 0 0 1</color></diffuse>", name="f")
    nodes = "".join(
        f'<node><scale>{scale} 1 1</scale><instance_geometry url="#g"><bind_material><technique_common>'
        f'<instance_material symbol="m" target="#{name}"/></technique_common></bind_material></instance_geometry>'
        "</node>"
        for name, scale in (("wood", 1), ("other", -1))
    )
    mesh, paint = look(collada(two, nodes=nodes))
    side = mesh.vertices[mesh.faces].sum(axis=1)[:, 0]
    assert (paint.colors[side > 0] == (128, 64, 255)).all()
    assert (paint.colors[side < 0] == RED).all()
    assert {(128, 64, 255), RED} == {tuple(color) for color in paint.colors.reshape(-1, 3).tolist()}


def test_collada_colours_of_corners() -> None:
    mesh, paint = look(collada(effect(SIENNA), COLOR_INPUT))
    np.testing.assert_array_equal(paint.colors[0], [RED, (0, 128, 0), BLUE])
    # a geometry that is mirrored is turned round, its colours with it
    node = '<node><scale>-1 1 1</scale><instance_geometry url="#g"/></node>'
    turned, painted = look(collada(effect(SIENNA), COLOR_INPUT, nodes=node))
    assert colors_at(Mesh(turned.vertices * [-1, 1, 1], turned.faces), painted) == colors_at(mesh, paint)


def test_collada_corners_of_polygons_strips_and_holes_keep_their_colours() -> None:
    vertices = '<input semantic="VERTEX" source="#v" offset="0"/><input semantic="COLOR" source="#colors" offset="1"/>'
    square = "0 0 1 1 3 2 2 1"
    whole = {
        "polylist": f'<polylist count="1">{vertices}<vcount>4</vcount><p>{square}</p></polylist>',
        "polygons": f'<polygons count="1">{vertices}<p>{square}</p></polygons>',
        "trifans": f'<trifans count="1">{vertices}<p>{square}</p></trifans>',
        "tristrips": f'<tristrips count="1">{vertices}<p>0 0 1 1 2 1 3 2</p></tristrips>',
        "holes": f'<polygons count="1">{vertices}<ph><p>{square}</p><h>0 0 0 0</h></ph></polygons>',
    }
    wanted = {(0, 0, 0): {RED}, (1, 0, 0): {(0, 128, 0)}, (0, 1, 0): {(0, 128, 0)}, (0, 0, 1): {BLUE}}
    for name, faces in whole.items():
        mesh, paint = look(collada(faces=faces))
        assert len(mesh.faces) == 2, name
        assert colors_at(mesh, paint) == wanted, name


def test_collada_white_corners_say_nothing_over_a_material() -> None:
    files = collada(effect(SIENNA), COLOR_INPUT)
    files["a.dae"] = files["a.dae"].replace(b"1 0 0 0 0.5 0 0 0 1", b"1 1 1 1 1 1 1 1 1")
    _, paint = look(files)
    assert (paint.colors == (128, 64, 255)).all()


TEXTURE = '<diffuse><texture texture="sampler" texcoord="UV"/></diffuse>'
SAMPLER = (
    '<newparam sid="surface"><surface type="2D"><init_from>pic</init_from></surface></newparam><newparam sid="sampler">'
    "<sampler2D><source>surface</source></sampler2D></newparam>"
)
NEWER = '<newparam sid="sampler"><sampler2D><instance_image url="#pic"/></sampler2D></newparam>'
OLD_IMAGE, NEW_IMAGE = (
    f'<image id="pic"><init_from>{text}</init_from></image>'
    for text in ("pictures/wood%20&amp;%20oak.png", "<ref>./pictures/wood%20&amp;%20oak.png</ref>")
)
BOUND = (
    '<instance_material symbol="m" target="#wood"><bind_vertex_input semantic="UV" input_semantic="TEXCOORD" '
    'input_set="3"/></instance_material>'
)


@pytest.mark.parametrize(("before", "image"), [(SAMPLER, OLD_IMAGE), (NEWER, NEW_IMAGE)], ids=["1.4", "1.5"])
@pytest.mark.parametrize("name", ["wood & oak.png", "Wood & Oak.PNG"])
def test_collada_pictures(tmp_path: Path, before, image, name) -> None:
    files = collada(effect(TEXTURE, before), PLACE_INPUT, BOUND, image)
    (tmp_path / "a.dae").write_bytes(files["a.dae"])
    (tmp_path / "Pictures").mkdir()
    (tmp_path / "Pictures" / name).write_bytes(png())
    _, paint = look(collect_files(tmp_path / "a.dae", tmp_path))
    assert paint.lost == ()
    assert paint.places is not None
    assert paint.pictures is not None
    assert paint.places[0].tolist() == [[0, 0], [1, 0.75], [0.5, 0.5]]
    assert (paint.pictures == 0).all()
    (tmp_path / "Pictures" / name).unlink()
    (what,) = lost(collect_files(tmp_path / "a.dae", tmp_path))
    assert what.startswith(
        image.split(">")[1 + image.count("<ref>")].split("<")[0].replace("%20", " ").replace("&amp;", "&")
    )
    assert "is not there" in what


def test_collada_pictures_end_as_they_are_told_to() -> None:
    wraps = "<wrap_s>MIRROR</wrap_s><wrap_t> CLAMP </wrap_t></sampler2D>"
    image = '<image id="pic"><init_from>file:///C:/pictures/wood.png</init_from></image>'
    before = SAMPLER.replace("</sampler2D>", wraps)
    files = collada(effect(TEXTURE, before), PLACE_INPUT, BOUND, image)
    _, paint = look(files | {"/C:/pictures/wood.png": png()})
    assert [image.wraps for image in paint.images] == [("mirror", "clamp")]


def test_collada_pictures_without_a_place_on_the_surface() -> None:
    image = '<image id="pic"><init_from>wood.png</init_from></image>'
    files = collada(effect(TEXTURE, SAMPLER), "", BOUND, image) | {"wood.png": png()}
    assert lost(files) == ("wood.png has no place on the surface, which lacks texture coordinates",)


@pytest.mark.parametrize(
    "uri", ["../secret.png", "file:///etc/hostname", "http://127.0.0.1/x.png", "link.png"]
)
def test_collada_pictures_elsewhere_are_not_opened(tmp_path: Path, uri) -> None:
    (tmp_path / "secret.png").write_bytes(png())
    folder = tmp_path / "database"
    folder.mkdir()
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    image = f'<image id="pic"><init_from>{uri}</init_from></image>'
    (folder / "a.dae").write_bytes(collada(effect(TEXTURE, SAMPLER), PLACE_INPUT, BOUND, image)["a.dae"])
    files = collect_files(folder / "a.dae", folder)
    assert list(files) == ["a.dae"]
    assert len(lost(files)) == 1


def test_collada_names_of_pictures_are_looked_for_up_to_a_bound(tmp_path: Path) -> None:
    names = "".join(
        f"<image><init_from>{'x' * (number % 3000)}{number}.png</init_from></image>"
        for number in range(20_000)
    )
    (tmp_path / "a.dae").write_bytes(collada(effect(TEXTURE, SAMPLER), images=names)["a.dae"])
    (tmp_path / "0.png").write_bytes(png())
    (tmp_path / ("x" * 200 + "18200.png")).write_bytes(png())
    assert list(collect_files(tmp_path / "a.dae", tmp_path)) == ["a.dae", "0.png"]


@pytest.mark.parametrize(
    "effects",
    [
        "",
        effect("<diffuse><color>red</color></diffuse>"),
        effect("<diffuse><color>1 0</color></diffuse>"),
        effect('<diffuse><texture texture="nothing"/></diffuse>'),
        effect(TEXTURE, '<newparam sid="sampler"><sampler2D><source>sampler</source></sampler2D></newparam>'),
    ],
)
def test_collada_broken_looks_fail_no_shape(effects) -> None:
    mesh, paint = parse_painted(collada(effects, COLOR_INPUT.replace("colors", "nothing")))
    assert len(mesh.faces) == 4
    assert paint is not None
    read_paint(paint)


def test_bounds_are_those_of_all_formats() -> None:
    assert threemf.MOST_LOOKS == limits.MOST_LOOKS
