"""What readers do on the pages, in every browser they have."""

from __future__ import annotations

from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
from waiting import eventually

from shapeviz_report.pages import PAGES

#: Where a map of each page is, on which a box selects.
MAPS = {
    "index.html": "figure[data-slot=large] .surface",
    "features.html": "figure[data-slot=large] .surface",
    "workbench.html": "figure[data-map=original] .surface",
    "bins.html": "#pick-surface",
}
LARGE = MAPS["index.html"]
SHAPE = "class000/0001"
OPENED = {"shape.html": f"#id={SHAPE}", "index.html": f"#select={SHAPE}&open={SHAPE}"}

PLACE = """(selector) => {
  const { left, top, width, height } = document.querySelector(selector).getBoundingClientRect();
  return [left, top, width, height];
}"""


def place(window, selector) -> list[float]:
    """Left, top, width and height of an element on the screen."""
    window.evaluate(
        "(selector) => document.querySelector(selector).scrollIntoView({ block: 'center' })", selector
    )
    return window.evaluate(PLACE, selector)


def box(window, selector, right=0.98, bottom=0.98) -> None:
    """Drag a box over a map from its upper left corner, to shares of its size."""
    left, top, width, height = place(window, selector)
    end = (left + right * width, top + bottom * height)
    window.drag([(left + 0.02 * width, top + 0.02 * height), (left + width / 4, top + height / 4), end])


def named(window, number=None) -> list[str]:
    """The selected shapes as the tray names them, once there are any, or as many."""
    return window.until(
        """(number) => {
            const names = [...document.querySelectorAll("#tray .shape")].map((item) => item.title);
            return names.length > 0 && (number === null || number === names.length) && names;
        }""",
        number,
    )


def address(window) -> dict[str, list[str]]:
    return parse_qs(urlsplit(window.evaluate("() => location.href")).fragment)


def addressed(window, text: str) -> None:
    window.until("(text) => decodeURIComponent(location.hash).includes(text)", text)


def colour(window, selector) -> str:
    return window.evaluate(
        "(selector) => getComputedStyle(document.querySelector(selector)).backgroundColor", selector
    )


def seen(window, selector, rim=6) -> np.ndarray:
    """What is on the screen at an element, without its rim of some pixels; (h, w, 3)."""
    left, top, width, height = map(round, place(window, selector))
    return window.picture()[top + rim : top + height - rim, left + rim : left + width - rim]


def point_at_a_shape(window, selector=LARGE) -> tuple[float, float]:
    """Point with the mouse at the shape that an arrow key goes to."""
    window.evaluate("(selector) => document.querySelector(selector).focus()", selector)
    window.press("ArrowRight")
    left, top, width, height = window.until(
        """(selector) => {
            const ring = document.querySelector(`${selector} .ring.pointed.shown`)?.getBoundingClientRect();
            return ring && [ring.left, ring.top, ring.width, ring.height];
        }""",
        selector,
    )
    window.evaluate("() => document.activeElement.blur()")
    window.point(left + width / 2, top + height / 2)
    return left + width / 2, top + height / 2


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_opens_with_all_that_a_site_can_have(visit, page):
    window = visit("everything", page.file + OPENED.get(page.file, ""))
    assert window.text("nav [aria-current]") == ("Shapes" if page.within else page.title)
    assert window.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
    assert len(window.text("main")) > 100


def test_what_a_link_names_in_vain_is_said_until_the_reader_goes_on(visit):
    window = visit("workbench", "index.html#hide=dragon")
    said = "() => document.getElementById('missing').textContent"
    sentence = "This link names the class “dragon”, which is not in this database."
    assert window.evaluate(said) == sentence
    window.click("#legend button")
    window.until(f"() => ({said})() === ''")
    window.evaluate("() => void (location.hash = 'hide=dragon')")
    window.until(f"(sentence) => ({said})() === sentence", sentence)


@pytest.mark.parametrize("file", MAPS)
def test_a_box_on_a_map_fills_the_tray_and_the_address(visit, file):
    window = visit("bins" if file == "bins.html" else "workbench", file)
    box(window, MAPS[file], right=0.6)
    names = named(window)
    addressed(window, "select")
    again = visit("", "", window.evaluate("() => location.href"))
    assert named(again) == names
    window.click("#tray button", "Clear")
    window.until("() => !location.hash.includes('select') && document.querySelector('#tray .shape') === null")


