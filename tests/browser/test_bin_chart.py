"""The Workbench's bars of bins as a reader uses them: by mouse, by keyboard and by touch."""

import base64
import io
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from reports import make_report
from screenshots import pixels_of
from waiting import box_of, drawn_again, eventually, rested

from shapeviz_report.presets import PRESETS, compared_values
from shapeviz_report.scorers import SCORERS, as_one_group, score_separation
from shapeviz_report.writing import write_site
from shapeviz_report.writing.joiner import join

SURFACE = ".bin-plot .surface"
BARS = Path(__file__).parent / "bars.js"
ACCENT = (0x1F, 0x5F, 0x99)
FEATURES = ("Gc", "Sc", "PFH", "FPFH")
CLASSES = ("ant", "bird", "cup", "dog")


@pytest.fixture(scope="module")
def report():
    return make_report(CLASSES, 10, features=FEATURES)


@pytest.fixture(scope="module")
def address(report, tmp_path_factory):
    folder = tmp_path_factory.mktemp("bins") / "site"
    write_site(report, folder)
    return f"{folder.as_uri()}/workbench.html#scorer=anova"


@pytest.fixture(scope="module")
def ranking(report):
    """The bins from best to worst, where every class is to be set apart from the rest by ANOVA's F."""
    anova = next(scorer for scorer in SCORERS if scorer.name == "anova")
    compared = compared_values(report.features, PRESETS["default"])
    contests = [contest for name in CLASSES for contest in as_one_group(report.labels, [name])]
    scores = score_separation(anova, compared, contests)
    order = np.argsort(-scores, kind="stable")
    return [report.features.columns[column] for column in order], scores[order]


@pytest.fixture(scope="module")
def shared(browser, address):
    """One page for all tests that leave it as they found it, or nearly so."""
    page = browser.new_page(viewport={"width": 1440, "height": 900}, reduced_motion="reduce")
    complaints = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(address)
    yield ready(page)
    page.close()
    assert complaints == []


@pytest.fixture
def page(shared):
    """The page with nothing chosen, nothing pointed at and all bars in view."""
    shared.fill("#bin-search", "")
    shared.click("#bin-order >> text=Chosen first")
    shared.locator("#bin-clear").evaluate("button => button.click()")
    shared.click(".bin-zoom >> text=All")
    shared.mouse.move(5, 5)
    assert reading(shared) == "0 of 50 bins chosen"
    heard(shared)
    return shared


def opened(open_page, address, **options):
    """A page of its own, for readers of another kind."""
    return ready(open_page("", "workbench.html", address=address, **options))


def ready(page):
    eventually(page, lambda: page.locator("#bin-add").is_enabled())
    page.evaluate("""() => {
        window.heard = [];
        const live = document.getElementById("live");
        new MutationObserver(() => heard.push(live.textContent)).observe(live, { childList: true });
    }""")
    return page


def reading(page) -> str:
    return re.sub(r"\s+", " ", page.locator(".bin-tools .reading").inner_text())


def heard(page) -> str:
    """All that was announced since it was last asked for, by other parts of the page too."""
    return "\n".join(page.evaluate("heard.splice(0)"))


def point_on(page, place, count=50) -> tuple[float, float]:
    """The middle of a bar while all are in view."""
    box = box_of(page.locator(SURFACE))
    return box["x"] + (place + 0.5) * min(box["width"] / count, 36), box["y"] + 60


def name_at(page, place) -> str:
    page.mouse.move(*point_on(page, place))
    return reading(page).split()[0]


def drag(page, start, end, selector=SURFACE) -> None:
    """Drag from one share of an element's width to another."""
    box = box_of(page.locator(selector))
    x = [box["x"] + share * box["width"] for share in (start, end)]
    y = box["y"] + box["height"] / 2
    page.mouse.move(x[0], y)
    page.mouse.down()
    page.mouse.move(sum(x) / 2, y)
    page.mouse.move(x[1], y)
    page.mouse.up()


