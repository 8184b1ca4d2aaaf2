"""The About page in a browser."""

import pytest
from waiting import eventually

from shapeviz_report.writing.record import RECORD


@pytest.mark.parametrize("width", [1280, 390])
def test_it_fits_the_window(open_page, width):
    page = open_page("nasty", "about.html", viewport={"width": width, "height": 900})
    page.locator("details summary").click()
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_downloads_are_there(open_page, site):
    page = open_page("plain", "about.html")
    links = page.eval_on_selector_all(
        "a[download][href^=data]", "links => links.map(link => link.getAttribute('href'))"
    )
    folder = site("plain")
    assert {folder / link for link in links} == set((folder / "data").iterdir()) - {folder / RECORD}


@pytest.mark.parametrize("file", ["about.html", "index.html"])
def test_pages_in_other_tabs_take_the_theme_along(open_page, site, serve, file):
    address = serve(site("plain"), "shapes")
    here = open_page("plain", "about.html", f"{address}/about.html")
    there = here.context.new_page()
    there.goto(f"{address}/{file}")
    there.wait_for_selector("#theme")
    if file == "index.html":
        there.wait_for_selector("html[data-ready]", state="attached")
    ground = "getComputedStyle(document.documentElement).colorScheme"
    for theme in ("dark", "light"):
        here.click("#theme")
        eventually(there, lambda theme=theme: there.evaluate(ground) == theme)


def test_the_theme_button_works(open_page):
    page = open_page("plain", "about.html", color_scheme="light")
    page.click("#theme")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"


def test_meshes_are_found_by_name_and_by_repair(open_page):
    page = open_page("plain", "about.html")
    page.locator("details summary").click()
    rows = page.locator("#meshes tbody tr:visible")
    every = rows.count()
    page.fill("#find-mesh", "duplicate FACES")
    assert 0 < rows.count() < every
    assert all("duplicate faces removed: 4" in row for row in rows.all_text_contents())
    page.fill("#find-mesh", "0003")
    assert 0 < rows.count() < every
    assert all("0003" in row for row in rows.all_text_contents())
    page.fill("#find-mesh", "no such thing")
    assert rows.count() == 0
    assert page.locator("#meshes [role=status]").text_content().startswith("0 of ")
