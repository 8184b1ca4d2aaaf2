"""The Overview as a reader uses it, with mouse, keys and touch."""

import csv
import json
import re

import numpy as np
import pytest
from screenshots import pixels_of
from waiting import box_of, drawn_again, eventually, rested

LARGE = "figure[data-slot=large] .surface"


def corner(page, selector=LARGE):
    """The upper left corner of a map on the screen, its width and its height."""
    box = box_of(page.locator(selector))
    return box["x"], box["y"], box["width"], box["height"]


def brush(page, left=0.02, top=0.02, right=0.98, bottom=0.9, selector=LARGE):
    """Drag a box over a part of a map, given in shares of its size."""
    x, y, width, height = corner(page, selector)
    page.mouse.move(x + left * width, y + top * height)
    page.mouse.down()
    page.mouse.move(x + right * width, y + bottom * height, steps=5)
    page.mouse.up()


def selected(page) -> int:
    """The number of selected shapes as the tray says it."""
    drawn_again(page)
    head = page.locator("#tray h2")
    return int(re.sub(r"\D", "", head.inner_text())) if head.count() else 0


def pictured(page) -> float:
    """How much of the large map pictures cover, in pixels."""
    return page.locator(f"{LARGE} .pictured").count() * picture_size(page) ** 2


def point(page, key) -> tuple[float, float]:
    """Go to a shape with an arrow key; where it then is on the screen."""
    page.focus(LARGE)
    page.keyboard.press(key)
    page.wait_for_selector(f"{LARGE} .ring.pointed.shown")
    return middle(page)


def middle(page) -> tuple[float, float]:
    """The middle of the ring about the shape pointed at."""
    ring = box_of(page.locator(f"{LARGE} .ring.pointed"))
    return ring["x"] + ring["width"] / 2, ring["y"] + ring["height"] / 2


def places_on_the_way(page, method) -> list[float]:
    """Where the opened shape is, from left, in all frames in which it moves while the projection changes."""
    return page.evaluate(
        """async ([ring, method]) => {
            const node = document.querySelector(ring);
            const places = [];
            const end = performance.now() + 3000;
            [...document.querySelectorAll("#methods label")].find((label) => label.textContent === method).click();
            while (performance.now() < end) {
                const place = Number(node.getAttribute("cx"));
                if (places.at(-1) !== place) places.push(place);
                await new Promise(requestAnimationFrame);
            }
            return places;
        }""",
        [f"{LARGE} .ring.opened", method],
    )


def ink(page, selector) -> float:
    """The share of a place on the screen where something is drawn."""
    picture = pixels_of(page, selector)
    return (np.abs(picture - picture[5, 5]).max(axis=2) > 40).mean()


def picture_size(page) -> float:
    """The size of the pictures on the large map, in pixels."""
    return page.eval_on_selector(
        f"{LARGE} .pictures", "node => parseFloat(node.style.getPropertyValue('--size'))"
    )


def ring(page) -> list[float]:
    """Where the opened shape is on the large map."""
    return page.eval_on_selector(
        f"{LARGE} .ring.opened", "node => [Number(node.getAttribute('cx')), Number(node.getAttribute('cy'))]"
    )


def address(page) -> str:
    return page.evaluate("decodeURIComponent(location.hash)")


def asked(page) -> str:
    """What the page answers who asks how good the map is."""
    page.click("#how-good summary")
    page.wait_for_selector("#bars svg")
    return page.locator("#quality").inner_text()


THREE = "index.html#view=three"


