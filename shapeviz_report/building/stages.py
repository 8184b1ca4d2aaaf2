"""What workers compute: functions for their processes, and a :class:`Stage` for each.

The functions take and return bytes and numbers. They know neither the database's folder nor the cache, so a
worker may be on any machine.
"""

from __future__ import annotations

import gzip
import io
import json
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt
from threadpoolctl import threadpool_limits

from shapeviz_report.cache import make_key
from shapeviz_report.clusters import Partition, part
from shapeviz_report.copies import Outline, compare, outline
from shapeviz_report.copies import Surface as LaidOut
from shapeviz_report.database.formats import split_name
from shapeviz_report.descriptors import Surface
from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
from shapeviz_report.errors import MeshError
from shapeviz_report.features import (
    compute_histograms,
    describe,
    find_bins,
    measure,
    sample_values,
)
from shapeviz_report.glb import encode_glb
from shapeviz_report.global_descriptors import PosedShape
from shapeviz_report.global_descriptors.registry import ALL_GLOBAL_DESCRIPTORS
from shapeviz_report.mesh import clean, content_hash, parse_mesh, parse_painted, prepare, read_paint
from shapeviz_report.mesh.clean import bounding_diagonal
from shapeviz_report.models import pack_model, simplify
from shapeviz_report.neighbours import RELATED, find_related
from shapeviz_report.plugins import find_plugins
from shapeviz_report.projections import project
from shapeviz_report.projections.registry import ALL_PROJECTIONS
from shapeviz_report.render import (
    Renderer,
    choose_view,
    mark_colors,
    render_painted,
    render_thumbnail,
    value_colors,
)
from shapeviz_report.retrieval import rate_subsets
from shapeviz_report.scorers import Contest, score_separation
from shapeviz_report.scorers.registry import ALL_SCORERS
from shapeviz_report.search import SubsetMaps, map_subsets
from shapeviz_report.search.bins import BinSpace, find_minimal_bins, hold_out, select_bins
from shapeviz_report.types import (
    BinSelection,
    BinStep,
    FloatArray,
    HeldOutBins,
    IntArray,
    Match,
    Mesh,
    MinimalBins,
    MinimalSet,
    Rating,
    ShapeFacts,
    UpAxis,
)
from shapeviz_report.versions import (
    find_closure,
    function_version,
    library_versions,
    plugin_versions,
    source_version,
)

R = TypeVar("R")


def examine_shape(files: Mapping[str, bytes]) -> bytes:
    """What would be repaired in a mesh file, what is lost of its colours, and its outline, for :func:`read_examined`.

    Parameters
    ----------
    files : mapping of str to bytes
        As :func:`~shapeviz_report.mesh.collect_files` finds them.
    """
    try:
        read, paint = parse_painted(files)
        mesh, repairs = clean(read)
    except MeshError as error:
        return _pack_arrays(note=np.array(json.dumps({"refused": str(error)})))
    lost = () if paint is None else read_paint(paint)[1]
    note = {"repairs": repairs, "lost": lost, "sha256": content_hash(files)}
    return _pack_arrays(note=np.array(json.dumps(note)), values=outline(mesh))


class Examined(NamedTuple):
    """What is known of a mesh file that can be used: what would be repaired and how often, what is lost of its colours
    and why, and its outline."""

    repairs: dict[str, int]
    lost: tuple[str, ...]
    outline: Outline


def read_examined(examined: bytes) -> Examined:
    """What :func:`examine_shape` found. Raises :class:`MeshError` with the reason if the mesh cannot be used."""
    arrays = _read_arrays(examined)
    note = json.loads(str(arrays["note"]))
    if "refused" in note:
        raise MeshError(note["refused"])
    return Examined(note["repairs"], tuple(note["lost"]), Outline(note["sha256"], arrays["values"]))


def compare_shapes(first: Mapping[str, bytes], second: Mapping[str, bytes]) -> bytes:
    """Whether two mesh files are the same shape, for :func:`read_match`."""
    with threadpool_limits(limits=1):
        match = compare(_lay_out(first), _lay_out(second))
    return json.dumps(None if match is None else asdict(match)).encode()


