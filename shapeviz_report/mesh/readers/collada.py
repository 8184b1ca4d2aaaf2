"""COLLADA 1.4 and 1.5: its triangles and polygons, where its scene places them at rest."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from itertools import islice
from urllib.parse import unquote

import numpy as np
from lxml import etree

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.limits import check_faces
from shapeviz_report.mesh.readers.polygons import (
    Indices,
    PolygonMesh,
    check_indices,
    cut_fan,
    cut_strip,
    cut_with_holes,
    triangulate,
)
from shapeviz_report.mesh.readers.scene import Node, Part, join_parts, place_nodes
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


def read_collada(data: bytes) -> PolygonMesh:
    """Read COLLADA.

    Raises
    ------
    MeshError
        If it is anything else, or holds a surface that is not read.
    """
    return _Reader(_parse(data)).read()


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

    def __init__(self, root: Element) -> None:
        self.root = root
        self.by_id: dict[tuple[str, str], list[Element]] = {}
        for element in root.iter(etree.Element):
            if (name := element.get("id")) is not None:
                self.by_id.setdefault((element.tag, name), []).append(element)

    def read(self) -> PolygonMesh:
        up = _UP_AXES.get((self.root.findtext("asset/up_axis") or "Y_UP").strip())
        if up is None:
            raise MeshError("its up_axis is none of X_UP, Y_UP and Z_UP")
        return PolygonMesh.of_triangles(*join_parts(self.place_geometries()), up=up)

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
                    yield self.part(geometry, np.eye(4)[None])
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
                yield self.part(self.shape_of(key), transforms)
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
        points, faces = self.surface(self.shape_of(instance))
        points = self.deformed(controller, points)
        deformation = _deformation(controller)
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
        mirrored = np.linalg.det(bind[:3, :3]) * np.linalg.det(poses[:, :3, :3]).mean() < 0
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

    def part(self, geometry: Element, transforms: FloatArray) -> Part:
        return Part(*self.surface(geometry), transforms)

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

    def surface(self, geometry: Element) -> tuple[FloatArray, Indices]:
        """Vertices (n, 3) and triangles (m, 3) of all primitives of a geometry."""
        mesh = _mesh_of(geometry)
        points = self.positions(mesh)
        faces = [np.empty((0, 3), np.int64)]
        for primitive in [] if mesh is None else _primitives(mesh):
            corners = [_corners(primitive, p, points) for p in primitive.findall("p")]
            holed = []
            for ph in primitive.findall("ph"):
                outlines, holes = ph.findall("p"), ph.findall("h")
                if len(outlines) != 1:
                    raise MeshError(f"a polygon with holes has {len(outlines)} outlines")
                holed.append([_corners(primitive, loop, points) for loop in (*outlines, *holes)])
            faces.append(_faces_of(primitive, corners, holed, points))
        return points, np.concatenate(faces)

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
    """The vertices that a run of indices goes through. Raises ``MeshError`` if one is not there."""
    indices, width = _integers(run.text), _width(primitive)
    if len(indices) % width:
        raise MeshError(f"<{primitive.tag}> has corners that are not complete")
    corners = indices.reshape(-1, width)[:, _vertex_offset(primitive)]
    check_indices(points, corners)
    return corners


def _faces_of(
    primitive: Element, corners: list[Indices], holed: list[list[Indices]], points: FloatArray
) -> Indices:
    """Triangles (m, 3) of runs of corners, and of polygons with holes, each a list of an outline and holes.

    Raises
    ------
    MeshError
        If they are not as many as the primitive announces.
    """
    together = np.concatenate([np.empty(0, np.int64), *corners])
    declared, found = _whole(primitive, "count", 0), len(corners)
    if primitive.tag in ("tristrips", "trifans"):
        cut: Callable[[Indices], Indices] = cut_strip if primitive.tag == "tristrips" else cut_fan
        faces = np.concatenate([np.empty((0, 3), np.int64), *(cut(run) for run in corners if len(run) > 2)])
    elif primitive.tag == "triangles":
        if len(together) % 3:
            raise MeshError(f"<triangles> has {len(together)} corners, which is no multiple of three")
        faces = together.reshape(-1, 3)
        found = len(faces)
    else:
        sizes = np.array([len(run) for run in corners], np.int64)
        if primitive.tag == "polylist":
            sizes = _integers(primitive.findtext("vcount"))
            found = len(sizes)
            if (sizes < 0).any():
                raise MeshError(f"<polylist> announces a polygon of {sizes.min():,} corners")
            if (sizes > len(together)).any():  # apart from their sum, which could overflow
                raise MeshError(
                    f"<polylist> announces a polygon of {sizes.max():,} corners, and has {len(together):,}"
                )
            if sizes.sum() != len(together):
                raise MeshError(f"<polylist> announces {sizes.sum():,} corners, and has {len(together):,}")
        faces = triangulate(PolygonMesh(points, together, sizes))
        if holed:
            found += len(holed)
            faces = np.concatenate([faces, *(cut_with_holes(points, loops) for loops in holed)])
    if found != declared:
        raise MeshError(f"<{primitive.tag}> announces {declared:,} elements, and has {found:,}")
    return faces


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
