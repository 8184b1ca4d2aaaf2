"""COLLADA 1.4 and 1.5: its triangles and polygons, where its scene places them at rest, and the colours of its
materials or corners."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice
from urllib.parse import unquote

import numpy as np
import numpy.typing as npt
from lxml import etree

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.paint import Bytes, Paint, Pictures, Wrap, as_bytes
from shapeviz_report.mesh.readers.limits import check_faces
from shapeviz_report.mesh.readers.polygons import (
    Indices,
    PolygonMesh,
    check_indices,
    cut_corners,
    cut_fan,
    cut_strip,
    cut_with_holes,
)
from shapeviz_report.mesh.readers.scene import Node, Part, join_corners, join_parts, place_nodes
from shapeviz_report.mesh.readers.text import parse_indices, parse_numbers
from shapeviz_report.types import FloatArray, UpAxis

Element = etree._Element

_UP_AXES: dict[str, UpAxis] = {"X_UP": "x", "Y_UP": "y", "Z_UP": "z"}
_FIRST_BYTES = {
    b"\xff\xfe\0\0": "utf-32",
    b"\0\0\xfe\xff": "utf-32",
    b"\xff\xfe": "utf-16",
    b"\xfe\xff": "utf-16",
    b"<\0": "utf-16-le",
    b"\0<": "utf-16-be",
}
_BLANKS = b" \t\r\n\0\x1a"
_FACES = frozenset({"triangles", "polylist", "polygons", "tristrips", "trifans"})


_WRAPS: dict[str, Wrap] = {"MIRROR": "mirror", "CLAMP": "clamp", "BORDER": "clamp", "NONE": "clamp"}
_IMAGE = re.compile(rb"<(?:[\w.-]+:)?(?:init_from|ref)(?:\s[^<>]*)?>([^<>]+)<")


@dataclass(frozen=True)
class _Cut:
    """A primitive cut into triangles.

    Attributes
    ----------
    primitive : Element
    table : (k, width) int64 array
        The indices of all its corners.
    places : (m, 3) int64 array
        The corners of its triangles: rows of the table.
    """

    primitive: Element
    table: Indices
    places: Indices


@dataclass(frozen=True)
class _Look:
    """How a material looks: its colour in sRGB; or its picture (its place among those of the surface, -1 for none, and
    its name) and the number of the set of its texture coordinates."""

    color: tuple[int, ...] = (255, 255, 255)
    picture: int = -1
    name: str = ""
    coordinates: str = ""


def read_collada(data: bytes, files: Mapping[str, bytes]) -> PolygonMesh:
    """Read COLLADA.

    Parameters
    ----------
    data : bytes
    files : mapping of str to bytes
        By the names that :func:`list_images` gives: those of its pictures that were found.

    Raises
    ------
    MeshError
        If it is anything else, or holds a surface that is not read.
    """
    reader = _Reader(_parse(data), files)
    up = reader.up_axis()
    mesh = PolygonMesh.of_triangles(*join_parts(reader.place_geometries()), up=up)
    return replace(mesh, paint=partial(_paint, data, files) if reader.is_painted() else None)


def _paint(data: bytes, files: Mapping[str, bytes]) -> Paint:
    """The colours of all corners. The document is read once more: kept until now, it would take more memory than the
    surface."""
    reader = _Reader(_parse(data), files)
    return reader.paint(list(reader.place_geometries()))


def list_images(data: bytes) -> Iterator[str]:
    """The files of pictures that a COLLADA may name, one after the other: there may be very many."""
    return (
        _image_name(html.unescape(match[1].decode("utf-8", "replace"))) for match in _IMAGE.finditer(data)
    )


def _image_name(uri: str) -> str:
    return unquote(uri.strip()).removeprefix("file://").replace("\\", "/")


def _parse(data: bytes) -> Element:
    """The root element, all names without their namespaces.

    Whatever encoding is declared, the parser meets UTF-8: all that matters here is ASCII, names apart, and so there is
    no encoding in which a declaration could pass that is not allowed.
    """
    text = _in_utf8(data).strip(_BLANKS)
    if not text.startswith(b"<") or b"COLLADA" not in text:
        raise MeshError("it is not COLLADA")
    if b"<!DOCTYPE" in text:
        raise MeshError("it has a document type declaration, which COLLADA does not use")
    parser = etree.XMLParser(
        encoding="utf-8",
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        huge_tree=True,  # arrays of more than 10 MB are common; without a document type nothing can expand
        remove_comments=True,
        remove_pis=True,
    )
    try:
        root = etree.fromstring(text, parser)
    except etree.XMLSyntaxError as error:
        # whole, and deeper or longer than the parser goes
        if getattr(error, "code", None) == etree.ErrorTypes.ERR_RESOURCE_LIMIT:
            raise MeshError(f"its XML goes beyond what is read: {error.msg.partition(',')[0]}") from error
        raise MeshError(f"its XML is broken, or cut off ({error.msg})") from error
    for element in root.iter(etree.Element):
        element.tag = etree.QName(element).localname
    if root.tag != "COLLADA":
        raise MeshError(f"it is not COLLADA: its root is <{root.tag[:40]}>")
    return root


def _in_utf8(data: bytes) -> bytes:
    """By what its first bytes tell. What is not UTF-8 then is taken for Latin-1, of which only names can be wrong."""
    for start, encoding in _FIRST_BYTES.items():
        if data.startswith(start):
            return data.decode(encoding, "replace").encode()
    data = data.removeprefix(b"\xef\xbb\xbf")
    try:
        data.decode()
        return data
    except UnicodeDecodeError:
        return data.decode("latin-1").encode()


class _Reader:
    """One document."""

    def __init__(self, root: Element, files: Mapping[str, bytes]) -> None:
        self.root = root
        self.files = files
        self.sources: list[tuple[Element | None, list[_Cut], bool]] = []
        """Of every part: what shows it, its triangles, and whether they were turned round."""
        self.pictures = Pictures()
        self.known: dict[Element, FloatArray] = {}
        """What was read of sources that primitives share."""
        self.by_id: dict[tuple[str, str], list[Element]] = {}
        for element in root.iter(etree.Element):
            if (name := element.get("id")) is not None:
                self.by_id.setdefault((element.tag, name), []).append(element)

    def up_axis(self) -> UpAxis:
        up = _UP_AXES.get((self.root.findtext("asset/up_axis") or "Y_UP").strip())
        if up is None:
            raise MeshError("its up_axis is none of X_UP, Y_UP and Z_UP")
        return up

    def is_painted(self) -> bool:
        """Whether anything of it may say something of colours."""
        return next(self.root.iter("effect"), None) is not None or any(
            element.get("semantic") == "COLOR" for element in self.root.iter("input")
        )

    # scene

    def place_geometries(self) -> Iterator[Part]:
        instance = self.root.find("scene/instance_visual_scene")
        if instance is not None:
            scene = self.target(instance, "visual_scene")
        else:
            found = self.root.find("library_visual_scenes/visual_scene")
            if found is None:
                geometries = self.root.findall("library_geometries/geometry")
                check_faces(sum(map(self.count_triangles, geometries)))
                for geometry in geometries:
                    yield self.part(None, geometry, np.eye(4)[None])
                return
            scene = found
        nodes: dict[Hashable, Node[Hashable]] = {}
        waiting = [scene]
        while waiting:
            element = waiting.pop()
            if element in nodes:
                continue
            children: list[Hashable] = []
            for child in element:
                if child.tag == "node":
                    children.append(child)
                    waiting.append(child)
                elif child.tag == "instance_node":
                    target = self.target(child, "node")
                    children.append(target)
                    waiting.append(target)
                elif child.tag in ("instance_geometry", "instance_controller"):
                    children.append(child)
                    nodes[child] = Node(np.eye(4), (), self.count_triangles(self.shape_of(child)))
            nodes[element] = Node(_transform(element), children, 0)
        placed = place_nodes(nodes, [scene])
        if not placed and self.root.find("library_geometries/geometry") is not None:
            raise MeshError("its scene shows none of its geometries' triangles")
        for key, transforms in placed.items():
            assert isinstance(key, Element)
            if key.tag == "instance_geometry":
                yield self.part(key, self.shape_of(key), transforms)
            else:
                yield self.skinned_part(key, transforms)

    def target(self, element: Element, *tags: str, attribute: str = "url") -> Element:
        """What an element refers to. Raises ``MeshError`` if it is elsewhere, not there, or not to be told."""
        url = element.get(attribute) or ""
        if not url.startswith("#"):
            raise MeshError(f"it refers to geometry in another file ({url[:60]!r}), which is not read")
        name = unquote(url[1:])
        found = [one for tag in tags for one in self.by_id.get((tag, name), [])]
        parent = element.getparent()
        within = [one for one in found if parent in tuple(islice(one.iterancestors(), 2))]
        if len(within or found) != 1:
            many = f"which stands {len(found)} times in the file" if found else "which is not in the file"
            raise MeshError(f"<{element.tag}> refers to {tags[0]} {name[:60]!r}, {many}")
        return (within or found)[0]

    def shape_of(self, instance: Element) -> Element:
        """The geometry that an instance shows, below all its controllers."""
        if instance.tag == "instance_geometry":
            return self.target(instance, "geometry")
        element = self.target(instance, "controller")
        for _ in range(len(self.by_id) + 1):
            if element.tag == "geometry":
                return element
            element = self.target(_deformation(element), "geometry", "controller", attribute="source")
        raise MeshError("a controller of it deforms itself")

    # controllers

    def skinned_part(self, instance: Element, transforms: FloatArray) -> Part:
        controller = self.target(instance, "controller")
        points, faces, cuts = self.surface(self.shape_of(instance))
        points = self.deformed(controller, points)
        deformation = _deformation(controller)
        self.sources.append((instance, cuts, False))
        if deformation.tag == "morph":
            return Part(points, faces, transforms)
        bind = _numbers(deformation.findtext("bind_shape_matrix") or _IDENTITY)
        if len(bind) != 16:
            raise MeshError(f"<bind_shape_matrix> of a skin has {len(bind)} numbers, not 16")
        bind = bind.reshape(4, 4)
        poses = self.poses(instance, deformation)
        if poses is None:
            return Part(points, faces, transforms @ bind)
        points = points @ bind[:3, :3].T + bind[:3, 3]
        moved = self.bent(deformation, poses, points)
        mirrored = bool(np.linalg.det(bind[:3, :3]) * np.linalg.det(poses[:, :3, :3]).mean() < 0)
        self.sources[-1] = (instance, cuts, mirrored)
        return Part(
            moved, faces[:, ::-1] if mirrored else faces, np.eye(4)[None].repeat(len(transforms), axis=0)
        )

    def deformed(self, controller: Element, points: FloatArray) -> FloatArray:
        """Points after the morphs at and below a controller, at the weights that the file gives."""
        deformation = _deformation(controller)
        below = self.target(deformation, "geometry", "controller", attribute="source")
        if below.tag == "controller":
            if deformation.tag == "skin" and _deformation(below).tag == "skin":
                raise MeshError("a skin of it deforms another skin, which is not read")
            points = self.deformed(below, points)
        if deformation.tag == "skin":
            return points
        target, weight_of = _inputs(deformation.find("targets"), "MORPH_TARGET", "MORPH_WEIGHT")
        names, weights = self.words(target), self.rows(weight_of)[:, 0]
        if len(names) != len(weights):
            raise MeshError(f"a morph has {len(names)} targets, and {len(weights)} weights")
        relative = deformation.get("method", "NORMALIZED") == "RELATIVE"
        result = points if relative else points * (1 - weights.sum())
        for name, weight in zip(names, weights, strict=True):
            geometries = self.by_id.get(("geometry", name), [])
            if len(geometries) != 1:
                raise MeshError(f"a morph refers to geometry {name[:60]!r}, which is not in the file")
            other = self.positions(_mesh_of(geometries[0]))
            if other.shape != points.shape:
                raise MeshError("a morph has targets of other numbers of vertices")
            result = result + weight * other
        return result

    def poses(self, instance: Element, skin: Element) -> FloatArray | None:
        """(j, 4, 4): from where a skin was bound to where its joints rest; None if one is not in the file."""
        joint, bound = _inputs(skin.find("joints"), "JOINT", "INV_BIND_MATRIX")
        names, inverse = self.words(joint), self.rows(bound)
        if inverse.shape != (len(names), 16):
            raise MeshError(f"a skin has {len(names)} joints, and {inverse.size / 16:g} bind matrices")
        inverse = inverse.reshape(-1, 4, 4)
        roots = [self.target(_with_url(one), "node") for one in instance.findall("skeleton") if one.text]
        joints: dict[str, Element] = {}
        for root in roots or self.root.findall("library_visual_scenes/visual_scene"):
            for node in root.iter("node"):
                for name in (node.get("sid"), node.get("id")):
                    if name is not None:
                        joints.setdefault(name, node)
        if not all(name in joints for name in names):
            return None
        return np.array([_world(joints[name]) for name in names]).reshape(-1, 4, 4) @ inverse

    def bent(self, skin: Element, poses: FloatArray, points: FloatArray) -> FloatArray:
        """Each point where its joints carry it, by their weights."""
        element = skin.find("vertex_weights")
        if element is None:
            raise MeshError("a skin has no weights")
        joint, weight = _inputs(element, "JOINT", "WEIGHT")
        width = _width(element)
        sizes = _integers(element.findtext("vcount"))
        table = _integers(element.findtext("v"))
        if len(sizes) != len(points) or len(table) != sizes.sum() * width:
            raise MeshError("the weights of a skin are not as many as it announces")
        table = table.reshape(-1, width)
        joints, places = (table[:, _whole(one, "offset", 0)] for one in (joint, weight))
        values = self.rows(weight)[:, 0]
        if len(table) and not (
            places.min() >= 0
            and places.max() < len(values)
            and joints.min() >= -1
            and joints.max() < len(poses)
        ):
            raise MeshError("a skin refers to a joint or a weight that is not there")
        owners = np.repeat(np.arange(len(points)), sizes)
        # joint -1 is the shape as it was bound
        matrices = np.concatenate([poses, np.eye(4)[None]])[joints]
        totals = np.bincount(owners, values[places], len(points))
        moved = np.where((totals == 0)[:, None], points, 0.0)
        shares = values[places] / np.where(totals == 0, 1, totals)[owners]
        reached = np.einsum("nij,nj->ni", matrices[:, :3, :3], points[owners]) + matrices[:, :3, 3]
        np.add.at(moved, owners, shares[:, None] * reached)
        return moved

    # geometries

    def part(self, instance: Element | None, geometry: Element, transforms: FloatArray) -> Part:
        points, faces, cuts = self.surface(geometry)
        self.sources.append((instance, cuts, False))
        return Part(points, faces, transforms)

    def count_triangles(self, geometry: Element) -> int:
        """What a geometry declares; its primitives are counted before they are read."""
        mesh = _mesh_of(geometry)
        if mesh is None:
            return 0
        total = 0
        for primitive in _primitives(mesh):
            # what has corners is read, whatever it announces, so that both can be compared
            total += any(run.text or len(run) for run in primitive.iterfind("*") if run.tag in ("p", "ph"))
            # two numbers are parted by a blank: what is announced beyond that is not there, which reading it says
            held = sum((len(p.text or "") + 1) // 2 for p in primitive.iterfind("p"))
            if primitive.tag == "polylist":
                sizes = np.clip(_integers(primitive.findtext("vcount")) - 2, 0, held)
                total += min(int(sizes.sum()), held)
            elif primitive.tag == "triangles":
                total += min(_whole(primitive, "count", 0), held // 3)
            else:
                width = _width(primitive)
                total += sum(max(len((p.text or "").split()) // width - 2, 0) for p in primitive.findall("p"))
                # a hole of s corners makes s + 2 triangles more
                total += sum(len((run.text or "").split()) // width + 2 for run in primitive.iterfind("ph/*"))
        return total

    def surface(self, geometry: Element) -> tuple[FloatArray, Indices, list[_Cut]]:
        """Vertices (n, 3) and triangles (m, 3) of all primitives of a geometry, and each of them cut into its own."""
        mesh = _mesh_of(geometry)
        points = self.positions(mesh)
        cuts = [_cut(primitive, points) for primitive in ([] if mesh is None else _primitives(mesh))]
        faces = [np.empty((0, 3), np.int64)]
        faces += [cut.table[cut.places, _vertex_offset(cut.primitive)] for cut in cuts]
        return points, np.concatenate(faces), cuts

    def positions(self, mesh: Element | None) -> FloatArray:
        """(n, 3)"""
        if mesh is None:
            return np.empty((0, 3))
        element = mesh.find("vertices/input[@semantic='POSITION']")
        if element is None:
            raise MeshError("a mesh has no positions")
        rows = self.rows(element)
        if rows.shape[1] < 3:
            raise MeshError("its positions do not have three coordinates")
        return rows[:, :3]

    def rows(self, element: Element) -> FloatArray:
        """What an ``<input>`` refers to, (count, width): of the accessor's parameters those that have names."""
        accessor, text = self.array(element, "float_array", "int_array")
        values = _numbers(text)
        stride, count = _whole(accessor, "stride", 1), _whole(accessor, "count", 0)
        offset = _whole(accessor, "offset", 0)
        params = accessor.findall("param")
        width = stride if stride in (9, 16) or not params else len(params)
        if stride < max(width, 1) or (count and offset + stride * (count - 1) + width > len(values)):
            raise MeshError(
                f"a source announces {count:,} elements of {stride} numbers, but has {len(values):,} numbers"
            )
        if not count:
            return np.empty((0, width))
        step = stride if count > 1 else width  # a single element may announce any stride
        padded = np.concatenate([values[offset:], np.zeros(step)])[: count * step].reshape(count, step)
        names = [(param.get("name") or "").upper() for param in params]
        if {"X", "Y", "Z"} <= set(names):
            return padded[:, [names.index(axis) for axis in "XYZ"]]
        named = [place for place, name in enumerate(names) if name]
        return padded[:, named] if len(named) >= 3 else padded[:, :width]

    def words(self, element: Element) -> list[str]:
        accessor, text = self.array(element, "Name_array", "IDREF_array", "SIDREF_array")
        return text.split()[: _whole(accessor, "count", 0)]

    def array(self, element: Element, *tags: str) -> tuple[Element, str]:
        """The accessor of what an ``<input>`` refers to, and the text of its array."""
        source = self.target(element, "source", attribute="source")
        accessor = source.find("technique_common/accessor")
        if accessor is None:
            raise MeshError(f"source {source.get('id', '')[:60]!r} does not say how it is read")
        array = self.target(accessor, *tags, attribute="source")
        return accessor, array.text or ""

    # colours

    def paint(self, parts: Sequence[Part]) -> Paint:
        """The colours of the corners of the joined parts."""
        looks = [self.paint_part(*source) for source in self.sources]
        colors, places, pictures = (
            join_corners(parts, [one[column] for one in looks]).reshape(-1, *width)
            for column, width in enumerate(((3,), (2,), ()))
        )
        lost = tuple(self.pictures.lost)
        if not self.pictures.images:
            return Paint(colors, lost=lost)
        return Paint(colors, places, pictures, tuple(self.pictures.images), lost)

    def paint_part(
        self, instance: Element | None, cuts: list[_Cut], turned: bool
    ) -> tuple[npt.NDArray[np.generic], ...]:
        """Colour (m, 3, 3), place in a picture (m, 3, 2) and picture (m, 3) of the corners of a part's triangles."""
        found = (
            () if instance is None else instance.iterfind("bind_material/technique_common/instance_material")
        )
        bindings = {one.get("symbol"): one for one in found}
        looks: dict[str | None, _Look] = {}
        painted = [
            (np.empty((0, 3, 3), np.uint8), np.empty((0, 3, 2), np.float32), np.empty((0, 3), np.int16))
        ]
        for cut in cuts:
            symbol = cut.primitive.get("material")
            if symbol not in looks:
                looks[symbol] = self.find_look(symbol, bindings.get(symbol))
            painted.append(self.paint_cut(cut, looks[symbol]))
        columns = (np.concatenate(column) for column in zip(*painted, strict=True))
        return tuple(column[:, ::-1] if turned else column for column in columns)

    def paint_cut(
        self, cut: _Cut, look: _Look
    ) -> tuple[Bytes, npt.NDArray[np.float32], npt.NDArray[np.int16]]:
        shape = cut.places.shape
        colors = np.broadcast_to(np.array(look.color, np.uint8), (*shape, 3))
        if (values := self.values_of(cut, "COLOR", "")) is not None and values.shape[1] >= 3:
            # some programs write colours of corners that say nothing
            own = as_bytes(values[:, :3])
            if not Paint(own[cut.places]).is_plain:
                colors = own[cut.places]
        places = np.zeros((*shape, 2), np.float32)
        pictures = np.full(shape, -1, np.int16)
        if look.picture >= 0:
            found = self.values_of(cut, "TEXCOORD", look.coordinates)
            if found is None or found.shape[1] < 2:
                self.pictures.miss_places(look.name)
            else:
                places[:] = (found[:, :2] * [1, -1] + [0, 1])[cut.places]
                pictures[:] = look.picture
        return colors, places, pictures

    def values_of(self, cut: _Cut, semantic: str, number: str) -> FloatArray | None:
        """What an input of a meaning has for each row of a table, (k, width), if there is one: that of a set's number,
        else the first. Where it leads nowhere it is not a number."""
        found = [(one, _whole(one, "offset", 0)) for one in cut.primitive.findall("input")]
        mesh = cut.primitive.getparent()
        if mesh is not None:
            offset = _vertex_offset(cut.primitive)
            found += [(one, offset) for one in mesh.iterfind("vertices/input")]
        found = [(one, offset) for one, offset in found if one.get("semantic") == semantic]
        if not found:
            return None
        one, offset = next(((one, o) for one, o in found if one.get("set", "0") == number), found[0])
        source = self.target(one, "source", attribute="source")
        if source not in self.known:
            self.known[source] = self.rows(one)
        rows, column = self.known[source], cut.table[:, offset]
        there = (column >= 0) & (column < len(rows))
        values = np.full((len(column), rows.shape[1]), np.nan)
        values[there] = rows[column[there]]
        return values

    def find_look(self, symbol: str | None, binding: Element | None) -> _Look:
        """How the primitives with a symbol look where an instance binds a material to it; where it binds none, that of
        this id."""
        material = self.refer("material", f"#{symbol}" if binding is None else binding.get("target"))
        reference = None if material is None else material.find("instance_effect")
        effect = None if reference is None else self.refer("effect", reference.get("url"))
        if effect is None:
            return _Look()
        for shader in ("phong", "lambert", "blinn", "constant"):
            seen = "emission" if shader == "constant" else "diffuse"
            color = effect.find(f"profile_COMMON/technique/{shader}/{seen}")
            if color is not None:
                return self.read_look(color, effect, binding)
        return _Look()

    def read_look(self, color: Element, effect: Element, binding: Element | None) -> _Look:
        """A colour or a texture of an effect."""
        parameters = {one.get("sid"): one for one in effect.iter("newparam")}
        texture = color.find("texture")
        if texture is None:
            param = color.find("param")
            known = None if param is None else parameters.get(param.get("ref"))
            text = color.findtext("color")
            if known is not None:
                text = known.findtext("float4") or known.findtext("float3")
            numbers = _numbers(text)[:3]
            return _Look(tuple(as_bytes(numbers, most=1).tolist())) if len(numbers) == 3 else _Look()
        name = texture.get("texture")
        sampler = parameters.get(name)
        image = None if sampler is None else sampler.find("sampler2D/instance_image")
        if image is not None:
            name = (image.get("url") or "").lstrip("#")
        elif sampler is not None:
            surface = parameters.get(sampler.findtext("sampler2D/source", "").strip())
            name = "" if surface is None else surface.findtext("surface/init_from", "").strip()
        found = self.refer("image", f"#{name}")
        uri = "" if found is None else found.findtext("init_from/ref") or found.findtext("init_from") or ""
        file = _image_name(uri) or str(name)
        wanted = texture.get("texcoord")
        number = ""
        for one in () if binding is None else binding.iterfind("bind_vertex_input"):
            if one.get("semantic") == wanted:
                number = one.get("input_set", "0")
        across, down = (
            "repeat"
            if sampler is None
            else _WRAPS.get(sampler.findtext(f"sampler2D/wrap_{axis}", "").strip(), "repeat")
            for axis in "st"
        )
        picture = self.pictures.place(file, file, partial(self.files.get, file), (across, down))
        return _Look(picture=picture, name=file, coordinates=number)

    def refer(self, tag: str, url: str | None) -> Element | None:
        """An element of the file, if it is there."""
        return next(iter(self.by_id.get((tag, unquote(url or "").removeprefix("#")), ())), None)