class TestFirstLook:
    def test_the_shapes_themselves_are_seen_first_and_no_chart_is_waited_for(self, open_page):
        page = open_page("plain")
        assert page.evaluate("performance.getEntriesByName('drawn: thumbnail').length") == 1
        assert page.evaluate("window.vega === undefined")
        assert page.evaluate("document.querySelector('#views :checked').value") == "thumbnail"
        places = page.eval_on_selector_all(
            f"{LARGE} .pictured",
            """nodes => nodes.map(node => {
                const { left, top, width } = node.getBoundingClientRect();
                return [left, top, width, getComputedStyle(node).getPropertyValue("--mark")];
            })""",
        )
        assert len(places) > 60
        assert len({color for *_, color in places}) == 12
        for index, (left, top, size, _) in enumerate(places):
            for other_left, other_top, *_ in places[:index]:
                assert np.hypot(left - other_left, top - other_top) > 0.93 * size

    @pytest.mark.parametrize("method", ["umap", "pca"])
    def test_every_class_has_a_picture_on_a_crowded_map(self, open_page, method):
        page = open_page("plain", f"index.html#map={method}")
        page.set_viewport_size({"width": 390, "height": 640})
        colours = (
            "nodes => new Set(nodes.map(node => getComputedStyle(node).getPropertyValue('--mark'))).size"
        )
        eventually(page, lambda: page.eval_on_selector_all(f"{LARGE} .pictured", colours) == 12)

    def test_it_is_told_how_many_shapes_have_no_picture(self, open_page):
        page = open_page("plain")
        page.check("#exact")
        reading = page.locator(f"{LARGE.split()[0]} .reading .shown")

        def told():
            rest = 120 - page.locator(f"{LARGE} .pictured").count()
            return f"pictures of the {rest} dots" in reading.inner_text()

        eventually(page, told)

    def test_exact_places_are_a_toggle_away(self, open_page):
        page = open_page("plain")
        spread = pictured(page)
        page.check("#exact")
        eventually(page, lambda: "exact=" in address(page) and pictured(page) < spread)
        page.uncheck("#exact")
        eventually(page, lambda: "exact=" not in address(page) and pictured(page) == spread)

    def test_pictures_are_larger_when_zoomed(self, open_page):
        page = open_page("plain")
        size = picture_size(page)
        page.keyboard.press("+")
        page.keyboard.press("+")
        eventually(page, lambda: picture_size(page) > 1.4 * size)

    def test_the_three_maps_of_the_paper_are_a_click_away_and_linked(self, open_page):
        page = open_page("plain")
        page.locator("#views label", has_text="All three").click()
        page.wait_for_selector("#bars svg")
        for view in ("thumbnail", "class", "hit"):
            surface = f"figure.linked[data-view={view}] .surface"
            page.wait_for_selector(f"{surface} .chart :is(svg, canvas)")
            eventually(page, lambda surface=surface: ink(page, surface) > 0.005)
            assert box_of(page.locator(surface))["width"] > 400

    def test_where_the_window_is_wide_two_stand_beside_the_one(self, open_page):
        page = open_page("plain", viewport={"width": 1920, "height": 1080})
        assert page.locator("figure.map:visible").count() == 3
        assert box_of(page.locator(LARGE))["width"] > 1000
        page.locator("#views label", has_text="Classes").click()
        page.wait_for_selector("figure.linked[data-view=thumbnail] .chart svg")
        page.set_viewport_size({"width": 1300, "height": 900})
        page.wait_for_selector("figure.linked[data-view=hit]", state="hidden")

    def test_classes_are_named_at_their_places(self, open_page):
        page = open_page("plain")
        names = page.eval_on_selector_all(
            f"{LARGE} .labels text", "nodes => nodes.map(node => node.textContent)"
        )
        assert len(names) >= 10
        boxes = [
            (box["x"], box["y"], box["x"] + box["width"], box["y"] + box["height"])
            for box in (box_of(text) for text in page.locator(f"{LARGE} .labels text").all())
        ]
        for index, (left, top, right, bottom) in enumerate(boxes):
            for other_left, other_top, other_right, other_bottom in boxes[:index]:
                apart = (
                    left >= other_right or other_left >= right or top >= other_bottom or other_top >= bottom
                )
                assert apart

    def test_quality_stands_in_three_decimals_beside_chance(self, open_page, site):
        page = open_page("plain")
        summary = json.loads((site("plain") / "data" / "summary.json").read_text())["projections"]["tsne"]
        text = asked(page)
        assert f"{summary['nh_s']:.3f}" in text
        assert f"{summary['null']['mean']:.3f}" in text

    def test_bars_stand_beside_their_classes_by_falling_value(self, open_page, site):
        page = open_page("plain")
        summary = json.loads((site("plain") / "data" / "summary.json").read_text())["projections"]["tsne"]
        asked(page)
        names = page.locator("#legend .name").all_inner_texts()
        assert names == list(summary["nh_c"])
        values = page.eval_on_selector_all("#bars text", "nodes => nodes.map(node => node.textContent)")
        assert values == [f"{value:.3f}" for value in summary["nh_c"].values()]
        legend = box_of(page.locator("#legend button").nth(5))
        bar = box_of(page.locator("#bars text").nth(5))
        assert abs(legend["y"] + legend["height"] / 2 - bar["y"] - bar["height"] / 2) < 3

    def test_the_page_explains_near_far_and_nh(self, open_page):
        page = open_page("plain")
        assert (
            "close together are alike" in page.locator("figure[data-slot=large] .reading .shown").inner_text()
        )
        assert "nearest neighbours" in asked(page)


