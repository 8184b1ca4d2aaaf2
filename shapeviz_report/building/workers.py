"""The processes that compute."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

from shapeviz_report.building import stages
from shapeviz_report.config import Config
from shapeviz_report.errors import RenderError
from shapeviz_report.executor import Executor, LocalExecutor, memory_share
from shapeviz_report.render import RENDERERS, Renderer, check_renderer


@contextmanager
def open_executor(config: Config, renderer: Renderer = "zbuffer") -> Iterator[Executor]:
    """The executor that a build is to use, which can draw so: the Dask cluster it names, or processes of this
    machine."""
    if config.scheduler is None:
        with open_workers(config, config.worker_count) as local:
            yield local
        return
    from shapeviz_report.executor.cluster import DaskExecutor

    with DaskExecutor(
        config.scheduler,
        config.time_limit,
        config.memory_bytes,
        stages.fingerprint,
        partial(check_renderer, renderer),
    ) as cluster:
        yield cluster


def open_workers(config: Config, jobs: int) -> LocalExecutor:
    """Processes of this machine, each with the share of its memory that the options say."""
    return LocalExecutor(jobs, config.time_limit, config.memory_bytes or memory_share(config.worker_count))


def find_renderer(config: Config) -> Renderer:
    """The renderer that is asked for, or the first that draws on this machine.

    Raises
    ------
    RenderError
        That which is asked for does not.
    """
    wanted = [name for name in RENDERERS if config.renderer in (None, name)]
    reason = ""
    for renderer in wanted:
        # In a process of its own: a graphics library is chosen once a process, and may bring it down.
        with open_workers(config, 1) as executor:
            (outcome,) = executor.run(check_renderer, [(renderer,)])
        if outcome.reason is None:
            return renderer
        reason = outcome.reason
    raise RenderError(reason)
