"""COLLADA 1.4 and 1.5."""

from __future__ import annotations

import io
import zipfile

import numpy as np
import numpy.typing as npt
from conformance.cases import BOX, BOX_QUADS, BOX_TRIANGLES, TWO_BOXES, Case, Extents, box

NAMESPACE = "http://www.collada.org/2005/11/COLLADASchema"
XYZ = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
POINTS = '<input semantic="VERTEX" source="#{id}-v" offset="0"/>'
ONE = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"


def words(values: npt.ArrayLike) -> str:
    return " ".join(f"{value:.17g}" for value in np.ravel(values))


def source(name: str, values: npt.ArrayLike, params: str = XYZ, stride: int = 3, more: str = "") -> str:
    count = np.size(values)
    return (
        f'<source id="{name}"><float_array id="{name}-a" count="{count}">{words(values)}</float_array>'
        f'<technique_common><accessor source="#{name}-a" count="{count // stride}" stride="{stride}"{more}>{params}'
        "</accessor></technique_common></source>"
    )


def list_of(names: str, name: str, param: str, tag: str = "Name_array") -> str:
    count = len(names.split())
    return (
        f'<source id="{name}"><{tag} id="{name}-a" count="{count}">{names}</{tag}><technique_common><accessor '
        f'source="#{name}-a" count="{count}"><param name="{param}" type="name"/></accessor></technique_common></source>'
    )


def triangles(name: str = "g", corners: npt.ArrayLike = BOX_TRIANGLES, inputs: str = POINTS) -> str:
    p = words(corners)
    return f'<triangles count="{np.size(BOX_TRIANGLES) // 3}">{inputs.format(id=name)}<p>{p}</p></triangles>'


def geometry(name: str = "g", faces: str | None = None, points: str | None = None, kind: str = "mesh") -> str:
    return (
        f'<geometry id="{name}"><{kind}>{points or source(f"{name}-p", box())}<vertices id="{name}-v"><input '
        f'semantic="POSITION" source="#{name}-p"/></vertices>{triangles(name) if faces is None else faces}'
        f"</{kind}></geometry>"
    )


def show(name: str = "g", moves: str = "", inside: str = "") -> str:
    return f'<node>{moves}<instance_geometry url="#{name}">{inside}</instance_geometry></node>'


MOVED = show(moves="<translate>10 0 0</translate>")


def document(
    nodes: str = show(),
    geometries: str | None = None,
    more: str = "",
    asset: str = "<up_axis>Y_UP</up_axis>",
    head: str = f'<COLLADA xmlns="{NAMESPACE}" version="1.4.1">',
    scene: str = '<scene><instance_visual_scene url="#s"/></scene>',
) -> bytes:
    return (
        f'<?xml version="1.0" encoding="utf-8"?>{head}<asset>{asset}</asset>{more}<library_geometries>'
        f"{geometry() if geometries is None else geometries}</library_geometries><library_visual_scenes>"
        f'<visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>{scene}</COLLADA>'
    ).encode()


def one(name: str, data: bytes, area: float = 52, volume: float | None = 24, size: Extents = BOX) -> Case:
    return Case(name, "mesh.dae", {"mesh.dae": data}, area, volume, size, 1)


def two(name: str, data: bytes) -> Case:
    return Case(name, "mesh.dae", {"mesh.dae": data}, 104, 48, TWO_BOXES, 2)


def bad(name: str, data: bytes, reason: str) -> Case:
    return Case(name, "mesh.dae", {"mesh.dae": data}, refused=reason)


def of(faces: str) -> bytes:
    return document(geometries=geometry(faces=faces.replace("{inputs}", POINTS.format(id="g"))))


def run(corners: npt.ArrayLike) -> str:
    return f"<p>{words(corners)}</p>"


