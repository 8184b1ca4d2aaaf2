"""The scorers of bins: CPU seconds, how well maps of their best bins separate, how far they agree.

    python -m benchmarks.scorers python SITE/data/features.npz     every class against the rest, in Python
    python -m benchmarks.scorers seeds SITE/data/features.npz      what another seed changes
    python -m benchmarks.scorers browser SITE/data/features.npz    times in Chromium, also of 1000 and 3000 shapes

`browser` needs playwright and Chromium, as the tests do. It times the task itself, without the messages between a page
and its worker. More shapes than there are: the shapes again, each value moved by up to a tenth.
"""

from __future__ import annotations

import argparse
import base64
import shutil
import time
from pathlib import Path

import numpy as np
from scipy.stats import spearmanr
from threadpoolctl import threadpool_limits

from benchmarks.sites import load_features
from shapeviz_report.presets import PRESETS, compared_values
from shapeviz_report.projections import PROJECTIONS, project
from shapeviz_report.quality import NEIGHBOURS, neighbour_weights, neighbourhood_hits
from shapeviz_report.scorers import SCORERS, Scorer, as_one_group, score_separation
from shapeviz_report.types import FloatArray
from shapeviz_report.writing.joiner import join

BEST = (10, 30, 50)
"""How many of the best bins make a map."""

TOP = 30
"""Best bins that two rankings should share."""

SIZES, RUNS = (1000, 3000), 3


def half_of(labels: np.ndarray) -> np.ndarray:
    """A random half of every class, as a mask."""
    random, half = np.random.default_rng(1), np.zeros(len(labels), dtype=bool)
    for name in np.unique(labels):
        half[random.permutation(np.flatnonzero(labels == name))[::2]] = True
    return half


def hit_of_class(values: FloatArray, bins: np.ndarray, members: np.ndarray, labels: np.ndarray) -> float:
    """NH_c of a class on the t-SNE map of some bins, each divided by its standard deviation."""
    chosen = values[:, bins]
    spread = chosen.std(axis=0)
    xy = project(PROJECTIONS[0], chosen / np.where(spread > 0, spread, 1), (), 0).xy
    codes = np.unique(labels, return_inverse=True)[1]
    return float(neighbourhood_hits(neighbour_weights(xy, NEIGHBOURS), codes)[members].mean())


def overlap(first: FloatArray, second: FloatArray) -> int:
    """How many of the ``TOP`` highest are the same."""
    return len(set(np.argsort(-first)[:TOP]) & set(np.argsort(-second)[:TOP]))


def relative(scorer: Scorer, values: FloatArray, labels: np.ndarray, name: str, seed: int = 0) -> FloatArray:
    """Scores of a class against the rest."""
    return score_separation(scorer, values, as_one_group(labels.tolist(), [name]), seed=seed)


def compare(values: FloatArray, labels: np.ndarray) -> None:
    """Print time and quality of all scorers, and how far they agree."""
    classes, half = np.unique(labels), half_of(labels)
    print(
        "| | CPU seconds a class | NH_c of the best 10, 30, 50 | of shapes that had no say |\n|---|---|---|---|"
    )
    found = {}
    for scorer in SCORERS:
        start = time.process_time()
        found[scorer.name] = [relative(scorer, values, labels, name) for name in classes]
        seconds = (time.process_time() - start) / len(classes)
        seen, unseen = [], []
        for name, scores in zip(classes, found[scorer.name]):
            best = np.argsort(-scores, kind="stable")
            seen.append([hit_of_class(values, best[:k], labels == name, labels) for k in BEST])
            learned = relative(scorer, values[half], labels[half], name)
            best, others = np.argsort(-learned, kind="stable"), labels[~half]
            unseen.append([hit_of_class(values[~half], best[:k], others == name, others) for k in BEST])
        columns = [" ".join(f"{x:.3f}" for x in np.mean(part, axis=0)) for part in (seen, unseen)]
        print(f"| {scorer.title} | {seconds:.3f} | {columns[0]} | {columns[1]} |", flush=True)
    print(f"\n| rank correlation \\ of the best {TOP} shared |" + "".join(f" {name} |" for name in found))
    print("|---" * (len(found) + 1) + "|")
    for one, rows in found.items():
        cells = []
        for other, columns in found.items():
            pairs = list(zip(rows, columns))
            below = list(found).index(one) > list(found).index(other)
            value = np.mean([spearmanr(a, b).statistic if below else overlap(a, b) for a, b in pairs])
            cells.append("" if one == other else f"{value:.2f}" if below else f"{value:.1f}")
        print(f"| {one} | " + " | ".join(cells) + " |")


