"""The command line: arguments in, messages and an exit code out."""

from __future__ import annotations

import argparse
import dataclasses
import importlib
import io
import logging
import math
import os
import sys
import time
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from tqdm import tqdm

from shapeviz_report import __version__
from shapeviz_report.building.progress import Progress, QuietProgress, TimeLeft, in_words
from shapeviz_report.cache import default_root
from shapeviz_report.config import ENVIRONMENT_PREFIX, FILE_NAME, MACHINE, PUBLICATION, Config, load_config
from shapeviz_report.ending import STOPPED, end_in_order, listen, listening
from shapeviz_report.errors import PluginError, ShapevizError
from shapeviz_report.imports import import_numba
from shapeviz_report.order import classes_of
from shapeviz_report.pruning import DAY, Entry, choose_unused, list_entries, remove
from shapeviz_report.types import Database, Failure, Report

if TYPE_CHECKING:
    from shapeviz_report.building.check import CheckResult
    from shapeviz_report.building.query import QueryResult

EXIT_CODES = """\
exit codes:
  0    done; files that had to be left out are listed on the About page
  1    nothing was built: the message says why
  2    the command line is wrong
  130  stopped by Ctrl-C (143: by a termination signal); the same command continues where it stopped
"""

LINES_EVERY = 30.0
"""Seconds between two lines of progress where there is no terminal."""

MOST_LISTED = 20
"""Shapes of a group that are named."""

QUERYING = ("time_limit", "memory_limit", "cache")
"""Options of a build that a query has as well."""

DESCRIBING = (
    "layout", "labeling", "preset", "external", "outside", "edge_length", "time_limit", "memory_limit", "jobs",
    "scheduler", "cache",
)  # fmt: skip
"""Options of a build that decide its features, and where they are computed."""

