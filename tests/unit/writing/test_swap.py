"""A folder that appears at once, whatever happens to its writer."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

from shapeviz_report.writing.swap import replaced_folder

pytestmark = pytest.mark.slow

WRITER = """
import sys, time
from pathlib import Path
from shapeviz_report.writing.swap import replaced_folder
with replaced_folder(Path(sys.argv[1]), lambda folder: set()) as folder:
    (folder / "new").write_text("half")
    print(folder, flush=True)
    time.sleep(60)
"""


def everything(folder):
    """All that lies in a folder is the site's own."""
    return set(os.listdir(folder))


def test_a_new_folder_appears_with_its_parents(tmp_path):
    destination = tmp_path / "deep" / "site"
    with replaced_folder(destination, everything) as folder:
        (folder / "page").write_text("content")
        assert not destination.exists()
    assert (destination / "page").read_text() == "content"
    assert os.listdir(destination.parent) == ["site"]


def test_an_old_folder_is_replaced_whole(tmp_path):
    destination = tmp_path / "site"
    destination.mkdir()
    (destination / "old").write_text("old")
    with replaced_folder(destination, everything) as folder:
        (folder / "new").write_text("new")
        assert os.listdir(destination) == ["old"]
    assert os.listdir(destination) == ["new"]
    assert os.listdir(tmp_path) == ["site"]


def test_an_error_leaves_the_old_folder_and_nothing_else(tmp_path):
    destination = tmp_path / "site"
    destination.mkdir()
    (destination / "old").write_text("old")

    def fail_half_way():
        with replaced_folder(destination, everything) as folder:
            (folder / "new").write_text("half")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail_half_way()
    assert os.listdir(destination) == ["old"]
    assert os.listdir(tmp_path) == ["site"]


def test_a_killed_writer_leaves_the_old_folder_and_the_next_one_cleans_up(tmp_path):
    destination = tmp_path / "site"
    destination.mkdir()
    (destination / "old").write_text("old")
    with subprocess.Popen(
        [sys.executable, "-c", WRITER, destination], stdout=subprocess.PIPE, text=True
    ) as writer:
        left = writer.stdout.readline().strip()
        writer.send_signal(signal.SIGKILL)
    assert os.listdir(destination) == ["old"]
    assert os.path.isdir(left)
    with replaced_folder(destination, everything) as folder:
        (folder / "new").write_text("new")
    assert os.listdir(destination) == ["new"]
    assert os.listdir(tmp_path) == ["site"]


def test_a_writer_that_lives_is_left_alone(tmp_path):
    destination = tmp_path / "site"
    with subprocess.Popen(
        [sys.executable, "-c", WRITER, destination], stdout=subprocess.PIPE, text=True
    ) as writer:
        working = writer.stdout.readline().strip()
        with replaced_folder(destination, everything) as folder:
            (folder / "new").write_text("new")
        assert os.path.isfile(os.path.join(working, "new"))
        writer.kill()


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux exchanges two folders in one step")
def test_there_is_no_instant_without_a_folder(tmp_path):
    destination = tmp_path / "site"
    destination.mkdir()
    (destination / "page").write_text("0")
    missing = []
    done = threading.Event()

    def watch():
        while not done.is_set():
            if not (destination / "page").exists():
                missing.append(time.monotonic())

    watcher = threading.Thread(target=watch)
    watcher.start()
    for round_number in range(200):
        with replaced_folder(destination, everything) as folder:
            (folder / "page").write_text(str(round_number))
    done.set()
    watcher.join()
    assert not missing
    assert (destination / "page").read_text() == "199"


def test_a_link_keeps_pointing_to_the_folder(tmp_path):
    real = tmp_path / "real"
    real.mkdir()
    link = tmp_path / "link"
    link.symlink_to(real)
    with replaced_folder(link, everything) as folder:
        (folder / "new").write_text("new")
    assert link.is_symlink()
    assert os.listdir(real) == ["new"]
