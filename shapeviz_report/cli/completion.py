"""Scripts that make a shell complete the command line."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Sequence

import shtab

from shapeviz_report.cli.arguments import given_path
from shapeviz_report.config import Config
from shapeviz_report.database.registry import ALL_LAYOUTS
from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
from shapeviz_report.global_descriptors.registry import ALL_GLOBAL_DESCRIPTORS


def completion_script(parser: argparse.ArgumentParser, shell: str) -> str:
    """A script of ``shell`` (bash, zsh or fish) that completes the commands of ``parser``, their options and values."""
    parsers = [parser]
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            parsers += action.choices.values()
    values = _option_values()
    for action in (action for one in parsers for action in one._actions):
        if action.dest in values:
            action.choices = values[action.dest]
        elif action.metavar in ("FOLDER", "SITE"):
            action.complete = shtab.DIRECTORY  # type: ignore[attr-defined]
        elif action.type is given_path or action.metavar == "FILE":
            action.complete = shtab.FILE  # type: ignore[attr-defined]
    return shtab.complete(parser, shell=shell)


def _option_values() -> dict[str, Sequence[str]]:
    """Option -> what it may be, of those that have a name of something; of a list of such, any one."""
    chosen = {f.name: f.metadata["choices"] for f in dataclasses.fields(Config) if f.metadata["choices"]}
    local = [descriptor.name for descriptor in ALL_DESCRIPTORS]
    return chosen | {
        "layout": [layout.name for layout in ALL_LAYOUTS],
        "gltf_values": ["all", *local],
        "features": [*local, *(descriptor.name for descriptor in ALL_GLOBAL_DESCRIPTORS)],
    }
