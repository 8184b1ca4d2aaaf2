"""The colours must be told apart: from the ground, from each other, and by readers with a colour-vision deficiency."""

import itertools

import numpy as np
import pytest

from shapeviz_report.charts.palette import (
    PLAIN_CLASSES,
    SYMBOLS,
    THEMES,
    Theme,
    class_color_indices,
    class_symbol_indices,
)

# Machado, Oliveira and Fernandes 2009, severity 1, on linear RGB.
DEFICIENCIES = {
    "protanopia": [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    "deuteranopia": [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    "tritanopia": [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
}


def linear(colors: tuple[str, ...]) -> np.ndarray:
    values = np.array([[int(color[i : i + 2], 16) for i in (1, 3, 5)] for color in colors]) / 255
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def oklab(rgb: np.ndarray) -> np.ndarray:
    """Ottosson 2020: a space in which distances are about those one sees."""
    to_cones = [[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566]]
    to_cones.append([0.0883024619, 0.2817188376, 0.6299787005])
    to_lab = [[0.2104542553, 0.7936177850, -0.0040720468], [1.9779984951, -2.4285922050, 0.4505937099]]
    to_lab.append([0.0259040371, 0.7827717662, -0.8086757660])
    return np.cbrt(rgb @ np.transpose(to_cones)) @ np.transpose(to_lab)


def seen(theme: Theme, deficiency: str | None = None, kind: str = "classes") -> np.ndarray:
    rgb = linear(getattr(theme, kind))
    if deficiency is not None:
        rgb = np.clip(rgb @ np.transpose(DEFICIENCIES[deficiency]), 0, 1)
    return oklab(rgb)


def contrast(colors: tuple[str, ...], ground: str) -> np.ndarray:
    luminance = linear(colors) @ [0.2126, 0.7152, 0.0722]
    other = (linear((ground,)) @ [0.2126, 0.7152, 0.0722])[0]
    return (np.maximum(luminance, other) + 0.05) / (np.minimum(luminance, other) + 0.05)


@pytest.mark.parametrize("theme", THEMES, ids=lambda theme: theme.name)
class TestTheme:
    def test_every_class_color_stands_out_from_the_ground(self, theme):
        assert contrast((*theme.classes, theme.unlabelled), theme.ground).min() >= 2.2

    def test_all_class_colors_differ(self, theme):
        lab = seen(theme)
        for one, other in itertools.combinations(lab, 2):
            assert np.linalg.norm(one - other) >= 0.055

    @pytest.mark.parametrize("deficiency", [None, *DEFICIENCIES])
    @pytest.mark.parametrize(
        ("count", "least"), [(8, 0.06), (10, 0.085), (20, 0.085), (45, 0.065), (50, 0.055)]
    )
    def test_classes_that_share_a_symbol_differ_in_color(self, theme, deficiency, count, least):
        lab = seen(theme, deficiency)[list(class_color_indices(count))]
        symbols = class_symbol_indices(count)
        for one, other in itertools.combinations(range(count), 2):
            if symbols[one] == symbols[other]:
                assert np.linalg.norm(lab[one] - lab[other]) >= least

    def test_every_feature_color_stands_out_from_the_ground(self, theme):
        assert contrast(theme.features, theme.ground).min() >= 2.2

    @pytest.mark.parametrize("deficiency", [None, *DEFICIENCIES])
    def test_feature_colors_need_no_symbol(self, theme, deficiency):
        lab = seen(theme, deficiency, "features")
        for one, other in itertools.combinations(lab, 2):
            assert np.linalg.norm(one - other) >= 0.07

    def test_neighbourhood_hit_rises_evenly_from_red_to_yellow(self, theme):
        lab = oklab(linear(theme.hit))
        lightness = lab[:, 0]
        steps = np.linalg.norm(np.diff(lab, axis=0), axis=1)
        hue = np.degrees(np.arctan2(lab[:, 2], lab[:, 1]))
        assert (np.diff(lightness) > 0.05).all()
        assert steps.max() < 1.3 * steps.min()
        assert hue[0] < 35
        assert 95 < hue[-1] < 110


@pytest.mark.parametrize("kind", ["classes", "features"])
def test_themes_give_a_class_and_a_feature_the_same_hue(kind):
    light, dark = (seen(theme, kind=kind) for theme in THEMES)
    turn = np.degrees(np.arctan2(light[:, 2], light[:, 1]) - np.arctan2(dark[:, 2], dark[:, 1]))
    assert np.abs((turn + 180) % 360 - 180).max() < 12


def test_few_classes_are_all_circles():
    assert set(class_symbol_indices(PLAIN_CLASSES)) == {0}


def test_a_hundred_classes_have_a_mark_of_their_own():
    count = 100
    marks = set(zip(class_color_indices(count), class_symbol_indices(count), strict=True))
    assert len(marks) == count


def test_the_first_twenty_classes_have_colors_of_their_own_and_all_symbols_are_used():
    assert class_color_indices(20) == tuple(range(20))
    assert set(class_symbol_indices(20)) == set(range(len(SYMBOLS)))


def test_a_class_keeps_its_mark_when_classes_are_added_behind_it():
    assert class_symbol_indices(30)[:12] == class_symbol_indices(12)
    assert class_color_indices(30)[:12] == class_color_indices(12)
