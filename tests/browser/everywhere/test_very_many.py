"""A site of more shapes than there may be files: pictures and facts come in parts, and are those of the right shape."""

from __future__ import annotations

import base64
import re
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest
from reports import colour_of

SITE = "very many"

#: Of every picture in sight, the row of its shape and the colour in its middle; nothing while one is missing.
COLOURS = """(selector) => {
  const images = [...document.querySelectorAll(selector)].filter((image) => {
    const { top, bottom } = image.getBoundingClientRect();
    return bottom > 0 && top < innerHeight;
  });
  if (images.length === 0 || images.some((image) => !image.complete || image.naturalWidth === 0)) return null;
  return images.map((image) => {
    const canvas = document.createElement("canvas");
    const pen = canvas.getContext("2d");
    pen.drawImage(image, 0, 0, 8, 8);
    return [Number(image.dataset.picture), [...pen.getImageData(4, 4, 1, 1).data.slice(0, 3)]];
  });
}"""

FIRST_CELL = """(name) => {
  const cell = document.querySelector("#grid .cell");
  return cell?.querySelector(".name").textContent === name && Number(cell.dataset.row);
}"""


@pytest.fixture
def report(reports):
    return reports(SITE)


def search(window, text):
    window.evaluate(
        """(text) => {
            const field = document.querySelector("#search");
            field.value = text;
            field.dispatchEvent(new InputEvent("input", { bubbles: true }));
        }""",
        text,
    )


def test_pictures_are_those_of_their_shapes(visit, report):
    window = visit(SITE, "shapes.html")
    for place in (0, 0.4, 0.99):
        window.evaluate(
            """(place) => {
                const frame = document.querySelector('#scroller');
                frame.scrollTop = place * frame.scrollHeight;
            }""",
            place,
        )
        shown = window.until(COLOURS, "#grid img")
        assert len(shown) > 10
        assert all(tuple(colour) == colour_of(row) for row, colour in shown)
    # The last class is seen, not the first once more.
    assert report.labels[shown[-1][0]] != report.labels[0]


def test_a_search_finds_the_one_that_is_meant(visit, report):
    window = visit(SITE, "shapes.html")
    row = next(row for row, shape in enumerate(report.shapes) if shape.name == "cup 2 number 777")
    search(window, "number 0002-00777 CUP")
    assert window.until(FIRST_CELL, report.shapes[row].name) == row
    assert window.until(COLOURS, "#grid img")[0] == [row, list(colour_of(row))]


def test_a_shape_is_told_and_shown(visit, report):
    row = 7_654
    shape, facts = report.shapes[row], report.facts[row]
    window = visit(SITE, f"shape.html#id={shape.id}")
    told = window.until(
        "() => document.querySelector('#facts dl') && document.querySelector('#facts').innerText"
    )
    assert shape.id in told
    assert f"{facts.faces_read:,}".replace(",", "\u202f") in told
    assert window.until(COLOURS, "#stage img") == [[row, list(colour_of(row))]]
    near = window.until(COLOURS, "#neighbours img")
    assert len(near) == 10
    assert all(tuple(colour) == colour_of(other) for other, colour in near)


def test_a_host_may_call_all_scripts_utf8(visit, serve, heard_site):
    address = serve(Path(url2pathname(urlsplit(heard_site(SITE)).path)), "shapes")
    window = visit(SITE, "shapes.html", f"{address}/shapes.html")
    shown = window.until(COLOURS, "#grid img")
    assert all(tuple(colour) == colour_of(row) for row, colour in shown)


def test_a_saved_figure_holds_the_picture(visit, report):
    row = 11_999
    window = visit(SITE, f"shape.html#id={report.shapes[row].id}")
    window.until(COLOURS, "#neighbours img")
    near = window.evaluate(
        "() => [...document.querySelectorAll('#neighbours img')].map((i) => Number(i.dataset.picture))"
    )
    window.evaluate(
        """() => {
            window.saved = null;
            const create = URL.createObjectURL;
            URL.createObjectURL = (blob) => {
                if (blob.type === "image/svg+xml") blob.text().then((text) => (window.saved = text));
                return create.call(URL, blob);
            };
            const figure = document.querySelector("[data-figure='Its place on the map']");
            figure.querySelector(".save-figure button").click();
        }"""
    )
    text = window.until("() => window.saved")
    held = {base64.b64decode(content) for content in re.findall(r"data:image/webp;base64,([^\"]+)", text)}
    assert held >= {report.thumbnails[other] for other in near}


def test_similar_shapes_are_found_part_by_part(visit, report):
    row = 7_654
    window = visit(SITE, f"shape.html#id={report.shapes[row].id}&features=Sc")
    window.evaluate("() => document.querySelector('#by-features').scrollIntoView()")
    found = window.until(
        """() => {
            const images = [...document.querySelectorAll("#similar-list .similar img")];
            return images.length === 12 && images.map((image) => Number(image.dataset.picture));
        }"""
    )
    # As many rows are the same again.
    assert {other // 1000 for other in found} == {row // 1000}


def test_groups_are_compared_by_parts(visit, report):
    window = visit(SITE, "compare.html#a=class:ant&b=class:cup")
    told = window.until(
        "() => !document.querySelector('#result').hidden && document.querySelector('#answer h2').textContent"
    )
    assert "different" in told.lower()


def test_the_folder_has_few_files(site):
    folder = site(SITE)
    assert sum(path.is_file() for path in folder.rglob("*")) < 1_200
    assert not (folder / "thumbnails").exists()
