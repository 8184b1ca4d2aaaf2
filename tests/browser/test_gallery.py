"""The gallery as a reader uses it, with mouse, keys and touch."""

import re

import pytest
from reports import NASTY_LABELS
from waiting import box_of, drawn_again, eventually

PHONE = {"viewport": {"width": 390, "height": 800}, "has_touch": True, "is_mobile": True}


def shown(page) -> int:
    """How many shapes pass, as the page says it."""
    drawn_again(page)
    return int(re.sub(r"\D", "", page.inner_text("#shown").split(" of ")[0]))


def names(page) -> list[str]:
    """The names of the shapes that are drawn, as they lie on the screen."""
    drawn_again(page)
    return page.evaluate(
        """() => [...document.querySelectorAll(".cell")]
            .map((cell) => [cell.getBoundingClientRect(), cell.querySelector(".name").textContent])
            .sort(([a], [b]) => a.top - b.top || a.left - b.left)
            .map(([, name]) => name)"""
    )


def heads(page) -> list[str]:
    drawn_again(page)
    return page.locator(".group-name").all_inner_texts()


def selected(page) -> list[str]:
    drawn_again(page)
    return [item.get_attribute("title").split(",")[0] for item in page.locator("#tray .shape").all()]


def address(page) -> str:
    return page.evaluate("decodeURIComponent(location.hash)")


def addressed(page, text: str) -> None:
    eventually(page, lambda: text in address(page))


def focused(page) -> str:
    return page.evaluate(
        """() => { const { activeElement: here } = document;
                   return (here.querySelector(".name, .group-name") ?? here).textContent; }"""
    )


def facet(page, title):
    """A filter, unfolded."""
    found = page.locator(
        ".facet", has=page.locator("summary bdi", has_text=re.compile(f"^{re.escape(title)}$"))
    )
    if found.get_attribute("open") is None:
        found.locator("summary").click()
    return found


def value(page, title, name):
    """What ticks a value of a filter."""
    return facet(page, title).locator("li", has=page.locator(".value", has_text=re.compile(f"^{name}$"))).last


class TestFirstLook:
    def test_shapes_stand_in_their_classes(self, open_page):
        page = open_page("museum", "shapes.html")
        assert page.inner_text("#shown") == "144 shapes"
        assert heads(page)[:2] == ["ant", "bee"]
        assert names(page)[:3] == ["ant 0", "ant 1", "ant 2"]

    def test_pictures_are_seen(self, open_page):
        page = open_page("museum", "shapes.html")
        picture = page.locator(".cell img").first
        eventually(page, lambda: picture.evaluate("image => image.complete && image.naturalWidth > 0"))

    def test_a_click_opens_the_page_of_the_shape(self, open_page):
        page = open_page("museum", "shapes.html")
        page.locator(".cell a").nth(2).click()
        page.wait_for_url(re.compile(r"shape\.html#id=class000%2F0002"))

    def test_whoever_comes_back_is_where_they_were(self, open_page):
        page = open_page("large", "shapes.html")
        page.locator("#scroller").evaluate("node => { node.scrollTop = 6000; }")
        drawn_again(page)
        middle = page.locator(".cell a", has_text=re.compile("class 1 ")).nth(20)
        middle.scroll_into_view_if_needed()
        name = middle.locator(".name").inner_text()
        middle.click()
        page.wait_for_url(re.compile("shape.html"))
        page.go_back()
        page.wait_for_selector("html[data-ready]", state="attached")
        drawn_again(page)
        box = box_of(page.locator(".cell", has_text=re.compile(f"^{name}$")))
        assert 0 < box["y"] < 900


class TestCopies:
    def test_the_filter_of_copies_leaves_them(self, open_page):
        page = open_page("copied", "shapes.html")
        value(page, "Copies", "has copies").locator("input").check()
        assert shown(page) == 5
        addressed(page, "is.copies=has+copies")
        assert names(open_page("copied", "shapes.html#is.copies=has+copies")) == names(page)
        assert set(names(page)) == {"ant 0", "ant 3", "ant 5", "bird 0", "bird 1"}
        value(page, "Copies", "has copies").locator("input").uncheck()
        value(page, "Copies", "no copies").locator("input").check()
        assert shown(page) == 11


