"""The demo database: made by the package itself, and built like any other."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from shapeviz_report import demo
from shapeviz_report.building.guard import check_places
from shapeviz_report.building.pipeline import build_report
from shapeviz_report.building.progress import Progress, QuietProgress
from shapeviz_report.building.stages import GENERATE
from shapeviz_report.building.workers import open_executor
from shapeviz_report.cache import Cache, default_root, discard
from shapeviz_report.config import Config
from shapeviz_report.demo import catalogue
from shapeviz_report.errors import CacheError, DatabaseError
from shapeviz_report.staging import write_atomically
from shapeviz_report.types import Report


def build_demo(destination: Path, config: Config, progress: Progress | None = None) -> Report:
    """Generate the demo database below the cache and build its site; see
    :func:`~shapeviz_report.building.pipeline.build_report`."""
    check_places(destination, config, (config.cache or default_root()).absolute(), None)
    progress = progress or QuietProgress()
    cache = Cache((config.cache or default_root()).absolute())
    root = cache.root / "demo" / f"{GENERATE.version}-{config.seed}"
    shapes = [(c.name, i, config.seed) for c in demo.CLASSES for i in range(demo.PER_CLASS)]
    kept = {task: cache.load(GENERATE.folder, GENERATE.key(*task)) for task in shapes}
    made = {task: content for task, content in kept.items() if content is not None}
    tasks = [task for task in shapes if task not in made]
    if tasks:
        with (
            open_executor(config) as executor,
            progress.stage(GENERATE.doing, len(tasks)) as advance,
        ):
            for outcome in executor.run(GENERATE.compute, tasks):
                task = tasks[outcome.index]
                if outcome.reason is not None:
                    raise DatabaseError(GENERATE.failing.format(task=task, reason=outcome.reason))
                cache.store(GENERATE.folder, GENERATE.key(*task), outcome.value)
                made[task] = outcome.value
                advance()
    cache.tell()
    introduction = root / "introduction.md"
    files = {demo.shape_path(root, name, index): content for (name, index, _), content in made.items()}
    files[root / "shapes.csv"] = catalogue.write_catalogue(config.seed).encode()
    files[introduction] = catalogue.INTRODUCTION.encode()
    # The files that are read are written from what is kept, unless they are still the same.
    try:
        for path, content in files.items():
            if not path.is_file() or path.is_symlink() or path.read_bytes() != content:
                discard(path)
                write_atomically(path, content)
    except OSError as error:
        raise CacheError(
            f"The demo shapes cannot be written to {root}: {error.strerror} ({error.filename}). Make room there, or "
            "name another folder with --cache."
        ) from error
    config = replace(
        config,
        title=config.title or catalogue.TITLE,
        description=config.description or catalogue.DESCRIPTION,
        introduction=config.introduction or introduction,
        creator=config.creator or catalogue.CREATOR,
        citation=config.citation or catalogue.CITATION,
        licence=config.licence or "CC0-1.0",
        up="z",
    )
    return build_report(root, destination, config, progress)