def test_the_map_stays_where_it_is_while_shapes_are_selected(visit):
    window = visit("plain", "index.html")
    before = window.evaluate(PLACE, LARGE)
    box(window, LARGE)
    named(window, 120)
    assert window.evaluate(PLACE, LARGE) == before
    left, top, width, height = window.evaluate(PLACE, "#tray")
    beneath = [(left + share * width, top + height - rise) for share in (0.02, 0.5, 0.9) for rise in (2, 50)]
    assert window.evaluate(
        "(places) => places.every(([x, y]) => document.elementFromPoint(x, y).closest('#tray'))", beneath
    )


def test_the_mouse_shows_a_shape_and_a_click_opens_it(visit):
    window = visit("plain", "index.html")
    x, y = point_at_a_shape(window)
    name = window.until(
        "() => !document.getElementById('card').hidden && document.querySelector('#card .name').innerText"
    )
    window.drag([(x, y)])
    window.until("(name) => document.querySelector('#detail h2')?.innerText === name", name)
    window.until("() => document.querySelector('#detail img').naturalWidth === 256")
    addressed(window, "open=")
    window.press("Escape")
    window.until("() => document.getElementById('detail').hidden")


def test_lines_lead_from_a_shape_to_those_most_alike(visit):
    window = visit("plain", "index.html#view=class")
    point_at_a_shape(window)
    window.until("() => document.getElementById('card').innerText.includes('most alike')")
    window.until("() => document.querySelector('.ties.kept.shown, .ties.missing.shown') !== null")
    window.evaluate("() => document.getElementById('lines').click()")
    window.until("() => document.querySelector('.ties.shown') === null")
    addressed(window, "lines=none")


def test_keys_go_through_a_map_and_select(visit):
    window = visit("plain", "index.html")
    window.evaluate("(selector) => document.querySelector(selector).focus()", LARGE)
    window.press("ArrowRight", " ")
    named(window, 1)
    window.press("3")
    window.until("() => document.querySelector('figure[data-slot=large]').dataset.view === 'hit'")
    addressed(window, "color=hit")


def test_the_wheel_zooms_about_the_pointer(visit):
    window = visit("plain", "index.html#view=class")
    x, y = point_at_a_shape(window)
    window.wheel(x, y, -400)
    addressed(window, "at=")
    left, top, width, height = window.evaluate(PLACE, f"{LARGE} .ring.pointed")
    assert (left + width / 2, top + height / 2) == pytest.approx((x, y), abs=4)


def test_a_map_is_coloured_by_a_bin_and_the_next_one_too(visit):
    window = visit("searched", "index.html#color=fact:faces")
    window.until("() => document.querySelectorAll('#color-legend .ramp-texts span').length === 3")
    window.evaluate(
        """() => {
            const choice = document.getElementById("color-by");
            choice.value = "bin:";
            choice.dispatchEvent(new Event("change"));
        }"""
    )
    window.until("() => document.activeElement.id === 'color-search'")
    addressed(window, "color=bin:")
    ramp = window.text("#color-legend .ramp-texts")
    colors = window.evaluate("() => location.hash")
    for page in ("workbench.html", "features.html"):
        other = visit("searched", page + colors)
        assert other.text("#color-legend .ramp-texts") == ramp
        assert other.evaluate("() => document.querySelector('figure.map').dataset.view") == "color"


def test_a_click_hides_a_class_and_the_address_keeps_it(visit):
    window = visit("plain", "index.html")
    window.click("#legend button", "kind c")
    addressed(window, "hide=")
    visit("", "", window.evaluate("() => location.href"))
    assert window.text("#legend button[aria-pressed=false] .name") == "kind c"
    box(window, LARGE)
    assert not any(name.startswith("kind c") for name in named(window, 110))


