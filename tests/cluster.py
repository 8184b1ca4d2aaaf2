"""A real Dask cluster on this machine: a scheduler, and workers that share neither folder nor cache with us."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from distributed import Client

from shapeviz_report.errors import RenderError


class Cluster:
    """A running scheduler; workers come and go.

    Attributes
    ----------
    address : str
        Of the scheduler.
    workers : list of subprocess.Popen
    """

    def __init__(self, folder: Path) -> None:
        self.workers: list[subprocess.Popen] = []
        self._folder = folder
        self._file = folder / "scheduler.json"
        # --port 0: any free one, so that test runs do not meet.
        command = [
            "--host",
            "127.0.0.1",
            "--port",
            "0",
            "--no-dashboard",
            "--scheduler-file",
            str(self._file),
        ]
        self.scheduler = self._start("scheduler", "scheduler", *command)
        end = time.monotonic() + 60
        while not self._file.exists() or not self._file.read_text():
            assert time.monotonic() < end, (folder / "scheduler.log").read_text()
            time.sleep(0.05)
        self.address = json.loads(self._file.read_text())["address"]

    def add_worker(self, modules: Path | None = None) -> None:
        """Start a worker of one thread, in an empty folder, with an empty cache; modules of a folder come first."""
        name = f"worker-{len(self.workers)}"
        options = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--name", name]
        self.workers.append(self._start(name, "worker", self.address, *options, modules=modules))

    def stop(self) -> None:
        """End everything."""
        for process in [*self.workers, self.scheduler]:
            process.kill()
            process.wait()

    def _start(self, name: str, *command: str, modules: Path | None = None) -> subprocess.Popen:
        home = self._folder / name
        home.mkdir()
        environment = os.environ | {
            "HOME": str(home),
            "XDG_CACHE_HOME": str(home / "cache"),
            # For `lack_something`; and our own package, whatever puts it on the path here.
            "PYTHONPATH": os.pathsep.join(
                [*([str(modules)] if modules else []), str(Path(__file__).parent), *sys.path]
            ),
        }
        with (self._folder / f"{name}.log").open("wb") as log:
            return subprocess.Popen(
                [sys.executable, "-m", "dask", *command],
                cwd=home,
                env=environment,
                stdout=log,
                stderr=log,
                stdin=subprocess.DEVNULL,
            )


def same_everywhere() -> dict[str, str]:
    """Versions that agree."""
    return {"all": "1"}


def other_everywhere() -> dict[str, str]:
    """Versions that differ from process to process."""
    return {"process": str(os.getpid()), "all": "1"}


def lack_something() -> None:
    """A check that a worker does not pass."""
    raise RenderError("OSMesa is missing here")


def lack_for_a_while(worker: str, times: int) -> None:
    """A check that a worker of some name does not pass so many times."""
    asked = Path.home() / "asked"
    with asked.open("a") as file:
        file.write(".")
    if Path.home().name == worker and asked.stat().st_size <= times:
        raise RenderError("OSMesa is missing here")


def name_worker(seconds: float) -> str:
    """Which worker this is, after some seconds."""
    time.sleep(seconds)
    return Path.home().name


@contextmanager
def running_cluster(folder: Path, workers: int) -> Iterator[Cluster]:
    """A cluster with so many workers, ended at the end."""
    cluster = Cluster(folder)
    try:
        for _ in range(workers):
            cluster.add_worker()
        if workers:
            with Client(cluster.address, set_as_default=False) as client:
                client.wait_for_workers(workers, timeout=120)
        yield cluster
    finally:
        cluster.stop()
