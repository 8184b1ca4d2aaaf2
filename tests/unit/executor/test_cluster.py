"""What only a cluster can do wrong, and how it is said."""

from __future__ import annotations

import gc
import os
import platform
import signal
import subprocess
import sys
import time
from functools import partial

import pytest
from cluster import lack_something, running_cluster
from distributed.protocol import Serialized

from shapeviz_report.errors import ClusterError
from shapeviz_report.executor import cluster as module
from shapeviz_report.executor.cluster import DaskExecutor
from shapeviz_report.render import check_renderer

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    with running_cluster(tmp_path_factory.mktemp("cluster"), workers=1) as cluster:
        yield cluster.address


def test_a_scheduler_that_is_not_there(monkeypatch) -> None:
    monkeypatch.setattr(module, "ANSWER_TIME", 1.0)
    with pytest.raises(ClusterError, match=r"tcp://127.0.0.1:9' does not answer.*dask scheduler"):
        DaskExecutor("tcp://127.0.0.1:9", 60, None, platform.python_version, os.getpid)


@pytest.mark.parametrize("address", ["nonsense", "nonsense://", "tls://127.0.0.1:9", ""])
def test_an_address_that_is_none_is_said_and_nothing_else(address) -> None:
    program = f"""
import os, platform
from shapeviz_report.errors import ClusterError
from shapeviz_report.executor.cluster import DaskExecutor
try:
    DaskExecutor({address!r}, 60, None, platform.python_version, os.getpid)
except ClusterError as error:
    print(error)
"""
    # What Python's end has to wait for, it waits for twice as long as a scheduler has to answer.
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=2 * module.ANSWER_TIME
    )
    assert ended.stdout.startswith(f"The Dask scheduler at {address!r} does not answer: ")
    assert (ended.stderr, ended.returncode) == ("", 0)


def test_a_worker_with_other_code_is_refused(address) -> None:
    # What differs here and there by itself: the process that answers.
    with (
        DaskExecutor(address, 60, None, os.getpid, os.getpid) as executor,
        pytest.raises(ClusterError, match=r"worker tcp://.* has other versions of shapeviz-report"),
    ):
        list(executor.run(divmod, [(1, 2)]))


def test_a_worker_that_lacks_something_is_refused(address) -> None:
    with (
        DaskExecutor(address, 60, None, platform.machine, lack_something) as executor,
        pytest.raises(ClusterError, match=r"worker tcp://.* cannot take part: OSMesa is missing here"),
    ):
        list(executor.run(divmod, [(1, 2)]))


def test_a_worker_that_can_draw_takes_part(address) -> None:
    with DaskExecutor(
        address, 60, None, platform.python_version, partial(check_renderer, "osmesa")
    ) as executor:
        assert [outcome.value for outcome in executor.run(divmod, [(7, 2)])] == [(3, 1)]


def test_what_was_sent_is_not_kept(address) -> None:
    with DaskExecutor(address, 60, None, platform.python_version, os.getpid) as executor:
        for outcome in executor.run(len, [(bytes(300_000),)] * 60):
            assert outcome.value == 300_000
        gc.collect()
        assert sum(isinstance(item, Serialized) for item in gc.get_objects()) < 10


def test_a_killed_worker_loses_nothing(tmp_path) -> None:
    with (
        running_cluster(tmp_path, workers=2) as cluster,
        DaskExecutor(cluster.address, 60, None, platform.python_version, os.getpid) as executor,
    ):
        outcomes = executor.run(time.sleep, [(0.05,)] * 60)
        found = [next(outcomes)]
        cluster.workers[0].kill()
        found += outcomes
    assert sorted(outcome.index for outcome in found) == list(range(60))
    assert {outcome.reason for outcome in found} == {None}


def test_what_a_frozen_worker_has_is_done_by_another(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(module, "LOOK_AGAIN", 0.5)
    with (
        running_cluster(tmp_path, workers=2) as cluster,
        DaskExecutor(cluster.address, 60, None, platform.python_version, os.getpid) as executor,
    ):
        outcomes = executor.run(time.sleep, [(0.05,)] * 60)
        found = [next(outcomes)]
        # Its connections stay open: to Dask it is at work, and for five minutes nothing is missed.
        cluster.workers[0].send_signal(signal.SIGSTOP)
        begun = time.monotonic()
        found += outcomes
        monkeypatch.setattr(module, "ANSWER_TIME", 2.0)
        executor.__exit__()
        assert time.monotonic() - begun < 60
    assert sorted(outcome.index for outcome in found) == list(range(60))
    assert {outcome.reason for outcome in found} == {None}


def test_a_cluster_without_workers_is_said(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(module, "PATIENCE", 1.0)
    with (
        running_cluster(tmp_path, workers=0) as cluster,
        DaskExecutor(cluster.address, 60, None, platform.python_version, os.getpid) as executor,
        pytest.raises(ClusterError, match="no worker for 1 seconds"),
    ):
        list(executor.run(divmod, [(1, 2)]))


def test_a_scheduler_that_goes_is_said(tmp_path, monkeypatch) -> None:
    with (
        running_cluster(tmp_path, workers=1) as cluster,
        DaskExecutor(cluster.address, 60, None, platform.python_version, os.getpid) as executor,
    ):
        outcomes = executor.run(time.sleep, [(0.2,)] * 40)
        next(outcomes)
        monkeypatch.setattr(module, "PATIENCE", 1.0)
        cluster.scheduler.kill()
        with pytest.raises(ClusterError, match="What was computed is kept"):
            list(outcomes)
