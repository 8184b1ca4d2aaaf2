from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from numba import config

from shapeviz_report.compilation import kept_for

pytestmark = pytest.mark.slow


def run(package: Path, cache: Path) -> str:
    script = "from loops.outer import outer; print(outer(1.0), sum(outer.stats.cache_hits.values()))"
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join([str(package.parent), *sys.path]),
        "NUMBA_CACHE_DIR": str(cache),
    }
    return subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
    ).stdout.strip()


def test_machine_code_follows_a_change_in_a_called_module(tmp_path) -> None:
    package, cache = tmp_path / "loops", tmp_path / "cache"
    package.mkdir()
    decorated = "from shapeviz_report.compilation import kernel\n{}\n@kernel(error_model='numpy')\n"
    (package / "__init__.py").write_text("")
    (package / "inner.py").write_text(decorated.format("") + "def inner(x): return x + 1\n")
    (package / "outer.py").write_text(
        decorated.format("from loops.inner import inner") + "def outer(x): return inner(x)\n"
    )
    stamp = (package / "outer.py").stat().st_mtime_ns
    assert run(package, cache) == "2.0 0"
    assert run(package, cache) == "2.0 1", "compiled code is kept"
    (package / "inner.py").write_text(decorated.format("") + "def inner(x): return x + 7\n")
    assert (package / "outer.py").stat().st_mtime_ns == stamp
    assert run(package, cache) == "8.0 0"
    assert run(package, cache) == "8.0 1"


def test_compiling_is_a_pause_of_its_worker_and_loading_what_is_kept_is_none(tmp_path) -> None:
    package, cache = tmp_path / "loops", tmp_path / "cache"
    package.mkdir()
    (package / "__init__.py").write_text(
        "from shapeviz_report.executor.pauses import tell_pauses\ntell_pauses(print)\n"
    )
    (package / "outer.py").write_text(
        "from shapeviz_report.compilation import kernel\n@kernel()\ndef inner(x): return x + 1\n"
        "@kernel()\ndef outer(x): return inner(x)\n"
    )
    assert run(package, cache).split("\n") == ["True", "False", "2.0 0"]
    assert run(package, cache) == "2.0 1"


def _spoil(file: Path, how: str) -> None:
    content = file.read_bytes()
    if how == "folder":
        file.unlink()
        file.mkdir()
    else:
        file.write_bytes({"cut": content[:-7], "flipped": content[:-1] + bytes([content[-1] ^ 1])}[how])


def test_damaged_machine_code_is_compiled_anew_and_what_cannot_be_kept_is_compiled(tmp_path) -> None:
    package, cache = tmp_path / "loops", tmp_path / "cache"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "outer.py").write_text(
        "from shapeviz_report.compilation import kernel\n@kernel()\ndef outer(x): return x + 1\n"
    )
    assert run(package, cache) == "2.0 0"
    for ways in (("folder", "cut"), ("flipped", "folder")):
        # the index of a function, and its code
        for file, how in zip(sorted(p for p in cache.rglob("*") if p.is_file()), ways, strict=True):
            _spoil(file, how)
        assert run(package, cache) == "2.0 0"
        assert run(package, cache) == "2.0 1"
    shutil.rmtree(cache)
    cache.write_text("a file where the folder would be")
    assert run(package, cache) == "2.0 0"


def test_settings_of_numba_are_left_as_they_are() -> None:
    before = config.CACHE_DIR
    with kept_for("umap", "pynndescent"):
        assert before != config.CACHE_DIR
    assert before == config.CACHE_DIR
