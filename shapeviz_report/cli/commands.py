"""What each command does with its arguments: a function a command, which returns the exit code."""

from __future__ import annotations

import argparse
import dataclasses
import importlib
import logging
import time
from collections.abc import Callable
from typing import Any

from shapeviz_report.building.progress import Progress, QuietProgress
from shapeviz_report.cache import default_root
from shapeviz_report.cli.arguments import QUERYING, command_parser
from shapeviz_report.cli.results import (
    checked_record,
    counted,
    in_bytes,
    print_check,
    print_entries,
    print_failures,
    print_found,
    print_summary,
)
from shapeviz_report.cli.terminal import TerminalProgress, complain, hand_over, say
from shapeviz_report.config import Config, load_config
from shapeviz_report.ending import end_in_order, listen
from shapeviz_report.errors import PluginError
from shapeviz_report.pruning import choose_unused, list_entries, remove


def build(options: argparse.Namespace) -> int:
    from shapeviz_report.building.pipeline import build_report

    listen(end_in_order)
    config = load_config(options.database, _given(options), options.config)
    report = build_report(options.database, options.output, config, _progress(options, config))
    if not options.quiet:
        print_summary(report, options.output)
    else:
        print_failures(report.failures, most=10)
    return 0


def demo(options: argparse.Namespace) -> int:
    from shapeviz_report.building.demo import build_demo

    listen(end_in_order)
    config = load_config(None, _given(options), options.config)
    report = build_demo(options.output, config, _progress(options, config))
    if not options.quiet:
        print_summary(report, options.output)
    return 0


def check(options: argparse.Namespace) -> int:
    from shapeviz_report.building.check import check_database
    from shapeviz_report.database import read_database
    from shapeviz_report.writing.data import json_text

    listen(end_in_order)
    config = load_config(options.database, _given(options), options.config)
    if options.list:
        database = read_database(
            options.database,
            layout=config.layout,
            labeling=config.labeling,
            outside=config.outside,
            besides=(*config.external, *config.coordinates),
        )
        hand_over([shape.id for shape in database.shapes])
        return 0
    result = check_database(options.database, config, _progress(options, config))
    if options.json:
        say(*json_text(checked_record(result), indent=1).splitlines())
    elif not options.quiet:
        print_check(result)
    else:
        print_failures(result.failures)
    return 1 if result.failures else 0


def describe(options: argparse.Namespace) -> int:
    from shapeviz_report.building.describing import describe_database
    from shapeviz_report.writing.feature_files import check_feature_file, write_feature_file

    listen(end_in_order)
    config = load_config(options.database, _given(options), options.config)
    check_feature_file(options.output)
    found = describe_database(options.database, config, _progress(options, config))
    write_feature_file(options.output, found.database, found.shapes, found.features, found.edges)
    print_failures(found.failures)
    if not options.quiet:
        shapes = counted(len(found.shapes), "shape", "shapes")
        columns = counted(len(found.features.columns), "feature value", "feature values")
        say("", f"{options.output}: {shapes}, {columns} each")
    return 0


def query(options: argparse.Namespace) -> int:
    from shapeviz_report.building.query import find_similar
    from shapeviz_report.writing.data import json_text

    listen(end_in_order)
    config = load_config(None, {name: getattr(options, name) for name in QUERYING}, options.config)
    result = find_similar(
        options.site,
        options.mesh,
        features=options.features,
        bins=options.bins,
        count=options.count,
        cache=(config.cache or default_root()).absolute(),
        time_limit=config.time_limit,
        memory_limit=config.memory_bytes,
        progress=_progress(options, config),
    )
    if options.json:
        say(*json_text(dataclasses.asdict(result), indent=1).splitlines())
    else:
        print_found(result, options.mesh)
    return 0


def plugins(options: argparse.Namespace) -> int:
    from shapeviz_report.plugins import GROUPS, find_plugins

    found = find_plugins()
    if not found:
        say("No package that is installed here brings anything along.")
    rows = [
        (GROUPS[plugin.group][0], plugin.name, f"{plugin.package} {plugin.version}", plugin.entry.value)
        for plugin in found
    ]
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        say("  ".join(f"{cell:{width}}" for cell, width in zip(row, widths)).rstrip())
    try:
        for _, module in GROUPS.values():
            importlib.import_module(module)
        from shapeviz_report.wording.registry import all_global_wordings, all_wordings

        all_wordings(), all_global_wordings()
    except PluginError as error:
        complain("", *error.lines)
        return 1
    return 0


def completion(options: argparse.Namespace) -> int:
    from shapeviz_report.cli.completion import completion_script

    say(*completion_script(command_parser(), options.shell).splitlines())
    return 0


def cache(options: argparse.Namespace) -> int:
    config = load_config(None, _given(options), options.config)
    root = (config.cache or default_root()).absolute()
    now = time.time()
    entries = sorted(list_entries(root))
    size = sum(entry.size for entry in entries)
    say(f"The cache {root} holds {counted(len(entries), 'result', 'results')}, {in_bytes(size)}.")
    if options.unused is None and options.keep is None:
        print_entries(entries, now)
        return 0
    most = None if options.keep is None else int(options.keep * 1e9)
    chosen = choose_unused(entries, now, days=options.unused, most=most)
    if options.dry_run:
        count, freed, done = len(chosen), sum(entry.size for entry in chosen), "would be"
    else:
        (count, freed), done = remove(chosen), "were" if len(chosen) != 1 else "was"
    say(
        f"{counted(count, 'result', 'results')}, {in_bytes(freed)}, {done} removed; {in_bytes(size - freed)} stay."
    )
    if not options.dry_run and count < len(chosen):
        complain(f"{counted(len(chosen) - count, 'file', 'files')} could not be removed, or are no results.")
    return 0


def _given(options: argparse.Namespace) -> dict[str, Any]:
    """The options that were given as flags."""
    return {f.name: getattr(options, f.name, None) for f in dataclasses.fields(Config)}


def _progress(options: argparse.Namespace, config: Config) -> Progress:
    """How far a command is told to be; with ``--verbose`` after the options that hold."""
    if options.quiet:
        return QuietProgress()
    if options.verbose:
        logging.getLogger("shapeviz_report").setLevel(logging.DEBUG)
        for option in dataclasses.fields(Config):
            value = getattr(config, option.name)
            if value != option.default:
                complain(f"{option.name} = {value}")
        complain(f"results are kept in {(config.cache or default_root()).absolute()}")
        if config.scheduler is None:
            complain(f"computed by {counted(config.worker_count, 'process', 'processes')} of this machine")
    return TerminalProgress(verbose=options.verbose)


COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "build": build,
    "demo": demo,
    "check": check,
    "query": query,
    "describe": describe,
    "plugins": plugins,
    "completion": completion,
    "cache": cache,
}
"""The command of every name."""