_IDENTITY = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"


def _numbers(text: str | None) -> FloatArray:
    return parse_numbers(text) if text and not text.isspace() else np.empty(0)


def _integers(text: str | None) -> Indices:
    return parse_indices(text) if text and not text.isspace() else np.empty(0, np.int64)


def _whole(element: Element, name: str, default: int) -> int:
    """An attribute that is a count or a place. Raises ``MeshError`` if it is something else."""
    value = (element.get(name) or str(default)).strip()
    if not value.isdecimal():
        raise MeshError(f"the {name} of <{element.tag}> is no whole number from 0 on: {value[:20]!r}")
    return int(value)


def _inputs(element: Element | None, *semantics: str) -> list[Element]:
    """The inputs of given meanings. Raises ``MeshError`` if one is not there."""
    found = {} if element is None else {one.get("semantic"): one for one in element.findall("input")}
    for semantic in semantics:
        if semantic not in found:
            raise MeshError(f"a skin or a morph of it has no input {semantic}")
    return [found[semantic] for semantic in semantics]


def _with_url(skeleton: Element) -> Element:
    skeleton.set("url", (skeleton.text or "").strip())
    return skeleton


def _deformation(controller: Element) -> Element:
    for tag in ("skin", "morph"):
        found = controller.find(tag)
        if found is not None:
            return found
    raise MeshError("a controller is neither a skin nor a morph")


