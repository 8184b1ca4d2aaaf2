"""The Features page says what every subset reaches, and how sure that is."""

from dataclasses import replace

import numpy as np
import pytest
from packed_chunks import packed
from reports import NASTY_LABELS, make_report, with_best, with_search

from shapeviz_report.pages.base import SHARE_STEPS, change
from shapeviz_report.pages.features import FeaturesPage, Ranking, _of_paper
from shapeviz_report.pages.overview import OverviewPage
from shapeviz_report.writing import write_site

FEATURES = ("Gc", "Sc", "PFH", "FPFH")


@pytest.fixture(scope="module")
def report():
    return with_search(make_report([f"kind {letter}" for letter in "abcd"], 8, features=FEATURES))


@pytest.fixture(scope="module")
def content(report):
    return FeaturesPage().content(report)


@pytest.mark.slow
def test_chunks_are_json_and_the_same_every_time(report, content):
    again = FeaturesPage().content(report)
    assert again.context == content.context
    assert packed(again.chunks) == packed(content.chunks)


def test_subsets_stand_from_best_to_worst_with_their_own_scores(report, content):
    scores = content.chunks["search"]
    assert len(scores["members"]) == len(set(scores["members"])) == 15
    assert scores["hit"] == sorted(scores["hit"], reverse=True)
    subsets = report.search.subsets
    for place, code in enumerate(scores["members"]):
        row = next(i for i, has in enumerate(subsets.members) if "".join("01"[int(h)] for h in has) == code)
        assert scores["hit"][place] == pytest.approx(subsets.nh_s[row], abs=1e-6)
        assert scores["hitOfClass"][place] == pytest.approx(subsets.nh_c[row], abs=1e-6)


def test_maps_read_back_close_enough_to_keep_the_nearest_neighbours(report, content):
    maps = content.chunks["subsets"]
    order = list(Ranking.of(report.search).order)
    xy = np.stack([maps["x"], maps["y"]], axis=-1) / maps["steps"]
    np.testing.assert_allclose(xy, report.search.subsets.xy[order], atol=2e-5)
    np.testing.assert_allclose(
        np.array(maps["hit"]) / SHARE_STEPS, report.search.subsets.nh[order], atol=1e-5
    )


def test_chunks_hold_no_times(report, content):
    slower = replace(
        report.search,
        subsets=replace(report.search.subsets, cpu_seconds=report.search.subsets.cpu_seconds + 7),
        greedy=tuple(replace(run, cpu_seconds=run.cpu_seconds + 7) for run in report.search.greedy),
        table=tuple(replace(row, cpu_seconds=row.cpu_seconds + 7) for row in report.search.table),
    )
    assert packed(FeaturesPage().content(replace(report, search=slower)).chunks) == packed(content.chunks)


def test_greedy_paths_rise(content):
    scores = content.chunks["search"]
    for greedy in scores["greedy"]:
        hits = [scores["hit"][place] for place in greedy["path"]]
        assert hits == sorted(hits)
        assert greedy["runs"] <= 15


def test_words_follow_the_numbers(content):
    effects = content.context["search"]["effects"]
    assert [row["added"] for row in effects] == sorted((row["added"] for row in effects), reverse=True)
    for row in effects:
        expected = (
            "helps" if row["added"] >= 0.005 else "spoils" if row["added"] <= -0.005 else "hardly matters"
        )
        assert row["verdict"] == expected
    spread = content.context["search"]["spread"]
    assert spread["similar"] == sum(not row.told_apart for row in spread["rows"])
    assert not spread["smallest"].told_apart
    assert spread["everything"].features == FEATURES


def test_boxes_are_the_quartiles_of_all_subsets(report, content):
    for column, box in enumerate(content.chunks["search"]["boxes"]):
        values = report.search.subsets.nh_c[:, column]
        assert box["median"] == pytest.approx(np.median(values), abs=1e-6)
        assert box["least"] == pytest.approx(values.min(), abs=1e-6)
        assert box["upper"] == pytest.approx(np.quantile(values, 0.75), abs=1e-6)


@pytest.mark.slow
def test_chance_is_that_of_the_overview(report, content):
    # Labels dealt at random reach the same on every map on average.
    report = with_search(make_report(["a", "b"], 20, features=FEATURES[:2]))
    chance = FeaturesPage().content(report).chunks["search"]["chance"]
    assert chance == pytest.approx(19 / 39, abs=0.01)


def test_without_a_search_there_is_nothing_to_load():
    content = FeaturesPage().content(make_report())
    assert content.context["search"] is content.context["retrieval"] is None
    assert content.chunks == {}


