"""A selection is the same on every page: in the maps, in the tray, in the address, and on the way to another page."""

import csv
import json
import re
from urllib.parse import parse_qs, unquote_plus, urlsplit

import pytest
from waiting import box_of, drawn_again, eventually, rested

#: Where a map of each page is, on which a box selects.
MAPS = {
    "index.html": "figure[data-slot=large] .surface",
    "features.html": "figure[data-slot=large] .surface",
    "workbench.html": "figure[data-map=original] .surface",
    "bins.html": "#pick-surface",
}

SITE_OF = {"bins.html": "bins"}


def box(page, selector, left=0.02, top=0.02, right=0.98, bottom=0.98) -> None:
    """Drag a box over a part of a map, given in shares of its size."""
    page.locator(selector).scroll_into_view_if_needed()
    place = box_of(page.locator(selector))
    page.mouse.move(place["x"] + left * place["width"], place["y"] + top * place["height"])
    page.mouse.down()
    page.mouse.move(place["x"] + right * place["width"], place["y"] + bottom * place["height"], steps=4)
    page.mouse.up()


def counted(page) -> int:
    """The number of selected shapes as the tray says it."""
    drawn_again(page)
    if not page.locator("#tray h2").is_visible():
        return 0
    return int(re.sub(r"\D", "", page.inner_text("#tray h2")))


def named(page) -> list[str]:
    """The selected shapes as the tray names them."""
    drawn_again(page)
    return page.locator("#tray .shape").evaluate_all("items => items.map((item) => item.title)")


def in_address(page) -> list[str]:
    """The shapes that the address of a page names."""
    return parse_qs(urlsplit(page.url).fragment).get("select", [])


def follow(page, click) -> None:
    """Follow a link to another page, and wait until this is drawn."""
    with page.expect_navigation():
        click()
    if "about.html" not in page.url:
        page.wait_for_selector("html[data-ready]", state="attached")


def go(page, title: str) -> None:
    follow(page, lambda: page.click(f"nav[aria-label=Pages] a:text-is('{title}')"))


@pytest.mark.parametrize("file", MAPS)
def test_a_box_on_a_map_fills_the_tray_and_the_address(open_page, file):
    page = open_page(SITE_OF.get(file, "workbench"), file)
    assert counted(page) == 0
    box(page, MAPS[file], right=0.5)
    few = counted(page)
    assert 0 < few < 80
    assert len(named(page)) == few
    eventually(page, lambda: "select" in page.url)
    of_few = page.url
    box(page, MAPS[file])
    everyone = counted(page)
    assert everyone > few
    eventually(page, lambda: page.url != of_few)
    # On its way to the end of the drag the address may rest at fewer shapes.
    eventually(page, lambda: named(open_page("", address=page.url)) == named(page))
    page.click("#tray >> text=Clear")
    assert counted(page) == 0
    eventually(page, lambda: "select" not in page.url)


@pytest.mark.parametrize("file", MAPS)
def test_shift_adds_one_shape_and_a_click_beside_all_drops_the_selection(open_page, file):
    page = open_page(SITE_OF.get(file, "workbench"), f"{file}#select=class000%2F0001")
    page.locator(MAPS[file]).scroll_into_view_if_needed()
    assert counted(page) == 1
    place = box_of(page.locator(MAPS[file]))
    # Along a line across the map there is a shape somewhere.
    for share in range(4, 97):
        page.mouse.move(place["x"] + place["width"] * share / 100, place["y"] + place["height"] * 0.5)
        if page.locator(f"{MAPS[file]}.on-shape").count():
            break
    page.keyboard.down("Shift")
    page.mouse.down()
    page.mouse.up()
    page.keyboard.up("Shift")
    eventually(page, lambda: counted(page) in (0, 2))
    assert counted(page) == 2
    page.mouse.click(place["x"] + 3, place["y"] + 3)
    assert counted(page) == 0


@pytest.mark.parametrize("file", MAPS)
def test_escape_gives_up_a_box_and_leaves_the_selection_as_it_was(open_page, file):
    page = open_page(SITE_OF.get(file, "workbench"), f"{file}#select=class000%2F0001")
    page.locator(MAPS[file]).scroll_into_view_if_needed()
    place = box_of(page.locator(MAPS[file]))
    page.mouse.move(place["x"] + 3, place["y"] + 3)
    page.mouse.down()
    page.mouse.move(place["x"] + place["width"] * 0.9, place["y"] + place["height"] * 0.9, steps=4)
    shown = page.locator(f"{MAPS[file]} .brush.shown")
    assert shown.count() == 1
    page.keyboard.press("Escape")
    assert shown.count() == 0
    # What is left of the drag draws nothing, and is no click beside all shapes.
    page.mouse.move(place["x"] + place["width"] * 0.8, place["y"] + place["height"] * 0.5, steps=4)
    page.mouse.up()
    assert shown.count() == 0
    assert counted(page) == 1