def test_the_selection_goes_along_and_back(visit, follow):
    window = visit("workbench", "index.html")
    box(window, LARGE, right=0.4)
    names = named(window)
    addressed(window, "select")
    for title in ("Features", "Workbench", "Compare", "About", "Shapes"):
        follow("nav a", title)
        if title != "About":
            assert named(window) == names
    window.back()
    window.until("() => document.body.classList.contains('page-about')")
    follow("nav a", "Overview")
    assert named(window) == names


def test_a_changed_address_is_a_changed_page(visit):
    window = visit("workbench", f"index.html#select={SHAPE}")
    named(window, 1)
    window.evaluate("() => { location.hash = 'select=class001/0002&select=class002/0000&map=pca'; }")
    named(window, 2)
    window.until("() => document.querySelector('#methods input:checked').value === 'pca'")
    window.click("#methods label", "UMAP")
    addressed(window, "map=umap")


def test_the_theme_is_chosen_and_stays(visit):
    window = visit("plain", "index.html")
    before = colour(window, "body")
    window.click("#theme")
    window.until("(before) => getComputedStyle(document.body).backgroundColor !== before", before)
    chosen = colour(window, "body")
    visit("plain", "index.html")
    assert colour(window, "body") == chosen
    corner = seen(window, LARGE)[0, 0]
    window.click("#theme")
    window.until("(before) => getComputedStyle(document.body).backgroundColor === before", before)
    eventually(window, lambda: np.abs(seen(window, LARGE)[0, 0] - corner).min() > 100)


def test_the_worker_scores_bins_and_lays_out_a_map(visit):
    window = visit("workbench", "workbench.html")
    window.until("() => !document.querySelector('#bin-add').disabled")
    window.click("#bin-add")
    refined = "figure[data-map=refined] .value"
    window.until("(refined) => document.querySelector(refined)?.innerText > 0", refined)
    window.until("() => document.querySelector('main').ariaBusy !== 'true'")
    value = window.text(refined)
    visit("", "", window.evaluate("() => location.href"))
    window.until(
        "([refined, value]) => document.querySelector(refined)?.innerText === value", [refined, value]
    )


def test_the_gallery_finds_shapes(visit):
    window = visit("museum", "shapes.html")
    assert window.text("#shown") == "144 shapes"
    window.press("/", *"plate 7")
    window.until("() => document.querySelector('#shown').innerText === '13 of 144 shapes'")
    addressed(window, "find=plate+7")
    found = """() => [...document.querySelectorAll(".cell .name")].map((name) => name.innerText)
        .every((name) => name.startsWith("plate"))"""
    window.until(found)
    window.until("() => document.querySelector('.cell img').naturalWidth > 0")
    visit("", "", window.evaluate("() => location.href"))
    assert window.evaluate(found)


def test_the_gallery_scrolls_and_opens_a_shape(visit, follow):
    window = visit("museum", "shapes.html")
    window.evaluate("() => { document.getElementById('scroller').scrollTop = 1e9; }")
    name = window.until(
        """() => [...document.querySelectorAll(".cell .name")].map((name) => name.innerText)
            .find((name) => name.startsWith("table"))"""
    )
    follow(".cell a", name)
    assert window.text("#name") == name
    window.until("() => document.querySelectorAll('.similar .name').length >= 5")


def test_a_shape_is_turned_in_3d(visit):
    window = visit("bins", "bins.html")
    if not window.evaluate("() => document.createElement('canvas').getContext('webgl2') !== null"):
        pytest.skip("this browser has no WebGL 2 here")
    window.click("#show-3d")
    window.until(
        "() => document.querySelector('#stage canvas') && !document.querySelector('#stage[aria-busy]')"
    )

    def is_drawn() -> bool:
        picture = seen(window, "#stage canvas")
        return (np.abs(picture - picture[0, 0]).max(axis=2) > 12).mean() > 0.05

    # A browser may show the canvas some frames after the page has drawn on it.
    eventually(window, is_drawn)
    before = seen(window, "#stage canvas")
    left, top, width, height = place(window, "#stage canvas")
    window.drag([(left + width / 2, top + height / 2), (left + width / 4, top + height / 3)])
    eventually(
        window, lambda: (np.abs(before - seen(window, "#stage canvas")).max(axis=2) > 12).mean() > 0.02
    )