def _mesh_of(geometry: Element) -> Element | None:
    """The mesh of a geometry; None for curves, which have no surface."""
    for kind in ("mesh", "convex_mesh"):
        mesh = geometry.find(kind)
        if mesh is not None:
            if mesh.get("convex_hull_of"):
                raise MeshError("it has a convex hull of another geometry (convex_mesh), which is not read")
            return mesh
    if geometry.find("brep") is not None:
        raise MeshError("it has a boundary representation (brep), which is not read; export it as a mesh")
    return None


def _primitives(mesh: Element) -> list[Element]:
    return [element for element in mesh if element.tag in _FACES]


def _width(primitive: Element) -> int:
    """How many indices a corner has."""
    return 1 + max((_whole(one, "offset", 0) for one in primitive.findall("input")), default=0)


def _vertex_offset(primitive: Element) -> int:
    element = primitive.find("input[@semantic='VERTEX']")
    if element is None:
        raise MeshError(f"<{primitive.tag}> has no vertices")
    return _whole(element, "offset", 0)


def _corners(primitive: Element, run: Element, points: FloatArray) -> Indices:
    """The indices (k, width) of a run of corners. Raises ``MeshError`` if a vertex is not there."""
    indices, width = _integers(run.text), _width(primitive)
    if len(indices) % width:
        raise MeshError(f"<{primitive.tag}> has corners that are not complete")
    corners = indices.reshape(-1, width)
    check_indices(points, corners[:, _vertex_offset(primitive)])
    return corners


