"""What of a folder a site may remove: what it wrote and nobody has changed, and nothing else."""

import json
import os
import signal
import sys
from hashlib import sha256
from pathlib import Path

import pytest
from reports import make_report, with_bin_search, with_models, with_paintings, with_scores

from shapeviz_report.errors import SiteError
from shapeviz_report.writing import check_destination, swap, write_site
from shapeviz_report.writing.record import RECORD, find_own, may_be_written, record_text
from shapeviz_report.writing.swap import replaced_folder

pytestmark = pytest.mark.slow


def whole_report():
    """A report with all parts that may be missing."""
    return with_models(with_paintings(with_bin_search(with_scores(make_report()))))


ODD = os.fsdecode(b"n\xe4me \n*")


def keep_things(site: Path) -> None:
    """What publishers keep in the folder of a site."""
    (site / "CNAME").write_text("shapes.example.org")
    (site / ".git" / "objects").mkdir(parents=True)
    (site / ".git" / "objects" / "ab").write_bytes(b"\0packed")
    (site / "empty").mkdir()
    (site / "to-nowhere").symlink_to("nowhere")
    (site / "locked.txt").write_text("read only")
    (site / "locked.txt").chmod(0o400)
    (site / ODD).write_text("odd")
    (site / "data" / "mine.csv").write_text("1,2")
    (site / "models" / "notes").mkdir(exist_ok=True, parents=True)
    (site / "models" / "notes" / "a").write_text("a")


def kept(site: Path) -> set[tuple[str, str]]:
    """What of :func:`keep_things` is there."""
    there = set()
    for name in ("CNAME", ".git/objects/ab", "locked.txt", ODD, "data/mine.csv", "models/notes/a"):
        if (site / name).is_file():
            there.add((name, (site / name).read_bytes().hex()))
    if (site / "empty").is_dir():
        there.add(("empty", ""))
    if (site / "to-nowhere").is_symlink():
        there.add(("to-nowhere", os.readlink(site / "to-nowhere")))
    return there


def test_every_name_that_a_site_writes_is_known_beforehand(tmp_path):
    write_site(whole_report(), tmp_path / "site")
    names = {
        p.relative_to(tmp_path / "site").as_posix() for p in (tmp_path / "site").rglob("*") if p.is_file()
    }
    unknown = [name for name in sorted(names) if not may_be_written(name)]
    assert not unknown, "name them in DATA_NAMES of writing/data/files.py, or in _NAME of writing/record.py"
    assert find_own(tmp_path / "site") == names


@pytest.mark.parametrize("recorded", [True, False])
def test_what_a_publisher_keeps_stays_and_what_the_site_wrote_goes(tmp_path, recorded):
    site = tmp_path / "site"
    write_site(whole_report(), site)
    if not recorded:
        (site / RECORD).unlink()
    keep_things(site)
    inode, before = (site / ".git").stat().st_ino, kept(site)
    old_thumbnails = set(os.listdir(site / "thumbnails"))
    write_site(make_report(["bird"], 3), site)
    assert kept(site) == before
    assert len(before) == 8
    assert (site / ".git").stat().st_ino == inode
    assert len(os.listdir(site / "thumbnails")) <= 3 < len(old_thumbnails)
    assert os.listdir(tmp_path) == ["site"]


@pytest.mark.parametrize("name", ["index.html", "data/shapes.csv", "assets/style.css"])
def test_a_file_of_the_site_that_was_changed_is_refused_by_name(tmp_path, name):
    site = tmp_path / "site"
    write_site(make_report(), site)
    (site / name).write_text("mine now")
    with pytest.raises(SiteError, match=name):
        write_site(make_report(), site)
    assert (site / name).read_text() == "mine now"


def test_a_folder_of_the_publisher_under_a_name_of_the_site_is_refused(tmp_path):
    site = tmp_path / "site"
    write_site(make_report(), site)
    (site / "preview.png").unlink()
    (site / "preview.png").mkdir()
    with pytest.raises(SiteError, match=r"preview\.png"):
        check_destination(site)


def test_a_link_in_the_place_of_a_folder_of_the_site_is_not_followed(tmp_path):
    site = tmp_path / "site"
    write_site(make_report(), site)
    (site / "data").rename(tmp_path / "elsewhere")
    (site / "data").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(SiteError, match="data"):
        write_site(make_report(), site)
    assert json.loads((tmp_path / "elsewhere" / "files.json").read_text())