def test_the_selection_goes_along_through_the_whole_site(open_page):
    page = open_page("workbench", "index.html")
    box(page, MAPS["index.html"], right=0.4)
    names = named(page)
    assert names
    for title in ("Features", "Workbench", "Bins", "About", "Shapes", "Compare", "Features", "Overview"):
        go(page, title)
        if title != "About":
            assert named(page) == names
            assert len(in_address(page)) == len(names)


def test_the_selection_goes_along_by_keyboard(open_page):
    page = open_page("workbench", "index.html#select=class000%2F0001")
    page.focus("nav[aria-label=Pages] a:text-is('Workbench')")
    follow(page, lambda: page.keyboard.press("Enter"))
    assert named(page) == ["kind a 1, kind a"]


def test_a_link_keeps_a_selection_of_its_own(open_page):
    page = open_page("workbench", "workbench.html#select=class000%2F0001")
    page.evaluate(
        """() => {
            const link = document.createElement("a");
            link.href = "index.html#select=class001%2F0002&view=hit";
            link.id = "other-shape";
            link.textContent = "another";
            document.querySelector(".history").append(link);
        }"""
    )
    follow(page, lambda: page.click("#other-shape"))
    assert named(page) == ["kind b 2, kind b"]
    assert page.locator("figure[data-slot=large]").get_attribute("data-view") == "hit"


def test_many_shapes_go_along_too(open_page):
    page = open_page("workbench", "index.html")
    box(page, MAPS["index.html"])
    assert counted(page) == 80
    go(page, "Workbench")
    assert counted(page) == 80
    go(page, "About")
    go(page, "Features")
    assert counted(page) == 80


def test_the_tray_leads_to_the_other_pages_with_its_shapes(open_page):
    page = open_page("workbench", "workbench.html#select=class000%2F0001&select=class002%2F0003")
    names = page.locator("#tray a").all_inner_texts()
    assert names == ["Open in Shapes", "Show on the map", "Compare with the rest"]
    compared = parse_qs(urlsplit(page.locator("#tray a").nth(2).get_attribute("href")).fragment)
    assert (compared["a"], compared["b"]) == (["shapes"], ["rest"])
    assert compared["a-select"] == ["class000/0001", "class002/0003"]
    follow(page, lambda: page.click("text=Show on the map"))
    assert in_address(page) == ["class000/0001", "class002/0003"]
    assert named(page) == ["kind a 1, kind a", "kind c 3, kind c"]
    assert "Show on the map" not in page.inner_text("#tray")
    follow(page, lambda: page.click("text=Open in Shapes"))
    assert page.url.split("/")[-1].startswith("shapes.html#")
    assert in_address(page) == ["class000/0001", "class002/0003"]


@pytest.mark.parametrize("file", MAPS)
def test_every_page_exports_the_same_files(open_page, site, tmp_path, file):
    where = SITE_OF.get(file, "workbench")
    page = open_page(where, f"{file}#select=class002%2F0003&select=class000%2F0001")
    with page.expect_download() as saved:
        page.click("#tray >> text=CSV")
    saved.value.save_as(tmp_path / "selection.csv")
    with (tmp_path / "selection.csv").open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["id"] for row in rows] == ["class000/0001", "class002/0003"]
    summary = json.loads((site(where) / "data" / "summary.json").read_text())
    methods = list(summary["projections"])
    assert list(rows[0]) == [
        "id",
        "name",
        "class",
        *(f"{what}:{method}" for method in methods for what in ("nh", "nh_max")),
    ]
    with (site(where) / "data" / "shapes.csv").open(newline="", encoding="utf-8") as stream:
        known = {row["id"]: row for row in csv.DictReader(stream)}
    assert [row["name"] for row in rows] == [known[row["id"]]["name"] for row in rows]
    with page.expect_download() as saved:
        page.click("#tray >> text=JSON")
    saved.value.save_as(tmp_path / "selection.json")
    shapes = json.loads((tmp_path / "selection.json").read_text(encoding="utf-8"))["shapes"]
    assert [(shape["id"], shape["name"], shape["class"]) for shape in shapes] == [
        (row["id"], row["name"], row["class"]) for row in rows
    ]