GROUPS = {
    "what is read": ("layout", "labeling", "external", "coordinates", "outside"),
    "features and maps": ("preset", "edge_length", "bins", "search", "neighbours", "seed"),
    "what the site holds": (
        "meshes",
        "gltf",
        "gltf_values",
        "parquet",
        "clay",
        "single_file",
        "up",
        "thumbnail_size",
        "renderer",
    ),
    "what the site says of the database": PUBLICATION,
    "this machine": ("jobs", "scheduler", "time_limit", "memory_limit", "cache"),
}
"""How options stand in the help."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    with listening():
        return _run(arguments)


def _run(arguments: Sequence[str] | None) -> int:
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # as `>&-` has it
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif isinstance(stream, io.TextIOWrapper):
            # names of a database may have letters that a terminal has not
            stream.reconfigure(errors="backslashreplace")
    try:
        options = _parser().parse_args(arguments)
        handler = logging.StreamHandler(_Patient(sys.stderr))
        handler.setFormatter(_LogFormatter("%(levelname)s: %(message)s"))
        # what Dask logs of a cluster that fails, as tracebacks, ends the build with a sentence of ours
        handler.addFilter(lambda record: record.name.partition(".")[0] != "distributed")
        logging.basicConfig(level=logging.WARNING, handlers=[handler])
        import_numba()
        return int(options.command(options))
    except ShapevizError as error:
        first, *rest = error.lines
        _complain(f"shapeviz-report: {first}", *rest)
        return 1
    except MemoryError:
        _complain(
            "shapeviz-report: the memory of this machine does not suffice. What was computed is kept: end other "
            "programs, or use fewer --jobs, and the same command continues."
        )
        return 1
    except KeyboardInterrupt:
        _complain("", STOPPED)
        return 130
    except _OutputError as error:
        # Whoever reads no further, as `head`, wants no words.
        if not isinstance(error.__cause__, BrokenPipeError):
            _complain(f"shapeviz-report: what there is to say cannot be written: {error}")
        return 1
    finally:
        # What follows is the end of Python, where nobody could say what went wrong.
        for stream in (sys.stdout, sys.stderr):
            try:
                stream.flush()
            except OSError:
                with suppress(OSError):
                    stream.close()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="shapeviz-report",
        description="Turn a folder of 3D meshes into a static web site that shows the whole shape database, and "
        "why its shapes group as they do. The site needs no server: it opens by double-click.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"shapeviz-report {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    build = commands.add_parser(
        "build",
        usage="shapeviz-report build [options] -o OUT DATABASE",
        help="build the site of a shape database",
        description="Build the site of a shape database. What was computed before and has not changed is reused.",
        epilog=f"Options may also stand in {FILE_NAME} in the database's folder, with _ for -, but for those of the\n"
        f"machine ({', '.join(MACHINE)}): they may stand in a file that --config names, or in\n"
        f"the environment, such as {ENVIRONMENT_PREFIX}CACHE. Flags win.\n\n" + EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_database(build)
    _add_destination(build)
    _add_options(build, [f.name for f in dataclasses.fields(Config)])
    _add_loudness(build)
    build.set_defaults(command=_build)

    demo = commands.add_parser(
        "demo",
        usage="shapeviz-report demo [options] -o OUT",
        help="build a site of shapes that are generated on the spot",
        description="Generate the demo database, which needs no download, and build its site.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_destination(demo)
    _add_options(
        demo,
        [
            "preset",
            "bins",
            "search",
            "meshes",
            "gltf",
            "gltf_values",
            "parquet",
            "single_file",
            "seed",
            "jobs",
            "scheduler",
            "cache",
        ],
    )
    _add_loudness(demo)
    demo.set_defaults(command=_demo)

    check = commands.add_parser(
        "check",
        usage="shapeviz-report check [options] DATABASE",
        help="say what of a database would be read, and what is wrong with it",
        description="Read a database and every mesh of it without building anything. The exit code is 1 if any "
        "file cannot be used.",
    )
    _add_database(check)
    told = check.add_mutually_exclusive_group()
    told.add_argument(
        "--list", action="store_true", help="print the id of every shape, in order, and no more"
    )
    told.add_argument("--json", action="store_true", help="print everything that was found as JSON")
    _add_options(
        check,
        [
            "layout",
            "labeling",
            "external",
            "coordinates",
            "bins",
            *PUBLICATION,
            "outside",
            "time_limit",
            "memory_limit",
            "jobs",
            "cache",
        ],
    )
    _add_loudness(check)
    check.set_defaults(command=_check)

    query = commands.add_parser(
        "query",
        usage="shapeviz-report query [options] SITE MESH",
        help="find the shapes of a site that are most similar to a mesh",
        description="Find the shapes of a built site that are most similar to a mesh, which need not be among them, "
        "and say which features make them alike.",
    )
    query.add_argument("site", metavar="SITE", type=Path, help="folder of a site that this version has built")
    query.add_argument("mesh", metavar="MESH", type=Path, help="a mesh file")
    compared = query.add_mutually_exclusive_group()
    compared.add_argument(
        "--features",
        metavar="A,B",
        type=lambda text: tuple(part.strip() for part in text.split(",")),
        help="what to compare, such as PFH,FPFH; by default what the maps of the site compare",
    )
    compared.add_argument(
        "--bins",
        metavar="FILE",
        type=Path,
        help="compare the bins that FILE names instead: one name a line, or what the Workbench saves",
    )
    query.add_argument(
        "-n", "--count", metavar="N", type=int, default=10, help="how many shapes to find (10)"
    )
    query.add_argument("--json", action="store_true", help="print everything that was found as JSON")
    _add_options(query, QUERYING)
    _add_loudness(query)
    query.set_defaults(command=_query)

    describe = commands.add_parser(
        "describe",
        usage="shapeviz-report describe [options] -o FILE DATABASE",
        help="write the features of a shape database to a file",
        description="Measure a shape database and write its features to one file, a row a shape, for other programs: "
        "no pictures, maps or site. What was computed before and has not changed is reused.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_database(describe)
    describe.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        type=Path,
        required=True,
        help="FILE.parquet (needs pyarrow), FILE.csv, or FILE.npz for numpy; an earlier one is replaced",
    )
    _add_options(describe, DESCRIBING)
    _add_loudness(describe)
    describe.set_defaults(command=_describe)

    plugins = commands.add_parser(
        "plugins",
        help="list the parts that other packages bring along",
        description="List the descriptors, scorers, projections and layouts that other packages bring along, with the "
        "packages and their versions. The exit code is 1 if one of them cannot be used.",
    )
    plugins.set_defaults(command=_plugins)

    completion = commands.add_parser(
        "completion",
        help="print what makes a shell complete commands, options and their values",
        description="Print a script that makes a shell complete commands, options, their values, files and folders,\n"
        "with the plug-ins that are installed now. It goes, for instance, into\n"
        "  bash  ~/.local/share/bash-completion/completions/shapeviz-report\n"
        "  zsh   a file _shapeviz-report in a folder of $fpath\n"
        "  fish  ~/.config/fish/completions/shapeviz-report.fish",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    completion.add_argument(
        "shell", metavar="SHELL", choices=("bash", "zsh", "fish"), help="bash, zsh or fish"
    )
    completion.set_defaults(command=_completion)

    cache = commands.add_parser(
        "cache",
        help="say what the cache holds, and remove what was not used for long",
        description="Say what the cache of results holds, by stage, and when it was last used. Nothing but this "
        "command removes anything from it: results of other versions, and of meshes and options that are no longer "
        "used, stay. What is removed and asked for again is computed again.",
    )
    cache.add_argument(
        "--unused", metavar="DAYS", type=_at_least_zero, help="remove what was not used for so many days"
    )
    cache.add_argument(
        "--keep",
        metavar="GB",
        type=_at_least_zero,
        help="remove what is longest unused until no more than so many gigabytes are left",
    )
    cache.add_argument("--dry-run", action="store_true", help="say what would be removed, and remove nothing")
    _add_options(cache, ["cache"])
    cache.set_defaults(command=_cache)
    return parser


def _at_least_zero(text: str) -> float:
    number = float(text)
    if not 0 <= number < float("inf"):
        raise ValueError
    return number


_at_least_zero.__name__ = "number"  # as argparse says what is wrong


def _add_database(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "database",
        metavar="DATABASE",
        type=Path,
        help="a folder of meshes, a CSV, JSON or Parquet table, or a .cla file",
    )


def _add_destination(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        type=Path,
        required=True,
        help="folder of the site, or its file with --single-file; an earlier site there is replaced when the new one "
        "is complete",
    )


def _add_options(parser: argparse.ArgumentParser, names: Sequence[str]) -> None:
    """A flag for each of these options, as :class:`Config` describes them, and one for a file of them."""
    fields = {option.name: option for option in dataclasses.fields(Config)}
    for title, own in GROUPS.items():
        chosen = [fields[name] for name in own if name in names]
        if not chosen:
            continue
        section = parser.add_argument_group(title)
        for option in chosen:
            kind = str(option.type)
            flag = "--" + option.name.replace("_", "-")
            if kind == "bool":
                section.add_argument(
                    flag, action=argparse.BooleanOptionalAction, help=option.metadata["help"]
                )
                continue
            section.add_argument(
                flag,
                metavar=option.metadata["metavar"],
                help=option.metadata["help"]
                + (f" ({option.default})" if type(option.default) in (int, float) else ""),
                type=int if kind.startswith("int") else float if kind.startswith("float") else str,
                action="append" if kind.startswith("tuple") else "store",
            )
    # after all others, which are of the machine
    section.add_argument(
        "--config",
        metavar="FILE",
        type=Path,
        help="options from a TOML file of your own, which may hold any of them",
    )


def _add_loudness(parser: argparse.ArgumentParser) -> None:
    loudness = parser.add_mutually_exclusive_group()
    loudness.add_argument("-q", "--quiet", action="store_true", help="say nothing but what goes wrong")
    loudness.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="say also which options hold, and how long everything took",
    )


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
                _complain(f"{option.name} = {value}")
        _complain(f"results are kept in {(config.cache or default_root()).absolute()}")
        if config.scheduler is None:
            _complain(f"computed by {_count(config.worker_count, 'process', 'processes')} of this machine")
    return TerminalProgress(verbose=options.verbose)


def _build(options: argparse.Namespace) -> int:
    from shapeviz_report.building.pipeline import build_report

    listen(end_in_order)
    config = load_config(options.database, _given(options), options.config)
    report = build_report(options.database, options.output, config, _progress(options, config))
    if not options.quiet:
        _print_summary(report, options.output)
    return 0


def _demo(options: argparse.Namespace) -> int:
    from shapeviz_report.building.demo import build_demo

    listen(end_in_order)
    config = load_config(None, _given(options), options.config)
    report = build_demo(options.output, config, _progress(options, config))
    if not options.quiet:
        _print_summary(report, options.output)
    return 0


def _check(options: argparse.Namespace) -> int:
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
        _say(*(shape.id for shape in database.shapes))
        return 0
    result = check_database(options.database, config, _progress(options, config))
    if options.json:
        _say(*json_text(_checked(result), indent=1).splitlines())
    elif not options.quiet:
        _print_check(result)
    return 1 if result.failures else 0


def _checked(result: CheckResult) -> dict[str, object]:
    """What a check found, for programs."""
    from shapeviz_report.building.runner import name_files

    database = result.database
    files = name_files(database)
    return {
        "database": database.name,
        "root": str(database.root),
        "layout": database.layout,
        "labelings": {
            labeling: Counter(s.labels[labeling] for s in database.shapes if labeling in s.labels)
            for labeling in database.labelings
        },
        "shapes": [
            {
                "id": shape.id,
                "name": shape.name,
                "file": files[shape.id],
                "labels": shape.labels,
                "metadata": shape.metadata,
                "usable": shape.id in result.repairs,
                "repairs": result.repairs.get(shape.id, {}),
                "lost_colours": list(result.lost.get(shape.id, ())),
            }
            for shape in database.shapes
        ],
        "failures": [{"file": failure.path, "reason": failure.reason} for failure in result.failures],
        "copies": [
            {
                "shapes": list(group.shapes),
                "match": group.words,
                "pairs": [
                    {"first": copy.first, "second": copy.second, "match": copy.match.words}
                    for copy in group.copies
                ],
            }
            for group in result.copies
        ],
        "warnings": list(database.warnings),
    }


def _print_check(result: CheckResult) -> None:
    usable = tuple(shape for shape in result.database.shapes if shape.id in result.repairs)
    _print_database(dataclasses.replace(result.database, shapes=usable))
    mended = Counter(what for repairs in result.repairs.values() for what in repairs)
    if mended:
        _say("", "Would be repaired, in so many files:")
        for what, count in sorted(mended.items(), key=lambda item: (-item[1], item[0])):
            _say(f"  {count:6,}  {what}")
    if result.lost:
        _say("", f"Colours are left out of {_count(len(result.lost), 'shape', 'shapes')}:")
        losing: dict[str, list[str]] = {}
        for shape, lost in result.lost.items():
            for what in lost:
                losing.setdefault(what, []).append(shape)
        _say(*(f"  {_listed(shapes)}: {what}" for what, shapes in losing.items()))
    if result.copies:
        copies = sum(len(group.shapes) - 1 for group in result.copies)
        groups = _count(len(result.copies), "group", "groups")
        _say("", f"The same shape again: {_count(copies, 'copy', 'copies')}, in {groups}")
        for group in result.copies:
            _say(f"  {_listed(group.shapes)}: {group.words}")
    _print_failures(result.failures)
    if not result.failures:
        _say("", "All files can be used.")


def _describe(options: argparse.Namespace) -> int:
    from shapeviz_report.building.describing import describe_database
    from shapeviz_report.writing.feature_files import check_feature_file, write_feature_file

    listen(end_in_order)
    config = load_config(options.database, _given(options), options.config)
    check_feature_file(options.output, options.database)
    found = describe_database(options.database, config, _progress(options, config))
    write_feature_file(options.output, found.database, found.shapes, found.features, found.edges)
    if not options.quiet:
        _print_failures(found.failures)
        shapes = _count(len(found.shapes), "shape", "shapes")
        columns = _count(len(found.features.columns), "feature value", "feature values")
        _say("", f"{options.output}: {shapes}, {columns} each")
    return 0


def _query(options: argparse.Namespace) -> int:
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
        _say(*json_text(dataclasses.asdict(result), indent=1).splitlines())
    else:
        _print_found(result, options.mesh)
    return 0


def _print_found(result: QueryResult, mesh: Path) -> None:
    """A table of the shapes found: place, distance, class, the reasons feature by feature, and the shape's id."""
    if result.bins is not None:
        what = result.bins[0] if len(result.bins) == 1 else f"{len(result.bins)} bins"
    else:
        what = ", ".join(result.features or ())
    among = f"{_count(result.shapes, 'shape', 'shapes')} of {result.database}"
    _say(f"{mesh}: the most similar of {among}, by {what}.")
    if result.left_out:
        _say(f"Left out, for a mesh alone has no value for it: {', '.join(result.left_out)}.")
    _say(
        f"Two shapes of the database are typically {result.typical:.3f} apart. Below a feature: how many percent of",
        "the database are farther from the mesh than this shape, by that feature alone.",
        "",
    )
    features = list(result.found[0].closer)
    labels = [found.label or "" for found in result.found]
    width = max(len("class"), *map(len, labels)) if any(labels) else 0
    heading = f"{'class':{width}}  " if width else ""
    _say(f"{'':4}  distance  {heading}{'  '.join(f'{name:>4}' for name in features)}  shape")
    for place, (found, label) in enumerate(zip(result.found, labels), start=1):
        shares = "  ".join(f"{100 * found.closer[name]:{max(4, len(name))}.0f}" for name in features)
        said = f"{label:{width}}  " if width else ""
        _say(f"{place:4}  {found.distance:8.3f}  {said}{shares}  {found.id}")


