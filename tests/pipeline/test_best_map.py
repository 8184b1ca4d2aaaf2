"""Where a search laid out a sample, the map of its best subset is made of all shapes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reports import make_report, with_search

from shapeviz_report.building.progress import Clock, QuietProgress
from shapeviz_report.building.questions import lay_out_best
from shapeviz_report.building.runner import Runner
from shapeviz_report.building.workers import open_workers
from shapeviz_report.cache import Cache
from shapeviz_report.config import Config
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.projections import PROJECTIONS, align, project


@pytest.fixture(scope="module")
def report():
    return with_search(make_report(["ant", "bird", "cup"], 12, features=("Gc", "Sc", "PFH")), limit=24)


@pytest.fixture(scope="module")
def scaled(report):
    return scale(report.features, PRESETS["default"])


@pytest.fixture(scope="module")
def like(report):
    return report.projections["tsne"][0]


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    cache = Cache(tmp_path_factory.mktemp("cache"))
    with open_workers(Config(), 1) as executor:
        yield Runner(executor, Clock(QuietProgress()), cache, {}, [], Config())


def search_that_found(report, *best: str):
    """The report's search, as if its best subset were this one."""
    search = report.search
    wanted = [name in best for name in search.features]
    scores = (search.subsets.members == wanted).all(axis=1).astype(float)
    return replace(search, subsets=replace(search.subsets, nh_s=scores))


def test_it_compares_the_features_of_the_subset(run, report, scaled, like) -> None:
    search = search_that_found(report, "Gc", "PFH")
    found, values = lay_out_best(run, search, report.features, None, scaled, Config(), like)
    own = np.hstack([scaled[:, report.features.slice_of(name)] for name in ("Gc", "PFH")])
    np.testing.assert_array_equal(values, own)
    assert found.features == ("Gc", "PFH")
    assert found.bins is None
    expected = align(project(PROJECTIONS[0], own, ("Gc", "PFH"), 0), like)
    np.testing.assert_allclose(found.xy, expected.xy, atol=1e-6)


def test_where_all_features_are_best_their_map_is_there_already(run, report, scaled, like) -> None:
    search = search_that_found(report, "Gc", "Sc", "PFH")
    assert lay_out_best(run, search, report.features, None, scaled, Config(), like) is None
    # The site of some bins has no map of all features.
    found, values = lay_out_best(run, search, report.features, ("Gc:1",), scaled, Config(), like)
    assert found.features == search.features
    np.testing.assert_array_equal(values, scaled)


def test_a_search_of_all_shapes_has_its_maps(run, report, scaled, like) -> None:
    search = replace(search_that_found(report, "Gc"), rows=np.arange(36, dtype=np.int32))
    assert lay_out_best(run, search, report.features, None, scaled, Config(), like) is None


def test_without_labels_none_is_best(run, report, scaled, like) -> None:
    search = report.search
    unknown = np.full(len(search.subsets.nh_s), np.nan)
    search = replace(search, subsets=replace(search.subsets, nh_s=unknown))
    assert lay_out_best(run, search, report.features, None, scaled, Config(), like) is None