def compare_all(files: Mapping[str, Mapping[str, bytes]], pairs: Sequence[tuple[str, str]]) -> list[bytes]:
    """What :func:`compare_shapes` finds of some pairs of mesh files, in their order."""
    return [compare_shapes(files[first], files[second]) for first, second in pairs]


MOST_LAID_OUT = 500_000
"""Faces of all surfaces that a worker keeps at hand: some 125 MB."""

_laid_out: dict[str, LaidOut] = {}


def _lay_out(files: Mapping[str, bytes]) -> LaidOut:
    """A mesh file ready to be compared: of shapes that are compared one after the other, many are the same."""
    name = identify(files)
    surface = _laid_out.pop(name, None)
    if surface is None:
        mesh = parse_mesh(files)
        surface = LaidOut(clean(mesh)[0], bounding_diagonal(mesh))
    _laid_out[name] = surface
    while len(_laid_out) > 2 and sum(len(kept.triangles) for kept in _laid_out.values()) > MOST_LAID_OUT:
        del _laid_out[next(iter(_laid_out))]
    return surface


def read_match(content: bytes) -> Match | None:
    """What :func:`compare_shapes` found; None for shapes that differ."""
    fields = json.loads(content)
    return None if fields is None else Match(**fields)


def prepare_shape(files: Mapping[str, bytes], edge_length: float) -> bytes:
    """A mesh file prepared, as an archive for the other functions.

    A mesh that cannot be used gives an archive too, with the reason: so that it costs its time only once.
    """
    try:
        mesh, facts = prepare(files, edge_length)
        return _pack(mesh, {"facts": asdict(facts)})
    except MeshError as error:
        return _pack(Mesh(np.empty((0, 3)), np.empty((0, 3), np.int32)), {"refused": str(error)})


def tell_facts(prepared: bytes) -> bytes:
    """What is known of a prepared shape, or why there is none, for :func:`read_facts`: a thousandth of the mesh."""
    with np.load(io.BytesIO(prepared), allow_pickle=False) as archive:
        return str(archive["note"]).encode()


def read_facts(told: bytes) -> ShapeFacts:
    """The facts of a prepared shape. Raises :class:`MeshError` with the reason if it cannot be used."""
    note = json.loads(told)
    if "refused" in note:
        raise MeshError(note["refused"])
    return ShapeFacts(**note["facts"] | {"extents": tuple(note["facts"]["extents"])})


def sample_shape(prepared: bytes, count: int) -> bytes:
    """Descriptor values at ``count`` vertices of a prepared shape; an array (count, dimensions) as a file."""
    return _pack_array(sample_values(_unpack(prepared), count))


def describe_shape(
    prepared: bytes, view: bytes, edges: FloatArray, by_area: bool, faces: int, clay: bool
) -> bytes:
    """The features of a prepared shape, for :func:`read_features`, and its model, for :func:`read_model`.

    Parameters
    ----------
    prepared : bytes
    view : bytes
        As :func:`view_shape` found it.
    edges : (dimensions, 11) float64 array
    by_area : bool
    faces : int
        Of the model.
    clay : bool
        Leave out the colours of the model.
    """
    mesh = _unpack(prepared)
    model = simplify(mesh, faces)
    features, bins = describe(mesh, edges, model.source, by_area=by_area)
    # Level 9 would save a fortieth of the bytes for eight times the time.
    colors = None if clay or mesh.colors is None else mesh.colors[model.source]
    packed = gzip.compress(pack_model(model, bins, read_array(view), colors), compresslevel=6, mtime=0)
    return _pack_arrays(features=features, model=np.frombuffer(packed, np.uint8))


