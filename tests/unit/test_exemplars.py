"""Which shapes and classes show a contrast."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reports import make_report, with_bin_search

from shapeviz_report.exemplars import choose_exemplars, find_centres, find_rivals

LABELS = ["ant"] * 6 + ["bird"] * 6 + ["cup"] * 6 + [None]


def blobs(*centres: tuple[float, float]) -> np.ndarray:
    random = np.random.default_rng(0)
    return np.concatenate([np.repeat(centres, 6, axis=0) + random.normal(0, 0.1, (18, 2)), [[0, 0]]])


def test_the_centre_of_a_class_is_the_shape_nearest_to_its_mean() -> None:
    values = blobs((0, 0), (9, 9), (-9, 9))
    values[8] = values[[6, 7, 9, 10, 11]].mean(axis=0)
    assert find_centres(values, LABELS)["bird"] == 8
    assert set(find_centres(values, LABELS)) == {"ant", "bird", "cup"}


def test_a_class_is_confused_with_the_one_among_its_neighbours() -> None:
    # Cups lie far off but for one amid the birds; ants lie close to the birds without touching them.
    xy = blobs((0, 1.6), (0, 0), (20, 20))
    xy[12] = (0, 0)
    xy[18] = (-20, 20)
    rivals = find_rivals(xy, LABELS, 4)
    assert rivals["bird"] == "cup"
    assert rivals["cup"] == "bird"
    # Nobody is among the ants: then the nearest class counts.
    assert rivals["ant"] == "bird"


def test_rivals_need_no_more_neighbours_than_there_are() -> None:
    assert find_rivals(np.array([[0.0, 0], [1, 0]]), ["a", "b"], 10) == {"a": "b", "b": "a"}


@pytest.mark.slow
def test_every_bin_found_is_seen_where_it_tells_classes_apart() -> None:
    report = with_bin_search(make_report(features=("Gc", "Sc", "Nd")))
    table, labels = report.features, np.array(report.labels)
    xy = report.projections["tsne"][0].xy
    exemplars = choose_exemplars(report.bins, table, report.labels, table.values, xy, 10)
    centres, rivals = find_centres(table.values, report.labels), find_rivals(xy, report.labels, 10)
    for separated in report.bins.minimal:
        for column in separated.sets[0].bins:
            assert {centres[separated.label], centres[rivals[separated.label]]} <= set(exemplars[column])
    for column in report.bins.automatic.bins:
        amounts = table.values[:, table.columns.index(column)]
        means = {name: amounts[labels == name].mean() for name in centres}
        ranked = sorted(means, key=means.get)
        assert {centres[ranked[0]], centres[ranked[-1]]} <= set(exemplars[column])
    found = {c for m in report.bins.minimal for s in m.sets for c in s.bins} | set(report.bins.automatic.bins)
    assert set(exemplars) == found
    assert list(exemplars) == sorted(found, key=table.columns.index)


@pytest.mark.slow
def test_external_features_have_no_surface_to_be_seen_on() -> None:
    report = with_bin_search(make_report())
    blocks = tuple(replace(block, bins=1, dimensions=block.width) for block in report.features.blocks)
    plain = replace(report.features, blocks=blocks)
    names = dict(zip(report.features.columns, plain.columns))
    minimal = tuple(
        replace(m, sets=tuple(replace(s, bins=tuple(names[b] for b in s.bins)) for s in m.sets))
        for m in report.bins.minimal
    )
    path = report.bins.automatic.path
    path = (replace(path[-1], bins=tuple(names[b] for b in path[-1].bins)),)
    found = replace(report.bins, minimal=minimal, automatic=replace(report.bins.automatic, path=path))
    xy = report.projections["tsne"][0].xy
    assert choose_exemplars(found, plain, report.labels, plain.values, xy, 10) == {}
