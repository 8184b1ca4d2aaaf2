"""The Workbench as a reader uses it: from file://, with the real engine."""

import csv
import re
from functools import partial

import numpy as np
import pytest
from reports import make_report
from scipy.spatial.distance import cdist
from waiting import box_of, drawn_again, eventually

from shapeviz_report.bins import read_bins
from shapeviz_report.faithfulness import rate_maps
from shapeviz_report.pages import base, workbench
from shapeviz_report.pages.base import class_codes
from shapeviz_report.pages.sampling import sample_rows
from shapeviz_report.presets import PRESETS, compared_values
from shapeviz_report.scorers import SCORERS, as_one_group, score_separation
from shapeviz_report.writing import write_site

FEATURES = ("Gc", "Sc", "PFH")
REFINED = "figure[data-map=refined] .empty"
KINDS = [f"kind {letter}" for letter in "abcde"]


@pytest.fixture
def bench(open_page):
    """Open the Workbench of a site and wait for its first answers."""

    def open_(name="workbench", hash_="", **options):
        page = open_page(name, f"workbench.html{hash_}", **options)
        answered(page)
        return page

    return open_


def answered(page) -> None:
    """Wait until everything that was asked for is there."""
    eventually(page, lambda: page.locator("main[aria-busy=true]").count() == 0)
    drawn_again(page)


def nh(page, which) -> float | None:
    value = page.locator(f"figure[data-map={which}] .value")
    return float(value.inner_text()) if value.count() else None


def address(page) -> str:
    return page.evaluate("location.hash")


def use_only(page, *names) -> None:
    page.click("#classes-none")
    for name in names:
        page.locator(".use", has=page.get_by_text(name, exact=True)).click()
    answered(page)


def choose_best(page, count) -> None:
    page.fill("#bin-number", str(count))
    page.click("#bin-add")
    answered(page)


def chosen(page) -> int:
    return sum(int(text) for text in page.locator("#feature-list .size b").all_inner_texts())


def steps(page) -> list[str]:
    return [
        re.sub(r"\s+", " ", text).strip() for text in page.locator(".step-of-work .told").all_inner_texts()
    ]


def test_the_first_look_is_useful(bench, site):
    page = bench(color_scheme="light")
    assert nh(page, "original") is not None
    assert nh(page, "refined") is None
    assert "No bins are chosen yet" in page.locator("figure[data-map=refined] .empty").inner_text()
    names = "figure[data-map={}] .labels text"
    assert page.locator(names.format("original")).count() == 5
    assert page.locator(names.format("refined")).count() == 0
    choose_best(page, 3)
    eventually(page, lambda: page.locator(names.format("refined")).count() > 0)
    page.click("#undo")
    answered(page)
    assert page.locator("#separation-words").inner_text() == "all 5 classes, each from the rest"
    assert page.locator("#class-table tbody tr").count() == 5
    assert page.locator("#feature-list .use[aria-pressed=true]").count() == 3
    options = page.locator("#scorer option")
    assert options.count() == len(SCORERS)
    for scorer in SCORERS:
        page.select_option("#scorer", scorer.name)
        answered(page)
        assert page.locator("#scorer-words").inner_text() == scorer.explanation
    assert page.evaluate("[document.documentElement.scrollWidth, document.documentElement.scrollHeight]") == [
        1440,
        900,
    ]


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844), (320, 512)])
def test_what_stands_in_place_of_the_refined_map_stays_on_it(bench, width, height):
    page = bench("clusters searched", viewport={"width": width, "height": height})
    page.locator("figure[data-map=refined] .empty button").wait_for()
    inside = page.locator("figure[data-map=refined] .surface").bounding_box()
    words = page.locator("figure[data-map=refined] .empty").bounding_box()
    assert words["y"] >= inside["y"] - 1
    assert words["y"] + words["height"] <= inside["y"] + inside["height"] + 1


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844)])
def test_below_the_page_is_nothing_however_many_classes_there_are(open_page, tmp_path, width, height):
    write_site(make_report([f"kind {number:02}" for number in range(60)], 2, features=("Gc",)), tmp_path)
    page = open_page(
        "many", address=f"{tmp_path.as_uri()}/workbench.html", viewport={"width": width, "height": height}
    )
    answered(page)
    rows, room = page.locator(".class-scroll").evaluate("(node) => [node.scrollHeight, node.clientHeight]")
    assert rows > 2 * room
    end = page.evaluate("document.body.getBoundingClientRect().bottom")
    assert page.evaluate("document.documentElement.scrollHeight") <= max(end + 1, height)


