"""A place where a site cannot be, refused before anything is computed and with nothing left there."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from reports import make_report
from small_database import write_database

import shapeviz_report
from shapeviz_report.errors import CacheError, ConfigError, DatabaseError, ShapevizError, SiteError
from shapeviz_report.system import is_mount_point
from shapeviz_report.writing import check_destination, write_site

LONG = "a" * 300


@pytest.fixture
def places(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    write_database(Path("db"), per_class=1)
    Path("file").write_text("")
    Path("loop").symlink_to("loop")
    Path("to-db").symlink_to("db")
    os.mkfifo("pipe")
    return tmp_path


def listing(folder: Path) -> list[str]:
    return sorted(os.fspath(path) for path in folder.rglob("*"))


@pytest.mark.parametrize(
    "output",
    [
        "file",
        "file/site",
        "loop",
        "loop/site",
        "pipe",
        "db",
        "to-db",
        "db/",
        ".",
        "..",
        LONG,
        f"new/{LONG}",
        "cache",
        "cache/site",
        "a\0b",
        "\ud800",
    ],
)
def test_a_place_that_cannot_be_is_refused_first_and_nothing_is_left(places, output):
    before = listing(places)
    with pytest.raises(SiteError) as refused:
        shapeviz_report.build("db", output, cache="cache")
    assert str(Path(output)) in str(refused.value)
    assert "[Errno" not in str(refused.value)
    if LONG in output:
        assert "choose a shorter name" in str(refused.value)
    assert listing(places) == before


@pytest.mark.parametrize("cache", ["file", "file/x", "loop", "pipe", "db/kept", "to-db/kept", "c" * 300])
def test_a_cache_that_cannot_be_is_refused_first(places, cache):
    before = listing(places)
    with pytest.raises(CacheError) as refused:
        shapeviz_report.build("db", "site", cache=cache)
    assert cache in str(refused.value)
    assert listing(places) == before


@pytest.mark.parametrize("option", ["cache", "introduction", "logo", "bins", "external"])
@pytest.mark.parametrize("name", ["a\0b", "\ud800"])
def test_an_option_that_no_file_can_be_called_is_refused(places, option, name):
    with pytest.raises(ConfigError, match=f"{option} .* is no path that can be followed"):
        shapeviz_report.check("db", **{option: name})


@pytest.mark.parametrize("database", ["nowhere", "loop", "pipe", "d" * 300, "a\0b", "\ud800"])
def test_a_database_that_cannot_be_is_refused(places, database):
    with pytest.raises(DatabaseError, match=database):
        shapeviz_report.build(database, "site", cache="cache")


@pytest.mark.parametrize("name", ["n" * 255, os.fsdecode(b"\xff\xe4"), "two\nlines"])
def test_every_name_that_the_system_takes_is_a_place(tmp_path, name):
    check_destination(tmp_path / name)
    (tmp_path / name).mkdir()
    check_destination(tmp_path / name)
    assert os.listdir(tmp_path) == [name]


def test_a_site_may_lie_in_the_folder_of_its_database(places):
    check_destination(Path("db/site"), kept={"the database": Path("db")})


def test_the_current_folder_is_not_exchanged(places, monkeypatch):
    Path("site").mkdir()
    monkeypatch.chdir("site")
    with pytest.raises(SiteError, match="current folder"):
        check_destination(Path())


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_is_read_only_is_refused(tmp_path):
    write_site(make_report(), tmp_path / "site")
    (tmp_path / "site" / "mine").mkdir(mode=0o500)
    with pytest.raises(SiteError, match="mine"):
        check_destination(tmp_path / "site")
    tmp_path.chmod(0o500)
    with pytest.raises(SiteError, match="Permission denied"):
        check_destination(tmp_path / "other")
    tmp_path.chmod(0o700)


@pytest.mark.skipif(os.geteuid() != 0 or shutil.which("mount") is None, reason="only root mounts")
@pytest.mark.parametrize(
    ("options", "output", "said"),
    [
        (["-t", "tmpfs", "tmpfs"], "", "is a mount point"),
        (["--bind", "."], "", "is a mount point"),
        (["-t", "tmpfs", "-o", "ro", "tmpfs"], "site", "Read-only"),
        (["-t", "tmpfs", "-o", "size=16k", "tmpfs"], "site", "No space left .* make room there"),
    ],
)
def test_what_is_mounted_is_found_out(tmp_path, options, output, said):
    point = tmp_path / "a point"
    point.mkdir()
    if subprocess.run(["mount", *options, point], cwd=tmp_path, capture_output=True).returncode != 0:
        pytest.skip("this system lets nobody mount")
    try:
        assert is_mount_point(point)
        with pytest.raises(ShapevizError, match=said):
            check_destination(point / output)
    finally:
        subprocess.run(["umount", point], check=True)
