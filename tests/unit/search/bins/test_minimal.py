"""The fewest bins that separate a class: one where one does, two where two must, none by the order of files."""

from __future__ import annotations

import numpy as np
import pytest
from planted_bins import CLASSES, PLANTED, make_table

from shapeviz_report.presets import PRESETS
from shapeviz_report.search.bins import find_minimal_bins, make_bin_space


def test_one_bin_where_one_is_planted(planted) -> None:
    for label, name in zip(CLASSES, PLANTED):
        found = find_minimal_bins(planted.space, planted.labels, label)
        assert found.sets[0].bins == (name,)
        assert found.sets[0].nh_c_space == found.sets[0].nh_c == 1
        # Nothing is left to win.
        assert len(found.sets) == 1


def test_two_bins_where_each_alone_is_not_enough() -> None:
    """The first class has much of both; the others much of one, or of none."""
    random = np.random.default_rng(2)
    values = random.random((80, 40)) / 10
    columns = make_table(values).columns
    first, second = columns.index("A:4"), columns.index("B[2]:2")
    values[:40, first] += 0.5
    values[:20, second] += 0.5
    values[40:60, second] += 0.5
    labels = list(np.repeat(["both", "one", "other", "none"], 20))
    space = make_bin_space(make_table(values), PRESETS["default"], labels)
    found = find_minimal_bins(space, labels, "both", largest=2)
    assert found.sets[0].nh_c_space < 0.9
    assert found.sets[1].bins == ("A:4", "B[2]:2")
    assert found.sets[1].nh_c_space > 0.95


def test_ties_do_not_leak_the_order_of_files() -> None:
    """All bins are empty for most shapes; sorted by class, the nearest by position would be hits."""
    random = np.random.default_rng(0)
    values = (random.random((60, 40)) > 0.9) * 0.3
    labels = list(np.repeat(["a", "b", "c"], 20))
    space = make_bin_space(make_table(values), PRESETS["default"], labels)
    assert all(find_minimal_bins(space, labels, label, largest=1).sets[0].nh_c_space < 0.5 for label in "abc")


def test_the_order_of_shapes_does_not_matter(planted) -> None:
    labels = planted.labels[5:] + planted.labels[:5]
    order = np.random.default_rng(1).permutation(48)
    values = planted.table.values
    first, second = (
        find_minimal_bins(make_bin_space(make_table(v), PRESETS["default"], names), names, "crab")
        for v, names in ((values, labels), (values[order], [labels[i] for i in order]))
    )
    assert [(s.bins, s.nh_c_space, s.nh_c) for s in first.sets] == [
        (s.bins, s.nh_c_space, s.nh_c) for s in second.sets
    ]
    assert (second.sets[-1].xy == first.sets[-1].xy[order]).all()


def test_a_class_that_is_not_there(planted) -> None:
    with pytest.raises(ValueError, match="emu"):
        find_minimal_bins(planted.space, planted.labels, "emu")


def test_a_class_of_one(planted) -> None:
    labels = ["alone", *planted.labels[1:]]
    found = find_minimal_bins(planted.space, labels, "alone", largest=1)
    assert found.sets[0].nh_c_space == found.sets[0].nh_c == 0


def test_the_search_ends_at_what_no_map_exceeds() -> None:
    """Eight of a class have at most seven of ten neighbours in it: one perfect bin is enough."""
    random = np.random.default_rng(0)
    values = random.random((48, 40)) / 10
    values[:8, 7] += 0.6
    labels = list(np.repeat([f"class {i}" for i in range(6)], 8))
    space = make_bin_space(make_table(values), PRESETS["default"], labels)
    found = find_minimal_bins(space, labels, "class 0")
    assert len(found.sets) == 1
    assert found.sets[0].nh_c_space == found.sets[0].nh_c == pytest.approx(0.7)