def test_the_best_bins_separate_two_classes_and_a_reload_gives_the_same(bench):
    page = bench()
    start = nh(page, "original")
    use_only(page, "kind a", "kind e")
    assert page.locator("#separation-words").inner_text() == "kind a from kind e"
    page.select_option("#scorer", "anova")
    answered(page)
    before = nh(page, "original")
    choose_best(page, 6)
    after = nh(page, "refined")
    assert after > before
    assert f"NH of the refined map {after:.3f}, up {after - before:.3f}"[:-1] in page.inner_text("#live")
    assert chosen(page) == 6
    # Every class says what it gained.
    changes = page.locator("#class-table tr:not(.unused) .change").all_inner_texts()
    assert len([text for text in changes if text.startswith(("+", "±", "−"))]) == 2

    again = bench(hash_=address(page))
    assert (nh(again, "original"), nh(again, "refined")) == (before, after)
    assert chosen(again) == 6
    assert again.locator("#scorer").input_value() == "anova"

    # What was asked last is undone first; the maps are those of before.
    page.keyboard.press("Control+z")
    eventually(page, lambda: (nh(page, "original"), nh(page, "refined"), chosen(page)) == (before, None, 0))
    while page.locator("#undo").is_enabled():
        at = page.locator("#steps [aria-current]").get_attribute("data-step")
        page.click("#undo")
        eventually(page, lambda at=at: page.locator("#steps [aria-current]").get_attribute("data-step") != at)
    eventually(page, lambda: nh(page, "original") == start)
    page.locator(".step-of-work").last.click()
    eventually(page, lambda: (nh(page, "refined"), chosen(page)) == (after, 6))


def test_the_number_of_bins_says_how_many_are_added(bench):
    page = bench()
    for asked, taken in (("-3", "1"), ("0", "1"), ("2.7", "2"), ("1e9", None)):
        page.fill("#bin-number", asked)
        page.press("#bin-number", "Tab")
        assert page.input_value("#bin-number") == (taken or page.get_attribute("#bin-number", "max"))


def test_undo_and_the_browsers_way_back_are_one(bench):
    page = bench()

    def now():
        checked = page.locator("#projections input:checked").get_attribute("value")
        return checked, page.input_value("#scorer"), chosen(page)

    def at(*expected):
        eventually(page, lambda: now() == expected)

    entries = page.evaluate("history.length")
    page.locator("#projections label", has=page.locator("input:not(:checked)")).click()
    answered(page)
    page.select_option("#scorer", "anova")
    answered(page)
    choose_best(page, 6)
    first, other = "tsne", "umap"
    assert now() == (other, "anova", 6)
    assert page.evaluate("history.length") == entries + 3
    assert steps(page)[1].endswith("other map")
    page.click("#undo")
    at(other, "anova", 0)
    page.go_back()
    at(other, "rfe", 0)
    page.click("#redo")
    at(other, "anova", 0)
    page.go_back()
    page.go_back()
    at(first, "rfe", 0)
    assert page.locator("#undo").is_disabled()
    page.go_forward()
    at(other, "rfe", 0)
    page.locator(".step-of-work").last.click()
    at(other, "anova", 6)
    # After another opening of the page, undo still leads where the browser does, through what was selected too.
    page.reload()
    answered(page)
    page.focus("figure[data-map=refined] .surface")
    page.keyboard.press("ArrowRight")
    page.keyboard.press(" ")
    eventually(page, lambda: page.inner_text("#tray h2") == "1 shape selected")
    assert now() == (other, "anova", 6)
    page.click("#undo")
    eventually(page, lambda: not page.locator("#tray h2").is_visible())
    assert now() == (other, "anova", 6)
    page.keyboard.press("Control+z")
    at(other, "anova", 0)
    page.keyboard.press("Control+Shift+z")
    at(other, "anova", 6)
    page.click("#redo")
    eventually(page, lambda: page.inner_text("#tray h2") == "1 shape selected")
    # What is done after an undo takes the place of what was undone, in both.
    page.click("#undo")
    eventually(page, lambda: not page.locator("#tray h2").is_visible())
    page.click("#undo")
    at(other, "anova", 0)
    choose_best(page, 3)
    assert page.locator("#redo").is_disabled()
    page.go_back()
    at(other, "anova", 0)
    page.go_forward()
    at(other, "anova", 3)


