"""The Features page as a reader uses it, and the Overview's offer of feature subsets."""

import csv
import json
import re
from urllib.parse import unquote_plus

import numpy as np
import pytest
from reports import make_report, with_search
from screenshots import pixels_of
from waiting import box_of, drawn_again, eventually, rested

from shapeviz_report.faithfulness import rate_maps
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.writing import write_site

FEATURES = ("Gc", "Sc", "PFH", "FPFH")
MAP = "figure.map .surface"


def subsets_of(site) -> list[dict]:
    """What the search found, from best to worst, as the site's data says it."""
    search = json.loads((site / "data" / "summary.json").read_text())["search"]
    return (search["exhaustive"] or search["evaluated"])["subsets"]


def kept_of(site, column="kept") -> dict[str, float]:
    """What the map of each subset reaches without labels, by its features."""
    with (site / "data" / "subsets.csv").open() as lines:
        rows = list(csv.DictReader(lines))
    return {
        " ".join(name[8:] for name, has in row.items() if name.startswith("feature:") and has == "1"): float(
            row[column]
        )
        for row in rows
    }


def address(page) -> str:
    return page.evaluate("decodeURIComponent(location.hash).replaceAll('+', ' ')")


def reading(page) -> str:
    return re.sub(r"\s+", " ", page.locator("#reading").inner_text())


def value(page) -> str:
    return page.locator("#panel .value").inner_text()


def place_on_screen(page, place, count) -> tuple[float, float]:
    """The middle of a bar."""
    box = box_of(page.locator("#ranking"))
    return box["x"] + (place + 0.5) * box["width"] / count, box["y"] + 100


def changes(page, selector, act) -> None:
    """Do something, and wait until a place on the screen looks different."""
    before = pixels_of(page, selector)
    act()
    eventually(page, lambda: not np.array_equal(pixels_of(page, selector), before))


class TestFirstLook:
    def test_bars_matrix_map_and_boxes_are_drawn(self, open_page):
        page = open_page("searched", "features.html")
        # What fewer ask is folded, and drawn when it is opened.
        assert page.locator("#seed-dots").is_hidden()
        assert page.locator("#seed-dots svg").count() == 0
        page.click("summary >> text=How sure is it?")
        page.wait_for_selector("#boxes svg")
        page.wait_for_selector("#seed-dots svg")
        for selector in (
            "#subset-bars svg",
            "#feature-matrix svg",
            MAP,
            "#boxes svg",
            "#seed-dots svg",
        ):
            picture = pixels_of(page, selector)
            assert (np.abs(picture - picture[0, -1]).max(axis=2) > 30).mean() > 0.002, selector

    def test_the_best_subset_is_chosen_and_all_is_explained(self, open_page, site):
        page = open_page("searched", "features.html")
        best = subsets_of(site("searched"))[0]
        assert value(page) == f"{best['nh_s']:.3f}"
        assert reading(page).endswith(" ".join(best["features"]))
        page.eval_on_selector_all("details", "nodes => nodes.forEach(node => (node.open = true))")
        text = page.locator("main").inner_text()
        for words in ("nearest neighbours", "on average when it joins", "had no say", "dealt out at random"):
            assert words in text
        search = json.loads((site("searched") / "data" / "summary.json").read_text())["search"]
        assert page.locator(".costs tbody tr").count() == len(search["table"])
        rows = page.locator(".effects tbody tr").all_inner_texts()
        for feature, effect in search["effects"].items():
            row = next(row for row in rows if row.split("\t")[0].strip() == feature)
            assert f"{effect['alone']:.3f}" in row
            *_, alone, joined, without = row.split("\t")
            assert (alone, without) == (f"{effect['alone']:.3f}", f"{effect['without']:.3f}")
            assert float(joined) == pytest.approx(effect["without"] + effect["added"], abs=0.0006)
            told = re.search(r"(gain|lose|change by|change by −) ?(0\.\d{3})", row)
            assert float(told[2]) == pytest.approx(abs(float(joined) - float(without)), abs=1e-9)


class TestPointing:
    def test_pointing_names_rank_value_and_features(self, open_page, site):
        page = open_page("searched", "features.html")
        subsets = subsets_of(site("searched"))
        for place in (4, 11):
            page.mouse.move(*place_on_screen(page, place, 15))
            assert reading(page).startswith(f"Pointed at rank {place + 1} of 15")
            assert f"{subsets[place]['nh_s']:.3f}" in reading(page)
            assert reading(page).endswith(" ".join(subsets[place]["features"]))
        assert value(page) == f"{subsets[0]['nh_s']:.3f}"
        page.mouse.move(5, 5)
        assert reading(page).startswith("Chosen")

    def test_arrow_keys_go_from_bar_to_bar_and_enter_chooses(self, open_page, site):
        page = open_page("searched", "features.html")
        subsets = subsets_of(site("searched"))
        page.focus("#ranking")
        for key, place in (("ArrowRight", 1), ("PageDown", 11), ("End", 14), ("ArrowLeft", 13)):
            page.keyboard.press(key)
            assert reading(page).startswith(f"Pointed at rank {place + 1} ")
        assert "Rank 14 of 15" in page.locator("#live").inner_text()
        page.keyboard.press("Enter")
        assert value(page) == f"{subsets[13]['nh_s']:.3f}"


