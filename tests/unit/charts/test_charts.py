"""The charts, drawn by Vega-Lite itself: what a reader would see."""

import io
import json
import re

import numpy as np
import pytest
import vl_convert
from PIL import Image

from shapeviz_report.charts import LIGHT, specs, theme_config

ROWS = [
    {"index": 0, "group": 0, "x": [-0.5, 0.5], "y": [0.5, 0.5], "hit": [1.0, 0.0], "picture": "a.webp"},
    {"index": 1, "group": 1, "x": [0.5, 0.5], "y": [0.5, -0.5], "hit": [0.0, 1.0], "picture": "b.webp"},
    {"index": 2, "group": -1, "x": [0.0, -0.5], "y": [-0.5, 0.0], "hit": [None, None], "picture": "c.webp"},
]


def spec(chart, name, rows, class_count=2, **parameters) -> dict:
    """The chart as JSON with data, the light theme, and some of its parameters set."""
    value = chart.to_dict()
    value["datasets"] = {name: rows}
    value["config"] = {**theme_config(LIGHT, class_count), **value["config"]}
    for parameter in value.get("params", []):
        parameter["value"] = parameters.pop(parameter["name"], parameter["value"])
    assert not parameters, "a parameter that the chart does not have"
    return value


def pixels(chart, rows=ROWS, **parameters) -> np.ndarray:
    """The map as an image: 600 x 600, white ground, as opaque as a page."""
    settings = {"emphasis": [2, 2, 2], "mark_size": 900, "unlabelled": LIGHT.unlabelled, **parameters}
    page = {**spec(chart, "shapes", rows, **settings), "background": "white"}
    png = vl_convert.vegalite_to_png(json.dumps(page))
    image = Image.open(io.BytesIO(png)).convert("RGBA")
    white = Image.new("RGBA", image.size, "white")
    return np.asarray(Image.alpha_composite(white, image).convert("RGB"))


def color_at(image: np.ndarray, x: float, y: float) -> str:
    """The colour of a map at a place in its plane."""
    size = len(image)
    red, green, blue = image[round((1 - y) / 2 * size), round((1 + x) / 2 * size)]
    return f"#{red:02x}{green:02x}{blue:02x}"


def near(one: str, other: str) -> bool:
    """Equal up to the slight transparency of the marks."""
    parts = [[int(color[i : i + 2], 16) for i in (1, 3, 5)] for color in (one, other)]
    return max(abs(a - b) for a, b in zip(*parts, strict=True)) < 30


@pytest.mark.slow
def test_class_map_colors_shapes_by_class():
    image = pixels(specs.class_map(2))
    assert near(color_at(image, -0.5, 0.5), LIGHT.classes[0])
    assert near(color_at(image, 0.5, 0.5), LIGHT.classes[1])
    assert near(color_at(image, 0.0, -0.5), LIGHT.unlabelled)


def test_hit_map_runs_from_red_to_yellow_and_leaves_the_unlabelled_grey():
    image = pixels(specs.hit_map())
    assert near(color_at(image, -0.5, 0.5), LIGHT.hit[-1])
    assert near(color_at(image, 0.5, 0.5), LIGHT.hit[0])
    assert near(color_at(image, 0.0, -0.5), LIGHT.unlabelled)


def test_maps_move_between_projections():
    chart = specs.class_map(2)
    half = pixels(chart, origin=0, target=1, progress=0.5)
    assert near(color_at(half, 0.0, 0.5), LIGHT.classes[0])
    assert near(color_at(half, 0.5, 0.0), LIGHT.classes[1])
    done = pixels(chart, origin=0, target=1, progress=1)
    assert near(color_at(done, 0.5, -0.5), LIGHT.classes[1])


def test_hit_is_that_of_the_projection_moved_to():
    image = pixels(specs.hit_map(), origin=0, target=1, progress=1)
    assert near(color_at(image, 0.5, 0.5), LIGHT.hit[0])
    assert near(color_at(image, 0.5, -0.5), LIGHT.hit[-1])


