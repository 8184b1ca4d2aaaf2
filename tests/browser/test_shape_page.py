"""The page of one shape as a reader uses it: from file://, with real features and real 3D."""

from dataclasses import replace
from pathlib import Path
from urllib.parse import parse_qs

import numpy as np
import pytest
from reports import make_report, with_copies, with_external
from screenshots import pixels_of
from similar_cases import similar_cases
from waiting import box_of, drawn_again, eventually

from shapeviz_report.neighbours import find_related
from shapeviz_report.pages import base
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.similarity import rank_similar, typical_distance
from shapeviz_report.wording import WORDINGS
from shapeviz_report.writing import write_site
from shapeviz_report.writing.joiner import join

SIMILAR = Path(__file__).parent / "similar.js"


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("large", [False, True])
def test_similar_shapes_are_those_of_python(preset, large, browser, tmp_path, monkeypatch):
    if large:
        monkeypatch.setattr(base, "MOST_IN_FULL", 10)
    report = with_external(make_report(["ant", "bird"], 9, features=("Gc", "Sc", "PFH")))
    report = replace(report, parameters={**report.parameters, "preset": preset})
    write_site(report, tmp_path / "site")
    page = browser.new_page()
    page.goto(f"{(tmp_path / 'site').as_uri()}/about.html")
    page.evaluate(join(SIMILAR))
    cases = similar_cases(report)
    answers = page.evaluate("(cases) => similar.answer(cases)", cases)
    page.close()
    for case, answer in zip(cases, answers, strict=True):
        expected = sorted(case["found"], key=lambda found: found["row"])
        found = sorted(answer["found"], key=lambda found: found["row"])
        assert [other["row"] for other in found] == [other["row"] for other in expected]
        distances = [other["distance"] for other in answer["found"]]
        assert distances == sorted(distances)
        # The site has the values in 65 536 steps, in 256 where they are too many.
        near = {"rel": 1e-2, "abs": 3e-2} if large else {"rel": 1e-4, "abs": 1e-4}
        assert [other["distance"] for other in found] == pytest.approx(
            [other["distance"] for other in expected], **near
        )
        closer, closer_expected = (
            np.array([other["closer"] for other in others]) for others in (found, expected)
        )
        # Two shapes that are equally far but for such a step may change places.
        places = 3 if large else 1
        assert np.abs(closer - closer_expected).max() <= 1.01 * places / (len(expected) - 1)
        assert answer["typical"] == pytest.approx(
            typical_distance(report.features, PRESETS[preset], features=case["features"], bins=case["bins"]),
            rel=1e-3,
        )


@pytest.fixture
def shape(open_page):
    """Open the page of a shape and wait for its features."""

    def open_(name="bins", hash_="#id=class001/0003", **options):
        page = open_page(name, f"shape.html{hash_}", **options)
        return featured(page)

    return open_


def featured(page):
    """Wait until the features are there, as they are for a reader who scrolls to them."""
    page.locator("#by-features").scroll_into_view_if_needed()
    eventually(page, lambda: page.locator("#by-features[aria-busy]").count() == 0)
    page.evaluate("scrollTo(0, 0)")
    drawn_again(page)
    return page


def title(page) -> str:
    return page.locator("#name").inner_text()


def address(page) -> dict[str, list[str]]:
    return parse_qs(page.evaluate("location.hash.slice(1)"), keep_blank_values=True)


def pressed(page) -> list[str]:
    return page.locator(".compared[aria-pressed=true]").all_inner_texts()


def similar(page) -> list[str]:
    return page.locator(".similar .name").all_inner_texts()


