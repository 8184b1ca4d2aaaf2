"""The command asked to end, and outputs that take no more: no traceback, the right exit code, nothing left."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from signals import hear_signals
from small_database import write_database
from waiting import wait_until

STOPPED = "Stopped. What was computed is kept: the same command continues from here."


def start(folder: Path, **options) -> subprocess.Popen[str]:
    """A build in a process group of its own, which asks for signals whatever the tests were started from."""
    write_database(folder / "database", per_class=1)
    (folder / "temporary").mkdir()
    return subprocess.Popen(
        [sys.executable, "-m", "shapeviz_report", "build", "database", "-o", "site", "--cache", "cache"],
        cwd=folder,
        env=os.environ | {"TMPDIR": str(folder / "temporary")},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=hear_signals,
        **options,
    )


def is_listening(process: int, folder: Path) -> bool:
    """Whether a process has a way of its own to end, which Python has none of for this signal."""
    status = Path(f"/proc/{process}/status").read_text()
    caught = next(line for line in status.splitlines() if line.startswith("SigCgt:"))
    return bool(int(caught.split()[1], 16) >> (signal.SIGTERM - 1) & 1)


def is_importing(process: int, folder: Path) -> bool:
    return "llvmlite" in Path(f"/proc/{process}/maps").read_text()


def is_working(process: int, folder: Path) -> bool:
    return any((folder / "cache").glob("prepared/*/*"))


def group_of(leader: int) -> list[str]:
    """The processes of a group that live."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, group = status.read_text().rpartition(")")[2].split()[:3]
        except OSError:
            continue
        if int(group) == leader and state not in "ZX":
            found.append(status.parent.name)
    return found


@pytest.mark.parametrize(
    ("number", "times", "moment"),
    [
        (signal.SIGINT, 1, is_listening),
        (signal.SIGTERM, 1, is_importing),
        (signal.SIGINT, 1, is_working),
        (signal.SIGINT, 3, is_working),
        (signal.SIGHUP, 1, is_working),
        (signal.SIGTERM, 2, is_working),
    ],
)
def test_a_signal_ends_all_processes_with_its_code_and_nothing_left(tmp_path, number, times, moment) -> None:
    with start(tmp_path) as process:
        wait_until(lambda: process.poll() is not None or moment(process.pid, tmp_path))
        assert process.poll() is None
        for _ in range(times):
            os.killpg(process.pid, number)
            time.sleep(0.01)
        said = "".join(process.communicate(timeout=120))
    assert process.returncode == 128 + number
    assert "Traceback" not in said
    assert STOPPED in said or number != signal.SIGINT
    wait_until(lambda: not group_of(process.pid))
    assert os.listdir(tmp_path / "temporary") == []
    assert sorted(set(os.listdir(tmp_path)) - {"cache"}) == ["database", "temporary"]


@pytest.mark.parametrize(
    ("outputs", "code", "said"),
    [
        (">&- 2>/dev/full", 0, ""),
        (">/dev/full", 1, "what there is to say cannot be written: No space left on device"),
        ("2>&-", 0, ""),
        ("| head -1", 0, ""),
    ],
)
def test_outputs_that_take_no_more_bring_no_traceback(tmp_path, outputs, code, said) -> None:
    write_database(tmp_path / "database", per_class=1)
    command = f"{sys.executable} -m shapeviz_report check database --list {outputs}"
    done = subprocess.run(["bash", "-c", command], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == code
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
