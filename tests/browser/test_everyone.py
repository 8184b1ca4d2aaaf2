"""The site for everyone: the keyboard alone, what axe-core finds, narrow windows, large text, forced colours."""

from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from waiting import drawn_again, eventually

from shapeviz_report.pages import PAGES

SCRIPT = (Path(__file__).parent / "everyone.js").read_text(encoding="utf-8")
DESK = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 800}
NARROW = {"width": 320, "height": 640}
#: Half as wide as the window of a desk.
HALF = {"width": 720, "height": 900}
SHAPE = "class000/0000"

#: What the address of a page opens besides what is there at once.
OPENED = {
    "index.html": f"#select={SHAPE}&open={SHAPE}",
    "shapes.html": f"#select={SHAPE}",
    "shape.html": f"#id={SHAPE}",
}
ADDRESSES = [page.file + OPENED.get(page.file, "") for page in PAGES]
ADDRESSES += ["compare.html#view=outliers", "compare.html#view=classes"]


@pytest.fixture(scope="module")
def reader(browser):
    """One window for all pages."""
    context = browser.new_context(viewport=DESK, reduced_motion="reduce")
    yield context.new_page()
    context.close()


def visit(page, site, address):
    # From one address of a page to another, a browser does not load it again.
    page.goto("about:blank")
    page.goto(f"{site.as_uri()}/{address}")
    if not address.startswith("about.html"):
        page.wait_for_selector("html[data-ready]", state="attached")
    drawn_again(page)


def look(page, viewport, theme):
    page.set_viewport_size(viewport)
    page.emulate_media(color_scheme=theme)
    drawn_again(page)


def faults(page, context=None) -> list[str]:
    found = Axe().run(page, context, {"resultTypes": ["violations"], "preload": False}).response["violations"]
    return [
        f"{page.url.split('/')[-1]}, {page.viewport_size['width']} wide, {rule['impact']}: "
        f"{rule['id']} {node['target']} {node['failureSummary']}"
        for rule in found
        for node in rule["nodes"]
    ]


@pytest.fixture(scope="module", params=ADDRESSES)
def page(request, reader, site):
    """Each page in turn with all that a site can have, on a desk and in light; loaded once for all of these tests."""
    look(reader, DESK, "light")
    visit(reader, site("everything"), request.param)
    if request.param.startswith("shape.html"):
        reader.wait_for_selector("#featured:not([hidden])")
    reader.evaluate(SCRIPT)
    return reader


class TestPage:
    def test_tab_reaches_everything_and_shows_where_it_is(self, page):
        stops = []
        for _ in range(400):
            page.keyboard.press("Tab")
            stop = page.evaluate("everyone.focused()")
            # At its end a page gives the focus back to the browser, and then starts again.
            if stop is None:
                continue
            if stop["number"] < len(stops):
                break
            stops.append(stop)
        assert stop["number"] == 0, f"held at {stop['name']}"
        assert [stop["name"] for stop in stops if not stop["rings"]] == []
        assert [stop["name"] for stop in stops if not stop["inSight"]] == []
        assert page.evaluate("everyone.missed()") == []

    def test_axe_finds_no_fault(self, page):
        found = faults(page)
        look(page, PHONE, "dark")
        assert found + faults(page) == []

    def test_charts_have_tables_and_dialogs_no_fault(self, page):
        look(page, DESK, "dark")
        charts = page.locator("main canvas:visible, main .surface:visible").count()
        assert charts == 0 or page.locator("#open-tables:visible").count() == 1
        for opener in page.locator("#open-tables:visible, #open-export:visible").all():
            opener.focus()
            page.keyboard.press("Enter")
            page.wait_for_selector("dialog[open]")
            assert faults(page, "dialog[open]") == []
            if opener.get_attribute("id") == "open-tables":
                assert page.locator("dialog[open] tbody tr").count() > 0
            page.keyboard.press("Escape")
            assert page.locator("dialog[open]").count() == 0
            assert opener.evaluate("(node) => node === document.activeElement")

    def test_it_fits_a_narrow_window_and_large_text(self, page):
        look(page, NARROW, "light")
        assert page.evaluate("document.scrollingElement.scrollWidth") <= NARROW["width"]
        look(page, HALF, "light")
        page.evaluate("everyone.enlargeText(2)")
        drawn_again(page)
        assert page.evaluate("document.scrollingElement.scrollWidth") <= HALF["width"]


