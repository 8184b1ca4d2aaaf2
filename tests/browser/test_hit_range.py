"""What NH can be, in the browser as in Python."""

from __future__ import annotations

from pathlib import Path

import pytest

from shapeviz_report.quality import hit_range, share_of_range
from shapeviz_report.writing.joiner import join


@pytest.fixture
def page(browser):
    page = browser.new_page()
    page.evaluate(join(Path(__file__).parent / "hit-range.js"))
    yield page
    page.close()


@pytest.mark.parametrize(
    "labels", ["", "a", "--", "abc", "aaaa", "aabb-", "a" * 8 + "b" * 8 + "c" * 30, "a" * 11 + "b" * 12]
)
def test_the_range_is_that_of_python(page, labels) -> None:
    for k in (1, 3, 10):
        groups = ["abc".find(label) for label in labels]
        found = page.evaluate("([groups, k]) => ranges.hitRange(groups, k)", [groups, k])
        expected = hit_range([None if label == "-" else label for label in labels], k)
        assert found["highest"] == pytest.approx(expected.highest, abs=1e-12)
        for name, values in (
            ("highestOfClass", expected.highest_of_class),
            ("chanceOfClass", expected.chance_of_class),
        ):
            assert {"abc"[group]: value for group, value in found[name]} == pytest.approx(dict(values))


@pytest.mark.parametrize(
    "values", [(0.7, 0.1, 0.7), (0.05, 0.1, 0.7), (0.4, 0.1, 1), (0, 0, 0), (None, 0.1, 1)]
)
def test_the_share_is_that_of_python(page, values) -> None:
    found = page.evaluate("(values) => ranges.shareOfRange(...values)", list(values))
    assert found == pytest.approx(share_of_range(*values))
