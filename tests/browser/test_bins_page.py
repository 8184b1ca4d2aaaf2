"""The Bins page as a reader uses it: from file://, with real 3D."""

import re
import shutil

import numpy as np
import pytest
from playwright.sync_api import expect
from screenshots import pixels_of
from waiting import box_of, drawn_again, eventually


@pytest.fixture
def bins(open_page):
    def open_(name="bins", hash_="", **options):
        return open_page(name, f"bins.html{hash_}", **options)

    return open_


def shown(page) -> None:
    """Wait until the shape that was asked for is there and drawn."""
    eventually(page, lambda: page.locator("#stage canvas").count() == 1)
    eventually(page, lambda: page.locator("#stage[aria-busy]").count() == 0)
    drawn_again(page)


def turn_on(page) -> None:
    page.click("#show-3d")
    shown(page)


def seen(page) -> np.ndarray:
    """What the 3D view shows, without its rim, where the mark of the focus lies; (h, w, 3)."""
    return pixels_of(page, "#stage canvas")[6:-6, 6:-6]


def change(before: np.ndarray, after: np.ndarray) -> float:
    """Share of the pixels that are another colour than before."""
    return float((np.abs(before - after).max(axis=2) > 12).mean())


def find(page, field, text) -> None:
    page.fill(field, text)
    page.press(field, "Enter")
    drawn_again(page)


def point_at_another(page, surface, kind) -> None:
    """Move the mouse over a map until it is on a shape of a kind."""
    page.locator(surface).scroll_into_view_if_needed()
    box = box_of(page.locator(surface))
    card = page.locator("#content > .card:not(.bin-card)")
    for x in np.linspace(8, box["width"] - 8, 24):
        for y in np.linspace(8, box["height"] - 8, 12):
            page.mouse.move(box["x"] + x, box["y"] + y)
            if card.is_visible() and kind in card.inner_text():
                return
    raise AssertionError(f"no shape of {kind} is on the map")


def address(page) -> str:
    return page.evaluate("location.hash")


def test_every_class_has_a_map_of_few_bins(bins):
    page = bins()
    cards = page.locator(".class-card")
    assert cards.locator("h3").all_inner_texts() == ["ant", "bird", "cup", "fish"]
    for number in (1, 2):
        page.locator(f"#sizes input[value='{number}']").check(force=True)
        assert [card.locator(".bin-chip").count() for card in cards.all()] == [number] * 4
        assert all(re.fullmatch(r"[01]\.\d{3}", text) for text in cards.locator(".nh b").all_inner_texts())
    # A name says what it is where the pointer or the keyboard is.
    chip = cards.nth(1).locator(".bin-chip").first
    chip.hover()
    card = page.locator("#content > .bin-card")
    name = chip.locator("bdi").inner_text()
    assert card.locator(".name b").inner_text() == name
    assert card.locator(".in-words").inner_text() == chip.locator(".in-words").inner_text() != ""
    assert card.inner_text().find("What share of the surface") >= 0
    # The class that the bin separates stands above the others.
    assert card.locator(".names li").first.inner_text() == "bird"
    chip.click()
    assert page.locator("#bin-words h3 b").inner_text() == name
    assert "of=bird" in address(page)
    eventually(
        page, lambda: page.evaluate("document.getElementById('look').getBoundingClientRect().top") < 100
    )


def test_the_way_to_all_classes_goes_step_by_step(bins):
    page = bins()
    steps = page.locator(".path-step")
    last = steps.count()
    assert last > 1
    assert page.locator("#step-title").inner_text() == f"Step {last} of {last}"
    figures = steps.locator("b").all_inner_texts()
    assert page.locator("#step-nh .value").inner_text() == figures[-1]
    steps.nth(last - 1).focus()
    page.keyboard.press("Home")
    assert page.locator("#step-title").inner_text() == f"Step 1 of {last}"
    assert page.locator("#step-nh .value").inner_text() == figures[0]
    assert page.locator("#step-bins .bin-chip").count() == 1
    page.keyboard.press("ArrowRight")
    assert page.evaluate("document.activeElement.dataset.step") == "1"
    eventually(page, lambda: "step=2" in address(page))
    # Who asks for less movement is not played to.
    assert page.locator("#play").is_hidden()


