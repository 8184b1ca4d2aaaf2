"""The processes that compute."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from shapeviz_report.building import stages
from shapeviz_report.config import Config
from shapeviz_report.executor import Executor, LocalExecutor, memory_share
from shapeviz_report.render import check_renderer


@contextmanager
def open_executor(config: Config) -> Iterator[Executor]:
    """The executor that a build is to use: the Dask cluster it names, or processes of this machine."""
    if config.scheduler is None:
        with open_workers(config, config.worker_count) as local:
            yield local
        return
    from shapeviz_report.executor.cluster import DaskExecutor

    with DaskExecutor(
        config.scheduler, config.time_limit, config.memory_bytes, stages.fingerprint, check_renderer
    ) as cluster:
        yield cluster


def open_workers(config: Config, jobs: int) -> LocalExecutor:
    """Processes of this machine, each with the share of its memory that the options say."""
    return LocalExecutor(jobs, config.time_limit, config.memory_bytes or memory_share(config.worker_count))
