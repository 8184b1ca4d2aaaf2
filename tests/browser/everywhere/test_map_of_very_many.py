"""The map of more shapes than have pictures of their own: it shows, finds and selects what lies at a place."""

from __future__ import annotations

import base64
import io
import re
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
from PIL import Image
from reports import colour_of
from waiting import eventually

SITE = "very many"
LARGE = "figure[data-slot=large] .surface"

PICTURES = """(selector) => {
  const frame = document.querySelector(selector).getBoundingClientRect();
  const found = [...document.querySelectorAll(`${selector} .pictured`)].map((node) => {
    const { left, top, width, height } = node.getBoundingClientRect();
    return [Number(node.dataset.shape), left + width / 2, top + height / 2];
  });
  const inside = ([, x, y]) => x > frame.left && x < frame.right && y > frame.top && y < frame.bottom;
  return found.length > 0 && found.filter(inside);
}"""

POINTED = """(selector) => {
  const ring = document.querySelector(`${selector} .ring.pointed.shown`);
  const card = document.querySelector("#card:not([hidden]) .name");
  return ring && card && [card.textContent, Number(ring.getAttribute("cx")), Number(ring.getAttribute("cy"))];
}"""

FRAME = """(selector) => {
  const { left, top, width, height } = document.querySelector(selector).getBoundingClientRect();
  return [left, top, width, height];
}"""


@pytest.fixture
def report(reports):
    return reports(SITE)


@pytest.fixture
def xy(report):
    return report.projections["tsne"][0].xy


#: Those of one base shape, which lie close together.
CLUMP = slice(4000, 5000)


def close_up(xy, view="") -> str:
    """The Overview as near to a clump of shapes as one can come."""
    x, y = xy[CLUMP].mean(axis=0)
    return f"index.html#at={x:.6f},{y:.6f},40{view}"


def lay(window, report, xy) -> tuple[float, np.ndarray]:
    """Pixels for a unit of the plane, and where its origin is on the map: from the shapes that are pointed at."""
    names = {shape.name: row for row, shape in enumerate(report.shapes)}
    left, top, width, height = window.evaluate(FRAME, LARGE)
    rows, places = [], []
    for across, down in ((0, 0), (14, 3), (-12, 8), (5, -13), (-8, -10)):
        window.point(left + width / 2 + across, top + height / 2 + down)
        window.wait_for_timeout(300)
        name, x, y = window.until(POINTED, LARGE)
        rows.append(names[name])
        places.append((x, -y))
    unknowns = np.zeros((2 * len(rows), 3))
    unknowns[:, 0] = xy[rows].ravel()
    unknowns[::2, 1] = unknowns[1::2, 2] = 1
    found, *_ = np.linalg.lstsq(unknowns, np.ravel(places), rcond=None)
    # Every one of them is where the map of the report has it.
    np.testing.assert_allclose(unknowns @ found, np.ravel(places), atol=0.5)
    return found[0], np.array([found[1], -found[2]])


def screen(xy, scale, origin) -> np.ndarray:
    return origin + scale * xy * (1, -1)


@pytest.mark.parametrize("close", [True, False])
def test_pictures_are_those_of_their_shapes(visit, xy, close):
    window = visit(SITE, close_up(xy) if close else "index.html")
    shown = window.until(PICTURES, LARGE)
    assert len(shown) > 2
    # Some lie over others, and what lies above comes later.
    for place, (row, x, y) in enumerate(shown):
        covered = any(np.hypot(x - left, y - top) < 55 for _, left, top in shown[place + 1 :])
        if not covered:
            # A sheet may come a moment later.
            eventually(window, lambda: off(window, x, y, colour_of(row)) < 16)  # noqa: B023


def off(window, x, y, colour) -> float:
    """How far what is seen at a place is from a colour."""
    around = window.picture()[round(y) - 4 : round(y) + 4, round(x) - 4 : round(x) + 4]
    return np.abs(around.mean(axis=(0, 1)) - colour).max()


def test_the_shape_under_the_pointer_is_the_nearest(visit, report, xy):
    window = visit(SITE, close_up(xy, "&color=class"))
    scale, origin = lay(window, report, xy)
    places = screen(xy, scale, origin)
    names = {shape.name: row for row, shape in enumerate(report.shapes)}
    left, top, *_ = window.evaluate(FRAME, LARGE)
    middle = screen(xy[CLUMP].mean(axis=0), scale, origin)
    for step in ((3, 4), (-9, 7), (12, -6)):
        at = np.round(middle + step)
        window.point(left + at[0], top + at[1])
        window.wait_for_timeout(300)
        name, *_ = window.until(POINTED, LARGE)
        distance = np.hypot(*(places - at).T)
        assert distance[names[name]] < distance.min() + 0.6


