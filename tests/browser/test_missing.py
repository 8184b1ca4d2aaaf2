"""An address that names what is not there: every page says so, in one line above it."""

from __future__ import annotations

from urllib.parse import urlencode

import pytest
from waiting import box_of, drawn_again, eventually

HOSTILE = (
    "<img src=x onerror=alert(1)>",
    "toString",
    "\u202egnp.exe",
    "%F0%9F&%",
    "x" * 20_000,
)

# What each page says of an address; names that are there, and those of other pages, it does not mention.
ADDRESSES = {
    "index.html": (
        {
            "map": "mds",
            "features": "Gc dragons",
            "hide": "dragon",
            "color": "column:planet",
            "select": "ghost",
            "find": "x",
        },
        "This link names the map “mds”, the feature “dragons”, the class “dragon”, the shape “ghost” and the column "
        "“planet”, which this page does not offer.",
    ),
    "features.html": (
        {"features": "dragons", "color": "bin:Gc:99", "open": "ghost", "map": "umap"},
        "This link names the feature “dragons”, the shape “ghost” and the bin “Gc:99”, which are not in this database.",
    ),
    "workbench.html": (
        {"class": "dragon", "bins": "Gc:1 Gc:11 Gc:12", "map": "pca", "features": "Gc"},
        "This link names the class “dragon”, and the bins “Gc:11” and “Gc:12”, which are not in this database.",
    ),
    "bins.html": (
        {"bin": "Gc:11", "of": "dragon", "id": "ghost", "map": "mds"},
        "This link names the bin “Gc:11”, the class “dragon”, the shape “ghost” and the map “mds”, which this page "
        "does not offer.",
    ),
    "shapes.html": (
        {"is.planet": "Mars", "sort": "nh:mds", "select": "ghost", "hide": "dragon"},
        "This link names the column “planet”, the map “mds”, the shape “ghost” and the class “dragon”, which this page "
        "does not offer.",
    ),
    "shape.html": (
        {"id": "class000/0000", "beside": "ghost", "features": "dragons", "parts": "Gc[7]", "map": "pca"},
        "This link names the shape “ghost”, the feature “dragons” and the bin “Gc[7]”, which are not in this database.",
    ),
    "compare.html": (
        {"a": "class:dragon", "b": "cluster:nobody", "bin": "Gc:11", "select": "ghost"},
        "This link names the shape “ghost”, the class “dragon”, the cluster “nobody” and the bin “Gc:11”, which are "
        "not in this database.",
    ),
}

# A name that each page looks up: the parameter, and what stands before it.
NAMES = {
    "index.html": ("hide", ""),
    "features.html": ("open", ""),
    "workbench.html": ("hide", ""),
    "bins.html": ("bin", ""),
    "shapes.html": ("at", ""),
    "shape.html": ("bin", ""),
    "compare.html": ("a", "class:"),
}


def said(page) -> str:
    return " ".join(page.locator("#missing").text_content().split())


@pytest.mark.parametrize("file", ADDRESSES)
def test_a_page_says_what_its_address_names_in_vain(open_page, file) -> None:
    names, sentence = ADDRESSES[file]
    page = open_page("everything", f"{file}#{urlencode(names)}")
    eventually(page, lambda: said(page) == sentence)
    line = page.get_by_role("status").filter(has_text="This link names")
    assert line.count() == 1
    box = box_of(line)
    assert box["y"] + box["height"] <= box_of(page.locator("main"))["y"] + 1
    assert open_page("everything", file).locator("#missing").text_content() == ""