BESIDE = [
    "CNAME",
    "robots.txt",
    ".nojekyll",
    "LICENSE.md",
    "README.md",
    "_headers",
    "google0123456789abcdef.html",
]


def test_the_first_build_may_go_into_a_folder_with_what_publishers_keep(tmp_path):
    site = tmp_path / "checkout"
    (site / ".git" / "objects").mkdir(parents=True)
    (site / ".git" / "HEAD").write_text("ref: refs/heads/gh-pages")
    for name in BESIDE:
        (site / name).write_text(name)
    inode = (site / ".git").stat().st_ino
    write_site(make_report(), site)
    assert [(site / name).read_text() for name in BESIDE] == BESIDE
    assert (site / ".git" / "HEAD").read_text() == "ref: refs/heads/gh-pages"
    assert (site / ".git").stat().st_ino == inode
    assert not find_own(site) & {".git", *BESIDE}
    assert "index.html" in find_own(site)
    write_site(make_report(), site)
    assert [(site / name).read_text() for name in BESIDE] == BESIDE
    assert os.listdir(tmp_path) == ["checkout"]


@pytest.mark.parametrize("name", ["notes.txt", "index.html", "data/mine.csv", "cname"])
def test_the_first_build_does_not_go_among_other_things(tmp_path, name):
    site = tmp_path / "checkout"
    (site / name).parent.mkdir(parents=True)
    (site / name).write_text("mine")
    (site / "CNAME").write_text("shapes.example.org")
    with pytest.raises(SiteError, match="not a site of shapeviz-report"):
        write_site(make_report(), site)
    assert sorted(p.name for p in site.rglob("*") if p.is_file()) == sorted([Path(name).name, "CNAME"])


def test_two_writers_of_one_folder_lose_nothing_and_leave_nothing(tmp_path):
    site = tmp_path / "site"
    assert write_dying(site, 0, "exchange") == 0
    keep_things(site)
    before = kept(site)
    for _ in range(15):
        writers = []
        for _ in range(4):
            writers.append(os.fork())
            if writers[-1] == 0:
                os._exit(write_dying(site, 0, "exchange"))
        assert [os.waitstatus_to_exitcode(os.waitpid(writer, 0)[1]) for writer in writers] == [0] * 4
        assert kept(site) == before
    assert os.listdir(tmp_path) == ["site"]
    assert find_own(site) == {"index.html", "data/summary.json", f"models/{20 * 'b'}.js", RECORD}


def write_dying(site: Path, step: int, way: str) -> int:
    """Replace a folder in a process that kills itself before the given change of the file system (0: never).

    Returns its exit code, negative for a signal.
    """
    child = os.fork()
    if child == 0:
        try:
            _die_at(step)
            if way == "two renames":
                swap.exchange = lambda one, other: False
            with replaced_folder(site, find_own) as folder:
                hashes = {}
                for name in ("index.html", "data/summary.json", f"models/{20 * 'b'}.js"):
                    (folder / name).parent.mkdir(exist_ok=True)
                    (folder / name).write_bytes(b"new")
                    hashes[name] = sha256(b"new").hexdigest()
                (folder / RECORD).write_bytes(record_text(hashes))
            os._exit(0)
        finally:
            os._exit(1)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def _die_at(step: int) -> None:
    calls = 0

    def dying(function):
        def call(*arguments, **options):
            nonlocal calls
            calls += 1
            if calls == step:
                os.kill(os.getpid(), signal.SIGKILL)
            return function(*arguments, **options)

        return call

    for name in ("rename", "rmdir", "unlink", "mkdir"):
        setattr(os, name, dying(getattr(os, name)))
    swap.exchange = dying(swap.exchange)


@pytest.mark.parametrize("way", ["exchange", "two renames"])
def test_killed_before_any_step_nothing_is_lost_and_the_next_run_mends(tmp_path, way):
    if way == "exchange" and sys.platform != "linux":
        pytest.skip("only Linux exchanges two folders in one step")
    for step in range(1, 100):
        base = tmp_path / str(step)
        base.mkdir()
        site = base / "site"
        assert write_dying(site, 0, way) == 0
        keep_things(site)
        before = kept(site)
        code = write_dying(site, step, way)
        if way == "exchange":
            assert (
                (site / "index.html").read_bytes() == (site / "data" / "summary.json").read_bytes() == b"new"
            )
        assert write_dying(site, 0, way) == 0
        assert kept(site) == before, f"after a kill before step {step}"
        assert os.listdir(base) == ["site"]
        if code == 0:
            break
        assert code == -signal.SIGKILL
    assert 15 < step < 99
