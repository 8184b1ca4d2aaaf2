"""Neighbourhood hit of t-SNE maps of chosen bins, by scorer and by the weight of the bins.

    python -m benchmarks.bin_weights SITE/data/features.npz

The best k bins are those with the highest mean, over all classes, of the relative score of the class against the rest.
"Held out": bins are chosen without the labels of a fifth of the shapes, then NH of these shapes is taken on the map of
all; the mean over the five fifths. One thread; the means of three seeds.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from benchmarks.sites import load_features
from shapeviz_report.bins import scale_bins
from shapeviz_report.presets import PRESETS, compared_values
from shapeviz_report.projections import PROJECTIONS, project
from shapeviz_report.quality import NEIGHBOURS, neighbour_weights, neighbourhood_hits
from shapeviz_report.scorers import SCORERS, Scorer, as_one_group, score_separation
from shapeviz_report.search.certainty import deal_folds
from shapeviz_report.types import FeatureTable, FloatArray

SEEDS = range(3)
RANDOM_CHOICES = 5
PRESET = PRESETS["default"]

Weigh = Callable[[FeatureTable, Sequence[int]], FloatArray]


def by_bins(table: FeatureTable, columns: Sequence[int]) -> FloatArray:
    """As a build with ``--bins`` does."""
    return scale_bins(table, PRESET, [table.columns[column] for column in columns])


def by_features(table: FeatureTable, columns: Sequence[int]) -> FloatArray:
    """Each feature of equal weight, with what is left of it."""
    compared, parts = compared_values(table, PRESET), []
    for block in table.blocks:
        own = table.slice_of(block.name)
        chosen = [column for column in columns if own.start <= column < own.stop]
        if chosen:
            centred = compared[:, chosen] - compared[:, chosen].mean(axis=0)
            parts.append(centred / np.sqrt((centred**2).sum(axis=1).mean()))
    return np.column_stack(parts)


def plain(table: FeatureTable, columns: Sequence[int]) -> FloatArray:
    """Square roots without a weight."""
    return compared_values(table, PRESET)[:, list(columns)]


WEIGHTS: dict[str, Weigh] = {"by features": by_features, "by bins": by_bins, "none": plain}


def hits(values: FloatArray, codes: np.ndarray) -> FloatArray:
    """NH of every shape, the mean over seeds."""
    tsne = PROJECTIONS[0]
    maps = [project(tsne, values, (), seed).xy for seed in SEEDS]
    return np.mean([neighbourhood_hits(neighbour_weights(xy, NEIGHBOURS), codes) for xy in maps], axis=0)


def rank(scorer: Scorer, compared: FloatArray, labels: Sequence[str | None]) -> list[int]:
    """All bins from the best to the worst by the labels that are given."""
    classes = sorted({label for label in labels if label is not None})
    scores = [score_separation(scorer, compared, as_one_group(labels, [name])) for name in classes]
    return np.argsort(-np.mean(scores, axis=0), kind="stable").tolist()


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("features", type=Path, metavar="SITE/data/features.npz")
    parser.add_argument("--count", type=int, nargs="+", default=[30, 51])
    options = parser.parse_args()
    table, _, labels = load_features(options.features, PRESET.name)
    codes = np.unique(labels, return_inverse=True)[1]
    compared = compared_values(table, PRESET)
    width = len(table.columns)
    print(f"{'bins':20}" + "".join(f"{name:>14}" for name in (*WEIGHTS, "held out")))

    def tell(name: str, *choices: Sequence[int], held_out: float | None = None) -> None:
        found = [
            np.mean([hits(weigh(table, c), codes).mean() for c in choices]) for weigh in WEIGHTS.values()
        ]
        last = "" if held_out is None else f"{held_out:14.3f}"
        print(f"{name:20}" + "".join(f"{value:14.3f}" for value in found) + last, flush=True)

    with threadpool_limits(limits=1):
        tell("all", range(width))
        for count in options.count:
            random = np.random.default_rng(0)
            tell(f"random {count}", *(random.choice(width, count, False) for _ in range(RANDOM_CHOICES)))
        for scorer in SCORERS:
            ranked = rank(scorer, compared, labels)
            folds = deal_folds(codes, 0)
            seen = [[None if row in fold else label for row, label in enumerate(labels)] for fold in folds]
            ranked_by = [rank(scorer, compared, some) for some in seen]
            for count in options.count:
                reached = np.empty(len(labels))
                for fold, order in zip(folds, ranked_by, strict=True):
                    reached[fold] = hits(by_bins(table, order[:count]), codes)[fold]
                tell(f"{scorer.name} {count}", ranked[:count], held_out=reached.mean())


if __name__ == "__main__":
    main()
