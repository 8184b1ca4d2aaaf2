"""The engine of the Workbench in Chromium: times of maps, and their neighbourhood hit beside Python's.

    python -m benchmarks.browser times SITE/data/features.npz       280, 1000, 3000 shapes
    python -m benchmarks.browser quality SITE/data/features.npz     several seeds, started anew and from another map

Needs playwright and Chromium, as the tests do. Times are the CPU time of all of the browser's processes from the call
to the answer, with all messages between a page and its worker: what a reader waits on a machine that has no other work,
and a little more, as several threads add up. The fastest of several runs. More shapes than there are: the
shapes again, each value moved by up to a tenth. The times of the scorers are those of `benchmarks.scorers browser`.
"""

from __future__ import annotations

import argparse
import base64
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import CDPSession, Page, sync_playwright
from sklearn.ensemble import ExtraTreesClassifier
from threadpoolctl import threadpool_limits

from benchmarks.sites import load_features
from shapeviz_report.bins import scale_bins
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.projections import TSNE_METHOD, UMAP_METHOD, project
from shapeviz_report.quality import NEIGHBOURS, neighbour_weights, neighbourhood_hits
from shapeviz_report.types import FeatureTable, FloatArray
from shapeviz_report.writing.joiner import join
from shapeviz_report.writing.resources import site_folder

METHODS = (TSNE_METHOD, UMAP_METHOD)
SIZES, RUNS, SEEDS = (1000, 3000), 3, range(5)
BEST = (30, 51)
"""How many of the best bins make a map."""


class Engine:
    """The engine in a worker of a page."""

    def __init__(self, page: Page, session: CDPSession) -> None:
        self.page, self.session = page, session
        page.evaluate(join(Path(__file__).parent / "browser.js"))
        self.text = join(site_folder() / "scripts" / "engine" / "worker.js")

    def call(self, name: str, *arguments: Any) -> Any:
        """Call a function of browser.js."""
        return self.page.evaluate(f"(given) => engine.{name}(...given)", list(arguments))

    def time(self, name: str, *arguments: Any) -> float:
        """CPU milliseconds of a call."""
        before = self._cpu_seconds()
        self.call(name, *arguments)
        return 1000 * (self._cpu_seconds() - before)

    def _cpu_seconds(self) -> float:
        processes = self.session.send("SystemInfo.getProcessInfo")["processInfo"]
        return sum(process["cpuTime"] for process in processes)

    def start(self, compared: FloatArray, blocks: list[int]) -> None:
        """Start on compared values (n, d); ``blocks`` has the feature of each column."""
        count, width = compared.shape
        text = base64.b64encode(compared.T.astype(np.float32).tobytes()).decode()
        table = {"rows": count, "columns": width, "values": text, "blocks": blocks}
        self.call("start", self.text, {**table, "weights": [1.0] * (max(blocks) + 1)})
        self.count = count

    def lay_out(
        self, method: str, columns: np.ndarray, by: str, start: list[float] | None = None, seed: int = 0
    ) -> list[float]:
        """A map of all rows: x, y, x, y ..."""
        return self.call("layOut", method, self.count, columns.tolist(), by, start, seed)