def test_a_lasso_selects_what_it_goes_round(visit, report, xy):
    window = visit(SITE, close_up(xy, "&color=class"))
    scale, origin = lay(window, report, xy)
    left, top, *_ = window.evaluate(FRAME, LARGE)
    middle = screen(xy[CLUMP].mean(axis=0), scale, origin)
    # A crescent, whose hollow is outside.
    turns = np.linspace(0.4, 5.9, 24)
    circle = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    way = np.round(np.concatenate([middle + 60 * circle, middle + 12 * circle[::-1]]))
    window.evaluate("() => document.querySelector('#drag input[value=lasso]').click()")
    window.drag([(left + x, top + y) for x, y in way])
    chosen = window.until(
        "() => document.querySelector('#tray.filled h2') && new URLSearchParams(location.hash.slice(1)).get('selected')"
    )
    # As it is drawn: a browser may tell of fewer places than the mouse went to.
    drawn = window.evaluate(
        "(selector) => document.querySelector(selector).getAttribute('d')", f"{LARGE} .brush"
    )
    line = np.array([step.split() for step in drawn.strip("MZ").split("L")], dtype=float)
    assert len(line) > 20
    bits = np.frombuffer(base64.urlsafe_b64decode(chosen.partition(".")[2] + "=="), np.uint8)
    selected = np.unpackbits(bits, bitorder="little")[: len(xy)].astype(bool)
    places = screen(xy, scale, origin)
    expected = inside(line, places)
    near_the_line = distance_to(line, places) < 1
    assert 50 < expected.sum() < 1000
    assert (selected == expected)[~near_the_line].all()


def inside(line, places) -> np.ndarray:
    """Whether a closed line goes round each place, by the angle at which one sees it pass."""
    turned = np.zeros(len(places))
    for (ax, ay), (bx, by) in zip(line, np.roll(line, -1, axis=0)):
        one = np.arctan2(ay - places[:, 1], ax - places[:, 0])
        other = np.arctan2(by - places[:, 1], bx - places[:, 0])
        turned += (other - one + np.pi) % (2 * np.pi) - np.pi
    return np.abs(turned) > np.pi


def distance_to(line, places) -> np.ndarray:
    """Of each place to a closed line."""
    nearest = np.full(len(places), np.inf)
    for start, end in zip(line, np.roll(line, -1, axis=0)):
        way = end - start
        along = np.clip((places - start) @ way / max(way @ way, 1e-9), 0, 1)
        nearest = np.minimum(nearest, np.hypot(*(places - start - along[:, None] * way).T))
    return nearest


def test_an_address_holds_the_selection(visit, report, xy):
    window = visit(SITE, "index.html")
    left, top, width, height = window.evaluate(FRAME, LARGE)
    window.drag(
        [(left + 4, top + 4), (left + width / 3, top + height / 3), (left + width - 4, top + height - 4)]
    )
    window.until("() => document.querySelector('#tray.filled h2')")
    assert window.text("#tray h2") == "12\u202f000 shapes selected"
    assert "selected" in parse_qs(urlsplit(window.evaluate("() => location.href")).fragment)


def test_a_saved_map_holds_its_marks_as_one_image(visit):
    window = visit(SITE, "index.html#color=class")
    window.evaluate(
        """() => {
            window.saved = null;
            const create = URL.createObjectURL;
            URL.createObjectURL = (blob) => {
                if (blob.type === "image/svg+xml") blob.text().then((text) => (window.saved = text));
                return create.call(URL, blob);
            };
            document.querySelector("figure[data-slot=large] .save-figure button").click();
        }"""
    )
    text = window.until("() => window.saved")
    [image] = re.findall(r"data:image/png;base64,([^\"]+)", text)
    with Image.open(io.BytesIO(base64.b64decode(image))) as marks:
        drawn = np.asarray(marks.convert("RGBA"))
    # Of the two classes and of those without one.
    opaque = drawn[drawn[..., 3] > 200][:, :3]
    _, counts = np.unique(opaque // 16, axis=0, return_counts=True)
    assert (counts > 10).sum() >= 3
    assert text.count("<path") < 100