def test_the_way_plays_and_stops(bins):
    page = bins(reduced_motion="no-preference")
    last = page.locator(".path-step").count()
    title, play = page.locator("#step-title"), page.locator("#play")
    page.locator(".path-step").nth(last - 2).click()
    assert title.inner_text() == f"Step {last - 1} of {last}"
    play.click()
    assert play.inner_text() == "Pause"
    eventually(page, lambda: play.inner_text() == "Play")
    assert title.inner_text() == f"Step {last} of {last}"
    # From the end it plays from the beginning, until a step is chosen.
    play.click()
    assert title.inner_text() == f"Step 1 of {last}"
    page.locator(".path-step").nth(1).click()
    assert play.inner_text() == "Play"
    assert title.inner_text() == f"Step 2 of {last}"
    # Escape stops it too, wherever the reader is, and drops no selection by the same press.
    page.evaluate("location.hash = 'select=class000/0001'")
    tray = page.locator("#tray .shape")
    eventually(page, lambda: tray.count() == 1)
    page.locator(".path-step").nth(0).click()
    play.click()
    page.focus("#content")
    page.keyboard.press("Escape")
    assert play.inner_text() == "Play"
    assert tray.count() == 1
    page.keyboard.press("Escape")
    eventually(page, lambda: tray.count() == 0)


def test_a_step_opens_in_the_workbench(bins):
    page = bins()
    names = page.locator("#step-bins .bin-chip").all_inner_texts()
    page.click("#step-open")
    page.wait_for_selector("html[data-ready]", state="attached")
    eventually(page, lambda: page.locator("main[aria-busy=true]").count() == 0)
    assert page.locator("figure[data-map=refined] .made-from").inner_text() == (
        "1 bin" if len(names) == 1 else f"{len(names)} bins"
    )


def test_a_bin_is_told_and_pictured_on_a_contrast(bins, site):
    page = bins()
    words = page.locator("#bin-words")
    assert "What share of the surface" in words.locator(".exactly").text_content()
    assert re.search(r"Typical of \w+ is [\d.<]+\u00a0%", words.locator(".who").inner_text())
    pictures = page.locator(".painting")
    assert pictures.count() == 2
    shapes = pictures.evaluate_all("nodes => nodes.map((node) => Number(node.dataset.shape))")
    assert shapes[0] // 8 != shapes[1] // 8
    for image in pictures.locator("img").all():
        assert (site("bins") / image.get_attribute("src")).is_file()
        assert image.evaluate("node => node.decode().then(() => node.naturalWidth)") > 0
    # Ten colours, one of them the bin's own.
    assert page.locator("#legend .ten i").count() == 10
    assert page.locator("#legend .ten .own").count() == 1


def test_clusters_are_named_within_sentences_as_the_shapes_they_hold(open_page):
    page = open_page("clusters searched", "bins.html")
    said = page.locator(".who").first
    expect(said).to_contain_text(re.compile(r"Typical of those \W*like class\d+/\d+\W* is"))
    assert not re.search(r"\b(of|on|in) \W*like ", said.inner_text())


def test_a_bin_is_found_by_what_one_sees(bins):
    page = bins()
    # All bins of this site's curvature are bumps; the last one holds the strongest.
    page.fill("#bin-search", "round")
    line = page.locator("#bin-found li").first
    assert line.locator("b").inner_text() == "Gc:10"
    # Its plain name stands beside it.
    assert line.locator(".in-words").inner_text().startswith("bump over ")
    page.press("#bin-search", "Enter")
    assert page.locator("#bin-words h3 b").inner_text() == "Gc:10"