class TestManyShapes:
    def test_only_what_is_in_sight_is_in_the_page(self, open_page):
        page = open_page("large", "shapes.html")
        assert page.inner_text("#shown") == "2\u202f000 shapes"
        for place in (0, 9000, 1e9):
            page.locator("#scroller").evaluate("(node, place) => { node.scrollTop = place; }", place)
            drawn_again(page)
            assert 0 < page.locator(".cell").count() < 150
        assert "class 7 249" in names(page)

    def test_the_head_of_a_group_stays_in_sight(self, open_page):
        page = open_page("large", "shapes.html")
        page.locator("#scroller").evaluate("node => { node.scrollTop = 3000; }")
        drawn_again(page)
        top = box_of(page.locator("#scroller"))["y"]
        boxes = [box_of(head) for head in page.locator(".block-head").all()]
        assert any(abs(box["y"] - top) < 4 for box in boxes)

    def test_pictures_come_when_one_stops_rushing(self, open_page):
        page = open_page("large", "shapes.html")
        page.locator("#scroller").evaluate("node => { node.scrollTop = 20000; }")
        eventually(page, lambda: page.locator(".cell img:not([src])").count() == 0)

    def test_another_size_keeps_the_place(self, open_page):
        page = open_page("large", "shapes.html")
        page.locator("#scroller").evaluate("node => { node.scrollTop = 12000; }")
        drawn_again(page)
        edge = box_of(page.locator("#scroller"))["y"] + 45
        before = next(cell.inner_text() for cell in page.locator(".cell").all() if box_of(cell)["y"] > edge)
        for size in ("60", "300"):
            page.locator("#size").fill(size)
            assert before.strip() in [name.strip() for name in names(page)]
        assert box_of(page.locator(".cell img").first)["width"] >= 300


class TestArranging:
    def test_by_another_column(self, open_page):
        page = open_page("museum", "shapes.html")
        page.select_option("#group", label="place")
        assert heads(page)[0] == "Delft"
        page.select_option("#group", label="Nothing")
        assert heads(page) == []
        assert names(page)[:2] == ["ant 0", "ant 1"]

    def test_by_ranges_of_a_number(self, open_page):
        page = open_page("museum", "shapes.html")
        page.select_option("#group", label="year")
        assert heads(page)[0] == "1400 to 1420"

    def test_outliers_come_first(self, open_page):
        page = open_page("museum", "shapes.html")
        page.select_option("#group", label="Nothing")
        page.select_option("#sort", label="NH on the t-SNE map")
        drawn_again(page)
        values = [float(text.split()[-1]) for text in page.locator(".cell .beside").all_inner_texts()]
        assert values == sorted(values)
        assert values[0] < 1
        page.click("#down")
        drawn_again(page)
        assert page.locator(".cell .beside").first.inner_text() == "NH 1.000"

    def test_shapes_without_a_value_come_last_either_way(self, open_page):
        page = open_page("museum", "shapes.html#group=&sort=column%3Ayear")
        page.focus(".cell a")
        for order in ("Smallest first", "Largest first"):
            assert page.inner_text("#down") == order
            page.focus(".cell a[tabindex='0']")
            page.keyboard.press("End")
            drawn_again(page)
            assert page.locator(".cell:focus-within .beside").inner_text() == "year –"
            page.click("#down")

    def test_groups_fold(self, open_page):
        page = open_page("museum", "shapes.html")
        page.locator(".fold").first.click()
        assert names(page)[0] == "bee 0"
        addressed(page, "closed==ant")
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert names(page)[0] == "bee 0"
        page.click("#fold")
        assert names(page)[0] == "ant 0"
        page.click("#fold")
        assert names(page) == []
        assert len(heads(page)) == 6


class TestSearch:
    def test_it_answers_as_one_types(self, open_page):
        page = open_page("museum", "shapes.html")
        page.focus("body")
        page.keyboard.press("/")
        page.keyboard.type("munster")
        eventually(page, lambda: shown(page) == 48)
        page.keyboard.type(" K-0002")
        eventually(page, lambda: names(page) == ["ant 2"])
        page.keyboard.press("Escape")
        eventually(page, lambda: shown(page) == 144)

    def test_how_many_there_are_is_said(self, open_page):
        page = open_page("museum", "shapes.html")
        page.fill("#search", "kyoto")
        eventually(page, lambda: page.inner_text("#live") == "48 shapes shown")

    def test_when_nothing_is_found_the_way_back_is_shown(self, open_page):
        page = open_page(
            "museum", "shapes.html#find=kyoto&is.column%3Aplace=Delft&is.label%3Afolder=insects%2Fant"
        )
        assert shown(page) == 0
        offers = page.locator("#empty li").all_inner_texts()
        assert offers == [
            "Without Search: “kyoto” there are 8",
            "Without place: Delft there are 8",
        ]
        page.locator("#empty li button").first.click()
        assert shown(page) == 8
        assert page.locator("#empty").is_hidden()


