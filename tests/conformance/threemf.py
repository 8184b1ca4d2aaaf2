"""3MF: the core specification, the production extension, and extensions that are not read."""

from __future__ import annotations

from io import BytesIO
from zipfile import ZIP_DEFLATED, ZipFile

from conformance.cases import BOX, BOX_TRIANGLES, TWO_BOXES, Case, box

ROOT, OTHER = "3D/3dmodel.model", "3D/Objects/part.model"
SPACE = "http://schemas.microsoft.com/3dmanufacturing/"
RELATIONSHIPS = (
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    f'<Relationship Target="/{ROOT}" Id="r" Type="{SPACE}2013/01/3dmodel"/></Relationships>'
)
MESH = (
    "<mesh><vertices>"
    + "".join(f'<vertex x="{x:g}" y="{y:g}" z="{z:g}"/>' for x, y, z in box())
    + "</vertices><triangles>"
    + "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in BOX_TRIANGLES)
    + "</triangles></mesh>"
)
MOVED = 'transform="1 0 0 0 1 0 0 0 1 10 0 0"'
ONE = f'<object id="1">{MESH}</object>'
ITEM = '<item objectid="1"/>'
FAR = f'<item objectid="1" {MOVED}/>'
PATH = f'p:path="/{OTHER}"'


def model(objects: str, build: str = "", attributes: str = "") -> str:
    return (
        f'<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" xmlns="{SPACE}core/2015/02" '
        f'xmlns:p="{SPACE}production/2015/06" xmlns:m="{SPACE}material/2015/02" xmlns:b="{SPACE}beamlattice/2017/02" '
        f'xmlns:s="{SPACE}slice/2015/07" {attributes}>'
        f"<resources>{objects}</resources><build>{build}</build></model>"
    )


def package(files: dict[str, str | bytes]) -> bytes:
    data = BytesIO()
    with ZipFile(data, "w", ZIP_DEFLATED) as archive:
        for name, content in ({"_rels/.rels": RELATIONSHIPS} | files).items():
            archive.writestr(name, content)
    return data.getvalue()


def one(objects: str = ONE, build: str = ITEM, attributes: str = "") -> dict[str, str | bytes]:
    return {ROOT: model(objects, build, attributes)}


def reads(name: str, files: dict[str, str | bytes]) -> Case:
    return Case(name, "mesh.3mf", {"mesh.3mf": package(files)}, 52, 24, BOX, 1)


def reads_two(name: str, files: dict[str, str | bytes]) -> Case:
    return Case(name, "mesh.3mf", {"mesh.3mf": package(files)}, 104, 48, TWO_BOXES, 2)


def refuses(name: str, files: dict[str, str | bytes], reason: str) -> Case:
    return Case(name, "mesh.3mf", {"mesh.3mf": package(files)}, refused=reason)


def chain(length: int, copies: int) -> str:
    """Objects, each of which has the one before it several times."""
    return ONE + "".join(
        f'<object id="{i}"><components>{f"<component objectid={chr(34)}{i - 1}{chr(34)}/>" * copies}</components></object>'
        for i in range(2, length + 2)
    )


def components(inner: str, number: int = 3) -> str:
    return f'<object id="{number}"><components>{inner}</components></object>'


TWO_COMPONENTS = components(f'<component objectid="1"/><component objectid="1" {MOVED}/>')
LATTICE = MESH.replace("</mesh>", '<b:beamlattice minlength="1"><b:beams/></b:beamlattice></mesh>')
NOTHING = '<object id="2"/>'
BOTH = ITEM + '<item objectid="2"/>'


def compressed_by(method: int) -> bytes:
    """A package that says that its files are compressed in another way than they are."""
    data = bytearray(package(one()))
    for mark, place in ((b"PK\x03\x04", 8), (b"PK\x01\x02", 10)):
        start = -1
        while (start := data.find(mark, start + 1)) >= 0:
            data[start + place] = method
    return bytes(data)


UTF16 = model(ONE, ITEM).replace("UTF-8", "UTF-16").encode("utf-16")

