"""The sample of a large database is in proportion, and the same as the browser's."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from shapeviz_report.pages.sampling import sample_rows

SCRIPT = Path(__file__).parents[3] / "site" / "scripts" / "database" / "sample.js"

DATABASES = {
    "uneven classes": (np.repeat([0, 1, 2, -1], [9000, 990, 9, 1]), 1000),
    "mixed up": (np.random.default_rng(0).integers(-1, 40, 5000), 700),
    "more classes than places": (np.arange(300) // 2, 100),
    "no labels": (np.full(500, -1), 64),
    "few": (np.arange(5), 10),
}


@pytest.mark.parametrize("name", DATABASES)
def test_the_browser_takes_the_same_shapes(name: str) -> None:
    groups, most = DATABASES[name]
    asked = (
        f'import {{ sampled }} from "{SCRIPT.as_uri()}";'
        f"const groups = {json.dumps(groups.tolist())};"
        f"console.log(JSON.stringify([...sampled([...groups.keys()], groups, {most})]));"
    )
    answer = subprocess.run(
        ["node", "--input-type=module"], input=asked, capture_output=True, text=True, check=True
    )
    assert json.loads(answer.stdout) == sample_rows(groups, most).tolist()


def test_each_class_is_there_in_proportion() -> None:
    groups, most = DATABASES["uneven classes"]
    rows = sample_rows(groups, most)
    assert len(rows) == most
    assert (np.diff(rows) > 0).all()
    found = {int(group): int(count) for group, count in zip(*np.unique(groups[rows], return_counts=True))}
    assert found[-1] == 1
    assert found[2] == 1
    for group in (0, 1):
        assert found[group] == pytest.approx((groups == group).mean() * most, abs=2)


def test_it_has_nothing_to_do_with_where_shapes_stand() -> None:
    groups, most = DATABASES["uneven classes"]
    rows = sample_rows(groups, most)
    quarters = np.histogram(rows[groups[rows] == 0], bins=4, range=(0, 9000))[0]
    assert quarters.min() > 190


def test_of_more_classes_than_places_no_two_shapes_are_of_one() -> None:
    groups, most = DATABASES["more classes than places"]
    assert len(np.unique(groups[sample_rows(groups, most)])) == most
