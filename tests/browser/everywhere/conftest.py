"""The same tests in Chromium, Firefox and WebKit, one window of each for all of them."""

from __future__ import annotations

import base64
import functools
import hashlib
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from browsers import BROWSERS, opened
from webdriver import Window

LISTENING = Path(__file__).with_name("listening.js").read_text(encoding="utf-8")
DIGEST = base64.b64encode(hashlib.sha256(LISTENING.encode()).digest()).decode()


@pytest.fixture(scope="session", params=BROWSERS)
def browser_window(request, tmp_path_factory) -> Iterator[Window]:
    with opened(request.param, tmp_path_factory.mktemp(request.param) / "files") as window:
        yield window


@pytest.fixture(scope="session")
def heard_site(site, tmp_path_factory) -> Callable[[str], str]:
    """The address of a site whose pages keep what a browser complains of."""

    @functools.cache
    def address(name: str) -> str:
        folder = tmp_path_factory.mktemp("heard") / "site"
        shutil.copytree(site(name), folder)
        (folder / "listening.js").write_text(LISTENING, encoding="utf-8")
        for page in folder.glob("*.html"):
            listen(page, page, '<script src="listening.js"></script>')
        return folder.as_uri()

    return address


@pytest.fixture(scope="session")
def heard_file(single_file, tmp_path_factory) -> Callable[[str], str]:
    """The address of a site in one file, which keeps what a browser complains of."""

    @functools.cache
    def address(name: str) -> str:
        file = tmp_path_factory.mktemp("heard") / "site.html"
        listen(single_file(name), file, f"<script>{LISTENING}</script>")
        return file.as_uri()

    return address


def listen(source: Path, destination: Path, script: str) -> None:
    """Put a script before all others of a page, and allow it."""
    before, policy, after = source.read_text(encoding="utf-8").partition("script-src ")
    head, end, rest = after.partition('">')
    assert policy
    assert end
    destination.write_text(f"{before}{policy}'sha256-{DIGEST}' {head}{end}{script}{rest}", encoding="utf-8")


@pytest.fixture
def visit(browser_window, heard_site) -> Iterator[Callable[..., Window]]:
    """Load a page into the window, and wait until it is drawn.

    A complaint of the browser's fails the test.
    """

    visited = False

    def load(name: str, file: str, address: str | None = None) -> Window:
        nonlocal visited
        if visited:
            assert complaints(browser_window) == []
        visited = True
        browser_window.visit(address or f"{heard_site(name)}/{file}")
        drawn(browser_window)
        return browser_window

    yield load
    assert complaints(browser_window) == []


@pytest.fixture
def follow(browser_window) -> Callable[[str, str], None]:
    """Click a link to another page, and wait until this is drawn."""

    def click(selector: str, text: str) -> None:
        assert complaints(browser_window) == []
        browser_window.evaluate("() => { document.body.dataset.left = ''; }")
        browser_window.click(selector, text)
        browser_window.until("() => !('left' in document.body.dataset)")
        drawn(browser_window)

    return click


def complaints(window: Window) -> list[str]:
    return window.evaluate("() => window.complaints")


def drawn(window: Window) -> None:
    """Wait until the page is drawn; the one that says what it is about draws nothing."""
    window.until(
        "() => document.readyState === 'complete' && "
        "('ready' in document.documentElement.dataset || document.body.classList.contains('page-about'))"
    )
