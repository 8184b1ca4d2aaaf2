"""What a built site says in words, to read aloud: ten pairs of classes, outliers, bins, shapes, clusters.

    python -m benchmarks.sentences SITE

Needs playwright and Chromium, as the tests do. The pairs are the five whose classes are most alike, and five more from
all over the database.
"""

from __future__ import annotations

import argparse
import csv
import shutil
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlencode

from playwright.sync_api import Page, sync_playwright

PAIRS = 10
BINS, SHAPES = 12, 4
"""Bins of the Bins page, and shapes, of which each is looked at."""


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("site", type=Path)
    site = parser.parse_args().site.resolve()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1440, "height": 1000})
        for text in read_out(page, site):
            print(text)


def read_out(page: Page, site: Path) -> Iterator[str]:
    """The words of each view in turn."""
    yield from _compared(page, site)
    _open(page, site, "compare.html", view="outliers")
    page.wait_for_selector(".outlier .reason")
    yield from _texts(page, "Outliers", "#outlier-words, .outlier .whereabouts > p, .outlier .reasons p")
    yield from _bins(page, site)
    yield from _shapes(page, site)
    _open(page, site, "about.html")
    yield from _texts(page, "Clusters", "tr:has(th bdi) td:last-child")


def _compared(page: Page, site: Path) -> Iterator[str]:
    classes = sorted({row["class"] for row in _table(site)} - {""})
    _open(page, site, "compare.html", view="classes")
    alike = page.locator("#likest li").evaluate_all(
        "(items) => items.map((item) => [...item.querySelectorAll('bdi')].map((name) => name.textContent))"
    )
    pairs = [(pair[0], pair[1]) for pair in alike[: PAIRS // 2]]
    count = len(classes)
    step = 0
    while len(pairs) < min(PAIRS, count * (count - 1) // 2):
        first, second = classes[step % count], classes[(3 * step + 1 + step // count) % count]
        step += 1
        if first != second and (first, second) not in pairs and (second, first) not in pairs:
            pairs.append((first, second))
    for first, second in pairs:
        _open(page, site, "compare.html", a=f"class:{first}", b=f"class:{second}")
        page.wait_for_selector("#result:not([hidden])")
        yield from _texts(
            page,
            f"{first} and {second}",
            "#answer h2, #answer li, #answer p, #apart-words, .bin-of-two .bin-name, .bin-of-two .says, "
            ".bin-of-two > p:last-of-type, #seen-bin, #shared-words",
        )


def _bins(page: Page, site: Path) -> Iterator[str]:
    _open(page, site, "bins.html")
    options = page.locator("#bin-choice option")
    values = options.evaluate_all("(options) => options.map((option) => option.value)")
    for value in values[:: max(len(values) // BINS, 1)]:
        page.select_option("#bin-choice", value)
        yield from _texts(page, f"Bin {value}", "#bin-words h3, #bin-words p, #legend > p")


def _shapes(page: Page, site: Path) -> Iterator[str]:
    rows = _table(site)
    for row in rows[:: max(len(rows) // SHAPES, 1)][:SHAPES]:
        _open(page, site, "shape.html", id=row["id"])
        page.evaluate("() => document.getElementById('by-features').scrollIntoView()")
        page.wait_for_selector(".similar")
        yield from _texts(page, row["name"], "#similar-words, .similar .why")


def _table(site: Path) -> list[dict[str, str]]:
    """The shapes of a site with what is known of them."""
    with (site / "data" / "shapes.csv").open(encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


def _open(page: Page, site: Path, file: str, **query: str) -> None:
    # A new address of an open page is no new page.
    page.goto("about:blank")
    page.goto(f"{(site / file).as_uri()}#{urlencode(query)}")
    page.wait_for_selector("html[data-ready]")


def _texts(page: Page, title: str, selector: str) -> Iterator[str]:
    yield f"\n== {title}"
    for text in page.locator(selector).all_inner_texts():
        if text.strip():
            yield " ".join(text.split())


if __name__ == "__main__":
    main()
