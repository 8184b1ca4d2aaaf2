"""The stages of a build, in their order."""

from __future__ import annotations

import platform
from collections.abc import Iterator, Sequence
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from shapeviz_report.agreement import weigh
from shapeviz_report.bins import read_bins, scale_bins
from shapeviz_report.building import stages
from shapeviz_report.building.guard import check_meshes, check_places
from shapeviz_report.building.progress import Clock, Progress, QuietProgress
from shapeviz_report.building.questions import (
    find_clusters,
    find_copies,
    lay_out_best,
    paint_all,
    project_all,
    rate_all,
    relate_all,
    score_all,
    search_all_bins,
    search_subsets,
)
from shapeviz_report.building.reading import load_all_external, plan_examining, read_published
from shapeviz_report.building.runner import Runner, Task
from shapeviz_report.building.workers import open_executor
from shapeviz_report.cache import Cache, default_root
from shapeviz_report.config import Config
from shapeviz_report.distinct import rate_without_copies
from shapeviz_report.errors import DatabaseError
from shapeviz_report.exemplars import choose_exemplars
from shapeviz_report.faithfulness import rate_maps
from shapeviz_report.features import fixed_edges, quantile_edges
from shapeviz_report.mesh import collect_files
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.projections import squared_distances
from shapeviz_report.publication import read_publication
from shapeviz_report.quality import score
from shapeviz_report.render import check_renderer
from shapeviz_report.search import make_space
from shapeviz_report.separation import rate_separation
from shapeviz_report.types import Failure, FeatureTable, Painting, Projection, Quality, Report, group_copies
from shapeviz_report.writing import write_site

SAMPLED_VERTICES = 400_000
"""Vertices behind data-driven histogram ranges, over all shapes."""

SAMPLED_OF_A_SHAPE = (16, 1000)
"""The least and most of these of one shape."""

CLUSTERS = "clusters"
"""What the labeling is called that stands in for labels."""

PAINTING_SIZE = 320
"""Width and height of a picture of a bin, in pixels."""

LIBRARIES = (
    "numpy", "scipy", "numba", "scikit-learn", "umap-learn", "mmgpy", "trimesh", "pyrender-maintained", "altair",
)  # fmt: skip
"""The libraries whose versions the site states."""


