"""3MF: what the build places, with the production extension, as slicers write it.

Trimesh takes all objects of all parts of the package, whether they are built or not, and mixes up those of the same
number in different parts; so 3MF is read here.
"""

from __future__ import annotations

import graphlib
import lzma
import zlib
from array import array
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from io import BytesIO
from typing import IO
from urllib.parse import unquote
from xml.parsers import expat
from zipfile import BadZipFile, ZipFile, ZipInfo

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.paint import Paint, Pictures
from shapeviz_report.mesh.readers.limits import MOST_LOOKS, check_faces, check_unpacked
from shapeviz_report.mesh.readers.polygons import Indices, PolygonMesh, check_indices
from shapeviz_report.mesh.readers.scene import Part as Surface
from shapeviz_report.mesh.readers.scene import join_corners, join_parts
from shapeviz_report.mesh.readers.text import not_numbers, parse_indices, parse_numbers
from shapeviz_report.mesh.readers.threemf_colors import Groups
from shapeviz_report.types import FloatArray

_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
_READ_EXTENSIONS = frozenset(
    {
        _CORE,
        _PRODUCTION,
        "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",  # looks
        "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07",  # groups of triangles, for selecting
    }
)
_RELATIONSHIP = "http://schemas.openxmlformats.org/package/2006/relationships Relationship"
_ROOT_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_MILLIMETRES = {
    "micron": 1e-3,
    "millimeter": 1.0,
    "centimeter": 10.0,
    "inch": 25.4,
    "foot": 304.8,
    "meter": 1e3,
}
_CHUNK = 2**20
_MOST_WORDS = 2**18

Key = tuple[str, str]
"""Which object: the path of its part, the number it has there."""


@dataclass
class Object:
    """An object: a mesh of its own, or other objects in their places.

    Attributes
    ----------
    coordinates : array of float
        Of its vertices, x, y, z in turns.
    indices : array of int
        Of the corners of its triangles, three in turns.
    children : list of (Key, (4, 3) float64 array)
        Objects, and the matrix that a row (x, y, z, 1) is multiplied with to place it.
    is_shape : bool
        It has a mesh or components, be they empty.
    groups : Groups
        What its triangles refer to for their colours.
    look : (int, int)
        Number of the group that they refer to if they say nothing, -1 for none, and what they have of it.
    looks : array of int
        Of the triangles that say something, five numbers each: its own, its group, and what its corners have of it.
    """

    coordinates: array[float] = field(default_factory=lambda: array("d"))
    indices: array[int] = field(default_factory=lambda: array("q"))
    children: list[tuple[Key, FloatArray]] = field(default_factory=list)
    is_shape: bool = False
    groups: Groups = field(default_factory=Groups)
    look: tuple[int, int] = (-1, -1)
    looks: array[int] = field(default_factory=lambda: array("i"))

    @property
    def is_painted(self) -> bool:
        return self.look[0] >= 0 or len(self.looks) > 0


@dataclass
class Part:
    """A model part of the package: what it builds, its objects by number, its colours, its unit in millimetres."""

    build: Object = field(default_factory=Object)
    objects: dict[str, Object] = field(default_factory=dict)
    groups: Groups = field(default_factory=Groups)
    unit: float = 1.0


def read_3mf(data: bytes) -> PolygonMesh:
    """Read 3MF.

    Raises
    ------
    MeshError
        If it is anything else, or has geometry that is not read.
    """
    try:
        with ZipFile(BytesIO(data)) as archive:
            placed = _place(*_collect(Package(archive)))
        mesh = PolygonMesh.of_triangles(*join_parts([part for _, part in placed]))
        painted = any(each.is_painted for each, _ in placed)
        return replace(mesh, paint=partial(_paint, placed, data) if painted else None)
    except BadZipFile as error:
        raise MeshError(f"it is not 3MF, or damaged: {error}") from error
    except expat.ExpatError as error:
        raise MeshError(f"its XML is broken, or cut off ({error})") from error


