from __future__ import annotations

import os
import subprocess
import sys
import textwrap

import pytest

from shapeviz_report.cache import Cache, default_root, make_key, write_atomically
from shapeviz_report.errors import CacheError


def test_an_entry_comes_back(tmp_path) -> None:
    cache = Cache(tmp_path / "new" / "folder")
    assert cache.load("stage", "abcdef") is None
    cache.store("stage", "abcdef", b"content")
    assert cache.load("stage", "abcdef") == b"content"
    assert cache.load("other", "abcdef") is None


def test_keys_tell_parts_apart() -> None:
    keys = {
        make_key(*parts)
        for parts in [("a", "b"), ("ab",), ("a", "b", 1), ("a", "b", 1.0), ("a", "b", "1"), (b"a", "b")]
    }
    assert len(keys) == 6
    assert make_key("a", 0.01) == make_key("a", 0.01)


def test_a_writer_killed_half_way_leaves_the_old_content(tmp_path) -> None:
    path = tmp_path / "entry"
    write_atomically(path, b"old")
    script = textwrap.dedent(
        """
        import os, signal, sys
        from pathlib import Path
        from shapeviz_report import cache
        replace = os.replace
        os.replace = lambda *a: os.kill(os.getpid(), signal.SIGKILL)
        cache.write_atomically(Path(sys.argv[1]), b"new" * 100000)
        """
    )
    assert subprocess.run([sys.executable, "-c", script, str(path)], check=False).returncode == -9
    assert path.read_bytes() == b"old"


def test_a_failed_write_leaves_nothing(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(os, "replace", lambda *a: (_ for _ in ()).throw(OSError("disk")))
    with pytest.raises(OSError, match="disk"):
        write_atomically(tmp_path / "entry", b"x")
    assert list(tmp_path.iterdir()) == []


def test_default_root(monkeypatch, tmp_path) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert default_root() == tmp_path / "shapeviz-report"


def _spoil(path, kind: str, other: bytes) -> None:
    entry = path.read_bytes()
    flip = {"mark": 0, "digest": 30, "first": 56, "last": -1}
    if kind in flip:
        changed = bytearray(entry)
        changed[flip[kind]] ^= 1
        path.write_bytes(changed)
    elif kind in ("folder", "pipe", "link to nowhere", "link to a folder"):
        path.unlink()
        if kind == "folder":
            path.mkdir()
            (path / "file").write_bytes(b"x")
        elif kind == "pipe":
            os.mkfifo(path)
        else:
            path.symlink_to(path.parent if kind == "link to a folder" else "nowhere")
    else:
        path.write_bytes(
            {
                "empty": b"",
                "cut in its head": entry[:20],
                "cut": entry[:-7],
                "longer": entry + b"x",
                "without a head": entry[56:],
                "random": bytes(range(256)) * 9,
                "of another stage": other,
            }[kind]
        )


@pytest.mark.parametrize(
    "kind",
    [
        "mark", "digest", "first", "last", "folder", "pipe", "link to nowhere", "link to a folder", "empty",
        "cut in its head", "cut", "longer", "without a head", "random", "of another stage",
    ],
)  # fmt: skip
def test_a_spoiled_entry_is_thrown_away_and_can_be_stored_anew(tmp_path, caplog, kind: str) -> None:
    cache = Cache(tmp_path)
    cache.store("stage", "abcdef", b"some content")
    cache.store("other", "abcdef", b"some content")
    _spoil(cache.path("stage", "abcdef"), kind, cache.path("other", "abcdef").read_bytes())
    assert cache.load("stage", "abcdef") is None
    assert cache.spoiled == 1
    cache.store("stage", "abcdef", b"some content")
    assert cache.load("stage", "abcdef") == b"some content"
    assert cache.load("other", "abcdef") == b"some content"
    cache.tell_spoiled()
    assert "1 kept result in the cache" in caplog.text


def test_a_cache_that_takes_no_results_is_told_of(tmp_path) -> None:
    (tmp_path / "cache").write_text("a file where the folder should be")
    with pytest.raises(CacheError, match="what was kept before stays"):
        Cache(tmp_path / "cache").store("stage", "0123", b"content")
