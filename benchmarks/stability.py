"""How far features move when a mesh is turned, scaled, renumbered or sampled twice as densely.

Run as ``python -m benchmarks.stability MESHES...``. Two histograms are compared by the share of the surface that is
in another bin: half the sum of the absolute differences. Beside it stands the noise of a histogram: the share
expected between two histograms of as many vertices drawn independently. The first table gives the ratio. Values of
whole shapes are compared by their distance; the second table has it as a fraction of the mean distance of two meshes.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
from scipy.spatial.distance import pdist

from benchmarks.shapes import parser_of_meshes
from shapeviz_report import demo
from shapeviz_report.descriptors import DESCRIPTORS, Surface
from shapeviz_report.features import BINS, compute_histograms, fixed_edges
from shapeviz_report.global_descriptors import GLOBAL_DESCRIPTORS, PosedShape
from shapeviz_report.mesh import collect_files, normalise, prepare, read_mesh
from shapeviz_report.types import FloatArray, Mesh

DENSER = 2**-0.5
"""Edges of this times the length make twice as many vertices."""


def rotate(mesh: Mesh) -> Mesh:
    """The mesh turned at random, the same way each time, and moved."""
    q, r = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return Mesh(mesh.vertices @ (q * np.linalg.det(q)).T + [3.0, -1.0, 2.0], mesh.faces)


def scale(mesh: Mesh) -> Mesh:
    """The mesh 37 times as large."""
    return Mesh(37.0 * mesh.vertices, mesh.faces)


def renumber(mesh: Mesh) -> Mesh:
    """The mesh with its vertices and faces in another order, and faces that begin at another corner."""
    random = np.random.default_rng(2)
    order = random.permutation(len(mesh.vertices))
    faces = np.argsort(order)[mesh.faces[random.permutation(len(mesh.faces))]]
    corners = (np.arange(3) + random.integers(3, size=(len(faces), 1))) % 3
    return Mesh(mesh.vertices[order], np.take_along_axis(faces, corners, axis=1).astype(np.int32))


def refine(mesh: Mesh) -> Mesh:
    """The same surface with about twice the vertices: one more in the middle of every second face."""
    split, kept = mesh.faces[::2], mesh.faces[1::2]
    middle = len(mesh.vertices) + np.arange(len(split))
    fans = [np.column_stack([split[:, i], split[:, (i + 1) % 3], middle]) for i in range(3)]
    vertices = np.concatenate([mesh.vertices, mesh.vertices[split].mean(axis=1)])
    return Mesh(vertices, np.concatenate([kept, *fans]).astype(np.int32))


def describe(mesh: Mesh) -> FloatArray:
    """(187, 10) the features of a prepared mesh."""
    return compute_histograms(mesh, fixed_edges(), by_area=True).reshape(-1, BINS)


def by_descriptor(values: FloatArray) -> FloatArray:
    """(8,) means over the dimensions of each descriptor."""
    starts = np.cumsum([0] + [d.dimensions for d in DESCRIPTORS[:-1]])
    return np.add.reduceat(values, starts) / [d.dimensions for d in DESCRIPTORS]


def difference(before: FloatArray, after: FloatArray) -> FloatArray:
    """(8,) share of the surface in another bin."""
    return by_descriptor(np.abs(before - after).sum(axis=1) / 2)


def noise(mesh: Mesh, histograms: FloatArray) -> FloatArray:
    r"""(8,) the difference expected between two independent draws of the mesh's vertices.

    The share p of a bin has the variance p (1 - p) sum w^2 with weights w that add up to 1, the difference of two
    draws twice that, and a normal variable the mean magnitude sqrt(2 / pi) of its deviation.
    """
    weights = Surface(mesh).areas / Surface(mesh).areas.sum()
    variance = 2 * histograms * (1 - histograms) * (weights**2).sum()
    return by_descriptor(np.sqrt(2 / np.pi * np.maximum(variance, 0)).sum(axis=1) / 2)


def write(mesh: Mesh, path: Path) -> Path:
    """Write a mesh as OFF, with the digits of float32."""
    with path.open("w", encoding="utf-8") as file:
        file.write(f"OFF\n{len(mesh.vertices)} {len(mesh.faces)} 0\n")
        np.savetxt(file, mesh.vertices.astype(np.float32), fmt="%.9g")
        np.savetxt(file, np.column_stack([np.full(len(mesh.faces), 3), mesh.faces]), fmt="%d")
    return path


def move_all(path: Path, edge_length: float, folder: Path) -> Iterator[tuple[str, Mesh]]:
    """A mesh file moved in every way, by the name of the way; first as it is."""
    original = read_mesh(path)
    mesh = prepare(collect_files(path), edge_length)[0]
    yield "as it is", mesh
    ways: dict[str, Callable[[Mesh], Mesh]] = {"rotated": rotate, "scaled": scale, "renumbered": renumber}
    for name, move in ways.items():
        yield f"prepared mesh, {name}", normalise(move(mesh))
    yield "prepared mesh, denser", prepare(collect_files(path), edge_length * DENSER)[0]
    for name, move in (ways | {"denser": refine}).items():
        moved = write(move(original), folder / f"{name}.off")
        yield f"file, {name}", prepare(collect_files(moved), edge_length)[0]


def describe_whole(mesh: Mesh) -> list[FloatArray]:
    """The values of each global descriptor."""
    shape = PosedShape(mesh)
    return [descriptor.compute(shape) for descriptor in GLOBAL_DESCRIPTORS]


def measure(
    path: Path, edge_length: float, folder: Path
) -> tuple[dict[str, FloatArray], dict[str, list[FloatArray]]]:
    """Name of the way -> (8,) differences, and ``noise``; and name of the way -> values of whole shapes."""
    rows: dict[str, FloatArray] = {}
    whole: dict[str, list[FloatArray]] = {}
    before = np.empty(0)
    for name, mesh in move_all(path, edge_length, folder):
        own = describe(mesh)
        whole[name] = describe_whole(mesh)
        if not rows:
            before, rows["noise"] = own, noise(mesh, own)
        else:
            rows[name] = difference(before, own)
    return rows, whole


def print_whole(shapes: Sequence[dict[str, list[FloatArray]]]) -> None:
    """The second table."""
    print("\n| |", " | ".join(d.name for d in GLOBAL_DESCRIPTORS), "|")
    print("|---|" + "---|" * len(GLOBAL_DESCRIPTORS))
    apart = []
    for number in range(len(GLOBAL_DESCRIPTORS)):
        values = np.array([shape["as it is"][number] for shape in shapes])
        apart.append(pdist(values).mean())
    for name in list(shapes[0])[1:]:
        cells = []
        for number, mean in enumerate(apart):
            moves = [
                np.linalg.norm(shape[name][number] - shape["as it is"][number]) / mean for shape in shapes
            ]
            cells.append(f"{np.median(moves):.3f} ({max(moves):.3f})")
        print(f"| {name} |", " | ".join(cells), "|", flush=True)


def main() -> None:
    """Print two tables: median and largest movement over the meshes, for every descriptor and way."""
    arguments = parser_of_meshes(__doc__).parse_args()
    with tempfile.TemporaryDirectory() as folder:
        paths = arguments.meshes or [demo.write_shape(Path(folder), c.name, 0) for c in demo.CLASSES]
        measured = [measure(path, arguments.edge_length, Path(folder)) for path in paths]
    shapes = [rows for rows, _ in measured]
    print("| |", " | ".join(d.name for d in DESCRIPTORS), "|")
    print("|---|" + "---|" * len(DESCRIPTORS))
    levels = np.median([shape["noise"] for shape in shapes], axis=0)
    print("| noise, share of the surface |", " | ".join(f"{level:.1%}" for level in levels), "|")
    for name in list(shapes[0])[1:]:
        ratios = np.array([shape[name] / np.maximum(shape["noise"], 1e-12) for shape in shapes])
        cells = [f"{np.median(column):.2f} ({column.max():.2f})" for column in ratios.T]
        print(f"| {name} |", " | ".join(cells), "|", flush=True)
    print_whole([whole for _, whole in measured])


if __name__ == "__main__":
    main()
