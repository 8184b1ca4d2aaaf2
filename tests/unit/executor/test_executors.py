"""What both executors promise: workers that answer, refuse, crash and hang, in real processes."""

from __future__ import annotations

import os
import platform
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from cluster import running_cluster
from waiting import wait_until

from shapeviz_report.errors import MeshError, WorkerError
from shapeviz_report.executor import Executor, LocalExecutor, apart, call_apart
from shapeviz_report.executor.cluster import DaskExecutor
from shapeviz_report.mesh import read_mesh

pytestmark = pytest.mark.slow

GIB = 2**30


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    with running_cluster(tmp_path_factory.mktemp("cluster"), workers=2) as cluster:
        yield cluster


@pytest.fixture(params=["local", "cluster"])
def make_executor(request):
    """A function that opens an executor with two workers, given a time limit."""
    if request.param == "local":
        return lambda time_limit, memory_limit=2 * GIB: LocalExecutor(2, time_limit, memory_limit)
    address = request.getfixturevalue("cluster").address
    # Functions of the standard library: the workers of a cluster do not have our tests.
    return lambda time_limit, memory_limit=2 * GIB: DaskExecutor(
        address, time_limit, memory_limit, platform.python_version, os.getpid
    )


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
    value, reason = found.pop(3)
    assert value is None
    assert reason.startswith(
        f"the process working on it ended (signal {signal.SIGSEGV}), perhaps for want of"
    )
    assert all(reason is None for _, reason in found.values())
    assert len(found) == 7


def test_a_task_that_hangs_is_stopped(make_executor) -> None:
    with make_executor(5) as executor:
        found = collect(executor, time.sleep, [(600,), (0,), (0,), (0,)])
    assert found.pop(0) == (None, "it took longer than 5 seconds; a larger time_limit may help")
    assert all(reason is None for _, reason in found.values())


def test_with_patience_a_task_may_take_longer(make_executor) -> None:
    with make_executor(1) as executor:
        (outcome,) = executor.run(time.sleep, [(2,)], 20.0)
        assert outcome.reason is None
        (outcome,) = executor.run(time.sleep, [(60,)], 2.5)
        assert outcome.reason == "it took longer than 2.5 seconds; a larger time_limit may help"


def test_what_a_worker_does_once_for_all_its_tasks_is_no_task_s_time(make_executor) -> None:
    pausing = "import time; from shapeviz_report.executor.pauses import pause; pause(True); time.sleep(4); pause(False)"
    with make_executor(3) as executor:
        found = collect(
            executor, exec, [(pausing,), (f"{pausing}; time.sleep(1)",), (f"{pausing}; time.sleep(600)",)]
        )
    assert found.pop(2) == (None, "it took longer than 3 seconds; a larger time_limit may help")
    assert {reason for _, reason in found.values()} == {None}


# Touched and untouched memory, in one piece and in many, asked for by Python, by numpy and by C.
_GREEDY = {
    "one piece": "bytearray(3 << 30)",
    "untouched": "import numpy; numpy.empty(3 << 30, numpy.uint8)",
    "many pieces": "kept = []\nwhile True: kept.append(bytearray(1 << 20))",
    "a huge count": "import numpy; numpy.zeros(1 << 50)",
    "a mapping": "import mmap; mmap.mmap(-1, 3 << 30, flags=mmap.MAP_PRIVATE)",
    "its answer": "raise MemoryError",
}


@pytest.mark.skipif(platform.system() != "Linux", reason="only Linux bounds the memory of a process")
@pytest.mark.parametrize("kind", _GREEDY)
def test_a_task_that_takes_too_much_memory_is_told_so(make_executor, kind: str) -> None:
    with make_executor(60, GIB) as executor:
        found = collect(executor, exec, [("0",), (_GREEDY[kind],), ("0",), ("bytearray(1 << 28)",)])
    value, reason = found.pop(1)
    assert value is None
    assert reason.startswith("it needs more memory than there is for it: one process may take 1.0 GiB;")
    assert found == dict.fromkeys((0, 2, 3), (None, None))


