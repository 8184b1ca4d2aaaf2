"""What both executors promise: workers that answer, refuse, crash and hang, in real processes."""

from __future__ import annotations

import os
import platform
import signal
import time

import pytest
from cluster import running_cluster

from shapeviz_report.errors import MeshError
from shapeviz_report.executor import Executor, LocalExecutor
from shapeviz_report.executor.cluster import DaskExecutor
from shapeviz_report.mesh import read_mesh


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    with running_cluster(tmp_path_factory.mktemp("cluster"), workers=2) as cluster:
        yield cluster


@pytest.fixture(params=["local", "cluster"])
def make_executor(request):
    """A function that opens an executor with two workers, given a time limit."""
    if request.param == "local":
        return lambda time_limit: LocalExecutor(2, time_limit)
    address = request.getfixturevalue("cluster").address
    # Functions of the standard library: the workers of a cluster do not have our tests.
    return lambda time_limit: DaskExecutor(address, time_limit, platform.python_version, os.getpid)


@pytest.fixture
def executor(make_executor):
    with make_executor(60) as executor:
        yield executor


def collect(executor: Executor, function, tasks) -> dict[int, tuple[object, str | None]]:
    return {o.index: (o.value, o.reason) for o in executor.run(function, tasks)}


def test_every_task_is_answered(executor) -> None:
    found = collect(executor, divmod, [(i, 7) for i in range(50)])
    assert found == {i: (divmod(i, 7), None) for i in range(50)}


def test_workers_are_reused(executor) -> None:
    first = {value for value, _ in collect(executor, os.getpid, [()] * 20).values()}
    second = {value for value, _ in collect(executor, os.getpid, [()] * 20).values()}
    assert len(first) == 2
    assert first == second
    assert os.getpid() not in first


def test_tasks_are_drawn_as_workers_become_free(executor) -> None:
    drawn = []

    def tasks():
        for i in range(50):
            drawn.append(i)
            yield i, 7

    outcomes = executor.run(divmod, tasks())
    next(outcomes)
    assert len(drawn) <= 5
    outcomes.close()


def test_a_refusal_is_its_message(executor, tmp_path) -> None:
    (tmp_path / "x.off").write_text("not a mesh")
    found = collect(executor, read_mesh, [(tmp_path / "x.off",)])
    with pytest.raises(MeshError) as refused:
        read_mesh(tmp_path / "x.off")
    assert found == {0: (None, str(refused.value))}


def test_a_crash_takes_one_task_only(executor) -> None:
    # os.kill with the worker's own process: what native code does to itself when it fails.
    tasks = [
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)",) if i == 3 else ("0",) for i in range(8)
    ]
    found = collect(executor, exec, tasks)
    assert found.pop(3) == (None, f"the process working on it ended (signal {signal.SIGSEGV})")
    assert all(reason is None for _, reason in found.values())
    assert len(found) == 7


def test_a_task_that_hangs_is_stopped(make_executor) -> None:
    with make_executor(5) as executor:
        found = collect(executor, time.sleep, [(600,), (0,), (0,), (0,)])
    assert found.pop(0) == (None, "it took longer than 5 seconds")
    assert all(reason is None for _, reason in found.values())


def test_a_bug_keeps_its_traceback(executor) -> None:
    with pytest.raises(ZeroDivisionError) as bug:
        collect(executor, divmod, [(1, 0)])
    assert "function(*task)" in "".join(bug.value.__notes__)


def test_stopping_half_way_leaves_a_working_executor(executor) -> None:
    outcomes = executor.run(divmod, [(i, 2) for i in range(100)])
    next(outcomes)
    outcomes.close()
    assert collect(executor, divmod, [(9, 2)]) == {0: ((4, 1), None)}


def test_cpu_seconds_are_those_of_the_worker(executor) -> None:
    list(executor.run(divmod, [(1, 1)] * 4))
    outcomes = list(
        executor.run(
            exec, [("import time\nend = time.process_time() + 0.3\nwhile time.process_time() < end: pass",)]
        )
    )
    assert 0.3 <= outcomes[0].cpu_seconds < 1


def test_no_process_is_left_behind(make_executor) -> None:
    with make_executor(60) as executor:
        pids = {value for value, _ in collect(executor, os.getpid, [()] * 10).values()}
    for pid in pids:
        with pytest.raises(ProcessLookupError):
            os.kill(pid, 0)
