"""The Workbench's data: what it holds is what the report holds, in a form that a page loads quickly."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reports import NASTY_LABELS, make_report, with_bin_search, with_bins, with_scores, with_search

from shapeviz_report import quality
from shapeviz_report.pages.workbench import WorkbenchPage
from shapeviz_report.presets import PRESETS, compared_values
from shapeviz_report.scorers import SCORERS
from shapeviz_report.types import FeatureBlock, FeatureTable, Projection
from shapeviz_report.wording import explain_bins
from shapeviz_report.writing import write_site
from shapeviz_report.writing.data import json_text

FEATURES = ("Gc", "Sc", "own one")


def chunks(report):
    return WorkbenchPage().content(report).chunks


def with_external(report):
    """The report with a further feature of two values that may be negative, one of them always the same."""
    values = np.column_stack(
        [np.random.default_rng(1).normal(0, 50, len(report.shapes)), np.full(len(report.shapes), -3)]
    )
    table = report.features
    features = FeatureTable(
        table.shape_ids, (*table.blocks, FeatureBlock("deep", 2, 1)), np.column_stack([table.values, values])
    )
    return replace(report, features=features)


def test_the_bins_that_a_search_found_are_offered() -> None:
    report = with_bin_search(make_report(["ant", "bird", "cup"], 8))
    found = chunks(report)["workbench"]["found"]
    names = [report.features.columns[column] for column in found["bins"]]
    assert names == list(report.bins.automatic.bins)
    assert found["nh"] == pytest.approx(report.bins.automatic.nh_s, abs=1e-6)
    assert 0 <= found["heldOut"] <= 1
    assert chunks(make_report())["workbench"]["found"] is None


class TestBins:
    @pytest.mark.parametrize("preset", ["default", "paper"])
    def test_values_read_back_to_half_a_step(self, preset) -> None:
        report = with_external(make_report(features=FEATURES))
        report = replace(report, parameters={"preset": preset})
        content = WorkbenchPage().content(report)
        made, held = content.chunks, b"".join(content.parts["bins"])
        compared = compared_values(report.features, PRESETS[preset])
        assert len(held) == made["workbench"]["bytesOfBins"]
        steps = np.frombuffer(held, dtype="<u2").reshape(len(report.features.columns), len(report.shapes))
        assert made["workbench"]["scaling"] == {"default": "balanced", "paper": "plain"}[preset]
        for feature in made["workbench"]["features"]:
            columns = slice(feature["start"], feature["start"] + feature["dimensions"] * feature["bins"])
            width = feature["high"] - feature["low"]
            np.testing.assert_allclose(
                feature["low"] + width * steps[columns].T / 65535,
                compared[:, columns],
                rtol=0,
                atol=width / 65535 / 1.99,
            )

    def test_columns_are_those_of_the_table(self) -> None:
        report = with_external(make_report(features=FEATURES))
        features = chunks(report)["workbench"]["features"]
        assert [feature["name"] for feature in features] == [*FEATURES, "deep"]
        for feature, block in zip(features, report.features.blocks):
            columns = report.features.slice_of(block.name)
            assert (feature["start"], feature["dimensions"] * feature["bins"]) == (columns.start, block.width)

    def test_every_column_has_its_sentence(self) -> None:
        report = with_external(make_report(features=FEATURES))
        expected = explain_bins(report.features, report.edges, by_area=True)
        assert chunks(report)["workbench"]["sentences"] == list(expected)
        called = chunks(report)["workbench"]["called"]
        assert [name == "" for name in called] == [
            name.startswith("deep") for name in report.features.columns
        ]


class TestScores:
    def test_they_are_numbered_by_method_class_and_column(self) -> None:
        report = with_scores(make_report(["b", "a", None], 6))
        made = chunks(report)
        shape = (len(SCORERS), 2, len(report.features.columns))
        steps = np.frombuffer(made["scores"], dtype="<u2").reshape(shape)
        np.testing.assert_allclose(steps / 65535, report.scores.values, atol=1e-5)
        assert [scorer["key"] for scorer in made["workbench"]["scorers"]] == list(report.scores.methods)
        assert report.scores.classes == ("a", "b")
        assert made["workbench"]["scored"]

    @pytest.mark.slow
    def test_without_them_there_is_a_page_all_the_same(self, tmp_path) -> None:
        report = make_report()
        assert not chunks(report)["workbench"]["scored"]
        assert "scores" not in chunks(report)
        write_site(report, tmp_path)
        assert (tmp_path / "workbench.html").is_file()


class TestExample:
    def test_the_two_classes_that_mix_most_and_how_much(self) -> None:
        report = make_report(["ant", "bird", "cup", "dog", None], 8)
        random = np.random.default_rng(0)
        # Bird and dog share a place, cup and the shapes without a label another one, ant is alone.
        centres = np.array([[-1, 0], [1, 0], [0, 1], [1, 0.1], [0, 1]])
        xy = np.repeat(centres, 8, axis=0) + random.normal(0, 0.05, (40, 2))
        hits = quality.score(xy, report.labels, k=6)
        report = replace(report, projections={"tsne": (Projection("tsne", FEATURES, 0, xy), hits)})
        example = chunks(report)["workbench"]["example"]
        assert example["classes"] == (1, 3)
        distances = np.linalg.norm(xy[:, None] - xy, axis=2)
        np.fill_diagonal(distances, np.inf)
        labels = np.array([label or "" for label in report.labels])
        nearest = labels[np.argsort(distances, axis=1)[:, :6]]
        shares = [
            (nearest[labels == one] == other).mean() for one, other in (("bird", "dog"), ("dog", "bird"))
        ]
        assert example["mixed"] == pytest.approx(np.mean(shares), abs=1e-6)

    @pytest.mark.parametrize("classes", [["ant"], [None], ["ant", None]])
    def test_without_two_classes_there_is_none(self, classes) -> None:
        assert chunks(make_report(classes, 6))["workbench"]["example"] is None

    def test_classes_that_do_not_touch_are_no_example(self) -> None:
        report = make_report(["ant", "bird"], 6)
        xy = np.repeat([[-1.0, 0], [1, 0]], 6, axis=0) + np.random.default_rng(0).normal(0, 0.05, (12, 2))
        hits = quality.score(xy, report.labels, k=4)
        report = replace(report, projections={"tsne": (Projection("tsne", FEATURES, 0, xy), hits)})
        assert chunks(report)["workbench"]["example"] is None


class TestChosenBins:
    def test_the_page_learns_which_bins_the_maps_are_of(self) -> None:
        report = make_report(features=FEATURES)
        assert chunks(report)["workbench"]["bins"] is None
        assert chunks(with_bins(report, ("Gc:3", "Sc[1]:10")))["workbench"]["bins"] == [2, 29]

    def test_the_example_is_of_the_map_of_all_features(self) -> None:
        report = with_search(make_report(["a", "b", "c"], 6, features=FEATURES))
        search = report.search
        xy = search.subsets.xy[search.subsets.members.all(axis=1)][0].astype(float)
        whole = replace(
            report,
            projections={"tsne": (Projection("tsne", FEATURES, 0, xy), quality.score(xy, report.labels))},
        )
        expected = chunks(whole)["workbench"]["example"]
        assert expected is not None
        chosen = with_bins(report, ("Gc:3",))
        assert chunks(chosen)["workbench"]["example"] == expected
        assert chunks(replace(chosen, search=None))["workbench"]["example"] is None


@pytest.mark.slow
@pytest.mark.parametrize(
    ("classes", "per_class"), [([None], 1), (["ant"], 1), (["ant"], 5), (["ant", "bird"], 1)]
)
def test_the_smallest_databases_have_a_page(classes, per_class, tmp_path) -> None:
    report = make_report(classes, per_class)
    if len(classes) > 1:
        report = with_scores(report)
    write_site(report, tmp_path)
    json_text(chunks(report)["workbench"])


def test_strange_labels_stand_in_the_scores_as_on_the_overview() -> None:
    report = with_scores(make_report([*NASTY_LABELS, None], 3))
    assert report.scores.classes == tuple(sorted(NASTY_LABELS))