def _cut(primitive: Element, points: FloatArray) -> _Cut:
    """Cut a primitive's runs of corners, and its polygons with holes, into triangles.

    Raises
    ------
    MeshError
        If they are not as many as the primitive announces.
    """
    tables = [np.empty((0, _width(primitive)), np.int64)]
    total = 0

    def add(run: Element) -> Indices:
        nonlocal total
        tables.append(_corners(primitive, run, points))
        total += len(tables[-1])
        return np.arange(total - len(tables[-1]), total)

    runs = [add(run) for run in primitive.findall("p")]
    count = total
    holed = []
    for ph in primitive.findall("ph"):
        outlines, holes = ph.findall("p"), ph.findall("h")
        if len(outlines) != 1:
            raise MeshError(f"a polygon with holes has {len(outlines)} outlines")
        holed.append([add(loop) for loop in (*outlines, *holes)])
    table = np.concatenate(tables)
    corners = table[:, _vertex_offset(primitive)] if total else np.empty(0, np.int64)
    declared, found = _whole(primitive, "count", 0), len(runs)
    if primitive.tag in ("tristrips", "trifans"):
        cut: Callable[[Indices], Indices] = cut_strip if primitive.tag == "tristrips" else cut_fan
        places = np.concatenate([np.empty((0, 3), np.int64), *(cut(run) for run in runs if len(run) > 2)])
    elif primitive.tag == "triangles":
        if count % 3:
            raise MeshError(f"<triangles> has {count} corners, which is no multiple of three")
        places = np.arange(count).reshape(-1, 3)
        found = len(places)
    else:
        sizes = np.array([len(run) for run in runs], np.int64)
        if primitive.tag == "polylist":
            sizes = _integers(primitive.findtext("vcount"))
            found = len(sizes)
            if (sizes < 0).any():
                raise MeshError(f"<polylist> announces a polygon of {sizes.min():,} corners")
            if (sizes > count).any():  # apart from their sum, which could overflow
                raise MeshError(
                    f"<polylist> announces a polygon of {sizes.max():,} corners, and has {count:,}"
                )
            if sizes.sum() != count:
                raise MeshError(f"<polylist> announces {sizes.sum():,} corners, and has {count:,}")
        places = cut_corners(PolygonMesh(points, corners[:count], sizes))
        if holed:
            found += len(holed)
            places = np.concatenate([places, *(cut_with_holes(points, corners, loops) for loops in holed)])
    if found != declared:
        raise MeshError(f"<{primitive.tag}> announces {declared:,} elements, and has {found:,}")
    return _Cut(primitive, table, places)


