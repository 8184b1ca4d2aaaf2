"""glTF 2.0, text and binary: its triangles, where its scene places them at rest."""

from __future__ import annotations

import binascii
import json
import re
from base64 import b64decode
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import PurePosixPath
from typing import Any
from urllib.parse import unquote, unquote_to_bytes, urlsplit

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.paint import Paint, Pictures, Wrap, from_light
from shapeviz_report.mesh.readers.draco import decode_draco
from shapeviz_report.mesh.readers.limits import check_faces, check_json, check_unpacked
from shapeviz_report.mesh.readers.meshopt import decode_meshopt
from shapeviz_report.mesh.readers.polygons import Indices, PolygonMesh, cut_fan, cut_strip
from shapeviz_report.mesh.readers.scene import Node, Part, join_parts, join_values, place_nodes
from shapeviz_report.types import FloatArray

GLTF = (".gltf", ".glb")
"""Suffixes."""

_BINARY_MAGIC = b"glTF"
_JSON_CHUNK, _BINARY_CHUNK = b"JSON", b"BIN\0"

_DRACO = "KHR_draco_mesh_compression"
_MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")
_INSTANCING = "EXT_mesh_gpu_instancing"
_VISIBILITY = "KHR_node_visibility"
_READ_EXTENSIONS = frozenset({_DRACO, *_MESHOPT, _INSTANCING, _VISIBILITY, "KHR_mesh_quantization"})
_SURFACE_UNTOUCHED = re.compile(
    r"(KHR|EXT|ADOBE|MSFT|FB)_(materials|texture|lights|packing)_\w+|KHR_animation_pointer|KHR_xmp(_json_ld)?"
    r"|KHR_techniques_webgl|KHR_audio_emitter|KHR_audio|EXT_mesh_features|EXT_instance_features"
    r"|EXT_structural_metadata|EXT_mesh_manifold|CESIUM_primitive_outline|MSFT_lod"
)
"""Extensions of looks, sound and meaning, or of other levels of detail than the one that is read."""