class TestFilters:
    def test_values_count_what_the_other_filters_leave(self, open_page):
        page = open_page("museum", "shapes.html")
        value(page, "place", "Kyoto").locator("input").check()
        assert shown(page) == 48
        assert value(page, "place", "Delft").locator(".size").inner_text() == "48"
        assert value(page, "Class", "insects").locator(".size").first.inner_text() == "16"
        value(page, "place", "Delft").locator("input").check()
        assert shown(page) == 96
        assert page.locator("#chips li").all_inner_texts() == ["placeKyoto, Delft\n×"]

    def test_a_tree_is_walked_down(self, open_page):
        page = open_page("museum", "shapes.html")
        node = page.locator("[role=treeitem]", has_text="household").first
        node.locator(".chevron").click()
        assert shown(page) == 144
        page.locator("[role=treeitem] [role=treeitem] .value", has_text="tableware").click()
        assert shown(page) == 48
        assert heads(page) == ["cup", "plate"]
        assert page.locator("[role=treeitem][aria-checked=mixed]").count() == 1
        addressed(page, "is.label:folder=household/tableware")

    def test_a_part_takes_the_place_of_the_whole(self, open_page):
        page = open_page("museum", "shapes.html#is.label%3Afolder=household")
        assert shown(page) == 48
        page.locator("[role=treeitem] .chevron").nth(0).click()
        page.focus("[role=tree] [tabindex='0']")
        page.keyboard.press("Home")
        for key in ("ArrowRight", "ArrowRight", "ArrowRight", "Space"):
            page.keyboard.press(key)
        assert shown(page) == 24
        assert page.locator("#chips li").inner_text().startswith("Classhousehold / tableware / cup")

    def test_a_tree_works_by_keys(self, open_page):
        page = open_page("museum", "shapes.html")
        page.focus("[role=tree] [tabindex='0']")
        page.keyboard.press("End")
        for key in ("ArrowUp", "ArrowUp", "ArrowRight", "ArrowRight", "Space"):
            page.keyboard.press(key)
        assert heads(page) == ["ant"]
        page.keyboard.press("ArrowLeft")
        page.keyboard.press("Enter")
        assert heads(page) == ["ant", "bee"]

    def test_a_range_is_drawn_in_from_both_ends(self, open_page):
        page = open_page("museum", "shapes.html")
        low, high = facet(page, "year").locator("input[type=range]").all()
        low.focus()
        for _ in range(2):
            page.keyboard.press("ArrowRight")
        high.focus()
        page.keyboard.press("ArrowLeft")
        addressed(page, "range.column:year=1440..1820")
        years = [1400 + 3 * row for row in range(144) if row % 6]
        assert shown(page) == sum(1440 <= year <= 1820 for year in years)
        assert facet(page, "year").locator(".between").inner_text() == "1440 to 1820"
        page.locator("#chips button").click()
        assert shown(page) == 144

    def test_shapes_without_a_label_are_found(self, open_page):
        page = open_page("museum", "shapes.html")
        page.locator("[role=treeitem] .value", has_text="no label").click()
        assert shown(page) == 24
        assert heads(page) == ["no label"]
        addressed(page, "lacks.label:folder=")
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert heads(page) == ["no label"]

    def test_an_address_reproduces_all_of_it(self, open_page):
        state = (
            "find=k&is.column:place=Kyoto&range.column:year=1400..1700&group=&sort=column:year&down=&size=100"
            "&select=class000/0001"
        )
        page = open_page("museum", f"shapes.html#{state}")
        number, order, taken = shown(page), names(page), selected(page)
        assert 0 < number < 48
        assert taken == ["ant 1"]
        page.select_option("#sort", label="Name")
        addressed(page, "find=k&is.column:place=Kyoto")
        page.select_option("#sort", label="year")
        page.click("#down")
        addressed(page, "sort=column:year&down=&size=100")
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert (shown(page), names(page), selected(page)) == (number, order, taken)

    def test_what_an_address_names_in_vain_is_left_out(self, open_page):
        page = open_page(
            "museum",
            "shapes.html#is.column%3Aplace=Rome&is.nothing=1&range.column%3Ayear=a..b&group=x&sort=__proto__&size=9",
        )
        assert shown(page) == 144
        assert heads(page)[0] == "ant"


