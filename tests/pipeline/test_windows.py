"""Windows, simulated: what it lacks is taken away, and its half of ``system/`` runs. See ``simulated_windows/``."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from small_database import OPTIONS, read_site

SIMULATION = Path(__file__).parents[1] / "simulated_windows"


def run(script: str, *arguments: object) -> str:
    """What a script prints."""
    head = "import sys, shapeviz_report.system as system\nassert 'windows' in system.held.__module__\n"
    done = subprocess.run(
        [sys.executable, "-P", "-c", head + textwrap.dedent(script), *map(str, arguments)],
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(SIMULATION), *sys.path])},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_site_is_the_same(database, unsearched, tmp_path) -> None:
    run(
        f"""
        import shapeviz_report
        shapeviz_report.build(sys.argv[1], sys.argv[2], cache=sys.argv[3], **{OPTIONS | {"jobs": 2}!r})
        """,
        database,
        tmp_path / "site",
        tmp_path / "cache",
    )
    assert read_site(tmp_path / "site") == read_site(unsearched)
    assert sorted(os.listdir(tmp_path)) == ["cache", "site"]


def test_an_earlier_site_is_replaced_and_leftovers_go(built, tmp_path) -> None:
    run(
        """
        from pathlib import Path
        from shapeviz_report.writing.record import find_own, RECORD, record_text
        from shapeviz_report.writing.swap import replaced_folder
        from shapeviz_report.staging import hidden_prefix
        from hashlib import sha256

        site = Path(sys.argv[1]) / "site"
        abandoned = site.parent / (hidden_prefix("site", "writing") + "0123")
        abandoned.mkdir()
        for text in (b"one", b"two"):
            with replaced_folder(site, find_own) as folder:
                assert not abandoned.exists()
                (folder / "data").mkdir()
                (folder / "index.html").write_bytes(text)
                (folder / RECORD).write_bytes(record_text({"index.html": sha256(text).hexdigest()}))
            assert (site / "index.html").read_bytes() == text
            (site / "CNAME").write_text("kept")
        """,
        tmp_path,
    )
    assert os.listdir(tmp_path) == ["site"]
    assert sorted(os.listdir(tmp_path / "site")) == ["CNAME", "data", "index.html"]


@pytest.mark.parametrize("make", ["mkdir", "touch"])
def test_what_is_held_is_not_claimed(tmp_path, make) -> None:
    run(
        f"""
        from pathlib import Path
        old, new = Path(sys.argv[1]) / "old", Path(sys.argv[1]) / "new"
        old.{make}()

        def is_refused(way, path, kind):
            try:
                with way(path):
                    return False
            except kind:
                return True

        with system.held(old):
            assert is_refused(system.claimed, old, PermissionError)
            old.rename(new)
            assert is_refused(system.claimed, new, PermissionError)
        with system.claimed(new):
            assert is_refused(system.claimed, new, PermissionError)
            assert is_refused(system.held, new, FileNotFoundError)
        assert is_refused(system.held, old, FileNotFoundError)
        assert not is_refused(system.claimed, new, OSError)
        """,
        tmp_path,
    )


def test_two_processes_are_never_alone_at_once(tmp_path) -> None:
    script = """
        import os, time
        from pathlib import Path
        folder = Path(sys.argv[1])
        for _ in range(20):
            with system.alone_in(folder):
                (folder / "inside").mkdir()
                time.sleep(0.005)
                (folder / "inside").rmdir()
    """
    code = f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r}); "
    other = subprocess.Popen(
        [
            sys.executable,
            "-c",
            code + f"import test_windows; test_windows.run({script!r}, {str(tmp_path)!r})",
        ],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
    )
    run(script, tmp_path)
    assert other.wait() == 0
    assert os.listdir(tmp_path) == []


def test_workers_crash_hang_and_go_on() -> None:
    said = run(
        """
        import os, time
        from shapeviz_report.executor import LocalExecutor, memory_share
        print(memory_share(2) / 2**30)
        with LocalExecutor(2, 3, 2**30) as executor:
            tasks = [("0",), ("import os; os._exit(0xC0000005 & 255)",), ("import time; time.sleep(600)",)]
            for outcome in sorted(executor.run(exec, tasks), key=lambda outcome: outcome.index):
                print(outcome.reason)
            print(next(executor.run(len, [(bytes(300_000_000),)])).value)
        """
    )
    share, fine, crashed, late, size = said.splitlines()
    assert float(share) == pytest.approx(3.2)
    assert fine == "None"
    assert crashed.startswith("the process working on it ended (exit code 5)")
    assert late == "it took longer than 3 seconds; a larger time_limit may help"
    assert size == "300000000"


def test_a_worker_ends_with_its_parent(tmp_path) -> None:
    run(
        """
        import os, subprocess, time
        command = [sys.executable, "-c", "import shapeviz_report.system as s, time; s.end_with_parent(); "
                   "print(flush=True); time.sleep(600)"]
        child = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        child.stdout.readline()
        assert child.poll() is None
        child.stdin.close()
        assert child.wait(timeout=20) == 1
        """
    )