@pytest.mark.parametrize("file", MAPS)
def test_a_changed_address_is_a_changed_selection(open_page, file):
    page = open_page(SITE_OF.get(file, "workbench"), f"{file}#select=class000%2F0001")
    page.evaluate("location.hash = 'select=class001/0002&select=class002/0000'")
    eventually(page, lambda: counted(page) == 2)
    page.evaluate("location.hash = 'select=nobody'")
    eventually(page, lambda: counted(page) == 0)
    # Bits that belong to another database, or are none at all.
    page.evaluate("location.hash = 'selected=abc.a'")
    drawn_again(page)
    assert counted(page) == 0


def test_an_address_of_nonsense_opens_the_page(open_page, site):
    page = open_page("workbench", "index.html")
    box(page, MAPS["index.html"])
    eventually(page, lambda: "selected=" in page.url)
    mark = parse_qs(urlsplit(page.url).fragment)["selected"][0].split(".")[0]
    other = open_page("workbench", f"index.html#selected={mark}.A")
    assert counted(other) == 0


def test_the_brush_on_the_workbench_moves_nothing_below_it(open_page):
    page = open_page("workbench", "workbench.html")
    surface = page.locator(MAPS["workbench.html"])
    before = box_of(surface)
    page.mouse.move(before["x"] + 5, before["y"] + 5)
    page.mouse.down()
    page.mouse.move(before["x"] + before["width"] - 5, before["y"] + before["height"] - 5, steps=4)
    drawn_again(page)
    assert box_of(surface) == before
    assert page.inner_text("#picked") == "80 shapes selected"
    page.mouse.up()
    assert counted(page) == 80


@pytest.mark.parametrize("file", ["index.html", "shapes.html", "workbench.html"])
def test_on_a_small_desk_all_that_the_tray_offers_lies_in_it(open_page, file):
    page = open_page("workbench", f"{file}#select=class000%2F0001", viewport={"width": 1000, "height": 700})
    tray = box_of(page.locator("#tray"))
    for way in page.locator(".tray-ways > *").all():
        place = box_of(way)
        # What is clicked reaches as far beyond as the space around its words.
        assert place["x"] + place["width"] <= tray["x"] + tray["width"] + 8
        assert place["y"] + place["height"] <= tray["y"] + tray["height"]


def test_shapes_that_a_search_left_out_stay_selected_without_a_place(open_page):
    page = open_page("sampled", "features.html")
    box(page, MAPS["features.html"])
    on_the_map = counted(page)
    assert on_the_map == 24
    ids = [f"class{group:03}/{index:04}" for group in range(2) for index in range(18)]
    address = "&".join(f"select={name}" for name in ids)
    all_of_them = open_page("sampled", f"features.html#{address}")
    assert counted(all_of_them) == 36
    go(all_of_them, "Overview")
    assert counted(all_of_them) == 36


def test_without_labels_the_tray_says_no_classes(open_page):
    page = open_page("no labels", "workbench.html#select=class000%2F0001")
    assert named(page) == ["shape 1"]
    assert page.locator("#tray .census").count() == 0


LARGE = MAPS["index.html"]
LEFT_HALF = [(0.02, 0.02), (0.5, 0.02), (0.5, 0.98), (0.02, 0.98)]
UPPER_LEFT = [(0.02, 0.02), (0.98, 0.02), (0.02, 0.98)]


def draw(page, places, selector=LARGE, *, keys=()) -> None:
    """Drag along places of a map, given in shares of its size, with keys held down."""
    box = box_of(page.locator(selector))
    (x, y), *rest = [(box["x"] + box["width"] * x, box["y"] + box["height"] * y) for x, y in places]
    for key in keys:
        page.keyboard.down(key)
    page.mouse.move(x, y)
    page.mouse.down()
    for x, y in rest:
        page.mouse.move(x, y, steps=4)
    page.mouse.up()
    for key in keys:
        page.keyboard.up(key)


def where_all_is(page) -> list[str]:
    """Where names and the chart are: what would tell that the map has moved."""
    return page.evaluate(
        """() => [...document.querySelectorAll("figure[data-slot=large] .labels > g")]
            .map((name) => name.getAttribute("transform"))"""
    )


