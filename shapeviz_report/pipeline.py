"""The stages of a build, from reading a database to writing its site."""

from __future__ import annotations

import logging
import os
import platform
import time
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import Any, Protocol, TypeVar

import numpy as np
import numpy.typing as npt

from shapeviz_report import demo, stages
from shapeviz_report.bins import features_of, read_bins, scale_bins
from shapeviz_report.cache import Cache, default_root, discard
from shapeviz_report.clusters import Partition, describe_clusters
from shapeviz_report.config import SEARCHES, Config
from shapeviz_report.contrasts import choose_contrasts
from shapeviz_report.copies import Outline, join_copies, pair_outlines
from shapeviz_report.database import read_database
from shapeviz_report.distinct import rate_without_copies
from shapeviz_report.errors import CacheError, ConfigError, DatabaseError, MeshError, SiteError
from shapeviz_report.executor import Executor, LocalExecutor, memory_share
from shapeviz_report.features import (
    BINS,
    BLOCKS,
    PRESETS,
    compared_values,
    fixed_edges,
    load_external,
    quantile_edges,
    scale,
)
from shapeviz_report.mesh import collect_files
from shapeviz_report.order import classes_of
from shapeviz_report.places import explain, holds, tried
from shapeviz_report.projections import PROJECTIONS, align, squared_distances
from shapeviz_report.publication import licence_warning, read_publication
from shapeviz_report.quality import score
from shapeviz_report.render import check_renderer
from shapeviz_report.retrieval import query_classes, rate_chance
from shapeviz_report.scorers import SCORERS
from shapeviz_report.search import SearchSpace, SubsetMaps, make_space, planned_runs, search_features
from shapeviz_report.search.bins import affordable_deals, encode, make_bin_space, shuffle_labels
from shapeviz_report.search.certainty import deal_folds
from shapeviz_report.site import check_destination, write_site
from shapeviz_report.types import (
    BinScores,
    BinSearch,
    Clusters,
    Copy,
    Database,
    Failure,
    FeatureBlock,
    FeatureSearch,
    FeatureTable,
    FloatArray,
    IntArray,
    Match,
    Painting,
    Projection,
    Publication,
    Quality,
    Rating,
    Report,
    Retrieval,
    ShapeEntry,
    distinct_rows,
    group_copies,
)
from shapeviz_report.writing import write_atomically

logger = logging.getLogger(__name__)

SAMPLED_VERTICES = 400_000
"""Vertices behind data-driven histogram ranges, over all shapes."""

SAMPLED_OF_A_SHAPE = (16, 1000)
"""The least and most of these of one shape."""

SUBSETS_A_TASK = 16
"""Maps that a worker makes before it reports back: few enough to lose little, many enough to send distances seldom."""

RATINGS_A_TASK = 64
"""Subsets whose retrieval a worker rates before it reports back: each takes 2 to 150 milliseconds, by the number of
shapes, against up to 32 MB of distances that are sent along."""

SHUFFLES = 2
"""Folds that also meet labels dealt out at random. With labels without meaning the search takes twice the time, and two
folds of 56 shapes tell NH_s to 0.01."""

CLUSTERS = "clusters"
"""What the labeling is called that stands in for labels."""

PAINTING_SIZE = 320
"""Width and height of a picture of a bin, in pixels."""

Name = TypeVar("Name", bound=Hashable)

LIBRARIES = (
    "numpy", "scipy", "numba", "scikit-learn", "umap-learn", "mmgpy", "trimesh", "pyrender-maintained", "altair",
)  # fmt: skip
"""The libraries whose versions the site states."""


class Progress(Protocol):
    """Told how far a build is."""

    def stage(self, name: str, total: int) -> AbstractContextManager[Callable[[], None]]:
        """Enter a stage of ``total`` steps (0: unknown); the function it gives is called after each."""
        ...


class QuietProgress:
    """Progress as log records: one when a stage begins."""

    @contextmanager
    def stage(self, name: str, total: int) -> Iterator[Callable[[], None]]:
        """See :class:`Progress`."""
        logger.info("%s (%d)", name, total) if total else logger.info("%s", name)
        yield lambda: None


@dataclass
class Clock:
    """Wall-clock and CPU seconds a stage, in order of the stages."""

    progress: Progress
    seconds: dict[str, float] = field(default_factory=dict)
    cpu_seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, total: int = 0) -> Iterator[Callable[[float], None]]:
        """Time a stage; the function it gives takes the CPU seconds of a worker, once for each step done."""
        wall, cpu, workers = time.perf_counter(), time.process_time(), 0.0
        with self.progress.stage(name, total) as advance:

            def step(worker_cpu: float) -> None:
                nonlocal workers
                workers += worker_cpu
                advance()

            yield step
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - wall
        spent = time.process_time() - cpu + workers
        self.cpu_seconds[name] = self.cpu_seconds.get(name, 0.0) + spent