@pytest.mark.skipif(platform.system() != "Linux", reason="only Linux bounds the memory of a process")
def test_native_code_that_dies_for_want_of_memory_takes_one_task_only(executor) -> None:
    greedy = "import ctypes\nwhile p := ctypes.CDLL(None).malloc(1 << 20): pass\nimport os; os.abort()"
    found = collect(executor, exec, [("0",), (greedy,), ("0",)])
    assert "perhaps for want of memory: one process may take 2.0 GiB" in found.pop(1)[1]
    assert found == dict.fromkeys((0, 2), (None, None))


@pytest.mark.skipif(platform.system() != "Linux", reason="only Linux bounds the memory of a process")
def test_a_task_too_large_to_be_handed_over_is_told_so() -> None:
    with LocalExecutor(2, 60, GIB) as executor:
        found = collect(executor, len, [(b"0",), (bytes(9 << 27),), (b"000",)])
    assert "needs more memory" in found.pop(1)[1]
    assert found == {0: (1, None), 2: (3, None)}


def test_a_worker_that_cannot_be_started_is_a_sentence(monkeypatch) -> None:
    monkeypatch.setattr(sys, "executable", "/nowhere/python")
    with (
        LocalExecutor(1, 60, GIB) as executor,
        pytest.raises(WorkerError, match="cannot be started: No such"),
    ):
        collect(executor, os.getpid, [()])


@pytest.mark.skipif(
    platform.system() != "Linux", reason="elsewhere a worker ends when its native code returns"
)
@pytest.mark.parametrize("native", [False, True])
def test_workers_end_when_their_parent_is_killed(tmp_path, native: bool) -> None:
    # PyDLL keeps the interpreter's lock while C sleeps: no thread of the worker can run meanwhile.
    busy = "import ctypes; ctypes.PyDLL(None).sleep(600)" if native else "import time; time.sleep(600)"
    task = (
        f"import os; from pathlib import Path; (Path({str(tmp_path)!r}) / str(os.getpid())).touch(); {busy}"
    )
    script = (
        "from shapeviz_report.executor import LocalExecutor\n"
        f"list(LocalExecutor(2, 600, 2**30).run(exec, [({task!r},)] * 2))"
    )
    parent = subprocess.Popen([sys.executable, "-c", script])
    try:
        wait_until(lambda: len(list(tmp_path.iterdir())) == 2)
    finally:
        parent.kill()
        parent.wait()
    pids = [int(file.name) for file in tmp_path.iterdir()]
    wait_until(lambda: not any(is_running(pid) for pid in pids))


def is_running(pid: int) -> bool:
    # One that nobody has collected yet has ended too.
    try:
        return (Path("/proc") / str(pid) / "stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except FileNotFoundError:
        return False


def test_no_descriptor_is_left_open() -> None:
    before = len(os.listdir("/dev/fd"))
    with LocalExecutor(2, 60, GIB) as executor:
        collect(executor, exec, [("0",), ("import os; os._exit(3)",), ("raise MemoryError",)])
    assert len(os.listdir("/dev/fd")) == before


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


@pytest.mark.skipif(platform.system() != "Linux", reason="a disk that is always full")
def test_a_worker_whose_disk_is_full_ends_the_run_with_a_sentence(executor) -> None:
    with pytest.raises(WorkerError, match="cannot go on: No space left on device"):
        collect(executor, exec, [("open('/dev/full', 'wb', 0).write(b'0')",)])


def test_what_is_called_apart_ends_no_other_process(monkeypatch) -> None:
    assert call_apart(divmod, 7, 2) == (3, 1)
    with pytest.raises(ValueError, match="invalid literal"):
        call_apart(int, "seven")
    with pytest.raises(ValueError, match=r"^the process working on it ended \(exit code 5\)"):
        call_apart(os._exit, 5)
    monkeypatch.setattr(apart, "MOST_SECONDS", 1.0)
    with pytest.raises(ValueError, match=r"^it took longer than 1 seconds$"):
        call_apart(time.sleep, 600)