def test_what_is_offered_first_makes_no_worse_map(bench):
    page = bench()
    use_only(page, "kind a", "kind e")
    offer = page.locator("#first-offer")
    assert offer.inner_text() == "Find a few that keep these classes apart"
    offer.click()
    answered(page)
    before, found = nh(page, "original"), nh(page, "refined")
    assert found >= before
    assert 1 < chosen(page) <= 25
    assert f"NH {before:.3f} → {found:.3f}" in page.inner_text(".bin-tools .reading")
    # Where nothing better is found, the reader keeps what there is.
    page.click("#classes-all")
    answered(page)
    page.click("#bin-clear")
    answered(page)
    kept = address(page)
    page.click("#first-offer")
    answered(page)
    if nh(page, "refined") is None:
        assert "No small set of bins does better than all features here" in page.inner_text(REFINED)
        assert address(page) == kept
    else:
        assert nh(page, "refined") >= nh(page, "original")


def test_what_the_build_found_is_offered_with_what_it_does(bench, reports):
    page = bench("bins that pay")
    search = reports("bins that pay").bins
    told = page.inner_text(REFINED)
    before = reports("bins that pay").projections["tsne"][1].nh_s
    assert f"NH {before:.3f} → {search.automatic.nh_s:.3f}; on shapes that the search never saw, 0." in told
    assert page.inner_text("#first-offer") == f"Take these {len(search.automatic.bins)} bins"
    # What is promised is what these bins reach, by a link too.
    page.evaluate("(bins) => { location.hash = `bins=${bins}`; }", " ".join(search.automatic.bins))
    eventually(page, lambda: nh(page, "refined") is not None)
    answered(page)
    assert nh(page, "refined") == float(f"{search.automatic.nh_s:.3f}")
    page.click("#bin-clear")
    # By another projection nothing was searched.
    page.locator("#projections label", has_text="UMAP").click()
    answered(page)
    assert "on a t-SNE map" in page.inner_text(REFINED)
    # Of other classes the build knows nothing.
    page.locator("#class-table .use").first.click()
    answered(page)
    assert page.inner_text("#first-offer") == "Find a few that keep these classes apart"


def test_bins_that_are_no_better_are_not_offered(bench, reports):
    page = bench("bins")
    report = reports("bins")
    found, before = report.bins.automatic, report.projections["tsne"][1].nh_s
    assert found.nh_s < before
    told = page.inner_text(REFINED)
    assert (
        f"No small set of bins does better than all features here: the {len(found.bins)} bins that the build found "
        f"reach NH {found.nh_s:.3f}, all features {before:.3f}."
    ) in told
    # Asked for all the same, they are not taken, and that is told with the same figures.
    page.click("#bin-find")
    answered(page)
    assert chosen(page) == 0
    told = page.inner_text(REFINED)
    assert f"the best that was found, of {len(found.bins)} bins, reaches NH {found.nh_s:.3f}" in told
    assert f"the map beside this {before:.3f}" in told
    # What can be done instead is.
    assert page.inner_text("#first-offer") == "Show only these two"
    page.click("#first-offer")
    answered(page)
    assert page.locator("#class-table .use[aria-pressed=true]").count() == 2
    assert page.inner_text("#first-offer") == "Find a few that keep these classes apart"


