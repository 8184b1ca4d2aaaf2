"""What the Features page and the data folder say of retrieval."""

from __future__ import annotations

import csv
import io

import numpy as np
import pytest
from reports import make_report, with_bin_search, with_retrieval, with_search

from shapeviz_report.pages.about import AboutPage
from shapeviz_report.pages.features import FeaturesPage
from shapeviz_report.retrieval import MEASURES, RECALL_LEVELS
from shapeviz_report.writing.data import data_files, summary

FEATURES = ("Gc", "Sc", "PFH")


@pytest.fixture(scope="module")
def report():
    labelled = make_report(["ant", "bird", "cup", None], 6, features=FEATURES)
    return with_retrieval(with_bin_search(with_search(labelled)))


@pytest.fixture(scope="module")
def chunk(report):
    return FeaturesPage().content(report).chunks["retrieval"]


@pytest.mark.slow
def test_the_chunk_has_every_subset_of_the_search(report, chunk) -> None:
    searched = FeaturesPage().content(report).chunks["search"]["members"]
    assert sorted(chunk["members"]) == sorted(searched)
    assert len(chunk["subsets"]) == 7
    for rated in (*chunk["subsets"], chunk["byBins"], chunk["chance"]):
        assert len(rated["shapes"]) == len(rated["classes"]) == len(MEASURES)
        assert len(rated["curveOfShapes"]) == len(rated["curveOfClasses"]) == len(RECALL_LEVELS)
        assert np.shape(rated["each"]) == (3, len(MEASURES))
        values = [*rated["shapes"], *rated["curveOfClasses"], *np.ravel(rated["each"])]
        assert all(0 <= value <= chunk["steps"] for value in values)


def test_the_chunk_names_the_best_and_orders_features_by_what_they_find(report, chunk) -> None:
    average = [rated["shapes"][-1] for rated in chunk["subsets"]]
    assert average[chunk["best"]] == max(average)
    alone = [average[chunk["members"].index(code)] for code in ("100", "010", "001")]
    assert [alone[feature] for feature in chunk["order"]] == sorted(alone, reverse=True)


def test_the_context_says_what_all_features_find(report) -> None:
    context = FeaturesPage().content(report).context["retrieval"]
    everything = report.retrieval.subsets[report.retrieval.place(FEATURES)]
    assert context["queries"] == 18
    assert context["nearest"] == pytest.approx(everything.scores[:, 0].mean())
    assert context["chance"] == pytest.approx(5 / 23)
    assert context["bins"] == len(report.bins.automatic.bins)


def test_without_a_search_each_feature_and_all_are_rated() -> None:
    content = FeaturesPage().content(with_retrieval(make_report(features=FEATURES)))
    assert content.context["search"] is None
    assert sorted(content.chunks["retrieval"]["members"]) == ["001", "010", "100", "111"]


def test_without_two_shapes_of_a_class_there_is_no_section() -> None:
    content = FeaturesPage().content(with_retrieval(make_report(["ant", "bird", None], 1)))
    assert content.context["retrieval"] is None
    assert "retrieval" not in content.chunks


def test_summary_and_tables_agree_with_the_report(report) -> None:
    told = summary(report, "0")["retrieval"]
    retrieval = report.retrieval
    sc = retrieval.subsets[retrieval.place(("Sc",))]
    assert told["features"]["Sc"]["first_tier"] == pytest.approx(sc.scores[:, 1].mean())
    assert told["features"]["Sc"]["class_mean"]["dcg"] == pytest.approx(sc.scores[:, 4].mean())
    assert told["best"]["average_precision"] >= told["everything"]["average_precision"]
    assert told["bins"]["bins"] == list(report.bins.automatic.bins)
    assert told["chance"]["nearest_neighbour"] == pytest.approx(5 / 23)

    files = dict(data_files(report, "0"))
    rows = list(csv.DictReader(io.StringIO(files["retrieval.csv"].decode())))
    assert len(rows) == 2 * (7 + 1 + 1 + 1)
    (own,) = [
        row
        for row in rows
        if (row["compared"], row["over"]) == ("features", "shapes")
        and [row[f"feature:{name}"] for name in FEATURES] == ["0", "1", "0"]
    ]
    assert float(own["first_tier"]) == pytest.approx(told["features"]["Sc"]["first_tier"], abs=1e-6)
    assert float(own["precision:0.05"]) == pytest.approx(told["features"]["Sc"]["precision"][0], abs=1e-6)
    offered = [file for file, _ in AboutPage().content(report).context["downloads"]]
    assert {"retrieval.csv", "retrieval-classes.csv"} <= set(offered)
    classes = list(csv.DictReader(io.StringIO(files["retrieval-classes.csv"].decode())))
    assert len(classes) == 3 * (7 + 1 + 1 + 1)
    assert {(row["class"], row["queries"]) for row in classes} == {("ant", "6"), ("bird", "6"), ("cup", "6")}


def test_means_over_shapes_and_over_classes_differ_where_classes_do() -> None:
    report = make_report(["ant", "bird"], 8, features=FEATURES)
    labels = tuple("ant" if row < 3 else "bird" for row in range(16))
    rated = with_retrieval(type(report)(**{**vars(report), "labels": labels})).retrieval
    scores = rated.subsets[0].scores
    assert rated.queries.tolist() == [3, 13]
    assert rated.over_shapes(scores) == pytest.approx((3 * scores[0] + 13 * scores[1]) / 16)
