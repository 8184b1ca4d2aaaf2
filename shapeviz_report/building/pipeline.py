"""The stages of a build, in their order."""

from __future__ import annotations

import logging
import platform
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import Any, overload

import numpy as np

from shapeviz_report.agreement import weigh
from shapeviz_report.bins import read_bins, scale_bins
from shapeviz_report.building import stages
from shapeviz_report.building.chains import Chain, Plan
from shapeviz_report.building.guard import check_meshes, check_places
from shapeviz_report.building.measuring import nothing_usable, sampled_of_each
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
from shapeviz_report.building.reading import (
    MeshFiles,
    load_all_coordinates,
    load_all_external,
    read_published,
)
from shapeviz_report.building.runner import Made, Runner, name_files
from shapeviz_report.building.workers import find_renderer, open_executor
from shapeviz_report.cache import Cache, default_root
from shapeviz_report.config import Config
from shapeviz_report.copies import Outline
from shapeviz_report.database import Listing
from shapeviz_report.distinct import rate_without_copies
from shapeviz_report.errors import DatabaseError
from shapeviz_report.exemplars import choose_exemplars
from shapeviz_report.faithfulness import rate_maps
from shapeviz_report.features import fixed_edges, quantile_edges
from shapeviz_report.glb import find_dimensions
from shapeviz_report.models import faces_of_model
from shapeviz_report.pages.base import thumbnail_size
from shapeviz_report.plugins import find_plugins
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.projections import bring_along, squared_distances
from shapeviz_report.publication import read_publication
from shapeviz_report.quality import score
from shapeviz_report.search import make_space
from shapeviz_report.separation import rate_separation
from shapeviz_report.types import (
    Exported,
    FeatureTable,
    FloatArray,
    Painting,
    Projection,
    Quality,
    Report,
    ShapeFacts,
    group_copies,
)
from shapeviz_report.writing import ShownReport, write_site
from shapeviz_report.writing.hosts import note

logger = logging.getLogger(__name__)

CLUSTERS = "clusters"
"""What the labeling is called that stands in for labels."""

