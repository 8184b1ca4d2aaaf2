"""Our t-SNE, exact and for many rows, beside scikit-learn's: CPU seconds, KL divergence, neighbourhood hit.

    python -m benchmarks.tsne seeds SITE/data/features.npz     ten seeds on a database's own features
    python -m benchmarks.tsne sizes 280 1000 5000 20000        generated rows, one seed

All start from the same principal components with the same jitter. The KL divergence is that of the affinities of all
pairs, whatever a library minimises, on up to 5000 rows. Everything runs on one thread.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from benchmarks.sites import load_features
from shapeviz_report.presets import PRESETS
from shapeviz_report.projections import squared_distances, tsne
from shapeviz_report.projections.base import principal_components
from shapeviz_report.projections.kernels import exact_tsne
from shapeviz_report.quality import NEIGHBOURS, neighbour_weights
from shapeviz_report.types import FloatArray

SEEDS = range(10)
PERPLEXITY = tsne.PERPLEXITY
PAIRS_LIMIT = 5000
"""Most rows for which all pairs are looked at: by the KL divergence, and by the exact engine."""

Layout = Callable[[FloatArray, int], FloatArray]


def ours(values: FloatArray, seed: int) -> FloatArray:
    """The exact engine, distances included."""
    return tsne.arrange(squared_distances(values), seed)


def for_many(values: FloatArray, seed: int) -> FloatArray:
    """openTSNE, as it lays out databases that are too large for the exact engine."""
    return tsne.embed(values, seed)


def by_scikit_learn(values: FloatArray, seed: int) -> FloatArray:
    """Barnes-Hut."""
    from sklearn.manifold import TSNE

    start = tsne._start(principal_components(values), seed)
    return TSNE(perplexity=PERPLEXITY, init=start, random_state=seed, n_jobs=1).fit_transform(values)


def by_scikit_learn_exactly(values: FloatArray, seed: int) -> FloatArray:
    """All pairs."""
    from sklearn.manifold import TSNE

    start = tsne._start(principal_components(values), seed)
    return TSNE(perplexity=PERPLEXITY, init=start, method="exact", random_state=seed).fit_transform(values)


SCIKIT_LEARN_LIMIT = 20_000
"""Most rows that scikit-learn lays out in less than an hour."""

LAYOUTS: dict[str, Layout] = {
    "ours, exact": ours,
    "ours, for many": for_many,
    "scikit-learn, Barnes-Hut": by_scikit_learn,
}


def divergence(values: FloatArray, xy: FloatArray) -> float:
    """KL divergence of a map from the exact affinities."""
    squared = squared_distances(values).astype(np.float32)
    shares = exact_tsne.affinities(squared, PERPLEXITY, len(values) - 1).astype(float)
    kernel = 1 / (1 + squared_distances(np.asarray(xy, dtype=float)))
    np.fill_diagonal(kernel, 0)
    kernel /= kernel.sum()
    there = shares > 0
    return float((shares[there] * np.log(shares[there] / kernel[there])).sum())


def neighbourhood_hit(xy: FloatArray, labels: np.ndarray) -> float:
    """NH_s."""
    weights = neighbour_weights(np.asarray(xy, dtype=float), NEIGHBOURS).tocoo()
    return float((weights.data * (labels[weights.row] == labels[weights.col])).sum() / len(labels))


def measure(layout: Layout, values: FloatArray, seed: int) -> tuple[float, FloatArray]:
    """CPU seconds and the map."""
    start = time.process_time()
    xy = layout(values, seed)
    return time.process_time() - start, xy


def compare_seeds(file: Path, preset: str) -> None:
    """Print a table over seeds."""
    _, values, folders = load_features(file, preset)
    labels = np.array(folders)
    print("| | CPU seconds | KL divergence | NH_s |\n|---|---|---|---|")
    for name, layout in (LAYOUTS | {"scikit-learn, exact": by_scikit_learn_exactly}).items():
        runs = [measure(layout, values, seed) for seed in SEEDS]
        kl = np.array([divergence(values, xy) for _, xy in runs])
        hits = np.array([neighbourhood_hit(xy, labels) for _, xy in runs])
        seconds = np.median([seconds for seconds, _ in runs])
        print(
            f"| {name} | {seconds:.3f} | {kl.mean():.3f} +- {kl.std(ddof=1):.3f} "
            f"| {hits.mean():.3f} +- {hits.std(ddof=1):.3f} |",
            flush=True,
        )


def compare_sizes(sizes: list[int]) -> None:
    """Print a table over numbers of rows: overlapping groups of 20 in 50 dimensions."""
    print("| rows | | CPU seconds | KL divergence | NH_s |\n|---|---|---|---|---|")
    for count in sizes:
        random = np.random.default_rng(0)
        labels = np.arange(count) // 20
        values = random.normal(size=(labels[-1] + 1, 50))[labels] + 1.6 * random.normal(size=(count, 50))
        for name, layout in LAYOUTS.items():
            if count > {ours: PAIRS_LIMIT, by_scikit_learn: SCIKIT_LEARN_LIMIT}.get(layout, count):
                continue
            seconds, xy = measure(layout, values, 0)
            kl = f"{divergence(values, xy):.3f}" if count <= PAIRS_LIMIT else ""
            print(
                f"| {count} | {name} | {seconds:.2f} | {kl} | {neighbourhood_hit(xy, labels):.3f} |",
                flush=True,
            )


def main() -> None:
    """Measure and print a table in Markdown."""
    parser = argparse.ArgumentParser(description="Our t-SNE beside scikit-learn's.")
    commands = parser.add_subparsers(dest="command", required=True)
    seeds = commands.add_parser("seeds", help="ten seeds on a database's own features")
    seeds.add_argument("features", type=Path, metavar="SITE/data/features.npz")
    seeds.add_argument("--preset", choices=PRESETS, default="default")
    sizes = commands.add_parser("sizes", help="generated rows, one seed")
    sizes.add_argument("rows", type=int, nargs="+")
    options = parser.parse_args()
    with threadpool_limits(limits=1):
        # Compiling is not what is compared.
        ours(np.random.default_rng(0).random((50, 5)), 0)
        if options.command == "seeds":
            compare_seeds(options.features, options.preset)
        else:
            compare_sizes(options.rows)


if __name__ == "__main__":
    main()
