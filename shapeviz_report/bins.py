"""Bins: single columns of the feature table, their meaning in words, and how a choice of them is compared."""

from __future__ import annotations

from shapeviz_report.descriptors import DESCRIPTORS
from shapeviz_report.types import FeatureTable, FloatArray

_DESCRIPTORS = {descriptor.name: descriptor for descriptor in DESCRIPTORS}


def explain_bins(table: FeatureTable, edges: FloatArray, *, by_area: bool) -> tuple[str, ...]:
    """What the value of every column is, a sentence each.

    Parameters
    ----------
    table : FeatureTable
    edges : (d, 11) float array
        As in :class:`~shapeviz_report.types.Report`.
    by_area : bool
        Whether histograms count surface or vertices.
    """
    whole = "the surface" if by_area else "the vertices"
    sentences, row = [], 0
    for block in table.blocks:
        if block.bins == 1:
            sentences += [
                f"The value of {column}, a feature that was brought along." for column in block.columns
            ]
            continue
        descriptor = _DESCRIPTORS.get(block.name)
        for dimension in range(block.dimensions):
            quantity = descriptor.quantities[dimension] if descriptor else block.name
            unit = descriptor.unit if descriptor else ""
            for place in range(block.bins):
                span = _word_range(edges[row], place, unit)
                sentences.append(f"What share of {whole} lies where {quantity} is {span}.")
            row += 1
    return tuple(sentences)


def _word_range(edges: FloatArray, place: int, unit: str) -> str:
    """The values that fall into a bin; the outer bins also take what lies beyond."""
    factor = 100 if unit == "%" else 1
    low, high = (f"{factor * edge:.3g}".replace("-", "−") for edge in edges[place : place + 2])
    after = f" {unit}" if unit else ""
    if place == 0:
        return f"below {high}{after}"
    if place == len(edges) - 2:
        return f"{low}{after} or more"
    return f"from {low} to {high}{after}"
