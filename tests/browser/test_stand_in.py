"""A site without labels in a browser: it works with clusters, and says so on every page."""

from __future__ import annotations

import re

import pytest
from waiting import box_of

from shapeviz_report.pages import PAGES


@pytest.mark.parametrize("page_file", [page.file for page in PAGES])
def test_every_page_opens_and_says_that_clusters_stand_in(open_page, page_file) -> None:
    page = open_page("clusters", page_file, viewport={"width": 390, "height": 800})
    notice = page.get_by_role("note").filter(has_text="stand in for classes")
    assert notice.is_visible()
    box = box_of(notice)
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= 390
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    assert notice.get_by_role("link").get_attribute("href") == "about.html#clusters"


@pytest.mark.parametrize(
    "address",
    [page.file for page in PAGES if page.file not in ("about.html", "shape.html")]
    + ["compare.html#view=outliers", "compare.html#view=classes", "shape.html#id=class000/0000"],
)
def test_where_clusters_stand_in_no_page_speaks_of_classes(open_page, address) -> None:
    page = open_page("clusters searched", address)
    words = page.evaluate(
        """() => {
            for (const folded of document.querySelectorAll("main details")) folded.open = true;
            const titles = [...document.querySelectorAll("main [title]")].filter((node) => node.checkVisibility());
            return [document.querySelector("main").innerText, ...titles.map(({ title }) => title)].join("\\n");
        }"""
    )
    # The shapes of the report have "class" in their names.
    assert "cluster" in words or address.startswith("shapes.html")
    assert re.findall(r"[^.\n]*\b[Cc]lass(?:es)?\b[^.\n]*", words) == []


def test_the_overview_fits_the_window_below_the_notice(open_page) -> None:
    page = open_page("clusters")
    assert page.evaluate("document.documentElement.scrollHeight") <= 900
    assert box_of(page.locator("#tray"))["y"] < 900
    names = page.locator("#legend li").all_text_contents()
    assert names
    assert all("like shape" in name or "like class" in name for name in names)
    assert "The clusters come from the same features" in page.locator("#quality").text_content()
