"""glTF 2.0 and its extensions."""

from __future__ import annotations

import base64
import json
import struct
from dataclasses import replace
from typing import Any
from urllib.parse import quote

import DracoPy
import numpy as np
import numpy.typing as npt
from conformance.cases import BOX, BOX_TRIANGLES, TWO_BOXES, Case, Extents, box

_CODES = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
Json = dict[str, Any]


class File:
    """A glTF that grows: accessors into one buffer, one mesh, and what a case adds to the document."""

    def __init__(self) -> None:
        self.data = b""
        self.document: Json = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
        }
        self.further_buffers: list[Json] = []

    def view(self, content: bytes, **more: Any) -> int:
        self.data += b"\0" * (-len(self.data) % 4)
        self.document["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(content)} | more
        )
        self.data += content
        return len(self.document["bufferViews"]) - 1

    def accessor(self, values: npt.ArrayLike, kind: str = "f4", pad: int = 0, **more: Any) -> int:
        rows = np.asarray(values)
        rows = rows.reshape(len(rows), -1)
        packed = [row.astype(f"<{kind}").tobytes() + b"\0" * pad for row in rows]
        stride = {"byteStride": len(packed[0])} if pad else {}
        described = {
            "bufferView": self.view(b"".join(packed), **stride),
            "componentType": _CODES[kind],
            "count": len(rows),
            "type": _TYPES[rows.shape[1]],
        }
        self.document["accessors"].append(described | more)
        return len(self.document["accessors"]) - 1

    def primitive(
        self, points: Any = None, corners: Any = BOX_TRIANGLES, kind: str = "u2", **more: Any
    ) -> Json:
        primitive: Json = {"attributes": {"POSITION": self.accessor(box() if points is None else points)}}
        if corners is not None:
            primitive["indices"] = self.accessor(np.ravel(corners), kind)
        return primitive | more

    def mesh(self, *primitives: Json, **more: Any) -> int:
        self.document["meshes"].append({"primitives": list(primitives)} | more)
        return len(self.document["meshes"]) - 1

    def text(self, uri: str | None = None) -> bytes:
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        buffers = [{"byteLength": len(self.data), "uri": uri}, *self.further_buffers]
        return json.dumps(self.document | {"buffers": buffers}).encode()

    def binary(self, *extra: tuple[bytes, bytes], length: int | None = None) -> bytes:
        text = json.dumps(self.document | {"buffers": [{"byteLength": len(self.data)}]}).encode()
        chunks = [
            (b"JSON", text + b" " * (-len(text) % 4)),
            (b"BIN\0", self.data + b"\0" * (-len(self.data) % 4)),
        ]
        body = b"".join(
            struct.pack("<I", len(content)) + kind + content for kind, content in [*chunks, *extra]
        )
        return b"glTF" + struct.pack("<II", 2, 12 + len(body) if length is None else length) + body


def one_box(**document: Any) -> File:
    file = File()
    file.mesh(file.primitive())
    file.document.update(document)
    return file


def one(
    name: str, file: File | bytes, area: float = 52, volume: float | None = 24, size: Extents = BOX
) -> Case:
    content = file.text() if isinstance(file, File) else file
    return Case(name, "mesh.gltf", {"mesh.gltf": content}, area, volume, size, 1)


def two(name: str, file: File) -> Case:
    return Case(name, "mesh.gltf", {"mesh.gltf": file.text()}, 104, 48, TWO_BOXES, 2)


def bad(name: str, file: File | bytes, reason: str) -> Case:
    content = file.text() if isinstance(file, File) else file
    return Case(name, "mesh.gltf", {"mesh.gltf": content}, refused=reason)


def nodes(*entries: Json, roots: list[int] | None = None) -> File:
    return one_box(
        nodes=list(entries), scenes=[{"nodes": list(range(len(entries))) if roots is None else roots}]
    )


