"""What the owner of a database says of it, where a reader meets it."""

import re

import pytest
from playwright.sync_api import expect
from waiting import box_of

ACCENTS = {"light": "rgb(160, 19, 70)", "dark": "rgb(216, 107, 147)"}


@pytest.mark.parametrize("viewport", [{"width": 1440, "height": 900}, {"width": 390, "height": 800}])
def test_the_introduction_begins_above_the_map_and_leaves_it_its_place(open_page, viewport):
    page = open_page("published", viewport=viewport)
    welcome = page.locator(".welcome")
    expect(welcome.locator("p")).to_have_text("Vessels of two museums.")
    assert box_of(welcome)["height"] < 90
    surface = box_of(page.locator(".map[data-slot=large] .surface"))
    assert surface["y"] + 0.8 * surface["height"] < viewport["height"]
    assert page.evaluate("document.documentElement.scrollWidth") <= viewport["width"]


def test_the_introduction_is_read_and_closed_by_keyboard(open_page):
    page = open_page("published")
    page.focus("#open-introduction")
    page.keyboard.press("Enter")
    dialog = page.locator("dialog#introduction")
    expect(dialog).to_be_visible()
    expect(dialog.locator(".prose h3")).to_have_text("What is here")
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    assert page.evaluate("document.activeElement.id") == "open-introduction"


def test_a_link_in_the_introduction_leads_to_a_page_of_a_single_file(open_page, single_file):
    page = open_page("published", "", single_file("published").as_uri())
    page.click("#open-introduction")
    page.click("dialog#introduction a")
    page.wait_for_selector("body.page-shapes")
    assert page.url.endswith("#/shapes")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("whole", [False, True], ids=["folder", "single file"])
def test_the_accent_and_the_logo_are_seen(open_page, single_file, scheme, whole):
    address = single_file("published").as_uri() if whole else None
    page = open_page("published", address=address, color_scheme=scheme)
    assert (
        page.locator("#open-introduction").evaluate("node => getComputedStyle(node).color") == ACCENTS[scheme]
    )
    logo = page.locator(".masthead .logo")
    assert logo.evaluate("picture => picture.complete && picture.naturalWidth > 0")
    assert box_of(logo)["height"] <= 32


def test_a_page_without_an_introduction_has_no_place_for_one(open_page):
    page = open_page("one shape")
    assert page.locator(".welcome, dialog#introduction, .logo").count() == 0


def test_the_citation_is_copied(open_page, browser):
    page = open_page("published", "about.html")
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.click("button.copy >> text=BibTeX")
    expect(page.locator("#live")).to_have_text("Copied")
    assert re.match(r"@misc\{vessels,\n", page.evaluate("navigator.clipboard.readText()"))


def test_a_citation_that_may_not_be_copied_is_selected(open_page):
    page = open_page("published", "about.html")
    page.evaluate("Object.defineProperty(navigator, 'clipboard', { value: undefined })")
    page.locator("button.copy").first.click()
    expect(page.locator("#live")).to_contain_text("Selected")
    assert page.evaluate("getSelection().toString()").strip() == "N. N.: Vessels of two museums, 2019."
