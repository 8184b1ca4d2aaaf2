"""The Compare page as a reader uses it: from file://, two groups, outliers and similar classes."""

from __future__ import annotations

import re
from urllib.parse import urlencode

import numpy as np
import pytest
from waiting import box_of, drawn_again, eventually

from shapeviz_report.neighbours import find_fits, find_nearest
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.wording import WORDINGS, say_bins

ROWS = 12


@pytest.fixture
def compare(open_page):
    """Open the page, and wait until the two groups are compared or it is said why not."""

    def open_(name="workbench", wait="#result:not([hidden]), #status .notice", **given):
        options = {key: given.pop(key) for key in list(given) if key in ("viewport", "color_scheme")}
        hash_ = f"#{urlencode(given)}" if given else ""
        page = open_page(name, f"compare.html{hash_}", **options)
        page.wait_for_selector(wait, state="attached")
        return page

    return open_


def compared(page) -> None:
    """Wait until the groups that were chosen last are compared."""
    drawn_again(page)
    eventually(page, lambda: page.locator("#groups[aria-busy=true]").count() == 0)
    drawn_again(page)


def title(page) -> str:
    return page.locator("#answer h2").inner_text()


def address(page) -> str:
    return page.evaluate("decodeURIComponent(location.hash.replaceAll('+', ' '))")


def called(report) -> dict[str, str]:
    """Plain words of every bin."""
    said = say_bins(report.features, report.edges, by_area=True)
    return {column: words.name for column, words in zip(report.features.columns, said) if words is not None}


def rows_of(report, label) -> np.ndarray:
    return np.flatnonzero([other == label for other in report.labels])


