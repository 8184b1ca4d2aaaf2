"""Compare ways to remesh: CPU seconds, evenness, and how far the surface moves.

    python -m benchmarks.remeshing MESH ...

Prints, for the steps of preparing and for every set of Mmg's options, medians over the meshes.
"""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from mmgpy import MmgMeshS

from benchmarks.shapes import parser_of_meshes
from shapeviz_report.mesh import clean, deviation, read_mesh, surface_size
from shapeviz_report.types import FloatArray, Mesh

OPTIONS: Mapping[str, Mapping[str, float]] = {
    "all": {},
    "tenth of the tolerance": {"hausd": 0.1},
    "no ridges": {"ar": 180},
    "no swaps": {"noswap": 1},
    "no moves": {"nomove": 1},
    "no swaps, no moves": {"noswap": 1, "nomove": 1},
}
"""What differs from remeshing with everything Mmg does; ``hausd`` in edge lengths."""


def remesh_with(mesh: Mesh, edge_length: float, options: Mapping[str, float]) -> Mesh:
    """Remesh a cleaned mesh, whose diagonal is 1, with some of Mmg's options."""
    surface = MmgMeshS()
    surface.set_mesh_size(vertices=len(mesh.vertices), triangles=len(mesh.faces))
    surface.set_vertices(mesh.vertices)
    surface.set_triangles(mesh.faces)
    other = {name: value for name, value in options.items() if name != "hausd"}
    surface.remesh(hsiz=edge_length, hausd=edge_length * options.get("hausd", 0.5), verbose=-1, **other)
    return Mesh(surface.get_vertices(), np.ascontiguousarray(surface.get_triangles(), np.int32))


def edge_lengths(mesh: Mesh) -> FloatArray:
    """The length of every distinct edge."""
    pairs = np.sort(
        np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]]), axis=1
    )
    keys = np.unique(pairs[:, 0].astype(np.int64) * len(mesh.vertices) + pairs[:, 1])
    starts, ends = np.divmod(keys, len(mesh.vertices))
    return np.linalg.norm(mesh.vertices[starts] - mesh.vertices[ends], axis=1)


def qualities(mesh: Mesh) -> FloatArray:
    """4 sqrt(3) area / (sum of the squared edges) of every face: 1 for an equilateral one, 0 for an empty one."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    double_area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    squares = sum(np.einsum("ij,ij->i", x, x) for x in (b - a, c - b, a - c))
    return 2 * np.sqrt(3) * double_area / np.maximum(squares, 1e-300)


def timed(function: Callable[..., Any], *arguments: Any) -> tuple[Any, float]:
    """The result, and the CPU seconds it took."""
    start = time.process_time()
    result = function(*arguments)
    return result, time.process_time() - start


def main() -> None:
    """Measure and print."""
    parser = parser_of_meshes(__doc__.partition("\n")[0])
    arguments = parser.parse_args()
    steps: dict[str, list[float]] = defaultdict(list)
    rows: dict[str, list[tuple[float, ...]]] = defaultdict(list)
    for path in arguments.meshes:
        original, seconds = timed(read_mesh, path)
        steps["read"].append(seconds)
        (mesh, _), seconds = timed(clean, original)
        steps["clean"].append(seconds)
        for name, options in OPTIONS.items():
            result, seconds = timed(remesh_with, mesh, arguments.edge_length * surface_size(mesh), options)
            strays, checking = timed(deviation, mesh, result)
            steps["check"].append(checking)
            lengths = edge_lengths(result)
            spread = float(lengths.std() / lengths.mean())
            worst = float(np.percentile(qualities(result), 1))
            rows[name].append((seconds, float(lengths.mean()), spread, worst, strays, len(result.vertices)))
    print("CPU s:", ", ".join(f"{name} {np.median(seconds):.3f}" for name, seconds in steps.items()))
    print(f"{'options':24}{'CPU s':>8}{'edge':>9}{'spread':>8}{'quality':>9}{'strays':>9}{'vertices':>10}")
    for name, values in rows.items():
        seconds, edge, spread, worst, strays, count = np.median(values, axis=0)
        print(f"{name:24}{seconds:8.3f}{edge:9.5f}{spread:8.3f}{worst:9.2f}{strays:9.4f}{count:10.0f}")


if __name__ == "__main__":
    main()
