"""The search for bins on a database of one's own: what docs/method/bins-search.md states.

    python -m benchmarks.bins automatic SITE/data/features.npz       the selection, its path, ten seeds of its map
    python -m benchmarks.bins minimal SITE/data/features.npz         the fewest bins of every class, beside chance
    python -m benchmarks.bins honest SITE/data/features.npz          held-out shapes, and labels without meaning

Prints Markdown. CPU seconds are of one thread, compiling left out.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from benchmarks.sites import load_features
from shapeviz_report.bins import features_of, scale_bins
from shapeviz_report.presets import PRESETS
from shapeviz_report.projections import PROJECTIONS, project, squared_distances
from shapeviz_report.quality import score
from shapeviz_report.search.bins import (
    BinSpace,
    encode,
    find_minimal_bins,
    hold_out,
    make_bin_space,
    select_bins,
    shuffle_labels,
)
from shapeviz_report.search.certainty import deal_folds
from shapeviz_report.types import FeatureTable, FloatArray, HeldOutBins

SEEDS = range(10)
CHANCE_CLASSES = 5
"""Random groups whose fewest bins stand beside those of the classes."""


def print_automatic(table: FeatureTable, preset: str, labels: list[str], space: BinSpace) -> None:
    """The selection and its map as a site draws it."""
    selection = select_bins(space, labels)
    print(f"{len(selection.bins)} of {len(space.names)} bins, {selection.cpu_seconds:.1f} CPU seconds.\n")
    print("| bins | joined | left | NH_s in their space | of the map |\n|---|---|---|---|---|")
    for step in selection.path:
        print(
            f"| {len(step.bins)} | {', '.join(step.added)} | {', '.join(step.removed)} "
            f"| {step.nh_space:.3f} | {step.nh_s:.3f} |"
        )
    values = scale_bins(table, PRESETS[preset], selection.bins)
    features = features_of(table, selection.bins)
    for method in PROJECTIONS[:2]:
        hits = [score(project(method, values, features, seed).xy, labels).nh_s for seed in SEEDS]
        print(
            f"\n{method.title} of these bins, ten seeds: NH_s {np.mean(hits):.3f} +- {np.std(hits, ddof=1):.3f}"
        )
    final = score(project(PROJECTIONS[0], values, features, 0).xy, labels)
    print("\n" + ", ".join(f"{label} {value:.3f}" for label, value in final.nh_c.items()))


def print_minimal(labels: list[str], space: BinSpace) -> None:
    """All classes, and random groups of their middle size."""
    start = time.process_time()
    print("| class | bins | NH_c in their space | of the map |\n|---|---|---|---|")
    sizes = []
    for label in sorted(set(labels)):
        sizes.append(labels.count(label))
        print_class(label, labels, space)
    print(f"\n{time.process_time() - start:.1f} CPU seconds.\n\nRandom groups:\n")
    print("| group | bins | NH_c in their space | of the map |\n|---|---|---|---|")
    for seed in range(CHANCE_CLASSES):
        chosen = np.random.default_rng(seed).permutation(len(labels))[: int(np.median(sizes))]
        group = ["group" if row in chosen else "rest" for row in range(len(labels))]
        print_class("group", group, space)


def print_class(label: str, labels: Sequence[str], space: BinSpace) -> None:
    """A row for every number of bins."""
    for found in find_minimal_bins(space, labels, label).sets:
        print(
            f"| {label} | {', '.join(found.bins)} | {found.nh_c_space:.3f} | {found.nh_c:.3f} |", flush=True
        )


def print_honest(scaled: FloatArray, labels: list[str], space: BinSpace, shuffles: int) -> None:
    """Cross-validation with the labels, and with shuffled ones."""
    everything = squared_distances(scaled[space.rows])
    print("| labels | bins | NH_s seen | held out, in their space | map | all features | recognised | all |")
    print("|---|---|---|---|---|---|---|---|")
    labelings = {"own": list(labels)} | {
        f"shuffled {seed}": shuffle_labels(space, labels, seed) for seed in range(shuffles)
    }
    for name, names in labelings.items():
        start = time.process_time()
        folds = []
        for fold in deal_folds(encode(space, names)[1], 0):
            folds.append(hold_out(space, names, fold, everything))
            print_folds(name, folds[-1:])
        print_folds(f"{name}, mean", folds)
        print(f"\n{time.process_time() - start:.1f} CPU seconds.\n")


def print_folds(name: str, folds: Sequence[HeldOutBins]) -> None:
    """A row: the mean over folds, each shape counting once."""
    weights = [fold.shapes for fold in folds]
    columns = ("nh_s_seen", "nh_space", "nh_s", "nh_s_all", "knn_accuracy", "knn_accuracy_all")
    means = [np.average([getattr(fold, column) for fold in folds], weights=weights) for column in columns]
    bins = np.mean([len(fold.bins) for fold in folds])
    print(f"| {name} | {bins:.0f} | " + " | ".join(f"{mean:.3f}" for mean in means) + " |", flush=True)


def main() -> None:
    """Search and print."""
    parser = argparse.ArgumentParser(description="The search for bins, measured.")
    parser.add_argument("part", choices=("automatic", "minimal", "honest"))
    parser.add_argument("features", type=Path, metavar="SITE/data/features.npz")
    parser.add_argument("--preset", choices=PRESETS, default="default")
    parser.add_argument("--shuffles", type=int, default=1, help="labelings without meaning")
    options = parser.parse_args()
    with threadpool_limits(limits=1):
        table, scaled, labels = load_features(options.features, options.preset)
        space = make_bin_space(table, PRESETS[options.preset], labels)
        # Compiling is not what is measured.
        select_bins(space.keep(np.arange(0, len(labels), 7)), labels, limit=2)
        if options.part == "automatic":
            print_automatic(table, options.preset, labels, space)
        elif options.part == "minimal":
            print_minimal(labels, space)
        else:
            print_honest(scaled, labels, space, options.shuffles)


if __name__ == "__main__":
    main()
