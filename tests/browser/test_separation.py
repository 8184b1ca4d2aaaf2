"""Whether the map or the features mix classes: what the Overview says of it, and the table that it leads to."""

import re

import numpy as np
import pytest
from waiting import box_of, eventually

from shapeviz_report.presets import PRESETS, scale

FEATURES = "features"


def nearest_of(report, place) -> np.ndarray:
    """The shape nearest to each; place is that of a map, or of all features."""
    points = (
        scale(report.features, PRESETS["default"]) if place == FEATURES else report.projections[place][0].xy
    )
    distances = np.linalg.norm(points[:, None] - points[None], axis=2)
    np.fill_diagonal(distances, np.inf)
    return distances.argmin(axis=1)


def of_their_class(report, place) -> np.ndarray:
    """Whether the nearest shape is of the same class."""
    labels = np.array(report.labels)
    return labels == labels[nearest_of(report, place)]


def whole(share) -> str:
    return f"{round(100 * share)}\u00a0%"


@pytest.fixture
def told(open_page):
    """Open the Overview and its answer to how good the map is; gives the page and the section as text."""

    def open_(name, hash_="", **options):
        page = open_page(name, f"index.html{hash_}", **options)
        page.click("#how-good summary")
        page.wait_for_selector("#bars svg")
        return page, lambda: re.sub(r"[ \n\t]+", " ", page.locator("#quality").inner_text())

    return open_


TITLE = "Is it the map, or the features?"


@pytest.mark.parametrize("method", ["tsne", "umap", "pca"])
def test_features_and_map_are_held_against_each_other(told, reports, method):
    report = reports("plain")
    _, text = told("plain", "" if method == "tsne" else f"#map={method}")
    own, mapped = (of_their_class(report, place).mean() for place in (FEATURES, method))
    said = text().split(TITLE)[1].split("Does it show")[0]
    assert said.startswith(f" {whole(own)} by features {whole(mapped)} on this map")
    assert "For so many shapes the nearest one is of the same class." in said
    # The labels of the site are dealt at random: no feature knows them.
    assert "The features themselves cannot tell many of these classes apart" in said


def test_the_class_that_is_hardest_to_tell_is_named_with_what_it_is_mistaken_for(told, reports):
    report = reports("plain")
    _, text = told("plain")
    nearest, hits = nearest_of(report, FEATURES), of_their_class(report, FEATURES)
    labels = np.array(report.labels)
    counts = {label: int(hits[labels == label].sum()) for label in sorted(set(report.labels))}
    hardest = min(counts, key=counts.__getitem__)
    right = counts[hardest] or "none"
    assert (
        f"Hardest to tell by features is {hardest}: the nearest shape is of this class for {right} of its 10 shapes"
        in text()
    )
    # Where none has one of its class nearest, there are no others.
    others, mistaken = re.search(r"; (for the others )?it is most often of (kind \w)", text()).groups()
    assert (others is None) == ("for none of its" in text())
    others = labels[nearest[(labels == hardest) & ~hits]].tolist()
    assert others.count(mistaken) == max(others.count(other) for other in others)


def test_another_map_has_another_figure(told, reports):
    report = reports("searched")
    page, text = told("searched")
    for method, title in (("umap", "UMAP"), ("pca", "PCA"), ("tsne", "t-SNE")):
        page.locator("#methods label", has_text=title).click()
        share = whole(of_their_class(report, method).mean())
        eventually(page, lambda: f"by features {share} on this map" in text())  # noqa: B023


def test_of_the_map_of_a_subset_nothing_is_said(told):
    page, text = told("searched", "#features=Gc Sc")
    assert "Do classes keep together?" in text()
    assert TITLE not in text()
    page.locator("#features label", has_text="All features").click()
    eventually(page, lambda: TITLE in text())


@pytest.mark.parametrize("name", ["no labels", "clusters", "one class"])
def test_where_no_class_can_be_told_apart_nothing_is_said(open_page, name):
    page = open_page(name)
    if page.locator("#how-good:not([open])").count():
        page.click("#how-good summary")
    assert page.locator("#quality").get_by_text(TITLE).count() == 0
    assert open_page(name, "features.html").locator("#separation").count() == 0


@pytest.mark.parametrize("width", [390, 1440])
def test_the_link_leads_to_each_class(told, reports, width):
    report = reports("searched")
    page, _ = told("searched", viewport={"width": width, "height": 844})
    page.get_by_role("link", name="Each class").click()
    page.wait_for_url("**/features.html*")
    page.wait_for_selector("html[data-ready]", state="attached")
    section = page.locator("#separation")
    eventually(page, lambda: 0 <= box_of(section.locator("h2"))["y"] < 600)
    section.locator("details summary").click()
    head = section.locator("thead th").all_inner_texts()
    rows = [row.split("\t") for row in section.locator("tbody tr").all_inner_texts()]
    labels = np.array(report.labels)
    for place, column in ((FEATURES, "Nearest, by features"), ("tsne", "on t-SNE"), ("umap", "on UMAP")):
        hits = of_their_class(report, place)
        found = {row[0]: int(row[head.index(column)]) for row in rows}
        assert found == {label: int(hits[labels == label].sum()) for label in set(report.labels)}
    # The hardest first.
    known = [int(row[head.index("Nearest, by features")]) / int(row[1]) for row in rows]
    assert known == sorted(known)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