def _plugins(options: argparse.Namespace) -> int:
    from shapeviz_report.plugins import GROUPS, find_plugins

    found = find_plugins()
    if not found:
        _say("No package that is installed here brings anything along.")
    rows = [
        (GROUPS[plugin.group][0], plugin.name, f"{plugin.package} {plugin.version}", plugin.entry.value)
        for plugin in found
    ]
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        _say("  ".join(f"{cell:{width}}" for cell, width in zip(row, widths)).rstrip())
    try:
        for _, module in GROUPS.values():
            importlib.import_module(module)
        from shapeviz_report.wording.registry import all_global_wordings, all_wordings

        all_wordings(), all_global_wordings()
    except PluginError as error:
        _complain("", *error.lines)
        return 1
    return 0


def _completion(options: argparse.Namespace) -> int:
    import shtab

    parser = _parser()
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
        elif action.type is Path or action.metavar == "FILE":
            action.complete = shtab.FILE  # type: ignore[attr-defined]
    _say(*shtab.complete(parser, shell=options.shell).splitlines())
    return 0


def _option_values() -> dict[str, Sequence[str]]:
    """Option -> what it may be, of those that have a name of something; of a list of such, any one."""
    from shapeviz_report.database.registry import ALL_LAYOUTS
    from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
    from shapeviz_report.global_descriptors.registry import ALL_GLOBAL_DESCRIPTORS

    chosen = {f.name: f.metadata["choices"] for f in dataclasses.fields(Config) if f.metadata["choices"]}
    local = [descriptor.name for descriptor in ALL_DESCRIPTORS]
    return chosen | {
        "layout": [layout.name for layout in ALL_LAYOUTS],
        "gltf_values": ["all", *local],
        "features": [*local, *(descriptor.name for descriptor in ALL_GLOBAL_DESCRIPTORS)],
    }


