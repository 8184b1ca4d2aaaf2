"""Waiting for a page: for what should become true, never for a time that is long enough on a fast machine."""

import time


def drawn_again(page) -> None:
    """Wait until what the page has scheduled for its next frame is done."""
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def eventually(page, holds, seconds=15) -> None:
    """Wait until ``holds()``; fails if it does not come to hold."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, f"still not so after {seconds} seconds"
        page.wait_for_timeout(50)
