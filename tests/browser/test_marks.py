"""Marks of very many shapes look the same whether WebGL draws them or not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reports import make_report
from screenshots import pixels_of
from waiting import rested

from shapeviz_report.writing import write_site

LARGE = "figure[data-slot=large] .surface"

WITHOUT_WEBGL = """
const getContext = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, settings) {
  return kind === "webgl2" ? null : getContext.call(this, kind, settings);
};
"""

KIND = """(selector) =>
  document.querySelector(`${selector} canvas.dots`).getContext("webgl2") === null ? "2d" : "webgl2"
"""


def drawn(browser, address, script=None, **options):
    """What is drawn on the map, and by what."""
    context = browser.new_context(viewport={"width": 1440, "height": 900}, reduced_motion="reduce", **options)
    page = context.new_page()
    if script is not None:
        page.add_init_script(script)
    page.goto(address)
    page.wait_for_selector("html[data-ready]", state="attached")
    rested(page, 500)
    picture = pixels_of(page, LARGE)
    kind = page.evaluate(KIND, LARGE)
    context.close()
    return picture, kind


@pytest.mark.parametrize(
    ("view", "options"),
    [
        ("color=class", {}),
        ("color=hit&at=0.1,0.1,6", {"color_scheme": "dark"}),
        # Two levels: what is faint, and what stands out above it.
        (
            "color=class&hide=class+3&select=class000/0004&select=class005/0120&at=0,0,3",
            {"device_scale_factor": 2},
        ),
    ],
)
def test_marks_look_the_same_with_and_without_webgl(browser, site, view, options):
    address = f"{site('large').as_uri()}/index.html#{view}"
    with_webgl, one = drawn(browser, address, **options)
    without, other = drawn(browser, address, WITHOUT_WEBGL, **options)
    assert (one, other) == ("webgl2", "2d")
    differences = np.abs(with_webgl - without).max(axis=2)
    # A middle between two pixels may be rounded up here and down there.
    assert (differences > 24).mean() < 0.0005
    assert differences.mean() < 0.3
    assert with_webgl.std() > 5


@pytest.mark.parametrize("script", [None, WITHOUT_WEBGL], ids=["webgl2", "2d"])
def test_what_nothing_is_known_of_covers_nothing(browser, tmp_path, script):
    """Each shape without a label, whose fit is not known, lies where one with a label does."""
    report = make_report(["ant", "bee", None], 520, methods=("tsne",))
    projection, quality = report.projections["tsne"]
    xy = projection.xy.copy()
    xy[1040:] = xy[:520]
    xy[520:1040] = xy[:520] + 1e-3
    write_site(
        replace(report, projections={"tsne": (replace(projection, xy=xy), quality)}), tmp_path / "site"
    )
    picture, _ = drawn(browser, f"{(tmp_path / 'site').as_uri()}/index.html#color=hit", script)
    marks = picture.min(axis=2) < 200
    coloured = np.ptp(picture, axis=2) > 60
    assert (marks & coloured).sum() > 0.5 * marks.sum()