class Package:
    """The files of a 3MF, by path in small letters, and how many bytes of them were unpacked."""

    def __init__(self, archive: ZipFile) -> None:
        self._archive = archive
        self._entries: dict[str, ZipInfo] = {}
        self._twice: set[str] = set()
        for info in archive.infolist():
            path = _normal(info.filename)
            if path in self._entries:
                self._twice.add(path)
            self._entries[path] = info
        self._unpacked = 0

    def parse(self, path: str, parser: expat.XMLParserType) -> None:
        """Hand a file to a parser, piece by piece: no more of it is ever held. Raises ``MeshError``."""
        entry = self._entries.get(path)
        if entry is None:
            raise MeshError(f"it refers to {path[:100]!r}, which is not in it")
        if path in self._twice:
            raise MeshError(f"{path[:100]!r} stands in it twice")
        if entry.flag_bits & 1:
            raise MeshError("it is encrypted")
        check_unpacked(self._unpacked + entry.file_size)
        try:
            with self._archive.open(entry) as file:
                self._feed(file, parser)
        except NotImplementedError as error:
            raise MeshError(
                f"it is compressed in a way that is not read (method {entry.compress_type}); save it anew"
            ) from error
        except LookupError as error:
            raise MeshError(f"the XML of {path[:100]!r} is in an encoding that is not known") from error
        except (zlib.error, lzma.LZMAError, EOFError, OSError, ValueError) as error:
            raise MeshError(f"it is damaged: {path[:100]!r} cannot be unpacked from it") from error

    def _feed(self, file: IO[bytes], parser: expat.XMLParserType) -> None:
        while piece := file.read(_CHUNK):
            self._unpacked += len(piece)
            check_unpacked(self._unpacked)
            parser.Parse(piece, False)
        parser.Parse(b"", True)

    def read(self, path: str) -> bytes | None:
        """The content of a picture; None if it is not there, damaged, or larger than all may be together."""
        entry = self._entries.get(_normal(path))
        if entry is None or entry.flag_bits & 1 or self._unpacked + entry.file_size > MOST_LOOKS:
            return None
        try:
            with self._archive.open(entry) as file:
                content = file.read(entry.file_size + 1)
        except (NotImplementedError, BadZipFile, zlib.error, lzma.LZMAError, EOFError, OSError, ValueError):
            return None
        self._unpacked += len(content)
        return content

    def root(self) -> str:
        """The path of the part that says what is built."""
        targets: list[str] = []

        def start(name: str, attributes: dict[str, str]) -> None:
            if name == _RELATIONSHIP and attributes.get("Type") == _ROOT_TYPE:
                targets.append(_normal(attributes.get("Target", "")))

        if "_rels/.rels" not in self._entries:
            raise MeshError("it is not 3MF: it has no _rels/.rels, which says what its model is")
        self.parse("_rels/.rels", _parser(start))
        if not targets:
            raise MeshError("it is not 3MF: no part of it is a 3D model")
        return targets[0]


def _normal(path: str) -> str:
    """A path in the package as it is compared: without a slash in front, in small letters, nothing escaped."""
    return unquote(path).replace("\\", "/").lstrip("/").lower()


def _parser(start: Callable[[str, dict[str, str]], None]) -> expat.XMLParserType:
    parser = expat.ParserCreate(namespace_separator=" ")
    parser.StartElementHandler = start
    parser.StartDoctypeDeclHandler = _refuse_document_type
    return parser


def _refuse_document_type(*_: object) -> None:
    raise MeshError("it has a document type declaration, which 3MF does not use")


def _collect(package: Package) -> tuple[Object, dict[Key, Object]]:
    """What is built, and every object that it has, in one unit."""
    root = package.root()
    parts = {root: _read_part(package, root)}
    build = parts[root].build
    if not build.children:
        raise MeshError("it builds nothing: no object is placed")
    objects: dict[Key, Object] = {}
    wanted = [key for key, _ in build.children]
    while wanted:
        key = path, number = wanted.pop()
        if key in objects:
            continue
        if path not in parts:
            parts[path] = _read_part(package, path)
        part = parts[path]
        if number not in part.objects:
            raise MeshError(f"it places object {number[:20]!r} of {path[:100]!r}, which is not there")
        if not part.objects[number].is_shape:
            raise MeshError(f"object {number[:20]!r} of {path[:100]!r} has neither a mesh nor components")
        objects[key] = part.objects[number]
        wanted += [child for child, _ in objects[key].children]
    # a component is placed in the unit of the part that places it
    for part in parts.values():
        for entry in [part.build, *part.objects.values()]:
            entry.children = [
                (key, _scaled(transform, parts[key[0]].unit / part.unit))
                if key[0] in parts
                else (key, transform)
                for key, transform in entry.children
            ]
    return build, objects


def _scaled(transform: FloatArray, factor: float) -> FloatArray:
    return transform * np.array([[factor]] * 3 + [[1.0]])


def _read_part(package: Package, path: str) -> Part:
    reader = PartReader(path)
    package.parse(path, reader.parser)
    if not reader.is_model:
        raise MeshError(f"{path[:100]!r} in it is not a 3MF model")
    return reader.part