def _cache(options: argparse.Namespace) -> int:
    config = load_config(None, _given(options), options.config)
    root = (config.cache or default_root()).absolute()
    now = time.time()
    entries = sorted(list_entries(root))
    size = sum(entry.size for entry in entries)
    _say(f"The cache {root} holds {_count(len(entries), 'result', 'results')}, {_bytes(size)}.")
    if options.unused is None and options.keep is None:
        _print_entries(entries, now)
        return 0
    most = None if options.keep is None else int(options.keep * 1e9)
    chosen = choose_unused(entries, now, days=options.unused, most=most)
    if options.dry_run:
        count, freed, done = len(chosen), sum(entry.size for entry in chosen), "would be"
    else:
        (count, freed), done = remove(chosen), "were" if len(chosen) != 1 else "was"
    _say(
        f"{_count(count, 'result', 'results')}, {_bytes(freed)}, {done} removed; {_bytes(size - freed)} stay."
    )
    if not options.dry_run and count < len(chosen):
        _complain(f"{_count(len(chosen) - count, 'file', 'files')} could not be removed, or are no results.")
    return 0


def _print_entries(entries: Sequence[Entry], now: float) -> None:
    """A line for every stage, and how much was not used for how long."""
    if not entries:
        return
    _say("", f"  {'':<20}{'results':>10}  {'size':>9}  last used")
    for stage in sorted({entry.stage for entry in entries}):
        own = [entry for entry in entries if entry.stage == stage]
        used = [_ago(now - entry.used) for entry in (own[-1], own[0])]
        span = used[0] if used[0] == used[1] else " to ".join(used)
        _say(f"  {stage:<20}{len(own):>10,}  {_bytes(sum(entry.size for entry in own)):>9}  {span}")
    _say("")
    for days in (30, 90):
        old = [entry for entry in entries if now - entry.used > days * DAY]
        if old:
            _say(
                f"Not used for {days} days: {_count(len(old), 'result', 'results')}, "
                f"{_bytes(sum(entry.size for entry in old))}; --unused {days} removes them."
            )


