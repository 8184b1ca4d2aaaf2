"""All subsets of features by our t-SNE beside scikit-learn's: CPU seconds and neighbourhood hit.

    python -m benchmarks.search SITE/data/features.npz --sample 20

Ours evaluates every subset; scikit-learn (Barnes-Hut, its own defaults but for the common start) an even sample of
them, from which the cost of all is extrapolated. Both run on one thread.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from benchmarks.sites import load_features
from shapeviz_report.presets import PRESETS
from shapeviz_report.projections import tsne
from shapeviz_report.quality import NEIGHBOURS, neighbour_weights, neighbourhood_hits
from shapeviz_report.search import make_space, map_subsets


def main() -> None:
    """Measure and print a table in Markdown."""
    parser = argparse.ArgumentParser(description="All subsets of features, by our t-SNE and scikit-learn's.")
    parser.add_argument("features", type=Path, metavar="SITE/data/features.npz")
    parser.add_argument("--preset", choices=PRESETS, default="default")
    parser.add_argument("--sample", type=int, default=20, help="subsets for scikit-learn")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()

    table, scaled, labels = load_features(options.features, options.preset)
    space = make_space(table, scaled, labels)
    codes = np.unique(labels, return_inverse=True)[1][space.rows]
    blocks = [scaled[space.rows][:, table.slice_of(name)] for name in space.features]

    def score(xy: np.ndarray) -> float:
        return float(neighbourhood_hits(neighbour_weights(xy.astype(float), NEIGHBOURS), codes).mean())

    # Compiling is not what is compared.
    map_subsets(space.squared, "tsne", options.seed, [space.everything])
    start = time.process_time()
    ours = map_subsets(space.squared, "tsne", options.seed, range(1, space.everything + 1))
    our_seconds = time.process_time() - start
    hits = np.array([score(xy) for xy in ours.xy])

    chosen = np.unique(np.linspace(1, space.everything, options.sample).astype(int))
    their_hits, their_seconds = [], []
    with threadpool_limits(limits=1):
        for subset in chosen:
            values = np.concatenate([b for i, b in enumerate(blocks) if subset >> i & 1], axis=1)
            start = time.process_time()
            xy = tsne.embed(values, options.seed)
            their_seconds.append(time.process_time() - start)
            their_hits.append(score(xy))
    their_mean = float(np.mean(their_seconds))
    gained = hits[chosen - 1] - their_hits
    print("| | maps | CPU seconds a map | all | NH_s on the sample |\n|---|---|---|---|---|")
    print(
        f"| ours | {len(hits)} | {our_seconds / len(hits):.4f} | {our_seconds:.1f} "
        f"| {hits[chosen - 1].mean():.4f} |"
    )
    print(
        f"| scikit-learn | {len(chosen)} | {their_mean:.3f} | {their_mean * len(hits):.0f}, extrapolated "
        f"| {np.mean(their_hits):.4f} |"
    )
    error = gained.std(ddof=1) / np.sqrt(len(gained))
    print(
        f"\nCheaper by {their_mean * len(hits) / our_seconds:.0f}; NH_s higher by {gained.mean():.4f} +- {error:.4f}."
    )


if __name__ == "__main__":
    main()
