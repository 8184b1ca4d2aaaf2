"""The arguments of each command, and their help."""

from __future__ import annotations

import argparse
import dataclasses
import re
import textwrap
from collections.abc import Sequence
from pathlib import Path

from shapeviz_report import __version__
from shapeviz_report.config import ENVIRONMENT_PREFIX, FILE_NAME, MACHINE, PUBLICATION, Config

EXIT_CODES = """\
exit codes:
  0    done; files that had to be left out are listed on the About page
  1    nothing was built: the message says why
  2    the command line is wrong
  130  stopped by Ctrl-C (143: by a termination signal); the same command continues where it stopped
"""

_ROW_HEAD = re.compile(r" +\S+  +")
"""How a row of a table begins in the text of a help."""

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


class Help(argparse.HelpFormatter):
    """Paragraphs and rows of a table stay apart, and each goes on below its own text where a line is full."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        lines = []
        for line in text.splitlines():
            head = _ROW_HEAD.match(line)
            below = " " * (head.end() if head else 0)
            wrapped = textwrap.wrap(
                line, width, subsequent_indent=below, break_long_words=False, break_on_hyphens=False
            )
            lines += wrapped or [""]
        return "\n".join(lines)


def command_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="shapeviz-report",
        description="Turn a folder of 3D meshes into a static web site that shows the whole shape database, and "
        "why its shapes group as they do. The site needs no server: it opens by double-click.",
        epilog=EXIT_CODES,
        formatter_class=Help,
    )
    parser.add_argument("--version", action="version", version=f"shapeviz-report {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    build = commands.add_parser(
        "build",
        usage="shapeviz-report build [options] -o OUT DATABASE",
        help="build the site of a shape database",
        description="Build the site of a shape database. What was computed before and has not changed is reused.",
        epilog=f"Options may also stand in {FILE_NAME} in the database's folder, with _ for -, but for those of the "
        f"machine ({', '.join(MACHINE)}): they may stand in a file that --config names, or in "
        f"the environment, such as {ENVIRONMENT_PREFIX}CACHE. Flags win.\n\n" + EXIT_CODES,
        formatter_class=Help,
    )
    _add_database(build)
    _add_destination(build)
    _add_options(build, [f.name for f in dataclasses.fields(Config)])
    _add_loudness(build)

    demo = commands.add_parser(
        "demo",
        usage="shapeviz-report demo [options] -o OUT",
        help="build a site of shapes that are generated on the spot",
        description="Generate the demo database, which needs no download, and build its site.",
        epilog=EXIT_CODES,
        formatter_class=Help,
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
        "--list", action="store_true", help="print the id of every shape, in order, one a line, and no more"
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

    query = commands.add_parser(
        "query",
        usage="shapeviz-report query [options] SITE MESH",
        help="find the shapes of a site that are most similar to a mesh",
        description="Find the shapes of a built site that are most similar to a mesh, which need not be among them, "
        "and say which features make them alike.",
    )
    query.add_argument(
        "site", metavar="SITE", type=given_path, help="folder of a site that this version has built"
    )
    query.add_argument("mesh", metavar="MESH", type=given_path, help="a mesh file")
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
        type=given_path,
        help="compare the bins that FILE names instead: one name a line, or what the Workbench saves",
    )
    query.add_argument(
        "-n", "--count", metavar="N", type=int, default=10, help="how many shapes to find (10)"
    )
    query.add_argument("--json", action="store_true", help="print everything that was found as JSON")
    _add_options(query, QUERYING)
    _add_loudness(query)

    describe = commands.add_parser(
        "describe",
        usage="shapeviz-report describe [options] -o FILE DATABASE",
        help="write the features of a shape database to a file",
        description="Measure a shape database and write its features to one file, a row a shape, for other programs: "
        "no pictures, maps or site. What was computed before and has not changed is reused.",
        epilog=EXIT_CODES,
        formatter_class=Help,
    )
    _add_database(describe)
    describe.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        type=given_path,
        required=True,
        help="FILE.parquet (needs pyarrow), FILE.csv, or FILE.npz for numpy; an earlier one is replaced",
    )
    _add_options(describe, DESCRIBING)
    _add_loudness(describe)

    commands.add_parser(
        "plugins",
        help="list the parts that other packages bring along",
        description="List the descriptors, scorers, projections and layouts that other packages bring along, with the "
        "packages and their versions. The exit code is 1 if one of them cannot be used.",
    )

    completion = commands.add_parser(
        "completion",
        help="print what makes a shell complete commands, options and their values",
        description="Print a script that makes a shell complete commands, options, their values, files and folders, "
        "with the plug-ins that are installed now. It goes, for instance, into\n"
        "  bash  ~/.local/share/bash-completion/completions/shapeviz-report\n"
        "  zsh   a file _shapeviz-report in a folder of $fpath\n"
        "  fish  ~/.config/fish/completions/shapeviz-report.fish",
        formatter_class=Help,
    )
    completion.add_argument(
        "shell", metavar="SHELL", choices=("bash", "zsh", "fish"), help="bash, zsh or fish"
    )

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
    return parser


def _at_least_zero(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = -1
    if not 0 <= number < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is no number from 0 on")
    return number


def given_path(text: str) -> Path:
    """A path that is not empty, as a variable without a value makes it: the current folder was not asked for."""
    if not text:
        raise argparse.ArgumentTypeError("it is empty; give a path ('.' for the current folder)")
    return Path(text)


def _add_database(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "database",
        metavar="DATABASE",
        type=given_path,
        help="a folder of meshes, a CSV, JSON or Parquet table, or a .cla file",
    )


def _add_destination(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        type=given_path,
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
        type=given_path,
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