class TestSelecting:
    def test_ticks_and_ranges(self, open_page):
        page = open_page("museum", "shapes.html")
        ticks = page.locator(".cell .tick")
        ticks.nth(1).check(force=True)
        ticks.nth(4).click(force=True, modifiers=["Shift"])
        assert selected(page) == ["ant 1", "ant 2", "ant 3", "ant 4"]
        addressed(page, "select=class000/0001&select=class000/0002")
        ticks.nth(2).uncheck()
        assert selected(page) == ["ant 1", "ant 3", "ant 4"]

    def test_a_whole_group(self, open_page):
        page = open_page("museum", "shapes.html")
        page.locator(".block-head .tick").first.check()
        assert len(selected(page)) == 24
        page.locator(".cell .tick").first.uncheck()
        assert page.locator(".block-head .tick").first.evaluate("tick => tick.indeterminate")

    def test_all_that_are_shown_go_to_the_map(self, open_page):
        page = open_page("museum", "shapes.html#find=kyoto")
        page.click("#select-shown")
        assert page.inner_text("#tray h2") == "48 shapes selected"
        page.click("#on-map")
        page.wait_for_url(re.compile("index.html#selected="))
        page.wait_for_selector("html[data-ready]", state="attached")
        assert page.inner_text("#tray h2") == "48 shapes selected"

    def test_only_the_selected_are_shown_as_another_page_asks(self, open_page):
        page = open_page("museum", "index.html#find=K-000")
        page.wait_for_selector("#search-select:not([hidden])")
        page.click("#search-select")
        page.click("#tray >> text=Open in Shapes")
        page.wait_for_url(re.compile("shapes.html#only"))
        page.wait_for_selector("html[data-ready]", state="attached")
        assert names(page) == [f"ant {row}" for row in range(10)]
        page.locator(".cell a").nth(3).focus()
        page.keyboard.press("Space")
        assert shown(page) == 9
        assert "ant 3" not in names(page)
        assert focused(page) == "ant 4"
        page.click("#chips button")
        assert shown(page) == 144
        page.click("#only-selected")
        assert shown(page) == 9
        page.click("#tray >> text=Clear")
        assert shown(page) == 144

    def test_they_are_compared_with_the_rest(self, open_page):
        page = open_page("museum", "shapes.html#find=K-0002")
        page.click("#compare-shown")
        page.wait_for_url(re.compile(r"compare\.html#a=shapes&a-select=class000%2F0002&b=rest"))


class TestKeys:
    def test_arrows_go_through_rows_and_groups(self, open_page):
        page = open_page("museum", "shapes.html")
        page.focus(".cell a[tabindex='0']")
        columns = int(page.get_attribute("#grid", "aria-colcount"))
        page.keyboard.press("ArrowRight")
        assert focused(page) == "ant 1"
        page.keyboard.press("ArrowDown")
        assert focused(page) == f"ant {columns + 1}"
        page.keyboard.press("Home")
        assert focused(page) == "ant"
        page.keyboard.press("ArrowLeft")
        assert names(page)[0] == "bee 0"
        page.keyboard.press("ArrowDown")
        page.keyboard.press("ArrowDown")
        assert focused(page) == "bee 0"

    def test_the_focus_goes_to_the_end_and_back_through_thousands(self, open_page):
        page = open_page("large", "shapes.html")
        page.focus(".cell a[tabindex='0']")
        page.keyboard.press("End")
        drawn_again(page)
        assert focused(page) == "class 7 249"
        for _ in range(3):
            page.keyboard.press("PageUp")
            drawn_again(page)
        assert focused(page).startswith("class 7 1")
        box = box_of(page.locator(".cell:focus-within"))
        assert 0 < box["y"] < 900
        page.locator("#scroller").evaluate("node => { node.scrollTop = 0; }")
        drawn_again(page)
        page.keyboard.press("ArrowRight")
        assert focused(page).startswith("class 7 1")

    def test_space_selects_and_shift_extends(self, open_page):
        page = open_page("museum", "shapes.html")
        page.focus(".cell a[tabindex='0']")
        page.keyboard.press("Space")
        page.keyboard.press("Shift+ArrowRight")
        page.keyboard.press("Shift+ArrowRight")
        assert selected(page) == ["ant 0", "ant 1", "ant 2"]
        page.keyboard.press("Control+a")
        drawn_again(page)
        assert page.inner_text("#tray h2") == "144 shapes selected"
        page.keyboard.press("Escape")
        assert selected(page) == []

    def test_enter_opens(self, open_page):
        page = open_page("museum", "shapes.html")
        page.focus(".cell a[tabindex='0']")
        page.keyboard.press("ArrowRight")
        page.keyboard.press("Enter")
        page.wait_for_url(re.compile(r"shape\.html#id=class000%2F0001"))

    def test_the_grid_is_one_stop_of_tab(self, open_page):
        page = open_page("museum", "shapes.html")
        page.focus("#open-tables")
        page.keyboard.press("Tab")
        assert focused(page) == "ant 0"
        page.keyboard.press("Tab")
        assert not page.evaluate("document.getElementById('grid').contains(document.activeElement)")


