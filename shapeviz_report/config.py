"""Every option of a build, in one place.

Later ones win: defaults, the ``shapeviz.toml`` of the database, a file that the user names, the environment, flags or
arguments. The first of the files is a stranger's, as the meshes are: it says what the database is, and nothing of the
machine that builds it.
"""

from __future__ import annotations

import dataclasses
import datetime
import difflib
import os
import reprlib
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from numbers import Integral, Real
from pathlib import Path
from typing import Any

from shapeviz_report.arrow import require_pyarrow
from shapeviz_report.errors import ConfigError
from shapeviz_report.files import read_regular
from shapeviz_report.places import refuse_no_path
from shapeviz_report.system import core_count

FILE_NAME = "shapeviz.toml"
"""The options' file; it lies in the database's folder."""

MOST_BYTES = 16 * 1024
"""Size of the largest file of options. Reading a key of n parts takes a time that grows with the cube of n."""

MOST_LETTERS = 5_000
"""Letters of a text, which may stand on every page."""

PRESETS = ("default", "local", "paper")
PUBLICATION = (
    "title", "description", "introduction", "creator", "licence", "citation", "date", "url", "logo", "accent",
)  # fmt: skip
"""Options that say how the site presents itself; no figure depends on them."""
SEARCHES = ("tsne", "umap", "none")
RENDERERS = ("osmesa", "zbuffer")
GLTF = ("decimated", "prepared")
UP_AXES = ("y", "z")
ENVIRONMENT_PREFIX = "SHAPEVIZ_"


def _option(
    default: Any,
    text: str,
    metavar: str | None = None,
    choices: Sequence[str] = (),
    *,
    of_machine: bool = False,
) -> Any:
    """An option; with choices, it has one of them, or its default."""
    told = {"help": text, "metavar": metavar, "choices": tuple(choices), "of_machine": of_machine}
    return field(default=default, metadata=told)


_machine_option = partial(_option, of_machine=True)
"""An option that reaches out of the database: what is written where, what is connected to, what may be used up."""