def test_without_labels_there_are_maps_only():
    report = with_search(make_report([None], 12, features=FEATURES[:2]))
    content = FeaturesPage().content(report)
    packed(content.chunks)
    assert content.chunks["search"]["hit"] == [None] * 3
    assert content.chunks["search"]["boxes"] == []
    assert not content.context["search"]["labelled"]
    assert len(content.chunks["subsets"]["x"]) == 3


@pytest.mark.slow
def test_a_sample_says_which_shapes_it_took():
    report = with_search(make_report(["a", "b"], 20, features=FEATURES[:2]), limit=12)
    content = FeaturesPage().content(report)
    rows = content.chunks["search"]["rows"]
    assert len(rows) == len(content.chunks["subsets"]["x"][0]) == 12
    assert [report.labels[row] for row in rows] == ["a"] * 6 + ["b"] * 6
    assert (content.context["search"]["shapes"], content.context["search"]["shape_count"]) == (12, 40)


@pytest.mark.slow
@pytest.mark.parametrize(("classes", "per_class"), [(["ant"], 1), (["ant"], 5), (["ant", "bird"], 1)])
def test_the_smallest_databases_have_a_page(classes, per_class, tmp_path):
    report = with_search(make_report(classes, per_class, features=FEATURES[:1]))
    write_site(report, tmp_path)
    assert packed(FeaturesPage().content(report).chunks).keys() >= {"search"}


@pytest.mark.slow
def test_strange_labels_are_numbered_as_on_the_overview():
    report = with_search(make_report([*NASTY_LABELS, None], 3, features=FEATURES[:2]))
    classes = OverviewPage().content(report).chunks["overview"]["classes"]
    numbers = FeaturesPage().content(report).chunks["search"]["classes"]
    assert [classes[number] for number in numbers] == list(report.search.classes)


class TestOffersOfTheOverview:
    def test_it_offers_the_best_subset(self, report):
        offer = OverviewPage().content(report).chunks["overview"]["subsets"]
        best = report.search.subsets.members[int(report.search.subsets.nh_s.argmax())]
        assert offer["best"] == [name for name, has in zip(FEATURES, best) if has]
        assert offer["method"] == "tsne"

    @pytest.mark.parametrize(
        "report",
        [
            make_report(),
            with_search(make_report(["a", "b"], 5, methods=("pca",))),
        ],
        ids=["no search", "another method"],
    )
    def test_it_offers_none_that_it_could_not_show(self, report):
        assert OverviewPage().content(report).chunks["overview"]["subsets"] is None

    def test_of_a_sample_it_has_what_the_others_are_placed_by(self, report):
        assert "components" not in OverviewPage().content(report).parts
        sampled = with_search(make_report(["a", "b"], 10), limit=8)
        content = OverviewPage().content(sampled)
        offer = content.chunks["overview"]["subsets"]
        assert (offer["sample"], offer["laidOut"]) == (8, False)
        parts = list(content.parts["components"])
        assert len(parts) == len(sampled.features.blocks)
        assert all(len(part["values"]) % 20 == 0 for part in parts)
        laid_out = OverviewPage().content(with_best(sampled)).chunks["overview"]["subsets"]
        assert laid_out["laidOut"]


def test_the_papers_features_among_others_have_their_own_spread_and_alone_or_incomplete_none(report):
    assert FeaturesPage().content(report).chunks["search"]["paper"] is None
    mixed = with_search(make_report(["a", "b", "c"], 8, features=("Gc", "own", "Sc")))
    content = FeaturesPage().content(mixed)
    assert content.chunks["search"]["paper"] == [0, 2]
    assert content.context["search"]["paper"] == {"features": 2, "subsets": 3}
    own = ~mixed.search.subsets.members[:, 1]
    for column, box in enumerate(content.chunks["search"]["boxesOfPaper"]):
        values = mixed.search.subsets.nh_c[own, column]
        assert [box["least"], box["median"], box["most"]] == pytest.approx(
            [values.min(), np.median(values), values.max()], abs=1e-6
        )
    fewer = np.flatnonzero(mixed.search.subsets.members.sum(axis=1) != 2)
    members, scores, by_class = (
        getattr(mixed.search.subsets, name)[fewer] for name in ("members", "nh_s", "nh_c")
    )
    cut = replace(
        mixed.search, subsets=replace(mixed.search.subsets, members=members, nh_s=scores, nh_c=by_class)
    )
    assert _of_paper(cut) is None


def test_differences_are_those_of_the_figures_as_they_are_shown(content):
    # 0.9385 and 0.9436 differ by 0.0051, and show as 0.939 and 0.944; the next pair by 0.0059.
    assert change(0.93851, 0.9436) == 0.005
    assert change(0.9444, 0.93851) == -0.005
    for row in content.context["search"]["effects"]:
        assert round(float(f"{row['with']:.3f}") - float(f"{row['without']:.3f}"), 3) == row["added"]
