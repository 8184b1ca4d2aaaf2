"""From meshes to rows of features, without pictures and models."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from shapeviz_report.building import stages
from shapeviz_report.building.chains import Chain, Plan
from shapeviz_report.building.runner import Runner
from shapeviz_report.features import fixed_edges, quantile_edges
from shapeviz_report.presets import Preset
from shapeviz_report.types import Failure, FeatureBlock, FeatureTable, FloatArray, ShapeFacts

SAMPLED_VERTICES = 400_000
"""Vertices behind data-driven histogram ranges, over all shapes."""

SAMPLED_OF_A_SHAPE = (16, 1000)
"""The least and most of these of one shape."""

Files = Callable[[], Mapping[str, bytes]]
"""Gives the files of a mesh when its turn comes. May raise :class:`~shapeviz_report.errors.MeshError`."""


@dataclass
class Measured:
    """What is found of meshes; those that failed are missing.

    Attributes
    ----------
    facts : dict of str to ShapeFacts
    rows : dict of str to (w,) float64 array
        The features of each.
    vertices : dict of str to dict
        Values at its vertices, as :func:`~shapeviz_report.building.stages.read_vertices` has them, where asked for.
    """

    facts: dict[str, ShapeFacts] = field(default_factory=dict)
    rows: dict[str, FloatArray] = field(default_factory=dict)
    vertices: dict[str, dict[str, Any]] = field(default_factory=dict)


def measure_meshes(
    run: Runner,
    meshes: Mapping[str, Files],
    preset: Preset,
    edges: FloatArray,
    edge_length: float,
    *,
    vertices: bool = False,
) -> Measured:
    """The features of meshes.

    Parameters
    ----------
    run : Runner
    meshes : mapping of str to callable
        By shape.
    preset : Preset
    edges : (D, 11) float64 array
        Of the histograms; see :func:`find_edges`.
    edge_length : float
        As :func:`~shapeviz_report.mesh.prepare` takes it.
    vertices : bool
        Whether the values at vertices are wanted too.
    """

    def plan(shape: str) -> Plan:
        chain, files = _prepare(meshes[shape], edge_length)
        chain.add(stages.MEASURE, [stages.PREPARE], edges, preset.by_area)
        chain.add(stages.DESCRIBE_WHOLE, [stages.PREPARE])
        chain.add(stages.MEASURE_VERTICES, [stages.PREPARE])
        return chain, files

    measured = Measured()
    described: list[stages.Stage[Any]] = [
        stages.MEASURE,
        *([stages.DESCRIBE_WHOLE] if preset.whole else []),
    ]

    def take(shape: str, _: Chain, found: dict[stages.Stage[Any], Any]) -> None:
        measured.facts[shape] = found[stages.FACTS]
        measured.rows[shape] = np.concatenate([found[stage] for stage in described])
        if vertices:
            measured.vertices[shape] = found[stages.MEASURE_VERTICES]

    wanted = [stages.FACTS, *described, *([stages.MEASURE_VERTICES] if vertices else [])]
    run.each("Measuring shapes", meshes, wanted, plan, take)
    return measured


def find_edges(
    run: Runner, meshes: Mapping[str, Files], preset: Preset, edge_length: float
) -> tuple[FloatArray, Mapping[str, Files]]:
    """The (D, 11) bin edges of a preset: those that descriptors define, or those that these meshes have; and the meshes
    but for those that failed meanwhile."""
    if preset.fixed_ranges:
        return fixed_edges(), meshes
    share = sampled_of_each(len(meshes))

    def plan(shape: str) -> Plan:
        chain, files = _prepare(meshes[shape], edge_length)
        chain.add(stages.SAMPLE, [stages.PREPARE], share)
        return chain, files

    samples: dict[str, FloatArray] = {}

    def take(shape: str, _: Chain, found: dict[stages.Stage[Any], Any]) -> None:
        samples[shape] = found[stages.SAMPLE]

    run.each("Preparing shapes", meshes, [stages.FACTS, stages.SAMPLE], plan, take)
    kept = {shape: read for shape, read in meshes.items() if shape in samples}
    return quantile_edges([samples[shape] for shape in kept]) if kept else fixed_edges(), kept


def tabulate(
    rows: dict[str, FloatArray],
    places: Mapping[str, int],
    preset: Preset,
    external: Sequence[tuple[FeatureBlock, FloatArray]],
) -> FeatureTable:
    """The table of what was measured, and of features that were brought along.

    Parameters
    ----------
    rows : dict of str to (w,) float64 array
        What was measured, by shape; taken out one by one, as those of 100,000 shapes are two gigabytes.
    places : mapping of str to int
        The shapes of the table, in its order, and the row of each in what was brought along.
    preset : Preset
    external : sequence of (FeatureBlock, (n, v) float64 array)
    """
    blocks = (*preset.blocks, *(block for block, _ in external))
    values = np.empty((len(places), sum(block.width for block in blocks)))
    for row, (shape, place) in zip(values, places.items(), strict=True):
        np.concatenate([rows.pop(shape), *(own[place] for _, own in external)], out=row)
    return FeatureTable(tuple(places), blocks, values)


def sampled_of_each(count: int) -> int:
    """Vertices of each of so many shapes that decide data-driven ranges."""
    return int(np.clip(SAMPLED_VERTICES // max(1, count), *SAMPLED_OF_A_SHAPE))


def nothing_usable(path: Path, failures: Sequence[Failure]) -> Iterator[str]:
    """The lines of a message."""
    yield f"None of the files in {path} can be used:"
    yield from (f"  {failure.path}: {failure.reason}" for failure in failures[:5])
    if len(failures) > 5:
        yield f"  and {len(failures) - 5} more"


def _prepare(read: Files, edge_length: float) -> Plan:
    """The stages with which all begins."""
    files = read()
    chain = Chain(stages.identify(files))
    chain.add(stages.PREPARE, (), edge_length)
    chain.add(stages.FACTS, [stages.PREPARE])
    return chain, files
