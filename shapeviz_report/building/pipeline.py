"""The stages of a build, in their order."""

from __future__ import annotations

import logging
import platform
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from pathlib import Path

import numpy as np

from shapeviz_report.agreement import weigh
from shapeviz_report.bins import scale_bins
from shapeviz_report.building.comparing import find_copies
from shapeviz_report.building.guard import check_meshes, check_places
from shapeviz_report.building.measuring import nothing_usable, tabulate
from shapeviz_report.building.progress import Clock, Progress, QuietProgress
from shapeviz_report.building.questions import (
    find_clusters,
    lay_out_best,
    paint_all,
    project_all,
    rate_all,
    relate_all,
    score_all,
    search_all_bins,
    search_subsets,
)
from shapeviz_report.building.reading import MeshFiles, read_inputs
from shapeviz_report.building.runner import Runner, name_files
from shapeviz_report.building.scoring import score_maps
from shapeviz_report.building.shapes import ShapeMaker
from shapeviz_report.building.workers import open_drawing
from shapeviz_report.cache import Cache, default_root
from shapeviz_report.config import Config
from shapeviz_report.database import Listing
from shapeviz_report.distinct import rate_without_copies
from shapeviz_report.errors import DatabaseError
from shapeviz_report.exemplars import choose_exemplars
from shapeviz_report.pages.base import thumbnail_size
from shapeviz_report.plugins import find_plugins
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.projections import bring_along, squared_distances
from shapeviz_report.search import make_space
from shapeviz_report.types import Painting, Report, group_copies
from shapeviz_report.writing import ShownReport, write_site
from shapeviz_report.writing.hosts import note

logger = logging.getLogger(__name__)

CLUSTERS = "clusters"
"""What the labeling is called that stands in for labels."""

LIBRARIES = (
    "numpy", "scipy", "numba", "scikit-learn", "umap-learn", "mmgpy", "trimesh", "pyrender-maintained", "altair",
)  # fmt: skip
"""The libraries whose versions the site states."""