class TestReading:
    def test_a_bar_tells_its_bin_its_rank_and_its_score(self, page, ranking):
        names, scores = ranking
        for place in (0, 3, 49):
            page.mouse.move(*point_on(page, place))
            told = re.fullmatch(r"(\S+) rank (\d+) of 50 score ([\d.]+)", reading(page))
            assert int(told[2]) == place + 1
            assert float(told[3]) == pytest.approx(scores[place], abs=0.001)
            assert told[1] == names[place]
        page.mouse.move(5, 5)
        assert reading(page) == "0 of 50 bins chosen"

    def test_the_card_says_what_a_bin_is_and_which_class_has_much_of_it(self, page, report, ranking):
        names, _ = ranking
        page.mouse.move(*point_on(page, 1))
        card = page.locator(".bin-card")
        column = report.features.columns.index(names[1])
        shares = report.features.values[:, column]
        medians = {
            label: 100 * np.median(shares[np.array(report.labels) == label]) for label in sorted(CLASSES)
        }
        labels = card.locator(".names li").all_inner_texts()
        told = [float(text.removesuffix("\u00a0%")) for text in card.locator(".medians li").all_inner_texts()]
        assert labels == sorted(medians, key=lambda label: -medians[label])
        np.testing.assert_allclose(told, [medians[label] for label in labels], atol=0.6)
        assert "What share of the surface" in card.inner_text()
        assert "rank 2" in card.inner_text()
        box = box_of(card)
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 1440
        page.mouse.move(5, 5)
        assert card.is_hidden()

    def test_the_card_goes_when_a_bar_is_chosen_and_comes_with_another_bar(self, page):
        card = page.locator(".bin-card")
        page.mouse.move(*point_on(page, 7))
        assert card.is_visible()
        page.mouse.click(*point_on(page, 7))
        assert card.is_hidden()
        # The line above the bars still says which it was.
        assert reading(page).endswith("chosen")
        page.mouse.move(*point_on(page, 8))
        assert card.is_visible()

    def test_names_of_chosen_bars_keep_all_their_letters(self, open_page, tmp_path):
        write_site(make_report(CLASSES, 10, features=("MWMWMWMWM", "Gc")), tmp_path / "site")
        page = opened(open_page, f"{(tmp_path / 'site').as_uri()}/workbench.html#scorer=anova")
        page.fill("#bin-number", "20")
        page.click("#bin-add")
        page.mouse.move(5, 5)
        drawn_again(page)
        # Names hang from the bars; one that is cut has ink in the last row.
        address = page.locator(f"{SURFACE} canvas").evaluate("canvas => canvas.toDataURL()")
        alpha = np.asarray(Image.open(io.BytesIO(base64.b64decode(address.split(",")[1]))))[:, :, 3]
        assert alpha[-20].any()
        assert not alpha[-1].any()

    def test_bars_rise_with_their_scores(self, page, report, ranking):
        _, scores = ranking
        rows = pixels_of(page, SURFACE)
        ground = rows[8, -4]
        step = rows.shape[1] / 50
        heights = []
        for place in (0, 10, 25, 45):
            bar = rows[:, int((place + 0.5) * step)]
            base = np.flatnonzero((bar < 60).all(axis=1))[0]
            heights.append((np.abs(bar[:base] - ground).max(axis=1) > 40).sum())
        shares = np.array(heights) / heights[0]
        np.testing.assert_allclose(shares, scores[[0, 10, 25, 45]] / scores[0], atol=0.06)

    def test_by_feature_the_bins_of_each_stand_together(self, page, ranking):
        page.click("#bin-order >> text=By feature")
        names = [name_at(page, place) for place in range(0, 50, 5)]
        assert [re.match(r"\w+", name)[0] for name in names] == (
            ["Gc"] * 2 + ["Sc"] * 4 + ["PFH"] * 2 + ["FPFH"] * 2
        )
        assert name_at(page, 0) == next(name for name in ranking[0] if name.startswith("Gc"))

    def test_the_figures_stand_in_a_table_too(self, page, ranking):
        page.mouse.click(*point_on(page, 4))
        page.click("#open-tables")
        tables = page.locator("#tables table")
        chosen = tables.filter(has=page.locator("caption", has_text="Chosen bins"))
        assert chosen.locator("tbody th").all_inner_texts() == [ranking[0][4]]
        best = tables.filter(has=page.locator("caption", has_text="All bins"))
        assert best.locator("tbody th").all_inner_texts() == ranking[0]
        page.click("#tables >> text=Close")