class TestColors:
    def test_any_column_colors_the_map_and_stands_in_legend_card_table_and_address(self, open_page):
        page = open_page("museum")
        page.locator("#views label", has_text="Colour by").click()
        page.select_option("#color-by", "column:place")
        lines = page.locator("#color-legend li")
        eventually(page, lambda: lines.locator(".name").all_inner_texts() == ["Delft", "Kyoto", "Münster"])
        assert "color=column%3Aplace" in page.evaluate("location.hash")
        # They are strewn over the map: no place on it is that of one.
        assert page.locator(f"{LARGE} .labels text").count() == 0
        strips = page.locator("#legend .makeup")
        assert strips.count() == 6
        assert page.locator("#legend .swatch").count() == 0
        point(page, "ArrowRight")
        assert "place: " in page.locator("#card").inner_text()
        page.click("#open-tables")
        table = page.locator("#tables table").last
        assert "place" in table.locator("thead").inner_text()
        assert "Kyoto" in table.inner_text()
        page.keyboard.press("Escape")
        lines.locator("button").nth(1).click()
        assert selected(page) == 48
        page.check("#pictures")
        page.wait_for_selector(f"{LARGE} .pictured")
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert lines.count() == 3
        assert page.locator(f"{LARGE} .pictured").count() > 20

    def test_numbers_have_a_ramp_and_what_lacks_one_a_line(self, open_page):
        page = open_page("museum", "index.html#color=column:year")
        assert page.locator(".ramp-texts span").all_inner_texts() == ["1403", "1616", "1829"]
        assert page.locator("#color-legend li").inner_text().split() == ["no", "value", "24"]

    def test_a_bin_is_found_by_its_name(self, open_page):
        page = open_page("workbench")
        page.locator("#views label", has_text="Colour by").click()
        page.select_option("#color-by", "bin:")
        # One is shown at once, and its name is written over by who types.
        eventually(page, lambda: page.evaluate("document.activeElement.id") == "color-search")
        assert page.input_value("#color-search") == page.locator("#color-legend h2").inner_text()
        page.keyboard.type("Sc[1]:4")
        page.wait_for_selector("#color-found li[data-place]")
        page.keyboard.press("Enter")
        eventually(page, lambda: page.locator("#color-legend h2").all_inner_texts() == ["Sc[1]:4"])
        assert "%" in page.locator(".ramp-texts").inner_text()
        assert "share of the surface" in page.locator("#color-legend .note").inner_text()
        eventually(page, lambda: "color=bin:Sc[1]:4" in address(page))
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert page.input_value("#color-search") == "Sc[1]:4"

    def test_a_field_that_is_not_there_is_no_error(self, open_page):
        page = open_page("no labels", "index.html#color=column:gone")
        for color in ("column:gone", "bin:gone", "bin:", "hit", "x" * 5000):
            page.evaluate("(color) => { location.hash = `color=${color}`; }", color)
            drawn_again(page)
            assert page.locator("#views input:checked").get_attribute("value") == "thumbnail"

    def test_colors_go_along_to_the_other_maps_by_the_menu(self, open_page):
        page = open_page("searched", "index.html#color=fact:faces")
        ramp = page.locator(".ramp-texts").inner_text()
        for title, maps in (("Workbench", 2), ("Features", 1)):
            page.locator(".masthead nav a", has_text=title).click()
            page.wait_for_selector("html[data-ready]", state="attached")
            assert page.locator(".ramp-texts").inner_text() == ramp
            assert page.locator("#color-by").input_value() == "fact:faces"
            assert page.locator("#colors input:checked").get_attribute("value") == "color"
            assert page.locator("figure.map[data-view=color]").count() == maps
        page.select_option("#color-by", "bin:")
        page.wait_for_selector("#color-legend .note")
        bin_ = page.input_value("#color-search")
        page.go_back()
        eventually(page, lambda: page.locator("#color-by").input_value() == "fact:faces")
        page.go_forward()
        eventually(page, lambda: page.input_value("#color-search") == bin_)
        page.locator("#colors label", has_text="Fit").click()
        page.wait_for_selector("#color-legend", state="hidden")
        page.locator(".masthead nav a", has_text="Overview").click()
        page.wait_for_selector("figure[data-slot=large][data-view=hit]")

    def test_the_legend_stays_in_view_beside_an_open_shape(self, open_page, reports):
        shape = reports("searched").shapes[0].id
        page = open_page("searched", f"index.html#color=fact:faces&open={shape}")
        for viewport in ((1440, 900), (1700, 900)):
            page.set_viewport_size(dict(zip(("width", "height"), viewport, strict=True)))
            detail = page.locator("#detail")
            detail.wait_for()
            drawn_again(page)
            ramp = page.locator("#color-legend .ramp")
            assert ramp.evaluate(
                """node => {
                    const { left, top, width, height } = node.getBoundingClientRect();
                    return document.elementFromPoint(left + width / 2, top + height / 2) === node;
                }"""
            )
            legend = box_of(page.locator("#color-legend"))
            assert legend["y"] + legend["height"] <= box_of(detail)["y"] + 1


def truth_of(site, method) -> dict:
    """How far a map shows who is like whom, as the site's data says it."""
    return json.loads((site / "data" / "summary.json").read_text())["projections"][method]["faithfulness"]


def shares_of(site, column) -> dict[str, float]:
    """Of every shape, by its name."""
    with (site / "data" / "shapes.csv").open() as lines:
        return {row["name"]: float(row[column]) for row in csv.DictReader(lines)}


def lines(page, kind) -> int:
    """How many lines of a kind lead from a shape on the large map."""
    return page.eval_on_selector(
        f"{LARGE} .ties.{kind}",
        "node => node.classList.contains('shown') ? node.getAttribute('d').split('M').length - 1 : 0",
    )