def test_a_shape_is_told_whole(shape, tmp_path):
    metadata = {
        "artist": "N. N.",
        "licence": "CC BY 4.0",
        "own page": "javascript:alert(1)",
        "source": "https://example.org/shapes?of=birds&all",
    }
    write_site(make_report(["ant", "bird"], metadata=metadata), tmp_path / "site")
    page = shape(address=f"{(tmp_path / 'site').as_uri()}/shape.html#id=class001/0003")
    assert title(page) == "bird 3"
    assert page.title() == "bird 3 · Test shapes"
    assert page.locator("#of-class").inner_text() == "bird"
    # Whose it is and what may be done with it stand first.
    sections = page.locator(".facts section")
    assert sections.nth(0).locator("h2").inner_text() == "Licence and source"
    assert sections.nth(0).locator("dt").all_inner_texts() == ["licence", "source"]
    link = sections.nth(0).locator("a")
    assert link.get_attribute("href") == "https://example.org/shapes?of=birds&all"
    assert "noopener" in link.get_attribute("rel")
    facts = page.locator(".facts").inner_text()
    for words in (
        "1\u202f011 faces, 502 vertices",
        "1 × 2 × 11.5",
        "0.120\u00a0% of its diagonal",
        "surface\nwatertight",
    ):
        assert words in facts
    # Not everything that looks like an address is one.
    assert page.locator(".facts a").count() == 1
    assert "javascript:alert(1)" in facts


def test_neighbours_and_hit_are_those_of_the_map(shape, reports):
    page = shape()
    projection, hits = reports("bins").projections["tsne"]
    assert f"{hits.nh[11]:.3f}" in page.locator("#nh").inner_text()
    distances = np.linalg.norm(projection.xy - projection.xy[11], axis=1)
    nearest = [reports("bins").shapes[row].id for row in np.argsort(distances)[1 : hits.k + 1]]
    links = page.locator("#neighbours a")
    assert [parse_qs(link.get_attribute("href").split("#")[1])["id"][0] for link in links.all()] == nearest
    page.locator("#maps input").nth(1).check(force=True)
    assert address(page)["map"] == ["umap"]
    assert f"{reports('bins').projections['umap'][1].nh[11]:.3f}" in page.locator("#nh").inner_text()
    # Links keep the map.
    assert "map=umap" in links.first.get_attribute("href")
    page.locator("#neighbours-key a").click()
    page.wait_for_selector("html[data-ready]", state="attached")
    assert page.locator("#methods input:checked").get_attribute("value") == "umap"
    assert page.locator("#detail h2").inner_text() == "bird 3"
    page.locator("#detail a", has_text="All about this shape").click()
    eventually(page, lambda: page.locator("#name").count() == 1 and title(page) == "bird 3")
    assert page.locator("#maps input").nth(1).is_checked()


def test_one_goes_from_shape_to_shape_and_back(shape):
    page = shape()
    assert page.locator("#turn-over .quiet").inner_text() == "4 of 8 in bird"
    page.locator("#turn-over [rel=next]").click()
    eventually(page, lambda: title(page) == "bird 4")
    for name in ("bird 5", "bird 6", "bird 7", "bird 0"):
        page.locator("#turn-over [rel=next]").click()
        eventually(page, lambda name=name: title(page) == name)
    # The first follows the last.
    page.locator("#turn-over [rel=prev]").click()
    eventually(page, lambda: title(page) == "bird 7")
    page.fill("#shape-search", "cup 2")
    page.press("#shape-search", "Enter")
    eventually(page, lambda: title(page) == "cup 2")
    assert page.title().startswith("cup 2")
    page.locator(".similar a.shape").nth(3).click()
    assert page.locator(".similar .name").count() == 12
    assert page.evaluate("scrollY") == 0
    page.go_back()
    eventually(page, lambda: title(page) == "cup 2")
    page.go_back()
    eventually(page, lambda: title(page) == "bird 7")
    page.locator("#way-back a").click()
    page.wait_for_selector("html[data-ready]", state="attached")
    assert address(page)["at"] == ["class001/0007"]