class TestChoosing:
    def test_a_click_puts_a_bin_first_and_another_gives_it_up(self, page, ranking):
        names, _ = ranking
        page.mouse.click(*point_on(page, 9))
        assert reading(page).endswith("chosen")
        page.mouse.move(5, 5)
        assert name_at(page, 0) == names[9]
        assert name_at(page, 1) == names[0]
        page.mouse.move(5, 5)
        drawn_again(page)
        rows = pixels_of(page, SURFACE)
        border = np.abs(rows - ACCENT).max(axis=2) < 12
        step = rows.shape[1] // 50
        assert border[:, :step].sum() > 100
        assert border[:, step + 4 :].sum() == 0
        page.mouse.click(*point_on(page, 0))
        page.mouse.move(5, 5)
        assert reading(page) == "0 of 50 bins chosen"

    def test_under_the_pointer_a_chosen_bar_stays_where_it_is(self, page, ranking):
        names, _ = ranking
        page.mouse.click(*point_on(page, 9))
        assert reading(page).startswith(f"{names[9]} rank 10 of 50")
        assert f"{names[9]} chosen, 1 bin chosen" in heard(page)
        # Not even other bars move, so that one chooses several, and the second click gives the first one up.
        page.mouse.click(*point_on(page, 20))
        assert f"{names[20]} chosen, 2 bins chosen" in heard(page)
        page.mouse.click(*point_on(page, 9))
        page.mouse.click(*point_on(page, 9))
        page.mouse.click(*point_on(page, 9))
        assert f"{names[9]} removed, 1 bin chosen" in heard(page)
        page.mouse.move(5, 5)
        assert [name_at(page, place) for place in range(3)] == [names[20], names[0], names[1]]

    def test_by_score_is_by_score_whatever_is_chosen(self, page, ranking):
        names, _ = ranking
        page.mouse.click(*point_on(page, 9))
        page.mouse.move(5, 5)
        page.click("#bin-order >> text=By score")
        assert [name_at(page, place) for place in range(50)] == names

    def test_dragging_over_bars_adds_them_and_over_chosen_ones_removes_them(self, page, ranking):
        names, _ = ranking
        drag(page, 10.5 / 50, 14.5 / 50)
        page.mouse.move(5, 5)
        assert reading(page).startswith("5 of 50 bins chosen")
        assert [name_at(page, place) for place in range(5)] == names[10:15]
        drag(page, 3.5 / 50, 1.5 / 50)
        page.mouse.move(5, 5)
        assert reading(page).startswith("2 of 50 bins chosen")

    def test_the_best_the_next_and_the_weakest(self, page, ranking):
        names, _ = ranking
        page.fill("#bin-number", "4")
        page.click("text=Add the best")
        assert [name_at(page, place) for place in range(5)] == names[:5]
        page.mouse.move(5, 5)
        features = [re.match(r"\w+", name)[0] for name in names[:4]]
        census = {feature: features.count(feature) for feature in features}
        most_first = sorted(census, key=lambda feature: (-census[feature], FEATURES.index(feature)))
        told = " ".join(f"{feature} {census[feature]}" for feature in most_first)
        # Beside what is chosen, what it did to the map.
        eventually(
            page,
            lambda: re.fullmatch(
                rf"4 of 50 bins chosen NH 0\.\d+ → [01]\.\d+ {re.escape(told)}", reading(page)
            ),
        )
        page.click("text=Add the best")
        page.fill("#bin-number", "3")
        page.click("text=Remove the weakest")
        page.mouse.move(5, 5)
        assert reading(page).startswith("5 of 50 bins chosen")
        assert "3 bins removed, 5 bins chosen" in heard(page)
        page.click("#bin-clear")
        assert reading(page) == "0 of 50 bins chosen"
        assert page.locator("#bin-clear").is_disabled()

    def test_the_number_stands_with_what_it_is_the_number_of(self, page):
        row = page.locator(".bin-best")
        assert row.locator("*:has(> #bin-number) > button").all_inner_texts() == [
            "Add the best",
            "Remove the weakest",
        ]
        number, finder = (box_of(page.locator(f"#{id_}")) for id_ in ("bin-number", "bin-find"))
        remove = box_of(page.locator("#bin-remove"))
        assert number["x"] < remove["x"] < finder["x"]


