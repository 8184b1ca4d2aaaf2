"""What a cache holds is counted, and what was not used for long goes, and nothing else."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

from shapeviz_report.cache import Cache, make_key
from shapeviz_report.cli import main
from shapeviz_report.errors import CacheError
from shapeviz_report.pruning import DAY, choose_unused, list_entries, remove

NOW = time.time()


@pytest.fixture
def cache(tmp_path) -> Cache:
    """Four results, last used 0, 10, 20 and 40 days ago, of two stages."""
    cache = Cache(tmp_path / "cache")
    for number, days in enumerate((0, 10, 20, 40)):
        stage, key = ("prepared", "rendered")[number % 2], make_key(number)
        cache.store(stage, key, bytes(1000))
        os.utime(cache.path(stage, key), (NOW - days * DAY,) * 2)
    return cache


def days_of(entries) -> list[int]:
    return [round((NOW - entry.used) / DAY) for entry in entries]


def test_entries_are_found_with_their_stage_size_and_last_use(cache) -> None:
    found = sorted(list_entries(cache.root))
    assert days_of(found) == [40, 20, 10, 0]
    assert [entry.stage for entry in found] == ["rendered", "prepared", "rendered", "prepared"]
    assert {entry.size for entry in found} == {os.path.getsize(found[0].path)}


@pytest.mark.parametrize(
    ("days", "most", "left"),
    [
        (30, None, [20, 10, 0]),
        (15, None, [10, 0]),
        (None, 2.5, [10, 0]),
        (15, 1, [0]),
        (30, 0, []),
        (99, 9, [40, 20, 10, 0]),
    ],
)
def test_the_longest_unused_go(cache, days, most, left) -> None:
    size = next(list_entries(cache.root)).size
    bytes_left = None if most is None else int(most * size)
    chosen = choose_unused(list_entries(cache.root), NOW, days=days, most=bytes_left)
    assert remove(chosen) == (4 - len(left), (4 - len(left)) * size)
    assert days_of(sorted(list_entries(cache.root))) == left


def test_what_is_used_counts_as_new_and_is_kept(cache) -> None:
    assert cache.load("rendered", make_key(3)) == bytes(1000)
    assert cache.load("prepared", make_key(0)) == bytes(1000)
    assert days_of(sorted(list_entries(cache.root)))[:2] == [20, 10]
    assert choose_unused(list_entries(cache.root), NOW, days=30) == []


def test_what_is_not_ours_stays(cache, tmp_path) -> None:
    folder = cache.path("prepared", make_key(0)).parent
    strangers = [
        cache.root / "thesis.txt",
        cache.root / "prepared" / "notes",
        folder / "README",
        folder / ("0" * 38),  # has the name of a result, and is none
        cache.root / "Photos" / "ab" / ("1" * 38),
    ]
    outside = tmp_path / "outside"
    for path in (*strangers, outside):
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_bytes(b"mine")
    (folder / ("2" * 38)).symlink_to(outside)
    (cache.root / "linked").symlink_to(tmp_path)
    remove(choose_unused(list_entries(cache.root), NOW + DAY, most=0))
    assert all(path.read_bytes() == b"mine" for path in (*strangers, outside))
    assert (folder / ("2" * 38)).is_symlink()
    assert not cache.path("rendered", make_key(1)).parent.exists(), "nor do empty folders stay"


def test_the_command_tells_and_removes(cache, capsys) -> None:
    root = str(cache.root)
    assert main(["cache", "--cache", root]) == 0
    told = capsys.readouterr().out
    assert "holds 4 results, 4.2 kB." in told
    assert "today to 20 days ago" in told
    assert "Not used for 30 days: 1 result, 1.1 kB; --unused 30 removes them." in told
    assert main(["cache", "--cache", root, "--unused", "15", "--dry-run"]) == 0
    assert "2 results, 2.1 kB, would be removed; 2.1 kB stay." in capsys.readouterr().out
    assert len(list(list_entries(cache.root))) == 4
    assert main(["cache", "--cache", root, "--keep", "0.000003"]) == 0
    assert "2 results, 2.1 kB, were removed; 2.1 kB stay." in capsys.readouterr().out
    assert len(list(list_entries(cache.root))) == 2


@pytest.mark.parametrize("number", ["-1", "nan", "inf", "all"])
def test_a_number_that_is_none_is_refused(cache, number, capsys) -> None:
    with pytest.raises(SystemExit):
        main(["cache", "--cache", str(cache.root), "--unused", number])
    assert "--unused" in capsys.readouterr().err
    assert len(list(list_entries(cache.root))) == 4


def test_a_cache_that_is_not_there_is_empty_and_a_file_is_an_error(tmp_path, capsys) -> None:
    assert main(["cache", "--cache", str(tmp_path / "none")]) == 0
    assert "holds 0 results, 0 bytes." in capsys.readouterr().out
    Path(tmp_path / "file").write_text("x", encoding="utf-8")
    with pytest.raises(CacheError, match="cannot be read: Not a directory"):
        list(list_entries(tmp_path / "file"))