def test_similar_under_any_choice(shape, reports):
    page = shape()
    table = reports("bins").features
    preset = PRESETS["default"]
    names = {row: entry.name for row, entry in enumerate(reports("bins").shapes)}

    def expected(**choice):
        found = rank_similar(table, preset, table.values[11], member=11, count=12, **choice)
        return [names[other.row] for other in found]

    assert pressed(page) == ["All 3 features"]
    assert similar(page) == expected()
    chips = page.locator(".compared")
    chips.nth(1).click()
    assert pressed(page) == ["Gc"]
    assert similar(page) == expected(features=["Gc"])
    chips.nth(3).click()
    assert address(page)["features"] == ["Gc own"]
    assert similar(page) == expected(features=["Gc", "own"])
    chips.nth(4).click()
    chosen = reports("bins").bins.automatic.bins
    assert pressed(page) == [f"{len(chosen)} selected bins"]
    assert similar(page) == expected(bins=chosen)
    assert "features" not in address(page)
    again = shape(hash_=page.evaluate("location.hash"))
    assert similar(again) == similar(page)
    again.goto(again.url.split("#")[0] + "#id=class001/0003&bins=Gc:3+Sc[1]:10")
    eventually(again, lambda: similar(again) == expected(bins=["Gc:3", "Sc[1]:10"]))
    assert "Compared by Gc:3, Sc[1]:10." in again.locator("#similar-words").inner_text()
    assert pressed(again) == []
    chips = again.locator(".compared")
    chips.nth(0).focus()
    again.keyboard.press("Enter")
    assert similar(again) == expected()
    # More of them, and the focus goes on to the first new one.
    again.click("#similar-more")
    assert again.locator(".similar").count() == 24
    assert again.evaluate(
        "document.activeElement.closest('.similar') === document.querySelectorAll('.similar')[12]"
    )


def test_similar_by_neighbourhood(shape, reports, tmp_path):
    report = reports("bins")
    compared = scale(report.features, PRESETS["default"])
    related = find_related(compared, 20)
    write_site(replace(report, related=related), tmp_path / "site")
    page = shape(address=f"{(tmp_path / 'site').as_uri()}/shape.html#id=class001/0003")
    names = [entry.name for entry in report.shapes]
    plain = similar(page)
    chip = page.locator(".compared", has_text="By neighbourhood")
    chip.click()
    assert pressed(page) == ["By neighbourhood"]
    assert similar(page) == [names[row] for row in related[11][:12]] != plain
    assert "no feature can be said to make it" in page.locator("#similar-words").inner_text()
    # Distances are the plain ones of all features.
    distances = np.linalg.norm(compared[related[11][:12]] - compared[11], axis=1)
    told = [float(text.split()[-1]) for text in page.locator(".similar .quiet").all_inner_texts()]
    assert told == pytest.approx(distances, abs=0.002)
    page.click("#similar-more")
    assert page.locator(".similar").count() == 20
    # Another shape is seen in the same way, and so is this one by a link.
    page.locator(".similar .name a").first.click()
    assert pressed(featured(page)) == ["By neighbourhood"]
    assert address(page)["neighbourhood"] == [""]
    page.locator(".compared", has_text="Gc").click()
    assert pressed(page) == ["Gc"]
    assert "neighbourhood" not in address(page)
    chip.click()
    page.locator(".compared", has_text="All 3").click()
    assert pressed(page) == ["All 3 features"]


def test_reasons_and_ways_to_go_on(shape, reports):
    page = shape()
    table = reports("bins").features
    found = rank_similar(table, PRESETS["default"], table.values[11], member=11, count=12)
    labels = reports("bins").labels
    cards = page.locator(".similar")
    for card, other in zip(cards.all(), found, strict=True):
        assert f"distance {other.distance:.3f}" in card.inner_text()
        order = np.argsort(-other.closer, kind="stable")
        words = card.locator(".why").inner_text()
        aspects = [WORDINGS[block.name].aspect for block in table.blocks if block.bins > 1] + ["own"]
        assert words.startswith(f"Alike in {aspects[order[0]]} and {aspects[order[1]]} (nearer than ")
        # What they are least alike in is told only where they are not alike in it.
        least = other.closer[order[-1]]
        assert (f"least in {aspects[order[-1]]} " in words) == (least < 0.9)
        heights = [
            bar.evaluate("node => parseFloat(node.style.height)") for bar in card.locator(".alike i").all()
        ]
        assert heights == pytest.approx(100 * other.closer, abs=4)
        # What is said of two features holds of both.
        assert ("nearer than all others" in words) == (sorted(heights)[-2] == 100)
        assert card.locator("a", has_text="Compare").count() == (labels[other.row] != "bird")
    assert (
        f"{sum(labels[other.row] == 'bird' for other in found)} of these 12"
        in page.locator("#similar-words").inner_text()
    )
    stranger = next(other.row for other in found if labels[other.row] != "bird")
    href = page.locator(".similar a", has_text="Compare").first.get_attribute("href")
    assert parse_qs(href.split("#")[1]) == {"a": ["class:bird"], "b": [f"class:{labels[stranger]}"]}
    page.click("#similar-on-map")
    page.wait_for_selector("html[data-ready]", state="attached")
    assert page.locator("#tray h2").inner_text() == "13 shapes selected"


