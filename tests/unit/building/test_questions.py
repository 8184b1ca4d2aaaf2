"""What is asked of a whole database, where it is large."""

from __future__ import annotations

from collections import Counter

from shapeviz_report.building.questions import contestants
from shapeviz_report.scorers import MOST_SCORED


def test_all_shapes_take_part_where_they_are_few() -> None:
    labels = ["ant", None, "cup", "ant", "bird"] * 50
    members, others = contestants(labels, "ant", 0)
    assert members == [row for row, label in enumerate(labels) if label == "ant"]
    assert others == [row for row, label in enumerate(labels) if label in ("cup", "bird")]


def test_of_many_shapes_a_share_of_every_class_takes_part() -> None:
    labels = ["ant"] * 4000 + ["bird"] * 8000 + ["cup"] * 2000 + [None] * 100 + ["rare"] * 3
    for name, own in (("ant", 500), ("bird", 500), ("rare", 3)):
        members, others = contestants(labels, name, 0)
        assert {labels[row] for row in members} == {name}
        assert len(members) == own
        assert len({*members, *others}) == MOST_SCORED
        counts = Counter(labels[row] for row in others)
        assert name not in counts
        assert None not in counts
    assert 3.5 < counts["bird"] / counts["cup"] < 4.5
    assert contestants(labels, "ant", 1) != contestants(labels, "ant", 0)


def test_a_class_that_is_nearly_all_is_not_cut_short() -> None:
    members, others = contestants(["ant"] * 9000 + ["bird"] * 10, "ant", 0)
    assert (len(members), len(others)) == (MOST_SCORED - 10, 10)