class TestWhoIsLikeWhom:
    def test_it_is_told_in_words_and_figures_each_beside_chance(self, open_page, site):
        page = open_page("plain", "index.html#map=umap")
        words = re.sub(r"\s+", " ", asked(page))
        truth = truth_of(site("plain"), "umap")
        assert (
            f"{10 * truth['kept']:.1f} of 10 {10 * truth['chance']['kept']:.1f} on a map at random" in words
        )
        for name in ("trustworthiness", "continuity", "stress"):
            row = page.locator(".measures tbody tr", has_text=name.capitalize()).inner_text().split("\t")
            assert row[1:] == [f"{truth[name]:.3f}", f"{truth['chance'][name]:.3f}"]
        few = {
            method: sum(share <= 0.2 for share in shares_of(site("plain"), f"kept:{method}").values())
            for method in ("tsne", "umap", "pca")
        }
        by = {method: count or "none" for method, count in few.items()}
        assert (
            f"In the wrong place are shapes that keep at most two of them: {by['umap']} of 120 on this map, "
            f"{by['tsne']} on the t-SNE map and {by['pca']} on the PCA map."
        ) in words
        assert page.locator("#shepard svg").is_visible()
        assert page.locator("#shepard .cells path").count() == 9

    def test_the_diagram_is_that_of_the_map_in_view(self, open_page):
        page = open_page("plain")
        asked(page)
        before = page.locator("#shepard .fit").get_attribute("points")
        page.click("#methods label:has-text('PCA')")
        eventually(page, lambda: page.locator("#shepard .fit").get_attribute("points") != before)
        assert page.locator("#shepard svg").count() == 1

    @pytest.mark.parametrize(
        ("words", "key", "title"),
        [
            ("neighbours kept", "kept", "Neighbours kept"),
            ("false", "false", "False neighbours"),
            ("missing", "missing", "Missing neighbours"),
        ],
    )
    def test_the_map_is_coloured_a_click_away_by_what_is_in_view(self, open_page, site, words, key, title):
        page = open_page("plain")
        asked(page)
        page.get_by_role("button", name=words, exact=True).click()
        eventually(page, lambda: f"color=map:{key}" in address(page))
        assert page.locator("#color-legend h2").inner_text() == title
        for method, label in (("tsne", "t-SNE"), ("pca", "PCA")):
            page.click(f"#methods label:has-text('{label}')")
            # The shapes take less than a second on their way.
            rested(page, 900)
            point(page, "ArrowRight")
            shares = shares_of(site("plain"), f"{key}:{method}")
            share = 100 * shares[page.locator("#card .name").inner_text()]
            found = re.search(rf"{title}: ([\d.]+)\s%", page.locator("#card").inner_text())
            assert float(found[1]) == pytest.approx(share, abs=0.51 if share >= 9.95 else 0.051)

    def test_lines_lead_to_the_most_alike_near_and_elsewhere(self, open_page, site):
        page = open_page("plain")
        kept = shares_of(site("plain"), "kept:tsne")
        for key in ("ArrowRight", "ArrowDown", "ArrowLeft"):
            point(page, key)
            eventually(page, lambda: "most alike" in page.locator("#card").inner_text())
            near = round(10 * kept[page.locator("#card .name").inner_text()])
            assert (lines(page, "kept"), lines(page, "missing"), lines(page, "false")) == (
                near,
                10 - near,
                10 - near,
            )
            number = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"][
                10 - near
            ]
            said = {
                0: "All of the ten most alike are near it.",
                10: "All of the ten most alike are elsewhere on the map.",
            }
            told = said.get(
                10 - near,
                f"{number.capitalize()} of the ten most alike {'is' if near == 9 else 'are'} elsewhere on the map.",
            )
            assert told in page.locator("#card").inner_text()
        page.uncheck("#lines")
        eventually(page, lambda: "lines=none" in address(page))
        assert lines(page, "kept") == lines(page, "missing") == 0
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert not page.is_checked("#lines")

    def test_an_opened_shape_keeps_its_lines(self, open_page):
        page = open_page("plain")
        point(page, "ArrowRight")
        page.keyboard.press("Enter")
        page.wait_for_selector("#detail h2")
        eventually(page, lambda: lines(page, "kept") + lines(page, "missing") == 10)
        # Beside its neighbours on the map, those that are missing among them.
        eventually(page, lambda: "most alike" in page.locator("#detail").inner_text())
        assert page.locator("#detail .elsewhere .shape").count() == lines(page, "missing")
        page.evaluate("document.activeElement.blur()")
        page.mouse.move(5, 5)
        eventually(page, lambda: lines(page, "kept") + lines(page, "missing") == 10)
        page.uncheck("#lines")
        eventually(page, lambda: lines(page, "near") == 10)

    def test_without_labels_it_is_told_all_the_same(self, open_page):
        page = open_page("searched without labels", "index.html")
        page.click("#how-good summary")
        assert "Does it show who is like whom?" in page.locator("#quality").inner_text()
        assert page.locator("#shepard svg").is_visible()


class TestPointing:
    def test_hover_shows_picture_name_class_and_neighbours(self, open_page):
        page = open_page("plain")
        point(page, "ArrowRight")
        card = page.locator("#card")
        assert card.is_visible()
        text = card.inner_text()
        assert re.search(r"kind [a-l] \d", text)
        assert "NH" in text
        assert "near it" in text
        assert page.locator("#card img").evaluate("image => image.complete && image.naturalWidth") == 256

    def test_the_mouse_finds_the_shape_under_it(self, open_page):
        page = open_page("plain")
        x, y = point(page, "ArrowDown")
        name = page.locator("#card .name").inner_text()
        page.mouse.move(5, 5)
        page.evaluate("document.activeElement.blur()")
        assert page.locator("#card").is_hidden()
        page.mouse.move(x, y)
        assert page.locator("#card .name").inner_text() == name

    def test_click_opens_what_is_known_and_neighbours_lead_on(self, open_page):
        page = open_page("plain")
        x, y = point(page, "ArrowLeft")
        page.mouse.click(x, y)
        detail = page.locator("#detail")
        detail.wait_for()
        text = detail.inner_text()
        for expected in (
            "10 nearest neighbours",
            "From the database",
            "N. N.",
            "watertight",
            "of its diagonal",
        ):
            assert expected in text
        first = page.locator("#detail h2").inner_text()
        assert page.locator("#detail .neighbours .shape").count() == 10
        page.locator("#detail .neighbours .shape").first.click()
        page.wait_for_function(
            "first => document.querySelector('#detail h2').textContent !== first", arg=first
        )
        page.keyboard.press("Escape")
        assert detail.is_hidden()

    def test_neighbours_shown_are_those_that_nh_counts(self, open_page, site):
        page = open_page("plain", "index.html#open=class003/0004")
        rows = list(csv.DictReader((site("plain") / "data" / "shapes.csv").open(encoding="utf-8")))
        nh = next(float(row["nh:tsne"]) for row in rows if row["id"] == "class003/0004")
        page.wait_for_selector("#detail .neighbours .shape")
        strangers = page.locator("#detail .neighbours .stranger").count()
        assert nh == pytest.approx(1 - strangers / 10)


