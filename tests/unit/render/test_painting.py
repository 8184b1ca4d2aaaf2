"""Painted pictures: the right colours in the right places, on an even ramp."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image
from solids import ball

from shapeviz_report.render.painting import mark_colors, render_painted, value_colors
from shapeviz_report.render.ramp import ramp_codes, ramp_colors
from shapeviz_report.render.shading import CLAY
from shapeviz_report.render.thumbnail import render_thumbnail
from shapeviz_report.render.viewpoint import choose_view

EDGES = np.array([0, 1, 2, 4, 8, 16, 32, 64, 128, 256, 512], float)


def picture(colors: np.ndarray) -> np.ndarray:
    mesh = ball()
    (content,) = render_painted(mesh, choose_view(mesh, up="y"), [colors], size=128)
    return np.asarray(Image.open(io.BytesIO(content)), float)


def lightness(linear: np.ndarray) -> np.ndarray:
    """L* of CIE 1976, as an eye other than OKLab's judge."""
    y = linear @ [0.2126, 0.7152, 0.0722]
    return np.where(y > 0.008856, 116 * np.cbrt(y) - 16, 903.3 * y)


def test_the_ramp_rises_evenly_in_lightness():
    steps = np.diff(lightness(ramp_colors(np.linspace(0, 1, 11))))
    assert (steps > 0).all()
    assert steps.max() < 2 * steps.min()


def test_the_ramp_is_written_in_steps_from_end_to_end():
    codes = ramp_codes(10)
    assert len(set(codes)) == 10
    red, blue = (int(codes[0][i : i + 2], 16) for i in (1, 5))
    assert blue > red
    assert int(codes[-1][1:3], 16) > 200


def test_a_bin_takes_a_tenth_of_the_ramp_however_wide_it_is():
    middles = (EDGES[:-1] + EDGES[1:]) / 2
    assert np.allclose(value_colors(middles, EDGES), ramp_colors(np.arange(10) / 10 + 0.05))
    assert np.allclose(value_colors(np.array([-5.0, 1e6]), EDGES), ramp_colors(np.array([0.0, 1.0])))


def test_what_falls_into_the_bin_is_marked_where_it_lies():
    upper = ball().vertices[:, 1] > 0
    shown = picture(mark_colors(upper))
    redness = shown[..., 0] - shown[..., 2]
    # Seen from a little above, the border of the upper half lies below the middle.
    assert redness[20, 64] > 60 > redness[110, 64]


@pytest.mark.parametrize("share", [0.1, 0.9])
def test_a_value_shows_its_colour(share: float):
    expected = ramp_colors(np.array([share]))[0]
    shown = picture(np.tile(expected, (len(ball().vertices), 1)))[50, 50, :3]
    assert np.argmax(shown) == np.argmax(expected)
    assert np.argmin(shown) == np.argmin(expected)


def test_clay_all_over_is_the_thumbnail():
    mesh = ball()
    view = choose_view(mesh)
    painted = render_painted(mesh, view, [np.tile(CLAY, (len(mesh.vertices), 1))] * 2, size=96)
    assert painted[0] == painted[1]
    pictures = (painted[0], render_thumbnail(mesh, view, size=96))
    one, other = (np.asarray(Image.open(io.BytesIO(content)), float) for content in pictures)
    assert np.array_equal(one[..., 3], other[..., 3])
    # Colours on vertices come in steps of 1/255, which the thumbnail's does not; WebP makes the most of that.
    differences = np.abs(one - other)[one[..., 3] == 255]
    assert differences.mean() < 2
    assert differences.max() <= 12