def test_bins_that_pay_only_for_those_that_chose_them_are_not_offered(bench, reports):
    told = bench("bins that pay nothing").inner_text(REFINED)
    found = reports("bins that pay nothing").bins.automatic
    assert f"reach NH {found.nh_s:.3f}" in told
    assert "A small set of bins is no sure gain here" in told
    assert "on shapes that the search never saw they are not surely ahead" in told
    assert "Take these" not in told


def test_what_was_measured_on_a_sample_says_so(bench, open_page):
    page = bench("bins of a sample")
    assert "measured on 16 of 32 shapes" in page.inner_text(REFINED)
    page = open_page("large", "workbench.html")
    eventually(page, lambda: "A search looks at 400 of 2\u202f000 shapes" in page.inner_text(REFINED))


def test_a_separation_of_groups_is_scored_as_python_scores_it(bench):
    page = bench()
    page.select_option("#scorer", "chi2")
    page.click("#separate-all")
    assert "Tick classes" in page.locator("#separation-words").inner_text()
    for name in ("kind a", "kind c"):
        page.get_by_label(f"Separate “{name}”", exact=True).check()
    page.get_by_text("together", exact=True).click()
    answered(page)
    assert page.locator("#separation-words").inner_text() == "kind a and kind c, together, from the rest"
    page.click("#open-tables")
    table = page.locator("#tables table", has_text="All bins").or_(
        page.locator("#tables table", has_text="The best")
    )
    rows = [text.split("\t") for text in table.locator("tbody tr").all_inner_texts()]
    shown = {row[0]: float(row[2]) for row in rows}
    report = make_report(KINDS, 16, features=FEATURES)
    values = compared_values(report.features, PRESETS["default"])
    scorer = next(scorer for scorer in SCORERS if scorer.name == "chi2")
    expected = score_separation(scorer, values, as_one_group(report.labels, ["kind a", "kind c"]))
    python = dict(zip(report.features.columns, expected, strict=True))
    assert len(shown) == len(python)
    np.testing.assert_allclose(list(shown.values()), [python[name] for name in shown], atol=0.001)


def test_features_out_of_use_take_their_bins_along(bench):
    page = bench(hash_="#bins=Gc:1-3+PFH")
    assert chosen(page) == 13
    page.locator("#feature-list .use").first.click()
    answered(page)
    assert chosen(page) == 10
    assert "features=Sc+PFH&bins=PFH" in address(page)
    assert steps(page)[-1].endswith("−1 feature −3 bins")
    everything = nh(page, "original")
    # The last feature stays.
    for name in ("Sc", "PFH"):
        # The last one is marked as not to be switched off; a click on it does nothing.
        page.locator("#feature-list .use", has=page.get_by_text(name, exact=True)).click(force=True)
    answered(page)
    assert page.locator("#feature-list .use[aria-pressed=true]").count() == 1
    assert nh(page, "original") is not None
    page.click("#features-all")
    page.click("#undo")
    page.click("#undo")
    eventually(page, lambda: nh(page, "original") == everything)


def test_pointing_marks_a_shape_on_both_maps(bench):
    page = bench(hash_="#bins=PFH")
    page.focus("figure[data-map=refined] .surface")
    page.keyboard.press("ArrowRight")
    name = page.inner_text("#live").split(",")[0]
    assert page.locator("#card").is_visible()
    assert name in page.inner_text("#card")
    drawn_again(page)
    assert page.locator(".ring.pointed.shown").count() == 2
    page.keyboard.press(" ")
    drawn_again(page)
    assert page.inner_text("#tray h2") == "1 shape selected"
    page.keyboard.press("Escape")
    drawn_again(page)
    assert page.locator("#tray").is_hidden()


