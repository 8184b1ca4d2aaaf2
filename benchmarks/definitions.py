"""What PFH and FPFH by other definitions are worth: the neighbourhood hit of each alone.

``python -m benchmarks.definitions CLASS/MESH...``: the folder of a file is its class. Features, scaling, t-SNE and
neighbourhood hit are those of a build.
"""

from __future__ import annotations

import sys

import numpy as np

from benchmarks import peers
from benchmarks.shapes import parser_of_meshes, prepared_shapes
from shapeviz_report.descriptors import DESCRIPTORS, Surface
from shapeviz_report.features import BINS
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.projections import PROJECTIONS, project
from shapeviz_report.quality import score
from shapeviz_report.types import FeatureBlock, FeatureTable, FloatArray, Mesh

SEEDS = range(5)

DESCRIPTOR = {descriptor.name: descriptor for descriptor in DESCRIPTORS}


def describe(mesh: Mesh) -> dict[tuple[str, str], FloatArray]:
    """PFH (n, 125) and FPFH (n, 33) by each library."""
    surface = Surface(mesh)
    return {
        ("PFH", "ours"): DESCRIPTOR["PFH"].compute(surface),
        ("PFH", "PCL"): peers.run_pcl("pfh", surface, peers.with_self(surface))[0],
        ("FPFH", "ours"): DESCRIPTOR["FPFH"].compute(surface),
        ("FPFH", "PCL"): peers.run_pcl("fpfh", surface, peers.with_self(surface))[0].reshape(-1, 33),
        ("FPFH", "Open3D"): peers.run_open3d(surface)[0].reshape(-1, 33),
    }


def gather(values: FloatArray, name: str, areas: FloatArray) -> FloatArray:
    """The ten-bin histograms of every dimension, vertices counted by area, with the descriptor's own edges."""
    inner = np.array(DESCRIPTOR[name].edges)[1:-1]
    cells = np.searchsorted(inner, values, side="right") + BINS * np.arange(values.shape[1])
    totals = np.bincount(cells.ravel(), np.repeat(areas, values.shape[1]), BINS * values.shape[1])
    return totals / areas.sum()


def main() -> None:
    """Print the table."""
    options = parser_of_meshes("What PFH and FPFH by other definitions are worth.").parse_args()
    peers.require_peers()
    names: list[str] = []
    rows: dict[tuple[str, str], list[FloatArray]] = {}
    for shape, mesh in prepared_shapes(options.meshes, options.edge_length):
        names.append(shape)
        areas = Surface(mesh).areas
        for key, values in describe(mesh).items():
            rows.setdefault(key, []).append(gather(values, key[0], areas))
        print(shape, file=sys.stderr, flush=True)
    labels = [name.split("/")[0] for name in names]
    tsne = next(method for method in PROJECTIONS if method.name == "tsne")
    print("| descriptor | by | NH_s of it alone |\n|---|---|---|")
    for (name, library), histograms in rows.items():
        block = FeatureBlock(name, DESCRIPTOR[name].dimensions, BINS)
        scaled = scale(FeatureTable(tuple(names), (block,), np.stack(histograms)), PRESETS["default"])
        hits = [score(project(tsne, scaled, (name,), seed).xy, labels).nh_s for seed in SEEDS]
        print(f"| {name} | {library} | {min(hits):.3f} - {max(hits):.3f} |", flush=True)


if __name__ == "__main__":
    main()
