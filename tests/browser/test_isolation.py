"""The site keeps to itself: from a double-click and from any host, it asks for nothing but its own files."""

import re

import pytest
from waiting import rested

from shapeviz_report.pages import PAGES


def use(page):
    """Everything that loads something: Vega's maps, the details, a theme, another projection, the pictures."""
    page.keyboard.press("5")
    page.locator("#methods label").last.click()
    page.fill("#search", "kind a")
    page.click("#search-select")
    page.locator("#tray .shape").first.click()
    page.wait_for_selector("#detail:not([hidden])")
    page.click("#theme")
    # What follows a click by timers: the settled picture, the address.
    rested(page, 900)


def test_from_a_double_click_only_files_of_the_site_are_read(open_page, site):
    page = open_page("plain")
    use(page)
    folder = site("plain").as_uri()
    assert len(page.watch.requests) > 20
    outside = [url for url in page.watch.requests if not url.startswith((f"{folder}/", "blob:", "data:"))]
    assert outside == []


def test_from_a_host_below_a_path_only_that_path_is_asked(open_page, site, serve):
    address = serve(site("plain"), "some/where/deep")
    page = open_page("plain", address=f"{address}/index.html")
    use(page)
    outside = [url for url in page.watch.requests if not url.startswith((f"{address}/", "blob:", "data:"))]
    assert outside == []
    page.click("nav a >> text=About")
    page.wait_for_selector("text=SHA-256", state="attached")


@pytest.mark.parametrize("file", [page.file for page in PAGES])
def test_a_host_that_names_other_letters_is_not_believed(open_page, site, serve, file):
    page = open_page("plain", address=f"{serve(site('plain'), 'shapes')}/{file}")
    assert page.evaluate("document.characterSet") == "UTF-8"
    # What the three first letters of a dash, a quotation mark and a narrow space would be.
    assert not re.search("â|Ã|Â", page.inner_text("body"))
    marks = page.evaluate(
        "getComputedStyle(document.querySelector('.save-figure summary, body'), '::before').content"
    )
    assert "â" not in marks


@pytest.mark.parametrize("file", ["index.html", "about.html"])
def test_the_policy_is_in_force(open_page, file):
    """A request that a script would make is refused, so the policy is not just words."""
    page = open_page("plain", file)
    refused = page.evaluate(
        """async () => {
            const violations = [];
            document.addEventListener("securitypolicyviolation", (event) => violations.push(event.effectiveDirective));
            await fetch("https://example.org/").catch(() => {});
            const picture = new Image();
            picture.src = "https://example.org/picture.png";
            const style = document.createElement("style");
            style.textContent = "body { color: red }";
            document.head.append(style);
            try { document.body.innerHTML = "<p>markup</p>"; } catch {}
            try { eval("1"); } catch {}
            await new Promise((resolve) => setTimeout(resolve, 200));
            return violations;
        }"""
    )
    assert {"connect-src", "img-src", "style-src-elem", "require-trusted-types-for"} <= set(refused)
    assert any(directive.startswith(("script-src", "require-trusted-types")) for directive in refused)
    page.watch.complaints.clear()


def test_one_name_is_added_to_the_window_beside_vega(open_page, browser, tmp_path):
    page = open_page("plain")
    (tmp_path / "empty.html").write_text("<!doctype html>")
    plain = browser.new_page()
    plain.goto((tmp_path / "empty.html").as_uri())
    names = "() => Object.getOwnPropertyNames(window)"
    added = set(page.evaluate(names)) - set(plain.evaluate(names))
    plain.close()
    assert {name for name in added if not re.fullmatch(r"\d+", name)} <= {"shapeviz", "vega"}