def test_maps_say_how_far_they_show_who_is_like_whom(bench, reports):
    bins = ["Gc:1", "Gc:2", "Gc:3", "Sc[1]:4"]
    page = bench(hash_="#bins=Gc:1-3+Sc[1]:4&color=map:kept")
    report = reports("workbench")
    known = report.faithfulness["tsne"]
    words = page.locator("figure[data-map=original] .faith").inner_text()
    assert f"kept {10 * known.kept.mean():.1f} of 10 (random {10 * known.chance:.1f})" in words
    assert f"stress {known.stress:.3f}" in words
    use_only(page, "kind a", "kind b", "kind c")
    rows = [row for row, label in enumerate(report.labels) if label in ("kind a", "kind b", "kind c")]
    columns = [report.features.columns.index(name) for name in bins]
    # Of the chosen bins each counts by its standard deviation over all shapes.
    values = compared_values(report.features, PRESETS["default"])[:, columns]
    points = (values / values.std(axis=0))[rows]
    page.click("#open-tables")
    shown = page.locator("#tables table", has_text="original x").locator("tbody tr")
    xy = np.array([[float(cell) for cell in row.split("\t")[4:6]] for row in shown.all_inner_texts()])
    measures = page.locator("#tables table", has_text="Trustworthiness").locator("tbody tr").all_inner_texts()
    found = {row.split("\t")[0]: [float(cell) for cell in row.split("\t")[3:5]] for row in measures}
    expected = rate_maps(points, {"refined": xy}, 10)["refined"]
    assert found == {
        "Neighbours kept": pytest.approx([expected.kept.mean(), expected.chance], abs=0.02),
        "Trustworthiness": pytest.approx([expected.trustworthiness, expected.random], abs=0.02),
        "Continuity": pytest.approx([expected.continuity, expected.random], abs=0.02),
        "Stress": pytest.approx([expected.stress, expected.random_stress], abs=0.02),
    }


def test_lines_on_a_map_lead_to_the_most_alike_by_what_it_is_made_from(bench):
    page = bench()
    choose_best(page, 4)
    page.focus("figure[data-map=refined] .surface")
    page.keyboard.press("ArrowRight")

    def lines(which, kind):
        return page.eval_on_selector(
            f"figure[data-map={which}] .ties.{kind}",
            "node => node.classList.contains('shown') ? node.getAttribute('d').split('M').length - 1 : 0",
        )

    for which in ("original", "refined"):
        eventually(page, lambda: lines(which, "kept") + lines(which, "missing") == 10)  # noqa: B023
    eventually(page, lambda: "most alike" in page.locator("#card").inner_text())
    page.uncheck("#lines")
    assert lines("original", "kept") == lines("refined", "missing") == 0
    assert "lines=none" in address(page)


def test_it_works_by_keyboard_alone(bench):
    page = bench()
    page.focus("#class-table .use")
    page.keyboard.press("Space")
    answered(page)
    assert page.locator("#class-table .use").first.get_attribute("aria-pressed") == "false"
    assert page.evaluate("document.activeElement.className") == "use"
    page.focus("#bin-chart .surface")
    for key in ("ArrowRight", "Enter", "ArrowRight", "ArrowRight", "Enter"):
        page.keyboard.press(key)
    answered(page)
    assert chosen(page) == 2
    assert nh(page, "refined") is not None
    page.focus("#steps [aria-current]")
    page.keyboard.press("Home")
    page.keyboard.press("Enter")
    eventually(page, lambda: chosen(page) == 0)
    assert page.locator("#class-table .use[aria-pressed=true]").count() == 5
    page.keyboard.press("Control+Shift+z")
    eventually(page, lambda: page.locator("#class-table .use[aria-pressed=true]").count() == 4)


