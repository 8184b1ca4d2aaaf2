"""What only a cluster can do wrong, and how it is said."""

from __future__ import annotations

import gc
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from functools import partial
from pathlib import Path

import pytest
from cluster import (
    lack_for_a_while,
    lack_something,
    name_worker,
    other_everywhere,
    running_cluster,
    same_everywhere,
)
from distributed import Client
from distributed.protocol import Serialized

import shapeviz_report
from shapeviz_report.building.stages import fingerprint
from shapeviz_report.errors import ClusterError
from shapeviz_report.executor import cluster as module
from shapeviz_report.executor import vetting
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
        DaskExecutor("tcp://127.0.0.1:9", 60, None, same_everywhere, os.getpid)


@pytest.mark.parametrize("address", ["nonsense", "nonsense://", "tls://127.0.0.1:9", ""])
def test_an_address_that_is_none_is_said_and_nothing_else(address) -> None:
    program = f"""
import os
from shapeviz_report.errors import ClusterError
from shapeviz_report.executor.cluster import DaskExecutor
try:
    DaskExecutor({address!r}, 60, None, dict, os.getpid)
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
    with (
        DaskExecutor(address, 60, None, other_everywhere, os.getpid) as executor,
        pytest.raises(
            ClusterError,
            match=rf"has other versions of shapeviz-report.*: process \d+ \(here {os.getpid()}\)\. Install",
        ),
    ):
        list(executor.run(divmod, [(1, 2)]))


def test_a_worker_that_lacks_something_is_refused(address, monkeypatch) -> None:
    monkeypatch.setattr(vetting, "VETTING_PAUSE", 0.1)
    with (
        DaskExecutor(address, 60, None, same_everywhere, lack_something) as executor,
        pytest.raises(ClusterError, match=r"worker tcp://.* cannot take part: OSMesa is missing here"),
    ):
        list(executor.run(divmod, [(1, 2)]))


def test_what_a_worker_lacks_for_a_moment_ends_nothing(tmp_path, monkeypatch, caplog) -> None:
    monkeypatch.setattr(vetting, "VETTING_PAUSE", 0.1)
    check = partial(lack_for_a_while, "worker-0", vetting.VETTINGS - 1)
    with (
        running_cluster(tmp_path, workers=1) as cluster,
        DaskExecutor(cluster.address, 60, None, same_everywhere, check) as executor,
    ):
        assert [outcome.value for outcome in executor.run(name_worker, [(0,)])] == ["worker-0"]
    assert caplog.messages == []
    assert len((tmp_path / "worker-0" / "asked").read_text()) == vetting.VETTINGS


def test_a_worker_that_is_refused_for_what_passes_takes_part_later(tmp_path, monkeypatch, caplog) -> None:
    monkeypatch.setattr(vetting, "VETTING_PAUSE", 0.1)
    check = partial(lack_for_a_while, "worker-1", vetting.VETTINGS + 1)
    with (
        running_cluster(tmp_path, workers=2) as cluster,
        DaskExecutor(cluster.address, 60, None, same_everywhere, check) as executor,
    ):
        tasks = ((0.1,) for _ in range(600))
        there = []
        for outcome in executor.run(name_worker, tasks):
            there.append(outcome.value)
            if outcome.value == "worker-1":
                tasks.close()
    assert {*there} == {"worker-0", "worker-1"}
    (message,) = caplog.messages
    assert re.search(r"cannot take part: OSMesa is missing here Meanwhile it is not used\.$", message)


def other_package(folder: Path) -> Path:
    """A folder with another version of the package."""
    package = Path(shapeviz_report.__file__).parent
    shutil.copytree(package, folder / package.name, ignore=shutil.ignore_patterns("__pycache__"))
    with (folder / package.name / "copies.py").open("a") as source:
        source.write("POINTS = 1501\n")
    return folder


def no_package(folder: Path) -> Path:
    """A folder of modules that hides the package."""
    folder.mkdir()
    (folder / "sitecustomize.py").write_text("import sys\nsys.modules['shapeviz_report'] = None\n")
    return folder


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (
            other_package,
            r"has other versions .*: shapeviz-report \S+, code \w+ \(here \S+, code \w+\)\. Install",
        ),
        (no_package, r"has not this version of shapeviz-report \(.*shapeviz_report.*\)\. Install"),
    ],
)
def test_a_late_worker_that_differs_is_told_of_once_and_not_used(tmp_path, caplog, make, said) -> None:
    with (
        running_cluster(tmp_path, workers=1) as cluster,
        DaskExecutor(cluster.address, 60, None, fingerprint, os.getpid) as executor,
        Client(cluster.address, set_as_default=False) as watcher,
    ):
        tasks = ((0.1,) for _ in range(400))
        outcomes = executor.run(time.sleep, tasks)
        found = [next(outcomes)]
        (first,) = watcher.nthreads()
        cluster.add_worker(make(tmp_path / "modules"))
        for outcome in outcomes:
            found.append(outcome)
            if caplog.messages:
                tasks.close()
        assert len(found) < 400
        (late,) = watcher.nthreads().keys() - {first}
        # what is asked later does not go there either, and where nobody else is left, the build says why it ends
        assert len(list(executor.run(time.sleep, [(0.05,)] * 40))) == 40
        (message,) = caplog.messages
        assert re.search(rf"^The worker {late} {said}.* Meanwhile it is not used\.$", message)
        assert sorted(outcome.index for outcome in found) == list(range(len(found)))
        assert {outcome.reason for outcome in found} == {None}


def test_workers_that_all_differ_end_the_build(tmp_path, caplog) -> None:
    modules = other_package(tmp_path / "modules")
    with running_cluster(tmp_path, workers=0) as cluster:
        for _ in range(2):
            cluster.add_worker(modules)
        with (
            DaskExecutor(cluster.address, 60, None, fingerprint, os.getpid) as executor,
            pytest.raises(ClusterError, match=r"worker tcp://.* has other versions of shapeviz-report"),
        ):
            list(executor.run(divmod, [(1, 2)] * 8))
    assert caplog.messages == []


def test_a_worker_that_can_draw_takes_part(address) -> None:
    with DaskExecutor(address, 60, None, same_everywhere, partial(check_renderer, "osmesa")) as executor:
        assert [outcome.value for outcome in executor.run(divmod, [(7, 2)])] == [(3, 1)]


def test_what_was_sent_is_not_kept(address) -> None:
    with DaskExecutor(address, 60, None, same_everywhere, os.getpid) as executor:
        for outcome in executor.run(len, [(bytes(300_000),)] * 60):
            assert outcome.value == 300_000
        gc.collect()
        assert sum(isinstance(item, Serialized) for item in gc.get_objects()) < 10


# Seconds in which nobody asks: what was sent is at work then, or done and still where it was done.
RESTS = (0.0, 2.0)


@pytest.mark.parametrize("rest", RESTS)
def test_a_killed_worker_loses_nothing(tmp_path, rest) -> None:
    with (
        running_cluster(tmp_path, workers=2) as cluster,
        DaskExecutor(cluster.address, 60, None, same_everywhere, os.getpid) as executor,
    ):
        outcomes = executor.run(time.sleep, [(0.05,)] * 60)
        found = [next(outcomes)]
        time.sleep(rest)
        cluster.workers[0].kill()
        found += outcomes
    assert sorted(outcome.index for outcome in found) == list(range(60))
    assert {outcome.reason for outcome in found} == {None}


@pytest.mark.parametrize("rest", RESTS)
def test_what_a_frozen_worker_has_is_done_by_another(tmp_path, monkeypatch, rest) -> None:
    monkeypatch.setattr(module, "LOOK_AGAIN", 0.5)
    with (
        running_cluster(tmp_path, workers=2) as cluster,
        DaskExecutor(cluster.address, 60, None, same_everywhere, os.getpid) as executor,
    ):
        outcomes = executor.run(time.sleep, [(0.05,)] * 60)
        found = [next(outcomes)]
        time.sleep(rest)
        # Its connections stay open: to Dask it is at work, and for five minutes nothing is missed.
        cluster.workers[0].send_signal(signal.SIGSTOP)
        begun = time.monotonic()
        found += outcomes
        monkeypatch.setattr(module, "ANSWER_TIME", 2.0)
        executor.__exit__()
        assert time.monotonic() - begun < 60
    assert sorted(outcome.index for outcome in found) == list(range(60))
    assert {outcome.reason for outcome in found} == {None}


def test_a_frozen_scheduler_is_told_of_once_and_waited_for(tmp_path, monkeypatch, caplog) -> None:
    monkeypatch.setattr(module, "SILENCE", 1.0)
    monkeypatch.setattr(module, "LOOK_AGAIN", 0.5)
    with (
        running_cluster(tmp_path, workers=1) as cluster,
        DaskExecutor(cluster.address, 60, None, same_everywhere, os.getpid) as executor,
    ):
        outcomes = executor.run(time.sleep, [(0.05,)] * 60)
        found = [next(outcomes)]
        cluster.scheduler.send_signal(signal.SIGSTOP)
        thaw = threading.Timer(5.0, cluster.scheduler.send_signal, [signal.SIGCONT])
        thaw.start()
        found += outcomes
        thaw.join()
    assert sorted(outcome.index for outcome in found) == list(range(60))
    assert {outcome.reason for outcome in found} == {None}
    silent, awake = caplog.messages
    assert silent.startswith(f"The Dask scheduler at {cluster.address} has not answered for 1 seconds.")
    assert awake == f"The Dask scheduler at {cluster.address} answers again."


def test_a_scheduler_that_is_frozen_from_the_beginning_is_said(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(module, "ANSWER_TIME", 1.0)
    with running_cluster(tmp_path, workers=0) as cluster:
        cluster.scheduler.send_signal(signal.SIGSTOP)
        begun = time.monotonic()
        with pytest.raises(ClusterError, match=r"does not answer: .*dask scheduler"):
            DaskExecutor(cluster.address, 60, None, same_everywhere, os.getpid)
        assert time.monotonic() - begun < 20


def test_a_connection_that_is_lost_and_comes_back_loses_nothing(tmp_path) -> None:
    """As to a scheduler that is frozen for so long that the system gives the connection up."""
    with (
        running_cluster(tmp_path, workers=1) as cluster,
        DaskExecutor(cluster.address, 60, None, same_everywhere, os.getpid) as executor,
    ):
        outcomes = executor.run(time.sleep, [(0.05,)] * 60)
        found = [next(outcomes)]
        client = executor._client
        client.loop.add_callback(client.scheduler_comm.comm.abort)
        found += outcomes
    assert sorted(outcome.index for outcome in found) == list(range(60))
    assert {outcome.reason for outcome in found} == {None}


def test_a_cluster_without_workers_is_said(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(module, "PATIENCE", 1.0)
    with (
        running_cluster(tmp_path, workers=0) as cluster,
        DaskExecutor(cluster.address, 60, None, same_everywhere, os.getpid) as executor,
        pytest.raises(ClusterError, match="no worker for 1 seconds"),
    ):
        list(executor.run(divmod, [(1, 2)]))


def test_a_scheduler_that_goes_is_said(tmp_path, monkeypatch) -> None:
    with (
        running_cluster(tmp_path, workers=1) as cluster,
        DaskExecutor(cluster.address, 60, None, same_everywhere, os.getpid) as executor,
    ):
        outcomes = executor.run(time.sleep, [(0.2,)] * 40)
        next(outcomes)
        monkeypatch.setattr(module, "PATIENCE", 1.0)
        cluster.scheduler.kill()
        with pytest.raises(ClusterError, match="What was computed is kept"):
            list(outcomes)
