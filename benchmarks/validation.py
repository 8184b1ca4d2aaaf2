"""Every descriptor against another library, an exact method or an analytic surface.

``python -m benchmarks.validation MESHES...`` prints the tables of docs/notes/validation.md. Every file is prepared
as in a build. The exact methods take minutes of CPU time a mesh.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator

import numpy as np
import trimesh
from scipy.spatial import cKDTree

from benchmarks import pair_histograms, peers, references
from benchmarks.shapes import RoundedSurface, parser_of_meshes, prepared_shapes
from shapeviz_report.descriptors import DESCRIPTORS, Surface
from shapeviz_report.descriptors.normal_diameter import SAME_PLACE
from shapeviz_report.descriptors.shape_context import SHELLS
from shapeviz_report.mesh import normalise, remesh, surface_size
from shapeviz_report.types import FloatArray, IntArray, Mesh

EVERY = 4
"""The slow methods take every fourth vertex; what they compare it with is the whole mesh."""

MOVED = "moved share"
"""The measure of two definitions, not of an error."""

Row = tuple[str, str, float]
"""What is compared with what, which measure, and its value."""


def describe(name: str, surface: Surface) -> FloatArray:
    """The values of one descriptor; (n,) or (n, d)."""
    values = next(d for d in DESCRIPTORS if d.name == name).compute(surface)
    return np.squeeze(np.asarray(values, dtype=np.float64))


def choose(mesh: Mesh) -> IntArray:
    """The vertices that the slow methods take."""
    return np.arange(0, len(mesh.vertices), EVERY, dtype=np.int32)


def compare_curvature(mesh: Mesh) -> Iterator[Row]:
    """Gc against the law of cosines, and its sum against Gauss-Bonnet."""
    values = describe("Gc", Surface(mesh))
    yield (
        "Gc, angles by the law of cosines",
        "largest difference",
        largest(values, references.curvature(mesh)),
    )
    total = 2 * np.pi * references.euler_characteristic(mesh)
    yield "Gc, Gauss-Bonnet: sum = 2 pi chi", "difference of the sum", abs(values.sum() - total)


def compare_geodesics(mesh: Mesh) -> Iterator[Row]:
    """Agd against all pairs. Parts that no edge joins are bridged by the descriptor's own rule."""
    surface = Surface(mesh)
    chosen = choose(mesh)
    values = describe("Agd", surface)[chosen]
    exact = references.geodesic_distance(references.line_graph(mesh), chosen)
    if not np.isfinite(exact).all():
        exact = references.geodesic_distance(surface.graph, chosen)
    error = np.abs(values - exact) / exact.mean()
    yield "Agd, Dijkstra to all vertices", "mean difference / mean value", error.mean()
    yield "Agd, Dijkstra to all vertices", "largest difference / mean value", error.max()


def compare_diameters(mesh: Mesh) -> Iterator[Row]:
    """Nd against every ray tried on every face, and against trimesh."""
    surface = Surface(mesh)
    chosen = choose(mesh)
    values = describe("Nd", surface)[chosen]
    for name, cast in (
        ("Nd, every ray against every face", references.normal_diameter),
        ("Nd, trimesh", references.normal_diameter_trimesh),
    ):
        difference = np.abs(values - cast(mesh, surface.normals, chosen, SAME_PLACE))
        yield name, "share of vertices off by > 1e-9", float((difference > 1e-9).mean())
        yield name, "largest difference", difference.max()


def compare_neighbours(mesh: Mesh) -> Iterator[Row]:
    """The distances to the 30 nearest vertices, which Sc, PFH and FPFH build on, against scipy's tree."""
    surface = Surface(mesh)
    size = surface.neighbours.shape[1] + 1
    found = np.sort(surface.neighbour_distances, axis=1)
    distances = cKDTree(mesh.vertices).query(mesh.vertices, k=size)[0][:, 1:]
    yield (
        "30 nearest vertices, scipy's k-d tree",
        "largest difference of a distance",
        largest(found, distances),
    )