class TestKeyboard:
    def test_keys_go_along_the_bars_choose_and_go_on(self, page, ranking):
        names, _ = ranking
        page.focus(SURFACE)
        for key, place in (("ArrowRight", 0), ("PageDown", 10), ("End", 49), ("ArrowLeft", 48), ("Home", 0)):
            page.keyboard.press(key)
            assert f"{names[place]}, rank {place + 1} of 50, score " in heard(page)
        for _ in range(3):
            page.keyboard.press("ArrowRight")
        page.keyboard.press("Space")
        assert f"{names[3]} chosen, 1 bin chosen" in heard(page)
        # The bin has moved to the front, the reader goes on from where it was.
        page.keyboard.press("ArrowRight")
        assert f"{names[4]}, rank 5 " in heard(page)
        page.keyboard.press("Enter")
        page.keyboard.press("Enter")
        assert f"{names[4]} removed, 1 bin chosen" in heard(page)
        page.keyboard.press("Escape")
        assert reading(page).startswith("1 of 50 bins chosen")
        assert page.locator(".bin-card").is_hidden()

    def test_shift_marks_a_range_that_enter_adds_and_delete_removes(self, page, ranking):
        names, _ = ranking
        page.focus(SURFACE)
        for key in ["ArrowRight"] * 6 + ["Shift+ArrowRight"] * 3:
            page.keyboard.press(key)
        assert f"4 bins marked, to {names[8]}" in heard(page)
        page.keyboard.press("Enter")
        assert "4 bins added, 4 bins chosen" in heard(page)
        for key in ("Home", "Shift+ArrowRight", "Delete"):
            page.keyboard.press(key)
        assert "2 bins removed, 2 bins chosen" in heard(page)
        page.keyboard.press("Escape")
        assert [name_at(page, place) for place in range(2)] == names[7:9]

    def test_zoom_keys_keep_what_is_pointed_at_in_place(self, page, ranking):
        names, _ = ranking
        page.focus(SURFACE)
        page.keyboard.press("End")
        for _ in range(4):
            page.keyboard.press("+")
        pointed = page.locator(".column.pointed")
        eventually(page, lambda: float(pointed.get_attribute("width")) == pytest.approx(48))
        box = box_of(page.locator(SURFACE))
        page.mouse.move(box["x"] + box["width"] - 10, box["y"] + 50)
        assert reading(page).split()[0] == names[49]
        page.mouse.move(box["x"] + 10, box["y"] + 50)
        assert reading(page).split()[0] == names[50 - int(np.ceil(box["width"] / 48))]
        page.focus(SURFACE)
        page.keyboard.press("0")
        assert name_at(page, 0) == names[0]


class TestFinding:
    def test_names_are_found_as_one_types(self, page):
        for text, found in {"fpfh": 10, "PFH": 10, "sc[1": 10, "Sc[1]:3": 1, ":3": 5, "gc:1 gc:2": 2}.items():
            page.fill("#bin-search", text)
            assert page.locator(".finding").inner_text() == f"{found} found"

    def test_enter_goes_from_match_to_match_and_all_can_be_added(self, page, ranking):
        names, _ = ranking
        matches = [name for name in names if name.startswith("Sc[0]")]
        page.fill("#bin-search", "sc[0]:")
        for place, key in enumerate(["Enter", "Enter", "Enter", "Shift+Enter"]):
            page.press("#bin-search", key)
            expected = [0, 1, 2, 1][place]
            assert reading(page).split()[0] == matches[expected]
            assert page.locator(".finding").inner_text() == f"{expected + 1} of 10"
        page.click("#bin-take")
        assert reading(page).startswith("10 of 50 bins chosen")
        assert page.locator("#bin-take").inner_text() == "Remove 10"
        page.fill("#bin-search", "nothing of the kind")
        assert page.locator(".finding").inner_text() == "none found"
        assert page.locator("#bin-take").is_hidden()

    def test_matches_stand_out(self, page):
        before = pixels_of(page, SURFACE)
        page.fill("#bin-search", "gc:1")
        drawn_again(page)
        changed = np.abs(pixels_of(page, SURFACE) - before).max(axis=2) > 20
        assert changed.mean() > 0.05
        page.press("#bin-search", "Escape")
        drawn_again(page)
        assert page.input_value("#bin-search") == ""
        assert (pixels_of(page, SURFACE) == before).all()


