"""All local descriptors: ours, and those of plug-ins."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from shapeviz_report.descriptors import DESCRIPTORS, Descriptor, Surface
from shapeviz_report.plugins import Plugin, guarded, require, take_numbers, with_plugins
from shapeviz_report.types import FloatArray


def _prepare(plugin: Plugin, descriptor: Descriptor) -> Descriptor:
    require(
        plugin,
        descriptor.name.isidentifier(),
        "its name is part of the names of bins: letters and digits only",
    )
    require(
        plugin,
        descriptor.measures.endswith("."),
        "what it measures is a sentence, which ends with a full stop",
    )
    require(plugin, descriptor.dimensions >= 1, "it has no dimension")
    edges = np.array(descriptor.edges, np.float64)
    require(
        plugin,
        edges.shape == (11,) and bool(np.isfinite(edges).all() and (np.diff(edges) > 0).all()),
        "its edges are not 11 rising numbers",
    )

    def take(values: Any, surface: Surface) -> FloatArray:
        return take_numbers(values, (len(surface.vertices), descriptor.dimensions), "its values")

    return replace(descriptor, compute=guarded(plugin, descriptor.compute, take))


ALL_DESCRIPTORS = with_plugins("shapeviz_report.descriptors", DESCRIPTORS, Descriptor, _prepare)
"""Ours first, in the order of the paper's table."""
