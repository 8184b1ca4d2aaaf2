"""What strangers put into an address, and into the files that pages save."""

import csv
import io
from pathlib import Path

import pytest
from waiting import box_of, drawn_again, eventually

from shapeviz_report.cells import write_cell
from shapeviz_report.writing.joiner import join

NUMBERS = ("1e308", "-1e308", "0", "-1", "1e-308", "1.5", "0x10", "")
"""For each parameter that a page reads as a number, or as a place among others; ``tests/js/addresses.test.js`` holds
that what is no number there is passed over."""

PARAMETERS = {
    "index.html": ["at={0},{0},{0}", "at=0,0,{0}", "at={0},{0},2", "at={0}"],
    "features.html": ["s={0}"],
    "workbench.html": ["bins=PFH[{0}]:{0}-{0}", "bins=Gc:{0}-{0}", "features={0}"],
    "bins.html": ["step={0}", "size={0}", "bin=PFH[{0}]:{0}&id={0}"],
    "shapes.html": [
        "size={0}",
        "range.faces={0}..{0}",
        "range.faces={0}..1",
        "range.area=1..{0}",
        "at={0}&sort={0}",
    ],
    "shape.html": ["id={0}&parts=PFH[{0}]&bin=PFH[{0}]:{0}", "bins=PFH:{0}&map={0}"],
    "compare.html": ["a=class:{0}&b=cluster:{0}&bin={0}", "view={0}&row={0}&column={0}&of={0}"],
}
LONG = [
    "&".join(f"select=nobody{n}" for n in range(5000)),
    "selected=abc." + "_" * 50_000,
    "selected=." + "A" * 50_000,
    "find=" + "(" * 20_000,
    "hide=" + "x" * 20_000,
    "&".join("closed=x&hide=y&class=z&lacks.faces=&is.class=w" for _ in range(2000)),
    "&".join(["at=1e308,1e308,1e308"] * 1000),
    "%F0%9F&%&=&&==&a-select=%ff&select",
]


@pytest.mark.parametrize("file", PARAMETERS)
def test_a_page_can_be_used_whatever_its_address_says(open_page, file) -> None:
    name = "bins" if file == "bins.html" else "workbench"
    page = open_page(name, f"{file}#{PARAMETERS[file][0].format('1e308')}")
    for address in [*(parameter.format(n) for parameter in PARAMETERS[file] for n in NUMBERS), *LONG]:
        page.evaluate("(address) => { location.hash = address; }", address)
        drawn_again(page)
    page.evaluate("location.hash = 'select=class001/0002'")
    eventually(page, lambda: page.locator("#tray h2").is_visible())
    assert open_page(name, f"{file}#{LONG[0]}").locator("h1").is_visible()


@pytest.mark.parametrize("at", ["1e308,-1e308,1", "0,0,-1e308", "0,0,0", "1e308,0,1e-300", "NaN,0,1"])
def test_some_of_a_map_is_in_view_wherever_the_address_looks(open_page, at) -> None:
    page = open_page("workbench", f"index.html#at={at}")
    place = box_of(page.locator("figure[data-slot=large] .surface"))
    page.mouse.move(place["x"] + 5, place["y"] + 5)
    page.mouse.down()
    page.mouse.move(place["x"] + place["width"] - 5, place["y"] + place["height"] - 5, steps=4)
    page.mouse.up()
    eventually(page, lambda: page.locator("#tray h2").is_visible())


def test_csv_of_a_page_holds_no_formulas(open_page) -> None:
    page = open_page("workbench", "about.html")
    page.evaluate(join(Path(__file__).with_name("cells.js")))
    texts = ["=1+1", "+A", "-2+3", "@SUM(1)", "\t=1", "\r=1", "'=1", "\uff1d1", "-5", "-.5e3", "it's", "a=b"]
    written = page.evaluate("(rows) => csvText(rows)", [texts, [-0.5, 2, -1e-7]])
    first, second = csv.reader(io.StringIO(written, newline=""))
    assert first == [write_cell(text) for text in texts]
    assert second == ["-0.5", "2", "-1e-7"]
