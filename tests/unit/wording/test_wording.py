"""What is said of the values of features: plain words that a stranger can picture, and exact ones."""

from __future__ import annotations

import re

import numpy as np
import pytest

from shapeviz_report.descriptors import DESCRIPTORS
from shapeviz_report.features import BLOCKS, fixed_edges
from shapeviz_report.global_descriptors import GLOBAL_DESCRIPTORS
from shapeviz_report.presets import PRESETS
from shapeviz_report.types import FeatureBlock, FeatureTable
from shapeviz_report.wording import (
    GLOBAL_WORDINGS,
    WORDINGS,
    call_bins,
    dimensions_of,
    explain_bins,
    say_bins,
)
from shapeviz_report.wording.base import percent, percents

#: A table of all our features, and of one that was brought along.
HISTOGRAMS = sum(block.width for block in BLOCKS)
TABLE = FeatureTable(("a",), (*BLOCKS, FeatureBlock("deep one", 3, 1)), np.zeros((1, HISTOGRAMS + 3)))
COLUMNS = TABLE.columns
EXACT = dict(zip(COLUMNS, explain_bins(TABLE, fixed_edges(), by_area=True), strict=True))
SAID = dict(zip(COLUMNS, say_bins(TABLE, fixed_edges(), by_area=True), strict=True))
PLAIN = {name: said for name, said in SAID.items() if said is not None}

#: Words of those who compute, which no sentence leads with.
FORMULAS = re.compile(
    r"cosine|sine|normal|tangent|eigen|radian|geodesic|histogram|descriptor|vector", re.IGNORECASE
)


@pytest.mark.parametrize("descriptor", DESCRIPTORS, ids=lambda d: d.name)
def test_every_descriptor_has_its_words(descriptor) -> None:
    assert descriptor.name in WORDINGS, (
        f"name {descriptor.name} in WORDINGS of shapeviz_report/wording/__init__.py"
    )
    wording = WORDINGS[descriptor.name]
    for texts in (wording.topics, wording.quantities):
        assert len(texts) == len(set(texts)) == descriptor.dimensions, "different words, one a dimension"
    assert " and " not in wording.aspect, "two aspects are joined by an and"
    assert len(wording.sought) == descriptor.dimensions
    for words in (wording.aspect, *wording.topics, *wording.quantities, wording.low, wording.high):
        assert words
        assert not words.endswith("."), f"{words!r} stands within a sentence"
    assert not FORMULAS.search(" ".join((wording.aspect, *wording.topics, wording.low, wording.high)))
    shown = wording.shown(np.array(descriptor.edges))
    assert (np.diff(shown) > 0).all(), "values as they are shown rise as they do"


def test_shares_read_as_in_the_scripts_of_the_site() -> None:
    told = [percent(share).replace("\u00a0", " ") for share in (0, 0.0004, 0.0005, 0.019, 0.0994, 0.0995, 1)]
    # What sums of floats miss.
    assert [percent(share) for share in (-1e-9, 1e-12, -0.0)] == ["0\u00a0%"] * 3
    assert told == ["0 %", "<0.1 %", "0.1 %", "1.9 %", "9.9 %", "10 %", "100 %"]
    assert [share.replace("\u00a0", " ") for share in percents(0.0001, 0.0003)] == ["0.01 %", "0.03 %"]


class TestPlain:
    def test_every_bin_has_a_short_name_and_a_clause_of_its_own(self) -> None:
        assert len(PLAIN) == HISTOGRAMS
        for texts in ([said.name for said in PLAIN.values()], [said.clause for said in PLAIN.values()]):
            assert len(set(texts)) == HISTOGRAMS
        assert max(len(said.name) for said in PLAIN.values()) <= 74

    def test_no_word_of_a_formula(self) -> None:
        for said in PLAIN.values():
            assert not FORMULAS.search(f"{said.name} {said.clause}"), said

    def test_sides_of_edges_say_what_one_sees(self) -> None:
        for dimension in dimensions_of(TABLE, fixed_edges()):
            for edge in dimension.edges[1:-1]:
                sides = dimension.say(None, float(edge)), dimension.say(float(edge), None)
                assert sides[0].clause != sides[1].clause
                # Of one side at least there is more.
                assert not all(side.fewer for side in sides)
                for side in sides:
                    assert not FORMULAS.search(" ".join((side.name, side.clause, side.trend))), side
                    assert side.fewer == side.trend.startswith(("less ", "there are fewer "))
                    # What one value a point describes leads with what a stranger sees.
                    assert bool(side.trend) == (dimension.block.dimensions == 1)

    def test_words_are_as_people_say_them(self) -> None:
        assert PLAIN["Nd:1"].clause == "is thinner than 0.1 radii"
        assert PLAIN["Nd:10"][:3] == ("thickness over 0.9", "is thicker than 0.9 radii", "bodies are thicker")
        assert PLAIN["Nd:3"].name == "thickness 0.2 to 0.3"
        assert PLAIN["Na:1"].clause == "keeps within 5.7° of the longest direction"
        assert PLAIN["Gc:5"].name == "flat, −0.57 to 0.57°"
        assert PLAIN["Gc:1"].name == "saddle over 4°"
        assert PLAIN["Sc[12]:4"].clause == (
            "has 5.8 to 10\u00a0% of the shape some way in front of it, away from the middle"
        )
        assert PLAIN["FPFH[14]:3"].name == "surroundings dropping by 16 to 27°: 4 to 9\u00a0%"
        assert PLAIN["PFH[62]:10"].name == "patch flat: over 52\u00a0%"
        assert PLAIN["PFH[48]:4"].clause == (
            "has 5.8 to 10\u00a0% of the patch around it rounded, rising steeply and twisted left"
        )

    def test_no_trend_says_more_than_its_range(self) -> None:
        by_name = {dimension.block.name: dimension for dimension in dimensions_of(TABLE, fixed_edges())}
        assert by_name["Na"].say(53.0, None).trend == "more surface faces the two ends"
        # What turns by a few degrees faces no end.
        assert by_name["Na"].say(12.0, None).trend == "less surface runs lengthways"
        assert by_name["Pa"].say(None, 53.0).trend == "less surface lies towards the two ends"
        assert by_name["Agd"].say(None, 0.8).trend == "more surface lies near the middle"

    def test_vertices_are_many_and_their_verbs_are_too(self) -> None:
        said = say_bins(TABLE, fixed_edges(), by_area=False)
        clauses = {name: words.clause for name, words in zip(COLUMNS, said, strict=True) if words is not None}
        assert clauses["Nd:1"] == "are thinner than 0.1 radii"
        assert clauses["Pa:1"].startswith("lie within ")
        assert clauses["Sc[0]:1"].startswith("have hardly any ")

    def test_narrow_bins_are_told_apart(self) -> None:
        edges = fixed_edges()
        edges[2] = np.linspace(0.1, 0.101, 11)
        names = {said.name for said in say_bins(TABLE, edges, by_area=True)[20:30] if said is not None}
        assert len(names) == 10

    def test_a_feature_that_was_brought_along_has_no_words_of_ours(self) -> None:
        assert SAID["deep one[2]"] is None
        own = FeatureTable(("a",), (FeatureBlock("<b>own</b>", 1, 10),), np.zeros((1, 10)))
        said = say_bins(own, np.linspace(0, 1, 11)[None], by_area=True)
        assert [words.name for words in said if words][2] == "<b>own</b> 0.2 to 0.3"