class TestSelecting:
    def test_a_box_in_one_map_selects_in_all_and_fills_the_tray(self, open_page):
        page = open_page("plain", THREE)
        surfaces = [f"figure.linked[data-view={view}] .surface" for view in ("class", "hit", "thumbnail")]
        before = {surface: pixels_of(page, surface) for surface in surfaces}
        brush(page, right=0.5, selector=surfaces[0])
        number = selected(page)
        assert 0 < number < 120
        assert page.locator("#tray .shape").count() == number
        for surface, picture in before.items():
            eventually(
                page, lambda surface=surface, old=picture: not np.array_equal(pixels_of(page, surface), old)
            )

    def test_selecting_moves_nothing_on_the_map(self, open_page):
        page = open_page("plain", "index.html#open=class003/0004")
        before = [corner(page), ring(page)]
        brush(page, right=0.4)
        assert selected(page) > 0
        rested(page, 500)
        assert [corner(page), ring(page)] == before

    def test_what_is_faint_stays_faint_where_it_lies_on_each_other(self, open_page):
        # All that is shown is faint: what is selected is of the class that is hidden. Ten shapes of a class lie close.
        page = open_page("plain", "index.html#view=class&select=class003/0004&hide=kind d")
        most = page.evaluate(
            """selector => {
                const canvas = document.querySelector(selector);
                const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
                return data.reduce((most, value, place) => (place % 4 === 3 && value > most ? value : most), 0);
            }""",
            f"{LARGE} canvas.dots",
        )
        assert most == pytest.approx(0.14 * 255, abs=2)

    def test_shift_adds_escape_clears(self, open_page):
        page = open_page("plain")
        brush(page, bottom=0.45)
        upper = selected(page)
        page.keyboard.press("Escape")
        assert selected(page) == 0
        brush(page, top=0.45)
        lower = selected(page)
        page.keyboard.press("Escape")
        drawn_again(page)
        brush(page, bottom=0.45)
        drawn_again(page)
        page.keyboard.down("Shift")
        brush(page, top=0.3)
        page.keyboard.up("Shift")
        assert upper < selected(page)
        assert lower > 0

    def test_exports_hold_the_selection(self, open_page, tmp_path):
        page = open_page("nasty")
        brush(page)
        number = selected(page)
        assert number > 10
        with page.expect_download() as saved:
            page.click("#tray >> text=CSV")
        saved.value.save_as(tmp_path / "selection.csv")
        with (tmp_path / "selection.csv").open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        assert len(rows) == number
        with page.expect_download() as saved:
            page.click("#tray >> text=JSON")
        saved.value.save_as(tmp_path / "selection.json")
        shapes = json.loads((tmp_path / "selection.json").read_text(encoding="utf-8"))["shapes"]
        assert [shape["id"] for shape in shapes] == [row["id"] for row in rows]
        assert [shape["class"] or "" for shape in shapes] == [row["class"] for row in rows]

    def test_the_tray_works_from_the_keyboard(self, open_page):
        page = open_page("plain")
        brush(page)
        drawn_again(page)
        page.locator("#tray .shape").first.focus()
        page.keyboard.press("ArrowRight")
        page.keyboard.press("Enter")
        page.wait_for_selector("#detail:not([hidden])")
        name = page.locator("#tray .shape").nth(1).get_attribute("aria-label")
        assert name.startswith(page.locator("#detail h2").inner_text())

    def test_space_selects_the_shape_at_the_cursor(self, open_page):
        page = open_page("plain")
        point(page, "ArrowRight")
        page.keyboard.press(" ")
        assert selected(page) == 1
        page.keyboard.press(" ")
        assert selected(page) == 0


class TestLegend:
    def test_a_click_hides_a_class_and_shows_it_again(self, open_page):
        page = open_page("plain")
        button = page.locator("#legend button").nth(2)
        name = button.locator(".name").inner_text()
        button.click()
        assert button.get_attribute("aria-pressed") == "false"
        brush(page)
        drawn_again(page)
        assert name not in page.locator("#tray .census").inner_text()
        page.click("#show-all")
        assert button.get_attribute("aria-pressed") == "true"

    def test_a_double_click_shows_one_class_alone(self, open_page):
        page = open_page("plain")
        page.locator("#legend button").nth(3).dblclick()
        assert page.locator("#legend button[aria-pressed=true]").count() == 1
        brush(page)
        assert selected(page) == 10
        page.locator("#legend button").nth(3).dblclick()
        assert page.locator("#legend button[aria-pressed=true]").count() == 12

    def test_it_works_from_the_keyboard(self, open_page):
        page = open_page("plain")
        page.locator("#legend button").first.focus()
        page.keyboard.press("Enter")
        assert page.locator("#legend button").first.get_attribute("aria-pressed") == "false"


