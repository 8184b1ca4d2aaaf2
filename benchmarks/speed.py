"""CPU seconds a mesh, side by side: PCL and Open3D for PFH and FPFH, scipy for Agd, and ours.

``python -m benchmarks.speed MESHES...`` prints the table of docs/notes/validation.md. All run in one thread, in turn on
the same prepared mesh; everyone gets points, normals and edges, and builds their own trees and graphs.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Literal

import numpy as np

from benchmarks import peers, references
from benchmarks.shapes import parser_of_meshes, prepared_shapes
from shapeviz_report.descriptors import DESCRIPTORS, Surface
from shapeviz_report.types import Mesh

REPEATS = 3
"""The least of so many runs counts: what other processes add is not the library's."""

SOURCES = 300
"""Dijkstra runs from this many vertices, and its time is scaled up to all."""


def surface_of(mesh: Mesh, *, neighbours: bool = False) -> Surface:
    """A fresh surface of which nothing is known but the normals and, if asked for, the neighbours."""
    surface = Surface(mesh)
    known = (surface.normals, surface.neighbours) if neighbours else (surface.normals,)
    assert all(len(values) == len(mesh.vertices) for values in known)
    return surface


def time_ours(name: str, surface: Surface) -> float:
    """One of our descriptors."""
    descriptor = next(d for d in DESCRIPTORS if d.name == name)
    return seconds_of(lambda: descriptor.compute(surface))


def time_pcl(kind: Literal["pfh", "fpfh"], mesh: Mesh, *, neighbours: bool = False) -> float:
    """The Point Cloud Library, with neighbours given or its own search."""
    surface = Surface(mesh)
    return peers.run_pcl(kind, surface, peers.with_self(surface) if neighbours else None)[1]


def time_scipy(mesh: Mesh) -> float:
    """Dijkstra from every vertex by scipy."""
    count = len(mesh.vertices)
    sources = np.linspace(0, count - 1, min(SOURCES, count)).astype(int)
    graph = references.line_graph(mesh)
    return seconds_of(lambda: references.geodesic_distance(graph, sources)) * count / len(sources)


def seconds_of(run: Callable[[], object]) -> float:
    """CPU seconds of this process, all threads together."""
    start = time.process_time()
    run()
    return time.process_time() - start


RUNS: dict[tuple[str, str], Callable[[Mesh], float]] = {
    ("PFH", "ours"): lambda mesh: time_ours("PFH", surface_of(mesh)),
    ("PFH", "PCL"): lambda mesh: time_pcl("pfh", mesh),
    ("PFH, neighbours known", "ours"): lambda mesh: time_ours("PFH", surface_of(mesh, neighbours=True)),
    ("PFH, neighbours known", "PCL"): lambda mesh: time_pcl("pfh", mesh, neighbours=True),
    ("FPFH", "ours"): lambda mesh: time_ours("FPFH", surface_of(mesh)),
    ("FPFH", "PCL"): lambda mesh: time_pcl("fpfh", mesh),
    ("FPFH", "Open3D"): lambda mesh: peers.run_open3d(Surface(mesh))[1],
    ("FPFH, neighbours known", "ours"): lambda mesh: time_ours("FPFH", surface_of(mesh, neighbours=True)),
    ("FPFH, neighbours known", "PCL"): lambda mesh: time_pcl("fpfh", mesh, neighbours=True),
    ("Agd", "ours"): lambda mesh: time_ours("Agd", surface_of(mesh)),
    ("Agd", "scipy, all pairs"): time_scipy,
}


def main() -> None:
    """Print the table."""
    options = parser_of_meshes("CPU seconds a mesh, side by side.").parse_args()
    peers.require_peers()
    seconds: dict[tuple[str, str], list[float]] = {run: [] for run in RUNS}
    sizes = []
    for name, mesh in prepared_shapes(options.meshes, options.edge_length):
        if not sizes:  # Compile and load everything before the first measurement.
            for time_run in RUNS.values():
                time_run(mesh)
        sizes.append(len(mesh.vertices))
        for run, time_run in RUNS.items():
            seconds[run].append(min(time_run(mesh) for _ in range(REPEATS)))
        print(name, sizes[-1], *(f"{s[-1]:.3f}" for s in seconds.values()), file=sys.stderr, flush=True)
    print(f"{len(sizes)} meshes of {min(sizes)} to {max(sizes)} vertices, median {np.median(sizes):.0f}\n")
    print("| descriptor | by | CPU seconds a mesh, median | of ours, median |\n|---|---|---|---|")
    for (descriptor, library), values in seconds.items():
        ratio = np.median(np.divide(values, seconds[descriptor, "ours"]))
        print(f"| {descriptor} | {library} | {np.median(values):.3f} | {ratio:.1f} × |")


if __name__ == "__main__":
    main()