def test_a_page_is_no_wider_than_its_window_whatever_its_choices_say(visit):
    window = visit("bins", f"shape.html#id={SHAPE}")
    window.until("() => document.querySelector('.histogram select option')")
    assert window.evaluate("() => document.documentElement.scrollWidth <= innerWidth")


def test_a_box_looks_ticked_only_when_it_is(visit):
    window = visit("museum", "shapes.html")
    tick = ".facet-values input[type=checkbox]"

    def as_bright_as_paper() -> bool:
        return abs(seen(window, tick, rim=2).mean() - window.picture()[3, 3].mean()) < 40

    for _ in ("light", "dark"):
        eventually(window, as_bright_as_paper)
        window.click(tick)
        eventually(window, lambda: not as_bright_as_paper())
        window.click(tick)
        window.click("#theme")


def test_a_bar_of_the_ranking_chooses_its_subset(visit):
    window = visit("workbench", "features.html")
    left, top, width, height = place(window, "#ranking")
    window.drag([(left + width * 0.9, top + height / 2)])
    addressed(window, "features=")


def test_groups_are_compared_in_sentences(visit):
    window = visit("museum", "compare.html#a=class:ant&b=class:cup")
    window.until("() => document.querySelector('main').innerText.length > 400")
    assert {"ant", "cup"} <= set(window.text("main").split())


def test_tables_open_and_close(visit):
    window = visit("plain", "index.html")
    window.click("#open-tables")
    window.until("() => document.querySelectorAll('dialog[open] tbody tr').length === 132")
    window.press("Escape")
    window.until("() => document.querySelector('dialog[open]') === null")


def test_undo_leads_where_the_way_back_does(visit):
    window = visit("workbench", "workbench.html")

    def at(*held):
        window.until(
            "(held) => ['bins=', 'map='].every((name) => location.hash.includes(name) === held.includes(name))",
            list(held),
        )

    window.until("() => !document.querySelector('#bin-add').disabled")
    window.click("#bin-add")
    at("bins=")
    window.click("#projections label", "UMAP")
    at("bins=", "map=")
    window.click("#undo")
    at("bins=")
    window.back()
    at()
    window.click("#redo")
    at("bins=")
    # An address written by hand is a step too.
    window.evaluate("() => void (location.hash = 'map=umap')")
    window.until("() => document.querySelector('#projections input:checked').value === 'umap'")
    window.click("#undo")
    at("bins=")


def test_the_policy_is_in_force(visit):
    window = visit("plain", "index.html")
    refused = window.evaluate(
        """async () => {
            await fetch("https://example.org/").catch(() => {});
            await new Promise((resolve) => setTimeout(resolve, 100));
            return window.complaints.splice(0);
        }"""
    )
    assert any("connect-src" in complaint for complaint in refused)


def test_links_lead_through_a_site_in_one_file(visit, heard_file, follow):
    window = visit("", "", heard_file("workbench"))
    for title in ("Features", "About", "Overview"):
        follow("nav a", title)
    window.back()
    window.until("() => document.body.classList.contains('page-about')")
    window.back()
    window.until("() => document.body.classList.contains('page-features')")
    window.until("() => 'ready' in document.documentElement.dataset")


def test_the_worker_runs_in_a_site_in_one_file(visit, heard_file):
    window = visit("", "", f"{heard_file('workbench')}#/workbench?select={SHAPE}")
    named(window, 1)
    window.until("() => !document.querySelector('#bin-add').disabled")
    window.click("#bin-add")
    window.until("() => document.querySelector('figure[data-map=refined] .value')?.innerText > 0")


def test_a_figure_is_saved_as_a_drawing_and_as_a_picture(visit):
    window = visit("plain", "index.html")
    window.evaluate(
        """() => {
            const make = URL.createObjectURL.bind(URL);
            window.kept = [];
            URL.createObjectURL = (blob) => (window.kept.push(blob), make(blob));
            for (const button of document.querySelector(".save-figure").querySelectorAll("button")) button.click();
        }"""
    )
    window.until(
        """() => ["image/svg+xml", "image/png"].every((kind) => window.kept.some(({ type }) => type === kind))"""
    )