class PartReader:
    """What a parser tells of a model part becomes a :class:`Part`."""

    def __init__(self, path: str) -> None:
        self.part = Part()
        self.is_model = False
        self.parser = _parser(self._start)
        self.parser.EndElementHandler = self._end
        self.parser.StartNamespaceDeclHandler = self._declare
        self._path = path
        self._namespaces: dict[str | None, str] = {}
        self._open: list[str] = []
        self._object = Object()
        self._coordinates: list[str] = []
        self._indices: list[str] = []
        self._triangles = 0

    def _declare(self, prefix: str | None, namespace: str) -> None:
        self._namespaces.setdefault(prefix, namespace)

    def _end(self, name: str) -> None:
        self._open.pop()
        if name in (_VERTICES, _TRIANGLES):
            self._take_numbers()

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        parent = self._open[-1] if self._open else ""
        self._open.append(name)
        try:
            if name == _VERTEX and parent == _VERTICES:
                self._coordinates += attributes["x"], attributes["y"], attributes["z"]
            elif name == _TRIANGLE and parent == _TRIANGLES:
                self._indices += attributes["v1"], attributes["v2"], attributes["v3"]
                if "p1" in attributes:
                    self._paint(attributes)
            else:
                self._begin(name, parent, attributes)
        except KeyError as error:
            raise MeshError(f"a <{name.rpartition(' ')[2]}> of it has no {error.args[0]}") from error
        if len(self._coordinates) + len(self._indices) > _MOST_WORDS:
            self._take_numbers()

    def _take_numbers(self) -> None:
        """Words that stand where numbers belong become those, many at once."""
        self._triangles += len(self._indices) // 3
        check_faces(self._triangles)
        for words, numbers, parse in (
            (self._coordinates, self._object.coordinates, parse_numbers),
            (self._indices, self._object.indices, parse_indices),
        ):
            if words:
                text = " ".join(words)
                values = parse(text)
                if values.size != len(words):
                    raise not_numbers(next((word for word in words if len(word.split()) != 1), ""))
                numbers.frombytes(values.tobytes())
                words.clear()

    def _paint(self, attributes: dict[str, str]) -> None:
        """What a triangle says of its colours."""
        number = (len(self._object.indices) + len(self._indices)) // 3 - 1
        group = self.part.groups.number(attributes["pid"]) if "pid" in attributes else self._object.look[0]
        first = attributes["p1"]
        corners = (_index(attributes.get(name, first)) for name in ("p1", "p2", "p3"))
        self._object.looks.extend((number, group, *corners))

    def _begin(self, name: str, parent: str, attributes: dict[str, str]) -> None:
        """Whatever is not one of the many."""
        if name == _MODEL and not parent:
            self.is_model = True
            self._begin_model(attributes)
        elif name == _OBJECT:
            if attributes["id"] in self.part.objects:
                raise MeshError(f"two objects of it have the id {attributes['id'][:20]!r}")
            self._object = self.part.objects[attributes["id"]] = Object(groups=self.part.groups)
            if "pid" in attributes:
                group = self.part.groups.number(attributes["pid"])
                self._object.look = group, _index(attributes.get("pindex", ""))
        elif name in (_MESH, _COMPONENTS) and parent == _OBJECT:
            self._object.is_shape = True
        elif name == _COMPONENT:
            self._object.children.append(self._placed(attributes))
        elif name == _ITEM:
            self.part.build.children.append(self._placed(attributes))
        elif parent in (_OBJECT, _MESH) and name not in _WITHIN:
            raise MeshError(
                f"an object of it has a <{name.rpartition(' ')[2][:40]}>, which is not read; export it as a mesh"
            )
        else:
            self.part.groups.describe(name, attributes)

    def _begin_model(self, attributes: dict[str, str]) -> None:
        for prefix in attributes.get("requiredextensions", "").split():
            namespace = self._namespaces.get(prefix, prefix)
            if namespace not in _READ_EXTENSIONS:
                raise MeshError(
                    f"it requires an extension that is not read: {namespace[:100]}; export it without"
                )
        unit = attributes.get("unit", "millimeter")
        if unit not in _MILLIMETRES:
            raise MeshError(f"its unit means nothing: {unit[:40]!r}")
        self.part.unit = _MILLIMETRES[unit]

    def _placed(self, attributes: dict[str, str]) -> tuple[Key, FloatArray]:
        path = attributes.get(f"{_PRODUCTION} path")
        words = attributes.get("transform", "1 0 0 0 1 0 0 0 1 0 0 0").split()
        if len(words) != 12:
            raise MeshError(f"a transform of it has {len(words)} numbers, not 12")
        key = (_normal(path) if path else self._path, attributes["objectid"])
        numbers = parse_numbers(" ".join(words))
        if not np.isfinite(numbers).all():
            raise MeshError(f"a transform of it has numbers without a value: {' '.join(words)[:60]!r}")
        return key, numbers.reshape(4, 3)