def _world(node: Element) -> FloatArray:
    """From a node to the scene, through the nodes that it stands in."""
    matrix = np.eye(4)
    above: Element | None = node
    while above is not None and above.tag == "node":
        matrix, above = _transform(above) @ matrix, above.getparent()
    return matrix


def _transform(node: Element) -> FloatArray:
    """From a node to its parent: its transformations, the last of them first."""
    matrix = np.eye(4)
    for element in node:
        if element.tag in _TRANSFORMATIONS:
            numbers = _numbers(element.text)
            count, make = _TRANSFORMATIONS[element.tag]
            if len(numbers) != count:
                raise MeshError(f"<{element.tag}> of a node has {len(numbers)} numbers, not {count}")
            move = make(numbers)
            if not np.isfinite(move).all():
                raise MeshError(
                    f"<{element.tag}> of a node means nothing: {(element.text or '').strip()[:60]!r}"
                )
            matrix = matrix @ move
    return matrix


def _translate(numbers: FloatArray) -> FloatArray:
    matrix = np.eye(4)
    matrix[:3, 3] = numbers
    return matrix


def _scale(numbers: FloatArray) -> FloatArray:
    return np.diag([*numbers, 1.0])


def _rotate(numbers: FloatArray) -> FloatArray:
    """About an axis (x, y, z), by an angle in degrees; no axis, no rotation."""
    length = np.linalg.norm(numbers[:3])
    if not length:
        return np.eye(4)
    x, y, z = numbers[:3] / length
    angle = np.radians(numbers[3])
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return matrix


