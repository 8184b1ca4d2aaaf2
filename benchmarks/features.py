"""What choices of features, of their weights and of the perplexity give: retrieval, and maps by labels and without.

Run as ``python -m benchmarks.features SITE...`` on sites of the default preset, whose labels are the folders of the
shapes. Prints a table a site: nearest neighbour and average precision with their standard errors over shapes, and of
t-SNE maps, over ``SEEDS`` seeds, NH_s with its spread, trustworthiness and continuity (Venna and Kaski 2001) and the
share of true neighbours kept, all with ten neighbours.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from benchmarks.sites import load_features
from shapeviz_report.agreement import weigh
from shapeviz_report.faithfulness import rate_maps
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.projections import arrange, squared_distances, tsne
from shapeviz_report.quality import score
from shapeviz_report.retrieval import query_classes, rate
from shapeviz_report.types import FeatureTable, FloatArray

SEEDS = 5
NEIGHBOURS = 10
COMPONENTS = 30
"""To which principal components reduce."""


def only(table: FeatureTable, names: set[str]) -> FeatureTable:
    """The table with some of its features."""
    kept = [block for block in table.blocks if block.name in names]
    values = np.hstack([table.values[:, table.slice_of(block.name)] for block in kept])
    return FeatureTable(table.shape_ids, tuple(kept), values)


def reduce(values: FloatArray) -> FloatArray:
    """The first principal components."""
    centred = values - values.mean(axis=0)
    return centred @ np.linalg.svd(centred, full_matrices=False)[2][:COMPONENTS].T


def tell(name: str, values: FloatArray, labels: list[str], perplexity: float | None = None) -> None:
    """A row of the table."""
    squared = squared_distances(values)
    classes, codes = query_classes(labels)
    sizes = np.bincount(codes[codes >= 0], minlength=len(classes))
    rating = rate(squared, codes)
    shares = (rating.scores[:, [0, 5]] * sizes[:, None]).sum(axis=0) / sizes.sum()
    rows = []
    own = tsne.perplexity_of
    if perplexity is not None:
        tsne.perplexity_of = lambda count: perplexity
    try:
        for seed in range(SEEDS):
            xy = arrange(tsne.TSNE_METHOD, squared, seed)
            nh = score(xy, labels, k=NEIGHBOURS).nh_s or 0.0
            found = rate_maps(values, {"": xy}, NEIGHBOURS)[""]
            rows.append((nh, found.trustworthiness, found.continuity, found.kept.mean()))
    finally:
        tsne.perplexity_of = own
    means, spread = np.mean(rows, axis=0), np.std(rows, axis=0)[0]
    error = np.sqrt(shares[0] * (1 - shares[0]) / sizes.sum())
    print(
        f"| {name} | {shares[0]:.3f} ({error:.3f}) | {shares[1]:.3f} | {means[0]:.3f} ({spread:.3f}) "
        f"| {means[1]:.3f} | {means[2]:.3f} | {means[3]:.3f} |"
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("sites", nargs="+", type=Path)
    for site in parser.parse_args().sites:
        table, _, labels = load_features(site / "data" / "features.npz", "default")
        default, local = PRESETS["default"], PRESETS["local"]
        print(f"\n{site.name}, {len(labels)} shapes, {len(set(labels))} classes\n")
        print("| features | nearest neighbour | average precision | NH_s | trust | continuity | kept |")
        print("|---|---|---|---|---|---|---|")
        eight = scale(only(table, {block.name for block in local.blocks}), local)
        tell("eight, perplexity 30", eight, labels, 30.0)
        tell("eight (`local`)", eight, labels)
        for block in default.blocks[len(local.blocks) :]:
            tell(f"{block.name} alone", scale(only(table, {block.name}), local), labels)
        everything = scale(table, local)
        tell("all, equal weight", everything, labels)
        weighed = scale(weigh(table, default), default)
        tell("all, by agreement (`default`)", weighed, labels)
        for perplexity in (5.0, 10.0, 15.0, 20.0, 30.0, 50.0):
            if 3 * perplexity < len(labels):
                tell(f"the same, perplexity {perplexity:g}", weighed, labels, perplexity)
        tell(f"the same, {COMPONENTS} principal components", reduce(weighed), labels)
        print("\nweights:", ", ".join(f"{b.name} {b.weight:.2f}" for b in weigh(table, default).blocks))


if __name__ == "__main__":
    main()