def shares_between(values: np.ndarray, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Eta squared of every column, by its definition."""
    both = np.concatenate([first, second])
    middle = values[both].mean(axis=0)
    between = sum(len(rows) * (values[rows].mean(axis=0) - middle) ** 2 for rows in (first, second))
    return between / ((values[both] - middle) ** 2).sum(axis=0)


class TestEngine:
    """The task that sets groups apart, against its definition."""

    def contrast(self, engine_page, values, first, second, *, blocks=None, weights=(1.0,), shuffles=199):
        engine_page.start(values)
        rows, columns = values.shape
        (answer,) = engine_page.run(
            "contrast",
            rows=rows,
            values=values.T.astype(np.float32).ravel(),
            blocks=np.zeros(columns, np.int32) if blocks is None else blocks,
            weights=list(weights),
            contests=[{"first": first, "second": second, "shuffles": shuffles}],
            seed=1,
        )
        return answer

    def test_an_effect_is_the_share_of_the_spread_between_the_groups(self, engine_page):
        random = np.random.default_rng(0)
        values = random.normal(0, 1, (20, 7))
        values[:8, 2] += 2
        values[:, 5] = 3
        first, second = np.arange(8), np.arange(9, 20)
        answer = self.contrast(engine_page, values, first, second)
        with np.errstate(invalid="ignore"):
            expected = np.nan_to_num(shares_between(values, first, second))
        signs = np.sign(values[first].mean(axis=0) - values[second].mean(axis=0))
        assert np.allclose(answer["effect"], signs * expected, atol=1e-5)
        assert np.abs(answer["effect"]).argmax() == 2
        # The other way round it is the same with other signs.
        back = self.contrast(engine_page, values, second, first)
        assert np.allclose(back["effect"], -np.array(answer["effect"]), atol=1e-6)

    def test_features_weigh_as_in_the_distances_of_shapes(self, engine_page):
        random = np.random.default_rng(1)
        values = random.normal(0, 1, (16, 6))
        blocks = np.array([0, 0, 1, 1, 1, 1])
        weights = np.array([3.0, 0.25])
        first, second = np.arange(7), np.arange(7, 16)
        answer = self.contrast(engine_page, values, first, second, blocks=blocks, weights=weights)
        spread = ((values - values.mean(axis=0)) ** 2).sum(axis=0) * weights[blocks]
        between = shares_between(values, first, second) * spread
        for feature in (0, 1):
            own = blocks == feature
            share = between[own].sum() / spread[own].sum()
            assert answer["features"][feature]["share"] == pytest.approx(share, abs=1e-5)
        assert answer["all"]["share"] == pytest.approx(between.sum() / spread.sum(), abs=1e-5)
        away = ((values[first] - values[first].mean(axis=0)) ** 2 * weights[blocks]).sum(axis=1)
        assert np.allclose(answer["away"][:7], away, rtol=1e-4)

    def test_chance_is_seldom_taken_for_a_difference(self, engine_page):
        random = np.random.default_rng(2)
        found = 0
        for _ in range(40):
            values = random.random((ROWS, 30)) ** 3
            answer = self.contrast(engine_page, values, np.arange(6), np.arange(6, ROWS))
            found += np.abs(answer["effect"]).max() > answer["limit"]
            assert answer["all"]["chance"] == pytest.approx(1 / (ROWS - 1), rel=0.3)
        # One in a hundred by its definition; more than three of forty would be one in a thousand times.
        assert found <= 3

    def test_chance_is_as_well_known_by_a_part_of_large_groups(self, engine_page):
        """Few rows are dealt out in place of many: what all would reach follows from it."""
        random = np.random.default_rng(4)
        values = random.normal(0, 1, (700, 20)) @ random.normal(0, 1, (20, 20))
        first, second = np.arange(400), np.arange(400, 700)
        answer = self.contrast(engine_page, values, first, second, shuffles=499)
        spread = ((values - values.mean(axis=0)) ** 2).sum(axis=0)
        dealt = []
        for _ in range(2000):
            order = random.permutation(700)
            dealt.append(shares_between(values, order[:400], order[400:]))
        highest = np.quantile(np.max(dealt, axis=1), 0.99)
        whole = np.quantile(np.average(dealt, axis=1, weights=spread), [0.5, 0.99])
        assert answer["limit"] == pytest.approx(highest, rel=0.25)
        assert answer["all"]["limit"] == pytest.approx(whole[1], rel=0.25)
        assert answer["all"]["chance"] == pytest.approx(1 / 699, rel=0.15)

    def test_a_true_difference_is_beyond_chance(self, engine_page):
        values = np.random.default_rng(3).random((24, 30))
        values[:12, 4] += 1.5
        answer = self.contrast(engine_page, values, np.arange(12), np.arange(12, 24))
        assert (np.abs(answer["effect"]) > answer["limit"]).nonzero()[0].tolist() == [4]


class TestTwoGroups:
    def test_it_opens_with_the_classes_that_are_most_alike(self, compare, reports):
        page = compare()
        report = reports("workbench")
        codes = np.array([ord(label[-1]) - ord("a") for label in report.labels])
        nearest = find_nearest(scale(report.features, PRESETS["default"]), 10)
        shares = np.array(
            [[(codes[nearest[codes == row]] == column).mean() for column in range(5)] for row in range(5)]
        )
        mixed = np.triu(shares + shares.T, k=1)
        first, second = divmod(int(mixed.argmax()), 5)
        names = page.locator("#group-a, #group-b").evaluate_all(
            "(lists) => lists.map((list) => list.selectedOptions[0].text)"
        )
        assert names == [f"kind {'abcde'[first]} (16)", f"kind {'abcde'[second]} (16)"]

    def test_the_bins_that_differ_most_come_first(self, compare, reports):
        page = compare(a="class:kind a", b="class:kind b")
        report = reports("workbench")
        values = compared_values(report.features, PRESETS["default"])
        effects = shares_between(values, rows_of(report, "kind a"), rows_of(report, "kind b"))
        assert re.search(
            r"^(Clearly different|Different|A little different, .+|Different, but .+): .*kind a and .*kind b\.$",
            title(page),
        )
        # A difference counts as often as it is easily pictured; beyond three standard deviations nothing says more.
        distances = np.sqrt(effects / (1 - effects) * 30 * 32) / 16
        ease = np.repeat([WORDINGS[block.name].ease for block in report.features.blocks], [10, 20, 10])
        worth = np.minimum(distances, 3) * ease
        best = report.features.columns[int(np.lexsort((distances, worth))[-1])]
        first = page.locator("#apart-bins .bin-of-two").first
        assert first.locator(".bin-chip bdi").inner_text() == best
        assert first.locator(".bin-chip .in-words").inner_text() == called(report)[best]
        shares = report.features.values[:, report.features.columns.index(best)]
        means = [100 * shares[rows_of(report, label)].mean() for label in ("kind a", "kind b")]
        shown = [float(text.removesuffix("\u00a0%")) for text in first.locator(".mean").all_inner_texts()[:2]]
        assert shown == pytest.approx(means, abs=0.51)
        # Each shape is a mark.
        assert first.locator(".dots-of circle").count() == 32
        # The noise that a report has for its first feature is not taken for a difference, the last one's is one.
        within = page.locator("#feature-rows li.within bdi:first-child").all_inner_texts()
        assert "Gc" in within
        assert "PFH" not in within

    def test_what_goes_with_a_small_group_of_many_shapes_is_told_of_all(self, compare, reports):
        """Of the others a sample speaks, but not as if they were as few as it has."""
        page = compare("large", a="class:class 0", b="rest")
        assert (
            "Compared by samples: the other shapes by 500 of 1\u202f750 shapes."
            in page.locator("#answer").inner_text()
        )
        report = reports("large")
        values = compared_values(report.features, PRESETS["default"])
        own = rows_of(report, "class 0")
        others = np.setdiff1d(np.arange(len(values)), own)
        spread = ((values - values.mean(axis=0)) ** 2).sum(axis=0)
        between = np.nan_to_num(shares_between(values, own, others)) * spread
        columns = report.features.slice_of("Sc")
        told = page.locator("#feature-rows li", has_text="Sc").locator(".figure").inner_text()
        expected = 100 * between[columns].sum() / spread[columns].sum()
        assert float(told.partition("\u00a0")[0]) == pytest.approx(expected, rel=0.1)

    def test_long_names_of_features_end_where_their_place_does(self, open_page):
        page = open_page("everything", "compare.html", viewport={"width": 1024, "height": 768})
        page.wait_for_selector("#feature-rows li")
        names = page.locator("#feature-rows .feature")
        assert (
            names.evaluate_all("all => all.map((name) => name.scrollWidth > name.clientWidth)")
            == [False] * names.count()
        )
        cut = page.locator("#feature-rows bdi", has_text="without an end")
        assert cut.evaluate("name => getComputedStyle(name).textOverflow") == "ellipsis"
        assert cut.get_attribute("title").endswith("without an end ")

    @pytest.mark.parametrize("pair", ["ab", "ce"])
    def test_sentences_are_those_of_people(self, compare, pair):
        page = compare(a=f"class:kind {pair[0]}", b=f"class:kind {pair[1]}")
        leads = page.locator("#answer .told-list li, #answer h2").all_inner_texts()
        said = page.locator(".bin-of-two .says").all_inner_texts()
        assert len(leads) > 1
        for text in (*leads, *said):
            assert not re.search("cosine|normal|tangent|radian|geodesic|histogram", text)
            # Both sides read differently, and are parts of a whole.
            figures = re.findall(
                r"(<?[\d.]+)\u00a0%(?=[.,; ]| on average)", re.sub(r"(has|have) [^;:]*", "", text)
            )
            assert len(figures) == len(set(figures)), text
            assert all(float(figure.removeprefix("<")) <= 100 for figure in figures), text

    def test_a_random_split_of_one_class_is_told_as_one(self, compare, reports):
        report = reports("workbench")
        rows = rows_of(report, "kind c")
        query = [("a", "shapes"), ("b", "shapes")]
        query += [("a-select", report.shapes[row].id) for row in rows[::2]]
        query += [("b-select", report.shapes[row].id) for row in rows[1::2]]
        page = compare(wait="html[data-ready]")
        page.evaluate("(hash) => { location.hash = hash; }", urlencode(query))
        eventually(page, lambda: "A: 8 kind c and B: 8 kind c" in title(page))
        assert title(page).startswith("Nothing sets ")
        assert title(page).endswith("apart beyond chance.")
        assert page.locator("#apart-bins.within").count() == 1

    def test_two_groups_of_selected_shapes_are_told_apart_by_name(self, compare, reports):
        report = reports("workbench")
        rows = {letter: rows_of(report, f"kind {letter}") for letter in "abce"}
        mixed = [*rows["c"][:4], *rows["e"][:4]]
        query = [("a", "shapes"), ("b", "shapes")]
        query += [("a-select", report.shapes[row].id) for row in rows["b"][:8]]
        page = compare(wait="html[data-ready]")
        for other, name in ((rows["a"][:8], "B: 8 kind a"), (mixed, "B: 8 shapes")):
            chosen = [*query, *(("b-select", report.shapes[row].id) for row in other)]
            page.evaluate("(hash) => { location.hash = hash; }", urlencode(chosen))
            eventually(page, lambda name=name: "A: 8 kind b" in title(page) and name in title(page))
            for side, own in (("a", "A: 8 kind b"), ("b", name)):
                assert page.locator(f"#group-{side} option:checked").inner_text() == own
                offers = page.locator(f"#group-{side} option").all_inner_texts()
                assert [offers.count(text) for text in ("A: 8 kind b", name)] == [1, 1]
            in_charts = page.locator(".bin-of-two").first.locator(".group-name bdi")
            assert in_charts.all_inner_texts()[:2] == ["A: 8 kind b", name]
            assert in_charts.evaluate_all(
                "all => all.every(({ parentNode: { scrollWidth, clientWidth } }) => scrollWidth <= clientWidth)"
            )

    def test_clusters_are_told_apart_where_their_names_stand_alone(self, open_page):
        page = open_page("clusters searched", "compare.html")
        page.wait_for_selector("#result:not([hidden])")
        lists = [page.locator(f"#group-{side} option:checked").inner_text() for side in "ab"]
        own = [name.rpartition(" (")[0] for name in lists]
        rows = page.locator(".bin-of-two").first.locator(".group-name bdi")
        assert rows.all_inner_texts() == own
        assert rows.evaluate_all("all => all.every((row) => row.scrollWidth <= row.clientWidth)")
        assert all(f"those {name}" in title(page) for name in own)
        assert "may be rare, or made unlike" in page.locator("#fit-words").text_content()

    def test_groups_are_chosen_from_lists_and_found_by_words(self, compare):
        page = compare()
        page.select_option("#group-a", label="kind e (16)")
        compared(page)
        page.select_option("#group-b", label="all other shapes")
        compared(page)
        assert "a=class:kind e&b=rest" in address(page)
        assert "kind e" in title(page)
        assert "the other shapes" in title(page)
        assert page.locator("#head-b b").inner_text() == "64 shapes"
        assert "no others that they could be alike against" in page.locator("#shared-words").inner_text()
        # The name of a shape ends with its number.
        page.fill("#words-b", "kind b")
        page.press("#words-b", "Enter")
        compared(page)
        eventually(page, lambda: "“kind b”" in title(page))
        assert page.locator("#head-b b").inner_text() == "16 shapes"
        page.click("#swap")
        compared(page)
        assert "a=search:kind b&b=class:kind e" in address(page)
        shown = title(page)
        page.reload()
        page.wait_for_selector("#result:not([hidden])")
        assert title(page) == shown

    def test_groups_go_along_by_the_menu_and_back(self, compare):
        page = compare(a="class:kind b", b="class:kind e")
        for name in ("Overview", "Bins", "Compare"):
            page.locator(".masthead nav a", has_text=name).click()
            page.wait_for_selector("html[data-ready]", state="attached")
        eventually(page, lambda: page.locator("#result:not([hidden])").count() == 1)
        assert "kind b" in title(page)
        assert "kind e" in title(page)

    def test_shapes_of_both_groups_belong_to_the_smaller_one(self, compare, reports):
        report = reports("workbench")
        page = compare(a="shapes", b="class:kind a", **{"a-select": report.shapes[0].id})
        assert page.locator("#common").inner_text().startswith("1 shape would be in both groups")
        assert page.locator("#head-b b").inner_text() == "15 shapes"
        assert page.locator("#head-a b").inner_text() == "1 shape"

    def test_a_selection_that_came_along_is_compared_with_the_rest(self, compare, reports):
        report = reports("workbench")
        page = compare(select=report.shapes[3].id)
        chosen = page.locator("#group-a").evaluate("(list) => list.selectedOptions[0].text")
        assert chosen == report.shapes[3].name
        assert page.locator("#head-b b").inner_text() == "79 shapes"

    def test_the_rest_chosen_on_the_other_side_swaps_the_sides(self, compare):
        page = compare(a="rest", b="class:kind b")
        page.select_option("#group-b", label="all other shapes")
        eventually(page, lambda: "a=class:kind b&b=rest" in address(page))
        assert page.locator("#group-a option:checked").inner_text() == "kind b (16)"
        assert page.locator("#group-b option:checked").inner_text() == "all other shapes"
        page.select_option("#group-a", label="all other shapes")
        eventually(page, lambda: "a=rest&b=class:kind b" in address(page))
        assert page.locator("#common").inner_text() == ""

    def test_nothing_found_and_nothing_left_are_said(self, compare):
        page = compare(a="search:no such words", b="class:kind a")
        assert "No shape is found by “no such words”" in page.locator("#status").inner_text()
        assert page.locator("#result").is_hidden()
        page.select_option("#group-a", label="kind a (16)")
        compared(page)
        # Two equal groups are no question: the other one becomes all other shapes, and that is said.
        eventually(page, lambda: "the other shapes" in title(page))
        assert "as kind a was on both sides" in page.locator("#common").inner_text()
        page.select_option("#group-b", label="kind b (16)")
        eventually(page, lambda: "kind b" in title(page))
        assert page.locator("#common").inner_text() == ""
        # An address may hold what the lists do not.
        page.evaluate("(hash) => { location.hash = hash; }", "a=class:kind a&b=class:kind a")
        eventually(page, lambda: "Both sides are kind a" in page.locator("#status").inner_text())

    def test_all_bins_are_in_the_tables(self, compare):
        page = compare()
        # One card a dimension; these are all there are.
        assert page.locator("#apart-bins > li").count() == 4
        assert page.locator("#more-bins").is_hidden()
        page.click("#open-tables")
        tables = page.locator("#tables table")
        assert tables.first.locator("tbody th").all_inner_texts() == ["all features", "Gc", "Sc", "PFH"]
        assert tables.nth(1).locator("tbody tr").count() == 40
        page.keyboard.press("Escape")
        assert page.locator("#tables[open]").count() == 0

    def test_bins_open_in_the_workbench(self, compare):
        page = compare(a="class:kind a", b="class:kind b")
        names = page.locator("#apart-bins .bin-chip bdi").all_inner_texts()
        page.click("#to-workbench")
        page.wait_for_selector("html[data-ready]", state="attached")
        eventually(page, lambda: page.locator("main[aria-busy=true]").count() == 0)
        made = page.locator("figure[data-map=refined] .made-from").inner_text()
        assert made == ("1 bin" if len(names) == 1 else f"{len(names)} bins")


class TestOnShapes:
    def test_examples_are_turned_in_3d_and_coloured_by_the_bin(self, compare):
        page = compare("bins", a="class:ant", b="class:bird")
        assert page.locator(".seen-on canvas").count() == 0
        chips = page.locator("#apart-bins .bin-chip")
        share = next(chip for chip in chips.all() if not chip.inner_text().startswith("own"))
        name = share.locator("bdi").inner_text()
        share.click()
        drawn_again(page)
        assert f"bin={name}" in address(page)
        assert page.locator("#seen-bin b").inner_text() == name
        # The exact definition is there for who asks.
        definition = page.locator("#seen-bin .exactly p")
        assert definition.is_hidden()
        page.click("#seen-bin summary")
        assert definition.inner_text().startswith("What share of the surface lies where ")
        page.click("#turn-both")
        eventually(page, lambda: page.locator(".seen-on canvas").count() == 2)
        eventually(page, lambda: page.locator(".stage[aria-busy]").count() == 0)
        labels = [canvas.get_attribute("aria-label") for canvas in page.locator(".seen-on canvas").all()]
        assert all(f"values of {name}" in label for label in labels)
        page.locator("#readings input[value=inside]").check(force=True)
        eventually(
            page,
            lambda: "fall into" in page.locator("#stage-a canvas").get_attribute("aria-label"),
        )
        # Another example of a group takes the place of the first.
        other = page.locator("#examples-b .example").nth(2)
        example = other.get_attribute("title")
        other.click()
        eventually(page, lambda: example in page.locator("#stage-b canvas").get_attribute("aria-label"))
        assert page.locator("#examples-b [aria-pressed=true]").get_attribute("title") == example

    def test_where_two_examples_differ_is_seen_on_both(self, compare):
        page = compare("bins", a="class:ant", b="class:bird")
        page.locator("#readings input[value=apart]").check(force=True)
        eventually(page, lambda: page.locator("#apart-legend").is_visible())
        assert page.locator(".seen-on canvas").count() == 2
        name = page.locator("#examples-b [aria-pressed=true]").get_attribute("title")
        label = page.locator("#stage-a canvas").get_attribute("aria-label")
        assert label.endswith(f"coloured where it differs from {name}")
        assert "reading=apart" in address(page)
        # Back to the bin, and to the difference again: there is no old picture in the way.
        page.locator("#readings input[value=inside]").check(force=True)
        eventually(page, lambda: page.locator(".seen-on canvas").count() == 0)
        assert page.locator("#apart-legend").is_hidden()
        page.locator("#readings input[value=apart]").check(force=True)
        eventually(page, lambda: page.locator(".seen-on canvas").count() == 2)
        page.get_by_role("link", name="Feature by feature").click()
        eventually(
            page,
            lambda: page.locator("#beside-title").count() == 1 and page.locator("#beside-title").is_visible(),
        )

    def test_the_first_example_is_the_most_central(self, compare, reports):
        page = compare("bins", a="class:cup", b="class:fish")
        report = reports("bins")
        points = scale(report.features, PRESETS["default"])
        rows = rows_of(report, "cup")
        central = rows[((points[rows] - points[rows].mean(axis=0)) ** 2).sum(axis=1).argmin()]
        assert (
            page.locator("#examples-a .example").first.get_attribute("title") == report.shapes[central].name
        )

    def test_a_feature_of_ones_own_is_not_on_the_surface(self, compare):
        page = compare("bins", a="class:ant", b="class:bird", bin="own[1]")
        said = "A value of the whole shape: it lies on no part of the surface, so nothing is coloured."
        assert page.locator("#seen-bin").get_by_text(said).is_visible()
        readings = page.locator("#readings label").filter(visible=True)
        assert readings.all_inner_texts() == ["no colours", "all they differ in"]
        assert page.locator("#readings input[value=value]").is_checked()
        # Both can be turned all the same.
        page.click("#turn-both")
        eventually(page, lambda: page.locator(".seen-on canvas").count() == 2)
        # A bin that is on the surface has its colours, and is asked for where all features were shown.
        page.locator("#readings input[value=apart]").check(force=True)
        page.locator("#apart-bins .bin-chip").first.click()
        assert "reading" not in address(page)
        assert page.locator("#readings input[value=value]").is_checked()
        assert page.locator("#readings label").filter(visible=True).count() == 3

    def test_a_site_without_models_shows_pictures(self, compare):
        page = compare()
        assert page.locator("#turn-both").is_hidden()
        assert page.locator(".stage > img").count() == 2


class TestOutliers:
    def test_shapes_come_by_rising_fit_with_reasons(self, compare, reports):
        page = compare(wait="#outlier-list > li", view="outliers")
        report = reports("workbench")
        codes = np.array([ord(label[-1]) - ord("a") for label in report.labels])
        fits = find_fits(scale(report.features, PRESETS["default"]), codes)
        worst = np.argsort(fits.fit)[:12]
        names = page.locator("#outlier-list .name a").all_inner_texts()
        assert names == [report.shapes[row].name for row in worst]
        told = page.locator("#outlier-words").inner_text()
        closer = int((fits.fit < 0).sum())
        assert told.startswith(f"{closer} shapes of 80 are closer to another class")
        rival = f"kind {'abcde'[fits.rival[worst[0]]]}"
        assert rival in page.locator("#outlier-list .whereabouts").first.inner_text()
        eventually(page, lambda: page.locator(".reasons:empty").count() == 0)
        # What sets it apart is told with the value of the shape on the axis of both classes.
        assert page.locator("#outlier-list > li").first.locator(".outstanding").count() >= 1

    def test_of_one_class_and_more_of_them(self, compare):
        page = compare(wait="#outlier-list > li", view="outliers")
        page.click("#more-outliers")
        assert page.locator("#outlier-list > li").count() == 24
        page.select_option("#outliers-of", value="1")
        drawn_again(page)
        assert "of=kind b" in address(page)
        assert page.locator("#outlier-list > li").count() == 12
        page.click("#more-outliers")
        assert page.locator("#outlier-list > li").count() == 16
        assert page.locator("#more-outliers").is_hidden()

    def test_a_shape_is_compared_with_its_class(self, compare):
        page = compare(wait="#outlier-list > li", view="outliers")
        name = page.locator("#outlier-list .name a").first.inner_text()
        page.get_by_role("link", name="Compare with its class").first.click()
        eventually(page, lambda: page.locator("#groups").is_visible())
        compared(page)
        eventually(page, lambda: page.locator("#result").is_visible())
        assert name in title(page)


class TestSimilarClasses:
    def test_a_cell_is_a_share_of_the_neighbours(self, compare, reports):
        page = compare("plain", wait="#matrix td", view="classes", row="kind a", column="kind c")
        report = reports("plain")
        codes = np.array([ord(label[-1]) - ord("a") for label in report.labels])
        for space, points in (
            ("features", scale(report.features, PRESETS["default"])),
            ("tsne", report.projections["tsne"][0].xy),
        ):
            page.locator(f"#spaces input[value={space}]").check(force=True)
            drawn_again(page)
            nearest = find_nearest(points, 10)
            for row, column in ((0, 0), (0, 2), (7, 3)):
                share = 100 * (codes[nearest[codes == row]] == column).mean()
                cell = page.locator(f"#matrix [data-row='{row}'][data-column='{column}']")
                assert (cell.inner_text() or "0") == ("<1" if 0 < share < 0.5 else f"{share:.0f}")
            behind = [row for row in range(10) if (codes[nearest[row]] == 2).any()]
            assert page.locator(".behind-list li").count() == len(behind)
        assert "by=tsne" in address(page)

    def test_names_that_go_on_to_the_left_leave_the_sentence_its_order(self, compare):
        page = compare("long names", wait="#matrix td", view="classes")
        chair, stool = (page.locator(f"#matrix th[scope=row][title^={word}]") for word in ("كرسي", "כיסא"))
        start = "\u2068{}\u2069 to \u2068{}\u2069: ".format(
            *(name.get_attribute("title") for name in (chair, stool))
        )
        cell = page.locator(f"#matrix [aria-label^='{start}']")
        cell.hover()
        assert page.locator("#cell-words").text_content() == f"{cell.get_attribute('aria-label')}."

    def test_arrow_keys_go_from_cell_to_cell(self, compare):
        page = compare("plain", wait="#matrix td", view="classes")
        page.locator("#matrix [tabindex='0']").focus()
        first = page.evaluate(
            "[document.activeElement.cellIndex, document.activeElement.parentElement.rowIndex]"
        )
        for key in ("ArrowRight", "ArrowRight", "ArrowDown"):
            page.keyboard.press(key)
        moved = page.evaluate(
            "[document.activeElement.cellIndex, document.activeElement.parentElement.rowIndex]"
        )
        assert moved == [first[0] + 2, first[1] + 1]
        assert page.locator("#matrix [tabindex='0']").count() == 1
        words = page.locator("#cell-words").inner_text()
        assert words.rstrip(".") == page.evaluate("document.activeElement.getAttribute('aria-label')")
        page.keyboard.press("Enter")
        drawn_again(page)
        assert page.locator("#matrix [aria-selected=true]").count() == 1
        eventually(page, lambda: "row=" in address(page) and "column=" in address(page))
        assert page.locator("#behind h3").is_visible()

    def test_the_pair_is_compared(self, compare):
        page = compare("plain", wait="#matrix td", view="classes")
        page.locator("#likest button").first.click()
        names = page.locator("#behind h3 bdi").all_inner_texts()
        page.get_by_role("link", name="Compare these classes").click()
        eventually(page, lambda: page.locator("#result").is_visible())
        assert all(name in title(page) for name in names)

    def test_forty_five_classes_are_readable(self, compare):
        page = compare("many classes", wait="#matrix td", view="classes")
        assert page.locator("#matrix [data-row]").count() == 45 * 45
        cell = box_of(page.locator("#matrix [data-row]").first)
        assert min(cell["width"], cell["height"]) >= 12
        page.click("#open-tables")
        assert page.locator("#tables tbody tr").count() == 45


class TestStates:
    @pytest.mark.parametrize(
        ("name", "groups", "outliers", "classes"),
        [
            ("one shape", "nothing to compare it with", "one class", "one class"),
            ("one class", "there are no others", "one class", "one class"),
            ("no labels", "has no labels", "has no labels", "has no labels"),
        ],
    )
    def test_what_cannot_be_compared_is_said(self, compare, name, groups, outliers, classes):
        page = compare(name)
        assert groups in page.locator("#status").inner_text()
        page.locator("#tab-outliers").click()
        assert outliers in page.locator("#outliers").inner_text()
        page.locator("#tab-classes").click()
        assert classes in page.locator("#classes").inner_text()

    def test_unlabelled_shapes_are_compared_by_words(self, compare):
        page = compare("no labels")
        page.fill("#words-a", "class000")
        page.press("#words-a", "Enter")
        page.select_option("#group-b", label="all other shapes")
        eventually(page, lambda: page.locator("#result").is_visible())
        assert "“class000”" in title(page)

    def test_tabs_by_keyboard(self, compare):
        page = compare()
        page.locator("#tab-groups").focus()
        page.keyboard.press("ArrowRight")
        assert page.locator("#outliers").is_visible()
        assert page.evaluate("document.activeElement.id") == "tab-outliers"
        page.keyboard.press("End")
        assert page.locator("#classes").is_visible()
        assert "view=classes" in address(page)
        page.keyboard.press("ArrowRight")
        assert page.locator("#groups").is_visible()

    @pytest.mark.parametrize("view", ["groups", "outliers", "classes"])
    def test_text_of_a_database_is_text(self, compare, view):
        waits = {"groups": "#result:not([hidden])", "outliers": "#outlier-list > li", "classes": "#matrix td"}
        page = compare("nasty", wait=waits[view], view=view)
        assert page.locator("main img[src='x']").count() == 0
        assert page.evaluate("document.documentElement.scrollWidth") <= 1440

    @pytest.mark.parametrize("view", ["groups", "outliers", "classes"])
    def test_a_phone_needs_no_scrolling_sideways(self, compare, view):
        waits = {"groups": "#result:not([hidden])", "outliers": "#outlier-list > li", "classes": "#matrix td"}
        page = compare("nasty", wait=waits[view], view=view, viewport={"width": 390, "height": 800})
        drawn_again(page)
        assert page.evaluate("document.documentElement.scrollWidth") == 390

    def test_nothing_is_asked_of_any_network(self, compare):
        page = compare(view="groups")
        page.locator("#tab-outliers").click()
        eventually(page, lambda: page.locator(".reasons:empty").count() == 0)
        assert all(request.startswith(("file://", "blob:")) for request in page.watch.requests)


def test_what_is_shared_is_told_by_those_who_have_more_of_it(open_page):
    """So no reader has to turn a "less" around."""
    told = []
    for one, other in ("ab", "ac", "bd", "ce"):
        page = open_page("workbench", f"compare.html#a=class:kind+{one}&b=class:kind+{other}")
        page.wait_for_selector("#answer h2")
        told += page.locator("#shared-bins .says").all_inner_texts()
    more = {True: 0, False: 0}
    for sentence in told:
        assert not sentence.startswith("Less ")
        words, figures = sentence.replace("\u00a0", " ").rsplit(": ", 1)
        shares = [float(share.lstrip("<")) for share in re.findall(r"(<?[\d.]+) %", figures)]
        others_first = "of other shapes than of both" in words
        more[others_first] += 1
        assert figures.startswith("the others ") is others_first
        own, others = (shares[1:], shares[0]) if others_first else (shares[:-1], shares[-1])
        assert all(share < others for share in own) if others_first else all(share > others for share in own)
    assert min(more.values()) > 0