def test_domains_choose_the_part_in_view():
    image = pixels(specs.class_map(2), x_domain=[-1, 0], y_domain=[0, 1])
    assert near(color_at(image, 0.0, 0.0), LIGHT.classes[0])


def test_emphasis_hides_and_fades():
    image = pixels(specs.class_map(2), emphasis=[0, 1, 3])
    assert color_at(image, -0.5, 0.5) == "#ffffff"
    faint = color_at(image, 0.5, 0.5)
    assert faint != "#ffffff"
    assert not near(faint, LIGHT.classes[1])
    assert near(color_at(image, 0.0, -0.5), LIGHT.unlabelled)


def test_what_lies_on_each_other_is_as_faint_as_one():
    row = {"group": 0, "x": [0.0, 0.0], "y": [0.0, 0.0], "hit": [1.0, 1.0], "picture": "a.webp"}
    one, three = (
        color_at(
            pixels(specs.class_map(2), rows=[row | {"index": i} for i in range(n)], emphasis=[1] * n), 0, 0
        )
        for n in (1, 3)
    )
    assert near(one, three)
    assert one != "#ffffff"


@pytest.mark.parametrize("class_count", [0, 1, 45])
def test_class_map_is_valid_for_any_number_of_classes(class_count):
    chart = specs.class_map(class_count)
    svg = vl_convert.vegalite_to_svg(json.dumps(spec(chart, "shapes", ROWS, class_count, emphasis=[2, 2, 2])))
    assert "<svg" in svg


def test_thumbnail_map_draws_pictures_where_asked_and_dots_elsewhere():
    value = spec(
        specs.thumbnail_map(),
        "shapes",
        ROWS,
        emphasis=[2, 2, 0],
        pictured=[True, False, True],
        picture_size=50,
    )
    vega = vl_convert.vegalite_to_vega(json.dumps(value))
    marks = {mark["type"] for mark in vega["marks"]}
    # The rectangle is what makes marks faint.
    assert marks == {"symbol", "image", "rect"}
    svg = vl_convert.vegalite_to_svg(json.dumps(value), allowed_base_urls=[])
    assert len(re.findall(r"<image", svg)) == 1
    assert len(re.findall(r'aria-roledescription="circle"', svg)) == 1


def test_bars_show_three_decimals_and_a_dash_for_no_value():
    rows = [
        {"row": 0, "hit": 0.98765, "present": True},
        {"row": 1, "hit": 0.0, "present": False},
        {"row": 2, "hit": None, "present": True},
    ]
    svg = vl_convert.vegalite_to_svg(json.dumps(spec(specs.class_bars(), "classes", rows, chance=0.07)))
    texts = re.findall(r"<text[^>]*>([^<]*)</text>", svg)
    assert texts == ["0.988", "0.000", "–"]
    assert svg.count('aria-roledescription="rule mark"') + svg.count('"rule"') >= 1


def test_bars_have_no_rule_without_a_chance_value():
    rows = [{"row": 0, "hit": 0.5, "present": True}]
    with_rule = vl_convert.vegalite_to_svg(json.dumps(spec(specs.class_bars(), "classes", rows, chance=0.1)))
    without = vl_convert.vegalite_to_svg(json.dumps(spec(specs.class_bars(), "classes", rows, chance=-1)))
    assert with_rule.count("<line") == without.count("<line") + 1


def sized(chart, name, data, **parameters) -> np.ndarray:
    """A chart of subsets as an image of 600 x 200 pixels on white."""
    png = vl_convert.vegalite_to_png(json.dumps(spec(chart, name, data, **parameters)))
    image = Image.open(io.BytesIO(png)).convert("RGBA")
    assert image.size == (600, 200)
    return np.asarray(Image.alpha_composite(Image.new("RGBA", image.size, "white"), image).convert("RGB"))


def color_of(image: np.ndarray, x: int, y: int) -> str:
    return "#{:02x}{:02x}{:02x}".format(*image[y, x])