def test_histograms_against_class_and_all(shape, reports):
    page = shape()
    report = reports("bins")
    panels = page.locator(".histogram")
    assert panels.locator("h3 bdi").all_inner_texts() == ["Gaussian curvature", "Shape context", "own"]
    column = report.features.columns.index("Gc:3")
    bar = page.locator(f"#histograms button[data-column='{column}']")
    shares = report.features.values[:, column]
    fellows = [row for row, label in enumerate(report.labels) if label == "bird" and row != 11]
    low, high = (percent(value) for value in np.quantile(shares[fellows], [0.25, 0.75]))
    assert f"this shape {percent(shares[11])}" in bar.get_attribute("aria-label")
    assert f"others of its class {low} to {high}" in bar.get_attribute("aria-label")
    # The bars stand in the ratio of the shares.
    heights = [
        float(
            page.locator(f"#histograms button[data-column='{other}'] .own").evaluate(
                "node => node.offsetHeight"
            )
        )
        for other in range(10)
    ]
    assert np.corrcoef(heights, report.features.values[11, :10])[0, 1] > 0.999
    bar.scroll_into_view_if_needed()
    bar.hover()
    card = page.locator(".value-card")
    assert "What share of the surface lies where" in card.inner_text()
    more = (shares < shares[11]).sum() / (len(shares) - 1)
    assert f"{round(100 * more)}\u00a0% of all" in card.inner_text()
    # By keyboard: one stop a feature, arrows within.
    page.mouse.move(2, 2)
    page.locator("#histograms button[data-column='0']").focus()
    page.keyboard.press("End")
    assert page.evaluate("document.activeElement.dataset.column") == "9"
    assert "Gc:10" in card.inner_text()
    page.keyboard.press("Home")
    assert page.evaluate("document.activeElement.dataset.column") == "0"
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.tagName") == "SELECT"


def test_a_feature_of_parts_opens_where_the_shape_stands_out(shape, reports):
    page = shape()
    table = reports("bins").features
    values = np.sqrt(table.values[:, table.slice_of("Sc")]).reshape(-1, 2, 10)
    unusual = ((values[11] - values.mean(axis=0)) ** 2).sum(axis=1).argmax()
    choice = page.locator(".histogram").nth(1).locator("select")
    assert choice.input_value() == str(unusual)
    other = 1 - int(unusual)
    choice.focus()
    choice.select_option(str(other))
    assert address(page)["parts"] == [f"Sc[{other}]"]
    first = table.slice_of("Sc").start + 10 * other
    assert page.locator(f"#histograms button[data-column='{first}']").count() == 1
    assert page.evaluate("document.activeElement.tagName") == "SELECT"
    again = shape(hash_=page.evaluate("location.hash"))
    assert again.locator(".histogram").nth(1).locator("select").input_value() == str(other)


def test_colours_or_clay(shape):
    page = shape(hash_="#id=class003/0007")
    looks = page.locator("#looks")
    assert not looks.is_visible()
    page.click("#show-3d")
    eventually(page, looks.is_visible)
    drawn_again(page)
    own = seen(page)
    chosen = looks.locator("input:checked")
    assert chosen.input_value() == "own"
    # by the keyboard alone
    chosen.focus()
    page.keyboard.press("ArrowRight")
    assert address(page)["clay"] == [""]
    assert chosen.input_value() == "clay"
    assert page.evaluate("document.activeElement.value") == "clay"
    drawn_again(page)
    clay = seen(page)
    assert changed(own, clay) > 0.1
    # a link brings it back, at once in 3D
    again = shape(hash_=page.evaluate("location.hash"))
    eventually(again, again.locator("#looks").is_visible)
    assert again.locator("#looks input:checked").input_value() == "clay"
    # the values of a bin are neither
    page.locator("#histograms button[data-column='2']").click()
    eventually(page, lambda: not looks.is_visible())
    page.click("text=Plain again")
    eventually(page, looks.is_visible)
    looks.locator("text=its colours").click()
    assert "clay" not in address(page)
    drawn_again(page)
    assert changed(own, seen(page)) < 0.02
    # where there are no colours there is nothing to choose
    bare = shape()
    bare.click("#show-3d")
    eventually(bare, lambda: bare.locator("#stage canvas").count() == 1)
    drawn_again(bare)
    assert not bare.locator("#looks").is_visible()


