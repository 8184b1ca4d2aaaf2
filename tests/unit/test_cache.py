from __future__ import annotations

import errno
import os
import shutil
import stat
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import shapeviz_report.cache
from shapeviz_report.cache import Cache, default_root, make_key
from shapeviz_report.errors import CacheError
from shapeviz_report.staging import write_atomically


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
        from shapeviz_report.staging import write_atomically
        Path.replace = lambda *a: os.kill(os.getpid(), signal.SIGKILL)
        write_atomically(Path(sys.argv[1]), b"new" * 100000)
        """
    )
    assert subprocess.run([sys.executable, "-c", script, str(path)], check=False).returncode == -9
    assert path.read_bytes() == b"old"


def test_a_failed_write_leaves_nothing(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(Path, "replace", lambda *a: (_ for _ in ()).throw(OSError("disk")))
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
    elif kind == "200 GB":
        os.truncate(path, 200 * 2**30)
    elif kind in ("folder", "pipe", "socket", "link to nowhere", "link to itself", "link to a folder"):
        path.unlink()
        if kind == "folder":
            path.mkdir()
            (path / "file").write_bytes(b"x")
        elif kind == "pipe":
            os.mkfifo(path)
        elif kind == "socket":
            os.mknod(path, stat.S_IFSOCK | 0o644)
        else:
            to = {"link to a folder": path.parent, "link to itself": path, "link to nowhere": "nowhere"}
            path.symlink_to(to[kind])
    elif "place" in kind:
        place = path.parent if kind.startswith("its folder") else path.parent.parent
        shutil.rmtree(place)
        place.symlink_to(place) if "link" in kind else place.write_text("x")
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
        "mark", "digest", "first", "last", "folder", "pipe", "socket", "link to nowhere", "link to itself",
        "link to a folder", "empty", "cut in its head", "cut", "longer", "without a head", "random", "of another stage",
        "200 GB", "its folder's place taken", "its stage's place taken", "its folder's place a link to itself",
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
    cache.tell()
    assert "1 kept result in the cache" in caplog.text
    assert "could not be kept" not in caplog.text


def _lock(path, how: str) -> None:
    """Make something that not even its owner may change; root may all the same, but for what is mounted."""
    if how == "mounted":
        if subprocess.run(["mount", "--bind", path, path], capture_output=True).returncode != 0:
            pytest.skip("this system lets nobody mount")
    elif os.geteuid() == 0:
        pytest.skip("root may write everywhere")
    else:
        (path if how == "closed folder in its place" else path.parent).chmod(0o500)


@pytest.mark.parametrize("how", ["mounted", "folder read-only", "closed folder in its place"])
def test_a_spoiled_entry_that_cannot_be_replaced_is_held_for_the_run(tmp_path, caplog, how: str) -> None:
    Cache(tmp_path).store("stage", "abcdef", b"content")
    cache = Cache(tmp_path)
    path = cache.path("stage", "abcdef")
    if how == "closed folder in its place":
        path.unlink()
        (path / "inside").mkdir(parents=True)
    else:
        path.write_bytes(b"spoiled")
    _lock(path, how)
    try:
        assert cache.load("stage", "abcdef") is None
        cache.store("stage", "abcdef", b"content")
        assert cache.load("stage", "abcdef") == b"content"
        assert Cache(tmp_path).load("stage", "abcdef") is None
    finally:
        if how == "mounted":
            subprocess.run(["umount", path], check=True)
        else:
            path.parent.chmod(0o700)
            path.chmod(0o700)
    cache.tell()
    assert caplog.text.count("Note: ") == 1
    assert "1 kept result in the cache" in caplog.text
    assert (
        f"1 result could not be kept there, and will be computed again: {_said(how)} ({path})" in caplog.text
    )


def _said(how: str) -> str:
    return {
        "mounted": os.strerror(errno.EBUSY),
        "folder read-only": os.strerror(errno.EACCES),
        "closed folder in its place": os.strerror(errno.EISDIR),
    }[how]


def test_more_than_can_be_held_is_told_at_once(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(shapeviz_report.cache, "MOST_HELD", 10)
    cache = Cache(tmp_path)
    (tmp_path / "stage").mkdir()
    (tmp_path / "stage" / "ab").write_text("in the way")
    cache.store("stage", "abcdef", bytes(6))
    with pytest.raises(CacheError, match="Make room there"):
        cache.store("stage", "abcdf0", bytes(6))


def test_what_a_killed_writer_left_goes_with_the_next(tmp_path) -> None:
    path = tmp_path / "entry"
    script = textwrap.dedent(
        """
        import os, signal, sys
        from pathlib import Path
        from shapeviz_report.staging import write_atomically
        Path.replace = lambda *a: os.kill(os.getpid(), signal.SIGKILL)
        write_atomically(Path(sys.argv[1]), b"new" * 100000)
        """
    )
    for _ in range(2):
        assert subprocess.run([sys.executable, "-c", script, str(path)], check=False).returncode == -9
        assert len(os.listdir(tmp_path)) == 1
    write_atomically(path, b"new")
    assert os.listdir(tmp_path) == ["entry"]


def test_a_cache_that_takes_no_results_is_told_of(tmp_path) -> None:
    (tmp_path / "cache").write_text("a file where the folder should be")
    with pytest.raises(CacheError, match="what was kept before stays"):
        Cache(tmp_path / "cache").store("stage", "0123", b"content")