def compare_seeds(values: FloatArray, labels: np.ndarray) -> None:
    """Print how far scores of two seeds agree."""
    print(f"| | rank correlation | of the best {TOP} shared |\n|---|---|---|")
    for scorer in SCORERS:
        if not scorer.exact:
            pairs = [
                [relative(scorer, values, labels, name, seed) for seed in (0, 1)]
                for name in np.unique(labels)
            ]
            ranks = np.mean([spearmanr(*pair).statistic for pair in pairs])
            shared = np.mean([overlap(*pair) for pair in pairs])
            print(f"| {scorer.title} | {ranks:.3f} | {shared:.1f} |", flush=True)


def time_browser(values: FloatArray, labels: np.ndarray) -> None:
    """Print times in Chromium, medians of several runs: of its processor's, which other work on the machine hardly
    changes, and by the clock."""
    from playwright.sync_api import sync_playwright

    random = np.random.default_rng(0)
    print("| shapes | contest | | CPU ms | first run | by the clock |\n|---|---|---|---|---|---|")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page()
        session = page.context.new_cdp_session(page)
        session.send("Performance.enable", {"timeDomain": "threadTicks"})

        def thread_seconds() -> float:
            metrics = session.send("Performance.getMetrics")["metrics"]
            return next(metric["value"] for metric in metrics if metric["name"] == "ThreadTime")

        page.evaluate(join(Path(__file__).parent / "scorers.js"))
        for size in (len(values), *SIZES):
            rows = np.arange(size) % len(values)
            noise = random.uniform(0.9, 1.1, (size, values.shape[1])) if size > len(values) else 1.0
            kinds = labels[rows]
            table = (values[rows] * noise).T.astype(np.float32)
            page.evaluate(
                """([text, rows, columns]) => {
                    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
                    window.table = { values: new Float32Array(bytes.buffer), rows, columns };
                }""",
                [base64.b64encode(table.tobytes()).decode(), size, len(table)],
            )
            first, second, *_ = np.unique(labels)
            groups = {"two classes": kinds == second, "class against rest": kinds != first}
            for contest, others in groups.items():
                for scorer in SCORERS:
                    parameters = {
                        "method": scorer.name,
                        "contests": [
                            {
                                "positive": np.flatnonzero(kinds == first).tolist(),
                                "negative": np.flatnonzero(others).tolist(),
                            }
                        ],
                        "columns": list(range(len(table))),
                        "seed": 0,
                    }
                    seconds, walls = [], []
                    for _ in range(RUNS):
                        before = thread_seconds()
                        walls.append(page.evaluate("(parameters) => timeScore(parameters)", parameters))
                        seconds.append(thread_seconds() - before)
                    print(
                        f"| {size} | {contest} | {scorer.title} | {1000 * np.median(seconds):.0f} "
                        f"| {1000 * seconds[0]:.0f} | {np.median(walls):.0f} |",
                        flush=True,
                    )
        browser.close()


def main() -> None:
    """Measure and print tables in Markdown."""
    parser = argparse.ArgumentParser(description="The scorers of bins: time, quality, agreement.")
    commands = {"python": compare, "seeds": compare_seeds, "browser": time_browser}
    parser.add_argument("command", choices=commands)
    parser.add_argument("features", type=Path, metavar="SITE/data/features.npz")
    parser.add_argument("--preset", choices=PRESETS, default="default")
    options = parser.parse_args()
    table, _, folders = load_features(options.features, options.preset)
    values, labels = compared_values(table, PRESETS[options.preset]), np.array(folders)
    with threadpool_limits(limits=1):
        for scorer in SCORERS:
            scorer.score(values[:40], np.arange(40) < 20)  # compiling is not what is compared
        commands[options.command](values, labels)


if __name__ == "__main__":
    main()