def primitives() -> list[Case]:
    quads = "4 4 4 4 4 4"
    wide = (
        POINTS
        + '<input semantic="NORMAL" source="#n" offset="1"/><input semantic="TEXCOORD" source="#t" offset="2"/>'
    )
    last = '<input semantic="NORMAL" source="#n" offset="0"/><input semantic="VERTEX" source="#{id}-v" offset="1"/>'
    spread = np.column_stack([BOX_TRIANGLES.ravel(), np.full((36, 2), 5)])
    behind = np.column_stack([np.full(36, 5), BOX_TRIANGLES.ravel()])
    strips = [[0, 1, 2, 3, 6, 7, 4, 5, 0, 1], [4, 0, 6, 2], [1, 5, 3, 7]]
    fans = [[0, 1, 3, 2, 6, 4, 5, 1], [7, 3, 1, 5, 4, 6, 2, 3]]
    outline = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]
    prism = np.array([[x, y, z] for z in (0, 2) for x, y in outline])
    sides = [[k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6] for k in range(6)]
    corners = words([5, 4, 3, 2, 1, 0, *range(6, 12)]) + " " + words(sides)
    concave = geometry(
        faces=f'<polylist count="8">{POINTS.format(id="g")}<vcount>6 6 4 4 4 4 4 4</vcount><p>{corners}</p></polylist>',
        points=source("g-p", prism),
    )
    half = words(BOX_TRIANGLES[:6]), words(BOX_TRIANGLES[6:])
    lines = (
        '<lines count="1">{inputs}<p>0 7</p></lines><linestrips count="1">{inputs}<p>0 7 3</p></linestrips>'
    )
    square, hole = [[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [1, 3], [3, 3], [3, 1]]
    frame = np.array([[x, y, z] for z in (0, 1) for x, y in square + hole])
    around = [[k, (k + 1) % 4 + k // 4 * 4, (k + 1) % 4 + k // 4 * 4 + 8, k + 8] for k in range(8)]

    def with_holes(below: str, above: str, count: int = 10) -> bytes:
        faces = f'<polygons count="{count}">{POINTS.format(id="g")}'
        faces += f"<ph><p>3 2 1 0</p>{below}</ph><ph><p>8 9 10 11</p>{above}</ph>{''.join(map(run, around))}</polygons>"
        return document(geometries=geometry(faces=faces, points=source("g-p", frame)))

    return [
        one("triangles", document()),
        one(
            "polylist",
            of(f'<polylist count="6">{{inputs}}<vcount>{quads}</vcount>{run(BOX_QUADS)}</polylist>'),
        ),
        one("polygons", of('<polygons count="6">{inputs}' + "".join(map(run, BOX_QUADS)) + "</polygons>")),
        one("concave polygons", document(geometries=concave), 34, 10, (3, 3, 2)),
        one("tristrips", of('<tristrips count="3">{inputs}' + "".join(map(run, strips)) + "</tristrips>")),
        one("trifans", of('<trifans count="2">{inputs}' + "".join(map(run, fans)) + "</trifans>")),
        one(
            "several primitives",
            of("".join(f'<triangles count="6">{{inputs}}<p>{p}</p></triangles>' for p in half)),
        ),
        one("corners with normals and texture coordinates", of(triangles(corners=spread, inputs=wide))),
        one("vertices at another offset", of(triangles(corners=behind, inputs=last))),
        one("lines and linestrips", of(triangles() + lines)),
        one("splines", document(show() + show("c"), geometry() + '<geometry id="c"><spline/></geometry>')),
        one("convex_mesh with faces", document(geometries=geometry(kind="convex_mesh"))),
        one("polygons with holes", with_holes("<h>7 6 5 4</h>", "<h>12 13 14 15</h>"), 48, 12, (4, 4, 1)),
        one(
            "polygons with holes turned as their outlines",
            with_holes("<h>4 5 6 7</h>", "<h>15 14 13 12</h>"),
            48,
            12,
            (4, 4, 1),
        ),
        bad(
            "holes that overlap",
            with_holes("<h>4 5 6 7</h><h>4 5 6 7</h>", "<h>12 13 14 15</h>"),
            "holes that do not lie within",
        ),
        bad(
            "holes without a value",
            with_holes("<h>4 5 6 7</h>", "<h>12 13 14 15</h>").replace(b" 3 1 0 ", b" 3 nan 0 "),
            "corners without a value",
        ),
        bad(
            "holes without an outline",
            of("<polygons count='1'>{inputs}<ph><h>0 1 2</h></ph></polygons>"),
            "0 outlines",
        ),
        bad(
            "fewer polygons with holes than announced",
            with_holes("", "", 11),
            "announces 11 elements, and has 10",
        ),
        bad(
            "convex_mesh of another geometry",
            document(geometries='<geometry id="g"><convex_mesh convex_hull_of="#h"/></geometry>'),
            "convex hull",
        ),
        bad("brep", document(geometries='<geometry id="g"><brep/></geometry>'), "brep"),
        bad(
            "a count that is no number",
            of(triangles().replace('"12"', '"twelve"')),
            "count of <triangles> .* 'twelve'",
        ),
        bad(
            "fewer triangles than announced",
            of(triangles(corners=BOX_TRIANGLES[:10])),
            "announces 12 elements, and has 10",
        ),
        bad(
            "corners that are not complete",
            of(triangles(corners=BOX_TRIANGLES.ravel()[:-1])),
            "35 corners, which is no multiple of three",
        ),
        bad(
            "more triangles than announced",
            document(
                show("h") + show(),
                geometry("h") + geometry(faces=triangles().replace('count="12"', 'count="0"')),
            ),
            "announces 0 elements, and has 12",
        ),
        bad(
            "fewer corners than vcount",
            of(f'<polylist count="6">{{inputs}}<vcount>{quads}</vcount>{run(BOX_QUADS[:5])}</polylist>'),
            "announces 24 corners, and has 20",
        ),
        bad(
            "an index out of range",
            of(triangles(corners=[*BOX_TRIANGLES.ravel()[:-1], 8])),
            "vertex 8 .* 8 vertices",
        ),
        bad("a negative index", of(triangles(corners=[*BOX_TRIANGLES.ravel()[:-1], -1])), "vertex -1"),
    ]


def sources() -> list[Case]:
    padded = np.column_stack([box(), np.full((8, 2), 9)])
    params = XYZ + '<param type="float"/><param type="float"/>'
    nameless = '<param type="float"/>' * 3
    swapped = "".join(f'<param name="{axis}" type="float"/>' for axis in "ZYX")

    def with_points(text: str) -> bytes:
        return document(geometries=geometry(points=text))

    short = source("g-p", box()).replace('count="8"', 'count="9"')
    return [
        one("a stride", with_points(source("g-p", padded, params, 5))),
        one("an offset", with_points(source("g-p", [7, 7, *box().ravel()], more=' offset="2"'))),
        one("parameters without names", with_points(source("g-p", box(), nameless))),
        one("parameters in another order", with_points(source("g-p", box()[:, ::-1], swapped))),
        one("int_array", with_points(source("g-p", box()).replace("float_array", "int_array"))),
        bad("a source that is too short", with_points(short), "announces 9 elements"),
        bad(
            "a source that is not there",
            with_points(source("other", box())),
            "'g-p', which is not in the file",
        ),
        bad(
            "words among numbers",
            with_points(source("g-p", box()).replace("3 4<", "3 four<")),
            "number belongs: 'four'",
        ),
        bad("decimal commas", with_points(source("g-p", box()).replace("3 4<", "3,5 4<")), "decimal comma"),
    ]


def scenes() -> list[Case]:
    def moved(text: str, *values: float, size: Extents = BOX, name: str) -> Case:
        return one(name, document(show(moves=text)), *(values or (52, 24)), size)

    library = '<library_nodes><node id="n">{}</node></library_nodes>'
    inner = '<node><instance_node url="#n"/></node>'
    further = '<node><translate>10 0 0</translate><instance_node url="#n"/></node>'
    matrix = "<matrix>1 0 0 10 0 1 0 0 0 0 1 0 0 0 0 1</matrix>"
    material = (
        '<bind_material><technique_common><instance_material symbol="m" target="#none"/></technique_common>'
        "</bind_material>"
    )
    levels = "".join(
        f'<node id="n{k}"><instance_node url="#n{k + 1}"/><instance_node url="#n{k + 1}"/></node>'
        for k in range(40)
    )
    bomb = f'<library_nodes>{levels}<node id="n40">{show()}</node></library_nodes>'
    lookat = "<lookat>0 0 0 0 0 -1 0 1 0</lookat>"
    aside = "<lookat>1 2 3 0 2 3 0 1 0</lookat>"  # looks along -x: z is x, and x is -z
    order = "<translate>10 0 0</translate><scale>2 1 1</scale>"
    return [
        two("translate", document(show() + MOVED)),
        two("matrix", document(show() + show(moves=matrix))),
        moved("<rotate>0 0 1 90</rotate>", size=(3, 2, 4), name="rotate"),
        moved("<scale>2 2 2</scale>", 208, 192, size=(4, 6, 8), name="scale"),
        # x moves by y: the box leans to 2 + 3 wide; the sides of x are sqrt(2) as large
        moved("<skew>45 0 1 0 1 0 0</skew>", 28 + 24 * 2**0.5, 24, size=(5, 3, 4), name="skew"),
        moved(lookat, name="lookat"),
        moved(aside, size=(4, 3, 2), name="lookat aside"),
        Case(
            "transformations in their order",
            "mesh.dae",
            {"mesh.dae": document(show() + show(moves=order))},
            132,
            72,
            (14, 3, 4),
            2,
        ),
        moved("<scale>-1 1 1</scale>", name="mirrored nodes"),
        two("nodes in nodes", document(f"<node><translate>5 0 0</translate>{MOVED}{show()}</node>")),
        two("instance_node", document(inner + further, more=library.format(show()))),
        two("missing materials", document(show(inside=material) + MOVED)),
        one("geometries outside the scene", document(geometries=geometry() + geometry("h"))),
        one(
            "cameras, lights and animations",
            document(
                show() + '<node><instance_camera url="#c"/><instance_light url="#l"/></node>',
                more="<library_animations/>",
            ),
        ),
        two("no scene", document(show() + MOVED, scene="")),
        one("no visual scene", document(scene="").replace(b"library_visual_scenes", b"library_lights")),
        bad(
            "transformations that mean nothing",
            document(show(moves="<lookat>0 0 0 0 0 0 0 1 0</lookat>")),
            "<lookat> of a node means nothing",
        ),
        bad(
            "transformations without a value",
            document(show(moves="<translate>nan 0 0</translate>")),
            "means nothing",
        ),
        bad(
            "transformations of too few numbers",
            document(show(moves="<scale>2 2</scale>")),
            "2 numbers, not 3",
        ),
        bad("a scene without geometry", document("<node/>"), "shows none of its geometries"),
        bad(
            "a geometry that is not there",
            document(show() + show("none")),
            "'none', which is not in the file",
        ),
        bad(
            "geometry in another file",
            document('<node><instance_geometry url="b.dae#g"/></node>'),
            "geometry in another file",
        ),
        bad(
            "nodes in a circle",
            document(inner, more=library.format('<instance_node url="#n"/>' + show())),
            "contains itself",
        ),
        bad(
            "nodes doubled forty times",
            document('<node><instance_node url="#n0"/></node>', more=bomb),
            "triangles, all copies",
        ),
        bad("two geometries of one id", document(geometries=geometry() * 2), "stands 2 times"),
    ]


def controllers() -> list[Case]:
    def skin(bind: str = ONE, inverse: str = ONE) -> str:
        return (
            f'<library_controllers><controller id="c"><skin source="#g"><bind_shape_matrix>{bind}</bind_shape_matrix>'
            + list_of("J", "j", "JOINT")
            + source("b", np.fromstring(inverse, sep=" "), '<param name="TRANSFORM" type="float4x4"/>', 16)
            + source("w", [1.0], '<param name="WEIGHT" type="float"/>', 1)
            + '<joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#b"/></joints>'
            '<vertex_weights count="8"><input semantic="JOINT" source="#j" offset="0"/><input semantic="WEIGHT" '
            f'source="#w" offset="1"/><vcount>{"1 " * 8}</vcount><v>{"0 0 " * 8}</v></vertex_weights></skin>'
            "</controller></library_controllers>"
        )

    def morph(method: str, target: str, weight: float) -> bytes:
        controllers = (
            f'<library_controllers><controller id="c"><morph source="#g" method="{method}">'
            + list_of(target, "t", "MORPH_TARGET", "IDREF_array")
            + source("w", [weight], '<param name="MORPH_WEIGHT" type="float"/>', 1)
            + '<targets><input semantic="MORPH_TARGET" source="#t"/><input semantic="MORPH_WEIGHT" source="#w"/>'
            "</targets></morph></controller></library_controllers>"
        )
        geometries = geometry() + geometry("h", points=source("h-p", box() * 3))
        return document(played, geometries, controllers)

    played = '<node><instance_controller url="#c"/></node>'
    shift = "1 0 0 {} 0 1 0 0 0 0 1 0 0 0 0 1"
    joint = '<node id="root"><translate>10 0 0</translate><node sid="J"><translate>5 0 0</translate></node></node>'
    posed = '<node><instance_controller url="#c"><skeleton>#root</skeleton></instance_controller></node>'
    return [
        two("skins without their joints", document(played + MOVED, more=skin())),
        two("bind_shape_matrix", document(played + show(), more=skin(shift.format(10)))),
        two(
            "skins where their joints are",
            document(posed + joint + show(), more=skin(inverse=shift.format(-5))),
        ),
        two(
            "skins below nodes of their own",
            document(
                posed.replace("<node>", "<node><translate>77 0 0</translate>") + joint + show(),
                more=skin(inverse=shift.format(-5)),
            ),
        ),
        one("morphs, normalised", morph("NORMALIZED", "h", 0.5), 208, 192, (4, 6, 8)),
        one("morphs, relative", morph("RELATIVE", "h", 1 / 3), 208, 192, (4, 6, 8)),
        bad(
            "morph targets that are not there",
            morph("NORMALIZED", "none", 0.5),
            "'none', which is not in the file",
        ),
        bad(
            "skins without an input",
            document(posed + joint, more=skin().replace("INV_BIND_MATRIX", "X")),
            "no input INV_BIND",
        ),
        bad(
            "skins of joints that are not there",
            document(posed + joint, more=skin().replace("<v>0 0", "<v>-5 0")),
            "a joint or a weight that is not there",
        ),
        bad("controllers that are not there", document(played), "'c', which is not in the file"),
    ]


def documents() -> list[Case]:
    plain = document()
    text = plain.decode()
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as packed:
        packed.writestr("doc.dae", plain)
    later = f'<COLLADA xmlns="{NAMESPACE}" version="1.5.0">'.replace("2005/11", "2008/03")
    prefixed = (
        text.replace("<", "<c:").replace("<c:/", "</c:").replace("<c:?", "<?").replace("xmlns=", "xmlns:c=")
    )
    typed = text.replace("<COLLADA", "<!DOCTYPE COLLADA><COLLADA")
    declared = text.replace("utf-8", "{}")
    noted = text.replace("<asset>", "<asset><title>M\u00fcnze</title>")
    return [
        one("COLLADA 1.5", document(head=later)),
        one("no namespace", document(head='<COLLADA version="1.4.1">')),
        one("a namespace prefix", prefixed.encode()),
        *(
            one(f"up_axis {up}", document(asset=f"<up_axis>{up}</up_axis>"))
            for up in ("X_UP", "Y_UP", "Z_UP")
        ),
        one("no asset", plain.replace(b"<asset><up_axis>Y_UP</up_axis></asset>", b"")),
        one("units", document(asset='<unit name="inch" meter="0.0254"/>')),
        one(
            "comments and processing instructions",
            plain.replace(b"<node>", b"<!-- a --><?b c?><node><!-- d -->"),
        ),
        one("blanks and NULs around", b"\n " + plain + b"\r\n\0\0"),
        one("a byte order mark", b"\xef\xbb\xbf" + plain),
        one("UTF-16", declared.format("utf-16").encode("utf-16")),
        one("Latin-1 that calls itself UTF-8", noted.encode("latin-1")),
        one("UTF-8 that calls itself UTF-16", declared.format("utf-16").encode()),
        bad(
            "UTF-7",
            b"+ADw?xml version=+ACI-1.0+ACI- encoding=+ACI-utf-7+ACI?+AD4-" + plain[38:],
            "not COLLADA",
        ),
        bad("EBCDIC", text.encode("cp500"), "not COLLADA"),
        bad("document types", typed.encode(), "document type declaration"),
        bad(
            "document types in UTF-16",
            typed.replace("utf-8", "utf-16").encode("utf-16"),
            "document type declaration",
        ),
        bad("zipped COLLADA", archive.getvalue(), "ZIP archive; unpack it"),
        bad("an unknown up_axis", document(asset="<up_axis>W_UP</up_axis>"), "none of X_UP"),
        bad("a file that is cut off", plain[:-40], "XML is broken, or cut off"),
    ]


CASES = [*primitives(), *sources(), *scenes(), *controllers(), *documents()]