def _bytes(size: float) -> str:
    if size < 1000:
        return f"{size:.0f} bytes"
    power = min(int(math.log10(size)) // 3, 3)
    number = size / 1000**power
    return f"{number:.{0 if number >= 100 else 1}f} {('kB', 'MB', 'GB')[power - 1]}"


def _ago(seconds: float) -> str:
    days = int(max(seconds, 0) // DAY)
    return ("today", "yesterday")[days] if days < 2 else f"{days:,} days ago"


def _print_database(database: Database) -> None:
    shapes = _count(len(database.shapes), "shape", "shapes")
    _say(f"{database.name}: {shapes}, read as {database.layout} from {database.root}")

    for labeling in database.labelings:
        sizes = Counter(s.labels[labeling] for s in database.shapes if labeling in s.labels)
        missing = len(database.shapes) - sum(sizes.values())
        without = f", {_count(missing, 'shape', 'shapes')} without" if missing else ""
        _say("", f"Labeling {labeling!r}: {_count(len(sizes), 'class', 'classes')}{without}")
        for label in classes_of(sizes):
            _say(f"  {sizes[label]:6,}  {label}")
    if not database.labelings:
        _say("", "No labels: clusters of the features stand in for classes, if the shapes fall into any.")
    for warning in database.warnings:
        _say("", f"Note: {warning}")


def _print_failures(failures: Sequence[Failure]) -> None:
    if not failures:
        return
    _say("", f"Cannot be used: {_count(len(failures), 'file', 'files')}")
    for failure in failures:
        _say(f"  {failure.path}: {failure.reason}")


def _print_summary(report: Report, destination: Path) -> None:
    classes = len(classes_of(report.labels))
    rows = [
        ("shapes", f"{len(report.shapes):,}"),
        ("classes", f"{classes:,}" if classes else "none: no labels"),
        ("failures", f"{len(report.failures):,}"),
    ]
    for name, (_, quality) in report.projections.items():
        if quality.nh_s is not None and quality.null_mean is not None:
            beside = f"random labels: {quality.null_mean:.3f}"
            if quality.range.highest is not None and quality.range.highest < 1:
                beside += f", at most {quality.range.highest:.3f}"
            without = report.without_copies
            if without is not None and (distinct := without.nh_s[name]) is not None:
                beside += f", without {_count(without.copies, 'copy', 'copies')}: {distinct:.3f}"
            rows.append((f"NH_s {name}", f"{quality.nh_s:.3f}  ({beside})"))
    total, total_cpu = sum(report.seconds.values()), sum(report.cpu_seconds.values())
    stages = "  ".join(f"{name} {seconds:.1f}" for name, seconds in report.seconds.items())
    rows.append(("seconds", f"{total:.1f}  ({stages})"))
    rows.append(("CPU seconds", f"{total_cpu:.1f}"))
    _say("")
    for name, value in rows:
        _say(f"{name:>12}  {value}")
    _print_failures(report.failures[:10])
    if len(report.failures) > 10:
        _say(f"  ... and {len(report.failures) - 10} more: see the About page")
    for warning in report.database.warnings:
        _say("", f"Note: {warning}")
    page = destination if destination.is_file() else destination / "index.html"
    _say("", f"The site is ready. Open {page.absolute()}")


def _listed(names: Sequence[str]) -> str:
    """Some names, and how many more there are."""
    more = len(names) - MOST_LISTED
    return ", ".join(names[:MOST_LISTED]) + (f" and {more:,} more" if more > 0 else "")


def _count(number: int, one: str, many: str) -> str:
    return f"{number:,} {one if number == 1 else many}"


class _OutputError(Exception):
    """Standard output takes no more, and why."""


def _say(*lines: str, file: TextIO | None = None) -> None:
    """Print each text as one line: all that the command tells goes this way, for it may hold names of strangers."""
    file = file or sys.stdout
    encoding = file.encoding or "utf-8"
    try:
        for line in lines:
            print(_one_line(line).encode(encoding, "replace").decode(encoding), file=file)
        file.flush()
    except OSError as error:
        raise _OutputError(error.strerror) from error


def _complain(*lines: str) -> None:
    """Say something on standard error, if it takes it."""
    with suppress(_OutputError):
        _say(*lines, file=sys.stderr)


def _one_line(text: str) -> str:
    """Text of a database as the terminal may show it: no line breaks, no control characters, none that turn the
    direction of writing, and no bytes that are no text. Spaces of other kinds, as our own texts have, are spaces.
    """
    return "".join(c if c.isprintable() else " " if unicodedata.category(c) == "Zs" else "?" for c in text)


class _LogFormatter(logging.Formatter):
    """Log records as :func:`_say` prints: the message as one line, a traceback line by line."""

    def formatMessage(self, record: logging.LogRecord) -> str:
        return _one_line(super().formatMessage(record))

    def formatException(self, ei: Any) -> str:
        return "\n".join(map(_one_line, super().formatException(ei).splitlines()))


class _Patient:
    """A stream for what may get lost: that its disk is full, or its reader gone, stops nobody's work."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> None:
        with suppress(OSError):
            self._stream.write(text)

    def flush(self) -> None:
        with suppress(OSError):
            self._stream.flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


class TerminalProgress:
    """A bar with the time left on a terminal; on anything else a line every half a minute.

    Parameters
    ----------
    verbose : bool
        Whether it is told how long every stage took.
    """

    def __init__(self, *, verbose: bool = False) -> None:
        self._verbose = verbose

    @contextmanager
    def stage(self, doing: str, total: int) -> Iterator[Callable[[], None]]:
        """See :class:`shapeviz_report.building.progress.Progress`."""
        begun = time.monotonic()
        with self._told(doing, total) as advance:
            yield advance
        if self._verbose:
            _complain(f"{doing}: {time.monotonic() - begun:.1f} s")

    @contextmanager
    def _told(self, doing: str, total: int) -> Iterator[Callable[[], None]]:
        if total == 0:
            _complain(doing)
            yield lambda: None
            return
        left = TimeLeft(total)
        with (
            self._bar(doing, total, left) if sys.stderr.isatty() else self._lines(doing, total, left) as tell
        ):

            def advance() -> None:
                left.step(time.monotonic())
                tell()

            yield advance

    @contextmanager
    def _bar(self, doing: str, total: int, left: TimeLeft) -> Iterator[Callable[[], None]]:
        with tqdm(
            total=total,
            desc=f"{doing:<22}",
            bar_format="{desc} {bar:24} {n_fmt:>6} of {total_fmt}  {elapsed} gone{postfix}",
            mininterval=0.2,
            file=_Patient(sys.stderr),
            dynamic_ncols=True,
        ) as bar:

            def tell() -> None:
                seconds = left.estimate(time.monotonic())
                bar.set_postfix_str("" if not seconds else f"about {in_words(seconds)} left", refresh=False)
                bar.update()

            yield tell

    @contextmanager
    def _lines(self, doing: str, total: int, left: TimeLeft) -> Iterator[Callable[[], None]]:
        begun = told = time.monotonic()
        done = 0
        _complain(f"{doing}: {total:,}")

        def tell() -> None:
            nonlocal told, done
            done += 1
            now = time.monotonic()
            if now - told < LINES_EVERY or done == total:
                return
            told, seconds = now, left.estimate(now)
            rest = "" if not seconds else f", about {in_words(seconds)} left"
            _complain(f"{doing}: {done:,} of {total:,}, {in_words(now - begun)} gone{rest}")

        yield tell


if __name__ == "__main__":
    sys.exit(main())