def test_all_classes_are_one_stop_of_the_tab_key(bench):
    page = bench()
    stops = page.locator("#class-table tbody :is(button, input)")
    assert (stops.count(), page.locator("#class-table tbody [tabindex='0']").count()) == (20, 1)

    def focus() -> str:
        return page.evaluate("document.activeElement.dataset.key")

    page.focus("#separate-all")
    page.keyboard.press("Tab")
    assert focus() == "use 0"
    for key, goal in {
        "ArrowUp": "use 0",
        "ArrowDown": "use 1",
        "ArrowRight": "only 1",
        "End": "only 4",
    }.items():
        page.keyboard.press(key)
        assert focus() == goal
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Space")
    assert not page.locator("[data-key='from 4']").is_checked()
    page.keyboard.press("ArrowUp")
    assert focus() == "from 3"
    page.keyboard.press("Home")
    assert focus() == "from 0"
    # What cannot be used is passed over, and the Tab key comes back to where it left.
    page.locator("[data-key='use 1']").click()
    answered(page)
    page.focus("[data-key='from 0']")
    page.keyboard.press("ArrowDown")
    assert focus() == "from 2"
    page.keyboard.press("Tab")
    page.keyboard.press("Shift+Tab")
    assert focus() == "from 2"


def test_the_example_runs_to_its_end(bench):
    page = bench()
    for step in range(1, 6):
        assert f"step {step} of 5" in page.inner_text("#guide")
        page.click("#do-it")
        answered(page)
        words, after, before = page.inner_text("#guide"), nh(page, "refined"), nh(page, "original")
        if step >= 3:
            assert f"NH is {after:.3f}" in words
        if step == 3:
            assert page.locator("#class-table .use[aria-pressed=true]").count() == 2
            assert ("keep them apart better" in words) == (after > before)
    assert page.locator("#class-table .use[aria-pressed=true]").count() == 5
    assert after >= before or "No few bins were found" in words
    page.click("#do-it")
    assert page.locator("#guide").is_hidden()
    assert page.evaluate("document.activeElement.id") == "open-guide"


def test_saved_bins_are_those_that_a_build_reads(bench, tmp_path):
    page = bench(hash_="#bins=Gc:2+Sc[1]:3-5")
    page.click("#open-export")
    assert "shapeviz-report build DATABASE -o OUT --bins bins.txt" in page.inner_text("#export")
    for name in ("bins.txt", "scores.csv", "workbench.json"):
        with page.expect_download() as download:
            page.click(f"[data-file='{name}']")
        download.value.save_as(tmp_path / name)
        blocks = make_report(features=FEATURES).features.blocks
        assert read_bins(tmp_path / name, blocks) == ("Gc:2", "Sc[1]:3", "Sc[1]:4", "Sc[1]:5")
    saved = (tmp_path / "bins.txt").read_text()
    assert "# workbench.html#bins=" in saved
    assert "file:" not in saved, "no folder of the reader's machine"
    with page.expect_download() as download:
        page.click("[data-file='maps.csv']")
    download.value.save_as(tmp_path / "maps.csv")
    assert len((tmp_path / "maps.csv").read_text().splitlines()) == 81


