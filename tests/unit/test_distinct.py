"""Figures without copies are those of a database that never had them."""

from __future__ import annotations

import numpy as np
import pytest
from reports import make_report, with_bin_search, with_copies, with_retrieval, with_search

from shapeviz_report.distinct import rate_without_copies
from shapeviz_report.pages.about import AboutPage
from shapeviz_report.pages.bins import BinsPage
from shapeviz_report.pages.features import FeaturesPage
from shapeviz_report.pages.overview import OverviewPage
from shapeviz_report.quality import hits_among, neighbour_weights, neighbourhood_hits, score
from shapeviz_report.retrieval import MEASURES, query_classes, rate
from shapeviz_report.types import Report, distinct_rows
from shapeviz_report.writing.data import summary

LABELS = ["ant", "bird", "ant", "bird", "ant", "bird"]
POINTS = np.array([[0, 0], [1, 0], [2, 0.3], [3.1, 0], [4.5, 0], [6, 1]], float)


def distances(points: np.ndarray) -> np.ndarray:
    return ((points[:, None] - points[None]) ** 2).sum(axis=2)


def test_planted_copies_change_the_figures_and_leave_none_behind() -> None:
    copied = [0, 5, 0]
    points, labels = np.concatenate([POINTS, POINTS[copied]]), LABELS + [LABELS[row] for row in copied]
    groups = np.array([0, 1, 2, 3, 4, 5, 0, 5, 0])
    found = rate_without_copies(
        groups, labels, {"pca": points}, 2, np.arange(9), {"everything": distances(points)}
    )
    assert found is not None
    assert found.copies == 3
    assert found.nh_s["pca"] == score(POINTS, LABELS, k=2).nh_s != score(points, labels, k=2).nh_s
    _, codes = query_classes(LABELS)
    alone = rate(distances(POINTS), codes).scores.mean(axis=0)
    np.testing.assert_allclose(found.retrieval["everything"], alone)


def test_a_sample_is_freed_of_its_own_copies() -> None:
    rows = np.array([1, 2, 3, 4, 5])
    groups = np.array([0, 1, 0, 2, 3, 1])
    found = rate_without_copies(groups, LABELS, {}, 2, rows, {"everything": distances(POINTS[rows])})
    assert found is not None
    kept = np.array([1, 2, 3, 4])
    _, codes = query_classes([LABELS[row] for row in kept])
    np.testing.assert_allclose(
        found.retrieval["everything"], rate(distances(POINTS[kept]), codes).scores.mean(axis=0)
    )


def test_nothing_is_said_without_copies_and_none_of_retrieval_without_a_class_of_two() -> None:
    squared = {"everything": distances(POINTS)}
    assert rate_without_copies(np.arange(6), LABELS, {"pca": POINTS}, 2, np.arange(6), squared) is None
    pairs = rate_without_copies(
        np.array([0, 1, 0, 1, 0, 1]), LABELS, {"pca": POINTS}, 2, np.arange(6), squared
    )
    assert pairs is not None
    assert pairs.retrieval == {}
    assert pairs.nh_s["pca"] == pairs.nh_max == 0


@pytest.fixture
def report() -> Report:
    return with_copies(with_retrieval(make_report(["ant", "bird"], 8)), [(0, 1), (8, 9)])


def test_the_data_and_the_pages_give_both_figures(report: Report) -> None:
    data = summary(report, "1")["without_copies"]
    assert report.without_copies is not None
    assert data["copies"] == 2
    assert data["projections"]["tsne"] == {
        "nh_s": report.without_copies.nh_s["tsne"],
        "nh_max": report.without_copies.nh_max,
    }
    assert set(data["retrieval"]["everything"]) == {measure.name for measure in MEASURES}
    methods = OverviewPage().content(report).chunks["overview"]["methods"]
    assert methods[0]["withoutCopies"] == {
        "copies": 2,
        "hitOfAll": report.without_copies.nh_s["tsne"],
        "highest": report.without_copies.nh_max,
    }
    said = FeaturesPage().content(report).context["retrieval"]["without_copies"]
    assert said["copies"] == 2
    assert said["nearest"] == report.without_copies.retrieval["everything"][0]
    about = AboutPage().content(report).context["projections"]
    assert [row["without_copies"] for row in about] == list(report.without_copies.nh_s.values())


@pytest.mark.slow
def test_what_was_chosen_and_what_was_held_out_is_given_without_copies_too() -> None:
    report = with_copies(with_bin_search(with_search(make_report(["ant", "bird"], 8))), [(0, 1), (8, 9)])
    assert report.bins is not None
    assert report.search is not None
    assert report.without_copies is not None
    kept = np.array([0, *range(2, 9), *range(10, 16)])
    chosen = report.bins.automatic.path[-1].xy[kept]
    assert report.without_copies.bins == score(chosen, [report.labels[row] for row in kept]).nh_s
    best = report.search.subsets.xy[report.search.subsets.nh_s.argmax()][kept]
    assert report.without_copies.best == score(best, [report.labels[row] for row in kept]).nh_s
    data = summary(report, "1")
    assert data["without_copies"]["bins"]["nh_s"] == report.without_copies.bins
    for page, place in ((BinsPage(), "selection"), (FeaturesPage(), "search")):
        said = page.content(report).context[place]
        said = said if place == "selection" else said["held_out"]
        assert 0 <= said["distinct"]["nh_s"] <= 1
        assert said["distinct"]["gain"].mean == pytest.approx(
            said["distinct"]["nh_s"] - said["distinct"]["all"]
        )
    gain = data["bins"]["automatic"]["held_out"]["gain_without_copies"]
    assert gain["mean"] == BinsPage().content(report).context["selection"]["distinct"]["gain"].mean
    assert data["search"]["held_out_gain_without_copies"]["deals"] == 10


def test_nothing_is_said_where_there_are_no_copies() -> None:
    report = with_retrieval(make_report(["ant", "bird"], 8))
    assert summary(report, "1")["without_copies"] is None
    assert OverviewPage().content(report).chunks["overview"]["methods"][0]["withoutCopies"] is None
    assert FeaturesPage().content(report).context["retrieval"]["without_copies"] is None


def test_held_out_shapes_and_chosen_bins_are_rated_without_copies() -> None:
    """Copies of one another are neighbours on any map: without them a map that holds nothing else has nothing."""
    random = np.random.default_rng(4)
    values = random.random((12, 2)).repeat(2, axis=0)
    labels = list(random.permutation(np.repeat(["a", "b"], 6)).repeat(2))
    codes = np.array([label == "b" for label in labels], int)
    groups = np.arange(12).repeat(2)
    kept = distinct_rows(groups, codes >= 0)
    assert kept is not None
    alone = hits_among(values, codes, kept, 1)
    assert np.isnan(alone[1::2]).all()
    np.testing.assert_array_equal(
        alone[kept], neighbourhood_hits(neighbour_weights(values[kept], 1), codes[kept])
    )
    assert alone[kept].mean() < 1 == neighbourhood_hits(neighbour_weights(values, 1), codes).mean()
