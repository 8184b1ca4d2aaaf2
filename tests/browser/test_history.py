"""The browser's way back leads through what a reader chose on a page, and through nothing that the page did itself."""

import re

import pytest
from waiting import box_of, drawn_again, eventually, rested


def entries(page) -> int:
    return page.evaluate("history.length")


def choose(page, group: str, text: str) -> None:
    page.locator(f"{group} label", has_text=re.compile(f"^{text}$")).click()


def checked(page, group: str) -> str:
    return page.locator(f"{group} label", has=page.locator("input:checked")).inner_text()


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("everything", "index.html"),
        ("everything", "shapes.html"),
        ("everything", "compare.html"),
        ("everything", "compare.html#view=classes"),
        ("everything", "features.html"),
        ("everything", "bins.html"),
        ("workbench", "workbench.html"),
    ],
)
def test_a_page_that_opens_makes_no_step(open_page, name, file) -> None:
    page = open_page(name, file)
    before = entries(open_page(name, "about.html"))
    rested(page, 600)
    assert entries(page) == before


def test_on_the_overview(open_page) -> None:
    page = open_page("plain")
    choose(page, "#methods", "UMAP")
    choose(page, "#views", r"Fit \(NH\)")
    page.locator("#legend button[aria-pressed]").first.click()
    eventually(page, lambda: page.locator("#legend button[aria-pressed=false]").count() == 1)
    page.go_back()
    eventually(page, lambda: page.locator("#legend button[aria-pressed=false]").count() == 0)
    page.go_back()
    eventually(page, lambda: page.locator("figure[data-slot=large][data-view=thumbnail]").count() == 1)
    assert checked(page, "#methods") == "UMAP"
    page.go_back()
    eventually(page, lambda: checked(page, "#methods") == "t-SNE")
    for _ in range(3):
        page.go_forward()
    eventually(page, lambda: page.locator("#legend button[aria-pressed=false]").count() == 1)
    assert checked(page, "#methods") == "UMAP"
    assert page.locator("figure[data-slot=large]").get_attribute("data-view") == "hit"


def test_a_double_click_is_one_step(open_page) -> None:
    page = open_page("plain")
    length = entries(page)
    page.locator("#legend button[aria-pressed]").first.dblclick()
    eventually(page, lambda: page.locator("#legend button[aria-pressed=true]").count() == 1)
    assert entries(page) == length + 1
    page.go_back()
    eventually(page, lambda: page.locator("#legend button[aria-pressed=false]").count() == 0)


def test_a_step_that_is_taken_back_at_once_is_none(open_page) -> None:
    page = open_page("workbench", "workbench.html#select=class000/0001")
    drawn_again(page)
    length = entries(page)
    # A double click where nothing is drops the selection and has it again.
    place = box_of(page.locator("figure[data-map=original] .surface"))
    page.mouse.dblclick(place["x"] + 6, place["y"] + 6)
    eventually(page, lambda: page.locator("#tray h2").is_visible() and "class000" in page.url)
    page.focus(".bin-plot .surface")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    eventually(page, lambda: "bins=" in page.url)
    assert entries(page) == length + 1
    page.go_back()
    eventually(page, lambda: "bins=" not in page.url)
    assert page.locator("#undo").is_disabled()


def test_every_choice_of_bins_is_one_step_and_one_of_the_strip(open_page) -> None:
    page = open_page("workbench", "workbench.html")
    length = entries(page)
    strip = page.locator("#steps li")

    def at() -> int:
        return int(page.locator("#steps [aria-current]").get_attribute("data-step"))

    def taken(number) -> None:
        eventually(page, lambda: strip.count() == number + 1)
        assert (at(), entries(page)) == (number, length + number)

    def press() -> None:
        place = box_of(page.locator(".bin-plot .surface"))
        page.mouse.click(place["x"] + 8, place["y"] + place["height"] / 3)

    for number in (1, 2):
        press()
        taken(number)
    page.focus(".bin-plot .surface")
    page.keyboard.press("Home")
    for number in (3, 4):
        page.keyboard.press("Enter")
        taken(number)
    # Undo and the browser's way back are one, and what follows takes the place of what was undone.
    page.click("#undo")
    eventually(page, lambda: at() == 3)
    page.go_back()
    eventually(page, lambda: at() == 2)
    press()
    taken(3)
    for number in (2, 1, 0):
        page.go_back()
        eventually(page, lambda number=number: at() == number)
    assert page.locator("#undo").is_disabled()