class TestChoosing:
    def test_a_click_shows_map_and_classes_of_a_subset_and_names_it_in_the_address(self, open_page, site):
        page = open_page("searched", "features.html")
        subset = subsets_of(site("searched"))[9]
        before = pixels_of(page, MAP)
        page.mouse.click(*place_on_screen(page, 9, 15))
        eventually(page, lambda: not np.array_equal(pixels_of(page, MAP), before))
        assert value(page) == f"{subset['nh_s']:.3f}"
        names = page.locator("#legend .name").all_inner_texts()
        shown = page.eval_on_selector_all("#bars text", "nodes => nodes.map(node => node.textContent)")
        assert dict(zip(names, shown, strict=True)) == {n: f"{v:.3f}" for n, v in subset["nh_c"].items()}
        page.mouse.click(*place_on_screen(page, 6, 15))
        names = subsets_of(site("searched"))[6]["features"]
        eventually(page, lambda: address(page) == f"#features={' '.join(names)}")

    def test_shapes_lie_where_the_search_put_them(self, open_page):
        report = with_search(make_report([f"kind {letter}" for letter in "abcde"], 10, features=FEATURES))
        members = report.search.subsets.members
        row = next(i for i, has in enumerate(members) if has.tolist() == [True, False, True, False])
        expected = report.search.subsets.xy[row]
        page = open_page("searched", "features.html#features=Gc PFH")
        ring = page.locator("figure.map .ring.pointed")
        page.focus(MAP)
        places = {}
        for key in ["ArrowRight", "ArrowUp", "ArrowLeft", "ArrowDown"] * 2:
            page.keyboard.press(key)
            name = page.locator("#live").inner_text().split(",")[0]
            drawn_again(page)
            places[name] = [float(ring.get_attribute(axis)) for axis in ("cx", "cy")]
        assert len(places) >= 3
        shown = np.array(list(places.values()))
        names = [shape.name for shape in report.shapes]
        computed = expected[[names.index(name) for name in places]]
        # Screen and map differ by one scale and a turn of the vertical axis.
        scale = np.ptp(shown[:, 0]) / np.ptp(computed[:, 0])
        np.testing.assert_allclose(
            shown - shown[0], (computed - computed[0]) * [scale, -scale], atol=0.002 * scale
        )

    def test_chips_lead_to_every_neighbouring_subset_and_keep_the_focus(self, open_page, site):
        page = open_page("searched", "features.html")
        values = {tuple(sorted(s["features"])): s["nh_s"] for s in subsets_of(site("searched"))}
        features = set(subsets_of(site("searched"))[0]["features"])
        for name in ("Gc", "FPFH", "Sc"):
            features ^= {name}
            chip = page.locator(".chip", has=page.get_by_text(name, exact=True))
            change = chip.locator(".change").inner_text()
            before = float(value(page))
            chip.click()
            assert value(page) == f"{values[tuple(sorted(features))]:.3f}"
            signed = float(change.replace("−", "-"))
            assert float(value(page)) - before == pytest.approx(signed, abs=0.0011)
            pressed = page.locator(".chip[aria-pressed=true] .name").all_inner_texts()
            assert set(pressed) == features

    def test_a_single_feature_stays_and_is_compared(self, open_page, site):
        page = open_page("searched", "features.html#features=Gc")
        assert page.locator(".chip", has=page.get_by_text("Gc", exact=True)).is_disabled()
        assert page.locator(".chip:not(:disabled)").count() == 3
        page.locator(".chip").nth(1).focus()
        page.keyboard.press("Enter")
        page.keyboard.press("Enter")
        assert page.evaluate("document.activeElement.dataset.key") == page.locator(".chip").nth(
            1
        ).get_attribute("data-key")
        subsets = subsets_of(site("searched"))
        own = next(s["nh_s"] for s in subsets if s["features"] == ["Gc"])
        everything = next(s["nh_s"] for s in subsets if len(s["features"]) == 4)
        text = page.locator("#panel .headline").inner_text()
        assert f"−{subsets[0]['nh_s'] - own:.3f} against the best" in text
        assert f"−{everything - own:.3f} against all features" in text

    def test_colors_change_to_neighbourhood_hit(self, open_page):
        page = open_page("searched", "features.html")
        changes(page, MAP, lambda: page.locator("#colors label", has_text="NH").click())
        eventually(page, lambda: "color=hit" in address(page))

    def test_points_move_smoothly_for_who_wants_it(self, open_page):
        page = open_page("searched", "features.html", reduced_motion="no-preference")
        page.focus(MAP)
        page.keyboard.press("ArrowRight")
        page.keyboard.press("Enter")
        places = page.evaluate(
            """async () => {
                const node = document.querySelector("figure.map .ring.opened");
                const places = [];
                document.querySelector("[data-key=next]").click();
                const end = performance.now() + 2500;
                while (performance.now() < end) {
                    const place = node.getAttribute("cx");
                    if (places.at(-1) !== place) places.push(place);
                    await new Promise(requestAnimationFrame);
                }
                return places.length;
            }"""
        )
        assert places > 2