PAINTING_SIZE = 320
"""Width and height of a picture of a bin, in pixels."""

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
        publication = read_publication(config)
        database = read_published(source, config, publication)
        check_meshes(destination, database)
        config = replace(config, thumbnail_size=thumbnail_size(config, len(database.shapes)))
        heavy = note(len(database.shapes), config)
        if heavy is not None and not config.single_file:
            logger.warning("Note: %s", heavy)
        external = load_all_external(config.external, database)
        own_maps = load_all_coordinates(config.coordinates, database)
        preset = PRESETS[config.preset]
        blocks = (*preset.blocks, *(block for block, _ in external))
        bins = None if config.bins is None else read_bins(config.bins, blocks)
        exported = find_dimensions(config.gltf_values)
    cache = Cache(root)
    failures = list(database.failures)

    renderer = find_renderer(config)
    with open_executor(config, renderer) as executor:
        run = Runner(executor, clock, cache, name_files(database), failures, config)
        meshes = MeshFiles(database, outside=config.outside)
        ids = [s.id for s in database.shapes]

        def plan(shape: str) -> Plan:
            files = meshes.read(shape)
            chain = Chain(stages.identify(files))
            chain.add(stages.PREPARE, (), config.edge_length)
            chain.add(stages.FACTS, [stages.PREPARE])
            chain.add(stages.EXAMINE)
            chain.add(stages.VIEW, [stages.PREPARE], config.up)
            chain.add(
                stages.RENDER, [stages.PREPARE, stages.VIEW], config.thumbnail_size, renderer, config.clay
            )
            if edges is None:
                chain.add(stages.SAMPLE, [stages.PREPARE], share)
            else:
                chain.add(
                    stages.DESCRIBE, [stages.PREPARE, stages.VIEW], edges, preset.by_area, faces, config.clay
                )
                if exports:
                    kept = faces if config.gltf == "decimated" else None
                    chain.add(stages.EXPORT, [stages.PREPARE, stages.VIEW], kept, exported, config.clay)
            if preset.whole:
                chain.add(stages.DESCRIBE_WHOLE, [stages.PREPARE])
            return chain, files

        # a site in one file has no place for them
        exports: list[stages.Stage[Any]] = [stages.EXPORT] if config.gltf and not config.single_file else []
        described: list[stages.Stage[Any]] = [
            stages.DESCRIBE,
            *([stages.DESCRIBE_WHOLE] if preset.whole else []),
        ]
        width = sum(block.width for block in preset.blocks)
        values = np.empty((len(ids), width))
        row = {shape: number for number, shape in enumerate(ids)}
        facts: dict[str, ShapeFacts] = {}
        outlines: dict[str, Outline] = {}
        pictures: dict[str, bytes] = {}
        models: dict[str, str] = {}
        files: dict[str, tuple[str, str]] = {}
        samples: dict[str, FloatArray] = {}

        def take(shape: str, chain: Chain, found: dict[stages.Stage[Any], Any]) -> None:
            if stages.FACTS in found:
                facts[shape] = found[stages.FACTS]
                outlines[shape] = found[stages.EXAMINE].outline
                pictures[shape] = found[stages.RENDER]
            if stages.SAMPLE in found:
                samples[shape] = found[stages.SAMPLE]
            if stages.DESCRIBE in found:
                values[row[shape]] = np.concatenate([found[stage] for stage in described])
                models[shape] = chain.key(stages.DESCRIBE)
                if exports:
                    name = f"{sha256(found[stages.EXPORT]).hexdigest()[:20]}.glb"
                    files[shape] = (name, chain.key(stages.EXPORT))

        looks: list[stages.Stage[Any]] = [stages.FACTS, stages.EXAMINE, stages.RENDER]
        share = sampled_of_each(len(ids))
        edges = fixed_edges() if preset.fixed_ranges else None
        faces = faces_of_model(len(ids))
        if edges is not None:
            run.each("Measuring shapes", ids, [*looks, *described, *exports], plan, take)
        else:
            run.each("Preparing shapes", ids, [*looks, stages.SAMPLE], plan, take)
            kept = [shape for shape in ids if shape in samples]
            edges = quantile_edges([samples[shape] for shape in kept]) if kept else fixed_edges()
            run.each("Measuring shapes", kept, [*described, *exports], plan, take)
        shapes = tuple(s for s in database.shapes if s.id in models)
        if not shapes:
            raise DatabaseError(*nothing_usable(Path(source), failures))
        copies = find_copies(run, meshes.read, {s.id: outlines[s.id] for s in shapes})
        groups = group_copies(copies, [s.id for s in shapes])
        rows = [row[s.id] for s in shapes]
        features = FeatureTable(
            tuple(s.id for s in shapes),
            blocks,
            np.column_stack([values[rows], *(own[rows] for _, own in external)]),
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
        projections |= {name: bring_along(name, xy[rows]) for name, xy in own_maps.items()}
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

            def plan_painting(shape: str, bins: tuple[tuple[int, int], ...]) -> Plan:
                chain, files = plan(shape)
                chain.add(stages.PAINT, [stages.PREPARE, stages.VIEW], edges, bins, PAINTING_SIZE, renderer)
                return chain, files

            paintings = paint_all(run, features, exemplars, plan_painting)
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

    def recalled(
        stage: stages.Stage[Any], read: Callable[[bytes], bytes], keys: Iterable[str]
    ) -> Sequence[bytes]:
        made = [Made(s.id, key, partial(plan, s.id)) for s, key in zip(shapes, keys, strict=True)]
        return Recalled(run, stage, read, made)

    models_shown, exported_files = None, None
    if config.meshes:
        models_shown = recalled(stages.DESCRIBE, stages.read_model, [models[s.id] for s in shapes])
    if exports:
        names, keys = zip(*(files[s.id] for s in shapes), strict=True)
        exported_files = Exported(names, recalled(stages.EXPORT, bytes, keys))

    report = ShownReport(
        database=database,
        shapes=shapes,
        facts=tuple(facts[s.id] for s in shapes),
        thumbnails=tuple(pictures[s.id] for s in shapes),
        labeling=labeling,
        labels=labels,
        features=features,
        edges=edges,
        projections=maps,
        failures=tuple(failures),
        parameters=config.as_parameters() | {"renderer": renderer},
        versions={
            name: version(name)
            for name in ("shapeviz-report", *LIBRARIES, *(("pyarrow",) if config.parquet else ()))
        }
        | {plugin.package: plugin.version for plugin in find_plugins()}
        | {"python": platform.python_version()},
        seconds=clock.seconds,
        cpu_seconds=clock.cpu_seconds,
        search=search,
        scores=scores,
        bins=found,
        retrieval=retrieval,
        paintings=paintings,
        models=models_shown,
        exported=exported_files,
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


class Recalled(Sequence[bytes]):
    """What a stage made of each shape, read when asked for: 3D models of 100,000 are several gigabytes."""

    def __init__(
        self,
        run: Runner,
        stage: stages.Stage[Any],
        read: Callable[[bytes], bytes],
        made: Sequence[Made],
    ) -> None:
        self._run = run
        self._stage = stage
        self._read = read
        self._made = made

    def __len__(self) -> int:
        return len(self._made)

    @overload
    def __getitem__(self, place: int) -> bytes: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[bytes]: ...
    def __getitem__(self, place: int | slice) -> bytes | Sequence[bytes]:
        if isinstance(place, slice):
            return Recalled(self._run, self._stage, self._read, self._made[place])
        return self._read(self._run.recall(self._stage, self._made, place))