class TestUnusualDatabases:
    def test_without_labels_bins_still_make_maps(self, bench):
        page = bench("no labels")
        assert "no labels" in page.inner_text(".scorer")
        page.click("#first-offer")
        answered(page)
        assert chosen(page) == 10
        assert page.locator("figure[data-map=refined] .empty").is_hidden()
        assert nh(page, "refined") is None
        assert page.inner_text("#live") == "The refined map is ready."

    @pytest.mark.parametrize(
        ("name", "words"),
        [
            ("one shape", "This database has 1 shape"),
            ("one class", "with one class there is nothing to tell apart"),
        ],
    )
    def test_what_is_too_little_is_said(self, bench, name, words):
        page = bench(name)
        assert words in page.inner_text("main")

    def test_no_class_in_use_says_what_to_do(self, bench):
        page = bench()
        page.click("#classes-none")
        answered(page)
        assert "take more classes into use" in page.locator("figure[data-map=original] .empty").inner_text()
        # Nothing is told of what there is not.
        assert "No bars" in page.inner_text(".bin-chart .key")
        assert page.inner_text(".bin-tools .reading").split() == ["0", "bins", "chosen"]
        page.locator("#class-table .use").first.click()
        answered(page)
        assert nh(page, "original") is None
        assert "One class alone" in page.inner_text("figure[data-map=refined] .empty")
        page.click("#classes-all")
        answered(page)
        assert nh(page, "original") is not None

    def test_nasty_names_are_text_and_survive_the_address(self, bench):
        page = bench("nasty workbench")
        page.click("#class-table .use >> nth=1")
        choose_best(page, 10)
        first = (nh(page, "original"), nh(page, "refined"), chosen(page))
        page.click("#open-tables")
        assert "</script><img src=x onerror=alert(1)>" in page.inner_text("#tables")
        again = bench("nasty workbench", hash_=address(page))
        assert (nh(again, "original"), nh(again, "refined"), chosen(again)) == first
        assert again.locator("#class-table .use[aria-pressed=false]").count() == 1

    def test_a_site_of_chosen_bins_opens_with_them(self, bench):
        page = bench("chosen bins")
        assert chosen(page) == 2
        assert page.locator("figure[data-map=refined] .value").count() == 1


class TestWorkThatTakesLong:
    @staticmethod
    def ask(page, way) -> None:
        """Ask for scores while workers come in another way; maps have a worker already."""
        page.evaluate(f"""() => {{
            window.start = shapeviz.startWorker;
            shapeviz.startWorker = () => {way};
        }}""")
        page.locator("#class-table .use").first.click()

    def test_escape_stops_it_and_it_can_go_on(self, bench):
        page = bench()
        self.ask(page, "new Promise((answer) => (window.late ??= []).push(answer))")
        status = page.locator("#scores-status")
        eventually(page, lambda: status.locator("progress").is_visible())
        # What does not wait for it is there.
        eventually(page, lambda: "NH of the original map" in page.inner_text("#live"))
        page.keyboard.press("Escape")
        assert status.inner_text().startswith("Stopped.")
        assert page.locator("main").get_attribute("aria-busy") == "false"
        page.evaluate("() => Promise.all(late.map(async (answer) => answer(await start()))).then(() => {})")
        status.locator("button").click()
        answered(page)
        assert status.is_hidden()

    def test_an_engine_that_fails_is_said_and_asked_again(self, bench):
        page = bench()
        self.ask(page, "Promise.reject(new Error('no workers here'))")
        status = page.locator("#scores-status")
        eventually(page, lambda: "no workers here" in status.inner_text())
        page.evaluate("() => void (shapeviz.startWorker = start)")
        status.locator("button").click()
        answered(page)
        assert status.is_hidden()


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (390, 844)])
def test_it_fits_the_window(bench, width, height):
    page = bench("nasty workbench", "#bins=Gc", viewport={"width": width, "height": height})
    assert page.evaluate("scrollY") == 0
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    if width > 1000:
        assert page.evaluate("document.documentElement.scrollHeight") <= height


def test_a_low_window_leaves_its_height_to_the_maps(bench):
    page = bench("everything", viewport={"width": 1024, "height": 768})
    for which in ("original", "refined"):
        assert box_of(page.locator(f"figure[data-map={which}] .surface"))["height"] >= 260
    assert page.locator(".bench").evaluate("(node) => node.scrollHeight - node.clientHeight") == 0
    faith = page.locator("figure[data-map=original] .faith")
    line = box_of(faith)
    measures = [box_of(part) for part in faith.locator("> *").all()]
    shown = [box for box in measures if box["y"] < line["y"] + line["height"]]
    assert len(shown) > 0
    assert all(box["x"] + box["width"] <= line["x"] + line["width"] for box in shown)