class TestGreedy:
    def test_its_steps_are_drawn_told_and_can_be_chosen(self, open_page, site):
        page = open_page("searched", "features.html")
        greedy = json.loads((site("searched") / "data" / "summary.json").read_text())["search"]["greedy_all"]
        for run in greedy:
            page.locator("#greedy label", has_text=f"s = {run['s']}").click()
            assert page.locator("#ranking .path circle").count() == len(run["path"])
            for step in run["path"]:
                assert f"{step['nh_s']:.3f}" in page.locator("#trace").inner_text()
            page.locator("#trace .step").first.click()
            assert value(page) == f"{run['path'][0]['nh_s']:.3f}"
        page.locator("#greedy label", has_text="none").click()
        assert page.locator("#ranking .path circle").count() == 0
        eventually(page, lambda: "s=none" in address(page))


class TestAddress:
    def test_a_reload_shows_the_same(self, open_page):
        page = open_page("searched", "features.html#features=Gc PFH&s=2&color=hit")
        before = (reading(page), value(page))
        assert reading(page).endswith("Gc PFH")
        assert page.locator("#greedy input:checked").get_attribute("value") == "2"
        assert page.locator("#colors input:checked").get_attribute("value") == "hit"
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert (reading(page), value(page)) == before

    def test_an_address_that_no_longer_fits_is_no_error(self, open_page, site):
        page = open_page("searched", "features.html#features=gone %zz&s=9&color=gone")
        assert value(page) == f"{subsets_of(site('searched'))[0]['nh_s']:.3f}"


class TestTables:
    def test_every_subset_class_and_step_is_in_a_table(self, open_page, site):
        page = open_page("searched", "features.html")
        page.click("#open-tables")
        text = page.locator("#tables").inner_text()
        for subset in subsets_of(site("searched")):
            assert re.search(rf"\t{subset['nh_s']:.3f}\t[^\n]*\t{', '.join(subset['features'])}\n", text)
        assert page.locator("#tables table").nth(1).locator("tbody tr").count() == 5
        assert page.locator("#tables table").last.locator("tbody tr").count() == 50
        page.keyboard.press("Escape")
        assert page.locator("#tables").is_hidden()