class TestMoving:
    def test_switching_the_projection_moves_the_points_and_the_figures(self, open_page, site):
        page = open_page("plain", "index.html#open=class003/0004", reduced_motion="no-preference")
        projections = json.loads((site("plain") / "data" / "summary.json").read_text())["projections"]
        places = places_on_the_way(page, "UMAP")
        assert len(places) > 2
        assert f"{projections['umap']['nh_s']:.3f}" in page.locator("#quality").text_content()
        with (site("plain") / "data" / "projection-umap.csv").open(encoding="utf-8") as file:
            places_in_file = {row["id"]: float(row["x"]) for row in csv.DictReader(file)}
        _, _, width, _ = corner(page)
        assert (places[-1] > width / 2) == (places_in_file["class003/0004"] > 0)

    @pytest.mark.parametrize("width", [1440, 1100])
    def test_the_map_stays_in_its_place(self, open_page, width):
        page = open_page("plain", viewport={"width": width, "height": 900})
        before = corner(page)
        for method in ("UMAP", "PCA"):
            page.locator("#methods label", has_text=method).click()
            assert corner(page) == before

    def test_who_wants_less_movement_gets_none(self, open_page):
        page = open_page("plain", "index.html#open=class003/0004")
        assert len(places_on_the_way(page, "UMAP")) <= 2

    def test_digits_and_titles_choose_what_the_map_shows(self, open_page):
        page = open_page("plain")
        large = page.locator(LARGE).locator("..")
        for key, view in (("2", "class"), ("3", "hit"), ("4", "color"), ("1", "thumbnail")):
            page.keyboard.press(key)
            eventually(page, lambda view=view: large.get_attribute("data-view") == view)
        page.keyboard.press("5")
        page.click("figure.linked[data-view=class] .promote")
        eventually(page, lambda: large.get_attribute("data-view") == "class")
        assert "color=class" in address(page)

    def test_the_wheel_zooms_all_maps_about_the_pointer(self, open_page):
        page = open_page("plain", "index.html#view=class", viewport={"width": 1920, "height": 1080})
        x, y = point(page, "ArrowRight")
        page.mouse.move(x, y)
        other = pixels_of(page, "figure[data-view=hit] .surface")
        page.mouse.wheel(0, -400)
        eventually(page, lambda: "at=" in address(page))
        assert middle(page) == pytest.approx((x, y), abs=3)
        eventually(page, lambda: not np.array_equal(pixels_of(page, "figure[data-view=hit] .surface"), other))
        page.keyboard.press("0")
        eventually(page, lambda: "at=" not in address(page))

    def test_something_is_in_view_wherever_one_zooms_and_whatever_marks_show(self, open_page):
        page = open_page("plain")
        place = box_of(page.locator(LARGE))
        page.mouse.move(place["x"] + place["width"] * 0.45, place["y"] + place["height"] * 0.55)
        for _ in range(12):
            page.mouse.wheel(0, -300)
        eventually(page, lambda: "at=" in address(page))
        for view in "23412":
            page.keyboard.press(view)
            # Left of the buttons; a single mark has colours enough.
            eventually(page, lambda: np.ptp(pixels_of(page, LARGE)[40:-40, 40:-240].astype(int)) > 60)

    def test_who_zooms_in_on_a_picture_keeps_it(self, open_page):
        page = open_page("plain")
        x, y = point(page, "ArrowRight")
        page.mouse.move(x, y)
        for _ in range(6):
            page.mouse.wheel(0, -200)
        eventually(page, lambda: float(address(page).rpartition(",")[2] or 0) > 8)
        rested(page, 300)
        assert np.hypot(*np.subtract(middle(page), (x, y))) < picture_size(page)

    def test_dragging_moves_the_map_when_asked_to(self, open_page):
        page = open_page("plain")
        page.locator("#drag label", has_text="Move").click()
        page.keyboard.press("+")
        eventually(page, lambda: "at=" in address(page))
        before = address(page)
        brush(page, left=0.5, top=0.5, right=0.6, bottom=0.6)
        assert selected(page) == 0
        eventually(page, lambda: address(page) != before)


class TestAddress:
    def test_a_reload_shows_the_same_view(self, open_page):
        page = open_page("plain")
        page.locator("#methods label", has_text="UMAP").click()
        page.keyboard.press("3")
        page.locator("#legend button").nth(1).click()
        hidden = page.locator("#legend button[aria-pressed=false] .name").inner_text()
        brush(page, right=0.4)
        number = selected(page)
        page.locator("#tray .shape").first.click()
        page.wait_for_selector("#detail:not([hidden])")
        name = page.locator("#detail h2").inner_text()
        eventually(page, lambda: "open=" in address(page))
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert page.locator("#methods input:checked").get_attribute("value") == "umap"
        assert page.locator("figure[data-slot=large]").get_attribute("data-view") == "hit"
        assert page.locator("#legend button[aria-pressed=false] .name").inner_text() == hidden
        assert selected(page) == number
        assert page.locator("#detail h2").inner_text() == name

    def test_an_address_that_no_longer_fits_is_no_error(self, open_page):
        page = open_page("plain", "index.html#map=gone&view=gone&hide=gone&open=gone&select=gone&at=1,b")
        assert page.locator("figure[data-slot=large]").get_attribute("data-view") == "thumbnail"
        assert page.locator("#detail").is_hidden()


