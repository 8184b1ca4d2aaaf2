"""How every stage of a build grows with the number of shapes, on a Dask cluster of this machine.

    python -m benchmarks.growth FOLDER --sizes 500 1000 2500 5000 --workers 2

Shapes of the demo's generators are built from end to end, larger databases holding the smaller ones; one cache serves
all, so a shape is measured once, and its time a shape is that of the shapes that are new. Prints a row a stage: wall
and CPU seconds at each size, and the power of the number of shapes with which the CPU seconds grew between the last
two sizes; and the memory of the coordinating process over time.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from math import log
from pathlib import Path

from shapeviz_report.demo import CLASSES, shape_path, write_shape

EACH_SHAPE = ("prepare", "examine", "render", "describe")
"""Stages whose time is that of new shapes."""


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sizes", type=int, nargs="+", default=[500, 1000, 2500, 5000])
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--edge-length", default="0.03")
    options = parser.parse_args()
    found = []
    sizes = sorted(options.sizes)
    shapes = _generate(options.folder / "shapes", sizes[-1])
    with _cluster(options.folder, options.workers) as address:
        for size in sizes:
            database = options.folder / f"database-{size}"
            for path in shapes[:size]:
                link = database / path.parent.name / path.name
                link.parent.mkdir(parents=True, exist_ok=True)
                if not link.exists():
                    os.link(path, link)
            found.append(_build(database, options.folder, address, options.edge_length))
            (options.folder / "growth.json").write_text(json.dumps(dict(zip(sizes, found)), indent=1))
    _print(sizes, found)


def _generate(folder: Path, count: int) -> list[Path]:
    """The first shapes of the demo's generators, the classes in turn."""
    wanted = [(CLASSES[number % len(CLASSES)].name, number // len(CLASSES)) for number in range(count)]
    missing = [(name, index) for name, index in wanted if not shape_path(folder, name, index).exists()]
    with ProcessPoolExecutor() as pool:
        list(pool.map(write_shape, [folder] * len(missing), *zip(*missing), chunksize=8) if missing else ())
    return [shape_path(folder, name, index) for name, index in wanted]


@contextmanager
def _cluster(folder: Path, workers: int):
    """The address of a scheduler with so many workers, each of one thread."""
    file = folder / "scheduler.json"
    file.unlink(missing_ok=True)
    log_file = (folder / "cluster.log").open("w")
    dask = [sys.executable, "-m", "distributed.cli.dask_scheduler"]
    started = [_start([*dask, "--port", "0", "--no-dashboard", "--scheduler-file", str(file)], log_file)]
    while not file.exists():
        time.sleep(0.2)
    address = json.loads(file.read_text())["address"]
    worker = [
        sys.executable,
        "-m",
        "distributed.cli.dask_worker",
        address,
        "--no-dashboard",
        "--nthreads",
        "1",
    ]
    started += [_start(worker, log_file) for _ in range(workers)]
    try:
        yield address
    finally:
        for process in started:
            process.terminate()


def _start(command: list[str], log_file) -> subprocess.Popen:
    return subprocess.Popen(command, stdout=log_file, stderr=log_file)


def _build(database: Path, folder: Path, address: str, edge_length: str) -> dict:
    """Build a site; what every stage took, and the memory of the process over time in MB."""
    site = folder / f"site-{database.name}"
    process = subprocess.Popen(
        [
            *(sys.executable, "-m", "shapeviz_report", "build", str(database), "-o", str(site)),
            *("--scheduler", address, "--cache", str(folder / "cache"), "--edge-length", edge_length),
        ],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    begun = time.monotonic()
    memory: list[tuple[float, int, str]] = []
    doing = [""]

    def read() -> None:
        for line in process.stderr:
            print(" ", line, end="", file=sys.stderr)
            doing[0] = line.partition(":")[0].strip()

    threading.Thread(target=read, daemon=True).start()
    while process.poll() is None:
        status = Path(f"/proc/{process.pid}/status")
        resident = re.search(r"VmRSS:\s+(\d+)", status.read_text(encoding="utf-8") if status.exists() else "")
        if resident:
            memory.append((round(time.monotonic() - begun, 1), int(resident[1]) // 1024, doing[0]))
        time.sleep(1)
    if process.returncode:
        sys.exit(f"the build of {database} failed")
    summary = json.loads((site / "data" / "summary.json").read_text())
    new = re.compile(r"\d+$").search(database.name)
    weight = sum(file.stat().st_size for file in site.rglob("*") if file.is_file())
    return {
        "shapes": int(new[0]) if new else 0,
        "seconds": summary["seconds"],
        "cpu_seconds": summary["cpu_seconds"],
        "failures": len(summary["failures"]),
        "megabytes": weight / 1e6,
        "files": sum(file.is_file() for file in site.rglob("*")),
        "memory": memory,
    }


def _print(sizes: list[int], found: list[dict]) -> None:
    print("| stage | " + " | ".join(f"{size:,}: wall, CPU s" for size in sizes) + " | power |")
    print("|---" * (len(sizes) + 2) + "|")
    for name in found[-1]["cpu_seconds"]:
        cells = [f"{one['seconds'].get(name, 0):.1f}, {one['cpu_seconds'].get(name, 0):.1f}" for one in found]
        power = ""
        if len(sizes) > 1 and name not in EACH_SHAPE:
            before, after = (max(one["cpu_seconds"].get(name, 0), 1e-3) for one in found[-2:])
            power = f"{log(after / before) / log(sizes[-1] / sizes[-2]):.2f}"
        print(f"| {name} | " + " | ".join(cells) + f" | {power} |")
    for size, one in zip(sizes, found):
        peak = max(one["memory"], key=lambda entry: entry[1])
        print(
            f"{size:,} shapes: {one['failures']} failures, site {one['megabytes']:.0f} MB in {one['files']:,} files, "
            f"memory of the coordinating process at most {peak[1]} MB, while it said {peak[2]!r}"
        )


if __name__ == "__main__":
    main()
