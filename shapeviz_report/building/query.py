"""A new shape as a query: the shapes of a built site that are most similar to a mesh.

The mesh goes through the same stages as those of the database, with the parameters that the site states, and is
compared with the features that the site holds for download. ``docs/method/retrieval.md`` says what similar means.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Integral
from pathlib import Path
from typing import Any

from shapeviz_report.bins import read_bins
from shapeviz_report.building.describing import measure_mesh
from shapeviz_report.building.guard import check_cache
from shapeviz_report.building.progress import Progress, QuietProgress
from shapeviz_report.config import Config
from shapeviz_report.errors import ConfigError
from shapeviz_report.similarity import rank_similar, typical_distance
from shapeviz_report.types import ShapeFacts
from shapeviz_report.writing.data import SiteData, read_site


@dataclass(frozen=True)
class FoundShape:
    """A shape of the site that resembles the query.

    Attributes
    ----------
    id, name : str
    label : str or None
        Its class in the site's active labeling.
    file : str
        Its mesh, relative to the database's folder.
    distance : float
        As :class:`~shapeviz_report.similarity.SimilarShape` has it.
    closer : mapping of str to float
        Feature -> the share of all other shapes that are farther from the query by this feature alone.
    """

    id: str
    name: str
    label: str | None
    file: str
    distance: float
    closer: Mapping[str, float]


@dataclass(frozen=True)
class QueryResult:
    """What a query found.

    Attributes
    ----------
    database : str
        Its name.
    shapes : int
        That were compared with the query.
    facts : ShapeFacts
        Of the query.
    features : tuple of str or None
        What was compared; None where it was bins.
    bins : tuple of str or None
        What was compared; None where it was features.
    left_out : tuple of str
        Features, or bins of a site of chosen bins, that would have been compared by default, but come from a file that
        was brought along to the build, so that a mesh alone has no values for them.
    typical : float
        How far two shapes of the database are apart, as a root mean square over all pairs.
    found : tuple of FoundShape
        By rising distance.
    """

    database: str
    shapes: int
    facts: ShapeFacts
    features: tuple[str, ...] | None
    bins: tuple[str, ...] | None
    left_out: tuple[str, ...]
    typical: float
    found: tuple[FoundShape, ...]


def find_similar(
    site: Path,
    mesh: Path,
    *,
    features: Sequence[str] | None = None,
    bins: Path | None = None,
    count: int = 10,
    cache: Path,
    time_limit: float,
    memory_limit: int | None = None,
    progress: Progress | None = None,
) -> QueryResult:
    """The shapes of a site that are most similar to a mesh.

    Parameters
    ----------
    site : Path
        Folder of a site that this version has built.
    mesh : Path
        A mesh file.
    features : sequence of str, optional
        What to compare; by default what the maps of the site compare.
    bins : Path, optional
        Compare the bins that this file names instead; see :func:`~shapeviz_report.bins.read_bins`.
    count : int
        Most shapes to find, at least 1.
    cache : Path
        Where results are kept.
    time_limit : float
        Seconds for one stage.
    memory_limit : int, optional
        Bytes of memory for the worker process; by default most of what is free.
    progress : Progress, optional

    Raises
    ------
    SiteError
        The folder is not a site, or of another version.
    MeshError
        The mesh cannot be used.
    ConfigError
        A feature or bin is not there, or only a build has it.
    CacheError
        Results cannot be kept in the cache.
    """
    if not isinstance(count, Integral) or count < 1:
        raise ConfigError(f"the number of shapes to find must be a whole number from 1 on, not {count}")
    if isinstance(features, str):
        raise ConfigError(
            f"features are a list of names, such as ['PFH', 'FPFH'], and not the text {features!r}"
        )
    check_cache(cache, None)
    opened = read_site(site)
    chosen, names, left_out = _choose(opened, features, bins)
    config = Config(
        edge_length=opened.summary["parameters"]["edge_length"],
        time_limit=time_limit,
        memory_limit=None if memory_limit is None else memory_limit / 2**30,
        jobs=1,
        cache=cache,
    )
    table, preset = opened.table, opened.preset
    facts, values = measure_mesh(mesh, config, preset, opened.edges, progress or QuietProgress())
    compared: dict[str, Any] = {chosen: names}
    similar = rank_similar(table, preset, values, **compared, count=count)
    blocks = [block.name for block in table.blocks]
    found = (
        FoundShape(
            id=opened.shapes[shape.row]["id"],
            name=opened.shapes[shape.row]["name"],
            label=opened.shapes[shape.row]["class"] or None,
            file=opened.shapes[shape.row]["file"],
            distance=shape.distance,
            closer=dict(zip(blocks, shape.closer.tolist(), strict=True)),
        )
        for shape in similar
    )
    return QueryResult(
        database=opened.summary["database"],
        shapes=len(table.values),
        facts=facts,
        features=names if chosen == "features" else None,
        bins=names if chosen == "bins" else None,
        left_out=left_out,
        typical=typical_distance(table, preset, **compared),
        found=tuple(found),
    )


def _choose(
    site: SiteData, features: Sequence[str] | None, bins: Path | None
) -> tuple[str, tuple[str, ...], tuple[str, ...]]:
    """Whether ``features`` or ``bins`` are compared, which, and what is left out of those the site compares."""
    if features is not None and bins is not None:
        raise ConfigError("features and bins are two ways to say what to compare: choose one")
    own = {block.name for block in site.brought}
    own_columns = {column for block in site.brought for column in block.columns}
    if bins is not None:
        names = read_bins(bins, (*site.table.blocks, *site.brought))
        for name in names:
            if name in own_columns:
                raise ConfigError(f"the file of bins {bins} names {name!r}, {_BROUGHT}")
        return "bins", names, ()
    if features is not None:
        there = [block.name for block in site.table.blocks]
        for name, times in Counter(features).items():
            if name in own:
                raise ConfigError(f"the feature {name!r} cannot be compared: it is {_BROUGHT}")
            if name not in there:
                raise ConfigError(f"there is no feature {name!r}; there are: {', '.join(there)}")
            if times > 1:
                raise ConfigError(f"the feature {name!r} is named {times} times")
        if not features:
            raise ConfigError(f"no feature is named; there are: {', '.join(there)}")
        return "features", tuple(name for name in there if name in features), ()
    projection = next(iter(site.summary["projections"].values()))
    if projection["bins"] is None:
        return "features", tuple(block.name for block in site.table.blocks), tuple(sorted(own))
    names = tuple(name for name in projection["bins"] if name not in own_columns)
    if not names:
        raise ConfigError(
            f"the site {site.folder} compares only values that were brought along to its build, which a mesh alone "
            "does not have; say with features or bins what to compare"
        )
    return "bins", names, tuple(name for name in projection["bins"] if name in own_columns)


_BROUGHT = "which was brought along to the build as a file: a mesh alone has no value for it"