class TestRankedWithoutLabels:
    @pytest.mark.parametrize(
        ("name", "title", "low"), [("kept", "Neighbours kept", False), ("stress", "Stress", True)]
    )
    def test_subsets_stand_in_another_order_and_lead_on_in_it(self, open_page, site, name, title, low):
        page = open_page("searched", "features.html")
        values = sorted(kept_of(site("searched"), name).values(), reverse=not low)
        page.select_option("#rank", name)
        eventually(page, lambda: f"rank={name}" in address(page))

        def reads(place):
            eventually(page, lambda: f"rank {place + 1} of {len(values)}" in reading(page))
            assert f"{title} {values[place]:.3f}" in reading(page)

        for place in (0, 3, len(values) - 1):
            page.mouse.move(*place_on_screen(page, place, len(values)))
            reads(place)
        page.mouse.move(5, 5)
        page.click("#panel [data-key=best]")
        reads(0)
        page.click("#panel [data-key=next]")
        reads(1)
        table = page.locator("#panel .measures tbody th").all_inner_texts()
        assert table == ["Neighbours kept", "Trustworthiness", "Continuity", "Stress"]

    def test_an_address_says_what_ranks(self, open_page, site):
        page = open_page("searched", "features.html#rank=continuity")
        assert page.locator("#rank").input_value() == "continuity"
        for words in page.locator("[data-rule=nh], [data-rule=best]").all():
            assert words.is_hidden()
        assert "NH" not in page.locator(".lead").inner_text()
        assert (
            page.locator("#rank-words").inner_text().startswith("The height of a bar: what is alike is near")
        )
        page.select_option("#rank", "nh")
        eventually(page, lambda: page.locator("p[data-rule=nh]").is_visible())
        assert page.locator("p[data-rule=nh]").inner_text().startswith("The height of a bar is NH")
        assert page.locator("#rank-words").inner_text() == ""
        page.select_option("#rank", "continuity")
        assert "a map at random" in page.locator("[data-rule=chance]").inner_text()

    @pytest.mark.parametrize("features", [("Gc",), ("Sc", "PFH")])
    def test_lines_lead_to_the_most_alike_by_the_chosen_features(self, open_page, reports, features):
        page = open_page("searched", f"features.html#features={' '.join(features)}")
        page.focus(MAP)
        page.keyboard.press("ArrowRight")
        eventually(page, lambda: "most alike" in page.locator("#card").inner_text())
        report = reports("searched")
        scaled = scale(report.features, PRESETS["default"])
        points = np.hstack([scaled[:, report.features.slice_of(name)] for name in features])
        search = report.search
        place = search.subsets.members.tolist().index([name in features for name in search.features])
        kept = rate_maps(points, {"": search.subsets.xy[place].astype(float)}, 10)[""].kept
        row = [shape.name for shape in report.shapes].index(page.locator("#card .name").inner_text())
        for kind, expected in (("kept", 10 * kept[row]), ("missing", 10 - 10 * kept[row])):
            found = page.eval_on_selector(
                f"{MAP} .ties.{kind}",
                "node => node.classList.contains('shown') ? node.getAttribute('d').split('M').length - 1 : 0",
            )
            assert found == round(expected)


class TestOfThePaper:
    def test_its_features_alone_are_ranked_among_themselves(self, open_page, site):
        page = open_page("searched with others", "features.html")
        hits = [
            row
            for row in kept_of(site("searched with others"), "nh_s").items()
            if "own" not in row[0].split()
        ]
        hits.sort(key=lambda row: -row[1])
        assert len(hits) == 7
        assert "all 15 maps" in page.locator(".by-class-head").inner_text()
        page.click("#among label:has([value=paper])")
        eventually(page, lambda: "among=paper" in address(page))
        eventually(page, lambda: "all 7 maps" in page.locator(".by-class-head").inner_text())
        for place in (0, 6):
            page.mouse.move(*place_on_screen(page, place, 7))
            eventually(page, lambda: f"rank {place + 1} of 7" in reading(page))  # noqa: B023
            assert f"{hits[place][1]:.3f}" in reading(page)
        page.mouse.move(5, 5)
        page.click("#panel [data-key=next]")
        eventually(page, lambda: "features=" in address(page))
        page.go_back()
        eventually(page, lambda: "features=" not in address(page))
        page.go_back()
        eventually(page, lambda: "of 15" in reading(page))

    def test_all_that_is_said_is_of_those_in_view(self, open_page, site):
        subsets = subsets_of(site("searched with others"))
        own = [row for row in subsets if "own" not in row["features"]]
        whole = next(row for row in own if len(row["features"]) == 3)
        page = open_page("searched with others", "features.html#features=own")
        everything = next(row for row in subsets if len(row["features"]) == 4)
        alone = next(row for row in subsets if row["features"] == ["own"])

        def told():
            return page.locator("#panel .headline").inner_text()

        def against(row, words):
            gap = round(alone["nh_s"], 3) - round(row["nh_s"], 3)
            return f"{gap:+.3f} against {words}".replace("-", "−")

        lead = page.locator(".lead")
        assert "one subset of the 4 features" in lead.inner_text()
        assert against(subsets[0], "the best") in told()
        assert against(everything, "all features") in told()
        assert page.locator("#rows li").count() == 4
        assert page.locator("#trace").inner_text().startswith("Greedy search")
        assert page.locator("[data-rule=best]").is_visible()
        page.click("#among label:has([value=paper])")
        eventually(page, lambda: "one subset of the paper’s 3 features" in lead.inner_text())
        assert against(own[0], "the best of these") in told()
        assert against(whole, "all of the paper’s") in told()
        # What has other features stands nowhere among them.
        assert "not one of these: it has other features" in told()
        for key in ("previous", "next"):
            assert page.locator(f"#panel [data-key={key}]").is_disabled()
        # A rank is one among those in view.
        assert "own" in reading(page)
        assert "rank" not in reading(page)
        # No row stays empty; the greedy search and the level of chance are of all subsets.
        assert sorted(page.locator("#rows li").all_inner_texts()) == ["Gc", "PFH", "Sc"]
        matrix, bars = box_of(page.locator("#feature-matrix svg")), page.locator("#subset-bars")
        assert matrix["height"] == pytest.approx(3 * 15, abs=3)
        assert box_of(page.locator("#ranking"))["height"] == pytest.approx(
            matrix["height"] + box_of(bars)["height"], abs=6
        )
        for gone in ("#trace", "#greedy", "[data-rule=best]"):
            assert page.locator(gone).is_hidden()
        assert page.locator("#ranking .path circle").count() == 0
        page.click("#panel [data-key=all]")
        eventually(page, lambda: " ".join(whole["features"]) in reading(page))
        assert "not one of these" not in told()
        # A feature beside them is offered only where it is one of the chosen subset.
        assert page.locator(".chip").count() == 3
        page.click("#among label:has([value=all])")
        eventually(page, lambda: page.locator(".chip").count() == 4)
        assert page.locator("#rows li").count() == 4
        assert page.locator("#ranking .path circle").count() > 0

    def test_an_address_says_so_and_tables_follow(self, open_page):
        page = open_page("searched with others", "features.html#among=paper")
        assert page.locator("#among [value=paper]").is_checked()
        page.click("#open-tables")
        # The greedy search went among all subsets, and has no table here.
        assert "Greedy search" not in page.locator("#tables").inner_text()
        assert page.locator("#tables table").nth(1).locator("tbody tr").count() == 7

    def test_where_there_are_no_others_there_is_no_choice(self, open_page):
        assert open_page("searched", "features.html").locator("#among").count() == 0


