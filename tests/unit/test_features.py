"""Histograms, presets, scaling and external features."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from solids import ball, from_trimesh, lump, sheet, tube

from shapeviz_report.descriptors import DESCRIPTORS, Descriptor, Surface
from shapeviz_report.features import (
    BINS,
    BLOCKS,
    clear_edges,
    compute_histograms,
    describe,
    find_bins,
    fixed_edges,
    measure,
    quantile_edges,
    sample_values,
)
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.types import FeatureBlock, FeatureTable


def table(*meshes) -> FeatureTable:
    values = np.array([compute_histograms(m, fixed_edges(), by_area=True) for m in meshes])
    return FeatureTable(tuple(map(str, range(len(meshes)))), BLOCKS, values)


def test_columns_have_the_papers_names() -> None:
    columns = table(ball(2)).columns
    assert len(columns) == BINS * sum(descriptor.dimensions for descriptor in DESCRIPTORS)
    assert columns[0] == "Gc:1"
    assert columns[15] == "Agd:6"
    assert columns[table(ball(2)).slice_of("FPFH").start + 142] == "FPFH[14]:3"
    assert len(set(columns)) == len(columns)


def test_histograms_against_numpy() -> None:
    mesh = lump()
    surface = Surface(mesh)
    values, edges = np.hstack([d.compute(surface) for d in DESCRIPTORS]), fixed_edges()
    for by_area, weights in ((True, surface.areas), (False, np.ones(len(values)))):
        found = compute_histograms(mesh, edges, by_area=by_area).reshape(-1, BINS)
        for dimension in range(len(edges)):
            inside = np.clip(values[:, dimension], edges[dimension, 0], edges[dimension, -1])
            counts, _ = np.histogram(inside, edges[dimension], weights=weights)
            assert found[dimension] == pytest.approx(counts / weights.sum(), abs=1e-9)


def test_fractions_add_up_and_values_beyond_the_ends_count() -> None:
    edges = np.tile(np.linspace(0.4, 0.6, 11), (len(fixed_edges()), 1))
    found = compute_histograms(lump(), edges, by_area=True).reshape(-1, BINS)
    assert found.sum(axis=1) == pytest.approx(1)
    assert found[:, [0, 9]].sum() > 100


def test_bins_of_vertices_are_those_that_the_histograms_count() -> None:
    mesh, edges = lump(), fixed_edges()
    every = np.arange(len(mesh.vertices))
    histograms, bins = describe(mesh, edges, every, by_area=False)
    counted = np.stack([np.bincount(row, minlength=10) for row in bins])
    assert histograms.reshape(-1, BINS) == pytest.approx(counted / len(every))
    np.testing.assert_array_equal(describe(mesh, edges, every[7:3:-1], by_area=True)[1], bins[:, 7:3:-1])


def test_measured_values_are_the_ones_that_fall_into_bins() -> None:
    mesh, edges = lump(), fixed_edges()
    _, bins = describe(mesh, edges, np.arange(len(mesh.vertices)), by_area=True)
    dimensions = [len(edges) - 1, 0, 40, 5]
    values = measure(mesh, dimensions)
    np.testing.assert_array_equal(find_bins(values, edges[dimensions]), bins[dimensions])


def test_a_value_on_an_edge_falls_above_it_and_what_lies_beyond_into_the_outer_bins() -> None:
    edges = np.arange(11.0)[None]
    values = np.array([[-5, 0, 0.99, 1, 9, 10, 99]], np.float32)
    assert find_bins(values, edges).tolist() == [[0, 0, 0, 1, 9, 9, 9]]


def test_quantile_edges_cut_off_one_per_cent() -> None:
    samples = [sample_values(mesh, 400) for mesh in (ball(3), lump(), tube())]
    assert samples[0].shape == (400, len(fixed_edges()))
    edges = quantile_edges(samples)
    assert edges.shape == fixed_edges().shape
    assert (np.diff(edges) > 0).all()
    values = np.concatenate(samples)
    assert np.mean(values[:, 1] < edges[1, 0]) == pytest.approx(0.01, abs=0.002)
    assert np.mean(values[:, 1] > edges[1, -1]) == pytest.approx(0.01, abs=0.002)


def shares(descriptor: Descriptor) -> np.ndarray:
    """Every value that a descriptor of shares can take."""
    return np.array(sorted({m / total for total in descriptor.totals for m in range(total + 1)}))


@pytest.mark.slow
@pytest.mark.parametrize("preset", ["default", "paper"])
def test_no_edge_lies_on_a_share(preset) -> None:
    meshes = (ball(3), lump(), sheet(), tube())
    edges = (
        fixed_edges()
        if preset == "default"
        else quantile_edges([sample_values(mesh, 400) for mesh in meshes])
    )
    start = 0
    for descriptor in DESCRIPTORS:
        inner = edges[start : start + descriptor.dimensions, 1:-1]
        start += descriptor.dimensions
        if descriptor.totals:
            values = shares(descriptor)
            place = np.searchsorted(values, inner).clip(1, len(values) - 1)
            away = np.minimum(np.abs(inner - values[place - 1]), np.abs(inner - values[place]))
            assert away.min() > 0.99e-7
    assert (np.diff(edges) > 0).all()


def test_an_edge_on_a_value_moves_to_the_middle_of_the_step_below_and_others_stay() -> None:
    edges = np.tile(np.linspace(0.0, 1.0, 11), (len(fixed_edges()), 1))
    edges[29, 1:4] = 1 / 870, 0.0015, 87 / 870 + 3e-8
    cleared = clear_edges(edges)
    assert cleared[29, 1] == pytest.approx(0.5 / 870)
    assert cleared[29, 2] == 0.0015
    assert 86.5 / 870 <= cleared[29, 3] < 87 / 870 - 1e-6
    np.testing.assert_array_equal(cleared[:, [0, 10]], edges[:, [0, 10]])


def test_rounding_moves_no_vertex_of_flat_and_regular_shapes_to_another_bin() -> None:
    rng = np.random.default_rng(0)
    box = from_trimesh(trimesh.creation.box((3, 2, 1)).subdivide().subdivide().subdivide())
    for mesh in (sheet(), box, tube(), lump()):
        surface = Surface(mesh)
        values = np.hstack([d.compute(surface).astype(np.float64) for d in DESCRIPTORS])
        sample = values[rng.integers(0, len(values), 400)].astype(np.float32)
        for edges in (fixed_edges(), quantile_edges([sample])):
            bins = [
                find_bins(
                    (values * (1 + size * rng.uniform(-1, 1, values.shape))).T.astype(np.float32), edges
                )
                for size in (0, 1e-12, 6e-8)
            ]
            np.testing.assert_array_equal(bins[0], bins[1])
            np.testing.assert_array_equal(bins[0][5:154], bins[2][5:154])


@pytest.mark.parametrize("dimension", [0, 1, 2, 3, 4, 160])
def test_round_values_fall_above_their_edges_whatever_the_rounding(dimension) -> None:
    nominal = np.concatenate([np.tile(d.edges, (d.dimensions, 1)) for d in DESCRIPTORS])[dimension, 1:-1]
    noise = np.linspace(-1e-7, 1e-7, 9)
    values = np.concatenate([nominal * (1 + part) for part in noise])[None].astype(np.float32)
    bins = find_bins(values, fixed_edges()[[dimension]])
    assert bins.reshape(9, 9).tolist() == [list(range(1, 10))] * 9


def test_a_range_of_rounding_is_one_value() -> None:
    noise = np.linspace(-1e-7, 1e-7, 500, dtype=np.float32)[:, None]
    samples = np.full((500, len(fixed_edges())), 0.25, np.float32) + noise
    assert set(find_bins(samples.T, quantile_edges([samples])).ravel()) == {0}


def test_balanced_scaling_gives_every_feature_the_same_say() -> None:
    features = table(ball(3), lump(0), lump(1), tube())
    scaled = scale(features, PRESETS["default"])
    for block in features.blocks:
        part = scaled[:, features.slice_of(block.name)]
        assert (part**2).sum(axis=1).mean() == pytest.approx(1)
    # Within a feature, distances are Hellinger distances of the histograms.
    agd = features.slice_of("Agd")
    roots = np.sqrt(features.values[:, agd])
    ratios = np.linalg.norm(scaled[1:, agd] - scaled[0, agd], axis=1) / np.linalg.norm(
        roots[1:] - roots[0], axis=1
    )
    assert ratios == pytest.approx(ratios[0])


def test_the_papers_reading_is_not_scaled() -> None:
    features = table(ball(2), lump())
    assert scale(features, PRESETS["paper"]) is features.values


def test_a_feature_without_differences_has_no_say() -> None:
    features = FeatureTable(
        ("a", "b"), (FeatureBlock("x", 1, 1), FeatureBlock("y", 1, 1)), np.array([[5.0, 1], [5, 2]])
    )
    assert scale(features, PRESETS["default"]).tolist() == [[0, -1], [0, 1]]