class TestSearch:
    def test_it_finds_by_name_and_metadata_and_selects(self, open_page):
        page = open_page("plain")
        page.keyboard.press("/")
        page.keyboard.type("KIND c")
        page.wait_for_selector("#search-select:not([hidden])")
        assert page.locator("#search-select").inner_text() == "Select 120" or selected(page) == 0
        page.fill("#search", "class002 n.")
        eventually(page, lambda: page.locator("#search-select").inner_text() == "Select 10")
        page.click("#search-select")
        assert selected(page) == 10

    def test_it_suggests_shapes_with_pictures_and_enter_opens_and_zooms(self, open_page):
        page = open_page("plain")
        page.keyboard.press("/")
        page.keyboard.type("kind c 7")
        lines = page.locator("#search-found [role=option]")
        # Whose name it is comes before those of whom something else has the words.
        eventually(page, lambda: lines.first.locator("bdi").all_inner_texts() == ["kind c 7", "kind c"])
        assert lines.first.locator("img").evaluate("image => image.complete && image.naturalWidth > 0")
        # The first press of Escape closes the list, the next one takes back the words.
        page.keyboard.press("Escape")
        assert page.locator("#search-found").is_hidden()
        assert page.locator("#search").input_value() == "kind c 7"
        page.fill("#search", "kind c")
        assert all(
            name.startswith("kind c") for name in lines.locator("bdi:first-of-type").all_inner_texts()[:10]
        )
        page.keyboard.press("ArrowDown")
        second = page.locator("#search-found [aria-selected=true] bdi").first.inner_text()
        page.keyboard.press("Enter")
        eventually(page, lambda: page.locator("#detail h2").all_inner_texts() == [second])
        assert page.locator("#search").input_value() == ""
        eventually(page, lambda: "at=" in page.url and "find=" not in page.url)

    def test_a_letter_is_answered_before_the_map_is_marked(self, open_page):
        page = open_page("plain")
        page.focus("#search")
        # What is seen after each letter, by the next frame: the list, and not yet the map.
        told = page.evaluate(
            """async () => {
                const field = document.getElementById("search");
                const told = [];
                for (const text of ["k", "ki", "kin"]) {
                    field.value = text;
                    field.dispatchEvent(new Event("input"));
                    told.push([document.querySelectorAll("#search-found [role=option]").length, location.hash]);
                }
                return told;
            }"""
        )
        assert told == [[12, ""]] * 3
        eventually(page, lambda: "find=kin" in page.url)

    def test_what_arrives_after_a_word_was_typed_is_found_too(self, open_page):
        page = open_page("plain")
        # The details arrive late: their script is added to the page when the test says so.
        page.evaluate(
            """() => {
                const { head } = document;
                head.append = (script) => {
                    window.arrive = () => Element.prototype.append.call(head, script);
                };
            }"""
        )
        page.fill("#search", "class002 n.")
        lines = page.locator("#search-found li")
        eventually(page, lambda: lines.all_inner_texts() == ["searching …"])
        page.evaluate("arrive()")
        page.locator("#search-found [role=option]").first.wait_for()
        assert page.locator("#search-found [role=option]").count() == 10

    def test_nothing_found_is_said(self, open_page):
        page = open_page("plain")
        page.fill("#search", "unicorn")
        page.wait_for_selector("text=none found")


class TestTheme:
    @pytest.mark.parametrize(("scheme", "dark"), [("light", False), ("dark", True)])
    def test_the_system_decides_until_the_reader_does(self, open_page, scheme, dark):
        page = open_page("plain", color_scheme=scheme)
        brightness = pixels_of(page, LARGE)[5, 5].mean()
        assert (brightness < 60) == dark
        page.click("#theme")
        eventually(page, lambda: (pixels_of(page, LARGE)[5, 5].mean() < 60) != dark)
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert (pixels_of(page, LARGE)[5, 5].mean() < 60) != dark


class TestTables:
    def test_every_figure_of_the_charts_is_in_a_table(self, open_page):
        page = open_page("plain")
        page.click("#open-tables")
        classes, shapes = page.locator("#tables table").all()
        assert classes.locator("tbody tr").count() == 12
        assert shapes.locator("tbody tr").count() == 120
        assert re.search(r"\d\.\d{3}", shapes.locator("tbody tr").first.inner_text())
        page.keyboard.press("Escape")
        assert page.locator("#tables").is_hidden()