@dataclass(frozen=True)
class Config:
    """The options of a build. Each is a key of ``shapeviz.toml``, a flag, and an argument of ``build``.

    Raises
    ------
    ConfigError
        A value is out of its range.
    """

    title: str | None = _option(None, "title of the site; by default the name of the database", "TEXT")
    description: str | None = _option(
        None, "a sentence or two on the database, for search engines and previews of links", "TEXT"
    )
    introduction: Path | None = _option(None, "what readers should know first, from a Markdown FILE", "FILE")
    creator: str | None = _option(None, "who made the database", "NAME")
    licence: str | None = _option(
        None,
        "what readers may do with the shapes: an SPDX identifier such as CC-BY-4.0, an address, or words",
        "TEXT",
    )
    citation: str | None = _option(None, "how to cite the database: a reference, or a BibTeX entry", "TEXT")
    date: str | None = _option(
        None, "day of publication, such as 2026-11-30; with a licence, it makes the site an RO-Crate", "DAY"
    )
    url: str | None = _option(
        None,
        "where the site will be, such as https://example.org/shapes/; previews of links need it",
        "ADDRESS",
    )
    logo: Path | None = _option(None, "a picture beside the title: SVG, PNG or WebP", "FILE")
    accent: str | None = _option(
        None,
        "colour of links and marks, such as #1f5f99; darker or lighter where it could not be read",
        "COLOUR",
    )
    layout: str | None = _option(
        None, "how the database is laid out; recognised by itself by default", "NAME"
    )
    labeling: str | None = _option(
        None, "which of several labelings to analyse; by default the first", "NAME"
    )
    preset: str = _option(
        "default",
        "which features there are, and how they are compared: 'default', 'local' for the paper's eight alone, or "
        "'paper' for the reading closest to the publication",
        "NAME",
        PRESETS,
    )
    external: tuple[Path, ...] = _option(
        (),
        "further features: FILE.npy with one row a shape in the order of `check --list`, or FILE.npz, FILE.csv or "
        "FILE.parquet with the ids that it prints; may be repeated",
        "FILE",
    )
    coordinates: tuple[Path, ...] = _option(
        (),
        "a map of your own beside the others, called as its file: FILE.csv, FILE.parquet with columns id, x and y, or "
        "FILE.npz, FILE.npy with two values a shape as for --external; may be repeated",
        "FILE",
    )
    bins: Path | None = _option(
        None,
        "make the maps from the bins that FILE names and no others: one name a line, or what the Workbench saves",
        "FILE",
    )
    neighbours: int = _option(10, "k of the neighbourhood hit", "K")
    search: str = _option(
        SEARCHES[0],
        f"method of the maps among which the best features are searched: "
        f"{', '.join(map(repr, SEARCHES[:-1]))}, or {SEARCHES[-1]!r} for no search",
        "METHOD",
        SEARCHES,
    )
    meshes: bool = _option(
        True,
        "whether the site holds a 3D model of every shape, to be turned in the browser: some 60 kB a shape; by default "
        "it does",
    )
    clay: bool = _option(
        False, "draw all shapes in one clay, also those whose files have colours or textures"
    )
    single_file: bool = _machine_option(
        False,
        "write one HTML file, to be mailed, instead of a folder: OUT is its name; it holds no 3D models and no glTF",
    )
    outside: bool = _machine_option(
        False,
        "also read meshes outside the database's folder, where links in it or rows of its table lead to some",
    )
    gltf: str | None = _option(
        None,
        "also write every shape as binary glTF, for download: 'decimated', as its page shows it, some 50 kB, or "
        "'prepared', the whole surface that was measured, some 200 kB",
        "KIND",
        GLTF,
    )
    gltf_values: str | None = _option(
        None,
        "values at every vertex that go along with --gltf, as attributes: names of descriptors, such as 'Agd,Gc', or "
        "'all'",
        "NAMES",
    )
    parquet: bool = _option(
        False,
        "also write the tables of shapes and of features as Parquet; needs the extra 'parquet'",
    )
    edge_length: float = _option(
        0.01, "edge length after remeshing, as a fraction of the shape's size", "FRACTION"
    )
    up: str | None = _option(
        None,
        "axis of the files that points up in pictures, 'y' or 'z'; by default what the file says, else guessed",
        "AXIS",
        UP_AXES,
    )
    renderer: str | None = _machine_option(
        None,
        "what draws pictures: osmesa, a library of the system, or zbuffer, which needs none; by default osmesa where "
        "it is",
        "NAME",
        RENDERERS,
    )
    thumbnail_size: int | None = _option(
        None,
        "width and height of a thumbnail in pixels; by default 320, of more than 10,000 shapes 192",
        "PIXELS",
    )
    seed: int = _option(0, "seed of everything random", "N")
    time_limit: float = _machine_option(
        300.0,
        "seconds that one mesh may take; a question of the whole database may take twenty times as long",
        "SECONDS",
    )
    memory_limit: float | None = _machine_option(
        None,
        "GiB of memory that one worker process may take; by default its share of most of what is free",
        "GIB",
    )
    jobs: int | None = _machine_option(None, "number of worker processes; by default one a core", "N")
    scheduler: str | None = _machine_option(
        None,
        "compute on a running Dask cluster, by the address of its scheduler such as tcp://host:8786, instead of in "
        "worker processes of this machine",
        "ADDRESS",
    )
    cache: Path | None = _machine_option(None, "where results are kept between builds", "FOLDER")

    def __post_init__(self) -> None:
        for option in dataclasses.fields(self):
            if fault := _out_of_range(option.name, getattr(self, option.name)):
                raise ConfigError(fault)
        if self.gltf_values is not None and self.gltf is None:
            raise ConfigError(f"gltf_values go along with gltf, which is not set: one of {', '.join(GLTF)}")
        if self.parquet:
            require_pyarrow("parquet = true", "or leave the option out: --no-parquet")
        if self.scheduler is not None and self.jobs is not None:
            raise ConfigError(
                "jobs is the number of processes on this machine; with a scheduler there are none"
            )

    @property
    def worker_count(self) -> int:
        """Number of worker processes: as asked for, or as many as this process may use cores."""
        if self.jobs is not None:
            return self.jobs
        return core_count()

    @property
    def memory_bytes(self) -> int | None:
        """Bytes of memory that one worker process may take; None where the machine decides."""
        return None if self.memory_limit is None else int(self.memory_limit * 2**30)

    def as_parameters(self) -> dict[str, object]:
        """The options that shape the result, as JSON values; not where and how fast it was computed."""
        left_out = {*MACHINE, *PUBLICATION}
        values = {f.name: getattr(self, f.name) for f in dataclasses.fields(self) if f.name not in left_out}
        return values | {
            "external": [path.name for path in self.external],
            "coordinates": [path.name for path in self.coordinates],
            "bins": None if self.bins is None else self.bins.name,
        }