_MODEL, _OBJECT, _MESH, _COMPONENTS, _COMPONENT, _ITEM, _VERTICES, _VERTEX, _TRIANGLES, _TRIANGLE = (
    f"{_CORE} {name}"
    for name in [
        "model",
        "object",
        "mesh",
        "components",
        "component",
        "item",
        "vertices",
        "vertex",
        "triangles",
        "triangle",
    ]
)
_WITHIN = frozenset(
    {_VERTICES, _TRIANGLES, f"{_CORE} metadatagroup"}
    | {"http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07 trianglesets"}
)
"""What an object and its mesh may have; anything else is geometry of an extension."""


def _index(text: str) -> int:
    """A number from 0 on; -1 for anything else."""
    return int(text) if text.isdecimal() and len(text) < 10 else -1


def _place(build: Object, objects: dict[Key, Object]) -> list[tuple[Object, Surface]]:
    """What is built: every mesh, and where it is placed. Counted before anything is copied."""
    try:
        order = list(
            graphlib.TopologicalSorter(
                {key: [child for child, _ in each.children] for key, each in objects.items()}
            ).static_order()
        )
    except graphlib.CycleError as error:
        raise MeshError("an object of it is a part of itself") from error
    counts: dict[Key, int] = {}
    for key in order:
        each = objects[key]
        counts[key] = len(each.indices) // 3 + sum(counts[child] for child, _ in each.children)
    check_faces(sum(counts[key] for key, _ in build.children))
    # from what is built down to the meshes: every object's transforms (k, 4, 3), one for each time it is placed
    transforms: dict[Key, list[FloatArray]] = {key: [] for key in objects}
    for key, transform in build.children:
        transforms[key].append(transform[None])
    surfaces: list[tuple[Object, Surface]] = []
    for key in reversed(order):
        placed = transforms.pop(key)
        if not placed or not counts[key]:
            continue
        every, each = np.concatenate(placed), objects[key]
        for child, transform in each.children:
            moved = transform @ every[:, :3]
            moved[:, 3] += every[:, 3]
            transforms[child].append(moved)
        if each.indices:
            matrices = np.eye(4)[None].repeat(len(every), axis=0)
            matrices[:, :3] = every.transpose(0, 2, 1)
            surfaces.append((each, Surface(*_mesh_of(each), matrices)))
    return surfaces


def _mesh_of(each: Object) -> tuple[FloatArray, Indices]:
    """Vertices (n, 3) and triangles (m, 3)."""
    points = (
        np.frombuffer(each.coordinates, np.float64).reshape(-1, 3) if each.coordinates else np.empty((0, 3))
    )
    triangles = np.frombuffer(each.indices, np.int64).reshape(-1, 3)
    check_indices(points, triangles.ravel())
    return points, triangles


def _paint(placed: list[tuple[Object, Surface]], data: bytes) -> Paint:
    """The colours of what is built, pictures read from the package once more."""
    pictures = Pictures()
    with ZipFile(BytesIO(data)) as archive:
        package = Package(archive)
        looks = [_paint_object(each, pictures, package) for each, _ in placed]
    surfaces = [surface for _, surface in placed]
    colors, places, shown = (
        join_corners(surfaces, [one[column] for one in looks]).reshape(-1, *width)
        for column, width in enumerate(((3,), (2,), ()))
    )
    if not pictures.images:
        return Paint(colors, lost=tuple(pictures.lost))
    return Paint(colors, places, shown, tuple(pictures.images), tuple(pictures.lost))


def _paint_object(each: Object, pictures: Pictures, package: Package) -> tuple[npt.NDArray[np.generic], ...]:
    """What :meth:`Groups.paint` gives, for the triangles of an object."""
    group, index = each.look
    count = len(each.indices) // 3
    groups, corners = np.full(count, group), np.full((count, 3), index)
    told = np.frombuffer(each.looks, np.int32).reshape(-1, 5) if each.looks else np.empty((0, 5), np.int32)
    groups[told[:, 0]], corners[told[:, 0]] = told[:, 1], told[:, 2:]
    colors, places, shown = each.groups.paint(groups, corners, pictures, package.read)
    return colors, places.astype(np.float32), shown.astype(np.int16)