@contextmanager
def open_engine() -> Iterator[Engine]:
    """An engine in a Chromium of its own."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        yield Engine(browser.new_page(), browser.new_browser_cdp_session())
        browser.close()


def choices(compared: FloatArray, codes: np.ndarray) -> dict[str, tuple[np.ndarray, str]]:
    """Columns to compare by: all features, the best bins by trees for all classes at once, any bins."""
    importances = ExtraTreesClassifier(300, random_state=0).fit(compared, codes).feature_importances_
    best = {f"best {k} bins": (np.sort(np.argsort(-importances)[:k]), "bins") for k in BEST}
    some = np.sort(np.random.default_rng(1).permutation(compared.shape[1])[: max(BEST)])
    return {"all features": (np.arange(compared.shape[1]), "features"), **best, "any 51 bins": (some, "bins")}


def neighbourhood_hit(xy: FloatArray, codes: np.ndarray) -> float:
    """NH_s."""
    points = np.asarray(xy, dtype=float).reshape(-1, 2)
    return float(neighbourhood_hits(neighbour_weights(points, NEIGHBOURS), codes).mean())


def measure_times(engine: Engine, compared: FloatArray, blocks: list[int], codes: np.ndarray) -> None:
    """Print the milliseconds of maps and of their hit."""
    random = np.random.default_rng(0)
    columns = {name: choice for name, choice in choices(compared, codes).items() if name != "any 51 bins"}
    print("| shapes | columns | | anew | from another map | hit |\n|---|---|---|---|---|---|")
    for size in (len(compared), *SIZES):
        rows = np.arange(size) % len(compared)
        moves = random.uniform(0.9, 1.1, (size, compared.shape[1])) if size > len(compared) else 1.0
        engine.start(compared[rows] * moves, blocks)
        hits = codes[rows].tolist()
        for name, (chosen, by) in columns.items():
            for method in METHODS:
                runs = RUNS if size <= 1000 else 1
                # From the map of half of the columns.
                half = engine.lay_out(method.name, chosen[::2], by)
                given = [method.name, size, chosen.tolist(), by]
                anew = min(engine.time("layOut", *given, None, 0) for _ in range(runs))
                warm = min(engine.time("layOut", *given, half, 0) for _ in range(runs))
                hit = min(engine.time("measureHit", half, hits) for _ in range(runs))
                print(
                    f"| {size} | {name} | {method.title} | {anew:.0f} | {warm:.0f} | {hit:.0f} |", flush=True
                )


def measure_quality(
    engine: Engine, table: FeatureTable, preset: str, blocks: list[int], codes: np.ndarray
) -> None:
    """Print NH_s over seeds: Python's, the browser's started anew, and from the map of all features."""
    compared = compared_values(table, PRESETS[preset])
    engine.start(compared, blocks)
    print(
        "| columns | | Python | browser, anew | browser, from the map of all features |\n|---|---|---|---|---|"
    )
    for name, (columns, by) in choices(compared, codes).items():
        if by == "features":
            scaled = scale(table, PRESETS[preset])
        else:
            scaled = scale_bins(table, PRESETS[preset], [table.columns[column] for column in columns])
        for method in METHODS:
            start = engine.lay_out(method.name, np.arange(compared.shape[1]), "features")
            maps = {
                "python": [project(method, scaled, (), seed).xy for seed in SEEDS],
                "anew": [engine.lay_out(method.name, columns, by, None, seed) for seed in SEEDS],
                "warm": [engine.lay_out(method.name, columns, by, start, seed) for seed in SEEDS],
            }
            hits = {way: [neighbourhood_hit(xy, codes) for xy in found] for way, found in maps.items()}
            cells = " | ".join(f"{np.mean(found):.3f} ± {np.std(found):.3f}" for found in hits.values())
            print(f"| {name} | {method.title} | {cells} |", flush=True)


def main() -> None:
    """Measure and print a table in Markdown."""
    parser = argparse.ArgumentParser(description="The engine of the Workbench in Chromium.")
    parser.add_argument("command", choices=("times", "quality"))
    parser.add_argument("features", type=Path, metavar="SITE/data/features.npz")
    parser.add_argument("--preset", choices=PRESETS, default="default")
    options = parser.parse_args()
    table, _, folders = load_features(options.features, options.preset)
    codes = np.unique(folders, return_inverse=True)[1]
    blocks = [number for number, block in enumerate(table.blocks) for _ in range(block.width)]
    with threadpool_limits(limits=1), open_engine() as engine:
        if options.command == "times":
            measure_times(engine, compared_values(table, PRESETS[options.preset]), blocks, codes)
        else:
            measure_quality(engine, table, options.preset, blocks, codes)


if __name__ == "__main__":
    main()
