"""Features without a site: of one mesh, of meshes at hand, of a database."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.building.guard import check_cache
from shapeviz_report.building.measuring import Measured, find_edges, measure_meshes, nothing_usable, tabulate
from shapeviz_report.building.progress import Clock, Progress, QuietProgress
from shapeviz_report.building.reading import MeshFiles, load_all_external, read_published
from shapeviz_report.building.runner import Runner, name_files
from shapeviz_report.building.workers import open_executor
from shapeviz_report.cache import Cache, default_root
from shapeviz_report.config import Config
from shapeviz_report.database import Listing
from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
from shapeviz_report.errors import DatabaseError, MeshError
from shapeviz_report.features import fixed_edges
from shapeviz_report.mesh import collect_files
from shapeviz_report.mesh.memory import encode_mesh
from shapeviz_report.presets import PRESETS, Preset
from shapeviz_report.publication import read_publication
from shapeviz_report.types import (
    Database,
    Failure,
    FeatureTable,
    FloatArray,
    IntArray,
    ShapeEntry,
    ShapeFacts,
)


@dataclass(frozen=True)
class DescribedMesh:
    """What is measured of one mesh.

    Attributes
    ----------
    facts : ShapeFacts
        Of the mesh as it came, and of what was mended.
    vertices : (n, 3) float64 array
    faces : (m, 3) int32 array
        The surface that was measured: cleaned, remeshed to even edges, centred, and scaled into the unit ball.
    areas : (n,) float64 array
        Of the surface around each vertex.
    values : mapping of str to (n, d) float32 array
        At every vertex, by the name of the descriptor, such as ``"Agd"``.
    edges : mapping of str to (d, 11) float64 array
        The bin edges of the histograms, by the same names.
    features : FeatureTable
        One row: what a site has of the shape.
    """

    facts: ShapeFacts
    vertices: FloatArray
    faces: IntArray
    areas: FloatArray
    values: Mapping[str, npt.NDArray[np.float32]]
    edges: Mapping[str, FloatArray]
    features: FeatureTable


@dataclass(frozen=True)
class DescribedDatabase:
    """What is measured of a database.

    Attributes
    ----------
    database : Database
    shapes : tuple of ShapeEntry
        Those that could be measured: a row of the features each.
    features : FeatureTable
    edges : (D, 11) float64 array
        Of the histograms.
    failures : tuple of Failure
    """

    database: Database
    shapes: tuple[ShapeEntry, ...]
    features: FeatureTable
    edges: FloatArray
    failures: tuple[Failure, ...]


def describe_mesh(mesh: Any, config: Config) -> DescribedMesh:
    """Everything that is measured of a mesh: at its vertices, and as a whole.

    Parameters
    ----------
    mesh : path, or what :func:`~shapeviz_report.mesh.memory.encode_mesh` takes
    config : Config

    Raises
    ------
    MeshError
        The mesh cannot be used.
    CacheError
        Results cannot be kept in the cache.
    """
    preset, edges = PRESETS["default"], fixed_edges()
    name, measured = _measure(mesh, config, preset, edges, QuietProgress(), vertices=True)
    arrays = measured.vertices[name]
    names = [descriptor.name for descriptor in ALL_DESCRIPTORS]
    ends = np.cumsum([descriptor.dimensions for descriptor in ALL_DESCRIPTORS])[:-1]
    return DescribedMesh(
        facts=measured.facts[name],
        vertices=arrays["vertices"],
        faces=arrays["faces"],
        areas=arrays["areas"],
        values={name: part.T for name, part in zip(names, np.split(arrays["values"], ends), strict=True)},
        edges=dict(zip(names, np.split(edges, ends), strict=True)),
        features=FeatureTable((name,), preset.blocks, measured.rows[name][None]),
    )


def measure_mesh(
    mesh: Any, config: Config, preset: Preset, edges: FloatArray, progress: Progress
) -> tuple[ShapeFacts, FloatArray]:
    """The facts of a mesh, and its row of features; see :func:`describe_mesh`."""
    name, measured = _measure(mesh, config, preset, edges, progress, vertices=False)
    return measured.facts[name], measured.rows[name]


def describe_database(
    source: Path | Listing, config: Config, progress: Progress | None = None
) -> DescribedDatabase:
    """The features of a database, by the stages that they need and no others.

    Raises
    ------
    ShapevizError
        The database cannot be read, or none of its meshes can be used.
    """
    progress = progress or QuietProgress()
    clock = Clock(progress)
    with clock.stage("read", "Reading the database"):
        database = read_published(source, config, read_publication(config))
        external = load_all_external(config.external, database)
    preset, failures = PRESETS[config.preset], list(database.failures)
    files = MeshFiles(database, outside=config.outside)
    meshes = {s.id: partial(files.read, s.id) for s in database.shapes}
    with open_run(config, name_files(database), failures, progress, Path(source)) as run:
        edges, kept = find_edges(run, meshes, preset, config.edge_length)
        rows = measure_meshes(run, kept, preset, edges, config.edge_length).rows
    places = {shape.id: row for row, shape in enumerate(database.shapes) if shape.id in rows}
    if not places:
        raise DatabaseError(*nothing_usable(Path(source), failures))
    shapes = tuple(database.shapes[row] for row in places.values())
    features = tabulate(rows, places, preset, external)
    return DescribedDatabase(database, shapes, features, edges, tuple(failures))


@contextmanager
def open_run(
    config: Config,
    files: Mapping[str, str],
    failures: list[Failure],
    progress: Progress,
    database: Path | None = None,
) -> Iterator[Runner]:
    """What runs stages and keeps their results, without a site; parameters as for
    :class:`~shapeviz_report.building.runner.Runner`.

    Raises
    ------
    CacheError
        Results cannot be kept where the options say, or would be read as part of the database.
    """
    root = (config.cache or default_root()).absolute()
    check_cache(root, database)
    cache = Cache(root)
    with open_executor(config) as executor:
        yield Runner(executor, Clock(progress), cache, files, failures, config)
    cache.tell()


def _measure(
    mesh: Any, config: Config, preset: Preset, edges: FloatArray, progress: Progress, *, vertices: bool
) -> tuple[str, Measured]:
    """What a mesh is called, and what is found of it under this name. Raises :class:`MeshError`."""
    name = name_mesh(mesh)
    failures: list[Failure] = []
    with open_run(config, {name: name}, failures, progress) as run:
        measured = measure_meshes(
            run, {name: partial(read_files, mesh)}, preset, edges, config.edge_length, vertices=vertices
        )
    if failures:
        raise MeshError(f"the mesh {name} cannot be used: {failures[0].reason}")
    return name, measured


def read_files(mesh: Any) -> Mapping[str, bytes]:
    """The files of a mesh that is a path, or is in memory. Raises :class:`MeshError`."""
    return collect_files(Path(mesh)) if isinstance(mesh, str | os.PathLike) else encode_mesh(mesh)


def name_mesh(mesh: Any) -> str:
    """What a mesh is called: its path, or its type."""
    return os.fsdecode(mesh) if isinstance(mesh, str | os.PathLike) else f"({type(mesh).__name__})"