@dataclass(frozen=True)
class CheckResult:
    """What a build would read.

    Attributes
    ----------
    database : Database
        As it is laid out.
    repairs : mapping of str to dict
        Shape id -> what would be mended, for shapes that can be used.
    failures : tuple of Failure
        Files that cannot be used.
    copies : tuple of Copy
        Shapes that are the same shape again.
    """

    database: Database
    repairs: dict[str, dict[str, int]]
    failures: tuple[Failure, ...]
    copies: tuple[Copy, ...] = ()


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
    _check_places(destination, config, root, database_path)
    check_renderer()
    clock = Clock(progress or QuietProgress())
    with clock.stage("read"):
        publication = read_publication(config)
        database = _read_database(database_path, config, publication)
        _check_meshes(destination, database)
        external = _load_external(config.external, len(database.shapes))
        blocks = (*BLOCKS, *(block for block, _ in external))
        bins = None if config.bins is None else read_bins(config.bins, blocks)
    cache = Cache(root)
    failures = list(database.failures)
    preset = PRESETS[config.preset]

    with open_executor(config) as executor:
        run = _Runner(executor, clock, cache, database, failures, config)
        paths = {s.id: s.path.absolute() for s in database.shapes}
        within = None if config.outside else database.root

        def plan_preparing(shape: str) -> _Task:
            files = collect_files(paths[shape], within)
            key = stages.PREPARE.key(stages.identify(paths[shape], files), config.edge_length)
            return _Task(key, lambda: (files, config.edge_length))

        prepared = run("prepare", stages.PREPARE, paths, plan_preparing, stages.read_facts)

        def plan(stage: stages.Stage, shape: str, *options: Any) -> _Task:
            """A task that starts from the prepared mesh."""
            source = prepared[shape].key
            key = stage.key(source, *(o.tobytes() if isinstance(o, np.ndarray) else o for o in options))
            return _Task(
                key, lambda: (run.recall(stages.PREPARE, source, lambda: plan_preparing(shape)), *options)
            )

        if preset.fixed_ranges:
            edges = fixed_edges()
        else:
            share = int(np.clip(SAMPLED_VERTICES // max(1, len(prepared)), *SAMPLED_OF_A_SHAPE))
            samples = run(
                "sample", stages.SAMPLE, prepared, lambda s: plan(stages.SAMPLE, s, share), stages.read_array
            )
            edges = quantile_edges([s.value for s in samples.values()]) if samples else fixed_edges()
        pictures = run(
            "render",
            stages.RENDER,
            prepared,
            lambda s: plan(stages.RENDER, s, config.thumbnail_size, config.up),
            stages.read_picture,
        )
        views = {shape: result.value[1] for shape, result in pictures.items()}

        def plan_describing(shape: str) -> _Task:
            return plan(stages.DESCRIBE, shape, views[shape], edges, preset.by_area)

        described = run("describe", stages.DESCRIBE, pictures, plan_describing, stages.read_features)
        shapes = tuple(s for s in database.shapes if s.id in described)
        if not shapes:
            raise DatabaseError(*_nothing_usable(database_path, failures))
        examined = run(
            "examine", stages.EXAMINE, described, _plan_examining(paths, within), stages.read_examined
        )
        copies = _compare(run, paths, within, examined)
        groups = group_copies(copies, [s.id for s in shapes])
        rows = [i for i, s in enumerate(database.shapes) if s.id in described]
        features = FeatureTable(
            tuple(s.id for s in shapes),
            blocks,
            np.column_stack(
                [[described[s.id].value for s in shapes], *(values[rows] for _, values in external)]
            ),
        )
        scaled = scale(features, preset)
        labeling = database.labelings[0] if database.labelings else None
        labels = tuple(s.labels.get(labeling) if labeling is not None else None for s in shapes)
        stand_in = not any(label is not None for label in labels)
        clusters = _cluster(run, shapes, features, scaled, edges, config, stand_in=stand_in)
        if stand_in and clusters is not None:
            labeling = CLUSTERS
            labels = tuple(clusters.clusters[code].name for code in clusters.of)
        space = make_space(features, scaled, labels, seed=config.seed)
        mapped = scaled if bins is None else scale_bins(features, preset, bins)
        projections = _project(run, space, features, bins, mapped, config.seed)
        search = _search(run, space, labels, groups, config)
        scores = _score_bins(run, compared_values(features, preset), labels, config.seed)
        found = _search_bins(run, features, scaled, labels, groups, config)
        chosen = bins if bins is not None else found.automatic.bins if found is not None else None
        by_bins = scale_bins(features, preset, chosen) if chosen else None
        retrieval = _rate_retrieval(run, space, labels, search, chosen or None, by_bins)
        paintings: tuple[Painting, ...] = ()
        if found is not None:
            contrasts = choose_contrasts(
                found, features, labels, scaled, next(iter(projections.values())).xy, config.neighbours
            )

            def plan_painting(shape: int, bins: tuple[tuple[int, int], ...]) -> _Task:
                name = shapes[shape].id
                return plan(stages.PAINT, name, views[name], edges, bins, PAINTING_SIZE)

            paintings = _paint(run, features, contrasts, plan_painting)
    models = None
    if config.meshes:
        models = tuple(
            stages.read_model(
                run.recall(stages.DESCRIBE, described[s.id].key, partial(plan_describing, s.id))
            )
            for s in shapes
        )
    cache.tell()
    with clock.stage("score"):
        maps: dict[str, tuple[Projection, Quality]] = {
            name: (projection, score(projection.xy, labels, k=config.neighbours, seed=config.seed))
            for name, projection in projections.items()
        }
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
    )
    with clock.stage("write"):
        write_site(report, destination, single_file=config.single_file)
    return report


def build_demo(destination: Path, config: Config, progress: Progress | None = None) -> Report:
    """Generate the demo database below the cache and build its site; see :func:`build_report`."""
    _check_places(destination, config, (config.cache or default_root()).absolute(), None)
    check_renderer()
    progress = progress or QuietProgress()
    cache = Cache((config.cache or default_root()).absolute())
    root = cache.root / "demo" / f"{stages.GENERATE.version}-{config.seed}"
    shapes = [(c.name, i, config.seed) for c in demo.CLASSES for i in range(demo.PER_CLASS)]
    kept = {task: cache.load("generated", stages.GENERATE.key(*task)) for task in shapes}
    made = {task: content for task, content in kept.items() if content is not None}
    tasks = [task for task in shapes if task not in made]
    if tasks:
        with open_executor(config) as executor, progress.stage("generate", len(tasks)) as advance:
            for outcome in executor.run(stages.generate_shape, tasks):
                task = tasks[outcome.index]
                if outcome.reason is not None:
                    raise DatabaseError(f"The demo shape {task} cannot be made: {outcome.reason}.")
                cache.store("generated", stages.GENERATE.key(*task), outcome.value)
                made[task] = outcome.value
                advance()
    cache.tell()
    # The files that are read are written from what is kept, unless they are still the same.
    try:
        for (name, index, _), content in made.items():
            path = demo.shape_path(root, name, index)
            if not path.is_file() or path.is_symlink() or path.read_bytes() != content:
                discard(path)
                write_atomically(path, content)
    except OSError as error:
        raise CacheError(
            f"The demo shapes cannot be written to {root}: {error.strerror} ({error.filename}). Make room there, or "
            "name another folder with --cache."
        ) from error
    config = replace(config, title=config.title or "Demo shapes", licence=config.licence or "CC0-1.0", up="z")
    return build_report(root, destination, config, progress)


def check_database(database_path: Path, config: Config, progress: Progress | None = None) -> CheckResult:
    """Read a database and every mesh of it, without building anything; what is found is kept in the cache."""
    root = (config.cache or default_root()).absolute()
    check_cache(root, database_path)
    clock = Clock(progress or QuietProgress())
    with clock.stage("read"):
        database = _read_database(database_path, config, read_publication(config))
        external = _load_external(config.external, len(database.shapes))
        if config.bins is not None:
            read_bins(config.bins, (*BLOCKS, *(block for block, _ in external)))
    failures = list(database.failures)
    cache = Cache(root)
    with _open_workers(config, config.worker_count) as executor:
        run = _Runner(executor, clock, cache, database, failures, config)
        paths = {s.id: s.path.absolute() for s in database.shapes}
        within = None if config.outside else database.root

        examined = run("check", stages.EXAMINE, paths, _plan_examining(paths, within), stages.read_examined)
        copies = _compare(run, paths, within, examined)
    cache.tell()
    repairs = {shape: result.value[0] for shape, result in examined.items()}
    return CheckResult(database, repairs, tuple(failures), copies)


def _plan_examining(paths: Mapping[str, Path], within: Path | None) -> Callable[[str], _Task]:
    """How the mesh file of a shape is examined."""

    def plan(shape: str) -> _Task:
        files = collect_files(paths[shape], within)
        return _Task(stages.EXAMINE.key(stages.identify(paths[shape], files)), lambda: (files,))

    return plan


def check_cache(root: Path, database: Path | None) -> None:
    """Refuse a folder of kept results that cannot be written, or whose files a database would read as its own.

    Raises
    ------
    CacheError
    """
    if database is not None and os.path.isdir(database) and holds(database, root):
        below = root.resolve().relative_to(database.resolve()).parts
        if not any(part.startswith(".") for part in below):
            raise CacheError(
                f"the cache {root} lies in the database {database}, which would read it: name a folder elsewhere, or a "
                "hidden one, with --cache"
            )
    try:
        with tried(root):
            pass
    except OSError as error:
        raise CacheError(
            f"results cannot be kept in {root}: {explain(error)}. Name another folder with --cache"
        ) from error


def _check_places(destination: Path, config: Config, cache: Path, database: Path | None) -> None:
    """Refuse, before anything is computed, a place for the site or for results that cannot be written, or where
    writing would touch what the build reads."""
    kept = {"the cache": cache}
    if database is not None:
        kept["the database"] = database
    for name in ("introduction", "logo", "bins"):
        if (path := getattr(config, name)) is not None:
            kept[f"the file of the option {name}"] = path
    kept |= {f"the file {path.name} of the option external": path for path in config.external}
    check_destination(destination, single_file=config.single_file, kept=kept)
    if holds(cache, destination):
        raise SiteError(f"{destination} lies in the cache {cache}: choose another place for the site")
    check_cache(cache, database)


def _check_meshes(destination: Path, database: Database) -> None:
    """Refuse a site that would be written among the meshes it shows, wherever a table found them."""
    for folder in sorted({shape.path.parent for shape in database.shapes}):
        if holds(destination, folder):
            raise SiteError(
                f"{destination} holds meshes of the database (in {folder}): choose another place for the site"
            )


@contextmanager
def open_executor(config: Config) -> Iterator[Executor]:
    """The executor that a build is to use: the Dask cluster it names, or processes of this machine."""
    if config.scheduler is None:
        with _open_workers(config, config.worker_count) as local:
            yield local
        return
    from shapeviz_report.executor.cluster import DaskExecutor

    with DaskExecutor(
        config.scheduler, config.time_limit, config.memory_bytes, stages.fingerprint, check_renderer
    ) as cluster:
        yield cluster


def _open_workers(config: Config, jobs: int) -> LocalExecutor:
    return LocalExecutor(jobs, config.time_limit, config.memory_bytes or memory_share(config.worker_count))


@dataclass(frozen=True)
class _Task:
    """What a stage has to do for one shape.

    Attributes
    ----------
    key : str
        Of the result, in the cache.
    arguments : callable
        Gives the arguments of the stage's function; called only if there is no result yet.
    """

    key: str
    arguments: Callable[[], tuple[Any, ...]]


@dataclass(frozen=True)
class _Result:
    """What a stage found for one shape, and the key under which the cache has it."""

    key: str
    value: Any


class _Runner:
    """Runs one stage for many shapes, keeps what it finds, and turns what goes wrong into failures."""

    def __init__(
        self,
        executor: Executor,
        clock: Clock,
        cache: Cache,
        database: Database,
        failures: list[Failure],
        config: Config,
    ) -> None:
        self.executor = executor
        self._config = config
        self.clock = clock
        self._cache = cache
        self._paths = {s.id: _relative(s, database.root) for s in database.shapes}
        self._failures = failures

    def __call__(
        self,
        name: str,
        stage: stages.Stage,
        shapes: Iterable[str],
        plan: Callable[[str], _Task],
        read: Callable[[bytes], Any],
    ) -> dict[str, _Result]:
        """Find the results of a stage in the cache, or have them computed.

        Parameters
        ----------
        name : str
            Of the stage, as people see it.
        stage : Stage
        shapes : iterable of str
            Their ids.
        plan : callable
            The task of a shape; called when its turn comes. May raise :class:`MeshError`.
        read : callable
            Turns a kept result into a value. May raise :class:`MeshError`.

        Returns
        -------
        dict of str to _Result
            By shape id, in the order of ``shapes``; those that failed are missing.
        """
        ids = list(shapes)
        results: dict[str, _Result] = {}
        failed: dict[str, str] = {}
        with self.clock.stage(name, len(ids)) as step:

            def take(shape: str, key: str, content: bytes, cpu_seconds: float) -> None:
                try:
                    results[shape] = _Result(key, read(content))
                except MeshError as error:
                    failed[shape] = str(error)
                step(cpu_seconds)

            def drop(shape: str, reason: str, cpu_seconds: float) -> None:
                failed[shape] = reason
                step(cpu_seconds)

            self.find(stage, ids, plan, take, drop)
        # Workers finish in any order; the report must not show which.
        self._failures.extend(Failure(self._paths[i], name, failed[i]) for i in ids if i in failed)
        return {shape: results[shape] for shape in ids if shape in results}

    def find(
        self,
        stage: stages.Stage,
        names: Iterable[Name],
        plan: Callable[[Name], _Task],
        take: Callable[[Name, str, bytes, float], None],
        drop: Callable[[Name, str, float], None],
    ) -> None:
        """Find results in the cache or have them computed and kept, in any order.

        Parameters
        ----------
        stage : Stage
        names : iterable
            Of the tasks.
        plan : callable
            The task of a name; called when its turn comes. May raise :class:`MeshError`.
        take : callable
            Gets each name, key, result and CPU seconds spent on it.
        drop : callable
            Gets each name that has no result, the reason, and the CPU seconds spent on it.
        """
        sent: list[tuple[Name, str]] = []

        def open_tasks() -> Iterator[tuple[Any, ...]]:
            for name in names:
                try:
                    task = plan(name)
                except MeshError as error:
                    drop(name, str(error), 0.0)
                    continue
                except MemoryError:
                    drop(name, "it is larger than the memory that this machine has left", 0.0)
                    continue
                content = self._cache.load(stage.folder, task.key)
                if content is not None:
                    take(name, task.key, content, 0.0)
                    continue
                try:
                    arguments = [task.arguments()]
                except MeshError as error:
                    drop(name, str(error), 0.0)
                    continue
                sent.append((name, task.key))
                # they may be a gigabyte, and are not to be held while the next ones are made
                del task
                yield arguments.pop()

        for outcome in self.executor.run(stage.function, open_tasks()):
            name, key = sent[outcome.index]
            if outcome.reason is None:
                self._cache.store(stage.folder, key, outcome.value)
                take(name, key, outcome.value, outcome.cpu_seconds)
            else:
                drop(name, outcome.reason, outcome.cpu_seconds)

    def recall(self, stage: stages.Stage, key: str, plan: Callable[[], _Task]) -> bytes:
        """A result that was there a moment ago, computed anew if the cache has lost it.

        Parameters
        ----------
        stage : Stage
        key : str
        plan : callable
            Its task.

        Raises
        ------
        MeshError
            It cannot be had again: the mesh has changed or gone, or fails this time.
        """
        content = self._cache.load(stage.folder, key)
        if content is not None:
            return content
        task = plan()
        if task.key != key:
            raise MeshError("its file was changed while it was used; build again")
        # The executor may be in the middle of a stage, so this rare task has a worker of its own.
        with _open_workers(self._config, 1) as executor:
            (outcome,) = executor.run(stage.function, [task.arguments()])
        if outcome.reason is not None:
            raise MeshError(outcome.reason)
        self._cache.store(stage.folder, key, outcome.value)
        return outcome.value


def _compare(
    run: _Runner, paths: Mapping[str, Path], within: Path | None, examined: Mapping[str, _Result]
) -> tuple[Copy, ...]:
    """The shapes that are the same shape again; those whose comparison fails are taken for different."""
    outlines: dict[str, Outline] = {shape: result.value[1] for shape, result in examined.items()}
    certain, possible = pair_outlines(outlines)
    found: dict[tuple[str, str], Match | None] = {}
    with run.clock.stage("compare", len(possible)) as step:

        def plan(pair: tuple[str, str]) -> _Task:
            first, second = (collect_files(paths[shape], within) for shape in pair)
            names = [stages.identify(paths[shape], files) for shape, files in zip(pair, (first, second))]
            return _Task(stages.COMPARE.key(*names), lambda: (first, second))

        def take(pair: tuple[str, str], _: str, content: bytes, cpu_seconds: float) -> None:
            found[pair] = stages.read_match(content)
            step(cpu_seconds)

        def drop(pair: tuple[str, str], reason: str, cpu_seconds: float) -> None:
            logger.warning("Whether %s and %s are copies is not known: %s", *pair, reason)
            step(cpu_seconds)

        run.find(stages.COMPARE, possible, plan, take, drop)
    return join_copies(certain, found, list(outlines))


def _cluster(
    run: _Runner,
    shapes: Sequence[ShapeEntry],
    features: FeatureTable,
    scaled: FloatArray,
    edges: FloatArray,
    config: Config,
    *,
    stand_in: bool,
) -> Clusters | None:
    """Groups of the shapes by their features alone, with names."""
    found: list[Partition | None] = []
    with run.clock.stage("cluster", 1) as step:

        def plan(_: str) -> _Task:
            content = sha256(scaled.tobytes()).hexdigest()
            return _Task(
                stages.CLUSTER.key(scaled.shape, content, config.seed), lambda: (scaled, config.seed)
            )

        def take(_: str, __: str, content: bytes, cpu_seconds: float) -> None:
            found.append(stages.read_partition(content))
            step(cpu_seconds)

        def drop(_: str, reason: str, __: float) -> None:
            raise DatabaseError(f"Clustering the shapes failed: {reason}.")

        run.find(stages.CLUSTER, ["all"], plan, take, drop)
    (partition,) = found
    if partition is None:
        return None
    preset = PRESETS[config.preset]
    return describe_clusters(partition, shapes, features, scaled, edges, preset, stand_in=stand_in)


def _project(
    run: _Runner,
    space: SearchSpace,
    features: FeatureTable,
    bins: tuple[str, ...] | None,
    values: FloatArray,
    seed: int,
) -> dict[str, Projection]:
    """The map of every method from the scaled values of all columns or of some bins, turned to agree with the first."""
    names = features_of(features, features.columns if bins is None else bins)
    found: dict[str, FloatArray] = {}
    # Where the search takes all shapes, its map of all features is the map: t-SNE and UMAP make another one of sums
    # that differ in their last digits.
    whole = bins is None and len(space.rows) == len(values)
    shared = {m.name for m in PROJECTIONS if m.name in SEARCHES and whole}
    everything = (space.everything,)
    with run.clock.stage("project", len(PROJECTIONS)) as step:

        def plan(method: str) -> _Task:
            key = stages.PROJECT.key(method, values.shape, sha256(values.tobytes()).hexdigest(), seed)
            return _Task(key, lambda: (method, values, seed))

        def plan_shared(method: str) -> _Task:
            key = stages.SEARCH.key(space.key, method, seed, everything)
            return _Task(key, lambda: (space.squared, method, seed, everything))

        def take(method: str, _: str, content: bytes, cpu_seconds: float) -> None:
            if method in shared:
                found[method] = np.empty((len(values), 2))
                found[method][space.rows] = stages.read_maps(content).xy[0]
            else:
                found[method] = stages.read_array(content)
            step(cpu_seconds)

        def drop(method: str, reason: str, _: float) -> None:
            raise DatabaseError(f"The projection {method} failed: {reason}.")

        methods = [method.name for method in PROJECTIONS]
        run.find(stages.PROJECT, [m for m in methods if m not in shared], plan, take, drop)
        run.find(stages.SEARCH, [m for m in methods if m in shared], plan_shared, take, drop)
    maps = {method: Projection(method, names, seed, found[method], bins) for method in methods}
    return {method: align(maps[method], maps[methods[0]]) for method in methods}


def _search(
    run: _Runner, space: SearchSpace, labels: Sequence[str | None], groups: IntArray, config: Config
) -> FeatureSearch | None:
    """The search for the best subset of features, its maps made by the executor and kept."""
    if config.search == "none":
        return None
    with run.clock.stage("search", planned_runs(len(space.features), config.search) or 0) as step:

        def evaluate(seed: int, subsets: Sequence[int]) -> SubsetMaps:
            chunks = [tuple(subsets[i : i + SUBSETS_A_TASK]) for i in range(0, len(subsets), SUBSETS_A_TASK)]
            made: dict[tuple[int, ...], SubsetMaps] = {}

            def plan(chunk: tuple[int, ...]) -> _Task:
                key = stages.SEARCH.key(space.key, config.search, seed, chunk)
                return _Task(key, lambda: (space.squared, config.search, seed, chunk))

            def take(chunk: tuple[int, ...], _: str, content: bytes, cpu_seconds: float) -> None:
                made[chunk] = stages.read_maps(content)
                step(cpu_seconds)
                for _other in chunk[1:]:
                    step(0.0)

            def drop(_: tuple[int, ...], reason: str, __: float) -> None:
                raise DatabaseError(
                    f"The search for the best features failed: {reason}; --search none leaves it out."
                )

            run.find(stages.SEARCH, chunks, plan, take, drop)
            return SubsetMaps(
                np.concatenate([made[chunk].xy for chunk in chunks]),
                np.concatenate([made[chunk].cpu_seconds for chunk in chunks]),
            )

        return search_features(
            space,
            labels,
            config.search,
            evaluate=evaluate,
            seed=config.seed,
            k=config.neighbours,
            groups=groups,
        )


def _score_bins(
    run: _Runner, compared: FloatArray, labels: Sequence[str | None], seed: int
) -> BinScores | None:
    """How well every bin separates each class from the rest, by every scorer; a task a class."""
    classes = classes_of(labels)
    if len(classes) < 2:
        return None
    content = sha256(compared.tobytes()).hexdigest()
    found: dict[str, npt.NDArray[np.float32]] = {}
    with run.clock.stage("bins", len(classes)) as step:

        def plan(name: str) -> _Task:
            members = [row for row, label in enumerate(labels) if label == name]
            others = [row for row, label in enumerate(labels) if label not in (name, None)]
            key = stages.SCORE.key(compared.shape, content, members, others, seed)
            return _Task(key, lambda: (compared, members, others, seed))

        def take(name: str, _: str, scores: bytes, cpu_seconds: float) -> None:
            found[name] = stages.read_array(scores)
            step(cpu_seconds)

        def drop(name: str, reason: str, _: float) -> None:
            raise DatabaseError(
                f"Scoring the bins for the class {name!r} failed: {reason}. A larger time_limit may help."
            )

        run.find(stages.SCORE, classes, plan, take, drop)
    values = np.stack([found[name] for name in classes], axis=1)
    return BinScores(tuple(scorer.name for scorer in SCORERS), tuple(classes), values)


def _search_bins(
    run: _Runner,
    features: FeatureTable,
    scaled: FloatArray,
    labels: Sequence[str | None],
    groups: IntArray,
    config: Config,
) -> BinSearch | None:
    """The bins that separate each class, those that separate all, and what these are worth."""
    if config.search == "none":
        return None
    space = make_bin_space(features, PRESETS[config.preset], labels, seed=config.seed)
    classes, codes = encode(space, labels)
    sizes = np.bincount(codes[codes >= 0], minlength=len(classes))
    if (sizes > 1).sum() < 2:
        return None
    everything = squared_distances(scaled[space.rows])
    shared = {"k": config.neighbours, "seed": config.seed}
    questions: list[tuple[str, Sequence[str | None], dict[str, Any]]] = [("select", labels, shared)]
    held: dict[str, Any] = {"k": config.neighbours, "everything": everything}
    distinct = distinct_rows(groups[space.rows], codes >= 0)
    if distinct is not None:
        held["distinct"] = distinct.tolist()
    for deal in range(affordable_deals(len(codes))):
        seed = config.seed + deal
        for fold in deal_folds(codes, seed, groups[space.rows]):
            questions.append(("hold out", labels, held | {"seed": seed, "fold": fold, "deal": deal + 1}))
    own = len(questions)
    # Each fold meets labels of its own, which tells more of chance than one labeling for all.
    for number in range(SHUFFLES):
        shuffled = shuffle_labels(space, labels, config.seed + number)
        folds = deal_folds(encode(space, shuffled)[1], config.seed, groups[space.rows])
        fold = folds[number % len(folds)]
        questions.append(("hold out", shuffled, shared | {"fold": fold, "everything": everything}))
    honest = len(questions)
    for label in (label for label, size in zip(classes, sizes) if size > 1):
        questions.append(("separate", labels, shared | {"label": label}))
    random = len(questions)
    of_size = {int(size): label for label, size in zip(classes, sizes) if size > 1}
    for label in of_size.values():
        questions.append(("separate", shuffle_labels(space, labels, config.seed), shared | {"label": label}))

    content = sha256(space.columns.tobytes() + everything.tobytes()).hexdigest()
    answers: dict[int, bytes] = {}
    with run.clock.stage("select", len(questions)) as step:

        def plan(number: int) -> _Task:
            task, names, options = questions[number]
            told = options | {"everything": None, "fold": list(options.get("fold", ()))}
            key = stages.SELECT.key(content, space.names, space.rows.tolist(), task, tuple(names), told)
            return _Task(key, lambda: (task, space, names, options))

        def take(number: int, _: str, answer: bytes, cpu_seconds: float) -> None:
            answers[number] = answer
            step(cpu_seconds)

        def drop(_: int, reason: str, __: float) -> None:
            raise DatabaseError(f"The search for bins failed: {reason}; --search none leaves it out.")

        run.find(stages.SELECT, range(len(questions)), plan, take, drop)
    held_out = [stages.read_held_out(answers[i]) for i in range(1, honest)]
    return BinSearch(
        automatic=stages.read_selection(answers[0]),
        held_out=tuple(held_out[: own - 1]),
        shuffled=tuple(held_out[own - 1 :]),
        chance=float((sizes[codes[codes >= 0]] - 1).mean() / (len(codes) - 1)),
        minimal=tuple(stages.read_minimal(answers[i]) for i in range(honest, random)),
        minimal_by_chance={
            size: stages.read_minimal(answers[i]) for i, size in enumerate(of_size, start=random)
        },
        sizes=dict(zip(classes, sizes.tolist())),
    )


def _rate_retrieval(
    run: _Runner,
    space: SearchSpace,
    labels: Sequence[str | None],
    search: FeatureSearch | None,
    bins: tuple[str, ...] | None,
    by_bins: FloatArray | None,
) -> Retrieval | None:
    """How well shapes of a class are found by each feature alone, all of them, the subsets of the search, and by some
    bins, whose scaled values of all shapes are ``by_bins``."""
    classes, codes = query_classes([labels[row] for row in space.rows])
    if not classes:
        return None
    features = range(len(space.features))
    searched = () if search is None else (search.subsets.members @ [1 << f for f in features]).tolist()
    subsets = sorted({*searched, *(1 << f for f in features), space.everything})
    distances: dict[str, tuple[str, npt.NDArray[np.floating]]] = {"subsets": (space.key, space.squared)}
    questions = [
        ("subsets", tuple(subsets[i : i + RATINGS_A_TASK])) for i in range(0, len(subsets), RATINGS_A_TASK)
    ]
    if by_bins is not None:
        squared = squared_distances(by_bins[space.rows])[None]
        distances["bins"] = (sha256(squared.tobytes()).hexdigest(), squared)
        questions.append(("bins", (1,)))
    found: dict[tuple[str, tuple[int, ...]], list[Rating]] = {}
    with run.clock.stage("retrieve", len(questions)) as step:

        def plan(question: tuple[str, tuple[int, ...]]) -> _Task:
            key, squared = distances[question[0]]
            return _Task(
                stages.RETRIEVE.key(key, codes.tolist(), question[1]), lambda: (squared, codes, question[1])
            )

        def take(question: tuple[str, tuple[int, ...]], _: str, content: bytes, cpu_seconds: float) -> None:
            found[question] = stages.read_ratings(content)
            step(cpu_seconds)

        def drop(_: tuple[str, tuple[int, ...]], reason: str, __: float) -> None:
            raise DatabaseError(f"Rating the retrieval failed: {reason}.")

        run.find(stages.RETRIEVE, questions, plan, take, drop)
    return Retrieval(
        features=space.features,
        rows=space.rows,
        shape_count=space.shape_count,
        classes=classes,
        queries=np.bincount(codes[codes >= 0]).astype(np.int32),
        members=np.array([[bool(subset >> f & 1) for f in features] for subset in subsets]),
        subsets=tuple(
            rating for question in questions if question[0] == "subsets" for rating in found[question]
        ),
        bins=bins,
        by_bins=None if by_bins is None else found["bins", (1,)][0],
        chance=rate_chance(codes),
    )


def _paint(
    run: _Runner,
    features: FeatureTable,
    contrasts: Mapping[str, Sequence[int]],
    plan: Callable[[int, tuple[tuple[int, int], ...]], _Task],
) -> tuple[Painting, ...]:
    """Bins painted on shapes, a task a shape.

    Parameters
    ----------
    run : _Runner
    features : FeatureTable
    contrasts : mapping of str to rows
        Bin -> the shapes that are to show it.
    plan : callable
        The task of a shape, by its row, and some bins, each by its dimension and place, both from 0.
    """
    place = {column: divmod(number, BINS) for number, column in enumerate(features.columns)}
    shapes = sorted({row for rows in contrasts.values() for row in rows})
    columns = {row: [column for column, rows in contrasts.items() if row in rows] for row in shapes}
    found: dict[tuple[str, int], Painting] = {}
    with run.clock.stage("paint", len(shapes)) as step:

        def take(row: int, _: str, content: bytes, cpu_seconds: float) -> None:
            for column, (value, inside) in zip(columns[row], stages.read_paintings(content)):
                found[column, row] = Painting(column, row, value, inside)
            step(cpu_seconds)

        def drop(row: int, reason: str, _: float) -> None:
            name = features.shape_ids[row]
            raise DatabaseError(f"Painting bins on {name} failed: {reason}.")

        run.find(
            stages.PAINT, shapes, lambda row: plan(row, tuple(place[c] for c in columns[row])), take, drop
        )
    return tuple(found[column, row] for column, rows in contrasts.items() for row in rows)


def _read_database(path: Path, config: Config, publication: Publication) -> Database:
    """The database, with what its owner should know before it is published."""
    database = read_database(
        path, layout=config.layout, labeling=config.labeling, name=config.title, outside=config.outside
    )
    warning = licence_warning(publication, database.shapes)
    return database if warning is None else replace(database, warnings=(*database.warnings, warning))


def _load_external(paths: Sequence[Path], shape_count: int) -> list[tuple[FeatureBlock, FloatArray]]:
    taken = {block.name for block in BLOCKS}
    result = []
    for path in paths:
        name = path.stem
        if name in taken:
            raise ConfigError(f"there is already a feature named {name!r}; rename the file {path}")
        taken.add(name)
        values = load_external(path, shape_count)
        result.append((FeatureBlock(name, values.shape[1], 1), values))
    return result


def _relative(shape: ShapeEntry, root: Path) -> str:
    try:
        return shape.path.relative_to(root).as_posix()
    except ValueError:
        return shape.path.as_posix()


def _nothing_usable(path: Path, failures: Sequence[Failure]) -> Iterator[str]:
    """The lines of a message."""
    yield f"None of the files in {path} can be used:"
    yield from (f"  {failure.path}: {failure.reason}" for failure in failures[:5])
    if len(failures) > 5:
        yield f"  and {len(failures) - 5} more"