def test_a_bar_colours_the_shape(shape):
    page = shape()
    assert not [url for url in page.watch.requests if "/models/" in url]
    page.click("#show-3d")
    eventually(page, lambda: page.locator("#stage canvas").count() == 1)
    drawn_again(page)
    plain = seen(page)
    page.locator("#histograms button[data-column='2']").click()
    assert address(page)["bin"] == ["Gc:3"]
    eventually(page, lambda: "Gc:3" in page.locator("#stage canvas").get_attribute("aria-label"))
    drawn_again(page)
    colours = seen(page)
    assert changed(plain, colours) > 0.1
    assert page.locator("#legend .ten .own").count() == 1
    assert page.locator("#painted b").inner_text() == "Gc:3"
    # A link brings it back, at once in 3D.
    again = shape(hash_=page.evaluate("location.hash"))
    eventually(again, lambda: again.locator("#stage canvas").count() == 1)
    page.click("text=Find shapes with as much of it")
    assert address(page)["bins"] == ["Gc:3"]
    page.click("text=Plain again")
    eventually(page, lambda: "Gc:3" not in page.locator("#stage canvas").get_attribute("aria-label"))
    drawn_again(page)
    assert changed(plain, seen(page)) < 0.02
    # What was brought along has no values on the surface: the shape stays as it is, and the page says why.
    page.locator("#histograms .value-strip button").click()
    assert (
        "it lies on no part of the surface, so nothing is coloured" in page.locator("#painted").inner_text()
    )
    assert page.locator("#stage canvas").count() == 1
    assert page.locator("#legend .ten").count() == 0
    page.locator("#painted a").click()
    page.wait_for_selector("html[data-ready]", state="attached")
    assert address(page)["bin"] == ["own[0]"] or "own" in address(page)["bin"][0]


def test_a_map_is_pointed_at_and_clicked(shape):
    page = shape()
    box = box_of(page.locator("#place-surface"))
    card = page.locator("#content > .card:not(.value-card)")
    for x in np.linspace(8, box["width"] - 8, 30):
        for y in np.linspace(8, box["height"] - 8, 15):
            page.mouse.move(box["x"] + x, box["y"] + y)
            if card.is_visible() and "fish" in card.inner_text():
                name = card.locator(".name").inner_text()
                page.mouse.down()
                page.mouse.up()
                assert title(page) == name
                page.go_back()
                eventually(page, lambda: title(page) == "bird 3")
                return
    raise AssertionError("no fish is on the map")


def test_an_unknown_shape_offers_others(open_page):
    page = open_page("plain", "shape.html#id=<b>nix</b>")
    assert title(page) == "No such shape"
    assert page.locator("#open-tables").is_hidden()
    assert "<b>nix</b>" in page.locator("#nowhere").inner_text()
    assert page.locator("#known").is_hidden()
    page.fill("#shape-search", "kind b 4")
    page.press("#shape-search", "Enter")
    assert title(page) == "kind b 4"
    assert page.locator("#nowhere").is_hidden()
    nameless = open_page("plain", "shape.html")
    assert "The address names no shape." in nameless.locator("#nowhere").inner_text()
    nameless.locator("#nowhere a").click()
    nameless.wait_for_selector("html[data-ready]", state="attached")
    assert nameless.url.endswith("shapes.html")