_OPTIONS: Mapping[str, dataclasses.Field[Any]] = {
    option.name: option for option in dataclasses.fields(Config)
}

_RANGES: Mapping[str, tuple[float, float]] = {
    "neighbours": (1, 10_000),
    "edge_length": (0.002, 0.1),
    "thumbnail_size": (32, 2048),
    "seed": (0, 2**32 - 1),
    "time_limit": (1, 1_000_000),
    "memory_limit": (0.5, 1_000_000),
    "jobs": (1, 10_000),
}

_WANTED = {
    "b": "true or false",
    "f": "a number",
    "i": "a whole number",
    "P": "a path",
    "s": "text",
    "t": "a list of file names",
}
"""First letter of an option's type -> its values."""

MACHINE = tuple(f.name for f in _OPTIONS.values() if f.metadata["of_machine"])
"""Options that reach out of the database; its own file may not hold them."""


def load_config(database: Path | None, options: Mapping[str, Any], file: Path | None = None) -> Config:
    """The options for a database.

    Parameters
    ----------
    database : Path or None
        The database's folder, or a table in it, whose ``shapeviz.toml`` is read; None for no such file.
    options : mapping
        Named as the fields of :class:`Config`; None means not given.
    file : Path, optional
        A file of options that the user names: it may hold any option, and paths to anywhere.

    Raises
    ------
    ConfigError
        A file is not TOML, or an option is unknown, of the wrong type or out of range; or the database's file holds
        an option of the machine or a path that leaves the database's folder.
    """
    values: dict[str, Any] = {}
    if database is not None:
        folder = database if os.path.isdir(database) else database.parent
        values |= _database_options(folder / FILE_NAME)
    if file is not None:
        for key, value in _read_file(file).items():
            values[key] = _convert(key, value, f"in {file}", file.parent)
    values |= _environment_options()
    for key, value in options.items():
        if value is not None:
            values[key] = _convert(key, value, "as an option", Path())
    return Config(**values)


def _database_options(file: Path) -> dict[str, Any]:
    """The options of a database's own file; none if there is no such file."""
    if not os.path.lexists(file):
        return {}
    _check_inside(file, FILE_NAME, file.parent)
    values = {}
    for key, value in _read_file(file).items():
        if key in MACHINE:
            raise ConfigError(
                f"{key} (in {file}) is not for the database to say, which may come from somebody else. Take it out of "
                f"this file, and give it as --{key.replace('_', '-')}, in the environment as "
                f"{ENVIRONMENT_PREFIX}{key.upper()}, or in a file of your own that --config names"
            )
        values[key] = _convert(key, value, f"in {file}", file.parent)
        for path in values[key] if isinstance(values[key], tuple) else (values[key],):
            if isinstance(path, Path):
                _check_inside(path, f"{key} (in {file})", file.parent)
    return values


def _check_inside(path: Path, what: str, folder: Path) -> None:
    try:
        # another machine is not asked whether it has the file: Windows would tell it who asks
        near = path.absolute().drive == folder.absolute().drive
        inside = near and path.resolve().is_relative_to(folder.resolve())
    except (OSError, RuntimeError, ValueError) as error:
        raise ConfigError(f"{what} is no path that can be followed: {error}") from error
    if not inside:
        raise ConfigError(
            f"{what} leads to {str(path)!r}, outside of the database's folder {folder}; such a file is not "
            "read. Copy it into the folder; or name it as a flag, or in a file of your own that --config names"
        )


def _environment_options() -> dict[str, Any]:
    """The options that stand in the environment, such as ``SHAPEVIZ_CACHE``; empty ones do not count."""
    options = {ENVIRONMENT_PREFIX + name.upper(): option for name, option in _OPTIONS.items()}
    values = {}
    for variable, text in os.environ.items():
        if not variable.startswith(ENVIRONMENT_PREFIX) or not text:
            continue
        option = options.get(variable)
        if option is None:
            # others may have variables that begin so; one that is nearly an option was meant to be it
            for near in difflib.get_close_matches(variable.upper(), options, n=1, cutoff=0.9):
                raise ConfigError(
                    f"there is no option {variable} (in the environment); the nearest is {near}"
                )
            continue
        kind = str(option.type)
        value: Any = text
        try:
            if kind.startswith("bool"):
                value = {"1": True, "true": True, "0": False, "false": False}.get(text.lower(), text)
            elif kind.startswith(("int", "float")):
                value = int(text) if kind.startswith("int") else float(text)
        except ValueError:
            pass  # `_convert` says what it should have been
        values[option.name] = _convert(option.name, value, f"in the environment, {variable}", Path())
    return values


