"""The paper's figures of the feature search beside ours: what docs/notes/reproduction.md states.

    python -m benchmarks.reproduction default=SITE/data/features.npz paper=OTHER_SITE/data/features.npz

Each site was built from the paper's database with the preset of that name. Prints Markdown.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from benchmarks.sites import load_features
from shapeviz_report.search import make_space, search_features
from shapeviz_report.types import FeatureSearch


def names(features: tuple[str, ...]) -> str:
    """Features as text."""
    return ", ".join(features)


def best_and_worst(search: FeatureSearch) -> tuple[int, int]:
    """Rows of ``search.subsets``."""
    return int(search.subsets.nh_s.argmax()), int(search.subsets.nh_s.argmin())


def features_of(search: FeatureSearch, row: int) -> tuple[str, ...]:
    """The features of a subset."""
    return tuple(np.array(search.features)[search.subsets.members[row]].tolist())


def print_search(preset: str, search: FeatureSearch) -> None:
    """All tables of one preset."""
    subsets = search.subsets
    best, worst = best_and_worst(search)
    print(f"\n## `{preset}`\n")
    print(f"{len(search.rows)} shapes, {len(subsets.nh_s)} subsets, {search.method}, seed {search.seed}.\n")
    print(f"- best: {names(features_of(search, best))}: {subsets.nh_s[best]:.3f}")
    print(f"- worst: {names(features_of(search, worst))}: {subsets.nh_s[worst]:.3f}")
    print(f"- all features: {subsets.nh_s[-1]:.3f}")
    print(
        f"- best of all subsets for random labels: {search.null_best.mean():.3f}, "
        f"{search.null_best.max():.3f} at most in {len(search.null_best)} trials"
    )
    print(
        "\n### Table 2\n\n| round | method | NH_s | CPU seconds | runs | features |\n|---|---|---|---|---|---|"
    )
    for row in search.table:
        method = row.method if row.s is None else f"{row.method}, s = {row.s}"
        print(
            f"| {row.round} | {method} | {row.nh_s:.3f} | {row.cpu_seconds:.1f} | {row.runs} "
            f"| {names(row.features)} |"
        )
    print("\n### Greedy over the rounds\n\n| s | NH_s below the best | share of the runs | of the time |")
    print("|---|---|---|---|")
    exhaustive = {row.round: row for row in search.table if row.s is None}
    for s in sorted({row.s for row in search.table if row.s is not None}):
        pairs = [(row, exhaustive[row.round]) for row in search.table if row.s == s]
        behind = [all_.nh_s - row.nh_s for row, all_ in pairs]
        runs = np.mean([row.runs / all_.runs for row, all_ in pairs])
        seconds = np.mean([row.cpu_seconds / all_.cpu_seconds for row, all_ in pairs])
        print(f"| {s} | {np.mean(behind):.4f}, {max(behind):.4f} at most | {runs:.0%} | {seconds:.0%} |")
    print("\n### Paths on the first seed\n")
    for greedy in search.greedy:
        steps = "; ".join(f"{names(step.changed)} {step.nh_s:.3f}" for step in greedy.path)
        print(f"- s = {greedy.s} ({greedy.runs} runs, {greedy.considered} with repetitions): {steps}")
    print(
        "\n### Spread over seeds\n\n| features | mean | std | behind the best | told apart |\n|---|---|---|---|---|"
    )
    for spread in search.spread:
        print(
            f"| {names(spread.features)} | {spread.mean:.3f} | {spread.std:.3f} "
            f"| {spread.behind:.3f} +- {spread.margin:.3f} | {'yes' if spread.told_apart else 'no'} |"
        )
    print("\n### Held-out shapes\n\n| chosen | by the others | held out | all features |\n|---|---|---|---|")
    for fold in search.held_out:
        print(f"| {names(fold.features)} | {fold.nh_s_seen:.3f} | {fold.nh_s:.3f} | {fold.nh_s_all:.3f} |")
    weights = [fold.shapes for fold in search.held_out]
    means = [
        np.average([getattr(fold, field) for fold in search.held_out], weights=weights)
        for field in ("nh_s_seen", "nh_s", "nh_s_all")
    ]
    print(f"| mean | {means[0]:.3f} | {means[1]:.3f} | {means[2]:.3f} |")
    third = np.argsort(subsets.nh_s)[-len(subsets.nh_s) // 3 :]
    shares = subsets.members[third].mean(axis=0)
    print(
        "\n### Features\n\n| | alone | with | without | adds | in the best third |\n|---|---|---|---|---|---|"
    )
    for effect, share in zip(search.effects, shares):
        print(
            f"| {effect.feature} | {effect.alone:.3f} | {effect.mean_with:.3f} | {effect.mean_without:.3f} "
            f"| {effect.added:+.3f} | {share:.0%} |"
        )
    quartiles = np.quantile(subsets.nh_c, [0.25, 0.5, 0.75], axis=0)
    print(
        "\n### Classes\n\n| | NH_c of the best map | median over the subsets | quartiles |\n|---|---|---|---|"
    )
    for c in np.argsort(-subsets.nh_c[best], kind="stable"):
        low, middle, high = quartiles[:, c]
        print(
            f"| {search.classes[c]} | {subsets.nh_c[best, c]:.3f} | {middle:.3f} | {low:.3f} - {high:.3f} |"
        )


def main() -> None:
    """Search and print."""
    parser = argparse.ArgumentParser(description="The feature search of the paper, with our figures.")
    parser.add_argument("sites", nargs="+", metavar="PRESET=SITE/data/features.npz")
    parser.add_argument("--method", choices=("tsne", "umap"), default="tsne")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    for site in options.sites:
        preset, _, file = site.partition("=")
        table, scaled, labels = load_features(Path(file), preset)
        space = make_space(table, scaled, labels, seed=options.seed)
        search = search_features(space, labels, options.method, seed=options.seed, rounds=options.rounds)
        print_search(preset, search)


if __name__ == "__main__":
    main()
