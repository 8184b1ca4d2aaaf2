"""What a reader of a large site waits for, by double-click in windows of Chromium and Firefox.

    PYTHONPATH=tests python -m benchmarks.reader [--runs 3] [--browsers Chromium,Firefox] SITE

The steps of a visit: medians of the seconds until what was asked for is drawn, on the clock and of the CPU (all
processes of the browser), and of the MiB that the page's process then takes (its proportional set size). Every page
has a window of its own, in which nothing is remembered; the first row is a window before it.
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from browsers import opened
from webdriver import Window

RUNS = 3
TICKS = os.sysconf("SC_CLK_TCK")
TABS = ("--type=renderer", "-contentproc")
"""What the command lines of processes that show pages have, in Chromium and in Firefox."""
LONGEST = 55
"""Seconds that a step may take; browsers are asked to end a script after sixty."""
SETTLED = 3
"""Seconds from a step to the next."""

READY = "document.documentElement.dataset.ready !== undefined"
DONE = "!document.querySelector('main[aria-busy=true]')"

#: Does something, and waits until something holds and is drawn.
STEP = """async () => {
  const end = performance.now() + 1000 * MOST;
  ACTION;
  while (!(CONDITION)) {
    if (performance.now() > end) return "too long";
    await new Promise((done) => setTimeout(done, 10));
  }
  await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  return "done";
}"""


@dataclass(frozen=True)
class Step:
    """``action`` and ``condition`` are JavaScript; without an action, the step is the opening of its page."""

    name: str
    condition: str
    action: str = ""


def visits(shape: str, classes: tuple[str, str]) -> dict[str, list[Step]]:
    """The steps by the address of the page that they are done on."""
    first, second = classes
    return {
        "index.html": [
            Step("Overview", READY),
            Step(
                "search on the map",
                "document.querySelectorAll('#search-found li').length > 0",
                typed("bowl 12"),
            ),
        ],
        "shapes.html": [
            Step("Shapes", f"{READY} && {pictures('#grid img')}"),
            Step(
                "search",
                "document.querySelector('#grid .cell .name')?.textContent !== first",
                f"const first = document.querySelector('#grid .cell .name').textContent; {typed('bowl')}",
            ),
        ],
        f"shape.html#id={shape}": [
            Step("a shape", f"{READY} && {pictures('#neighbours img')}"),
            Step(
                "similar shapes",
                "document.querySelectorAll('#similar-list .similar').length === 12",
                "document.querySelector('#by-features').scrollIntoView()",
            ),
            Step(
                "similar by one feature less",
                "list.dataset.was !== list.textContent && !document.querySelector('#by-features[aria-busy]')",
                "const list = document.querySelector('#similar-list'); list.dataset.was = list.textContent;"
                " document.querySelectorAll('.compared')[1].click()",
            ),
        ],
        f"compare.html#a=class:{first}&b=class:{second}": [
            Step("Compare, two classes", f"{READY} && !document.querySelector('#result').hidden"),
        ],
        "features.html": [Step("Features", READY)],
        "bins.html": [Step("Bins", READY)],
        "workbench.html": [
            Step("Workbench", READY),
            Step(
                "a map of the bins found",
                f"document.querySelector('figure[data-map=refined] .value')?.textContent && {DONE}",
                "document.querySelector('#bin-find').click()",
            ),
        ],
    }


def typed(text: str) -> str:
    return (
        f"const field = document.querySelector('#search'); field.value = {json.dumps(text)};"
        " field.dispatchEvent(new InputEvent('input', { bubbles: true }))"
    )


def pictures(images: str) -> str:
    """Whether there are such images, and all are there that are in sight."""
    return (
        f"((all) => all.length > 0 && all.every((one) => one.complete && one.naturalWidth > 0))"
        f"([...document.querySelectorAll('{images}')].filter((one) => one.getBoundingClientRect().top < innerHeight"
        " && one.getBoundingClientRect().bottom > 0))"
    )


def measure(window: Window, browser: int, step: Step, address: str | None) -> tuple[float, float, float]:
    """Seconds on the clock, of the CPU, and MiB, of a step in the window of a browser's process."""
    began, spent = time.perf_counter(), cpu_seconds(browser)
    if address is not None:
        window.wire.send("Navigate", {"url": address})
    script = (
        STEP.replace("MOST", str(LONGEST)).replace("ACTION", step.action).replace("CONDITION", step.condition)
    )
    outcome = window.until(script, seconds=2 * LONGEST)
    clock, cpu = time.perf_counter() - began, cpu_seconds(browser) - spent
    if outcome != "done":
        raise TimeoutError(f"{step.name}: more than {LONGEST} seconds")
    time.sleep(SETTLED)
    return clock, cpu, memory(browser)


def family(process: int) -> Iterator[int]:
    """A process and all below it."""
    yield process
    for task in Path(f"/proc/{process}/task").glob("*/children"):
        try:
            children = task.read_text(encoding="utf-8").split()
        except OSError:
            continue
        for child in children:
            yield from family(int(child))


def cpu_seconds(browser: int) -> float:
    """Of all processes of a browser that are alive, and of those that they have waited for."""
    total = 0.0
    for process in family(browser):
        try:
            fields = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        except OSError:
            continue
        total += sum(map(int, fields[11:15])) / TICKS
    return total


def memory(browser: int) -> float:
    """MiB of the page's process: the largest of those that show pages."""
    sizes = [0.0]
    for process in family(browser):
        try:
            command = Path(f"/proc/{process}/cmdline").read_text(encoding="utf-8")
            if any(tab in command for tab in TABS):
                lines = Path(f"/proc/{process}/smaps_rollup").read_text(encoding="utf-8").splitlines()
                sizes.append(next(int(line.split()[1]) / 1024 for line in lines if line.startswith("Pss:")))
        except OSError:
            continue
    return max(sizes)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.reader")
    parser.add_argument("site", metavar="SITE", type=Path)
    parser.add_argument("--runs", type=int, default=RUNS)
    parser.add_argument("--browsers", type=lambda text: text.split(","), default=["Chromium", "Firefox"])
    parser.add_argument("--shape", default="round bowl/000017")
    parser.add_argument(
        "--classes", type=lambda text: tuple(text.split(",")), default=("round bowl", "tall jar")
    )
    given = parser.parse_args()
    found: dict[tuple[str, str], list[Any]] = defaultdict(list)
    for _ in range(given.runs):
        for browser in given.browsers:
            for page, steps in visits(given.shape, given.classes).items():
                with (
                    tempfile.TemporaryDirectory() as folder,
                    opened(browser, Path(folder) / "files") as window,
                ):
                    window.visit("about:blank")
                    found["a window", browser].append((0, 0, memory(os.getpid())))
                    for step in steps:
                        address = f"{given.site.resolve().as_uri()}/{page}" if step is steps[0] else None
                        found[step.name, browser].append(measure(window, os.getpid(), step, address))
                        print(
                            step.name,
                            browser,
                            *(f"{value:.2f}" for value in found[step.name, browser][-1]),
                            flush=True,
                        )
    print(f"\nLoad of the machine: {os.getloadavg()[0]:.1f}\n")
    print("| step | browser | s | CPU s | MiB |\n|---|---|---|---|---|")
    for (name, browser), runs in found.items():
        clock, cpu, size = (median(run[column] for run in runs) for column in range(3))
        print(f"| {name} | {browser} | {clock:.2f} | {cpu:.2f} | {size:.0f} |")


if __name__ == "__main__":
    main()