def export_shape(
    prepared: bytes, view: bytes, faces: int | None, dimensions: Mapping[str, int], clay: bool
) -> bytes:
    """A prepared shape as binary glTF.

    Parameters
    ----------
    prepared : bytes
    view : bytes
        As :func:`view_shape` found it.
    faces : int or None
        To which it is simplified; None for all of it.
    dimensions : mapping of str to int
        Attributes of the vertices, and the dimension of the descriptors that each holds.
    clay : bool
        Leave out its colours.
    """
    mesh = _unpack(prepared)
    values = measure(mesh, list(dimensions.values()))
    vertices, triangles = mesh.vertices, mesh.faces
    colors = None if clay else mesh.colors
    if faces is not None:
        model = simplify(mesh, faces)
        vertices, triangles, values = model.vertices, model.faces, values[:, model.source]
        colors = None if colors is None else colors[model.source]
    return encode_glb(
        vertices, triangles, read_array(view), dict(zip(dimensions, values, strict=True)), colors
    )


def describe_whole_shape(prepared: bytes) -> bytes:
    """The features of a prepared shape as a whole, for :func:`read_array`."""
    with threadpool_limits(limits=1):
        shape = PosedShape(_unpack(prepared))
        return _pack_array(
            np.concatenate([descriptor.compute(shape) for descriptor in ALL_GLOBAL_DESCRIPTORS])
        )


def measure_shape(prepared: bytes, edges: FloatArray, by_area: bool) -> bytes:
    """The features of a prepared shape alone, for :func:`read_array`."""
    return _pack_array(compute_histograms(_unpack(prepared), edges, by_area=by_area))


def measure_vertices(prepared: bytes) -> bytes:
    """A prepared shape with the values of all descriptors at every vertex, for :func:`read_vertices`."""
    mesh = _unpack(prepared)
    values = measure(mesh, range(sum(descriptor.dimensions for descriptor in ALL_DESCRIPTORS)))
    return _pack_arrays(vertices=mesh.vertices, faces=mesh.faces, areas=Surface(mesh).areas, values=values)


def read_vertices(content: bytes) -> dict[str, npt.NDArray[Any]]:
    """``vertices``, ``faces``, ``areas`` (n,) and ``values`` (D, n) in a result of :func:`measure_vertices`."""
    return _read_arrays(content)


def read_features(described: bytes) -> FloatArray:
    """The features, one value a column, in a result of :func:`describe_shape`."""
    return _read_arrays(described)["features"]


def read_model(described: bytes) -> bytes:
    """The model in a result of :func:`describe_shape`, packed and gzipped."""
    return _read_arrays(described)["model"].tobytes()


def read_array(content: bytes) -> npt.NDArray[Any]:
    """The array in a result of :func:`sample_shape`, :func:`view_shape`, :func:`measure_shape`,
    :func:`describe_whole_shape`, :func:`project_features` or :func:`score_bins`."""
    return np.load(io.BytesIO(content), allow_pickle=False)


def view_shape(prepared: bytes, up: UpAxis | None) -> bytes:
    """From where a prepared shape is shown; a rotation (3, 3) as a file.

    Which axis points up, who builds the site knows best; then the file; then it is guessed.
    """
    return _pack_array(choose_view(_unpack(prepared), up or read_facts(tell_facts(prepared)).up))


def render_shape(prepared: bytes, view: bytes, size: int, renderer: Renderer, clay: bool) -> bytes:
    """The thumbnail of a prepared shape, as :func:`view_shape` found it: a WebP image of ``size`` x ``size`` pixels."""
    return render_thumbnail(_unpack(prepared), read_array(view), size=size, renderer=renderer, clay=clay)


def paint_shape(
    prepared: bytes,
    view: bytes,
    edges: FloatArray,
    bins: Sequence[tuple[int, int]],
    size: int,
    renderer: Renderer,
) -> bytes:
    """Bins painted on a prepared shape, for :func:`read_paintings`.

    Parameters
    ----------
    prepared : bytes
    view : bytes
        As :func:`view_shape` found it.
    edges : (dimensions, 11) float64 array
    bins : sequence of (int, int)
        Dimension and bin, both from 0.
    size : int
        Of the pictures, in pixels.
    renderer : Renderer
    """
    mesh = _unpack(prepared)
    dimensions = sorted({dimension for dimension, _ in bins})
    values = measure(mesh, dimensions)
    falls = find_bins(values, edges[dimensions])
    colorings = [value_colors(row, edges[dimension]) for row, dimension in zip(values, dimensions)]
    colorings += [mark_colors(falls[dimensions.index(dimension)] == place) for dimension, place in bins]
    pictures = render_painted(mesh, read_array(view), colorings, size=size, renderer=renderer)
    by_dimension = dict(zip(dimensions, pictures))
    inside = pictures[len(dimensions) :]
    return _pack_arrays(
        **{
            f"value {n}": np.frombuffer(by_dimension[dimension], np.uint8)
            for n, (dimension, _) in enumerate(bins)
        },
        **{f"inside {n}": np.frombuffer(picture, np.uint8) for n, picture in enumerate(inside)},
    )