def test_colours_appear_and_change_with_bin_and_reading(bins):
    page = bins()
    assert not [url for url in page.watch.requests if "/models/" in url]
    find(page, "#bin-search", "Gc:3")
    turn_on(page)
    assert len([url for url in page.watch.requests if "/models/" in url]) == 1
    values = seen(page)
    assert len(np.unique(values.reshape(-1, 3) // 32, axis=0)) > 12
    page.locator("#readings input[value=inside]").check(force=True)
    shown(page)
    inside = seen(page)
    assert change(values, inside) > 0.1
    # The model's bins are layers from bottom to top: what falls into a higher bin lies higher.
    heights = []
    for name in ("Gc:3", "Gc:8"):
        find(page, "#bin-search", name)
        shown(page)
        red, green, blue = seen(page).transpose(2, 0, 1)
        marked = (red > 1.6 * green) & (red > 2 * blue)
        assert 0.005 < marked.mean() < 0.3
        heights.append(-np.nonzero(marked)[0].mean())
    assert heights[1] > heights[0] + 20
    assert len([url for url in page.watch.requests if "/models/" in url]) <= 3


def test_a_shape_is_turned_by_mouse_and_keys(bins):
    page = bins()
    turn_on(page)
    assert page.evaluate("document.activeElement.tagName") == "CANVAS"
    first = seen(page)
    back = page.locator("#stage .back")
    assert back.is_hidden()
    for key in ("ArrowDown", "ArrowDown", "ArrowDown"):
        page.keyboard.press(key)
    drawn_again(page)
    by_keys = seen(page)
    assert change(first, by_keys) > 0.03
    page.keyboard.press("0")
    drawn_again(page)
    assert change(first, seen(page)) == 0
    box = box_of(page.locator("#stage canvas"))
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y + 90, steps=4)
    page.mouse.up()
    drawn_again(page)
    assert change(first, seen(page)) > 0.03
    back.click()
    drawn_again(page)
    assert change(first, seen(page)) == 0


def test_the_shape_is_chosen_by_name_by_its_share_and_on_the_map(bins):
    page = bins()
    name = page.locator("#turn-name")
    find(page, "#shape-search", "cup 3")
    assert "cup 3" in name.inner_text()
    shares = {}
    for end in ("most", "least"):
        page.click(f"#{end}-of-it")
        shares[end] = float(re.search(r"([\d.]+)\u00a0%", name.inner_text())[1])
    assert shares["most"] > shares["least"]
    assert "shape=least" in address(page)
    find(page, "#shape-search", "cup 3")
    page.locator(".painting").nth(1).click()
    assert page.locator(".painting").nth(1).locator("bdi").inner_text() in name.inner_text()
    before = name.inner_text()
    point_at_another(page, "#pick-surface", "bird" if "fish" in before else "fish")
    page.mouse.down()
    page.mouse.up()
    assert name.inner_text() != before
    again = bins(hash_=address(page))
    assert again.locator("#turn-name").inner_text() == name.inner_text()


def test_what_cannot_be_shown_is_said(bins, site, tmp_path):
    # A site whose 3D data was lost on the way.
    folder = tmp_path / "moved"
    shutil.copytree(site("bins"), folder, ignore=shutil.ignore_patterns("models"))
    page = bins(address=f"{folder.as_uri()}/bins.html#bin=own[1]")
    assert page.locator("#paintings").inner_text() == (
        "A value of the whole shape: it lies on no part of the surface, so nothing is coloured."
    )
    # There is nothing to choose of colours where there are none.
    assert page.locator("#readings").is_hidden()
    assert page.locator("#legend .ten").count() == 0
    find(page, "#bin-search", "Gc:1")
    assert page.locator("#readings").is_visible()
    find(page, "#shape-search", "fish 5")
    page.click("#show-3d")
    eventually(page, lambda: page.locator("#stage .empty").count() == 1)
    assert page.locator("#stage .empty").inner_text() == "There is no 3D data of fish 5 in this site."
    complaints = page.watch.complaints
    complaints[:] = [line for line in complaints if "ERR_FILE_NOT_FOUND" not in line]


def test_a_browser_without_3d_says_so(browser, site):
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    without = browser.browser_type.launch(
        executable_path=chromium, args=["--no-sandbox", "--disable-3d-apis"]
    )
    page = without.new_page()
    page.goto(f"{site('bins').as_uri()}/bins.html")
    page.wait_for_selector("#stage .empty")
    assert "WebGL 2 is missing" in page.locator("#stage .empty").inner_text()
    assert page.locator("#show-3d").count() == 0
    without.close()


@pytest.mark.parametrize("name", ["no labels", "one shape", "nasty", "one class"])
def test_without_a_search_or_3d_data_every_bin_can_still_be_read(bins, name):
    page = bins(name)
    assert page.locator(".bins-page > .notice").is_visible()
    assert page.locator("#path").count() == 0
    find(page, "#bin-search", "Gc:4")
    assert page.locator("#bin-words h3 b").inner_text() == "Gc:4"
    assert "--no-meshes" in page.locator("#stage .empty").inner_text()


@pytest.mark.parametrize("width", [390, 1000, 1280])
def test_names_of_classes_have_room_beside_their_bars(bins, width):
    page = bins(viewport={"width": width, "height": 720})
    room = page.locator("#bin-words .of-bin .names").first.evaluate("node => node.clientWidth")
    assert room >= 72  # "airplane" with its mark


def test_bins_of_a_step_have_room_whatever_is_told_above_them(bins):
    page = bins(viewport={"width": 1440, "height": 900})
    page.evaluate("document.querySelector('.worth').textContent = 'many words '.repeat(200)")
    assert page.locator(".step-words").evaluate("node => node.clientHeight") >= 240
    assert page.locator("#step-bins .bin-chip").first.is_visible()


@pytest.mark.parametrize("width", [390, 1280])
def test_nothing_is_wider_than_the_window(bins, width):
    page = bins(viewport={"width": width, "height": 720})
    turn_on(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_the_figures_are_there_as_tables(bins):
    page = bins()
    page.click("#open-tables")
    captions = page.locator("#tables caption").all_inner_texts()
    assert captions[:3] == [
        "Each class from the rest",
        "All classes from each other, step by step",
        "What such a choice is worth on shapes it never saw",
    ]
    shapes = page.locator("#tables table").last.locator("tbody tr")
    amounts = [float(text.split("\u00a0")[0]) for text in shapes.locator("td:last-child").all_inner_texts()]
    assert len(amounts) == 32
    assert amounts == sorted(amounts, reverse=True)
    rows = page.locator("#tables table").nth(1).locator("tbody tr")
    assert rows.count() == page.locator(".path-step").count()