def test_subset_bars_are_as_high_as_their_hit_and_single_features_have_their_color():
    rows = [
        {"place": 0, "hit": 0.75, "feature": -1},
        {"place": 1, "hit": 0.5, "feature": 0},
        {"place": 2, "hit": 0.25, "feature": 1},
    ]
    image = sized(specs.subset_bars(), "subsets", rows, count=3, fill=1, bar=LIGHT.bar)
    filled = (image != 255).any(axis=2)
    assert [filled[:, x].sum() for x in (100, 300, 500)] == pytest.approx([150, 100, 50], abs=1)
    expected = [LIGHT.bar, LIGHT.features[0], LIGHT.features[1]]
    assert [color_of(image, x, 190) for x in (100, 300, 500)] == expected


def test_the_matrix_has_a_cell_where_a_subset_has_a_feature():
    def row(feature, left, top):
        corners = [[left, top], [left + 300, top], [left + 300, top + 100], [left, top + 100]]
        return {
            "type": "Feature",
            "feature": feature,
            "geometry": {"type": "MultiPolygon", "coordinates": [[[*corners, corners[0]]]]},
        }

    image = sized(specs.feature_matrix(), "rows", [row(3, 0, 0), row(len(LIGHT.features) - 1, 300, 100)])
    assert color_of(image, 150, 50) == LIGHT.features[3]
    assert color_of(image, 450, 150) == LIGHT.features[-1]
    assert color_of(image, 450, 50) == color_of(image, 150, 150) == "#ffffff"


def test_boxes_stand_where_their_quartiles_are():
    rows = [{"row": 0, "least": 0.1, "lower": 0.4, "median": 0.5, "upper": 0.6, "most": 0.9, "hit": 0.8}]
    image = sized(specs.class_boxes(), "classes", rows, bar="#ff0000", ink="#000000", accent="#0000ff")
    red = (image == [255, 0, 0]).all(axis=2).any(axis=0).nonzero()[0]
    assert (red.min(), red.max()) == pytest.approx((243, 357), abs=2)
    blue = (image == [0, 0, 255]).all(axis=2).any(axis=0).nonzero()[0]
    assert blue.mean() == pytest.approx(470, abs=2)


def test_effects_and_seeds_name_their_rows_in_the_given_order():
    effects = [
        {"name": "Sc", "feature": 1, "alone": 0.5, "with": 0.8, "without": 0.7},
        {"name": "Gc", "feature": 0, "alone": 0.4, "with": None, "without": None},
    ]
    svg = vl_convert.vegalite_to_svg(json.dumps(spec(specs.effect_dots(), "effects", effects)))
    texts = re.findall(r"<text[^>]*>([^<]*)</text>", svg)
    assert [text for text in texts if text in ("Sc", "Gc")] == ["Sc", "Gc"]
    assert svg.count('aria-roledescription="point"') == 2
    common = {"mean": 0.81, "low": 0.8, "high": 0.82, "best": 0.81, "apart": False}
    seeds = [{"name": name, "hit": hit, **common} for name in ("Sc", "Gc") for hit in (0.8, 0.82)]
    svg = vl_convert.vegalite_to_svg(json.dumps(spec(specs.seed_dots(), "seeds", seeds)))
    assert svg.count('aria-roledescription="point"') == 4 + 2


@pytest.mark.slow
def test_vendored_vega_is_what_its_readme_says_and_fits_altair():
    """Altair writes specifications for one version of Vega-Lite; the vendored one must be of that line."""
    import altair

    from shapeviz_report.writing.resources import site_folder

    vendor = site_folder() / "vendor"
    parts = (vendor / "parts.js").read_text(encoding="utf-8")
    assert (vendor / "vega.js").read_text(encoding="utf-8") == vl_convert.javascript_bundle(parts)
    readme = (vendor / "README.md").read_text(encoding="utf-8")
    major, minor = altair.SCHEMA_VERSION.removeprefix("v").split(".")[:2]
    assert f"Vega-Lite {major}.{minor}" in readme