def test_sites_of_all_kinds_have_their_words(shape):
    one = shape("one shape", "#id=class000/0000")
    assert one.locator(".surroundings").is_hidden()
    assert one.locator("#similar").is_hidden()
    assert one.locator("#turn-over").inner_text() == ""
    assert one.locator("#stage .empty").inner_text().startswith("This site holds no 3D data")
    assert one.locator(".bars .own").count() == 20
    assert one.locator(".bars .all, .bars .fellows").count() == 0
    unlabelled = shape("no labels", "#id=class001/0002")
    assert unlabelled.locator("#turn-over .quiet").inner_text() == "15 of 24"
    assert "class" not in unlabelled.locator("#similar-words").inner_text()
    assert unlabelled.locator(".bars .fellows").count() == 0
    nasty = shape("nasty", "#id=class006/0002")
    assert title(nasty) == "עברית ימין 2"
    assert nasty.locator("#of-class bdi").inner_text() == "עברית ימין"
    features = shape("nasty features", "#id=class001/0002")
    features.locator(".compared").nth(2).click()
    assert address(features)["features"] == ["<b>50%20%25</b>%20&%20more"]
    assert len(pressed(features)) == 1
    # A site made of chosen bins compares these first.
    chosen = shape("chosen bins", "#id=class001/0002")
    assert pressed(chosen) == ["The 2 bins of the maps"]
    chosen.locator(".compared").first.click()
    assert len(pressed(chosen)) == 1
    assert len(address(chosen)["features"][0].split()) == 4


def test_a_shape_is_selected_and_stays_so(shape):
    page = shape(hash_="#id=class001/0003&select=class000/0001")
    choose = page.locator("#choose")
    assert choose.get_attribute("aria-pressed") == "false"
    choose.click()
    assert choose.get_attribute("aria-pressed") == "true"
    eventually(page, lambda: page.locator("#tray .shape").count() == 2)
    assert address(page)["select"] == ["class000/0001", "class001/0003"]
    page.locator("#turn-over [rel=next]").click()
    eventually(page, lambda: choose.get_attribute("aria-pressed") == "false")
    assert address(page)["select"] == ["class000/0001", "class001/0003"]
    page.locator("#way-back a").click()
    page.wait_for_selector("html[data-ready]", state="attached")
    assert address(page)["select"] == ["class000/0001", "class001/0003"]


def test_copies_are_told_with_what_says_so_and_lead_to_each_other(shape, reports):
    page = shape("copied", "#id=class000/0003")
    told = page.locator("#facts section", has=page.locator("h2", has_text="The same shape as"))
    words = reports("copied").copies[0].match.words
    assert told.locator("dt").all_inner_texts() == ["ant 0", "ant 5"]
    assert told.locator("dd").all_inner_texts() == [words, words]
    told.locator("a").first.click()
    eventually(page, lambda: title(page) == "ant 0")
    eventually(page, lambda: told.locator("dt").all_inner_texts() == ["ant 3", "ant 5"])
    assert told.locator("dd").all_inner_texts() == [words, "by way of ant 3"]


def test_everything_stands_in_tables(shape):
    page = shape()
    page.click("#open-tables")
    captions = page.locator("#tables caption").all_inner_texts()
    assert "Shape" in captions
    assert "Its 10 nearest neighbours on the t-SNE map" in captions
    for caption, rows in (("Most similar", 12), ("Its features", 21)):
        table = page.locator("#tables table", has=page.locator("caption", has_text=caption))
        assert table.locator("tbody tr").count() == rows


