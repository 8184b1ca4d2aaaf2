"""The words for all descriptors: ours, and those of plug-ins, which may bring their own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np

from shapeviz_report.descriptors import DESCRIPTORS, Descriptor
from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
from shapeviz_report.global_descriptors import GLOBAL_DESCRIPTORS, GlobalDescriptor
from shapeviz_report.global_descriptors.registry import ALL_GLOBAL_DESCRIPTORS
from shapeviz_report.plugins import Unfit, guarded, load_plugins, require
from shapeviz_report.wording import GLOBAL_WORDINGS, WORDINGS
from shapeviz_report.wording.base import GlobalWording, Said, Wording, span


@cache
def all_wordings() -> Mapping[str, Wording]:
    """The words for local descriptors, by their names. Raises :class:`~shapeviz_report.errors.PluginError`."""
    brought = {d.name: d for d in ALL_DESCRIPTORS if d not in DESCRIPTORS}
    words = {name: _plain(descriptor) for name, descriptor in brought.items()}
    for plugin, wording in load_plugins("shapeviz_report.wordings", (Wording, GlobalWording)):
        if isinstance(wording, Wording):
            require(plugin, plugin.name in brought, "no descriptor of a plug-in has its name")
            size = brought[plugin.name].dimensions
            parts = (wording.topics, wording.quantities, wording.sought)
            require(plugin, all(len(part) == size for part in parts), f"it is not for {size} dimensions")
            words[plugin.name] = replace(
                wording,
                shown=guarded(plugin, wording.shown, lambda shown, *_: np.asarray(shown, np.float64)),
                say=guarded(plugin, wording.say, _take_said),
            )
    return {**WORDINGS, **words}


@cache
def all_global_wordings() -> Mapping[str, GlobalWording]:
    """The words for global descriptors, by their names. Raises :class:`~shapeviz_report.errors.PluginError`."""
    brought = {d.name: d for d in ALL_GLOBAL_DESCRIPTORS if d not in GLOBAL_DESCRIPTORS}
    words = {name: _plain_of_whole(descriptor) for name, descriptor in brought.items()}
    for plugin, wording in load_plugins("shapeviz_report.wordings", (Wording, GlobalWording)):
        if isinstance(wording, GlobalWording):
            require(plugin, plugin.name in brought, "no global descriptor of a plug-in has its name")
            size = brought[plugin.name].width
            parts = (wording.names, wording.quantities)
            require(plugin, all(len(part) == size for part in parts), f"it is not for {size} values")
            words[plugin.name] = replace(wording, seek=guarded(plugin, wording.seek, _take_text))
    return {**GLOBAL_WORDINGS, **words}


def _take_said(said: Any, *_: object) -> Said:
    if not isinstance(said, Said):
        raise Unfit(f"what it says is of the type {type(said).__name__}, not Said")
    return said


def _take_text(text: Any, *_: object) -> str:
    if not isinstance(text, str):
        raise Unfit(f"other words for a value are of the type {type(text).__name__}, not str")
    return text


def _plain(descriptor: Descriptor) -> Wording:
    """Words for a descriptor that brings none."""
    called = _called(descriptor.title, descriptor.dimensions)
    return Wording(
        aspect=_called(descriptor.title, 1)[0],
        topics=called,
        quantities=tuple(f"the {name}" for name in called),
        unit="",
        shown=np.asarray,
        low="",
        high="",
        sought=(("", ""),) * descriptor.dimensions,
        ease=1.0,
        say=partial(_say, called),
    )


def _plain_of_whole(descriptor: GlobalDescriptor) -> GlobalWording:
    called = _called(descriptor.title, descriptor.width)
    return GlobalWording(
        aspect=_called(descriptor.title, 1)[0],
        names=called,
        quantities=tuple(f"the {name}" for name in called),
        seek=lambda number: "",
    )


def _called(title: str, count: int) -> tuple[str, ...]:
    """What each of some values is called: by the title, as it stands in a sentence."""
    name = title if title[1:2].isupper() else title[:1].lower() + title[1:]
    return (name,) if count == 1 else tuple(f"{name}, value {number + 1}" for number in range(count))


def _say(called: tuple[str, ...], dimension: int, low: float | None, high: float | None) -> Said:
    name = f"{called[dimension]} {span(low, high)}"
    return Said(name, f"has {name}")