def compare_directions(mesh: Mesh) -> Iterator[Row]:
    """Na and Pa with the axis from a singular value decomposition."""
    surface = Surface(mesh)
    normal_angle = references.normal_angle(mesh, surface.normals)
    yield "Na, plain numpy", "largest difference", largest(describe("Na", surface), normal_angle)
    yield (
        "Pa, plain numpy",
        "largest difference",
        largest(describe("Pa", surface), references.point_angle(mesh)),
    )


def compare_contexts(mesh: Mesh) -> Iterator[Row]:
    """Sc against counting all vertices."""
    surface = Surface(mesh)
    chosen = choose(mesh)
    values = describe("Sc", surface)[chosen]
    exact = references.shape_context(mesh, surface.normals, surface.neighbours, chosen, SHELLS)
    yield "Sc, all vertices counted", "mean difference of a share", np.abs(values - exact).mean()
    yield "Sc, all vertices counted", "largest difference of a share", largest(values, exact)


def compare_pfh(mesh: Mesh) -> Iterator[Row]:
    """PFH against the paper's definition in plain numpy, and that with PCL's choices against PCL."""
    surface = RoundedSurface(mesh)
    points, normals = surface.vertices, surface.normals
    alone, with_self = surface.neighbours, peers.with_self(surface)
    ours = describe("PFH", surface)[::EVERY]
    paper = pair_histograms.pfh(points, normals, alone[::EVERY], "both")
    yield "PFH, paper's definition in plain numpy", "largest difference of a share", largest(ours, paper)
    library = peers.run_pcl("pfh", surface, with_self)[0][::EVERY]
    flatter_with_self = pair_histograms.pfh(points, normals, with_self[::EVERY], "flatter")
    name = "PFH, PCL's definition in plain numpy, against PCL"
    yield name, "largest difference of a share", largest(library, flatter_with_self)
    flatter = pair_histograms.pfh(points, normals, alone[::EVERY], "flatter")
    yield "PFH, from PCL to ours: without the point itself", MOVED, moved(flatter_with_self, flatter)
    yield "PFH, from PCL to ours: each pair both ways", MOVED, moved(flatter, paper)
    yield "PFH, from PCL to ours: in all", MOVED, moved(library, ours)


def compare_fpfh(mesh: Mesh) -> Iterator[Row]:
    """FPFH as PFH, and against Open3D."""
    surface = RoundedSurface(mesh)
    points, normals, neighbours = surface.vertices, surface.normals, surface.neighbours
    ours = describe("FPFH", surface).reshape(-1, 3, 11)

    def average(histograms: FloatArray, power: int, own: str) -> FloatArray:
        return pair_histograms.average(
            histograms, neighbours, surface.neighbour_distances, power=power, own=own
        )

    first = pair_histograms.spfh(points, normals, neighbours, "first")
    flatter = pair_histograms.spfh(points, normals, neighbours, "flatter")
    yield (
        "FPFH, paper's definition in plain numpy",
        "largest difference of a share",
        largest(ours, average(first, 1, "added")),
    )
    steps = [
        average(flatter, 2, "left out"),
        average(first, 2, "left out"),
        average(first, 1, "left out"),
        ours,
    ]
    pcl = peers.run_pcl("fpfh", surface, peers.with_self(surface))[0]
    name = "FPFH, PCL's definition in plain numpy, against PCL"
    yield name, "largest difference of a share", largest(pcl, steps[0])
    open3d = peers.run_open3d(surface)[0]
    name = "FPFH, Open3D's definition in plain numpy, against Open3D"
    yield name, "largest difference of a share", largest(open3d, average(flatter, 2, "half"))
    changes = ("pairs start at x", "weights 1 / d, not 1 / d²", "own SPFH added")
    for change, before, after in zip(changes, steps, steps[1:]):
        yield f"FPFH, from PCL to ours: {change}", MOVED, moved(before, after)
    yield "FPFH, from PCL to ours: in all", MOVED, moved(pcl, ours)
    yield "FPFH, from Open3D to ours: in all", MOVED, moved(open3d, ours)


def largest(values: FloatArray, expected: FloatArray) -> float:
    """The largest absolute difference."""
    return float(np.abs(values - expected).max())


def moved(before: FloatArray, after: FloatArray) -> float:
    """Share of a histogram that changes its cell, 0 to 1, on average over vertices (and groups)."""
    return float(np.abs(before - after).sum(axis=-1).mean() / 2)


