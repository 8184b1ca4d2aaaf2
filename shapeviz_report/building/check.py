"""What a build would read, without building anything."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from shapeviz_report.bins import read_bins
from shapeviz_report.building.chains import Chain
from shapeviz_report.building.comparing import find_copies
from shapeviz_report.building.guard import check_cache
from shapeviz_report.building.progress import Clock, Progress, QuietProgress
from shapeviz_report.building.reading import (
    MeshFiles,
    load_all_coordinates,
    load_all_external,
    plan_examining,
    read_published,
)
from shapeviz_report.building.runner import Runner, name_files
from shapeviz_report.building.stages import EXAMINE, Examined, Stage
from shapeviz_report.building.workers import open_workers
from shapeviz_report.cache import Cache, default_root
from shapeviz_report.config import Config
from shapeviz_report.database import Listing
from shapeviz_report.presets import PRESETS
from shapeviz_report.publication import read_publication
from shapeviz_report.types import CopyGroup, Database, Failure, list_groups


@dataclass(frozen=True)
class CheckResult:
    """What a build would read.

    Attributes
    ----------
    database : Database
        As it is laid out.
    repairs : mapping of str to dict
        Shape id -> what would be mended, for shapes that can be used.
    lost : mapping of str to tuple of str
        Shape id -> what is left out of its colours, and why, for those of them that lose any.
    failures : tuple of Failure
        Files that cannot be used.
    copies : tuple of CopyGroup
        Shapes that are the same shape again, group by group.
    """

    database: Database
    repairs: dict[str, dict[str, int]]
    lost: dict[str, tuple[str, ...]]
    failures: tuple[Failure, ...]
    copies: tuple[CopyGroup, ...] = ()


def check_database(source: Path | Listing, config: Config, progress: Progress | None = None) -> CheckResult:
    """Read a database and every mesh of it, without building anything; what is found is kept in the cache."""
    root = (config.cache or default_root()).absolute()
    check_cache(root, Path(source))
    clock = Clock(progress or QuietProgress())
    with clock.stage("read", "Reading the database"):
        database = read_published(source, config, read_publication(config))
        external = load_all_external(config.external, database)
        load_all_coordinates(config.coordinates, database)
        if config.bins is not None:
            read_bins(config.bins, (*PRESETS[config.preset].blocks, *(block for block, _ in external)))
    failures = list(database.failures)
    cache = Cache(root)
    with open_workers(config, config.worker_count) as executor:
        run = Runner(executor, clock, cache, name_files(database), failures, config)
        meshes = MeshFiles(database, outside=config.outside)
        ids = [shape.id for shape in database.shapes]
        examined: dict[str, Examined] = {}
        checking = replace(EXAMINE, name="check")

        def take(shape: str, _: Chain, values: dict[Stage[Any], Any]) -> None:
            examined[shape] = values[checking]

        run.each("Checking meshes", ids, [checking], plan_examining(meshes.read), take)
        found = {shape: examined[shape] for shape in ids if shape in examined}
        outlines = {shape: each.outline for shape, each in found.items()}
        copies = find_copies(run, meshes.read, outlines)
    cache.tell()
    return CheckResult(
        database,
        repairs={shape: each.repairs for shape, each in found.items()},
        lost={shape: each.lost for shape, each in found.items() if each.lost},
        failures=tuple(failures),
        copies=tuple(list_groups(copies, list(outlines))),
    )