def build_report(
    database_path: Path, destination: Path, config: Config, progress: Progress | None = None
) -> Report:
    """Build the site of a shape database.

    Parameters
    ----------
    database_path : Path
        Folder or table; see ``docs/using/databases.md``.
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
    check_places(destination, config, root, database_path)
    check_renderer()
    clock = Clock(progress or QuietProgress())
    with clock.stage("read", "Reading the database"):
        publication = read_publication(config)
        database = read_published(database_path, config, publication)
        check_meshes(destination, database)
        external = load_all_external(config.external, len(database.shapes))
        preset = PRESETS[config.preset]
        blocks = (*preset.blocks, *(block for block, _ in external))
        bins = None if config.bins is None else read_bins(config.bins, blocks)
    cache = Cache(root)
    failures = list(database.failures)

    with open_executor(config) as executor:
        run = Runner(executor, clock, cache, database, failures, config)
        paths = {s.id: s.path.absolute() for s in database.shapes}
        within = None if config.outside else database.root

        def plan_preparing(shape: str) -> Task:
            files = collect_files(paths[shape], within)
            key = stages.PREPARE.key(stages.identify(paths[shape], files), config.edge_length)
            return Task(key, lambda: (files, config.edge_length))

        prepared = run.each(stages.PREPARE, paths, plan_preparing)

        def plan(stage: stages.Stage[Any], shape: str, *options: Any) -> Task:
            """A task that starts from the prepared mesh."""
            source = prepared[shape].key
            key = stage.key(source, *(o.tobytes() if isinstance(o, np.ndarray) else o for o in options))
            return Task(
                key, lambda: (run.recall(stages.PREPARE, source, lambda: plan_preparing(shape)), *options)
            )

        if preset.fixed_ranges:
            edges = fixed_edges()
        else:
            share = int(np.clip(SAMPLED_VERTICES // max(1, len(prepared)), *SAMPLED_OF_A_SHAPE))
            samples = run.each(stages.SAMPLE, prepared, lambda s: plan(stages.SAMPLE, s, share))
            edges = quantile_edges([s.value for s in samples.values()]) if samples else fixed_edges()
        pictures = run.each(
            stages.RENDER, prepared, lambda s: plan(stages.RENDER, s, config.thumbnail_size, config.up)
        )
        views = {shape: result.value[1] for shape, result in pictures.items()}

        def plan_describing(shape: str) -> Task:
            return plan(stages.DESCRIBE, shape, views[shape], edges, preset.by_area)

        described = run.each(stages.DESCRIBE, pictures, plan_describing)
        measured = {shape: [result.value] for shape, result in described.items()}
        if preset.whole:
            whole = run.each(stages.DESCRIBE_WHOLE, described, lambda s: plan(stages.DESCRIBE_WHOLE, s))
            measured = {shape: [*measured[shape], result.value] for shape, result in whole.items()}
        shapes = tuple(s for s in database.shapes if s.id in measured)
        if not shapes:
            raise DatabaseError(*_nothing_usable(database_path, failures))
        examined = run.each(stages.EXAMINE, measured, plan_examining(paths, within))
        copies = find_copies(run, paths, within, examined)
        groups = group_copies(copies, [s.id for s in shapes])
        rows = [i for i, s in enumerate(database.shapes) if s.id in measured]
        features = FeatureTable(
            tuple(s.id for s in shapes),
            blocks,
            np.column_stack(
                [
                    [np.concatenate(measured[s.id]) for s in shapes],
                    *(values[rows] for _, values in external),
                ]
            ),
        )
        features = weigh(features, preset)
        scaled = scale(features, preset)
        labeling = database.labelings[0] if database.labelings else None
        labels = tuple(s.labels.get(labeling) if labeling is not None else None for s in shapes)
        stand_in = not any(label is not None for label in labels)
        clusters = find_clusters(run, shapes, features, scaled, edges, config, stand_in=stand_in)
        if stand_in and clusters is not None:
            labeling = CLUSTERS
            labels = tuple(clusters.clusters[code].name for code in clusters.of)
        space = make_space(features, scaled, labels, seed=config.seed)
        mapped = scaled if bins is None else scale_bins(features, preset, bins)
        projections = project_all(run, space, features, bins, mapped, config.seed)
        related = relate_all(run, scaled)
        search = search_subsets(run, space, labels, groups, config)
        best = None
        if search is not None:
            first = next(iter(projections.values()))
            best = lay_out_best(run, search, features, bins, scaled, config, first)
        scores = score_all(run, compared_values(features, preset), labels, config.seed)
        found = search_all_bins(run, features, scaled, labels, groups, config)
        chosen = bins if bins is not None else found.automatic.bins if found is not None else None
        by_bins = scale_bins(features, preset, chosen) if chosen else None
        retrieval = rate_all(run, space, labels, search, chosen or None, by_bins)
        paintings: tuple[Painting, ...] = ()
        if found is not None:
            exemplars = choose_exemplars(
                found, features, labels, scaled, next(iter(projections.values())).xy, config.neighbours
            )

            def plan_painting(shape: int, bins: tuple[tuple[int, int], ...]) -> Task:
                name = shapes[shape].id
                return plan(stages.PAINT, name, views[name], edges, bins, PAINTING_SIZE)

            paintings = paint_all(run, features, exemplars, plan_painting)
    models = None
    if config.meshes:
        models = tuple(
            stages.read_model(
                run.recall(stages.DESCRIBE, described[s.id].key, partial(plan_describing, s.id))
            )
            for s in shapes
        )
    cache.tell()
    with clock.stage("score", "Scoring maps"):
        maps: dict[str, tuple[Projection, Quality]] = {
            name: (projection, score(projection.xy, labels, k=config.neighbours, seed=config.seed))
            for name, projection in projections.items()
        }
        shown = {name: projection.xy for name, projection in projections.items()}
        faithfulness = rate_maps(mapped, shown, config.neighbours)
        separation = rate_separation(mapped, shown, labels, config.neighbours, seed=config.seed)
        best_map = None
        if best is not None:
            found_map, compared = best
            quality = score(found_map.xy, labels, k=config.neighbours, seed=config.seed)
            rated = rate_maps(compared, {"best": found_map.xy}, config.neighbours)
            best_map = (found_map, quality, rated["best"])
        distances = {"everything": space.squared.sum(axis=0, dtype=np.float64)}
        if by_bins is not None:
            distances["bins"] = squared_distances(by_bins[space.rows])
        without_copies = rate_without_copies(
            groups,
            labels,
            shown,
            config.neighbours,
            space.rows,
            distances,
            search,
            found.automatic if found is not None else None,
        )
    report = Report(
        database=database,
        shapes=shapes,
        facts=tuple(prepared[s.id].value for s in shapes),
        thumbnails=tuple(pictures[s.id].value[0] for s in shapes),
        labeling=labeling,
        labels=labels,
        features=features,
        edges=edges,
        projections=maps,
        failures=tuple(failures),
        parameters=config.as_parameters(),
        versions={name: version(name) for name in ("shapeviz-report", *LIBRARIES)}
        | {"python": platform.python_version()},
        seconds=clock.seconds,
        cpu_seconds=clock.cpu_seconds,
        search=search,
        scores=scores,
        bins=found,
        retrieval=retrieval,
        paintings=paintings,
        models=models,
        clusters=clusters,
        publication=publication,
        copies=copies,
        without_copies=without_copies,
        faithfulness=faithfulness,
        related=related,
        separation=separation,
        best=best_map,
    )
    with clock.stage("write", "Writing the site"):
        write_site(report, destination, single_file=config.single_file)
    return report


def _nothing_usable(path: Path, failures: Sequence[Failure]) -> Iterator[str]:
    """The lines of a message."""
    yield f"None of the files in {path} can be used:"
    yield from (f"  {failure.path}: {failure.reason}" for failure in failures[:5])
    if len(failures) > 5:
        yield f"  and {len(failures) - 5} more"