SAMPLED = 90


@pytest.fixture(scope="module")
def large_report():
    return make_report(KINDS, 60, features=FEATURES)


@pytest.fixture(scope="module")
def large(large_report, tmp_path_factory):
    """The address of a site that holds the values of a sample, and of all shapes in parts, as those of very many do."""
    folder = tmp_path_factory.mktemp("large") / "site"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(base, "MOST_IN_FULL", 100)
        patch.setattr(workbench, "sample_rows", partial(sample_rows, most=SAMPLED))
        write_site(large_report, folder)
    return folder.as_uri()


def maps_of(page) -> list[dict[str, str]]:
    """The rows of both maps as they are saved."""
    page.click("#open-export")
    with page.expect_download() as saved:
        page.click("[data-file='maps.csv']")
    page.keyboard.press("Escape")
    return list(csv.DictReader(saved.value.path().read_text(encoding="utf-8").splitlines()))


@pytest.mark.parametrize(
    ("address", "which", "columns"),
    [
        ("bins=Gc:3+Sc[1]:2+PFH:4-6", "refined", [2, 21, 33, 34, 35]),
        ("features=Gc+Sc", "original", range(30)),
    ],
    ids=["bins", "features"],
)
def test_of_very_many_a_sample_is_laid_out_and_each_other_stands_beside_the_most_alike(
    open_page, large, large_report, address, which, columns
):
    page = open_page("large", "workbench.html", f"{large}/workbench.html#{address}")
    answered(page)
    assert f"are of {SAMPLED} of 300 shapes, each class in proportion" in page.inner_text("#of-a-sample")
    assert nh(page, which) is not None
    rows = maps_of(page)
    assert [row["id"] for row in rows] == [shape.id for shape in large_report.shapes]
    sample = sample_rows(class_codes(large_report), SAMPLED)
    # NH is of the sample alone.
    assert np.flatnonzero([row[f"{which}:nh"] != "" for row in rows]).tolist() == sample.tolist()
    places = np.array([[float(row[f"{which}:x"]), float(row[f"{which}:y"])] for row in rows])
    compared = compared_values(large_report.features, PRESETS["default"])[:, columns]
    if which == "refined":
        compared = compared / compared.std(axis=0)
    else:
        # Gc has one dimension, Sc two: each feature by its spread over all its values.
        parts = np.split(compared, [10], axis=1)
        compared = np.hstack([part / np.sqrt(part.var(axis=0).sum()) for part in parts])
    others = np.setdiff1d(np.arange(300), sample)
    beside = cdist(places[others], places[sample]).argmin(axis=1)
    apart = cdist(compared[others], compared[sample])
    alike = apart[np.arange(len(others)), beside] <= apart.min(axis=1) * 1.02
    # What is held is rounded, and of features only their principal components.
    assert alike.mean() > (0.95 if which == "refined" else 0.9)


def test_of_very_many_scores_are_of_the_sample(open_page, large, large_report):
    page = open_page(
        "large", "workbench.html", f"{large}/workbench.html#scorer=anova&separate=kind+a&together="
    )
    answered(page)
    page.click("#open-tables")
    rows = page.locator("#tables table", has_text="Score").locator("tbody tr").all_inner_texts()
    shown = {row.split("\t")[0]: float(row.split("\t")[2]) for row in rows}
    sample = sample_rows(class_codes(large_report), SAMPLED)
    values = compared_values(large_report.features, PRESETS["default"])[sample]
    labels = [large_report.labels[row] for row in sample]
    scorer = next(scorer for scorer in SCORERS if scorer.name == "anova")
    expected = dict(
        zip(
            large_report.features.columns,
            score_separation(scorer, values, as_one_group(labels, ["kind a"])),
            strict=True,
        )
    )
    assert shown == pytest.approx({name: expected[name] for name in shown}, abs=0.002)
    assert len(shown) == len(expected)
