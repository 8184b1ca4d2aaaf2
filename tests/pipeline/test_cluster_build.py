"""A build on a Dask cluster: the same site, whatever happens to its workers."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
from cluster import running_cluster
from signals import hear_signals
from small_database import WITH_SEARCH, read_site

import shapeviz_report
from shapeviz_report.building.pipeline import build_report
from shapeviz_report.building.stages import SEARCH
from shapeviz_report.config import Config

CLUSTER_OPTIONS = {name: value for name, value in WITH_SEARCH.items() if name != "jobs"}


class Watcher:
    """Progress that calls functions, each at the third step of a stage."""

    def __init__(self, acts) -> None:
        self.acts = acts

    @contextmanager
    def stage(self, doing, total):
        count = 0

        def advance():
            nonlocal count
            count += 1
            if count == 3 and doing in self.acts:
                self.acts[doing]()

        yield advance


def test_the_same_site_though_workers_are_killed_half_way(built, database, tmp_path) -> None:
    site, _ = built
    (tmp_path / "cluster").mkdir()
    with running_cluster(tmp_path / "cluster", workers=3) as cluster:
        first, second, _ = cluster.workers
        report = build_report(
            database,
            tmp_path / "site",
            Config(scheduler=cluster.address, cache=tmp_path / "cache", **CLUSTER_OPTIONS),
            Watcher({"Measuring shapes": first.kill, SEARCH.doing: second.kill}),
        )
        assert [first.wait(), second.wait()] == [-9, -9]
    assert report.failures == ()
    assert (tmp_path / "cache" / "facts").exists()
    assert not (tmp_path / "cache" / "prepared").exists(), "prepared meshes stay where they are made"
    assert read_site(site) == read_site(tmp_path / "site")


def start_build(database: Path, folder: Path, scheduler: str) -> subprocess.Popen[str]:
    options = ["-o", folder / "site", "--scheduler", scheduler, "--cache", folder / "cache"]
    command = [sys.executable, "-m", "shapeviz_report", "build", database, *options]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True, preexec_fn=hear_signals)


def test_a_scheduler_that_goes_ends_the_build_with_a_sentence_and_nothing_else(database, tmp_path) -> None:
    with running_cluster(tmp_path, workers=1) as cluster:
        build = start_build(database, tmp_path, cluster.address)
        assert build.stderr is not None
        said = [line for line, _ in zip(build.stderr, range(2), strict=False)]
        cluster.scheduler.kill()
        said += build.stderr
        assert build.wait() == 1
    assert [line.partition(":")[0] for line in said[:2]] == ["Reading the database\n", "Measuring shapes"]
    assert said[2:] == [
        "shapeviz-report: The Dask scheduler has gone. What was computed is kept: start it and its workers again, "
        "then the same command continues.\n"
    ]


def test_a_frozen_scheduler_holds_no_build_that_is_stopped(database, tmp_path) -> None:
    with running_cluster(tmp_path, workers=1) as cluster:
        build = start_build(database, tmp_path, cluster.address)
        while not any((tmp_path / "cache").glob("facts/*/*")):
            assert build.poll() is None
            time.sleep(0.05)
        cluster.scheduler.send_signal(signal.SIGSTOP)
        build.send_signal(signal.SIGINT)
        said = build.communicate(timeout=60)[1]
    assert build.returncode == 130
    assert said.endswith("\nStopped. What was computed is kept: the same command continues from here.\n")
    assert "Traceback" not in said


def test_a_cluster_and_a_number_of_processes_exclude_each_other(database, tmp_path) -> None:
    with pytest.raises(
        shapeviz_report.ShapevizError, match="jobs is the number of processes on this machine"
    ):
        shapeviz_report.build(database, tmp_path / "site", scheduler="tcp://127.0.0.1:9", jobs=2)
