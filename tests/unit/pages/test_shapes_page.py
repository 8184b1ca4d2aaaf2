"""What the gallery can group, filter and sort by, and the trees of a database."""

from __future__ import annotations

from dataclasses import replace
from datetime import date, timedelta
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import reports
from hypothesis import given, settings
from hypothesis import strategies as st
from reports import NASTY_LABELS, with_columns, with_parents

from shapeviz_report.order import natural
from shapeviz_report.pages.fields import MOST_INTERVALS, describe_fields
from shapeviz_report.pages.hierarchy import describe_hierarchy
from shapeviz_report.pages.shapes import ShapesPage
from shapeviz_report.types import Cluster, Clusters


@cache
def made(classes, per_class):
    return reports.make_report(classes, per_class, methods=("pca",))


def make_report(classes, per_class):
    """A report without the maps that these tests do not look at."""
    return made(tuple(classes), per_class)


def with_ids(report, ids):
    shapes = tuple(replace(shape, id=identifier) for shape, identifier in zip(report.shapes, ids))
    features = replace(report.features, shape_ids=tuple(ids))
    database = replace(report.database, shapes=shapes)
    return replace(report, shapes=shapes, features=features, database=database)


def with_labeling(report, name, labels):
    """The report with a further labeling."""
    shapes = tuple(
        replace(shape, labels={**shape.labels, name: label}) for shape, label in zip(report.shapes, labels)
    )
    database = replace(report.database, shapes=shapes, labelings=(*report.database.labelings, name))
    return replace(report, shapes=shapes, database=database)


def field(report, key):
    found = [field for field in describe_fields(report) if field["key"] == key]
    return found[0] if found else None


def trees(report):
    return {tree["key"]: tree for tree in describe_hierarchy(report, describe_fields(report))["trees"]}


def ways(tree):
    """The node of every shape by the names that lead to it."""
    found = []
    for node in tree["nodes"]:
        found.append((*(found[node["parent"]] if node["parent"] >= 0 else ()), node["name"]))
    return [None if node < 0 else found[node] for node in tree["of"]]


class TestNaturalOrder:
    def test_numbers_stand_by_their_size(self) -> None:
        names = ["cup 10", "Cup 2", "cup 1", "ant", "cup", "12", "cup 02"]
        assert sorted(names, key=natural) == ["12", "ant", "cup", "cup 1", "Cup 2", "cup 02", "cup 10"]

    def test_decimals_go_by_value_and_parts_of_names_by_part(self) -> None:
        assert sorted(["1.10", "10", "0.5", "1.9", "0.25", "2"], key=natural) == [
            "0.25",
            "0.5",
            "1.10",
            "1.9",
            "2",
            "10",
        ]
        assert sorted(["v1.10", "v1.9", "m 0.5", "m 0.25"], key=natural) == [
            "m 0.5",
            "m 0.25",
            "v1.9",
            "v1.10",
        ]

    @given(st.lists(st.text(), max_size=6))
    def test_any_texts_can_be_sorted_and_only_equal_ones_are_equal(self, names) -> None:
        ordered = sorted(names, key=natural)
        assert sorted(reversed(names), key=natural) == ordered

    def test_a_number_of_any_length_is_one(self) -> None:
        assert natural("9" * 10000) < natural("1" + "0" * 10000)


