"""What a build reads: the database with what its owner says of it, and features of the owner's own."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from shapeviz_report.bins import read_bins
from shapeviz_report.building import stages
from shapeviz_report.building.chains import Chain, Plan
from shapeviz_report.config import Config
from shapeviz_report.database import Listing, read_database
from shapeviz_report.errors import ConfigError, MeshError
from shapeviz_report.external import load_coordinates, load_external
from shapeviz_report.features import BLOCKS
from shapeviz_report.glb import find_dimensions
from shapeviz_report.mesh import collect_files
from shapeviz_report.plugins import same_name
from shapeviz_report.presets import GLOBAL_BLOCKS, PRESETS
from shapeviz_report.projections.registry import ALL_PROJECTIONS, TAKEN_NAMES
from shapeviz_report.publication import licence_warning, read_publication
from shapeviz_report.types import Database, FeatureBlock, FloatArray, Publication


def read_published(source: Path | Listing, config: Config, publication: Publication) -> Database:
    """The database, with what its owner should know before it is published."""
    database = read_database(
        source,
        layout=config.layout,
        labeling=config.labeling,
        name=config.title,
        outside=config.outside,
        besides=(*config.external, *config.coordinates),
    )
    warning = licence_warning(publication, database.shapes)
    return database if warning is None else replace(database, warnings=(*database.warnings, warning))


@dataclass(frozen=True)
class Inputs:
    """What a build is given.

    Attributes
    ----------
    database : Database
    publication : Publication
    external : tuple of (FeatureBlock, (n, w) float64 array)
        Features of the owner's own, a row a shape of the database.
    maps : mapping of str to (n, 2) float64 array
        Maps of the owner's own, by name, a row a shape of the database.
    bins : tuple of str or None
        That maps are to compare; None for all.
    gltf_dimensions : mapping of str to int
        As :func:`~shapeviz_report.glb.find_dimensions` gives it.
    """

    database: Database
    publication: Publication
    external: tuple[tuple[FeatureBlock, FloatArray], ...]
    maps: Mapping[str, FloatArray]
    bins: tuple[str, ...] | None
    gltf_dimensions: Mapping[str, int]


def read_inputs(source: Path | Listing, config: Config) -> Inputs:
    """All that a build is given but the meshes. Raises a ``ShapevizError`` that says what cannot be used."""
    publication = read_publication(config)
    database = read_published(source, config, publication)
    external = load_all_external(config.external, database)
    blocks = (*PRESETS[config.preset].blocks, *(block for block, _ in external))
    return Inputs(
        database=database,
        publication=publication,
        external=tuple(external),
        maps=load_all_coordinates(config.coordinates, database),
        bins=None if config.bins is None else read_bins(config.bins, blocks),
        gltf_dimensions=find_dimensions(config.gltf_values),
    )


def load_all_external(paths: Sequence[Path], database: Database) -> list[tuple[FeatureBlock, FloatArray]]:
    """Features from files of the owner's own, each a block of its name. Raises ``ConfigError``."""
    taken = {block.name for block in (*BLOCKS, *GLOBAL_BLOCKS)}
    ids = [shape.id for shape in database.shapes]
    result = []
    for path in paths:
        name = path.stem
        if name in taken:
            raise ConfigError(f"there is already a feature named {name!r}; rename the file {path}")
        taken.add(name)
        values = load_external(path, ids)
        result.append((FeatureBlock(name, values.shape[1], 1), values))
    return result


def load_all_coordinates(paths: Sequence[Path], database: Database) -> dict[str, FloatArray]:
    """Maps from files of the owner's own, (n, 2), by name. Raises ``ConfigError``."""
    taken = {same_name(text) for method in ALL_PROJECTIONS for text in (method.name, method.title)} | {
        *TAKEN_NAMES
    }
    ids = [shape.id for shape in database.shapes]
    maps = {}
    for path in paths:
        name = path.stem
        if not name.isidentifier():
            raise ConfigError(
                f"the map of the file {path} would be called {name!r}, and files and columns after it: rename the file "
                "to letters, digits and _, a letter first"
            )
        if same_name(name) in taken:
            raise ConfigError(f"there is already a map named {name!r}; rename the file {path}")
        taken.add(same_name(name))
        maps[name] = load_coordinates(path, ids)
    return maps


class MeshFiles:
    """The files of the shapes of a database, each as it was when it was first read: what is found of a shape belongs
    together.

    Parameters
    ----------
    database : Database
    outside : bool
        Whether meshes may lie outside its folder.
    """

    def __init__(self, database: Database, *, outside: bool) -> None:
        self._paths = {shape.id: shape.path.absolute() for shape in database.shapes}
        self._within = None if outside else database.root
        self._read_as: dict[str, str] = {}

    def read(self, shape: str) -> dict[str, bytes]:
        """As :func:`~shapeviz_report.mesh.collect_files` finds them.

        Raises
        ------
        MeshError
            Also if they are no longer what they were.
        """
        files = collect_files(self._paths[shape], self._within)
        found = stages.identify(files)
        if self._read_as.setdefault(shape, found) != found:
            raise MeshError("it was changed while it was used; run the same command again")
        return files


def plan_examining(read: Callable[[str], Mapping[str, bytes]]) -> Callable[[str], Plan]:
    """How the mesh file of a shape is examined, which a function reads."""

    def plan(shape: str) -> Plan:
        files = read(shape)
        chain = Chain(stages.identify(files))
        chain.add(stages.EXAMINE)
        return chain, files

    return plan
