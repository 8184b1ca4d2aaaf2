"""Databases of few shapes, or of one class, where no map can do better than chance: pages say so, and judge nothing."""

import re

import pytest
from reports import make_report

from shapeviz_report.writing import write_site

ALL = "With 8 shapes, each has all others among its 7 nearest on any map."
ONE = "All labelled shapes are of one class, which no map can mix with another."


def text_of(page, selector) -> str:
    return re.sub(r"\s+", " ", page.locator(selector).inner_text())


@pytest.mark.parametrize(("name", "why"), [("few", ALL), ("one class searched", ONE), ("one class", ONE)])
def test_the_overview_says_why_it_has_no_verdict(open_page, name, why):
    page = open_page(name)
    if page.locator("#how-good:not([open])").count():
        page.click("#how-good summary")
    told = text_of(page, "#quality")
    assert told.startswith(f"{why} So the neighbourhood hit says nothing of this one.")
    assert "Is it the map, or the features?" not in told
    assert page.locator("#features label", has_text="Best subset").count() == 0


def test_of_few_shapes_any_map_keeps_all_neighbours(open_page):
    page = open_page("few")
    page.click("#how-good summary")
    told = text_of(page, "#quality")
    assert "8 shapes are too few to say by their neighbours: each has all others among its 7 nearest" in told
    assert "on a map at random" not in told


@pytest.mark.parametrize(("name", "why"), [("few", ALL), ("one class searched", ONE)])
def test_features_are_not_ranked(open_page, name, why):
    page = open_page(name, "features.html")
    lead = text_of(page, ".lead")
    assert lead.startswith(f"{why} So no subset of its features can be called better than another.")
    said = text_of(page, "main")
    for verdict in ("Which features keep", "the best of", "Greedy", "adds or spoils", "tell most of"):
        assert verdict not in said
    options = page.locator("#rank option").all_inner_texts()
    assert "NH" not in options
    assert ("Neighbours kept" in options) is (name != "few")


def test_few_shapes_are_too_few_to_tell_classes_apart(open_page):
    page = open_page("few", "features.html")
    assert page.locator("#separation").count() == 0
    page = open_page("six", "features.html")
    said = text_of(page, "#separation")
    assert "With 6 shapes that have a class, each has all others among its 5 nearest: too few to say." in said
    for verdict in ("elect", "tell most", "chance"):
        assert verdict not in said


def test_the_workbench_has_no_example_of_mixed_classes(open_page):
    page = open_page("few", "workbench.html")
    page.wait_for_selector(".map[data-map=original] .nh .symbol")
    assert page.locator("#guide").is_hidden()
    assert "says nothing here: with 8 shapes" in text_of(page, ".map[data-map=original] .nh")
    assert text_of(page, ".map[data-map=original] .faith") == ""


def test_no_classes_are_said_to_be_alike(open_page):
    page = open_page("few", "compare.html#view=classes")
    assert "8 shapes are too few to say which classes are alike" in text_of(page, "#classes")
    page = open_page("few", "compare.html#a=class:kind+a&b=class:kind+b")
    page.wait_for_selector("#answer h2")
    assert "most like a shape of" not in text_of(page, "#answer")


def test_no_bins_are_said_to_keep_classes_apart(open_page):
    page = open_page("few bins", "bins.html")
    assert f"{ALL} So no bins can be said to keep classes apart." in text_of(page, ".notice")
    for part in ("#path", "#class-cards"):
        assert page.locator(part).count() == 0
    # The Workbench does not offer them either.
    page = open_page("few bins", "workbench.html")
    assert "the build found" not in text_of(page, "main")


def test_shapes_that_are_alone_in_their_classes_are_not_called_fitting(open_page, tmp_path):
    write_site(make_report(["ant", "bee", None], 1), tmp_path / "site")
    page = open_page("six", address=f"{(tmp_path / 'site').as_uri()}/compare.html#view=outliers")
    assert text_of(page, "#outlier-words").startswith("Each shape here is the only one of its class")


@pytest.mark.parametrize(
    ("first", "second", "words"),
    [("class:ant", "rest", "No difference could show by so few shapes"), ("class:ant", "class:bird", "")],
)
def test_where_nothing_could_show_that_is_said(open_page, first, second, words):
    page = open_page("six", f"compare.html#a={first}&b={second}")
    page.wait_for_selector("#result:not([hidden])", state="attached")
    told = text_of(page, "#answer")
    ways = {"rest": "15", "class:bird": "three"}[second]
    assert words in told
    assert f"there are only {ways} ways to deal them out" in told