class TestFields:
    def test_the_classes_come_first(self) -> None:
        first = describe_fields(make_report(["b", "a", None], 3))[0]
        assert (first["active"], first["title"], first["names"]) == (True, "Class", ["a", "b"])
        assert first["of"].tolist() == [1, 1, 1, 0, 0, 0, -1, -1, -1]

    def test_a_column_of_few_values_makes_groups(self) -> None:
        report = with_columns(make_report(["a"], 4), {"place": ["Delft", "Kyoto", "", "Delft"]})
        found = field(report, "column:place")
        assert (found["names"], found["numbers"]) == (["Delft", "Kyoto"], None)
        assert found["of"].tolist() == [0, 1, -1, 0]

    def test_a_column_that_names_every_shape_does_not(self) -> None:
        report = with_columns(make_report(["a"], 6), {"inventory": [f"K-{row}" for row in range(6)]})
        assert field(report, "column:inventory") is None

    def test_nor_does_a_column_that_says_the_same_of_all(self) -> None:
        report = with_columns(make_report(["a"], 4), {"licence": ["CC0"] * 4})
        assert field(report, "column:licence") is None

    def test_a_column_that_only_some_shapes_have_tells_them_apart(self) -> None:
        report = with_columns(make_report(["a"], 4), {"restored": ["yes", "", "", "yes"]})
        assert field(report, "column:restored")["of"].tolist() == [0, -1, -1, 0]

    def test_a_column_of_numbers_is_a_range(self) -> None:
        years = [str(1500 + 7 * row) for row in range(12)]
        found = field(with_columns(make_report(["a"], 12), {"year": [*years[:-1], ""]}), "column:year")
        np.testing.assert_array_equal(found["numbers"], [*(float(year) for year in years[:-1]), np.nan])
        assert found["names"] is None
        assert found["edges"][0] <= 1500
        assert found["edges"][-1] >= 1570

    def test_a_column_of_few_numbers_is_ticked_in_their_order(self) -> None:
        found = field(with_columns(make_report(["a"], 6), {"floor": ["10", "2", "-1"] * 2}), "column:floor")
        assert (found["names"], found["edges"]) == (["-1", "2", "10"], None)

    @pytest.mark.parametrize("value", ["1e999", "nan", "inf", "1_000", "12 cm", "٣"])
    def test_what_is_no_plain_number_makes_a_column_of_text(self, value) -> None:
        found = field(with_columns(make_report(["a"], 4), {"size": ["1", "1", value, value]}), "column:size")
        assert found["numbers"] is None
        assert value in found["names"]

    def test_a_column_of_dates_is_a_range_of_days(self) -> None:
        dates = ["1969-12-31", "1970-01", "", *(f"{1900 + row}-03-01T12:00" for row in range(9))]
        found = field(with_columns(make_report(["a"], 12), {"found": dates}), "column:found")
        assert found["date"]
        np.testing.assert_array_equal(found["numbers"][:3], [-1, 0, np.nan])
        first_days = {date(1970, 1, 1) + timedelta(days=edge) for edge in found["edges"]}
        assert {(day.month, day.day) for day in first_days} == {(1, 1)}
        assert len(first_days) <= MOST_INTERVALS + 1
        assert found["edges"][0] <= min(found["numbers"][3:])
        assert found["edges"][-1] > 0

    @pytest.mark.parametrize("value", ["1970-13-01", "1970-02-30", "1970-1-1", "0000-01-01", "today"])
    def test_what_is_no_date_makes_a_column_of_text(self, value) -> None:
        column = {"found": ["1970-01-01", "1970-01-01", value, value]}
        found = field(with_columns(make_report(["a"], 4), column), "column:found")
        assert (found["numbers"], found["date"]) == (None, False)

    def test_a_labeling_that_repeats_a_column_stands_once(self) -> None:
        places = ["x", "y", "x", "y"]
        report = with_labeling(with_columns(make_report(["a"], 4), {"place": places}), "place", places)
        assert [found["key"] for found in describe_fields(report) if found["title"] == "place"] == [
            "label:place"
        ]

    def test_facts_are_those_of_the_meshes(self) -> None:
        report = make_report(["a", "b"], 8)
        assert field(report, "fact:faces")["numbers"].tolist() == [
            float(facts.faces_read) for facts in report.facts
        ]
        volumes = field(report, "fact:volume")["numbers"]
        assert np.isnan(volumes).tolist() == [facts.volume is None for facts in report.facts]
        assert volumes[1] == pytest.approx(report.facts[1].volume, rel=1e-5)
        assert field(report, "fact:watertight")["names"] == ["open", "watertight"]

    def test_names_of_any_kind_are_values(self) -> None:
        report = make_report([*NASTY_LABELS, None], 2)
        found = describe_fields(report)[0]
        assert set(found["names"]) == set(NASTY_LABELS)
        assert [None if of < 0 else found["names"][of] for of in found["of"]] == list(report.labels)

    def test_clusters_stand_by_their_size_with_what_is_typical(self) -> None:
        clusters = Clusters(
            clusters=(
                Cluster("like b 1", central=4, size=4, typical=("round", "thin")),
                Cluster("like a 0", central=0, size=2, typical=()),
            ),
            of=np.array([1, 1, 0, 0, 0, 0]),
            silhouette=0.5,
            steadiness=0.9,
            stand_in=False,
        )
        found = field(replace(make_report(["a", "b"], 3), clusters=clusters), "cluster")
        assert (found["names"], found["notes"]) == (["like b 1", "like a 0"], ["round", ""])
        assert found["of"].tolist() == [1, 1, 0, 0, 0, 0]