def _skew(numbers: FloatArray) -> FloatArray:
    """By an angle in degrees, points move along the second axis by their distance along the first (as in RenderMan)."""
    angle, along, across = np.radians(numbers[0]), numbers[4:7], numbers[1:4]
    direction, other = along / np.linalg.norm(along), across / np.linalg.norm(across)
    # RenderMan: the first axis turns by the angle towards the second, in the plane of both
    normal = other - (other @ direction) * direction
    height = np.linalg.norm(normal)
    start = np.arctan2(height, other @ direction)
    matrix = np.eye(4)
    slope = 1 / np.tan(start - angle) - 1 / np.tan(start)
    matrix[:3, :3] += slope * np.outer(direction, normal / height)
    return matrix


def _look_at(numbers: FloatArray) -> FloatArray:
    """From the eye: its z axis points away from what it looks at."""
    eye, interest, up = numbers.reshape(3, 3)
    backward = eye - interest
    backward = backward / np.linalg.norm(backward)
    right = np.cross(up, backward)
    right = right / np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([right, np.cross(backward, right), backward])
    matrix[:3, 3] = eye
    return matrix


_TRANSFORMATIONS: dict[str, tuple[int, Callable[[FloatArray], FloatArray]]] = {
    "matrix": (16, lambda numbers: numbers.reshape(4, 4)),
    "translate": (3, _translate),
    "rotate": (4, _rotate),
    "scale": (3, _scale),
    "skew": (7, _skew),
    "lookat": (9, _look_at),
}
