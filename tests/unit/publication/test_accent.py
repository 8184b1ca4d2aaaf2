"""An accent colour can be read on every ground of its theme."""

import re

import pytest

from shapeviz_report.errors import ConfigError
from shapeviz_report.publication.accent import DARK_GROUND, LIGHT_GROUND, contrast, fit_accent
from shapeviz_report.writing.resources import site_folder


def test_contrast_is_that_of_the_guidelines():
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.005)
    assert contrast("#123456", "#123456") == 1


def test_the_grounds_are_the_hardest_of_the_style_sheet():
    tokens = (site_folder() / "styles" / "tokens.css").read_text(encoding="utf-8")
    grounds = re.findall(r"--(?:paper|ground|wash|picture): light-dark\((#\w{6}), (#\w{6})\);", tokens)
    assert len(grounds) == 4
    light, dark = zip(*grounds)
    assert contrast(LIGHT_GROUND, "#000000") == min(contrast(ground, "#000000") for ground in light)
    assert contrast(DARK_GROUND, "#ffffff") == min(contrast(ground, "#ffffff") for ground in dark)


@pytest.mark.parametrize("color", ["#000", "#ffffff", "#ffdd00", "c2185b", "#1f5f99", "#808080", "#00F"])
def test_any_colour_becomes_readable(color):
    accent = fit_accent(color)
    assert contrast(accent.light, LIGHT_GROUND) >= 4.5
    assert contrast(accent.dark, DARK_GROUND) >= 4.5


def test_a_colour_that_can_be_read_is_kept():
    assert fit_accent("#1F5F99").light == "#1f5f99"
    assert fit_accent("#86b8ea").dark == "#86b8ea"


@pytest.mark.parametrize("color", ["red", "#12", "#12345g", "", "#1234567; }"])
def test_what_is_no_colour_is_refused(color):
    with pytest.raises(ConfigError, match="accent must be a colour"):
        fit_accent(color)