COMPARISONS: tuple[Callable[[Mesh], Iterator[Row]], ...] = (
    compare_curvature,
    compare_geodesics,
    compare_diameters,
    compare_directions,
    compare_neighbours,
    compare_contexts,
    compare_pfh,
    compare_fpfh,
)


def _remeshed(original: trimesh.Trimesh, edge_length: float) -> Mesh:
    mesh = Mesh(original.vertices, original.faces.astype(np.int32))
    return remesh(mesh, edge_length * surface_size(mesh))


def compare_analytic(edge_length: float) -> Iterator[Row]:
    """Gc and Nd on a sphere and a torus, remeshed as any shape."""
    ball = trimesh.creation.icosphere(subdivisions=5)
    surface = Surface(normalise(_remeshed(ball, edge_length)))
    values = describe("Gc", surface)
    yield (
        "Gc, sphere: K × area of the vertex",
        "mean difference / mean value",
        relative(values, surface.areas),
    )
    yield (
        "Gc, sphere: K × area of 30 neighbours",
        "mean difference / mean value",
        relative(values[surface.neighbours].sum(axis=1), surface.areas[surface.neighbours].sum(axis=1)),
    )
    yield "Nd, sphere: 2", "largest difference / value", largest(describe("Nd", surface), np.float64(2)) / 2

    ring = trimesh.creation.torus(0.7, 0.3, major_sections=240, minor_sections=100)
    surface = Surface(_remeshed(ring, edge_length))
    values = describe("Gc", surface)
    x, y, z = surface.vertices.T
    around = np.arctan2(z, np.hypot(x, y) - 0.7)
    expected = np.cos(around) / (0.3 * (0.7 + 0.3 * np.cos(around))) * surface.areas
    yield "Gc, torus: K × area of the vertex", "mean difference / mean value", relative(values, expected)
    yield (
        "Gc, torus: K × area of 30 neighbours",
        "mean difference / mean value",
        relative(values[surface.neighbours].sum(axis=1), expected[surface.neighbours].sum(axis=1)),
    )
    outer = values[np.cos(around) > 0].sum()
    yield "Gc, torus: outer half = 4 pi", "difference of the sum / 4 pi", abs(outer / (4 * np.pi) - 1)
    yield (
        "Nd, torus: 0.6",
        "largest difference / value",
        largest(describe("Nd", surface), np.float64(0.6)) / 0.6,
    )


def relative(values: FloatArray, expected: FloatArray) -> float:
    """Mean absolute difference over the mean absolute value."""
    return float(np.abs(values - expected).mean() / np.abs(expected).mean())


def show(value: float) -> str:
    """As per cent; rounding errors as powers of ten."""
    if value == 0:
        return "0"
    return f"{100 * value:.2f} %" if value >= 1e-4 else f"{value:.0e}"


def print_table(results: dict[tuple[str, str], list[float]], wanted: Callable[[str], bool]) -> None:
    """The median and the worst mesh of every comparison with a wanted measure."""
    print("\n| descriptor, against | measure | median mesh | worst mesh |\n|---|---|---|---|")
    for (subject, measure), values in results.items():
        if wanted(measure):
            print(f"| {subject} | {measure} | {show(np.median(values))} | {show(max(values))} |")


def main() -> None:
    """Print the tables."""
    options = parser_of_meshes(__doc__.splitlines()[0]).parse_args()
    peers.require_peers()
    results: dict[tuple[str, str], list[float]] = {}
    for name, mesh in prepared_shapes(options.meshes, options.edge_length):
        print(f"{name}: {len(mesh.vertices)} vertices", file=sys.stderr, flush=True)
        for compare in COMPARISONS:
            for subject, measure, value in compare(mesh):
                results.setdefault((subject, measure), []).append(value)
                print(f"  {subject}; {measure}: {value:.2e}", file=sys.stderr, flush=True)
    print_table(results, lambda measure: measure != MOVED)
    print_table(results, lambda measure: measure == MOVED)
    print("\n| descriptor, against | measure | |\n|---|---|---|")
    for subject, measure, value in compare_analytic(options.edge_length):
        print(f"| {subject} | {measure} | {show(value)} |")


if __name__ == "__main__":
    main()
