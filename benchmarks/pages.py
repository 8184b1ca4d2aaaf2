"""The pages of built sites in Chromium: when they are ready, and what keeps their reader waiting.

    python -m benchmarks.pages [--runs 5] [--pages features,workbench] SITE...

Medians of several runs in which the sites take turns, in milliseconds: until the page says that it is ready, and the
longest task of its own thread, on the clock and of the CPU, as the machine's other work lengthens only the first. Then
the searches of two pages: from a key stroke until the page has answered and is drawn, for the slowest letter of a word;
and a lasso on the Overview: the CPU time of a step, exceeded by one in ten.
The first row is a page with nothing on it: what the browser itself takes.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import shutil
import tempfile
from collections import defaultdict
from pathlib import Path
from statistics import median, quantiles
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright

from shapeviz_report.pages import PAGES

RUNS = 5
SETTLED = 2000
"""How long a page is watched once it is ready: charts come after that."""
REACHED = 500
"""From coming to a field to the first letter."""
SIZE = {"width": 1440, "height": 900}
SEARCHES = {"overview": "#search", "workbench": "#bin-chart input[type=search]"}
TYPED = "curved edge"

LASSO = [
    (0.5 + 0.3 * math.cos(angle), 0.5 + 0.4 * math.sin(angle)) for angle in (step / 10 for step in range(60))
]
"""Where the mouse goes, in shares of the map's width and height."""

WATCH_READY = """new MutationObserver(() => {
    if (document.documentElement?.dataset.ready !== undefined) window.readyAt ??= performance.now();
}).observe(document, { attributes: true, subtree: true, attributeFilter: ["data-ready"] });"""

TYPE_LETTER = """async ([box, text]) => {
    const input = document.querySelector(box);
    const start = performance.now();
    input.value = text;
    input.dispatchEvent(new InputEvent("input", { bubbles: true }));
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    return performance.now() - start;
}"""

Figures = dict[str, float]
Event = dict[str, Any]
Thread = tuple[int, int]


def measure(browser: Browser, address: str, search: str | None) -> Figures:
    """The figures of a page, by name."""
    context = browser.new_context(viewport=SIZE)
    page = context.new_page()
    page.add_init_script(WATCH_READY)
    browser.start_tracing(page=page, categories=["toplevel", "blink.user_timing"])
    page.goto(address)
    if search is not None:
        page.wait_for_selector("html[data-ready]", state="attached")
    page.wait_for_timeout(SETTLED)
    trace = json.loads(browser.stop_tracing())["traceEvents"]
    thread, start = opening(trace, address)
    tasks = tasks_of(trace, thread, start)
    clock, cpu = (max(task.get(kind, 0) for task in tasks) / 1000 for kind in ("dur", "tdur"))
    figures = {"ready": page.evaluate("window.readyAt ?? 0"), "longest task": clock, "its CPU": cpu}
    if search:
        figures["key stroke"] = slowest_letter(page, search)
    if search == SEARCHES["overview"]:
        figures["lasso step"] = lasso_step(browser, page, thread)
    context.close()
    return figures


def opening(trace: list[Event], address: str) -> tuple[Thread, int]:
    """The thread that opened a page, and when."""
    # Pictures in SVG open as pages of their own.
    opened = next(
        event
        for event in trace
        if event["name"] == "navigationStart" and event["args"]["data"]["documentLoaderURL"] == address
    )
    return (opened["pid"], opened["tid"]), opened["ts"]


def tasks_of(trace: list[Event], thread: Thread, start: int = 0) -> list[Event]:
    return [
        event
        for event in trace
        if event["name"].endswith("RunTask")
        and (event["pid"], event["tid"]) == thread
        and event["ts"] >= start
    ]


def lasso_step(browser: Browser, page: Page, thread: Thread) -> float:
    """Milliseconds of the CPU that nine steps of ten do not exceed."""
    page.locator("label", has=page.locator("[name=drag][value=lasso]")).click()
    box = page.locator("figure[data-slot=large] .chart").bounding_box()
    assert box
    places = [(box["x"] + x * box["width"], box["y"] + y * box["height"]) for x, y in LASSO]
    browser.start_tracing(page=page, categories=["toplevel"])
    page.mouse.move(*places[0])
    page.mouse.down()
    for place in places[1:]:
        page.mouse.move(*place)
    page.mouse.up()
    tasks = tasks_of(json.loads(browser.stop_tracing())["traceEvents"], thread)
    steps = sorted(task.get("tdur", 0) / 1000 for task in tasks)[-len(LASSO) :]
    return quantiles(steps, n=10)[-1]


def slowest_letter(page: Page, box: str) -> float:
    """Milliseconds."""
    page.focus(box)
    page.wait_for_timeout(REACHED)
    begun = [TYPED[:length] for length in range(1, len(TYPED) + 1)]
    return max(page.evaluate(TYPE_LETTER, [box, text]) for text in begun)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pages")
    parser.add_argument("sites", metavar="SITE", nargs="+", type=Path)
    parser.add_argument("--runs", type=int, default=RUNS)
    parser.add_argument("--pages", type=lambda text: text.split(","), default=[page.name for page in PAGES])
    given = parser.parse_args()
    files = {page.name: page.file for page in PAGES}
    found: dict[tuple[str, str], list[Figures]] = defaultdict(list)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        empty = Path(folder) / "empty.html"
        empty.write_text("<!doctype html><title>Nothing</title><p>Nothing.")
        for _ in range(given.runs):
            browser = playwright.chromium.launch(
                executable_path=shutil.which("chromium"), args=["--no-sandbox"]
            )
            found["nothing", ""].append(measure(browser, empty.as_uri(), None))
            for name in given.pages:
                for site in given.sites:
                    address = (site.resolve() / files[name]).as_uri()
                    found[name, str(site)].append(measure(browser, address, SEARCHES.get(name, "")))
            browser.close()
    columns = ["ready", "longest task", "its CPU", "key stroke", "lasso step"]
    print(f"Load of the machine: {os.getloadavg()[0]:.1f}\n")
    print(f"| page | site | {' | '.join(columns)} |\n|---|---|{'---|' * len(columns)}")
    for (name, site), runs in found.items():
        cells = [
            f"{median(run[column] for run in runs):.0f}" if column in runs[0] else "" for column in columns
        ]
        print(f"| {name} | {site} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
