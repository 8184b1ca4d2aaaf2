"""The Retrieval section of the Features page, used as a reader would."""

from __future__ import annotations

import pytest
from reports import make_report, with_bin_search, with_retrieval, with_search
from waiting import box_of

from shapeviz_report.writing import write_site

KINDS = [f"kind {letter}" for letter in "abcd"]
FEATURES = ("Gc", "Sc", "PFH")


@pytest.fixture(scope="module")
def report():
    return with_retrieval(with_bin_search(with_search(make_report(KINDS, 8, features=FEATURES))))


@pytest.fixture(scope="module")
def address(report, tmp_path_factory):
    folder = tmp_path_factory.mktemp("retrieval") / "site"
    write_site(report, folder)
    return f"{folder.as_uri()}/features.html"


def texts(page, selector: str) -> list[str]:
    return [" ".join(text.split()) for text in page.locator(selector).all_inner_texts()]


def figures(row: str) -> list[str]:
    return row.split()[-6:]


def listed(page) -> dict[str, list[str]]:
    """The figures of each row, by its key."""
    rows = page.locator(".ratings tbody tr")
    return {row.get_attribute("data-key"): figures(" ".join(row.inner_text().split())) for row in rows.all()}


def test_every_choice_has_a_row_and_a_line_with_the_figures_of_the_report(open_page, address, report) -> None:
    page = open_page("", address=address)
    rows = listed(page)
    retrieval = report.retrieval
    assert set(rows) >= {"chosen", "neighbourhood", "bins", "chance"}
    others = {
        "neighbourhood": retrieval.by_neighbourhood,
        "bins": retrieval.by_bins,
        "chance": retrieval.chance,
    }
    for key, rating in others.items():
        assert rows[key] == [f"{value:.3f}" for value in retrieval.over_shapes(rating.scores)]
    lines = page.locator("#retrieval-curves .rating-line")
    assert sorted(line.get_attribute("data-key") for line in lines.all()) == sorted(rows)
    assert "of 100" in page.locator("#retrieval > p").first.inner_text()


def test_the_chosen_subset_of_the_page_is_that_of_the_section(open_page, address, report) -> None:
    page = open_page("", address=address)
    page.locator("#panel .chip", has_text="PFH").wait_for()
    page.locator('.ratings tr[data-key^="feature"] button', has_text="Sc").click()
    # The panel above and the address follow.
    page.wait_for_selector('#panel .chip[aria-pressed="true"]:has-text("Sc")')
    assert texts(page, '#panel .chip[aria-pressed="true"] .name') == ["Sc"]
    retrieval = report.retrieval
    expected = retrieval.over_shapes(retrieval.subsets[retrieval.place(("Sc",))].scores)
    assert listed(page)["chosen"] == [f"{value:.3f}" for value in expected]
    # And the section follows the panel.
    page.locator("#panel .chip", has_text="PFH").last.click()
    place = retrieval.place(("Sc", "PFH"))
    expected = retrieval.over_shapes(retrieval.subsets[place].scores)
    page.wait_for_selector('#panel .chip[aria-pressed="true"]:has-text("PFH")')
    assert listed(page)["chosen"] == [f"{value:.3f}" for value in expected]


def test_a_row_is_chosen_from_the_keyboard_and_keeps_the_focus(open_page, address) -> None:
    page = open_page("", address=address)
    button = page.locator(".ratings button").last
    key = button.locator("xpath=ancestor::tr").get_attribute("data-key")
    button.focus()
    # What has the focus is brought out among the lines.
    assert page.locator("#retrieval-curves .rating-line.pointed").get_attribute("data-key") == key
    page.keyboard.press("Enter")
    page.wait_for_selector('.ratings tr[data-key="chosen"]')
    assert page.evaluate("document.activeElement.closest('.ratings') !== null")


def test_pointing_at_a_line_marks_its_row_and_the_other_way_round(open_page, address) -> None:
    page = open_page("", address=address)
    page.locator('.ratings tr[data-key="chance"]').hover()
    assert page.locator(".rating-line.pointed").get_attribute("data-key") == "chance"
    page.locator("#retrieval-curves").scroll_into_view_if_needed()
    box = box_of(page.locator('#retrieval-curves .reach path[data-key="chance"]'))
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert page.locator(".ratings tr.pointed").get_attribute("data-key") == "chance"
    page.mouse.move(2, 2)
    assert page.locator(".rating-line.pointed").count() == 0


def test_the_mean_is_over_shapes_or_over_classes(open_page, tmp_path) -> None:
    report = make_report(KINDS[:2], 8, features=FEATURES)
    labels = tuple("kind a" if row < 4 else "kind b" for row in range(16))
    report = with_retrieval(type(report)(**{**vars(report), "labels": labels}))
    write_site(report, tmp_path / "site")
    page = open_page("", address=f"{(tmp_path / 'site').as_uri()}/features.html")
    retrieval = report.retrieval
    scores = retrieval.subsets[retrieval.place(FEATURES)].scores
    # A site without a search has the section, and nothing to choose.
    assert page.locator(".ratings button").count() == 0
    assert listed(page)["chosen"] == [f"{value:.3f}" for value in retrieval.over_shapes(scores)]
    page.locator('input[name="over"][value="classes"]').check(force=True)
    assert listed(page)["chosen"] == [f"{value:.3f}" for value in scores.mean(axis=0)]
    page.locator("#open-tables").click()
    assert "Retrieval, mean over classes" in texts(page, "#tables caption")


def test_each_class_and_the_tables_follow_the_chosen_subset(open_page, address, report) -> None:
    page = open_page("", address=address)
    page.locator("#retrieval summary").last.click()
    page.locator("#retrieval-classes table").wait_for()
    retrieval = report.retrieval
    chosen = tuple(texts(page, '#panel .chip[aria-pressed="true"] .name'))
    scores = retrieval.subsets[retrieval.place(chosen)].scores
    expected = {name: [f"{value:.3f}" for value in row] for name, row in zip(retrieval.classes, scores)}
    shown = {row[:6]: figures(row) for row in texts(page, "#retrieval-classes tbody tr")}
    assert shown == expected
    page.locator("#open-tables").click()
    captions = texts(page, "#tables caption")
    assert "Precision at each recall, mean over shapes" in captions
    assert any(caption.startswith("Retrieval of each class by ") for caption in captions)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone_shows_it_without_sideways_scrolling(open_page, address, scheme) -> None:
    page = open_page("", address=address, viewport={"width": 390, "height": 800}, color_scheme=scheme)
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    first = page.locator(".ratings tbody th").first
    page.locator(".retrieval .wide").first.evaluate("(node) => { node.scrollLeft = 400; }")
    # The names stay where the figures scroll.
    assert box_of(first)["x"] >= 0
    assert box_of(first)["width"] >= 100
