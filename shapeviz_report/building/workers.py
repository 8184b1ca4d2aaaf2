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
    """The executor that a command is to use: the Dask cluster it names, which can draw so, or processes of this
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


@contextmanager
def open_drawing(config: Config) -> Iterator[tuple[Executor, Renderer]]:
    """The executor that a build is to use, and the renderer that is asked for, or the first that draws on this machine.

    Raises
    ------
    RenderError
        That which is asked for does not.
    """
    reason = ""
    for renderer in [name for name in RENDERERS if config.renderer in (None, name)]:
        # Processes of its own for each: a graphics library is chosen once a process, and may bring it down.
        with open_workers(config, config.worker_count) as local:
            (outcome,) = local.run(check_renderer, [(renderer,)])
            if outcome.reason is not None:
                reason = outcome.reason
                continue
            if config.scheduler is None:
                # It goes on with the process that has drawn already.
                yield local, renderer
                return
        with open_executor(config, renderer) as cluster:
            yield cluster, renderer
        return
    raise RenderError(reason)


def open_workers(config: Config, jobs: int) -> LocalExecutor:
    """Processes of this machine, each with the share of its memory that the options say."""
    return LocalExecutor(jobs, config.time_limit, config.memory_bytes or memory_share(config.worker_count))