def test_to_the_view_that_was_left(open_page) -> None:
    page = open_page("plain")
    page.locator("#search").fill("kind c 3")
    page.wait_for_selector("#search-found li[data-place]")
    page.keyboard.press("Enter")
    page.wait_for_selector("#detail:not([hidden])")
    page.go_back()
    page.wait_for_selector("#detail", state="hidden")
    assert "index.html" in page.url
    # Zoomed, and gone on from there before that is written.
    page.click("[data-zoom=in]")
    choose(page, "#methods", "UMAP")
    eventually(page, lambda: "map=umap" in page.url and "at=" not in page.url)
    page.go_back()
    eventually(page, lambda: checked(page, "#methods") == "t-SNE" and "at=" in page.url)
    assert page.evaluate("document.body.hasAttribute('data-zoomed')")


def test_on_the_features(open_page) -> None:
    page = open_page("searched", "features.html")
    page.focus("figure.map .surface")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    eventually(page, lambda: "open=" in page.url)
    for _ in range(3):
        page.keyboard.press("+")
    page.locator("#colors label", has_text="Fit").click()
    eventually(page, lambda: page.locator("figure.map[data-view=hit]").count() == 1)
    page.click("[data-key=next]")
    eventually(page, lambda: "features=" in page.url and "at=" not in page.url)
    page.go_back()
    eventually(page, lambda: "features=" not in page.url)
    rested(page, 500)
    assert "at=" in page.url
    page.go_back()
    eventually(page, lambda: page.locator("figure.map[data-view=class]").count() == 1)
    page.go_back()
    eventually(page, lambda: page.locator("figure.map .ring.opened.shown").count() == 0)
    assert "features.html" in page.url


def test_in_the_gallery(open_page) -> None:
    page = open_page("museum", "shapes.html")
    page.select_option("#group", label="place")
    facet = page.locator(".facet", has=page.locator("summary bdi", has_text=re.compile("^place$")))
    if facet.get_attribute("open") is None:
        facet.locator("summary").click()
    delft = facet.locator("li", has=page.locator(".value", has_text=re.compile("^Delft$"))).locator("input")
    delft.check()
    eventually(page, lambda: "Delft" in page.url)
    # What is typed into the search is no step for every letter.
    length = entries(page)
    page.locator("#search").press_sequentially("cup")
    eventually(page, lambda: "find=cup" in page.url)
    assert entries(page) == length
    page.go_back()
    eventually(page, lambda: not delft.is_checked())
    assert page.locator("#group option:checked").inner_text() == "place"
    page.go_back()
    eventually(page, lambda: page.locator("#group option:checked").inner_text() != "place")
    assert "shapes.html" in page.url


def test_on_the_compare_page(open_page) -> None:
    page = open_page("workbench", "compare.html")
    drawn_again(page)
    first = page.locator("#group-a option:checked").inner_text()
    length = entries(page)
    page.select_option("#group-a", label="kind e (16)")
    eventually(page, lambda: "kind+e" in page.url)
    rested(page, 600)
    # The page chooses bins for the new groups; that is no step of the reader's.
    assert entries(page) == length + 1
    page.go_back()
    eventually(page, lambda: page.locator("#group-a option:checked").inner_text() == first)


def test_on_the_workbench_with_the_projection(open_page) -> None:
    page = open_page("workbench", "workbench.html")
    before = page.locator("#projections input:checked").get_attribute("value")
    other = page.locator("#projections label", has=page.locator("input:not(:checked)")).first
    other.click()
    eventually(page, lambda: page.locator("#projections input:checked").get_attribute("value") != before)
    page.go_back()
    eventually(page, lambda: page.locator("#projections input:checked").get_attribute("value") == before)