class TestTheme:
    def test_all_is_drawn_anew(self, open_page):
        page = open_page("searched", "features.html", color_scheme="light")
        before = pixels_of(page, "#feature-matrix svg")
        page.click("#theme")
        eventually(page, lambda: not np.array_equal(pixels_of(page, "#feature-matrix svg"), before))
        eventually(page, lambda: pixels_of(page, MAP)[5, 5].mean() < 60)


class TestOverview:
    def test_a_subset_opens_there(self, open_page, site):
        page = open_page("searched", "features.html#features=Gc PFH")
        page.click("#open-overview")
        page.wait_for_url("**/index.html*")
        page.wait_for_selector("html[data-ready]", state="attached")
        page.click("#how-good summary")
        page.wait_for_selector("#bars svg")
        subset = next(s for s in subsets_of(site("searched")) if s["features"] == ["Gc", "PFH"])
        assert page.locator("#quality .value").text_content() == f"{subset['nh_s']:.3f}"
        assert "Gc, PFH alone" in page.locator("#quality").text_content()
        assert page.locator("#features input:checked").get_attribute("value") == "chosen"
        names = page.locator("#legend .name").all_inner_texts()
        values = page.eval_on_selector_all("#bars text", "nodes => nodes.map(node => node.textContent)")
        assert dict(zip(names, values, strict=True)) == {n: f"{v:.3f}" for n, v in subset["nh_c"].items()}

    def test_it_offers_all_features_and_the_best_subset(self, open_page, site):
        page = open_page("searched", "index.html#view=hit&open=class002/0003")
        ring = page.locator("figure[data-slot=large] .ring.opened")
        place = ring.get_attribute("cx")
        best = subsets_of(site("searched"))[0]
        page.locator("#features label", has_text="Best subset").click()
        eventually(page, lambda: page.locator("#quality .value").text_content() == f"{best['nh_s']:.3f}")
        eventually(page, lambda: ring.get_attribute("cx") != place)
        eventually(page, lambda: f"features={' '.join(best['features'])}" in address(page))
        page.locator("#features label", has_text="All features").click()
        eventually(page, lambda: float(ring.get_attribute("cx")) == pytest.approx(float(place)))
        eventually(page, lambda: "features=" not in address(page))

    def test_another_projection_is_of_all_features(self, open_page):
        page = open_page("searched", "index.html#features=Sc")
        assert page.locator("#methods input:checked").get_attribute("value") == "tsne"
        page.locator("#methods label", has_text="UMAP").click()
        assert page.locator("#features input:checked").get_attribute("value") == "all"
        page.locator("#features label", has_text="Chosen: Sc").click()
        eventually(page, lambda: page.locator("#methods input:checked").get_attribute("value") == "tsne")
        eventually(page, lambda: address(page) == "#features=Sc")

    def test_a_reload_shows_the_same_subset_and_the_neighbours_that_nh_counts(self, open_page):
        page = open_page("searched", "index.html#features=Gc Sc&open=class003/0004")
        place = page.locator("figure[data-slot=large] .ring.opened").get_attribute("cx")
        shown = page.locator("#quality").text_content()
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert page.locator("#quality").text_content() == shown
        assert page.locator("figure[data-slot=large] .ring.opened").get_attribute("cx") == place
        page.wait_for_selector("#detail .neighbours .shape")
        hit = float(page.locator("#detail p b").first.inner_text())
        assert hit == pytest.approx(1 - page.locator("#detail .neighbours .stranger").count() / 10)

    def test_where_all_features_are_best_it_says_so(self, open_page, tmp_path):
        write_site(with_search(make_report(["ant", "bird"], 6, features=("Sc",))), tmp_path)
        page = open_page("", address=f"{tmp_path.as_uri()}/index.html")
        assert page.locator("#features label:visible").all_inner_texts() == ["All features (best)"]

    def test_a_site_of_chosen_bins_keeps_the_maps_of_features_apart(self, open_page, site):
        # Wide enough for all choices in one line, so that the map keeps its size.
        size = {"width": 1920, "height": 900}
        page = open_page("chosen bins", "index.html#open=class002/0003", viewport=size)
        assert (
            "2 chosen bins of Gc, PFH are compared"
            in page.locator("figure[data-slot=large] .reading").inner_text()
        )
        ring = page.locator("figure[data-slot=large] .ring.opened")
        place = ring.get_attribute("cx")
        # All features are another map here, which a link from the Features page leads to.
        page.goto(
            f"{site('chosen bins').as_uri()}/index.html#features={' '.join(FEATURES)}&open=class002/0003"
        )
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        everything = next(s for s in subsets_of(site("chosen bins")) if len(s["features"]) == len(FEATURES))
        assert page.locator("#quality .value").text_content() == f"{everything['nh_s']:.3f}"
        assert float(ring.get_attribute("cx")) != pytest.approx(float(place))
        page.locator("#features label", has_text="2 chosen bins").click()
        eventually(page, lambda: float(ring.get_attribute("cx")) == pytest.approx(float(place)))
        eventually(page, lambda: "features=" not in address(page))

    def test_an_unknown_subset_is_no_error(self, open_page):
        page = open_page("refused", "index.html#features=own 1 gone")
        assert page.locator("#features input:checked").get_attribute("value") == "all"

    def test_it_offers_nothing_that_was_not_searched(self, open_page):
        page = open_page("plain")
        assert page.locator("#features").count() == 0

    def test_where_a_sample_was_searched_its_best_subset_has_a_map_of_all_shapes(self, open_page, site):
        page = open_page("sampled")
        assert page.locator("#features label:visible").all_inner_texts() == ["All features", "Best subset"]
        title = page.locator("#features label", has_text="Best subset").get_attribute("title")
        assert "on a sample of 24 shapes" in title
        found = max(subsets_of(site("sampled")), key=lambda subset: subset["nh_s"])["features"]
        before = page.locator("#quality .value").text_content()
        page.locator("#features label", has_text="Best subset").click()
        eventually(page, lambda: address(page).count("features=") == 1)
        assert " ".join(found) in unquote_plus(address(page))
        assert page.locator("#quality .value").text_content() != before
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert page.locator("#features input:checked").get_attribute("value") == "best"

    def test_what_looks_for_places_says_so_meanwhile(self, open_page):
        page = open_page("sampled")
        page.evaluate(
            """() => {
                window.told = new Set();
                new MutationObserver(() => {
                    for (const node of document.querySelectorAll(".surface .placing"))
                        told.add(node.textContent + node.querySelector("progress").max);
                }).observe(document.body, { childList: true, subtree: true });
                location.hash = "features=Gc+Sc";
            }"""
        )
        chosen = page.locator("#features input[value=chosen]")
        eventually(page, lambda: chosen.is_checked())
        assert page.evaluate("[...told]") == [
            "The search laid out a sample. Finding a place for each of the 16 other shapes1"
        ]
        assert page.locator(".placing").count() == 0

    def test_who_chooses_another_map_meanwhile_keeps_that(self, open_page):
        page = open_page("sampled")
        page.evaluate(
            """() => {
                for (const value of ["best", "all"])
                    document.querySelector(`#features input[value=${value}]`).click();
            }"""
        )
        rested(page, 600)
        assert page.locator("#features input:checked").get_attribute("value") == "all"
        assert "features=" not in address(page)

    def test_who_goes_on_meanwhile_is_not_taken_back(self, open_page):
        page = open_page("sampled")
        page.evaluate("location.hash = 'color=class&features=Gc+Sc'")
        page.evaluate("location.hash = 'color=hit'")
        eventually(page, lambda: page.locator(".placing").count() == 0)
        rested(page, 600)
        assert address(page).endswith("#color=hit")
        assert page.locator("figure[data-slot=large][data-view=hit]").count() == 1

    def test_who_goes_back_while_a_page_opens_is_followed(self, open_page):
        page = open_page("sampled", "index.html#color=class&features=Gc+Sc")
        page.evaluate("location.hash = 'color=hit&features=Gc+Sc'")
        eventually(page, lambda: page.locator("figure[data-slot=large][data-view=hit]").count() == 1)
        page.add_init_script(
            """new MutationObserver((_, own) => {
                if (!document.querySelector(".placing")) return;
                own.disconnect();
                history.back();
            }).observe(document, { childList: true, subtree: true });"""
        )
        page.reload()
        eventually(page, lambda: page.locator("figure[data-slot=large][data-view=class]").count() == 1)
        assert "color=class" in address(page)

    def test_shapes_in_the_wrong_place_are_those_of_the_sample(self, open_page):
        page = open_page("sampled", "index.html#features=Gc+Sc&color=map:kept")
        page.locator("#how-good summary").first.click()
        eventually(page, lambda: "In the wrong place" in page.locator("#quality").inner_text())
        assert re.search(r"(none|\d+) of 24 on this map\.", page.locator("#quality").inner_text())

    def test_it_is_said_that_others_than_the_sample_have_no_fit(self, open_page):
        page = open_page("sampled", "index.html#features=Gc+Sc&color=hit")
        reading = page.locator("figure[data-slot=large] .reading .shown")
        assert "only of the 24 shapes that were laid out" in reading.inner_text()

    def test_where_a_sample_was_searched_any_subset_has_all_shapes(self, open_page, site):
        page = open_page("sampled", "index.html#features=Gc+Sc")
        assert page.locator("#features input:checked").get_attribute("value") == "chosen"
        assert "Laid out were 24 shapes" in page.locator("figure.map .reading").first.text_content()
        subset = next(one for one in subsets_of(site("sampled")) if set(one["features"]) == {"Gc", "Sc"})
        assert float(page.locator("#quality .value").text_content()) == pytest.approx(
            subset["nh_s"], abs=6e-4
        )
        page.click("#open-tables")
        table = page.locator("#tables table", has_text="class000/0000")
        places = [text.split("\t")[4:6] for text in table.locator("tbody tr").all_inner_texts()]
        assert len(places) == 40
        assert len(set(map(tuple, places))) == 40
        assert "–" not in {value for place in places for value in place}