@pytest.mark.parametrize("file", NAMES)
def test_names_are_text_and_short_whatever_they_are(open_page, file) -> None:
    parameter, before = NAMES[file]
    page = open_page("everything", file, viewport={"width": 390, "height": 800})
    for name in HOSTILE:
        page.evaluate("(hash) => { location.hash = hash; }", urlencode({parameter: before + name}))
        shown = name if len(name) <= 40 else f"{name[:39]}…"
        eventually(page, lambda shown=shown: page.locator("#missing bdi").all_text_contents() == [shown])
        assert page.locator("#missing img").count() == 0
        assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_the_line_goes_with_what_the_reader_does_and_comes_back_with_the_address(open_page) -> None:
    page = open_page("workbench", "workbench.html#hide=dragon")
    assert "“dragon”" in said(page)
    # What the page does by itself, as its maps come, leaves it there.
    page.wait_for_selector("#content[aria-busy=false]")
    assert "“dragon”" in said(page)
    page.get_by_role("radio", name="UMAP").locator("..").click()
    eventually(page, lambda: said(page) == "")
    page.go_back()
    eventually(page, lambda: "“dragon”" in said(page))
    page.evaluate("location.hash = 'hide=wyvern'")
    eventually(page, lambda: "“wyvern”" in said(page))
    assert "dragon" not in said(page)
    page.evaluate("location.hash = 'hide=kind a'")
    eventually(page, lambda: said(page) == "")


@pytest.mark.parametrize(
    ("link", "name"),
    [
        ("shapes.html#class=nope", "the class “nope”"),
        ("compare.html#a=nope", "the group “nope”"),
        ("index.html#view=bar", "the view “bar”"),
        ("bins.html#size=many", "the setting “many”"),
        ("bins.html#shape=none", "the setting “none”"),
        ("bins.html#map=mds", "the map “mds”"),
        ("compare.html#map=mds", "the map “mds”"),
        ("shapes.html#size=99999", "the setting “99999”"),
        ("index.html#at=9,0,1", "the part of a map “9,0,1”"),
        ("index.html#lines=some", "the setting “some”"),
        ("index.html#step=2", "the setting “step”"),
        ("workbench.html#hidden=ant", "the setting “hidden”"),
        ("shapes.html#range.column:none=1..2", "the column “none”"),
        ("about.html#chosen=Gc", "the setting “chosen”"),
    ],
)
def test_what_a_page_passes_over_is_told(open_page, link, name) -> None:
    page = open_page("bins", link)
    eventually(page, lambda: said(page).startswith(f"This link names {name}, which "))


@pytest.mark.parametrize("link", ["features.html#separation", "about.html#features", "index.html#content"])
def test_a_place_on_the_page_is_no_setting(open_page, link) -> None:
    page = open_page("bins", link)
    page.wait_for_selector("html[data-ready]", state="attached")
    assert page.evaluate("(id) => document.getElementById(id) !== null", link.split("#")[1])
    assert said(page) == ""


def test_a_size_that_was_not_searched_is_told(open_page) -> None:
    page = open_page("everything", "features.html#s=99")
    eventually(page, lambda: said(page).startswith("This link names the setting “99”, which "))


def test_an_address_of_no_id_names_no_shape(open_page) -> None:
    page = open_page("plain", "shape.html#id=")
    assert "The address names no shape." in page.locator("main").inner_text()


def test_values_of_columns_are_missed(open_page) -> None:
    names = {"is.column:place": "Atlantis", "is.column:year": "x", "lacks.column:place": ""}
    page = open_page("museum", f"shapes.html#{urlencode(names)}")
    assert said(page) == "This link names the value “Atlantis”, which is not in this database."


def test_a_range_of_no_numbers_is_told(open_page) -> None:
    page = open_page("museum", "shapes.html#range.column:year=many..2")
    assert said(page) == "This link names the range “many..2”, which this page does not offer."


def test_the_overview_fits_the_window_below_the_line(open_page) -> None:
    page = open_page("workbench", "index.html#hide=dragon&select=ghost")
    drawn_again(page)
    assert box_of(page.locator("#missing"))["height"] > 20
    assert page.evaluate("document.documentElement.scrollHeight") <= 900


def test_a_site_of_one_file_says_it_too(open_page, single_file) -> None:
    address = f"{single_file('workbench').as_uri()}#/workbench?hide=dragon"
    page = open_page("workbench", "workbench.html", address)
    assert "the class “dragon”, which is not in this database" in said(page)
