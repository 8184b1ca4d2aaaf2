"""The Bins page's data: what it holds is what the search found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reports import make_report, with_bin_search, with_bins, with_models, with_paintings

from shapeviz_report.pages.about import AboutPage
from shapeviz_report.pages.bins import BinsPage, mean_over_folds
from shapeviz_report.pages.workbench import WorkbenchPage
from shapeviz_report.writing import write_site


@pytest.fixture(scope="module")
def report():
    return with_models(with_paintings(with_bin_search(make_report(["ant", "bird", "cup", None], 6))))


def selection(report) -> dict:
    return BinsPage().content(report).chunks["selection"]


@pytest.mark.slow
def test_the_fewest_bins_of_every_class(report) -> None:
    found = selection(report)["minimal"]
    assert [separated["group"] for separated in found] == [0, 1, 2]
    for shown, separated in zip(found, report.bins.minimal):
        assert shown["other"] != shown["group"]
        for chosen, expected in zip(shown["sets"], separated.sets, strict=True):
            assert tuple(report.features.columns[bin] for bin in chosen["bins"]) == expected.bins
            assert chosen["nh"] == pytest.approx(expected.nh_c, abs=1e-6)
            xy = np.column_stack([chosen["x"], chosen["y"]]) / selection(report)["coordinateSteps"]
            np.testing.assert_allclose(xy, expected.xy, atol=2e-5)


def test_every_step_of_the_path_is_the_one_before_with_what_joined_and_without_what_left(report) -> None:
    path = selection(report)["path"]
    assert len(path) == len(report.bins.automatic.path)
    before: set[int] = set()
    for step in path:
        assert set(step["bins"]) == (before | set(step["added"])) - set(step["removed"])
        assert len(step["x"]) == len(step["y"]) == len(report.shapes)
        before = set(step["bins"])
    assert tuple(report.features.columns[bin] for bin in path[-1]["bins"]) == report.bins.automatic.bins


def test_what_it_is_worth_stands_beside_the_headline(report) -> None:
    found, context = selection(report), BinsPage().content(report).context["selection"]
    assert context["nh_s"] == pytest.approx(found["path"][-1]["nh"], abs=1e-6)
    assert [fold["nh"] for fold in found["heldOut"]] == pytest.approx(
        [fold.nh_s for fold in report.bins.held_out], abs=1e-6
    )
    shapes = np.array([fold["shapes"] for fold in found["heldOut"]])
    hits = np.array([fold["nh"] for fold in found["heldOut"]])
    assert context["held_out"]["nh_s"] == pytest.approx((shapes * hits).sum() / shapes.sum(), abs=1e-6)
    assert found["chance"] == pytest.approx(5 / 23, abs=1e-6)
    assert found["allFeatures"] == pytest.approx(report.projections["tsne"][1].nh_s, abs=1e-6)


def test_all_features_are_judged_by_their_own_map_where_the_site_shows_another(report) -> None:
    chosen = selection(with_bins(report, ("Gc:3",)))["allFeatures"]
    assert chosen == pytest.approx(mean_over_folds(report.bins.held_out, "nh_s_all"), abs=1e-6)


def test_every_dimension_has_its_words_and_the_values_between_its_bins(report) -> None:
    dimensions = selection(report)["dimensions"]
    assert len(dimensions) == len(report.edges)
    assert dimensions[0]["unit"] == "°"
    np.testing.assert_allclose(dimensions[0]["edges"], np.degrees(report.edges[0]), rtol=1e-3)
    # Shares are told in percent.
    assert dimensions[1]["unit"] == "%"
    np.testing.assert_allclose(dimensions[1]["edges"], 100 * report.edges[1])
    assert len({dimension["quantity"] for dimension in dimensions}) == len(dimensions)


def test_paintings_and_models_are_named_by_what_they_hold(report, tmp_path) -> None:
    write_site(report, tmp_path)
    found = selection(report)
    columns = [report.features.columns[painting["column"]] for painting in found["paintings"]]
    assert columns == [painting.column for painting in report.paintings]
    for shown, painting in zip(found["paintings"], report.paintings):
        assert (tmp_path / shown["value"]).read_bytes() == painting.value
        assert (tmp_path / shown["inside"]).read_bytes() == painting.inside
        share = report.features.values[painting.shape, shown["column"]]
        assert shown["share"] == pytest.approx(share, abs=1e-6)
    assert len(found["models"]) == len(report.shapes)
    assert {path.stem for path in (tmp_path / "models").iterdir()} == set(found["models"])


def test_a_search_of_a_sample_names_its_shapes(report) -> None:
    rows = np.arange(0, 24, 2, dtype=np.int32)
    sample = replace(report.bins.automatic, rows=rows)
    assert selection(report)["rows"] is None
    of_class = tuple(replace(separated, rows=rows[::2]) for separated in report.bins.minimal)
    found = selection(replace(report, bins=replace(report.bins, automatic=sample, minimal=of_class)))
    assert found["rows"] == rows.tolist()
    assert found["rowsOfClasses"] == rows[::2].tolist()


@pytest.mark.parametrize(
    ("bins", "everything", "pays"),
    [((0.8, 0.7), (0.6, 0.5), True), ((0.6, 0.5), (0.6, 0.5), False), ((0.5, 0.5), (0.6, 0.8), False)],
)
def test_where_choosing_does_not_pay_the_page_says_so(report, bins, everything, pays) -> None:
    folds = tuple(
        replace(report.bins.held_out[0], nh_s=own, nh_s_all=whole, knn_accuracy=own, knn_accuracy_all=whole)
        for own, whole in zip(bins, everything)
    )
    changed = replace(report, bins=replace(report.bins, held_out=folds))
    assert BinsPage().content(changed).context["selection"]["pays"] is pays
    assert WorkbenchPage().content(changed).chunks["workbench"]["found"]["pays"] is pays
    offered = dict(AboutPage().content(changed).context["downloads"])["selected-bins.txt"]
    assert ("no better off" in offered) is not pays


@pytest.mark.slow
@pytest.mark.parametrize(("classes", "per_class"), [([None], 1), (["ant"], 5), (["ant", "bird"], 1)])
def test_without_a_search_there_is_a_page_all_the_same(classes, per_class, tmp_path) -> None:
    report = with_bin_search(make_report(classes, per_class))
    content = BinsPage().content(report)
    assert content.context["selection"] is None
    assert content.chunks["selection"]["path"] == content.chunks["selection"]["minimal"] == []
    assert content.chunks["selection"]["models"] is None
    assert len(content.chunks["selection"]["ramp"]) == 10
    write_site(report, tmp_path)
    assert not (tmp_path / "models").exists()


def test_times_are_not_in_the_page(report) -> None:
    slower = replace(
        report, bins=replace(report.bins, automatic=replace(report.bins.automatic, cpu_seconds=99.0))
    )
    assert BinsPage().content(slower) == BinsPage().content(report)