def build_report(
    source: Path | Listing, destination: Path, config: Config, progress: Progress | None = None
) -> Report:
    """Build the site of a shape database.

    Parameters
    ----------
    source : Path or Listing
        Folder, table or data frame; see ``docs/using/databases.md``.
    destination : Path
        Folder of the site: absent, empty, or a site of ours, which is replaced at once when all is done.
    config : Config
    progress : Progress, optional

    Returns
    -------
    Report
        What the site shows.

    Raises
    ------
    ShapevizError
        Nothing could be built; an existing site is left as it is.
    """
    root = (config.cache or default_root()).absolute()
    check_places(destination, config, root, Path(source))
    clock = Clock(progress or QuietProgress())
    with clock.stage("read", "Reading the database"):
        given = read_inputs(source, config)
        database, bins = given.database, given.bins
        check_meshes(destination, database)
        config = replace(config, thumbnail_size=thumbnail_size(config, len(database.shapes)))
        heavy = note(len(database.shapes), config)
        if heavy is not None and not config.single_file:
            logger.warning("Note: %s", heavy)
        if config.gltf is not None and config.single_file:
            logger.warning("Note: a site in one file holds no glTF; build a folder to have it")
    preset = PRESETS[config.preset]
    cache = Cache(root)
    failures = list(database.failures)

    with open_drawing(config) as (executor, renderer):
        run = Runner(executor, clock, cache, name_files(database), failures, config)
        files = MeshFiles(database, outside=config.outside)
        meshes = {s.id: partial(files.read, s.id) for s in database.shapes}
        maker = ShapeMaker(run, meshes, config, renderer, given.gltf_dimensions)
        made = maker.make()
        places = {s.id: row for row, s in enumerate(database.shapes) if s.id in made.shapes}
        if not places:
            raise DatabaseError(*nothing_usable(Path(source), failures))
        shapes = tuple(database.shapes[row] for row in places.values())
        of_shape = [made.shapes[s.id] for s in shapes]
        features = weigh(tabulate(made.rows, places, preset, given.external), preset)
        scaled = scale(features, preset)

        copies = find_copies(run, files.read, {s.id: one.outline for s, one in zip(shapes, of_shape)})
        groups = group_copies(copies, [s.id for s in shapes])
        labeling = database.labelings[0] if database.labelings else None
        labels = tuple(s.labels.get(labeling) if labeling is not None else None for s in shapes)
        stand_in = not any(label is not None for label in labels)
        clusters = find_clusters(run, shapes, features, scaled, made.edges, config, stand_in=stand_in)
        if stand_in and clusters is not None:
            labeling = CLUSTERS
            labels = tuple(clusters.clusters[code].name for code in clusters.of)

        space = make_space(features, scaled, labels, seed=config.seed)
        mapped = scaled if bins is None else scale_bins(features, preset, bins)
        projections = project_all(run, space, features, bins, mapped, config.seed)
        projections |= {name: bring_along(name, xy[list(places.values())]) for name, xy in given.maps.items()}
        first = next(iter(projections.values()))
        related = relate_all(run, scaled)
        search = search_subsets(run, space, labels, groups, config)
        best = None
        if search is not None:
            best = lay_out_best(run, search, features, bins, scaled, config, first)

        scores = score_all(run, compared_values(features, preset), labels, config.seed)
        found = search_all_bins(run, features, scaled, labels, groups, config)
        chosen = bins if bins is not None else found.automatic.bins if found is not None else None
        by_bins = scale_bins(features, preset, chosen) if chosen else None
        retrieval = rate_all(run, space, labels, search, chosen or None, by_bins)
        paintings: tuple[Painting, ...] = ()
        if found is not None:
            exemplars = choose_exemplars(found, features, labels, scaled, first.xy, config.neighbours)
            paintings = paint_all(run, features, exemplars, partial(maker.plan_painting, made.edges))
    cache.tell()
    with clock.stage("score", "Scoring maps"):
        scored = score_maps(projections, mapped, labels, best, config)
        distances = {"everything": space.squared.sum(axis=0, dtype=np.float64)}
        if by_bins is not None:
            distances["bins"] = squared_distances(by_bins[space.rows])
        without_copies = rate_without_copies(
            groups,
            labels,
            {name: projection.xy for name, projection in projections.items()},
            config.neighbours,
            space.rows,
            distances,
            search,
            found.automatic if found is not None else None,
        )

    report = ShownReport(
        database=database,
        shapes=shapes,
        facts=tuple(one.facts for one in of_shape),
        thumbnails=tuple(one.picture for one in of_shape),
        labeling=labeling,
        labels=labels,
        features=features,
        edges=made.edges,
        projections=scored.maps,
        failures=tuple(failures),
        parameters=config.as_parameters() | {"renderer": renderer},
        versions=name_versions(config),
        seconds=clock.seconds,
        cpu_seconds=clock.cpu_seconds,
        search=search,
        scores=scores,
        bins=found,
        retrieval=retrieval,
        paintings=paintings,
        models=maker.recall_models(made, shapes) if config.meshes else None,
        exported=maker.recall_exported(made, shapes),
        clusters=clusters,
        publication=given.publication,
        copies=copies,
        without_copies=without_copies,
        faithfulness=scored.faithfulness,
        related=related,
        separation=scored.separation,
        best=scored.best,
    )
    with clock.stage("write", "Writing the site"):
        write_site(report, destination, single_file=config.single_file)
    return report


def name_versions(config: Config) -> dict[str, str]:
    """The versions that the site states, by name."""
    libraries = ("shapeviz-report", *LIBRARIES, *(("pyarrow",) if config.parquet else ()))
    return (
        {name: version(name) for name in libraries}
        | {plugin.package: plugin.version for plugin in find_plugins()}
        | {"python": platform.python_version()}
    )
