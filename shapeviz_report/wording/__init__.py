"""What the values of features mean, in words: plain ones that a stranger can picture, and exact ones.

One file a descriptor, which no stage but that of clusters reaches: better words cost no rebuild of features.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from shapeviz_report.types import FeatureBlock, FeatureTable, FloatArray
from shapeviz_report.wording.base import GlobalWording, Said, Wording, span
from shapeviz_report.wording.depth_views import DEPTH_VIEWS
from shapeviz_report.wording.fast_point_feature_histogram import FAST_POINT_FEATURE_HISTOGRAM
from shapeviz_report.wording.gaussian_curvature import GAUSSIAN_CURVATURE
from shapeviz_report.wording.geodesic_distance import GEODESIC_DISTANCE
from shapeviz_report.wording.normal_angle import NORMAL_ANGLE
from shapeviz_report.wording.normal_diameter import NORMAL_DIAMETER
from shapeviz_report.wording.panorama import PANORAMA
from shapeviz_report.wording.panorama_slant import PANORAMA_SLANT
from shapeviz_report.wording.point_angle import POINT_ANGLE
from shapeviz_report.wording.point_feature_histogram import POINT_FEATURE_HISTOGRAM
from shapeviz_report.wording.shape_context import SHAPE_CONTEXT
from shapeviz_report.wording.silhouettes import SILHOUETTES
from shapeviz_report.wording.surflets import SURFLETS

WORDINGS: Mapping[str, Wording] = {
    "Gc": GAUSSIAN_CURVATURE,
    "Agd": GEODESIC_DISTANCE,
    "Nd": NORMAL_DIAMETER,
    "Na": NORMAL_ANGLE,
    "Pa": POINT_ANGLE,
    "Sc": SHAPE_CONTEXT,
    "PFH": POINT_FEATURE_HISTOGRAM,
    "FPFH": FAST_POINT_FEATURE_HISTOGRAM,
}
"""By the names of the descriptors."""

GLOBAL_WORDINGS: Mapping[str, GlobalWording] = {
    "Pan": PANORAMA,
    "PanS": PANORAMA_SLANT,
    "Dep": DEPTH_VIEWS,
    "Sil": SILHOUETTES,
    "Sfl": SURFLETS,
}
"""By the names of the global descriptors."""


def _wording_of(descriptor: str) -> Wording | None:
    # when it is asked for: plug-ins, which bring more, import this package themselves
    from shapeviz_report.wording.registry import all_wordings

    return all_wordings().get(descriptor)


def _wordings_of_whole() -> Mapping[str, GlobalWording]:
    from shapeviz_report.wording.registry import all_global_wordings

    return all_global_wordings()


class Dimension(NamedTuple):
    """A histogram of a feature: the block and its number in it, and its edges as they are shown."""

    block: FeatureBlock
    number: int
    edges: FloatArray

    @property
    def wording(self) -> Wording | None:
        """Of its descriptor; None for a histogram that is none of ours."""
        return _wording_of(self.block.name)

    @property
    def topic(self) -> str:
        """What its values are, in few words."""
        return self.block.name if self.wording is None else self.wording.topics[self.number]

    @property
    def unit(self) -> str:
        """Of its edges."""
        return "" if self.wording is None else self.wording.unit

    def say(self, low: float | None, high: float | None) -> Said:
        """A range of its values in plain words."""
        if self.wording is None:
            name = f"{self.block.name} {span(low, high)}"
            return Said(name, f"has a {name}")
        return self.wording.say(self.number, low, high)

    def say_bin(self, place: int) -> Said:
        """A bin in plain words: the outer ones also take what lies beyond."""
        return self.say(
            None if place == 0 else float(self.edges[place]),
            None if place == self.block.bins - 1 else float(self.edges[place + 1]),
        )

    def define(self, place: int) -> str:
        """Where the surface lies that a bin counts, exactly, as it stands after "where"."""
        quantity = self.block.name if self.wording is None else self.wording.quantities[self.number]
        low, high = (f"{edge:.3g}".replace("-", "−") for edge in self.edges[place : place + 2])
        unit = self.unit if self.unit in ("", "°") else f"\u00a0{self.unit}"
        if place == 0:
            return f"{quantity} is below {high}{unit}"
        if place == self.block.bins - 1:
            return f"{quantity} is {low}{unit} or more"
        return f"{quantity} is from {low} to {high}{unit}"


def dimensions_of(table: FeatureTable, edges: FloatArray) -> Iterator[Dimension]:
    """The histograms of a table in the order of their columns.

    Parameters
    ----------
    table : FeatureTable
    edges : (d, 11) float array
        As in :class:`~shapeviz_report.types.Report`.
    """
    row = 0
    for block in table.blocks:
        wording = _wording_of(block.name)
        for number in range(block.dimensions if block.bins > 1 else 0):
            yield Dimension(block, number, edges[row] if wording is None else wording.shown(edges[row]))
            row += 1


def explain_bins(table: FeatureTable, edges: FloatArray, *, by_area: bool) -> tuple[str, ...]:
    """What the value of every column is exactly, a sentence each; parameters as for :func:`say_bins`."""
    sentences = [f"The value of {column}, a feature that was brought along." for column in table.columns]
    for block, start in _whole(table):
        for place, quantity in enumerate(_wordings_of_whole()[block.name].quantities):
            sentences[start + place] = f"The value is {quantity}."
    for dimension, start in _placed(table, edges):
        for place in range(dimension.block.bins):
            sentences[start + place] = (
                f"What share of {word_whole(by_area)} lies where {dimension.define(place)}."
            )
    return tuple(sentences)


def call_bins(table: FeatureTable, edges: FloatArray) -> tuple[str, ...]:
    """Every column in few plain words; empty for external features."""
    called = [""] * len(table.columns)
    for dimension, start in _placed(table, edges):
        for place in range(dimension.block.bins):
            called[start + place] = dimension.say_bin(place).name
    for block, start in _whole(table):
        called[start : start + block.width] = _wordings_of_whole()[block.name].names
    return tuple(called)


def say_bins(table: FeatureTable, edges: FloatArray, *, by_area: bool) -> tuple[Said | None, ...]:
    """Every share of the surface in plain words; None for columns that are none.

    Parameters
    ----------
    table : FeatureTable
    edges : (d, 11) float array
        As in :class:`~shapeviz_report.types.Report`.
    by_area : bool
        Whether histograms count surface or vertices.
    """
    said: list[Said | None] = [None] * len(table.columns)
    for dimension, start in _placed(table, edges):
        for place in range(dimension.block.bins):
            said[start + place] = agreed(dimension.say_bin(place), by_area)
    return tuple(said)


def _placed(table: FeatureTable, edges: FloatArray) -> Iterator[tuple[Dimension, int]]:
    """Histograms with their first columns."""
    for dimension in dimensions_of(table, edges):
        first = table.slice_of(dimension.block.name).start
        yield dimension, first + dimension.number * dimension.block.bins


def _whole(table: FeatureTable) -> Iterator[tuple[FeatureBlock, int]]:
    """The features of whole shapes with their first columns."""
    for block in table.blocks:
        if block.name in _wordings_of_whole():
            yield block, table.slice_of(block.name).start


def word_whole(by_area: bool) -> str:
    """What histograms count, as it stands in "a share of"."""
    return "the surface" if by_area else "the vertices"


def agreed(said: Said, by_area: bool) -> Said:
    """The words with the verb of their clause as it follows the surface, or the vertices."""
    if by_area:
        return said
    verb, rest = said.clause.split(" ", 1)
    return said._replace(clause=f"{_PLURALS.get(verb) or verb.removesuffix('s')} {rest}")


_PLURALS = {"is": "are", "has": "have"}
