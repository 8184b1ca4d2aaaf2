"""macOS, simulated: what its half of ``posix.py`` does where Linux has more."""

from __future__ import annotations

import ctypes
import os
import resource
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from shapeviz_report.system import posix


@pytest.fixture
def macos(monkeypatch) -> None:
    monkeypatch.setattr(posix, "sys", SimpleNamespace(platform="darwin"))


def test_places_are_those_of_the_system(macos, monkeypatch) -> None:
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    assert posix.cache_folder() == Path.home() / "Library" / "Caches"
    monkeypatch.setenv("XDG_CACHE_HOME", "/elsewhere")
    assert posix.cache_folder() == Path("/elsewhere")


def test_what_the_system_does_not_tell_is_taken_whole(macos, monkeypatch, tmp_path) -> None:
    monkeypatch.delattr(os, "sched_getaffinity")
    assert posix.core_count() == os.cpu_count()
    assert posix.free_memory(tmp_path) == os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def test_no_bound_of_memory_is_set(macos) -> None:
    before = resource.getrlimit(resource.RLIMIT_DATA)
    posix.bound_memory(os.getpid(), 2**30)
    assert resource.getrlimit(resource.RLIMIT_DATA) == before


def test_two_folders_cannot_be_exchanged(macos, monkeypatch, tmp_path) -> None:
    monkeypatch.setattr(ctypes, "CDLL", lambda name, use_errno: SimpleNamespace())
    assert posix.exchange(tmp_path, tmp_path) is False


def test_a_worker_ends_with_its_parent() -> None:
    script = (
        "import time, types; from shapeviz_report.system import posix; "
        "posix.sys = types.SimpleNamespace(platform='darwin'); posix.end_with_parent(); "
        "print(flush=True); time.sleep(600)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as child:
        assert child.stdout is not None
        assert child.stdin is not None
        child.stdout.readline()
        assert child.poll() is None
        child.stdin.close()
        assert child.wait(timeout=20) == 1
