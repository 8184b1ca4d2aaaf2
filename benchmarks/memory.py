"""Peak memory of describing one mesh, by its number of vertices.

Run as ``python -m benchmarks.memory 9000 100000 500000``. Each mesh, a torus with bumps, is described in a process of
its own, as by the worker of a build; the peak is that of the process, Python and libraries included.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time

import numpy as np

from shapeviz_report.features import compute_histograms, fixed_edges
from shapeviz_report.mesh import normalise
from shapeviz_report.types import Mesh


def bumpy_torus(count: int) -> Mesh:
    """A closed mesh of about ``count`` vertices."""
    around = round(np.sqrt(count / 2))
    along = 2 * around
    u, v = np.meshgrid(
        np.arange(along) * 2 * np.pi / along, np.arange(around) * 2 * np.pi / around, indexing="ij"
    )
    radius = 0.35 + 0.03 * np.sin(9 * u) * np.sin(5 * v)
    x, y = (1 + radius * np.cos(v)) * np.cos(u), (1 + radius * np.cos(v)) * np.sin(u)
    vertices = np.stack([x, y, radius * np.sin(v)], axis=-1).reshape(-1, 3)
    index = np.arange(along * around).reshape(along, around)
    a, b = index, np.roll(index, -1, axis=0)
    c, d = np.roll(b, -1, axis=1), np.roll(a, -1, axis=1)
    faces = np.concatenate([np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])
    return Mesh(vertices, faces.astype(np.int32))


def main() -> None:
    """Print a row for each number of vertices; given one and ``--here``, describe in this process."""
    if sys.argv[-1] == "--here":
        mesh = normalise(bumpy_torus(int(sys.argv[1])))
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        started = time.process_time()
        compute_histograms(mesh, fixed_edges(), by_area=True)
        seconds = time.process_time() - started
        after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        print(
            f"| {len(mesh.vertices):,} | {before / 1024:.0f} MiB | {after / 1024:.0f} MiB | {seconds:.1f} |"
        )
        return
    print("| vertices | before | peak | CPU seconds |\n|---|---|---|---|", flush=True)
    for count in sys.argv[1:]:
        subprocess.run([sys.executable, "-m", "benchmarks.memory", count, "--here"], check=True)


if __name__ == "__main__":
    main()