def read_paintings(painted: bytes) -> list[tuple[bytes, bytes]]:
    """The pictures of the value and of the inside of every bin in a result of :func:`paint_shape`."""
    arrays = _read_arrays(painted)
    return [
        (arrays[f"value {n}"].tobytes(), arrays[f"inside {n}"].tobytes()) for n in range(len(arrays) // 2)
    ]


def generate_shape(class_name: str, index: int, seed: int) -> bytes:
    """One shape of the demo database, as an OFF file."""
    # No other build needs it, and it takes long to import.
    from shapeviz_report.demo import encode_shape

    return encode_shape(class_name, index, seed)


def project_features(method: str, values: FloatArray, seed: int) -> bytes:
    """Lay out the rows of ``values`` with the method of that name; an array (n, 2) as a file."""
    return _pack_array(project(next(m for m in ALL_PROJECTIONS if m.name == method), values, (), seed).xy)


def relate_shapes(values: FloatArray) -> bytes:
    """The rows most similar to each of ``values`` by neighbourhood; an array (n, m) as a file. See
    :func:`~shapeviz_report.neighbours.find_related`."""
    return _pack_array(find_related(values, RELATED))


def cluster_features(values: FloatArray, seed: int) -> bytes:
    """The rows of ``values`` in groups, for :func:`read_partition`; see :func:`shapeviz_report.clusters.part`."""
    found = part(values, seed=seed)
    if found is None:
        return _pack_arrays()
    return _pack_arrays(of=found.of, quality=np.array([found.silhouette, found.steadiness]))


def read_partition(content: bytes) -> Partition | None:
    """The groups in a result of :func:`cluster_features`; None where there are none."""
    arrays = _read_arrays(content)
    return Partition(arrays["of"], *arrays["quality"].tolist()) if arrays else None


def map_features(squared: npt.NDArray[np.float32], method: str, seed: int, subsets: tuple[int, ...]) -> bytes:
    """Maps of some subsets of the features, for :func:`read_maps`; see :func:`~shapeviz_report.search.map_subsets`."""
    maps = map_subsets(squared, method, seed, subsets)
    return _pack_arrays(xy=maps.xy, cpu_seconds=maps.cpu_seconds)


def read_maps(content: bytes) -> SubsetMaps:
    """The maps in a result of :func:`map_features`."""
    return SubsetMaps(**_read_arrays(content))


def score_bins(values: FloatArray, members: Sequence[int], others: Sequence[int], seed: int) -> bytes:
    """Relative scores of every column by every scorer, for some rows against others; an array (scorers, columns) of
    float32 as a file."""
    contests = [Contest(np.array(members), np.array(others))]
    with threadpool_limits(limits=1):
        scores = [score_separation(scorer, values, contests, seed=seed) for scorer in ALL_SCORERS]
    return _pack_array(np.array(scores, dtype=np.float32))


def search_bins(
    task: str, space: BinSpace, labels: Sequence[str | None], options: Mapping[str, Any]
) -> bytes:
    """A part of the search for bins, for the function of its name below.

    Parameters
    ----------
    task : str
        ``select``, ``hold out`` or ``separate``: a function of :mod:`shapeviz_report.search.bins`.
    space, labels
        Its first arguments.
    options : mapping of str to object
        Its other arguments.
    """
    functions: dict[str, Callable[..., BinSelection | HeldOutBins | MinimalBins]] = {
        "select": select_bins,
        "hold out": hold_out,
        "separate": find_minimal_bins,
    }
    with threadpool_limits(limits=1):
        found = functions[task](space, labels, **options)
    return json.dumps(asdict(found), default=_array_to_json).encode()


def retrieve(squared: FloatArray, codes: IntArray, subsets: tuple[int, ...]) -> bytes:
    """How well some subsets of the features find shapes of a class, for :func:`read_ratings`; see
    :func:`~shapeviz_report.retrieval.rate_subsets`."""
    ratings = rate_subsets(squared, codes, subsets)
    return _pack_arrays(
        scores=np.array([rating.scores for rating in ratings]),
        precision=np.array([rating.precision for rating in ratings]),
    )


def read_ratings(content: bytes) -> list[Rating]:
    """The rating of each subset in a result of :func:`retrieve`."""
    arrays = _read_arrays(content)
    return [Rating(*parts) for parts in zip(arrays["scores"], arrays["precision"], strict=True)]


def read_found_bins(content: bytes) -> Any:
    """What :func:`search_bins` found: a :class:`BinSelection`, :class:`HeldOutBins` or :class:`MinimalBins`."""
    fields = json.loads(content, object_hook=_from_json)
    if "path" in fields:
        return BinSelection(**fields | {"path": tuple(BinStep(**step) for step in fields["path"])})
    if "sets" in fields:
        return MinimalBins(**fields | {"sets": tuple(MinimalSet(**found) for found in fields["sets"])})
    return HeldOutBins(**fields)


PATIENCE = 20.0
"""Times the time limit of a mesh that a question of the whole database may take: an hour and a half, for what takes
minutes on a machine that has nothing else to do."""


@dataclass(frozen=True)
class Stage(Generic[R]):
    """All that is known of a stage whose results are kept.

    Attributes
    ----------
    name : str
        As times and failures have it.
    doing : str
        What people read while it runs.
    folder : str
        Of the cache.
    compute : callable
        A function of this module that returns bytes, the result.
    read : callable
        Turns a result into a value. May raise :class:`MeshError`.
    failing : str
        What is said where a ``{task}`` that fails for a ``{reason}`` ends the build; empty where none does.
    """

    name: str
    doing: str
    folder: str
    compute: Callable[..., bytes]
    read: Callable[[bytes], R]
    failing: str = ""

    @property
    def version(self) -> str:
        """A name for the code behind the results."""
        return function_version(self.compute)

    @property
    def patience(self) -> float:
        """Times the time limit of a mesh that a task may take: where one that fails ends the build, more."""
        return PATIENCE if self.failing else 1.0

    def key(self, *inputs: object) -> str:
        """A name for the result of some inputs, whose ``repr`` must tell them apart."""
        return make_key(*inputs, self.version)


def identify(files: Mapping[str, bytes]) -> str:
    """What of a mesh file decides how it is read: its format and its content."""
    return f"{split_name(next(iter(files)))[1]} {content_hash(files)}"


EXAMINE = Stage("examine", "Outlining meshes", "examined", examine_shape, read_examined)
COMPARE = Stage("compare", "Comparing look-alikes", "compared", compare_shapes, read_match)
PREPARE = Stage("prepare", "Preparing meshes", "prepared", prepare_shape, bytes)
FACTS = Stage("prepare", "Preparing meshes", "facts", tell_facts, read_facts)
SAMPLE = Stage("sample", "Finding value ranges", "sampled", sample_shape, read_array)
DESCRIBE = Stage("describe", "Describing shapes", "described", describe_shape, read_features)
EXPORT = Stage("export", "Exporting shapes", "exported", export_shape, bytes)
MEASURE = Stage("describe", "Describing shapes", "measured", measure_shape, read_array)
DESCRIBE_WHOLE = Stage(
    "describe", "Describing whole shapes", "described-whole", describe_whole_shape, read_array
)
MEASURE_VERTICES = Stage(
    "describe", "Describing vertices", "measured-vertices", measure_vertices, read_vertices
)
VIEW = Stage("render", "Choosing views", "viewed", view_shape, read_array)
RENDER = Stage("render", "Drawing thumbnails", "rendered", render_shape, bytes)
GENERATE = Stage(
    "generate", "Generating shapes", "generated", generate_shape, bytes,
    "The demo shape {task} cannot be made: {reason}.",
)  # fmt: skip
CLUSTER = Stage(
    "cluster", "Finding clusters", "clustered", cluster_features, read_partition,
    "Clustering the shapes failed: {reason}.",
)  # fmt: skip
PROJECT = Stage(
    "project", "Projecting", "projected", project_features, read_array,
    "The projection {task} failed: {reason}.",
)  # fmt: skip
RELATE = Stage(
    "relate", "Finding neighbourhoods", "related", relate_shapes, read_array,
    "Finding the neighbourhoods of the shapes failed: {reason}.",
)  # fmt: skip
SEARCH = Stage(
    "search", "Searching features", "searched", map_features, read_maps,
    "The search for the best features failed: {reason}; --search none leaves it out.",
)  # fmt: skip
SCORE = Stage(
    "bins", "Scoring bins", "scored", score_bins, read_array,
    "Scoring the bins for the class {task!r} failed: {reason}.",
)  # fmt: skip
SELECT = Stage(
    "select", "Searching bins", "selected", search_bins, read_found_bins,
    "The search for bins failed: {reason}; --search none leaves it out.",
)  # fmt: skip
RETRIEVE = Stage(
    "retrieve", "Rating retrieval", "retrieved", retrieve, read_ratings,
    "Rating the retrieval failed: {reason}.",
)  # fmt: skip
PAINT = Stage(
    "paint", "Painting bins", "painted", paint_shape, read_paintings,
    "Painting bins on {task} failed: {reason}.",
)  # fmt: skip


def fingerprint() -> dict[str, str]:
    """The versions of all that can decide a result, by name, equal on machines that give the same ones."""
    closure = find_closure(__name__)
    return {
        "shapeviz-report": f"{version('shapeviz-report')}, code {source_version(__name__)[:8]}",
        **{plugin.package: plugin.version for plugin in find_plugins()},
        "code of plug-ins": make_key(*plugin_versions(closure.modules))[:8],
        "Python": f"{sys.version_info.major}.{sys.version_info.minor}",
        **dict(text.split(" ") for text in library_versions(closure.libraries)),
    }


def _pack(mesh: Mesh, note: dict[str, object]) -> bytes:
    arrays = {} if mesh.colors is None else {"colors": mesh.colors}
    return _pack_arrays(vertices=mesh.vertices, faces=mesh.faces, note=np.array(json.dumps(note)), **arrays)


def _unpack(prepared: bytes) -> Mesh:
    """A prepared mesh. Raises :class:`MeshError` with the reason if there is none."""
    with np.load(io.BytesIO(prepared), allow_pickle=False) as archive:
        note = json.loads(str(archive["note"]))
        if "refused" in note:
            raise MeshError(note["refused"])
        return Mesh(archive["vertices"], archive["faces"], colors=archive.get("colors"))


def _pack_arrays(**arrays: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    np.savez(buffer, allow_pickle=False, **arrays)
    return buffer.getvalue()


def _read_arrays(content: bytes) -> dict[str, Any]:
    with np.load(io.BytesIO(content), allow_pickle=False) as archive:
        return dict(archive)


def _pack_array(values: npt.NDArray[Any]) -> bytes:
    buffer = io.BytesIO()
    np.save(buffer, values)
    return buffer.getvalue()


def _array_to_json(values: npt.NDArray[Any]) -> dict[str, object]:
    return {"array": values.tolist(), "dtype": str(values.dtype)}


def _from_json(fields: dict[str, Any]) -> Any:
    """An array where :func:`_array_to_json` made the object; else its fields, lists as tuples."""
    if fields.keys() == {"array", "dtype"}:
        return np.array(fields["array"], fields["dtype"])
    return {name: tuple(value) if isinstance(value, list) else value for name, value in fields.items()}