POSITIONS, EXPONENTIAL, TRIANGLES, INDICES = map(
    base64.b64decode,
    (
        "oAAAAAEAwAAAgAAAAQzMAACAf4ABDMwAAIB/gAAAAT//AAD/////////AT//AACAf4B/gH+AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA=",
        "oAABAP8AAAgDBAMAATZmAADOAAIAxVDFAAAAAAABNmYAAM4AAgh4eHgAAAAAAAE2ZgAAzgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAkQAAAJEAAACR",
        "4f4A/w8HFqECBxORBQ8G/wIEAgMAdodWZ3iphmWJaJgBaQAA",
        "0QAECAoMAggIBAoMBhIQBBIUDgQEEBIUAhYIEBYYBgoQCBYYDgAAAAA=",
    ),
)
"""The box as meshoptimizer compresses it: its corners, the same after its exponential filter, and its triangles twice."""


def with_draco(
    content: bytes, vertices: int | None = None, attribute: int = 0, mode: int = 4, name: str = "POSITION"
) -> File:
    """The box, or what else is in the content, compressed with Draco and no other way."""
    file = File()
    count = 8 if vertices is None else vertices
    told = {"bufferView": file.view(content), "attributes": {name: attribute}}
    file.document["accessors"] = [
        {"componentType": 5126, "count": count, "type": "VEC3"},
        {"componentType": 5125, "count": 36, "type": "SCALAR"},
    ]
    extensions = {"KHR_draco_mesh_compression": told}
    file.mesh({"attributes": {"POSITION": 0}, "indices": 1, "mode": mode, "extensions": extensions})
    file.document["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return file


def with_meshopt(
    points: bytes = POSITIONS,
    filter: str = "NONE",
    corners: tuple[bytes, str] = (TRIANGLES, "TRIANGLES"),
    extension: str = "EXT_meshopt_compression",
) -> File:
    """The box compressed with meshopt; the buffer that stands for what it unpacks to has no content."""
    file = File()
    file.mesh({"attributes": {"POSITION": 0}, "indices": 1})
    file.document["extensionsRequired"] = [extension]
    file.further_buffers = [{"byteLength": 168, "extensions": {extension: {"fallback": True}}}]
    places = [(0, 96, 12, 8, points, "ATTRIBUTES", filter), (96, 72, 2, 36, *corners, "NONE")]
    for offset, length, stride, count, content, mode, own in places:
        packed = file.view(content)
        told = {
            **file.document["bufferViews"][packed],
            "byteStride": stride,
            "count": count,
            "mode": mode,
            "filter": own,
        }
        file.document["bufferViews"][packed] = {
            "buffer": 1, "byteOffset": offset, "byteLength": length, "extensions": {extension: told}
        }  # fmt: skip
    file.document["accessors"] = [
        {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
    ]
    return file


MOVED = {"mesh": 0, "translation": [10, 0, 0]}


def primitives() -> list[Case]:
    cases = []
    for kind, name in (("u1", "8-bit indices"), ("u2", "16-bit indices"), ("u4", "32-bit indices")):
        file = File()
        file.mesh(file.primitive(kind=kind))
        cases.append(one(name, file))
    file = File()
    file.mesh(file.primitive(box()[BOX_TRIANGLES.ravel()], None))
    cases.append(one("triangles without indices", file))
    strip = [0, 1, 2, 3, 6, 7, 4, 5, 0, 1]
    sides = [[4, 0, 6, 2], [1, 5, 3, 7]]
    file = File()
    file.mesh(*(file.primitive(corners=run, mode=5) for run in ([strip, *sides])))
    cases.append(one("triangle strips", file))
    file = File()
    fans = [[0, 1, 3, 2, 6, 4, 5, 1], [7, 3, 1, 5, 4, 6, 2, 3]]
    file.mesh(*(file.primitive(corners=run, mode=6) for run in fans))
    cases.append(one("triangle fans", file))
    file = File()
    file.mesh(*(file.primitive(corners=part) for part in np.split(BOX_TRIANGLES, 3)))
    cases.append(one("several primitives", file))
    for mode, name in ((0, "points"), (1, "lines"), (2, "line loops"), (3, "line strips")):
        file = File()
        file.mesh(file.primitive(), file.primitive(box(50), [0, 1, 2], mode=mode))
        cases.append(one(name, file))
    file = File()
    file.mesh(file.primitive(mode=7))
    cases.append(bad("an unknown mode", file, "mode 7"))
    file = File()
    file.mesh(file.primitive(corners=[*BOX_TRIANGLES.ravel()[:-1], 8]))
    cases.append(bad("an index out of range", file, "vertex 8 .* 8 vertices"))
    file = File()
    file.mesh(file.primitive(corners=[*range(4), 65535, *range(4)], mode=5))
    cases.append(bad("primitive restart", file, "vertex 65535"))
    file = File()
    file.mesh(file.primitive(corners=BOX_TRIANGLES.ravel()[:-1]))
    cases.append(bad("triangles that are not complete", file, "35 corners.*multiple of three"))
    file = File()
    file.mesh(file.primitive())
    file.document["meshes"][0]["primitives"][0]["attributes"] = {}
    cases.append(bad("no positions", file, "no positions"))
    file = File()
    file.mesh(file.primitive())
    del file.document["meshes"][0]["primitives"]
    cases.append(bad("a part of the JSON that is not there", file, "no 'primitives' where glTF has one"))
    file = File()
    file.mesh(file.primitive())
    file.document["meshes"] = {"first": file.document["meshes"][0]}
    cases.append(bad("a part of the JSON of another kind", file, "of another kind than glTF says"))
    return cases


def accessors() -> list[Case]:
    cases = []
    for kind, top in (("i1", 127), ("u1", 255), ("i2", 32767), ("u2", 65535)):
        for normalized in (False, True):
            file = one_box(extensionsRequired=["KHR_mesh_quantization"])
            values = (box() / [2, 3, 4] * (top if normalized else 1)).round()
            pad = -3 * np.dtype(kind).itemsize % 4
            position = file.accessor(values, kind, pad, normalized=normalized)
            file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = position
            file.document["nodes"][0]["scale"] = BOX
            words = {"i1": "signed 8-bit", "u1": "8-bit", "i2": "signed 16-bit", "u2": "16-bit"}
            cases.append(one(f"{words[kind]} positions{', normalised' * normalized}", file))
    file = File()
    file.mesh(file.primitive())
    file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = file.accessor(box(), pad=20)
    cases.append(one("a stride", file))
    file = File()
    rows = np.concatenate([box(), np.full((8, 3), 7.0)], axis=1).astype("<f4")
    file.mesh(file.primitive())
    file.document["accessors"][0] |= {"bufferView": file.view(rows.tobytes(), byteStride=24)}
    cases.append(one("interleaved attributes", file))
    file = File()
    file.mesh(file.primitive())
    wrong = box()
    wrong[[2, 5]] = 9
    changes = {
        "count": 2,
        "indices": {"bufferView": file.view(np.array([2, 5], "<u2").tobytes()), "componentType": 5123},
        "values": {"bufferView": file.view(box()[[2, 5]].astype("<f4").tobytes())},
    }
    position = file.accessor(wrong, sparse=changes)
    file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = position
    cases.append(one("sparse accessors", file))
    file = File()
    file.mesh(file.primitive())
    position = file.accessor(box())
    file.document["accessors"][position]["sparse"] = {
        "count": 8,
        "indices": {"bufferView": file.view(bytes(range(8))), "componentType": 5121},
        "values": {"bufferView": file.document["accessors"][position].pop("bufferView")},
    }
    file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = position
    cases.append(one("sparse accessors of zeros", file))
    file = one_box()
    del file.document["accessors"][0]["bufferView"]
    cases.append(bad("an accessor without content", file, "accessor 0 .* no content"))
    file = one_box()
    file.document["accessors"][0]["count"] = 9
    cases.append(bad("an accessor longer than its view", file, "too short for the 9 elements"))
    file = one_box()
    file.document["accessors"][0] |= {"bufferView": 77}
    cases.append(bad("a view that is not there", file, "entry 77 of its bufferViews"))
    file = one_box()
    file.document["accessors"][0]["componentType"] = 5130
    cases.append(bad("numbers of an unknown type", file, "type 5130"))
    return cases


def containers() -> list[Case]:
    plain = one_box()
    b64 = base64.b64encode(plain.data).decode()
    head = "data:application/octet-stream"
    named = {"mesh.gltf": plain.text("my%20part%231.bin"), "my part#1.bin": plain.data}
    below = {"mesh.gltf": plain.text("parts\\box.bin"), "parts/box.bin": plain.data}

    def glb(name: str, content: bytes, refused: str | None = None) -> Case:
        return Case(name, "mesh.glb", {"mesh.glb": content}, 52, 24, BOX, 1, refused)

    data = plain.data
    plain.data = plain.data[:-8]
    cut = plain.text()
    plain.data = data
    cut = cut.replace(b'"byteLength": 160', b'"byteLength": 168')
    return [
        one("buffers in base64", plain),
        one("base64 without padding", plain.text(f"{head};base64,{b64.rstrip('=')}")),
        one("base64 with percent escapes", plain.text(f"{head};base64,{quote(b64, safe='')}")),
        one("percent-encoded buffers", plain.text(f"{head},{quote(plain.data)}")),
        Case("buffers in files", "mesh.gltf", named, 52, 24, BOX, 1),
        Case("backslashes in paths", "mesh.gltf", below, 52, 24, BOX, 1),
        one("a byte order mark", b"\xef\xbb\xbf" + plain.text()),
        glb("binary glTF", plain.binary()),
        glb("further chunks", plain.binary((b"XTRA", b"abcd"))),
        glb("binary glTF longer than its file", plain.binary(length=99999), "cut off: it announces 99,999"),
        Case("binary glTF called .gltf", "mesh.gltf", {"mesh.gltf": plain.binary()}, 52, 24, BOX, 1),
        bad("a buffer that is cut off", cut, "is cut off"),
        bad("a buffer outside the folder", plain.text("../box.bin"), "not a file in its own folder"),
        bad(
            "a buffer on a server", plain.text("https://example.org/box.bin"), "not a file in its own folder"
        ),
        bad("glTF 1.0", one_box(asset={"version": "1.0"}), r"glTF 1\.0 is not read; convert it to 2\.0"),
        bad("a later version", one_box(asset={"version": "3.0"}), r"glTF 3\.0 is not read"),
    ]


def scenes() -> list[Case]:
    turned = [0, 0, 2**-0.5, 2**-0.5]  # 90 degrees about z: 2 x 3 becomes 3 x 2
    matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1]
    chain: list[Json] = [{"children": [k + 1]} for k in range(3000)]
    loose = one_box()
    del loose.document["nodes"], loose.document["scenes"], loose.document["scene"]
    no_scene = nodes({"mesh": 0}, MOVED)
    del no_scene.document["scenes"], no_scene.document["scene"]
    first = nodes({"mesh": 0}, MOVED, roots=[0])
    first.document["scenes"].append({"nodes": [1]})
    second = nodes({"mesh": 0, "scale": [5, 5, 5]}, {"mesh": 0}, roots=[0])
    second.document["scenes"].append({"nodes": [1]})
    second.document["scene"] = 1
    del first.document["scene"]
    hidden = nodes({"mesh": 0}, MOVED | {"extensions": {"KHR_node_visibility": {"visible": False}}})
    many = nodes({"mesh": 0}, *({"mesh": 0} for _ in range(9)))
    triangles = many.primitive(corners=np.tile(BOX_TRIANGLES, (85000, 1)))
    many.document["meshes"][0]["primitives"].append(triangles)
    return [
        two("nodes moved by translation", nodes({"mesh": 0}, MOVED)),
        two("nodes moved by a matrix", nodes({"mesh": 0}, {"mesh": 0, "matrix": matrix})),
        one("rotation", nodes({"mesh": 0, "rotation": turned}), size=(3, 2, 4)),
        one("scale", nodes({"mesh": 0, "scale": [2, 2, 2]}), 208, 192, (4, 6, 8)),
        one("mirrored nodes", nodes({"mesh": 0, "scale": [-1, 1, 1]})),
        two("children", nodes({"mesh": 0, "children": [1]}, MOVED, roots=[0])),
        two("nodes with a mesh and a camera", nodes({"mesh": 0}, MOVED | {"camera": 0})),
        two("children of a camera", nodes({"mesh": 0}, {"camera": 0, "children": [2]}, MOVED, roots=[0, 1])),
        one("a chain of 3,000 nodes", nodes(*chain, {"mesh": 0}, roots=[0])),
        one("nodes outside the scene", nodes({"mesh": 0}, MOVED, roots=[0])),
        one("the default scene of several", second),
        one("the first scene if none is the default", first),
        two("no scene", no_scene),
        one("meshes without nodes", loose),
        one("hidden nodes", hidden),
        bad("a scene without triangles", nodes({}, {"mesh": 0}, roots=[0]), "shows none of its meshes"),
        bad(
            "matrices of too few numbers",
            nodes({"mesh": 0, "matrix": [1, 0, 0]}),
            "matrix of node 0 is not 16 numbers",
        ),
        bad(
            "translations without a value",
            nodes({"mesh": 0, "translation": [float("nan"), 0, 0]}),
            "else than numbers",
        ),
        bad("nodes in a circle", nodes({"children": [1]}, {"children": [0]}, roots=[0]), "root of its scene"),
        bad(
            "a node below two others",
            nodes({"children": [2]}, {"children": [2]}, {"mesh": 0}),
            "below two nodes",
        ),
        bad("a mesh that is not there", nodes({"mesh": 4}), "entry 4 of its meshes"),
        bad("a node that is not there", nodes({"children": [9]}), "entry 9 of its nodes"),
        bad("more triangles than fit", many, "10,200,120 triangles"),
    ]


def deformations() -> list[Case]:
    def morph(weights: list[float] | None, on_node: bool) -> File:
        file = File()
        primitive = file.primitive()
        primitive["targets"] = [{"POSITION": file.accessor(box())}]
        file.mesh(primitive, **({"weights": weights} if weights and not on_node else {}))
        if weights and on_node:
            file.document["nodes"][0]["weights"] = weights
        return file

    def skin(joint: Json, bind: npt.NDArray[np.float64] | None = None) -> File:
        file = File()
        primitive = file.primitive()
        primitive["attributes"] |= {
            "JOINTS_0": file.accessor(np.zeros((8, 4)), "u1"),
            "WEIGHTS_0": file.accessor(np.tile([1.0, 0, 0, 0], (8, 1))),
        }
        file.mesh(primitive)
        file.document["nodes"] = [{"mesh": 0, "skin": 0, "translation": [99, 0, 0]}, joint, {"mesh": 1}]
        file.mesh(file.primitive())
        file.document["scenes"] = [{"nodes": [0, 1, 2]}]
        file.document["skins"] = [{"joints": [1]}]
        if bind is not None:
            file.document["skins"][0]["inverseBindMatrices"] = file.accessor(bind.T.reshape(1, 16))
        return file

    shift = np.eye(4)
    shift[0, 3] = -5
    return [
        one("morph targets at rest", morph(None, False)),
        one("morph weights of a mesh", morph([1.0], False), 208, 192, (4, 6, 8)),
        one("morph weights of a node", morph([1.0], True), 208, 192, (4, 6, 8)),
        two("skins", skin({"translation": [10, 0, 0]})),
        two("inverse bind matrices", skin({"translation": [15, 0, 0]}, shift)),
    ]


def extensions() -> list[Case]:
    def instanced(attributes: dict[str, Any], **more: Any) -> File:
        file = one_box(extensionsRequired=["EXT_mesh_gpu_instancing"])
        used = {name: file.accessor(values) for name, values in attributes.items()}
        file.document["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": used}}
        return file

    def required(*names: str) -> File:
        return one_box(extensionsRequired=list(names))

    turned = [0, 0, 2**-0.5, 2**-0.5]
    beside = one_box()
    beside.document["meshes"][0]["primitives"][0]["extensions"] = {
        "KHR_draco_mesh_compression": {"bufferView": 0}
    }
    content = DracoPy.encode(
        box(), BOX_TRIANGLES.astype(np.uint32), quantization_bits=16, preserve_order=True
    )
    spare = one_box()
    spare.document["bufferViews"][0]["extensions"] = {"EXT_meshopt_compression": {"buffer": 0}}
    return [
        two("EXT_mesh_gpu_instancing", instanced({"TRANSLATION": [[0, 0, 0], [10, 0, 0]]})),
        one(
            "instances that are turned and scaled",
            instanced({"ROTATION": [turned], "SCALE": [[2, 2, 2]]}),
            208,
            192,
            (6, 4, 8),
        ),
        bad(
            "instances of unequal attributes",
            instanced({"TRANSLATION": [[0, 0, 0]] * 2, "SCALE": [[1, 1, 1]]}),
            "different lengths",
        ),
        one("KHR_materials_*", required("KHR_materials_unlit", "KHR_materials_variants")),
        one("KHR_texture_*", required("KHR_texture_transform", "KHR_texture_basisu")),
        one("KHR_lights_punctual", required("KHR_lights_punctual")),
        one("KHR_draco_mesh_compression beside plain content", beside),
        replace(one("KHR_draco_mesh_compression", with_draco(content)), precision=1e-4),
        bad("damaged content of Draco", with_draco(content[:-9]), "with Draco is damaged"),
        bad("other numbers of vertices than Draco has", with_draco(content, vertices=9), "9 elements, but"),
        bad("attributes that Draco does not have", with_draco(content, attribute=7), "no attribute 7"),
        bad(
            "positions that Draco does not have", with_draco(content, name="NORMAL"), "Draco has no positions"
        ),
        bad("strips compressed with Draco", with_draco(content, mode=5), "strips or fans compressed"),
        one("EXT_meshopt_compression with its fallback", spare),
        one("EXT_meshopt_compression", with_meshopt()),
        one("EXT_meshopt_compression of single corners", with_meshopt(corners=(INDICES, "INDICES"))),
        one("EXT_meshopt_compression with an exponential filter", with_meshopt(EXPONENTIAL, "EXPONENTIAL")),
        one("KHR_meshopt_compression", with_meshopt(extension="KHR_meshopt_compression")),
        bad(
            "damaged content of meshopt", with_meshopt(POSITIONS[:-9]), "with meshopt is damaged, cut off, or"
        ),
        bad("a later version of meshopt", with_meshopt(b"\xa1" + POSITIONS[1:]), "or of a later version"),
        bad("filters of meshopt for directions", with_meshopt(filter="OCTAHEDRAL"), "filter 'OCTAHEDRAL'"),
        bad(
            "an unknown mode of meshopt",
            with_meshopt(corners=(TRIANGLES, "STRIPS")),
            "in a way that is not read",
        ),
        bad("unknown required extensions", required("ACME_teapot"), "requires the extension ACME_teapot"),
    ]


CASES = [*primitives(), *accessors(), *containers(), *scenes(), *deformations(), *extensions()]
