"""One part of every kind for shapeviz-report, each as short as it can be; docs/using/plugins.md says more."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from shapeviz_report.database import Layout
from shapeviz_report.database.flat import FlatFolder
from shapeviz_report.descriptors import Descriptor, Surface
from shapeviz_report.global_descriptors import GlobalDescriptor, PosedShape
from shapeviz_report.projections import Method
from shapeviz_report.scorers import Scorer
from shapeviz_report.types import Database, FloatArray
from shapeviz_report.wording.base import Said, Wording, span


def distance_to_middle(surface: Surface) -> FloatArray:
    """How far every vertex is from the middle of the shape, in its radii; (n, 1), from 0 to 1."""
    return np.linalg.norm(surface.vertices - surface.barycentre, axis=1)[:, None]


HUB = Descriptor(
    name="Hub",
    title="Distance to the middle",
    measures="How far a point is from the middle of the shape, on a straight line.",
    dimensions=1,
    edges=tuple(float(edge) for edge in np.linspace(0, 1, 11)),
    compute=distance_to_middle,
)

# A descriptor without words of its own is spoken of by its title.
HUB_WORDS = Wording(
    aspect="spread",
    topics=("distance to the middle",),
    quantities=("the distance to the middle of the shape",),
    unit="radii",
    shown=np.asarray,
    low="near the middle",
    high="far out",
    sought=(("centre core", "far outer tip end"),),
    ease=2.0,
    say=lambda dimension, low, high: Said(
        f"distance to the middle {span(low, high)}", f"is {span(low, high)} radii from the middle"
    ),
)


def proportions(shape: PosedShape) -> FloatArray:
    """The sizes of the shape along its main axes, the longest first, as parts of the first; (3,)."""
    sizes = np.sort(np.ptp(shape.vertices, axis=0))[::-1]
    return sizes / sizes[0]


BOX = GlobalDescriptor(
    name="Box",
    title="Proportions",
    measures="How long, broad and high the box is that the shape just fits into.",
    width=3,
    compute=proportions,
)


def gap(values: FloatArray, positive: np.ndarray, seed: int) -> FloatArray:
    """How far the means of two groups are apart, in standard deviations of all; (d,)."""
    means = values[positive].mean(axis=0), values[~positive].mean(axis=0)
    return np.abs(means[0] - means[1]) / values.std(axis=0)


GAP = Scorer(
    name="gap",
    title="Gap",
    explanation="High where the two groups are far apart on average.",
    source="Cohen 1988",
    range="0 and above",
    exact=True,
    measure=gap,
)


def on_rings(squared: FloatArray, seed: int) -> FloatArray:
    """Each row as far from the middle as it is from the most central one; (n, 2)."""
    central = squared.sum(axis=0).argmin()
    angles = np.argsort(np.argsort(squared[0])) * 2 * np.pi / len(squared)
    return np.sqrt(squared[central])[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])


RINGS = Method(
    name="rings",
    title="Rings",
    explanation="The farther out a shape, the less it is like the most typical one; directions mean nothing.",
    smallest=3,
    arrange=on_rings,
    embed=None,
)


class Prefixed(Layout):
    """``chair_01.off``: the class stands before the first underscore of the file's name."""

    name = "prefixed"
    description = "a folder of meshes whose names begin with their class: CLASS_*.off"

    def recognises(self, path: Path, outside: bool) -> bool:
        flat = FlatFolder()
        return flat.recognises(path, outside) and all("_" in s.id for s in flat.read(path, outside).shapes)

    def read(self, path: Path, outside: bool) -> Database:
        found = FlatFolder().read(path, outside)
        shapes = tuple(replace(s, labels={"class": s.id.partition("_")[0]}) for s in found.shapes)
        return replace(found, layout=self.name, shapes=shapes, labelings=("class",))


PREFIXED = Prefixed()