class TestStates:
    def test_one_shape(self, open_page):
        page = open_page("one shape", "shapes.html")
        assert page.inner_text("#shown") == "1 shape"
        assert names(page) == ["ant 0"]
        assert heads(page) == []

    def test_no_labels(self, open_page):
        page = open_page("no labels", "shapes.html")
        assert shown(page) == 24
        assert heads(page) == []
        options = page.locator("#sort option").all_inner_texts()
        assert options[0] == "Name"
        assert not any("NH" in option for option in options)

    def test_text_of_a_database_is_text(self, open_page):
        page = open_page("nasty", "shapes.html")
        page.click("#fold")
        assert set(heads(page)) == {*NASTY_LABELS, "no label"}
        for label in NASTY_LABELS:
            page.fill("#search", label)
            eventually(page, lambda: shown(page) == 4)
        page.fill("#search", "")
        for box in range(9):
            page.locator(".facet-values input").nth(box).check()
        assert shown(page) == 36
        addressed(page, "lacks.label:folder")
        page.reload()
        page.wait_for_selector("html[data-ready]", state="attached")
        assert page.locator(".facet-values input:checked").count() == 9

    def test_tables_hold_what_is_shown(self, open_page):
        page = open_page("museum", "shapes.html#find=kyoto")
        page.click("#open-tables")
        first = page.locator("#tables table").first
        assert first.locator("tbody tr").count() == 48
        assert "Kyoto" in first.locator("tbody tr").first.inner_text()

    @pytest.mark.parametrize("scheme", ["light", "dark"])
    @pytest.mark.parametrize("width", [390, 768, 1100])
    def test_it_fits_the_window(self, open_page, width, scheme):
        page = open_page(
            "nasty",
            "shapes.html#select=class000/0001&find=class",
            viewport={"width": width, "height": 800},
            color_scheme=scheme,
        )
        assert page.evaluate("document.documentElement.scrollWidth") <= width


class TestPhone:
    def test_the_page_scrolls_and_is_drawn_as_it_does(self, open_page):
        page = open_page("large", "shapes.html", **PHONE)
        page.evaluate("window.scrollTo(0, 20000)")
        drawn_again(page)
        drawn_again(page)
        found = page.evaluate(
            "document.elementsFromPoint(100, 500).some((node) => node.closest('.cell') !== null)"
        )
        assert found
        assert page.locator(".cell").count() < 100
        head = page.evaluate("document.elementFromPoint(100, 70).closest('.block-head') !== null")
        assert head

    def test_filters_lie_over_the_page(self, open_page):
        page = open_page("museum", "shapes.html", **PHONE)
        assert page.locator("#filters").is_hidden()
        page.tap("#open-filters")
        value(page, "place", "Kyoto").locator("label").tap()
        assert page.inner_text("#close-filters") == "Show 48 shapes"
        page.tap("#close-filters")
        assert page.locator("#filters").is_hidden()
        assert shown(page) == 48
        assert page.inner_text("#open-filters") == "Filters (1)"

    def test_escape_closes_the_filters_and_nothing_behind_them_is_reached(self, open_page):
        page = open_page("museum", "shapes.html", **PHONE)
        page.click("#open-filters")
        assert page.locator("#scroller").evaluate("node => node.inert")
        page.keyboard.press("Escape")
        assert page.locator("#filters").is_hidden()
        assert page.evaluate("document.activeElement.id") == "open-filters"