@pytest.mark.parametrize("viewport", [DESK, PHONE], ids=["desk", "phone"])
def test_long_names_stay_in_their_boxes_and_keep_their_beginning(reader, site, viewport):
    found = {}
    for address in ADDRESSES:
        look(reader, viewport, "light")
        visit(reader, site("long names"), address.replace(SHAPE, "class002/0000"))
        reader.evaluate(SCRIPT)
        found[address] = reader.evaluate("everyone.cut()")
    assert {address: names for address, names in found.items() if names} == {}


@pytest.mark.parametrize("name", ["one shape", "no labels"])
def test_axe_finds_no_fault_where_there_is_little_to_show(reader, site, name):
    found = []
    for address in ADDRESSES:
        look(reader, PHONE, "dark")
        visit(reader, site(name), address)
        found += faults(reader)
    assert found == []


def test_the_skip_link_leads_past_the_masthead(reader, site):
    look(reader, DESK, "light")
    visit(reader, site("everything"), "index.html")
    reader.keyboard.press("Tab")
    reader.keyboard.press("Enter")
    reader.keyboard.press("Tab")
    assert reader.evaluate("document.querySelector('main').contains(document.activeElement)")


def test_escape_closes_what_enter_opened_on_a_map(reader, site):
    look(reader, DESK, "light")
    visit(reader, site("everything"), "index.html")
    reader.focus("[data-slot=large] .surface")
    reader.keyboard.press("ArrowRight")
    reader.keyboard.press("Enter")
    reader.wait_for_selector("#detail:visible")
    reader.keyboard.press("Escape")
    eventually(reader, lambda: reader.locator("#detail").is_hidden())
    assert reader.evaluate("document.activeElement.matches('[data-slot=large] .surface')")


def test_forced_colors_still_tell_what_is_chosen_and_what_a_color_says(browser, site):
    context = browser.new_context(forced_colors="active", reduced_motion="reduce")
    page = context.new_page()
    visit(page, site("everything"), "index.html")
    ground = "(node) => getComputedStyle(node).backgroundColor"
    chosen = page.locator("#methods input:checked + span").evaluate(ground)
    assert chosen != page.locator("#methods input:not(:checked) + span").first.evaluate(ground)
    current = page.locator("nav [aria-current]").evaluate(ground)
    assert current != page.locator("nav a:not([aria-current])").first.evaluate(ground)
    fills = page.locator("#legend .swatch path").evaluate_all(
        "(marks) => marks.map((mark) => getComputedStyle(mark).fill)"
    )
    assert len(set(fills)) == len(fills)
    context.close()


@pytest.mark.parametrize("file", ["index.html", "bins.html#shape=most", "features.html", "workbench.html"])
def test_what_is_chosen_has_the_colors_of_the_reader(browser, site, file):
    context = browser.new_context(forced_colors="active", reduced_motion="reduce")
    page = context.new_page()
    visit(page, site("everything"), file)
    colours = page.evaluate(
        """() => {
            const colours = (node) => {
                const { color, backgroundColor } = getComputedStyle(node);
                return `${color} on ${backgroundColor}`;
            };
            const probe = document.createElement("i");
            Object.assign(probe.style, { color: "HighlightText", background: "Highlight", forcedColorAdjust: "none" });
            document.body.append(probe);
            const chosen = [...document.querySelectorAll("nav [aria-current], [aria-pressed=true]")];
            return [colours(probe), chosen.filter((node) => node.checkVisibility()).map(colours)];
        }"""
    )
    assert set(colours[1]) == {colours[0]}
    context.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_text_is_read_in_forced_colors(browser, site, theme):
    context = browser.new_context(
        forced_colors="active", color_scheme=theme, viewport=DESK, reduced_motion="reduce"
    )
    page = context.new_page()
    found = {}
    for address in ADDRESSES:
        visit(page, site("everything"), address)
        page.evaluate(SCRIPT)
        found[address] = page.evaluate("everyone.faint()")
    context.close()
    assert {address: texts for address, texts in found.items() if texts} == {}