class TestStates:
    def test_one_shape(self, open_page):
        page = open_page("one shape")
        assert "nothing to compare it with" in page.locator("#quality").text_content()
        x, y, width, height = corner(page)
        page.mouse.click(x + width / 2, y + height / 2)
        page.wait_for_selector("#detail:not([hidden])")

    def test_one_class(self, open_page):
        page = open_page("one class")
        assert "one class" in page.locator("#quality").text_content()

    def test_no_labels(self, open_page):
        page = open_page("no labels")
        assert "no labels" in page.locator("#quality").text_content()
        assert page.locator("#legend button").count() == 0
        picture = pixels_of(page, LARGE)
        assert (np.abs(picture - picture[5, 5]).max(axis=2) > 60).mean() > 0.001
        brush(page)
        assert selected(page) > 10

    def test_many_classes_scroll(self, open_page):
        page = open_page("many classes")
        assert page.locator("#legend button").count() == 45
        scrolls = page.locator(".class-list").evaluate("node => node.scrollHeight > node.clientHeight + 100")
        assert scrolls
        assert page.evaluate("document.documentElement.scrollHeight <= innerHeight")

    def test_labels_are_shown_as_they_are(self, open_page):
        page = open_page("nasty")
        names = page.locator("#legend .name").all_inner_texts()
        assert "</script><img src=x onerror=alert(1)>" in names
        assert "__proto__" in names
        assert "constructor" in names
        assert "no label" in names
        assert page.locator("main img[src=x]").count() == 0
        brush(page)
        page.locator("#tray .shape").first.click()
        page.wait_for_selector("#detail:not([hidden])")

    def test_a_large_database_draws_some_pictures_and_all_points(self, open_page):
        page = open_page("large")
        assert page.locator(f"{LARGE} .pictured").count() > 30
        before = pictured(page)
        page.keyboard.press("+")
        page.keyboard.press("+")
        eventually(page, lambda: pictured(page) > 1.2 * before)
        page.keyboard.press("0")
        brush(page, left=0.01, top=0.01, right=0.99, bottom=0.93)
        eventually(page, lambda: selected(page) > 1000)
        assert page.locator("#tray .shape").count() == 200
        page.locator("#tray .more").click()
        assert page.locator("#tray .shape").count() == 400


PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


class TestPhone:
    def test_it_fits_the_width_and_shows_the_map_first(self, open_page):
        page = open_page("plain", **PHONE)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        _, y, width, height = corner(page)
        assert width > 340
        assert y + height < 844

    def test_search_and_views_stand_above_the_map_in_a_row_each(self, open_page):
        page = open_page("museum", "index.html#view=three", **PHONE)
        views, search = (box_of(page.locator(selector)) for selector in ("#views", "#search"))
        assert views["height"] < 60
        assert search["height"] >= 40
        last = box_of(page.locator("#views label").last)
        # What is shown is seen there.
        assert views["x"] <= last["x"]
        assert last["x"] + last["width"] <= views["x"] + views["width"] + 1
        page = open_page("museum", **PHONE)
        place = box_of(page.locator(LARGE))
        assert box_of(page.locator("#search"))["y"] < place["y"] < 340

    def test_a_tap_opens_a_shape(self, open_page):
        page = open_page("plain", **PHONE)
        x, y = point(page, "ArrowRight")
        page.touchscreen.tap(x, y)
        page.wait_for_selector("#detail:not([hidden])")
        page.locator("#detail >> text=Close").tap()
        assert page.locator("#detail").is_hidden()

    def test_long_names_do_not_widen_it(self, open_page):
        page = open_page("nasty", **PHONE)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390


class TestManyClasses:
    def test_a_class_is_found_in_the_legend_and_shown_alone(self, open_page):
        page = open_page("many classes")
        names = page.locator("#legend .name")
        assert names.count() == 45
        page.fill("#find-class", "CLASS 3")
        numbers = [f"{number:02}" for number in range(45)]
        assert sorted(names.all_inner_texts()) == [f"class {number}" for number in numbers if "3" in number]
        page.fill("#find-class", "class 31")
        page.press("#find-class", "Enter")
        eventually(page, lambda: "hide=" in page.evaluate("location.hash"))
        page.fill("#find-class", "")
        pressed = page.locator("#legend button[aria-pressed=true]")
        assert pressed.locator(".name").all_inner_texts() == ["class 31"]
        page.click("#show-all")
        eventually(page, lambda: pressed.count() == 45)

    def test_what_no_class_is_called_leaves_none_and_breaks_nothing(self, open_page):
        page = open_page("many classes", "index.html#view=hit")
        page.wait_for_selector("#bars svg")
        page.fill("#find-class", "<b>")
        assert page.locator("#legend button").count() == 0
        page.press("#find-class", "Enter")
        page.fill("#find-class", "")
        assert page.locator("#legend button[aria-pressed=true]").count() == 45

    def test_few_classes_need_no_search(self, open_page):
        assert open_page("plain").locator("#find-class").count() == 0


def test_a_map_that_was_brought_along_says_so(open_page):
    page = open_page("own map", "index.html")
    choice = page.locator("#features")
    assert choice.is_visible()
    page.locator("#methods").get_by_text("drawer").click()
    eventually(page, lambda: "map=drawer" in page.url)
    assert not choice.is_visible(), "it is of no features"
    assert "were brought along with the database" in page.locator("body").inner_text()
    page.click("#how-good summary")
    said = page.locator("#quality").inner_text()
    assert "nearest neighbours on this drawer map" in said.replace("\u00a0", " ")
    assert "made from" not in said
    page.locator("#methods").get_by_text("t-SNE").click()
    eventually(page, lambda: choice.is_visible())