def on_a_shape(page, selector=LARGE) -> tuple[float, float]:
    """A place of the screen that is on a shape."""
    box = box_of(page.locator(selector))
    for share in range(4, 97):
        x, y = box["x"] + box["width"] * share / 100, box["y"] + box["height"] * 0.5
        page.mouse.move(x, y)
        if page.locator(f"{selector}.on-shape").count():
            return x, y
    raise AssertionError("no shape on the line")


def test_a_lasso_selects_what_it_goes_round_and_the_map_stays_where_it_is(open_page):
    page = open_page("workbench", "index.html")
    page.wait_for_selector(f"{LARGE} .labels > g")
    before = where_all_is(page)
    draw(page, UPPER_LEFT, keys=["Control"])
    by_key = named(page)
    page.click("#drag label:has-text('Lasso')")
    draw(page, UPPER_LEFT)
    assert named(page) == by_key
    assert 0 < counted(page) < 80
    page.click("#drag label:has-text('Box')")
    draw(page, [(0.02, 0.02), (0.98, 0.98)])
    assert set(by_key) < set(named(page))
    rested(page, 400)
    assert where_all_is(page) == before


@pytest.mark.parametrize("file", MAPS)
@pytest.mark.parametrize("kind", ["box", "lasso"])
def test_shift_adds_an_area_and_alt_takes_it_away(open_page, file, kind):
    page = open_page(SITE_OF.get(file, "workbench"), file)
    selector = MAPS[file]
    page.locator(selector).scroll_into_view_if_needed()
    own = ["Control"] if kind == "lasso" else []
    left = [(0.01, 0.01), (0.5, 0.01), (0.5, 0.99), (0.01, 0.99)]
    right = [(0.5, 0.01), (0.99, 0.01), (0.99, 0.99), (0.5, 0.99)]
    if kind == "box":
        left, right = left[::2], [right[0], right[2]]
    draw(page, left, selector, keys=own)
    at_left = counted(page)
    draw(page, right, selector, keys=own)
    at_right = counted(page)
    assert at_left > 0
    assert at_right > 0
    draw(page, left, selector, keys=[*own, "Shift"])
    everyone = counted(page)
    assert everyone > max(at_left, at_right)
    draw(page, left, selector, keys=[*own, "Alt"])
    assert counted(page) == everyone - at_left


@pytest.mark.parametrize("file", ["index.html", "bins.html"])
def test_a_click_with_alt_takes_a_shape_out_and_one_beside_all_does_nothing(open_page, file):
    page = open_page(SITE_OF.get(file, "workbench"), file)
    selector = MAPS[file]
    page.locator(selector).scroll_into_view_if_needed()
    draw(page, [(0.01, 0.01), (0.99, 0.99)], selector)
    everyone = counted(page)
    x, y = on_a_shape(page, selector)
    page.keyboard.down("Alt")
    page.mouse.click(x, y)
    assert counted(page) == everyone - 1
    box = box_of(page.locator(selector))
    page.mouse.click(box["x"] + 3, box["y"] + 3)
    assert counted(page) == everyone - 1
    page.keyboard.up("Alt")


def test_a_double_click_zooms_and_keeps_the_selection(open_page):
    page = open_page("workbench", "index.html#select=class000%2F0001&select=class002%2F0003")
    box = box_of(page.locator(LARGE))
    page.mouse.dblclick(box["x"] + 4, box["y"] + 4)
    page.wait_for_selector("body[data-zoomed]")
    assert counted(page) == 2
    page.keyboard.press("0")
    page.wait_for_selector("body:not([data-zoomed])")
    eventually(page, lambda: "at=" not in page.url)
    page.focus(LARGE)
    page.keyboard.press("z")
    eventually(page, lambda: "at=" in page.url)
    by_key = parse_qs(urlsplit(page.url).fragment)["at"]
    page.keyboard.press("0")
    eventually(page, lambda: "at=" not in page.url)
    page.click("#tray >> text=Zoom to them")
    eventually(page, lambda: "at=" in page.url)
    assert parse_qs(urlsplit(page.url).fragment)["at"] == by_key
    assert float(by_key[0].split(",")[2]) > 1


def test_keys_select_a_shape_a_box_and_all(open_page):
    page = open_page("workbench", "index.html")
    page.focus(LARGE)
    page.keyboard.press("ArrowRight")
    page.keyboard.press(" ")
    assert counted(page) == 1
    for _ in range(6):
        page.keyboard.press("ArrowRight")
        page.keyboard.press("ArrowUp")
    page.keyboard.press("Shift+ ")
    in_box = counted(page)
    assert in_box > 2
    page.keyboard.press("Control+a")
    assert counted(page) == 80
    page.keyboard.press("Shift+Delete")
    assert counted(page) == 79