class TestExact:
    def test_a_bin_in_the_middle(self) -> None:
        assert EXACT["Agd:6"] == (
            "What share of the surface lies where the mean distance to all other points, walking on the surface, is "
            "from 1.4 to 1.6\u00a0times the shape's radius."
        )

    def test_the_outer_bins_take_what_lies_beyond(self) -> None:
        assert EXACT["Gc:1"].endswith(" is below −4.01°.")
        assert EXACT["Gc:10"].endswith(" is 5.16° or more.")
        assert EXACT["Na:10"].endswith(" is 64.2° or more.")

    def test_fractions_are_told_in_per_cent(self) -> None:
        assert EXACT["PFH[0]:2"].endswith(" is from 0.64 to 2.56\u00a0%.")

    def test_every_bin_of_a_histogram_has_a_sentence_of_its_own(self) -> None:
        histograms = [text for name, text in EXACT.items() if not name.startswith("deep")]
        assert len(set(histograms)) == HISTOGRAMS
        assert max(map(len, histograms)) < 260

    def test_a_feature_that_was_brought_along(self) -> None:
        assert EXACT["deep one[2]"] == "The value of deep one[2], a feature that was brought along."

    def test_vertices_are_called_so_where_they_are_counted(self) -> None:
        assert explain_bins(TABLE, fixed_edges(), by_area=False)[0].startswith(
            "What share of the vertices lies"
        )


@pytest.mark.parametrize("descriptor", GLOBAL_DESCRIPTORS, ids=lambda d: d.name)
def test_every_global_descriptor_has_its_words(descriptor) -> None:
    wording = GLOBAL_WORDINGS[descriptor.name]
    for texts in (wording.names, wording.quantities):
        assert len(texts) == len(set(texts)) == descriptor.width, "different words, one a value"
    assert max(len(name) for name in wording.names) <= 74
    assert not any(text.endswith(".") for text in (wording.aspect, *wording.names, *wording.quantities))
    assert not FORMULAS.search(" ".join((wording.aspect, *wording.names, *wording.quantities)))
    assert len(wording.sought) == descriptor.width
    assert wording.sought[0][0]


def test_columns_are_called_and_explained_in_their_order() -> None:
    blocks = (*PRESETS["default"].blocks, FeatureBlock("deep one", 3, 1))
    table = FeatureTable(("a",), blocks, np.zeros((1, sum(block.width for block in blocks))))
    called = dict(zip(table.columns, call_bins(table, fixed_edges()), strict=True))
    exact = dict(zip(table.columns, explain_bins(table, fixed_edges(), by_area=True), strict=True))
    assert called["Pan[0]"] == "reach around the longest axis on average"
    assert called["Pan[7]"] == "reach at one place along the longest axis"
    assert called["Pan[9]"] == "reach on 2 sides of the longest axis, at one place along it"
    assert called["PanS[37]"] == "steepness on 2 sides of the middle axis"
    assert called["Dep[26]"] == "difference of the two ends (1 part across)"
    assert called["Sil[55]"] == "shadow of the broad side (1 part up)"
    assert called["Sfl[0]"] == "share of pairs 0 to 0.4 apart (square, both edge-on)"
    assert called["deep one[2]"] == ""
    assert exact["Dep[26]"].startswith(
        "The value is the root of the strength of 1 wave along the middle axis and 0 along the shortest"
    )
    assert exact["deep one[2]"] == "The value of deep one[2], a feature that was brought along."
    assert called["Agd:6"] == SAID["Agd:6"].name
