"""A report in a notebook: the site lives in its frame, and leads nowhere else."""

from __future__ import annotations

from shapeviz_report.writing import ShownReport


def drawn(window) -> None:
    window.until("() => 'ready' in document.documentElement.dataset")


def test_a_site_in_the_frame_of_a_notebook(browser_window, reports, tmp_path) -> None:
    shown = ShownReport(**vars(reports("workbench")))._repr_html_()
    notebook = tmp_path / "notebook.html"
    notebook.write_text(f"<!doctype html><meta charset=utf-8><title>notebook</title>{shown}", "utf-8")
    browser_window.visit(notebook.as_uri())
    browser_window.enter(0)
    browser_window.until("() => frames.length")
    browser_window.enter(0)
    drawn(browser_window)
    browser_window.evaluate("() => document.querySelector('nav a[href*=features]').click()")
    browser_window.leave()
    browser_window.enter(0)
    browser_window.until("() => document.querySelector('iframe').srcdoc.includes('#/features')")
    browser_window.enter(0)
    drawn(browser_window)
    assert browser_window.evaluate("() => document.body.className") == "page-features"
    # one that reaches nothing
    assert browser_window.evaluate("() => window.origin") == "null"