def test_two_groups_are_taken_from_two_pages_into_compare(open_page):
    page = open_page("workbench", "index.html#select=class000%2F0001&select=class000%2F0002")
    page.click("#tray >> text=Take as A")
    assert page.locator("#tray >> text='A: 2 shapes ×'").count() == 1
    page.click("#tray >> text=Clear")
    go(page, "Shapes")
    page.evaluate("location.hash = 'select=class003/0001'")
    eventually(page, lambda: page.locator("#tray h2").is_visible() and counted(page) == 1)
    follow(page, lambda: page.click("#tray >> text=Take as B"))
    address = parse_qs(urlsplit(page.url).fragment)
    assert "compare.html" in page.url
    assert address["a-select"] == ["class000/0001", "class000/0002"]
    assert address["b-select"] == ["class003/0001"]
    # Nothing is kept for the next comparison; here, groups are exchanged in place.
    page.evaluate("location.hash += '&select=class004/0001'")
    eventually(page, lambda: counted(page) == 2)
    page.click("#tray >> text=Take as A")
    both = ["class003/0001", "class004/0001"]
    eventually(page, lambda: parse_qs(urlsplit(page.url).fragment).get("a-select") == both)
    go(page, "Overview")
    assert page.locator("#tray >> text=Take as A").count() == 1


def test_fingers_draw_a_lasso_and_say_what_it_does(open_page):
    page = open_page(
        "workbench", "index.html", viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
    )

    def choose(words):
        page.locator(f".choice label:has-text('{words}')").click()
        page.wait_for_selector(f".choice label:has-text('{words}') input:checked", state="attached")

    choose("Lasso")
    touch = page.context.new_cdp_session(page)

    def finger(places):
        page.locator(LARGE).evaluate("node => node.scrollIntoView({ block: 'start' })")
        box = box_of(page.locator(LARGE))
        for number, (x, y) in enumerate(places):
            point = {"x": box["x"] + x * box["width"], "y": box["y"] + y * box["height"]}
            kind = "touchStart" if number == 0 else "touchMove"
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [point]})
            # Browsers hand on one movement a frame.
            drawn_again(page)
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        counted(page)
        # What the tray grows by moves nothing under the finger.
        assert page.locator(LARGE).bounding_box()["y"] == pytest.approx(box["y"], abs=1)

    finger(LEFT_HALF)
    at_left = counted(page)
    assert 0 < at_left < 80
    choose("Add")
    finger([(0.5, 0.02), (0.98, 0.02), (0.98, 0.98), (0.5, 0.98)])
    everyone = counted(page)
    assert everyone > at_left
    choose("Take away")
    finger(LEFT_HALF)
    assert counted(page) == everyone - at_left


class TestTheView:
    def test_the_menu_takes_it_along_past_pages_that_do_not_know_it(self, open_page):
        page = open_page("workbench", "index.html#map=umap&hide=kind b&select=class000/0001")

        def held(*parts) -> None:
            eventually(page, lambda: all(part in unquote_plus(page.url) for part in parts))

        go(page, "Shapes")
        held("map=umap", "hide=kind b", "select=class000/0001")
        page.locator("input[type=search]").first.fill("0003")
        go(page, "Compare")
        go(page, "Workbench")
        assert page.locator("#projections input:checked").get_attribute("value") == "umap"
        assert page.locator("#class-table .use[aria-pressed=false]").inner_text().startswith("kind b")
        eventually(page, lambda: page.locator("#bin-add").is_enabled())
        page.click("#bin-add")
        held("bins=", "find=0003")
        bins = parse_qs(urlsplit(page.url).fragment)["bins"]
        go(page, "About")
        go(page, "Overview")
        eventually(page, lambda: page.input_value("#search") == "0003")
        held("map=umap", "hide=kind b", "select=class000/0001")
        go(page, "Workbench")
        eventually(page, lambda: parse_qs(urlsplit(page.url).fragment).get("bins") == bins)

    def test_the_copied_link_says_what_it_holds(self, open_page):
        page = open_page("workbench", "index.html#map=umap&hide=kind b")
        page.evaluate("() => void (navigator.clipboard.writeText = async (text) => (window.copied = text))")
        page.click("#copy-link")
        eventually(page, lambda: page.locator("#copied").is_visible())
        assert page.inner_text("#copied") == "Link copied. It holds the map and which classes are hidden."
        assert page.evaluate("copied") == page.url


