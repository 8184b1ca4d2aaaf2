"""The About page in a browser."""

import pytest


@pytest.mark.parametrize("width", [1280, 390])
def test_it_fits_the_window(open_page, width):
    page = open_page("nasty", "about.html", viewport={"width": width, "height": 900})
    page.locator("details summary").click()
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_downloads_are_there(open_page, site):
    page = open_page("plain", "about.html")
    links = page.eval_on_selector_all("a[download]", "links => links.map(link => link.getAttribute('href'))")
    assert len(links) == 6
    assert all((site("plain") / link).is_file() for link in links)


def test_the_theme_button_works(open_page):
    page = open_page("plain", "about.html", color_scheme="light")
    page.click("#theme")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