def _read_file(file: Path) -> dict[str, Any]:
    try:
        text = read_regular(file, MOST_BYTES).decode("utf-8-sig")
    except OSError as error:
        raise ConfigError(f"the options in {file} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:  # UTF-16 has it beside every letter
        raise ConfigError(f"{file} cannot be read as TOML: it is no text in UTF-8; save it as such")
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise ConfigError(
            f"{file} cannot be read as TOML: its lists or tables are nested too deeply"
        ) from error
    except ValueError as error:  # of TOML, of a number of thousands of digits
        raise ConfigError(f"{file} cannot be read as TOML: {error}") from error


def _convert(key: str, value: Any, where: str, folder: Path) -> Any:
    """A value as the field wants it; relative paths start at ``folder``."""
    if key not in _OPTIONS:
        raise ConfigError(_unknown(key, value, where))
    kind = str(_OPTIONS[key].type)
    if isinstance(value, datetime.date) and kind.startswith("str"):
        value = value.isoformat()  # TOML knows days
    if isinstance(value, str) and len(value) > MOST_LETTERS:
        raise ConfigError(f"{key} has {len(value):,} letters; shorten it to {MOST_LETTERS:,} ({where})")
    converted = _of_kind(kind, key, value, where, folder)
    if converted is None:
        raise ConfigError(f"{key} must be {_WANTED[kind[0]]}, not {reprlib.repr(value)} ({where})")
    if fault := _out_of_range(key, converted):
        raise ConfigError(f"{fault} ({where})")
    return converted


def _unknown(key: str, value: Any, where: str) -> str:
    """What there is instead of an option that there is not."""
    told = f"there is no option {key[:60]!r} ({where})"
    if isinstance(value, Mapping):
        return f"{told}, and no option has a table: let all of them stand at the top, without [{key[:60]}]"
    near = difflib.get_close_matches(key.lower().replace("-", "_"), _OPTIONS, n=1, cutoff=0.75)
    return f"{told}; the nearest is {near[0]}" if near else f"{told}; there are: {', '.join(_OPTIONS)}"


def _out_of_range(name: str, value: Any) -> str:
    """What is wrong with the value of an option, if it is none of its choices or out of its range."""
    option = _OPTIONS[name]
    choices = option.metadata["choices"]
    if choices and value not in (option.default, *choices):
        return f"{name} must be one of {', '.join(choices)}, not {value!r}"
    low, high = _RANGES.get(name, (None, None))
    if low is not None and value is not None and not low <= value <= high:
        return f"{name} must be from {low:,} to {high:,}, not {value:,}"
    return ""


def _of_kind(kind: str, key: str, value: Any, where: str, folder: Path) -> Any:
    """A value as its field has it; None where it is of another kind."""
    if kind.startswith("tuple"):
        paths = value if isinstance(value, list | tuple) else [value]
        if all(isinstance(path, str | os.PathLike) for path in paths):
            return tuple(_path(key, path, where, folder) for path in paths)
    elif kind == "bool" and isinstance(value, bool):
        return value
    elif kind.startswith("Path") and isinstance(value, str | os.PathLike):
        return _path(key, value, where, folder)
    elif kind.startswith("float") and isinstance(value, Real) and not isinstance(value, bool):
        return float(value)
    elif kind.startswith("int") and isinstance(value, Integral) and not isinstance(value, bool):
        return int(value)  # perhaps a number of numpy
    elif kind.startswith("str") and isinstance(value, str):
        return value
    return None


def _path(key: str, value: str | os.PathLike[str], where: str, folder: Path) -> Path:
    try:
        refuse_no_path(folder / value)
    except OSError as error:
        raise ConfigError(f"{key} ({where}) is no path that can be followed: {error.strerror}") from error
    return folder / value