def test_on_a_phone_the_menu_is_one_row_and_the_tray_a_sheet(open_page):
    page = open_page(
        "workbench", "workbench.html#select=class001/0002", viewport={"width": 390, "height": 844}
    )
    places = page.locator("nav[aria-label=Pages] a").evaluate_all(
        "links => links.map((link) => link.getBoundingClientRect().top)"
    )
    assert len(set(places)) == 1
    # The page that is open is in sight.
    open_one = box_of(page.locator("nav [aria-current=page]"))
    assert 0 <= open_one["x"] <= 390 - open_one["width"]
    tray = box_of(page.locator("#tray"))
    assert (tray["x"], tray["width"]) == (0, 390)
    assert tray["y"] + tray["height"] == pytest.approx(844, abs=1)
    heights = page.locator("#tray .tray-ways > *, .tools .plain:visible, .tools .choice span").evaluate_all(
        "nodes => nodes.map((node) => node.getBoundingClientRect().height).filter(Boolean)"
    )
    assert min(heights) >= 40
    assert page.evaluate("document.documentElement.scrollWidth") == 390


@pytest.mark.parametrize("file", MAPS)
def test_back_and_undo_lead_to_the_selection_before(open_page, file):
    page = open_page(SITE_OF.get(file, "workbench"), file)
    entries = page.evaluate("history.length")
    # A drag is one step, however far it goes and however long it rests on its way.
    place = page.locator(MAPS[file])
    place.scroll_into_view_if_needed()
    where = box_of(place)
    page.mouse.move(where["x"] + 2, where["y"] + 2)
    page.mouse.down()
    page.mouse.move(where["x"] + where["width"] * 0.3, where["y"] + where["height"] * 0.9, steps=4)
    rested(page, 400)
    page.mouse.move(where["x"] + where["width"] * 0.5, where["y"] + where["height"] - 2, steps=4)
    page.mouse.up()
    some = named(page)
    assert some
    assert page.evaluate("history.length") == entries + 1
    x, y = on_a_shape(page, MAPS[file])
    page.keyboard.down("Control")
    page.mouse.click(x, y)
    page.keyboard.up("Control")
    eventually(page, lambda: abs(counted(page) - len(some)) == 1)
    changed = named(page)
    page.keyboard.press("Escape")
    eventually(page, lambda: counted(page) == 0)
    assert page.evaluate("history.length") == entries + 3
    page.go_back()
    eventually(page, lambda: named(page) == changed)
    page.keyboard.press("Control+z")
    eventually(page, lambda: named(page) == some)
    page.go_back()
    eventually(page, lambda: counted(page) == 0)
    # There is nothing before the page that Ctrl+Z would lead to.
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+Shift+z")
    eventually(page, lambda: named(page) == some)
    page.go_forward()
    eventually(page, lambda: named(page) == changed)
    assert file in page.url


def test_ticks_in_the_gallery_are_steps(open_page):
    page = open_page("workbench", "shapes.html")
    ticks = page.locator(".cell .tick")
    ticks.nth(0).check()
    ticks.nth(1).check()
    assert counted(page) == 2
    page.keyboard.press("Control+z")
    eventually(page, lambda: counted(page) == 1)
    page.keyboard.press("Control+Shift+z")
    eventually(page, lambda: counted(page) == 2)
    page.go_back()
    page.go_back()
    eventually(page, lambda: counted(page) == 0)
    assert "shapes.html" in page.url
    # In a field the keys are the field's own.
    ticks.nth(0).check()
    page.locator("#search").press_sequentially("cup")
    page.keyboard.press("Control+z")
    rested(page, 300)
    assert counted(page) == 1


def test_a_double_click_that_zooms_is_no_step_of_the_selection(open_page):
    page = open_page("workbench", "index.html")
    box(page, LARGE, right=0.5)
    some = named(page)
    assert some
    entries = page.evaluate("history.length")
    place = box_of(page.locator(LARGE))
    page.mouse.dblclick(place["x"] + 3, place["y"] + 3)
    eventually(page, lambda: "at=" in page.url)
    assert named(page) == some
    page.go_back()
    eventually(page, lambda: "at=" not in page.url)
    assert named(page) == some
    page.go_back()
    eventually(page, lambda: counted(page) == 0)
    assert page.evaluate("history.length") == entries + 1