def test_on_a_phone(shape):
    page = shape(viewport={"width": 390, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    bar = page.locator("#histograms button[data-column='4']")
    bar.scroll_into_view_if_needed()
    bar.click()
    # The shape that is coloured comes into sight.
    eventually(page, lambda: 0 <= box_of(page.locator("#stage"))["y"] < 400)


def percent(share) -> str:
    return f"{100 * share:.{0 if share >= 0.0995 else 1}f}\u00a0%"


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """Share of the pixels that are another colour than before."""
    height, width = np.minimum(before.shape, after.shape)[:2]
    return float((np.abs(before[:height, :width] - after[:height, :width]).max(axis=2) > 12).mean())


def seen(page) -> np.ndarray:
    return pixels_of(page, "#stage canvas")[6:-6, 6:-6]


def test_a_copy_is_called_one(shape, tmp_path):
    report = with_copies(make_report(["ant", "bird"], 6), [(0, 3), (0, 4)])
    # The first copy has the same features to the last digit, the other nearly so.
    report.features.values[3] = report.features.values[0]
    write_site(report, tmp_path / "site")
    page = shape(address=f"{(tmp_path / 'site').as_uri()}/shape.html#id={report.shapes[0].id}")
    cards = {card.locator(".name").inner_text(): card for card in page.locator(".similar").all()}
    same, other, stranger = (cards[report.shapes[row].name] for row in (3, 4, 5))
    assert "A copy of this shape: identical geometry, mirrored." in same.inner_text()
    # Nothing tells the two apart, so nothing is offered to see.
    assert same.locator("button, .alike").count() == 0
    assert "distance" not in same.inner_text()
    assert "A copy of this shape" in other.inner_text()
    assert other.locator("button, .alike").count() == 2
    assert "copy" not in stranger.inner_text()
    other.locator("button").click()
    eventually(page, lambda: "is a copy of" in page.locator("#beside-words").inner_text())
    assert page.locator("#beside-title").inner_text().startswith("Where ")
    page.evaluate(
        "(id) => { location.hash = `id=${id[0]}&beside=${id[1]}`; }",
        [report.shapes[0].id, report.shapes[3].id],
    )
    eventually(page, lambda: "Nothing that is compared" in page.locator("#beside-words").inner_text())
    assert not page.locator("#beside-title").inner_text().startswith("Where ")
    assert page.locator(".difference").count() == 0


def test_where_two_shapes_differ_is_seen_on_both(shape):
    page = shape()
    assert page.locator("#beside").is_hidden()
    first = page.locator(".similar").first
    other = first.locator(".name").inner_text()
    first.locator("button").click()
    eventually(page, lambda: page.locator("#beside-legend").is_visible())
    assert page.locator("#beside-title").inner_text() == f"Where {title(page)} and {other} differ"
    assert page.evaluate("document.activeElement.id") == "beside-title"
    assert page.locator("#beside .stage canvas").count() == 2
    shares = page.locator(".difference span:last-child").all_inner_texts()
    percents = [int(share.split("\u00a0")[0]) for share in shares]
    assert percents == sorted(percents, reverse=True)
    assert abs(sum(percents) - 100) <= len(percents) / 2
    # Of one feature alone the sides make what the feature makes.
    page.locator(".difference").first.click()
    eventually(page, lambda: "within" in address(page) and page.locator("#beside-legend").is_visible())
    share, *sides = [
        int(part.split("\u00a0")[0]) for part in page.locator("#beside-words b").all_inner_texts()
    ]
    assert share == percents[0]
    assert abs(share - sum(sides)) <= 1
    page.locator(".difference").first.click()
    eventually(page, lambda: "within" not in address(page))
    assert "beside" in address(page)
    page.click("#beside-close")
    eventually(page, lambda: "beside" not in address(page))
    assert page.locator("#beside").is_hidden()


def test_the_surface_can_be_taken_away(open_page, reports):
    report = reports("own map")
    shape = report.shapes[7]
    page = open_page("own map", f"shape.html#id={shape.id.replace('/', '%2F')}")
    link = page.get_by_text("Download the surface (glTF)")
    eventually(page, lambda: link.count() == 1)
    assert link.get_attribute("download") == f"{shape.id.replace('/', '-')}.glb"
    assert link.get_attribute("href") == f"gltf/{report.exported.names[7]}"
    page.locator("#maps").get_by_text("drawer").click()
    eventually(
        page, lambda: "The places on the drawer map were brought along" in page.locator("#nh").inner_text()
    )


def test_a_long_text_is_folded_and_an_author_is_told_once(open_page):
    page = open_page("long texts", "shape.html#id=class000/0000")
    folded = page.locator("#facts .long-text")
    assert folded.count() == 1
    assert len(folded.inner_text()) < 200
    folded.get_by_text("Show all").click()
    assert folded.inner_text().count("Lorem ipsum") == 40
    folded.get_by_text("Show less").click()
    assert "Lorem ipsum" in folded.inner_text()
    assert len(folded.inner_text()) < 200
    names = page.locator("#facts dt").all_inner_texts()
    assert names.count("author") == 1