_COMPONENTS: dict[int, np.dtype[Any]] = {
    5120: np.dtype("<i1"),
    5121: np.dtype("<u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_TRIANGLES, _TRIANGLE_STRIP, _TRIANGLE_FAN = 4, 5, 6
_POINTS_AND_LINES = range(4)

_WRAPS: dict[Any, Wrap] = {33071: "clamp", 33648: "mirror"}

_MOVES = {"translation": np.zeros(3), "rotation": np.array([0.0, 0, 0, 1]), "scale": np.ones(3)}
"""What may move a node, and the values that do not."""
_STILL = np.eye(4)

Document = Mapping[str, Any]


def read_gltf(data: bytes, files: Mapping[str, bytes]) -> PolygonMesh:
    """Read glTF.

    Parameters
    ----------
    data : bytes
        The ``.gltf`` or binary ``.glb`` file; which of both, its first bytes tell.
    files : mapping of str to bytes
        Path below the file's folder -> content, for every file that :func:`buffer_files` names.

    Raises
    ------
    MeshError
        If it is anything else, or holds a surface that is not read.
    """
    try:
        return _Reader(read_header(data), data, files).read()
    except KeyError as error:
        raise MeshError(f"it is damaged: no {str(error.args[0])[:40]!r} where glTF has one") from error
    except (AttributeError, TypeError) as error:
        raise MeshError("it is damaged: something in its JSON is of another kind than glTF says") from error


def read_header(data: bytes) -> dict[str, Any]:
    """The JSON of a glTF. Raises ``MeshError`` if there is none, or of another version."""
    text = _split_chunks(data)[0] if data.startswith(_BINARY_MAGIC) else data
    check_json(text)
    try:
        header = json.loads(text)
    except json.JSONDecodeError as error:
        raise MeshError(f"it is not glTF, or cut off: its JSON is broken ({error})") from error
    except (ValueError, RecursionError) as error:
        raise MeshError("it is not glTF, or damaged: its JSON is broken") from error
    if not isinstance(header, dict):
        raise MeshError("it is not glTF: its JSON is not an object")
    asset = header.get("asset", {})
    version = asset.get("version", "2.0") if isinstance(asset, dict) else "2.0"
    _check_version(str(version))
    if isinstance(asset, dict) and str(asset.get("minVersion", "2.0")) != "2.0":
        _check_version(str(asset["minVersion"]), newest="2.0")
    return header


def _check_version(version: str, newest: str | None = None) -> None:
    if version.startswith("1"):
        raise MeshError("glTF 1.0 is not read; convert it to 2.0")
    if not version.startswith("2") or (newest and version != newest):
        raise MeshError(f"glTF {version[:20]} is not read; convert it to 2.0")


def _split_chunks(data: bytes) -> tuple[bytes, bytes | None]:
    """The JSON and the buffer, if there is one, of binary glTF. Chunks of other kinds may follow."""
    version = int.from_bytes(data[4:8], "little")
    if len(data) >= 8 and version != 2:
        _check_version(f"{version}.0")
    length = int.from_bytes(data[8:12], "little")
    if len(data) < 20 or length > len(data):
        raise MeshError(f"it is cut off: it announces {length:,} bytes, and has {len(data):,}")
    chunks: list[tuple[bytes, bytes]] = []
    start = 12
    while start + 8 <= length:
        size, kind = int.from_bytes(data[start : start + 4], "little"), data[start + 4 : start + 8]
        start += 8
        if start + size > length:
            raise MeshError(f"it is damaged: a chunk of {size:,} bytes does not fit into it")
        chunks.append((kind, data[start : start + size]))
        start += size
    if not chunks or chunks[0][0] != _JSON_CHUNK:
        raise MeshError("it is damaged: it does not begin with its JSON")
    return chunks[0][1], next((content for kind, content in chunks if kind == _BINARY_CHUNK), None)


def buffer_files(header: Document) -> dict[str, str]:
    """The files that hold a glTF's geometry: URI, as it is written -> path below the file's folder. Embedded buffers
    need none.

    Raises
    ------
    MeshError
        If a buffer is not a file in the folder or below it. Nothing is ever fetched, and nothing outside the
        folder is opened, whatever a file asks for.
    """
    files = {}
    for buffer in header.get("buffers", []):
        uri = buffer.get("uri")
        if uri is None or _is_data(uri):
            continue
        path = PurePosixPath(unquote(uri).replace("\\", "/"))
        if urlsplit(uri).scheme or urlsplit(uri).netloc or path.is_absolute() or ".." in path.parts:
            raise MeshError(f"it refers to {uri[:100]!r}, which is not a file in its own folder")
        files[uri] = path.as_posix()
    return files


def list_buffers(data: bytes) -> list[str]:
    """The paths of :func:`buffer_files` for a glTF that is not empty. Raises ``MeshError``, also for one that does not
    list them as it should."""
    try:
        return list(buffer_files(read_header(data)).values())
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise MeshError("it is not glTF, or damaged: its buffers are not listed as they should be") from error


def list_pictures(data: bytes) -> list[str]:
    """The paths, below the file's folder, of the pictures of a glTF; none of what does not list them as it should."""
    if b'"images"' not in data:
        return []
    try:
        images = [image.get("uri") for image in read_header(data).get("images", [])]
        return [_picture_name(uri) for uri in images if isinstance(uri, str) and not _is_data(uri)]
    except (MeshError, AttributeError, TypeError, ValueError):
        return []


def _picture_name(uri: str) -> str:
    return unquote(uri).replace("\\", "/")


def _may_have_color(primitive: Document) -> bool:
    return "material" in primitive or "COLOR_0" in primitive["attributes"]


def _is_data(uri: str) -> bool:
    return uri[:5].lower() == "data:"


def _embedded(uri: str) -> bytes:
    """The content of a ``data:`` URI: base64, with or without its padding, or percent-encoded."""
    head, _, body = uri.partition(",")
    content = unquote_to_bytes(body)
    if not head.lower().rstrip().endswith(";base64"):
        return content
    content = b"".join(content.split()).translate(bytes.maketrans(b"-_", b"+/")).rstrip(b"=")
    try:
        return b64decode(content + b"=" * (-len(content) % 4), validate=True)
    except binascii.Error as error:
        raise MeshError("it is damaged: an embedded buffer is not base64") from error


class _Reader:
    """One file's document and buffers."""

    def __init__(self, document: Document, data: bytes, files: Mapping[str, bytes]) -> None:
        self.document = document
        names = buffer_files(document)
        binary = _split_chunks(data)[1] if data.startswith(_BINARY_MAGIC) else None
        self.buffers: list[bytes | None] = []
        for number, buffer in enumerate(document.get("buffers", [])):
            uri = buffer.get("uri")
            if uri is None:
                content = binary if number == 0 else None
            else:
                content = _embedded(uri) if _is_data(uri) else files[names[uri]]
            if content is not None and len(content) < _whole(buffer["byteLength"]):
                raise MeshError(
                    f"buffer {number} is cut off: it announces {_whole(buffer['byteLength']):,} bytes, and has "
                    f"{len(content):,}"
                )
            self.buffers.append(content)
        self.files = files
        self.sources: list[tuple[Document, Indices]] = []
        """The primitive of every part, and which rows of its attributes its vertices are."""
        self.pictures = Pictures()
        self.unpacked: dict[int, npt.NDArray[np.generic]] = {}
        """The elements of accessors that were compressed with Draco."""
        self.views: dict[int, bytes] = {}
        """The content of buffer views that were compressed with meshopt."""

    def read(self) -> PolygonMesh:
        for extension in self.document.get("extensionsRequired", []):
            if extension not in _READ_EXTENSIONS and not _SURFACE_UNTOUCHED.fullmatch(extension):
                raise MeshError(
                    f"it requires the extension {extension[:60]}, which is not read; export it without"
                )
        meshes = self.document.get("meshes", [])
        self.triangles = [sum(map(self.count_triangles, mesh["primitives"])) for mesh in meshes]
        if "nodes" not in self.document:
            check_faces(sum(self.triangles))
            parts = [part for mesh in meshes for part in self.read_mesh(mesh, [], np.eye(4)[None])]
        else:
            parts = self.read_scene()
        vertices, faces = join_parts(parts)
        looks = [primitive for primitive, _ in self.sources if _may_have_color(primitive)]
        return replace(
            PolygonMesh.of_triangles(vertices, faces, up="y"),
            paint=partial(self.paint, parts, faces.ravel()) if looks else None,
        )

    # scene

    def read_scene(self) -> list[Part]:
        numbers = range(len(self.document["nodes"]))
        parents: dict[int, int] = {}
        for number in numbers:
            for child in self.entry("nodes", number).get("children", []):
                self.entry("nodes", child)
                if child in parents:
                    raise MeshError(
                        f"node {child} stands below two nodes, or twice below one; glTF nodes form trees"
                    )
                parents[child] = number
        roots = [number for number in numbers if number not in parents]
        shown = roots
        if self.document.get("scenes"):
            shown = self.entry("scenes", self.document.get("scene", 0)).get("nodes", [])
        for root in shown:
            self.entry("nodes", root)
            if root in parents:
                raise MeshError(f"node {root} is a root of its scene, and stands below node {parents[root]}")
        if len(set(shown)) < len(shown):
            raise MeshError("a node is a root of its scene twice")
        nodes = {number: self.read_node(number) for number in numbers}
        placed = place_nodes(nodes, shown)
        if not placed and any(self.triangles):
            raise MeshError("its scene shows none of its meshes' triangles")
        groups: dict[tuple[int, tuple[float, ...], int | None], list[FloatArray]] = {}
        for number, transforms in placed.items():
            node = self.document["nodes"][number]
            mesh = self.entry("meshes", node["mesh"])
            weights = tuple(node.get("weights", mesh.get("weights", [])))
            if node.get("skin") is None:
                transforms = transforms[:, None] @ self.instances(node)
            elif self.instances_of(node):
                raise MeshError(f"node {number} has both a skin and {_INSTANCING}, which is not read")
            group = groups.setdefault((node["mesh"], weights, node.get("skin")), [])
            group.append(transforms.reshape(-1, 4, 4))
        parts = []
        for (mesh_number, weights, skin), stacks in groups.items():
            mesh = self.document["meshes"][mesh_number]
            poses = None if skin is None else self.read_poses(skin, parents, nodes)
            parts += self.read_mesh(mesh, weights, np.concatenate(stacks), poses)
        return parts

    def read_node(self, number: int) -> Node[int]:
        node = self.entry("nodes", number)
        if node.get("extensions", {}).get(_VISIBILITY, {}).get("visible") is False:
            return Node(np.eye(4), (), 0)
        count = 0
        if node.get("mesh") is not None:
            self.entry("meshes", node["mesh"])
            count = self.triangles[node["mesh"]] * self.count_instances(node)
        transform = _STILL
        if node.get("matrix") is not None:
            transform = _move(node, number, "matrix", _STILL.ravel()).reshape(4, 4).T
        elif not _MOVES.keys().isdisjoint(node):
            transform = _compose(*(_move(node, number, *each)[None] for each in _MOVES.items()))[0]
        return Node(transform, node.get("children", ()), count)

    def instances_of(self, node: Document) -> dict[str, int]:
        """Attribute -> accessor."""
        return dict(node.get("extensions", {}).get(_INSTANCING, {}).get("attributes", {}))

    def count_instances(self, node: Document) -> int:
        used = self.instances_of(node).values()
        counts = {_whole(self.entry("accessors", accessor)["count"]) for accessor in used}
        if len(counts) > 1:
            raise MeshError(f"the attributes of its {_INSTANCING} have different lengths")
        return counts.pop() if counts else 1

    def instances(self, node: Document) -> FloatArray:
        """(k, 4, 4), one a copy that the node itself places."""
        accessors = self.instances_of(node)
        count = self.count_instances(node)
        rows = np.arange(count)
        return _compose(
            *(
                self.values(accessors[name.upper()], rows, len(neutral))
                if name.upper() in accessors
                else np.broadcast_to(neutral, (count, len(neutral)))
                for name, neutral in _MOVES.items()
            )
        )

    def read_poses(self, skin: int, parents: Mapping[int, int], nodes: Mapping[int, Node[int]]) -> FloatArray:
        """(j, 4, 4): from where a skin was bound to where each of its joints is at rest."""
        document = self.entry("skins", skin)
        poses = []
        for joint in document["joints"]:
            self.entry("nodes", joint)
            pose, above, steps = np.eye(4), joint, 0
            while above is not None:
                pose, above, steps = nodes[above].transform @ pose, parents.get(above), steps + 1
                if steps > len(nodes):
                    raise MeshError("a node contains itself")
            poses.append(pose)
        stacked = np.array(poses).reshape(-1, 4, 4)
        if document.get("inverseBindMatrices") is None:
            return stacked
        inverse = self.values(document["inverseBindMatrices"], np.arange(len(poses)), 16)
        return stacked @ inverse.reshape(-1, 4, 4).transpose(0, 2, 1)

    # meshes

    def count_triangles(self, primitive: Document) -> int:
        """What a primitive declares. Raises ``MeshError`` if that is nothing whole."""
        mode = primitive.get("mode", _TRIANGLES)
        if mode in _POINTS_AND_LINES:
            return 0
        if mode not in (_TRIANGLES, _TRIANGLE_STRIP, _TRIANGLE_FAN):
            raise MeshError(f"a primitive has the mode {mode}, which glTF does not know")
        if "POSITION" not in primitive["attributes"]:
            raise MeshError("a primitive has no positions")
        corners = primitive.get("indices", primitive["attributes"]["POSITION"])
        count = _whole(self.entry("accessors", corners)["count"])
        if mode != _TRIANGLES:
            return max(count - 2, 0)
        if count % 3:
            raise MeshError(f"a primitive of triangles has {count} corners, which is no multiple of three")
        return count // 3

    def unpack_primitive(self, primitive: Document) -> None:
        """Decompress the accessors of a primitive that has no content but with Draco."""
        told = primitive["extensions"][_DRACO]
        if primitive.get("mode", _TRIANGLES) != _TRIANGLES:
            raise MeshError(
                "it has strips or fans compressed with Draco, which are not read; export it without"
            )
        corners, attributes = decode_draco(self.region(self.entry("bufferViews", told["bufferView"])))
        if primitive.get("indices") is None:
            raise MeshError("what it has compressed with Draco has no accessor for its corners")
        self.unpacked[primitive["indices"]] = corners
        packed = told.get("attributes", {})
        if "POSITION" not in packed:
            raise MeshError("what it has compressed with Draco has no positions")
        for name, identity in packed.items():
            if identity not in attributes:
                raise MeshError(f"what it has compressed with Draco has no attribute {identity!r:.20}")
            if name in primitive["attributes"]:
                self.unpacked[primitive["attributes"][name]] = attributes[identity]

    def unpack_view(self, number: int, view: Document) -> bytes | None:
        """What a buffer view has compressed with meshopt; None if it has nothing."""
        if number not in self.views:
            told = next(
                (view["extensions"][name] for name in _MESHOPT if name in view.get("extensions", {})), None
            )
            if told is None:
                return None
            count, stride = _whole(told["count"]), _whole(told["byteStride"])
            check_unpacked(count * stride + sum(map(len, self.views.values())))
            mode, filter = str(told["mode"]), str(told.get("filter", "NONE"))
            self.views[number] = decode_meshopt(self.region(told), count, stride, mode, filter)
        return self.views[number]

    def read_mesh(
        self,
        mesh: Document,
        weights: Sequence[float],
        transforms: FloatArray,
        poses: FloatArray | None = None,
    ) -> list[Part]:
        return [
            self.read_primitive(primitive, weights, transforms, poses)
            for primitive in mesh["primitives"]
            if self.count_triangles(primitive)
        ]

    def read_primitive(
        self,
        primitive: Document,
        weights: Sequence[float],
        transforms: FloatArray,
        poses: FloatArray | None,
    ) -> Part:
        attributes = primitive["attributes"]
        accessor = self.entry("accessors", attributes["POSITION"])
        for used in (attributes["POSITION"], primitive.get("indices")):
            described = None if used is None else self.entry("accessors", used)
            if (
                described is None
                or "bufferView" in described
                or "sparse" in described
                or used in self.unpacked
            ):
                continue
            if _DRACO not in primitive.get("extensions", {}):
                raise MeshError(f"accessor {used} of a primitive has no content")
            self.unpack_primitive(primitive)
        count = _whole(accessor["count"])
        corners = (
            np.arange(count) if primitive.get("indices") is None else self.read_indices(primitive["indices"])
        )
        if len(corners) and corners.max() >= count:
            raise MeshError(
                f"a face refers to vertex {corners.max()} (counted from 0), but there are {count} vertices"
            )
        rows, corners = _used_rows(corners, count)
        self.sources.append((primitive, rows))
        faces = _cut_triangles(corners, primitive.get("mode", _TRIANGLES))
        points = self.values(attributes["POSITION"], rows, 3)
        for weight, target in zip(weights, primitive.get("targets", [])):
            if weight and "POSITION" in target:
                points = points + weight * self.values(target["POSITION"], rows, 3)
        if poses is not None and "JOINTS_0" in attributes:
            points, mirrored = self.bend(attributes, rows, points, poses)
            own = np.eye(4)[None].repeat(len(transforms), axis=0)
            return Part(points, faces[:, ::-1] if mirrored else faces, own)
        return Part(points, faces, transforms)

    def bend(
        self, attributes: Mapping[str, int], rows: Indices, points: FloatArray, poses: FloatArray
    ) -> tuple[FloatArray, bool]:
        """Skinned points, and whether the skin mirrors them."""
        sets = [name.removeprefix("JOINTS_") for name in sorted(attributes) if name.startswith("JOINTS_")]
        joints = np.concatenate([self.values(attributes[f"JOINTS_{n}"], rows, 4) for n in sets], axis=1)
        shares = np.concatenate([self.values(attributes[f"WEIGHTS_{n}"], rows, 4) for n in sets], axis=1)
        joints = joints.astype(np.int64)
        joints[shares == 0] = 0
        if joints.max(initial=0) >= len(poses):
            raise MeshError(f"a vertex refers to joint {joints.max()}, but there are {len(poses)} joints")
        total = shares.sum(axis=1, keepdims=True)
        shares[total[:, 0] == 0, 0] = 1
        shares /= shares.sum(axis=1, keepdims=True)
        moved = np.zeros_like(points)
        for joint, share in zip(joints.T, shares.T):
            pose = poses[joint]
            moved += share[:, None] * (np.einsum("nij,nj->ni", pose[:, :3, :3], points) + pose[:, :3, 3])
        signs = np.linalg.det(poses[:, :3, :3])
        return moved, bool((shares * signs[joints]).sum() < 0)

    def read_indices(self, number: int) -> Indices:
        accessor = self.entry("accessors", number)
        if _COMPONENTS.get(accessor["componentType"], np.dtype("f4")).kind != "u":
            raise MeshError("the indices of a primitive are no unsigned whole numbers")
        return self.values(number, np.arange(_whole(accessor["count"])), 1)[:, 0].astype(np.int64)

    # colours

    def paint(self, parts: Sequence[Part], corners: Indices) -> Paint:
        """The colours of the corners, which are vertices of the joined parts."""
        looks = [self.read_looks(primitive, rows) for primitive, rows in self.sources]
        colors, places, pictures = (
            join_values(parts, [one[column] for one in looks])[corners] for column in range(3)
        )
        lost = tuple(self.pictures.lost)
        if not self.pictures.images:
            return Paint(colors, lost=lost)
        return Paint(colors, places, pictures, tuple(self.pictures.images), lost)

    def read_looks(self, primitive: Document, rows: Indices) -> tuple[npt.NDArray[Any], ...]:
        """Colour (k, 3), place in a picture (k, 2) and picture (k,) of a primitive's vertices (3.9.2)."""
        material = self.entry("materials", primitive["material"]) if "material" in primitive else {}
        base = material.get("pbrMetallicRoughness", {})
        factor, texture = base.get("baseColorFactor", [1, 1, 1]), base.get("baseColorTexture")
        older = material.get("extensions", {}).get("KHR_materials_pbrSpecularGlossiness")
        if older is not None:
            factor, texture = older.get("diffuseFactor", [1, 1, 1]), older.get("diffuseTexture")
        light = np.broadcast_to(np.array(factor[:3], np.float64), (len(rows), 3))
        attributes = primitive["attributes"]
        if "COLOR_0" in attributes:
            accessor = self.entry("accessors", attributes["COLOR_0"])
            values = self.values(attributes["COLOR_0"], rows, _WIDTHS.get(accessor["type"], 0))[:, :3]
            kind = _component(accessor)
            unscaled = kind.kind == "u" and not accessor.get("normalized")
            light = light * (values / np.iinfo(kind).max if unscaled else values)
        picture, places = -1, np.zeros((len(rows), 2))
        if texture is not None:
            picture = self.find_picture(texture["index"])
            moved = texture.get("extensions", {}).get("KHR_texture_transform", {})
            name = f"TEXCOORD_{moved.get('texCoord', texture.get('texCoord', 0))}"
            if name in attributes:
                turn = moved.get("rotation", 0.0)
                turned = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
                scaled = self.values(attributes[name], rows, 2) * np.array(moved.get("scale", [1, 1]))
                places = scaled @ turned.T + np.array(moved.get("offset", [0, 0]))
            elif picture >= 0:
                self.pictures.miss_places(self.picture_name(texture["index"]))
                picture = -1
        return from_light(light), places.astype(np.float32), np.full(len(rows), picture, np.int16)

    def find_picture(self, texture: int) -> int:
        """The place of a texture's picture among those of the surface; -1 if it cannot be used."""
        number, sampler = self.image_of(texture), self.entry("textures", texture).get("sampler")
        told = {} if sampler is None else self.entry("samplers", sampler)
        across: Wrap = _WRAPS.get(told.get("wrapS"), "repeat")
        down: Wrap = _WRAPS.get(told.get("wrapT"), "repeat")
        name, read = self.picture_name(texture), partial(self.read_image, number)
        return self.pictures.place(number, name, read, (across, down))

    def image_of(self, texture: int) -> int | None:
        """The number of a texture's image; None if it is only there in a way that is not read."""
        described = self.entry("textures", texture)
        instead = described.get("extensions", {}).get("EXT_texture_webp", {})
        number: int | None = described.get("source", instead.get("source"))
        return number

    def picture_name(self, texture: int) -> str:
        """What to call a texture's picture."""
        number = self.image_of(texture)
        if number is None:
            return f"texture {texture}"
        image = self.entry("images", number)
        uri = image.get("uri", "data:")
        return str(image.get("name") or f"picture {number}") if _is_data(uri) else _picture_name(uri)

    def read_image(self, number: int | None) -> bytes | None:
        if number is None:
            return b""
        image = self.entry("images", number)
        uri = image.get("uri")
        if uri is None:
            return self.region(self.entry("bufferViews", image["bufferView"]))
        return _embedded(uri) if _is_data(uri) else self.files.get(_picture_name(uri))

    # accessors

    def values(self, number: int, rows: Indices, width: int) -> FloatArray:
        """Rows (k, width) of an accessor as float64, only those: what a small file announces may be large."""
        accessor = self.entry("accessors", number)
        if _WIDTHS.get(accessor["type"]) != width:
            raise MeshError(
                f"accessor {number} has elements of type {accessor['type']}, which do not belong there"
            )
        kind, count = _component(accessor), _whole(accessor["count"])
        if len(rows) and rows.max() >= count:
            raise MeshError(f"accessor {number} has {count} elements, fewer than are asked of it")
        if number in self.unpacked:
            elements = self.unpacked[number]
            if elements.shape != (count, width):
                raise MeshError(
                    f"accessor {number} has {count:,} elements, but {len(elements):,} compressed with Draco"
                )
            stored = elements[rows]
        elif accessor.get("bufferView") is None:
            stored = np.zeros((len(rows), width), kind)
        else:
            stored = self.view(accessor, count, kind, width)[rows]
        sparse = accessor.get("sparse")
        if sparse:
            changes = _whole(sparse["count"])
            where = self.view(sparse["indices"], changes, _component(sparse["indices"]), 1)[:, 0].astype(
                np.int64
            )
            if (np.diff(where) <= 0).any() or (len(where) and where[-1] >= count):
                raise MeshError(f"the sparse indices of accessor {number} do not rise, or lead past its end")
            instead = self.view(sparse["values"], changes, kind, width)
            place = np.searchsorted(where, rows)
            hit = place < changes
            hit[hit] = where[place[hit]] == rows[hit]
            stored[hit] = instead[place[hit]]
        values = stored.astype(np.float64)
        if accessor.get("normalized") and kind.kind != "f":
            values = np.maximum(values / np.iinfo(kind).max, -1)
        return values

    def region(self, view: Document) -> bytes:
        """All that stands in a part of a buffer."""
        self.entry("buffers", view["buffer"])
        content = self.buffers[view["buffer"]]
        if content is None:
            raise MeshError(f"buffer {view['buffer']} has no content")
        start, length = _whole(view.get("byteOffset", 0)), _whole(view["byteLength"])
        if start + length > len(content):
            raise MeshError(
                f"a compressed part leads past the end of buffer {view['buffer']}; it may be cut off"
            )
        return content[start : start + length]

    def view(self, described: Document, count: int, kind: np.dtype[Any], width: int) -> npt.NDArray[Any]:
        """What stands in a buffer, not copied, as (count, width)."""
        number = described["bufferView"]
        view = self.entry("bufferViews", number)
        buffer_number = view["buffer"]
        self.entry("buffers", buffer_number)
        content = self.buffers[buffer_number]
        size = width * kind.itemsize
        stride = _whole(view.get("byteStride") or size)
        start, length = _whole(view.get("byteOffset", 0)), _whole(view["byteLength"])
        if content is None:
            content, start = self.unpack_view(number, view), 0
        if content is None:
            raise MeshError(f"buffer {buffer_number} has no content")
        offset = _whole(described.get("byteOffset", 0))
        if stride < size:
            raise MeshError(f"buffer view {number} has elements that overlap")
        if start + length > len(content):
            raise MeshError(f"buffer view {number} leads past the end of its buffer; it may be cut off")
        if count and offset + stride * (count - 1) + size > length:
            raise MeshError(
                f"buffer view {number} is too short for the {count:,} elements that it shall hold"
            )
        return np.ndarray(
            (count, width), kind, content, start + offset if count else 0, (stride, kind.itemsize)
        )

    def entry(self, kind: str, number: int) -> Document:
        """One of the document's lists' entries. Raises ``MeshError`` if there is none of that number."""
        entries = self.document.get(kind, [])
        if not isinstance(number, int) or not 0 <= number < len(entries):
            raise MeshError(f"it refers to entry {number!r:.20} of its {kind}, but has {len(entries)}")
        entry: Document = entries[number]
        return entry


def _whole(number: Any) -> int:
    """A count or an offset. Raises ``MeshError`` if it is none."""
    if (
        isinstance(number, bool)
        or not isinstance(number, int | float)
        or not 0 <= number < 2**53
        or number % 1
    ):
        raise MeshError(f"it is damaged: a length or a place is {number!r:.40}")
    return int(number)


def _move(node: Document, number: int, name: str, neutral: FloatArray) -> FloatArray:
    """The numbers of a node's matrix, translation, rotation or scale. Raises ``MeshError`` if they are none."""
    given = node.get(name)
    if given is None:
        return neutral
    if not isinstance(given, list) or len(given) != len(neutral):
        raise MeshError(f"the {name} of node {number} is not {len(neutral)} numbers")
    if not all(isinstance(value, int | float) and abs(value) < np.inf for value in given):
        raise MeshError(f"the {name} of node {number} has something else than numbers")
    return np.array(given, np.float64)


def _component(described: Document) -> np.dtype[Any]:
    kind = described["componentType"]
    if kind not in _COMPONENTS:
        raise MeshError(f"it has numbers of the type {kind!r:.20}, which glTF does not know")
    return _COMPONENTS[kind]


def _used_rows(corners: Indices, count: int) -> tuple[Indices, Indices]:
    """Which of ``count`` rows are used, rising, and the place of each corner among them."""
    if count > 8 * len(corners):  # a small file may announce any number
        rows, places = np.unique(corners, return_inverse=True)
        return rows, places
    used = np.zeros(count, bool)
    used[corners] = True
    return np.flatnonzero(used), (np.cumsum(used) - 1)[corners]


def _cut_triangles(corners: Indices, mode: int) -> Indices:
    """(m, 3) triangles of a list, a strip or a fan of corners (specification, 3.7.2.1)."""
    if mode == _TRIANGLES:
        return corners.reshape(-1, 3)
    return cut_fan(corners) if mode == _TRIANGLE_FAN else cut_strip(corners)


def _compose(translations: FloatArray, quaternions: FloatArray, scales: FloatArray) -> FloatArray:
    """(k, 4, 4) matrices that scale, then rotate, then move. Quaternions (x, y, z, w) need not be of length 1."""
    lengths = np.linalg.norm(quaternions, axis=1, keepdims=True)
    x, y, z, w = np.where(lengths > 0, quaternions / np.where(lengths > 0, lengths, 1), [0, 0, 0, 1]).T
    rotations = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    ).transpose(2, 0, 1)
    matrices = np.broadcast_to(np.eye(4), (len(rotations), 4, 4)).copy()
    matrices[:, :3, :3] = rotations * scales[:, None, :]
    matrices[:, :3, 3] = translations
    return matrices