class TestLookingCloser:
    def test_the_window_of_the_strip_leads_along_the_bars(self, page, ranking):
        names, _ = ranking
        drag(page, 0.003, 0.7, ".strip-of-bins")
        assert name_at(page, 0) != names[0]
        box = box_of(page.locator(SURFACE))
        right = (box["x"] + box["width"] - 3, box["y"] + 50)
        page.mouse.move(*right)
        assert reading(page).split()[0] == names[49]
        drag(page, 0.9, 0.2, ".strip-of-bins")
        page.mouse.move(*right)
        assert reading(page).split()[0] in names[10:45]

    def test_the_wheel_zooms_where_the_page_does_not_scroll(self, page, ranking):
        names, _ = ranking
        page.mouse.move(*point_on(page, 20))
        page.mouse.wheel(0, -300)
        page.mouse.move(*[place + 1 for place in point_on(page, 20)])
        assert reading(page).split()[0] == names[20]
        assert float(page.locator(".column.pointed").get_attribute("width")) > 30
        page.mouse.wheel(0, 3000)
        assert name_at(page, 0) == names[0]


class TestReaders:
    def test_a_finger_reads_first_and_then_chooses(self, open_page, address, ranking):
        names, _ = ranking
        page = opened(
            open_page, address, viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
        )
        page.locator(SURFACE).scroll_into_view_if_needed()
        assert page.evaluate("document.documentElement.scrollWidth") == 390
        # It opens with as many bars as have room for their names; all of them have the names of their rows.
        assert page.locator(".bin-plot .sides ul.aside").count() == 1
        page.tap(".bin-zoom >> text=All")
        drawn_again(page)
        assert page.locator(".bin-plot .sides ul:not(.aside) li").all_inner_texts() == list(FEATURES)
        page.tap(".bin-zoom >> text=First 20")
        page.touchscreen.tap(*point_on(page, 12, 20))
        assert reading(page).startswith(f"{names[12]} rank 13 of 50")
        assert page.locator(".bin-card").is_visible()
        page.touchscreen.tap(*point_on(page, 12, 20))
        assert f"{names[12]} chosen, 1 bin chosen" in heard(page)

    def test_bars_take_the_colours_of_the_dark_and_of_forced_colours(self, open_page, address):
        for options, ground in (({"color_scheme": "dark"}, 0x1B), ({"forced_colors": "active"}, None)):
            page = opened(open_page, address, **options)
            rows = pixels_of(page, SURFACE)
            ground = rows[8, -4].mean() if ground is None else ground
            base = rows[:, rows.shape[1] // 2]
            assert np.abs(rows[8, -4] - ground).max() < 10
            # The line that the bars stand on, and their names, are read on any ground.
            assert np.abs(base.mean(axis=1) - ground).max() > 150

    def test_who_asks_for_less_movement_sees_the_new_order_at_once(self, page):
        page.click("#bin-order >> text=By feature")
        drawn_again(page)
        first = pixels_of(page, SURFACE)
        rested(page, 200)
        assert (pixels_of(page, SURFACE) == first).all()

    def test_bars_that_move_end_in_their_places(self, open_page, address, page):
        moving = opened(open_page, address, reduced_motion="no-preference")
        for reader in (page, moving):
            reader.mouse.click(*point_on(reader, 30))
            reader.mouse.move(5, 5)
        drawn_again(page)
        still = pixels_of(page, SURFACE)
        eventually(page, lambda: (pixels_of(moving, SURFACE) == still).all())


@pytest.fixture(scope="module")
def painter(browser):
    """An empty page with the painter of the bars."""
    page = browser.new_page()
    page.evaluate(join(BARS))
    yield page
    page.close()


@pytest.fixture(scope="module")
def painted(painter):
    """2000 bars on 100 pixel columns, and their rows of marks: pictures (50, 100, 4) of colours and opacity."""
    pictures = painter.evaluate("""() => {
        const count = 2000;
        const columns = Int32Array.from({ length: count }, (_, place) => place);
        const level = new Float32Array(count).fill(0.2);
        const feature = new Uint16Array(count);
        // One bar far above all others, and one of another feature.
        level[1234] = 0.9;
        feature[432] = 1;
        const from = Float32Array.from(columns, (place) => place / 20);
        const bars = { columns, from, to: from.map((start) => start + 1 / 20), level, feature };
        const frame = { width: 100, colors: ["#0000ff", "#ff0000"] };
        const paint = (draw) => {
          const canvas = Object.assign(document.createElement("canvas"), { width: 100, height: 50 });
          const context = canvas.getContext("2d");
          draw(context);
          return [...context.getImageData(0, 0, 100, 50).data];
        };
        const { paintBars, paintRows } = window.bars;
        const rows = { ...frame, top: 0, height: 25, gap: 0, rows: [0, 1] };
        return [
          paint((context) => paintBars(context, bars, { ...frame, base: 50, room: 50 })),
          paint((context) => paintRows(context, bars, rows)),
        ];
    }""")
    return [np.array(picture).reshape(50, 100, 4) for picture in pictures]


class TestManyBars:
    """Thousands of bars share the pixels of a screen, and none of them is lost."""

    def test_the_highest_bar_of_a_pixel_gives_its_height(self, painted):
        heights = (painted[0][:, :, 3] > 0).sum(axis=0)
        assert heights[1234 // 20] == 45
        assert (np.delete(heights, 1234 // 20) == 10).all()

    def test_a_pixel_has_one_colour_and_every_feature_its_row(self, painted):
        bars, rows = painted
        for picture in painted:
            seen = picture[picture[:, :, 3] > 0]
            assert (seen[:, 3] == 255).all()
            assert {tuple(color) for color in seen[:, :3]} <= {(0, 0, 255), (255, 0, 0)}
        # A bar that is not the highest of its pixel is seen in the row of its feature.
        assert (bars[:, :, 0] == 0).all()
        assert np.flatnonzero(rows[30, :, 3]).tolist() == [432 // 20]

    def test_chosen_ones_stay_wide_enough_to_be_seen_and_places_find_back(self, painter):
        found = painter.evaluate("""() => {
            const scale = new window.bars.BinScale();
            scale.fit(2000, [0, 1, 2, 700, 701], 990);
            const whole = [0, 1, 2, 3, 700, 701, 702, 1999, 2000].map((place) => scale.xOf(place));
            const places = [0, 0.5, 2.9, 3, 350, 700.25, 1000, 1999.5];
            const back = places.map((place) => scale.placeOf(scale.xOf(place)) - place);
            scale.hold(700.5, 300, 2);
            const held = scale.xOf(700.5);
            const kept = scale.xOf(701) - scale.xOf(700);
            scale.frame(650, 750, false);
            return { whole, back, held, kept, framed: [scale.xOf(650), scale.xOf(750)] };
        }""")
        whole = found["whole"]
        np.testing.assert_allclose(np.diff([*whole[:4]]), 6)
        np.testing.assert_allclose(np.diff(whole[4:7]), 6)
        assert whole[8] == pytest.approx(990)
        assert 0.4 < whole[8] - whole[7] < 990 / 2000
        np.testing.assert_allclose(found["back"], 0, atol=1e-9)
        assert found["held"] == pytest.approx(300)
        assert found["kept"] == 6
        np.testing.assert_allclose(found["framed"], [0, 990], atol=1e-6)