CASES = [
    reads("a mesh", one()),
    reads_two("items with transforms", one(build=ITEM + FAR)),
    reads_two("components with transforms", one(ONE + TWO_COMPONENTS, '<item objectid="3"/>')),
    reads("components within components", one(ONE + components('<component objectid="1"/>', 2)
          + components('<component objectid="2"/>'), '<item objectid="3"/>')),
    reads("transforms that undo each other", one(
        ONE + components('<component objectid="1" transform="0 2 0 -2 0 0 0 0 2 5 6 7"/>'),
        '<item objectid="3" transform="0 -0.5 0 0.5 0 0 0 0 0.5 -3 2.5 -3.5"/>')),
    reads("mirrored items", one(build='<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>')),
    reads("objects that are not built", one(ONE + ONE.replace('"1"', '"9"', 1))),
    reads("objects before those they are made of", one(components('<component objectid="1"/>') + ONE, '<item objectid="3"/>')),
    *(reads_two(f"objects of type {kind}", one(ONE + ONE.replace('id="1"', f'id="2" type="{kind}"'),
                ITEM + FAR.replace('objectid="1"', 'objectid="2"')))
      for kind in ("model", "support", "solidsupport", "surface", "other")),
    reads_two("items that are not to be printed", one(build=ITEM + FAR.replace("/>", ' printable="0"/>'))),
    reads("production: items in another part", {ROOT: model("", f'<item objectid="1" {PATH}/>'), OTHER: model(ONE)}),
    reads_two("production: components in another part", {
        ROOT: model(TWO_COMPONENTS.replace('objectid="1"', f'{PATH} objectid="1"'), '<item objectid="3"/>'), OTHER: model(ONE)}),
    reads("production: numbers used in two parts", {
        ROOT: model(components(f'<component {PATH} objectid="1"/>', 1), ITEM), OTHER: model(ONE)}),
    reads("production: paths in another case, escaped", {
        ROOT: model("", '<item objectid="1" p:path="/3d/objects/PART%20A.model"/>'), "3D/Objects/Part A.model": model(ONE)}),
    reads("production: parts of another unit", {
        ROOT: model("", f'<item objectid="1" {PATH} transform="10 0 0 0 10 0 0 0 10 0 0 0"/>'),
        OTHER: model(ONE).replace("millimeter", "micron").replace(MESH, "".join(
            ["<mesh><vertices>", *(f'<vertex x="{x * 100:g}" y="{y * 100:g}" z="{z * 100:g}"/>' for x, y, z in box()),
             MESH[MESH.index("</vertices>"):]]))}),
    reads("production: required", {ROOT: model(ONE, ITEM, 'requiredextensions="p m"')}),
    reads("root part of another name", {
        "_rels/.rels": RELATIONSHIPS.replace(ROOT, "geometry/main.model"), "geometry/main.model": model(ONE, ITEM)}),
    reads("pictures and settings beside the model", one() | {"Metadata/thumbnail.png": b"\x89PNG", "Metadata/a.config": b"x"}),
    reads("materials and colours", one(
        '<m:colorgroup id="5"><m:color color="#ff0000"/></m:colorgroup>' + ONE.replace("v3=", 'pid="5" p1="0" v3='))),
    reads("metadata", {ROOT: model(ONE.replace("<mesh>", '<metadatagroup><metadata name="a">b</metadata></metadatagroup><mesh>'), ITEM)}),
    reads("vertices that no triangle uses", one(ONE.replace("</vertices>", '<vertex x="99" y="9" z="9"/></vertices>'))),
    reads("slices beside a mesh", one(ONE.replace('id="1"', 'id="1" s:slicestackid="7"'))),
    reads("UTF-16", {ROOT: UTF16}),
    reads("byte order mark", {ROOT: b"\xef\xbb\xbf" + model(ONE, ITEM).encode()}),
    reads("prefixes instead of a default namespace", {ROOT: (
        f'<c:model xmlns:c="{SPACE}core/2015/02"><c:resources>'
        + ONE.replace("</", "<|").replace("<", "<c:").replace("<c:|", "</c:")
        + '</c:resources><c:build><c:item objectid="1"/></c:build></c:model>')}),
    refuses("beam lattices", one(f'<object id="1">{LATTICE}</object>'), "beamlattice"),
    refuses("beam lattices, required", one(attributes='requiredextensions="b"'), "beamlattice/2017"),
    refuses("slices, required", one(attributes='requiredextensions="p s"'), "slice/2015"),
    refuses("extensions that are not known", one(attributes='xmlns:q="urn:q" requiredextensions="q"'), "urn:q"),
    refuses("shapes of an extension", one('<object id="1"><b:booleanshape/></object>'), "booleanshape"),
    refuses("objects within themselves", one(components('<component objectid="3"/>'), '<item objectid="3"/>'), "part of itself"),
    refuses("more copies than a computer can hold", one(chain(40, 8), '<item objectid="41"/>'), "triangles"),
    reads("objects with a mesh without triangles", one(
        ONE + '<object id="2"><mesh><vertices/><triangles/></mesh></object>', BOTH)),
    refuses("objects with neither mesh nor components", one(ONE + NOTHING, BOTH), "'2' .* neither a mesh nor components"),
    refuses("two objects of one id", one(ONE + ONE), "two objects of it have the id '1'"),
    refuses("two parts of one name", {ROOT: model(ONE, ITEM), ROOT.upper(): model(ONE, ITEM)}, "twice"),
    refuses("vertices without a coordinate", one(ONE.replace(' y="0"', "", 1)), "<vertex> of it has no y"),
    refuses("decimal commas", one(ONE.replace('x="2"', 'x="2,0"', 1)), "decimal comma"),
    refuses("words among numbers", one(ONE.replace('x="2"', 'x="2_0"', 1)), "number belongs: '2_0'"),
    refuses("transforms of other than 12 numbers", one(build='<item objectid="1" transform="1 0 0 1"/>'), "4 numbers, not 12"),
    refuses("transforms without a value", one(build=FAR.replace("10", "nan")), "without a value"),
    refuses("objects that are not there", one(build='<item objectid="7"/>'), "not there"),
    refuses("parts that are not there", one(build=f'<item objectid="1" {PATH}/>'), "not in it"),
    refuses("nothing built", one(build=""), "builds nothing"),
    refuses("indices of no vertex", one(ONE.replace('v1="0"', 'v1="8"')), "vertex 8 "),
    refuses("document types", {ROOT: model(ONE, ITEM).replace("?><", "?><!DOCTYPE model><", 1)}, "document type"),
    refuses("cut off XML", {ROOT: model(ONE, ITEM)[:-40]}, "XML is broken"),
    refuses("no relationships", {"_rels/.rels": "<x/>"} | one(), "no part of it"),
    refuses("units that mean nothing", {ROOT: model(ONE, ITEM).replace("millimeter", "cubit")}, "cubit"),
    Case("compressed as Windows does large files", "mesh.3mf", {"mesh.3mf": compressed_by(9)}, refused="method 9"),
    Case("archives that are cut off", "mesh.3mf", {"mesh.3mf": package(one())[:-30]}, refused="not 3MF, or damaged"),
]  # fmt: skip