class TestStates:
    def test_no_search(self, open_page):
        page = open_page("plain", "features.html")
        assert "--search tsne" in page.locator("main").inner_text()
        page.click("#theme")

    def test_no_labels(self, open_page, site):
        page = open_page("searched without labels", "features.html")
        assert "no labels" in page.locator(".lead").inner_text()
        assert page.locator(".chip").count() == 3
        before = pixels_of(page, MAP)
        page.locator(".chip").first.click()
        eventually(page, lambda: not np.array_equal(pixels_of(page, MAP), before))
        # What needs no labels ranks all the same.
        kept = kept_of(site("searched without labels"))
        best = max(kept, key=kept.get)
        page.focus("#ranking")
        page.keyboard.press("Home")
        assert reading(page) == f"Pointed at rank 1 of 7 Neighbours kept {kept[best]:.3f} {best}"
        assert [text.strip() for text in page.locator("#rank option").all_inner_texts()] == [
            "Neighbours kept",
            "Trustworthiness",
            "Continuity",
            "Stress",
        ]
        page.click("#open-tables")
        subsets, shapes = page.locator("#tables table").all()
        assert subsets.locator("tbody tr").count() == 7
        assert shapes.locator("tbody tr").count() == 24

    def test_no_labels_on_the_overview(self, open_page):
        page = open_page("searched without labels", "index.html#features=Gc Sc")
        assert page.locator("#features input:checked").get_attribute("value") == "chosen"
        assert page.locator("#features label", has_text="Best subset").count() == 0

    def test_too_many_features(self, open_page, site):
        page = open_page("refused", "features.html")
        count = len(subsets_of(site("refused")))
        said = page.locator("#not-all").inner_text()
        assert "11 features have 2\u202f047 subsets, too many to try" in said
        assert f"{count} are shown" in said
        assert f"of {count}" in reading(page)
        # Not every neighbour was evaluated.
        chips = page.locator(".chip")
        assert chips.count() == 11
        effects = page.locator(".effects").inner_text()
        assert "all features but one" in effects
        assert "the map of all others" in effects

    def test_a_sample_is_said_and_shown(self, open_page):
        page = open_page("sampled", "features.html")
        assert "a sample of 24 of the 40 shapes" in page.locator("#of-a-sample").inner_text()
        page.focus(MAP)
        page.keyboard.press("ArrowRight")
        assert re.search(r"(ant|bird) \d+", page.locator("#card .name").inner_text())

    def test_strange_names_are_shown_as_they_are(self, open_page):
        page = open_page("nasty features", "features.html")
        names = page.locator(".chip .name").all_inner_texts()
        assert "<b>50 %</b> & more" in names
        assert "</script><img src=x onerror=alert(1)>" in page.locator("#legend .name").all_inner_texts()
        page.locator(".chip:not(:disabled)").first.click()
        eventually(page, lambda: "features=" in address(page))
        before = reading(page)
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert reading(page) == before
        if page.locator("#open-overview").count():
            page.click("#open-overview")
            page.wait_for_url("**/index.html*")
            page.wait_for_selector("html[data-ready]", state="attached")
            page.click("#how-good summary")
        page.wait_for_selector("#bars svg")


PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


def test_retrieval_of_clusters_is_told_of_clusters(open_page):
    page = open_page("clusters searched", "features.html")
    page.locator("#retrieval details summary", has_text="Each cluster").click()
    heads = page.locator("#retrieval-classes th[scope=col]")
    eventually(page, lambda: heads.all_inner_texts()[:2] == ["Cluster", "Shapes"])
    said = page.locator("#retrieval").inner_text()
    assert "The clusters that judge them chose them" in said
    assert "the same clusters chose them" in said
    assert "labels" not in said.replace("with random labels", "")
    assert "chosen by the clusters" in page.locator("#panel").inner_text()


def test_what_is_drawn_when_it_is_unfolded_is_on_the_first_sheet_too(open_page):
    page = open_page("clusters searched", "features.html")
    rows = page.evaluate(
        """() => {
            window.dispatchEvent(new Event("beforeprint"));
            return document.querySelectorAll("#retrieval-classes tbody tr").length;
        }"""
    )
    assert rows == 4


@pytest.mark.parametrize("width", [1000, 1440])
def test_short_names_of_features_are_not_broken(open_page, width):
    # "FPFH" in a table whose other words want the room.
    page = open_page("clusters searched", "features.html", viewport={"width": width, "height": 900})
    names = page.locator(".effects tbody th bdi")
    assert set(names.evaluate_all("nodes => nodes.map(node => node.getClientRects().length)")) == {1}


