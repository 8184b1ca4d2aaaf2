"""A site in one file, opened from where a mail program puts it."""

import csv
import re
from urllib.parse import unquote

import pytest
from playwright.sync_api import expect

from shapeviz_report.pages import PAGES

READY = "html[data-ready]"


@pytest.fixture
def open_single(open_page, single_file):
    def open_(name, place="", **options):
        return open_page(
            name,
            "about.html" if place.startswith("#/about") else "",
            f"{single_file(name).as_uri()}{place}",
            **options,
        )

    return open_


def outside(page, file):
    """Requests for anything but the file itself."""
    return [url for url in page.watch.requests if not url.startswith((file.as_uri(), "data:", "blob:"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
@pytest.mark.parametrize("name", ["everything", "published"])
def test_every_page_opens_and_asks_for_nothing(open_single, single_file, name, page):
    opened = open_single(name, f"#/{page.name}")
    expect(opened.locator("main#content")).to_have_count(1)
    assert opened.evaluate("document.body.className").split()[0] == f"page-{page.name}"
    database = opened.locator(".masthead .title").inner_text()
    named = database if page.file == "index.html" else f"{page.title} · {database}"
    # The page of one shape has the shape's name in its title.
    assert opened.title() == named or (page.within and opened.title().endswith(f" · {database}"))
    assert outside(opened, single_file(name)) == []


def test_it_opens_on_the_overview(open_single):
    page = open_single("plain")
    assert page.locator("nav a[aria-current=page]").inner_text() == "Overview"
    assert page.locator(".map .pictured").count() > 50
    page.locator("#views label", has_text="All three").click()
    for view in ("class", "hit", "thumbnail"):
        page.wait_for_selector(f"figure.linked[data-view={view}] .chart :is(canvas, svg)")


def test_an_address_of_a_page_that_is_not_there_leads_to_the_overview(open_single):
    assert open_single("plain", "#/nowhere").locator("nav a[aria-current=page]").inner_text() == "Overview"


def test_links_lead_from_page_to_page_and_back(open_single):
    page = open_single("plain")
    for title in ("Features", "About", "Overview"):
        page.click(f"nav a >> text={title}")
        page.wait_for_selector(f"body.page-{title.lower()}")
        assert page.locator("nav a[aria-current=page]").inner_text() == title
    page.go_back()
    page.wait_for_selector("body.page-about")
    page.go_back()
    page.wait_for_selector("body.page-features")


def test_the_state_of_a_view_is_in_the_address_behind_the_page(open_single):
    page = open_single("plain")
    page.locator("#methods label").last.click()
    page.wait_for_url(re.compile(r"#/index\?map=pca$"))
    page.reload()
    page.wait_for_selector(READY, state="attached")
    assert page.locator("#methods input:checked").get_attribute("value") == "pca"


def test_a_link_made_by_a_script_opens_its_page_in_its_state(open_single):
    page = open_single("searched", "#/features")
    page.locator("#open-overview").click()
    page.wait_for_selector("body.page-overview")
    page.wait_for_selector(READY, state="attached")
    assert "features=" in unquote(page.url)


def test_the_way_past_the_masthead_leaves_the_address_alone(open_single):
    page = open_single("plain", "#/index?map=umap")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.id") == "content"
    assert page.url.endswith("#/index?map=umap")


def test_data_is_handed_out(open_single):
    page = open_single("plain", "#/about")
    with page.expect_download() as download:
        page.click("a[download] >> text=shapes.csv")
    assert download.value.suggested_filename == "shapes.csv"
    rows = list(csv.DictReader(download.value.path().open(encoding="utf-8")))
    assert len(rows) == 120


def test_pictures_are_seen(open_single):
    page = open_single("plain", "#/index?view=thumbnail&open=class000/0000")
    page.wait_for_selector("#detail img")
    page.locator("#detail img").first.evaluate("picture => picture.decode()")
    assert page.locator("#detail img").first.evaluate("picture => picture.naturalWidth") == 256


def test_the_engine_runs(open_single):
    """The worker starts from the text in the file, under the same policy."""
    page = open_single("workbench", "#/workbench")
    page.wait_for_selector("main[aria-busy=false]", timeout=60_000)
    assert (
        page.locator("figure[data-map=original] .surface canvas, figure[data-map=original] svg").count() > 0
    )


def test_a_script_from_elsewhere_is_refused(open_single):
    page = open_single("plain")
    refused = page.evaluate(
        """async () => {
            const violations = [];
            document.addEventListener("securitypolicyviolation", (event) => violations.push(event.effectiveDirective));
            await fetch("https://example.org/").catch(() => {});
            const style = document.createElement("style");
            style.textContent = "body { color: red }";
            document.head.append(style);
            const script = document.createElement("script");
            try { script.textContent = "1"; document.head.append(script); } catch {}
            try { document.body.innerHTML = "<p>markup</p>"; } catch {}
            await new Promise((resolve) => setTimeout(resolve, 200));
            return violations;
        }"""
    )
    assert {"connect-src", "style-src-elem", "require-trusted-types-for"} <= set(refused)
    page.watch.complaints.clear()