class TestEdges:
    @settings(deadline=None)
    @given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=9, max_size=20, unique=True))
    def test_they_rise_are_few_and_hold_every_number(self, values) -> None:
        texts = [repr(value) for value in values]
        report = with_columns(make_report(["a"], 20), {"size": texts + [""] * (20 - len(texts))})
        found = field(report, "column:size")
        numbers = found["numbers"][~np.isnan(found["numbers"])]
        if found["edges"] is None:
            return
        edges = found["edges"]
        assert edges == sorted(set(edges))
        assert 2 <= len(edges) - 1 <= MOST_INTERVALS
        assert edges[0] <= min(numbers)
        assert max(numbers) <= edges[-1]

    def test_a_wide_range_is_cut_by_factors(self) -> None:
        report = with_columns(make_report(["a"], 10), {"size": [str(10.0**power) for power in range(-3, 7)]})
        edges = field(report, "column:size")["edges"]
        assert (edges[0], edges[-1]) == (0.001, 1e6)
        assert max(right / left for left, right in pairwise(edges)) < 10

    def test_years_are_cut_at_round_years(self) -> None:
        report = with_columns(make_report(["a"], 40), {"year": [str(1501 + 11 * row) for row in range(40)]})
        assert field(report, "column:year")["edges"] == [float(year) for year in range(1500, 1941, 20)]


class TestTrees:
    def test_classes_without_parents_are_a_tree_of_one_level(self) -> None:
        tree = trees(make_report(["b", "a", None], 2))["label:folder"]
        assert tree["nodes"] == [{"name": "a", "parent": -1}, {"name": "b", "parent": -1}]
        assert tree["of"].tolist() == [1, 1, 0, 0, -1, -1]

    def test_parents_of_a_classification_stand_above_its_classes(self) -> None:
        report = make_report(["dog", "eagle", "car"], 2)
        report = with_parents(report, {"dog": "animal", "eagle": "bird", "bird": "animal"})
        found = trees(report)
        assert ways(found["label:folder"])[::2] == [("animal", "dog"), ("animal", "bird", "eagle"), ("car",)]
        assert "folders" not in found

    def test_coarser_levels_of_a_classification_are_no_trees_of_their_own(self) -> None:
        report = make_report(["dog", "eagle", "car"], 2)
        report = with_labeling(report, "level 1", ["animal"] * 4 + ["car"] * 2)
        report = with_parents(report, {"dog": "animal", "eagle": "animal"})
        assert list(trees(report)) == ["label:folder"]

    def test_a_path_in_a_column_is_one(self) -> None:
        report = with_columns(make_report(["a"], 6), {"kind": ["animal > dog", "animal > bird", "car"] * 2})
        tree = trees(report)["column:kind"]
        assert ways(tree)[:3] == [("animal", "dog"), ("animal", "bird"), ("car",)]

    def test_a_stroke_in_a_name_makes_no_tree(self) -> None:
        report = with_columns(make_report(["a"], 4), {"pair": ["his/hers", "black/white"] * 2})
        assert "column:pair" not in trees(report)

    def test_folders_in_the_names_of_clusters_make_no_tree(self) -> None:
        # a shape that shares its file name with another is called after its folder as well, and a cluster after it
        clusters = Clusters(
            tuple(Cluster(f"like a/{name}", row, 2, ()) for row, name in ((0, "x"), (2, "y"))),
            np.array([0, 0, 1, 1]),
            0.5,
            0.9,
            stand_in=False,
        )
        report = replace(make_report(["a", "b"], 2), clusters=clusters)
        assert "cluster" not in trees(report)

    def test_folders_are_one_where_they_say_more_than_the_classes(self) -> None:
        report = make_report(["a", "b"], 4)
        deep = [f"all/{kind}/{part}/{row}" for kind in "xy" for part in "pq" for row in "12"]
        tree = trees(with_ids(report, deep))["folders"]
        assert ways(tree)[::2] == [("x", "p"), ("x", "q"), ("y", "p"), ("y", "q")]

    @pytest.mark.parametrize(
        "ids",
        [
            [f"class{kind}/{row}" for kind in "xy" for row in "1234"],
            [f"{row}" for row in range(8)],
            [f"meshes/{row}" for row in range(8)],
            [f"{row}/model" for row in range(8)],
        ],
        ids=["as the classes", "none", "one for all", "one for each"],
    )
    def test_folders_that_say_nothing_are_none(self, ids) -> None:
        assert "folders" not in trees(with_ids(make_report(["a", "b"], 4), ids))

    def test_parents_in_a_circle_end(self) -> None:
        report = make_report(["a", "b"], 2)
        report = with_parents(report, {"a": "b", "b": "a"})
        assert ways(trees(report)["label:folder"])[0][-1] == "a"


def test_rows_stand_in_the_order_of_their_names() -> None:
    report = make_report(["b", "a"], 12)
    names = [report.shapes[row].name for row in ShapesPage().content(report).chunks["fields"]["byName"]]
    assert names[:3] == ["a 0", "a 1", "a 2"]
    assert names[11:13] == ["a 11", "b 0"]
