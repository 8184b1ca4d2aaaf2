"""All global descriptors: ours, and those of plug-ins."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
from shapeviz_report.global_descriptors import GLOBAL_DESCRIPTORS, GlobalDescriptor, PosedShape
from shapeviz_report.plugins import Plugin, guarded, require, same_name, take_numbers, with_plugins
from shapeviz_report.types import FloatArray


def _prepare(plugin: Plugin, descriptor: GlobalDescriptor) -> GlobalDescriptor:
    require(
        plugin,
        descriptor.name.isidentifier(),
        "its name is part of the names of values: letters and digits only",
    )
    require(
        plugin,
        all(same_name(descriptor.name) != same_name(local.name) for local in ALL_DESCRIPTORS),
        f"there is already a feature {descriptor.name!r}",
    )
    require(
        plugin,
        descriptor.measures.endswith("."),
        "what it measures is a sentence, which ends with a full stop",
    )
    require(plugin, descriptor.width >= 1, "it has no value")

    def take(values: Any, shape: PosedShape) -> FloatArray:
        return take_numbers(values, (descriptor.width,), "its values")

    return replace(descriptor, compute=guarded(plugin, descriptor.compute, take))


ALL_GLOBAL_DESCRIPTORS = with_plugins(
    "shapeviz_report.global_descriptors", GLOBAL_DESCRIPTORS, GlobalDescriptor, _prepare
)
"""Ours first."""
