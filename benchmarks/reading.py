"""Time the readers of meshes beside trimesh's, on one surface in every format.

    python -m benchmarks.reading --triangles 1000000
    python -m benchmarks.reading MESHES...

Both get the same bytes, and give triangles: trimesh without merging vertices, without materials where it can leave
them, and as one mesh. A line has the median CPU seconds of both, and their ratio. Files given by name are read instead
of a surface of our own; then the last line has the median and the largest of their ratios.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from functools import partial
from io import BytesIO
from pathlib import Path

import numpy as np
import trimesh

from shapeviz_report.mesh import collect_files
from shapeviz_report.mesh.read import parse_mesh


def ball(triangles: int) -> trimesh.Trimesh:
    """A bumpy ball of about as many triangles, its seams and poles open."""
    columns = max(4, round((triangles / 2) ** 0.5))
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, columns), np.linspace(0, np.pi, columns))
    radius = 1 + 0.1 * np.sin(7 * u) * np.sin(5 * v)
    points = np.stack(
        [radius * np.cos(u) * np.sin(v), radius * np.sin(u) * np.sin(v), radius * np.cos(v)], axis=-1
    )
    corner = (np.arange(columns - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    a, b, c, d = corner, corner + columns, corner + columns + 1, corner + 1
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return trimesh.Trimesh(points.reshape(-1, 3), faces, process=False)


def written(shape: trimesh.Trimesh) -> Iterator[tuple[str, str, bytes]]:
    """The surface in every format: what it is, its file's name, its content."""
    for title, suffix, options in (
        ("STL, binary", "stl", {}),
        ("PLY, binary", "ply", {"vertex_normal": False}),
        ("PLY, text", "ply", {"encoding": "ascii", "vertex_normal": False}),
        ("OFF", "off", {}),
        ("OBJ", "obj", {"include_normals": False}),
        ("OBJ with normals", "obj", {"include_normals": True}),
        ("glTF, binary", "glb", {}),
        ("3MF", "3mf", {}),
        ("COLLADA", "dae", {}),
        ("STL, text", "stl", {"file_type": "stl_ascii"}),
    ):
        content = shape.export(**({"file_type": suffix} | options))
        yield title, f"ball.{suffix}", content.encode() if isinstance(content, str) else content


def named(paths: list[Path]) -> Iterator[tuple[str, str, bytes]]:
    """Files by path; those of glTF have their buffers in them."""
    for path in paths:
        yield path.name, path.name, collect_files(path)[path.name]


def seconds(run: Callable[[], object], times: int) -> float:
    """Median CPU time."""
    taken = []
    for _ in range(times):
        start = time.process_time()
        run()
        taken.append(time.process_time() - start)
    return float(np.median(taken))


def read_by_trimesh(name: str, content: bytes) -> trimesh.Trimesh:
    suffix = name.rpartition(".")[2].lower()
    options = {"skip_materials": True} if suffix == "obj" else {}
    return trimesh.load_mesh(BytesIO(content), file_type=suffix, process=False, **options)


def main() -> None:
    """Print one line a file."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--triangles", type=int, default=1_000_000)
    parser.add_argument("--times", type=int, default=3, help="that each file is read by each")
    arguments = parser.parse_args()
    ratios = []
    print("| | triangles | shapeviz-report | trimesh | ratio |\n|---|---|---|---|---|")
    cases = named(arguments.meshes) if arguments.meshes else written(ball(arguments.triangles))
    for title, name, content in cases:
        count = len(parse_mesh({name: content}).faces)
        ours = seconds(partial(parse_mesh, {name: content}), arguments.times)
        theirs = seconds(partial(read_by_trimesh, name, content), arguments.times)
        ratios.append(ours / theirs)
        print(f"| {title} | {count:,} | {ours:.3f} s | {theirs:.3f} s | {ratios[-1]:.2f} |", flush=True)
    print(f"\nmedian ratio {np.median(ratios):.2f}, largest {max(ratios):.2f}")


if __name__ == "__main__":
    main()