class TestPhone:
    @pytest.mark.parametrize("name", ["nasty features", "refused"])
    def test_it_fits_the_width(self, open_page, name):
        page = open_page(name, "features.html", **PHONE)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        page = open_page(name, "index.html#features=Gc Sc PFH", **PHONE)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390

    def test_bars_and_map_come_first_and_the_rest_is_folded(self, open_page):
        page = open_page("searched with others", "features.html", **PHONE)

        def top(selector):
            return box_of(page.locator(selector).first)["y"]

        assert top("#ranking") < 500
        assert top("#ranking") < top("#greedy") < top("figure.map .surface") < top("#panel")
        assert top("figure.map .surface") < 1.2 * 844
        for part in page.locator("details.folds").all():
            assert part.get_attribute("open") is None
        page.click(".effects > summary")
        # A chart is drawn when its part is opened.
        page.locator("#effect-dots svg").wait_for()
        names = page.locator(".effects tbody th bdi")
        assert set(names.evaluate_all("nodes => nodes.map(node => node.getClientRects().length)")) == {1}
        # Each name stands beside its mark.
        for row in page.locator(".effects tbody .marked").all():
            mark, name = (box_of(row.locator(part)) for part in ("i", "bdi"))
            assert mark["x"] + mark["width"] <= name["x"]
            assert name["y"] < mark["y"] + mark["height"] < name["y"] + name["height"] + 2

    def test_what_an_address_leads_to_is_open(self, open_page):
        page = open_page("searched", "features.html", **PHONE)
        assert not page.locator("#separation > p").first.is_visible()
        page = open_page("searched", "features.html#separation", **PHONE)
        assert page.locator("#separation > p").first.is_visible()
        assert not page.locator(".effects > p").first.is_visible()

    def test_a_tap_chooses(self, open_page, site):
        page = open_page("searched", "features.html", **PHONE)
        page.touchscreen.tap(*place_on_screen(page, 8, 15))
        drawn_again(page)
        assert value(page) == f"{subsets_of(site('searched'))[8]['nh_s']:.3f}"


def test_the_names_of_the_features_stand_beside_their_rows(open_page):
    page = open_page("searched", "features.html")
    names, rows = (box_of(page.locator(f".plot {part}")) for part in (".sides", ".scroll"))
    assert names["x"] + names["width"] <= rows["x"] + 1
    assert abs(names["y"] - rows["y"]) < 1
