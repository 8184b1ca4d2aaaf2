"""Waiting for a page or processes: for what should become true, never for a time that a fast machine needs."""

import time


def drawn_again(page) -> None:
    """Wait until what the page has scheduled for its next frame is done."""
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def rested(page, milliseconds) -> None:
    """Wait until a page has done what it does by timers of so many milliseconds: its own timers come in their order,
    however slow the machine is."""
    page.evaluate("(milliseconds) => new Promise((done) => setTimeout(done, milliseconds))", milliseconds)
    drawn_again(page)


def eventually(page, holds, seconds=30) -> None:
    """Wait until ``holds()``; fails if it does not come to hold."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, f"still not so after {seconds} seconds"
        page.wait_for_timeout(50)


def box_of(locator, seconds=30) -> dict[str, float]:
    """Where an element is on the screen; of one that the page draws anew meanwhile, where the new one is."""
    end = time.monotonic() + seconds
    while (box := locator.bounding_box()) is None:
        assert time.monotonic() < end, f"{locator} is still not seen after {seconds} seconds"
        locator.page.wait_for_timeout(50)
    return box


def wait_until(holds, seconds: float = 120) -> None:
    """Wait until processes have come so far that ``holds()``; fails if they do not."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, f"still not so after {seconds} seconds"
        time.sleep(0.01)
