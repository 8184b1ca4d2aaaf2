"""Clusters beside the labels of built sites, and how far they depend on seeds and on which shapes there are.

``python -m benchmarks.clusters FEATURES.npz... [--preset default]``; see docs/method/clusters.md.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from sklearn.metrics import adjusted_rand_score, normalized_mutual_info_score

from benchmarks.sites import load_features
from shapeviz_report.clusters import part
from shapeviz_report.presets import PRESETS

SEEDS = 3


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "file", type=Path, nargs="+", help="SITE/data/features.npz, of shapes in class folders"
    )
    parser.add_argument("--preset", choices=PRESETS, default="default")
    options = parser.parse_args()
    for file in options.file:
        _, scaled, labels = load_features(file, options.preset)
        print(f"{file}: {len(labels)} shapes, {len(set(labels))} classes")
        for seed in range(SEEDS):
            found = part(scaled, seed=seed)
            kept = np.random.default_rng(seed).permutation(len(labels))[: 2 * len(labels) // 3]
            fewer = part(scaled[kept], seed=seed)
            if found is None or fewer is None:
                print("  no clusters")
                continue
            print(
                f"  seed {seed}: {found.of.max() + 1} clusters, "
                f"NMI {normalized_mutual_info_score(labels, found.of):.3f}, "
                f"ARI {adjusted_rand_score(labels, found.of):.3f}, "
                f"silhouette {found.silhouette:.3f}, steadiness {found.steadiness:.2f}, "
                f"agreement of two thirds {adjusted_rand_score(found.of[kept], fewer.of):.3f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
