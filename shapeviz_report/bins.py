"""Bins: single columns of the feature table, and how a choice of them is compared.

``docs/method/bins.md`` says what a bin is and why a choice of bins is scaled as it is.
"""

from __future__ import annotations

import csv
import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from shapeviz_report.cells import part_cells, read_cell
from shapeviz_report.errors import ConfigError
from shapeviz_report.files import decode_text, read_regular
from shapeviz_report.presets import Preset, compared_values
from shapeviz_report.types import FeatureBlock, FeatureTable, FloatArray

MOST_BYTES = 1024**2
"""Size of the largest file of bins."""


def read_bins(path: Path, blocks: Sequence[FeatureBlock]) -> tuple[str, ...]:
    """The bins that a file names.

    Parameters
    ----------
    path : Path
        Text with a name a line, where lines that start with ``#`` are comments; a ``.csv`` with a column ``bin``,
        of which only rows with 1 in a column ``chosen`` count if there is one; or a ``.json`` with a list of names,
        or with an object whose ``bins`` is that list. All are what the Workbench saves.
    blocks : sequence of FeatureBlock
        The features there are.

    Returns
    -------
    tuple of str
        In the order of the columns.

    Raises
    ------
    ConfigError
        The file cannot be read, names no bin, one twice, or one that there is not.
    """
    columns = {column: place for place, column in enumerate(c for block in blocks for c in block.columns)}
    try:
        text = decode_text(read_regular(path, MOST_BYTES))
        names = _READERS.get(path.suffix.lower(), _read_text)(text)
    except (OSError, ValueError, RecursionError, csv.Error) as error:
        said = error.strerror if isinstance(error, OSError) else error
        raise ConfigError(f"the file of bins {path} cannot be read: {said}") from error
    if not names:
        raise ConfigError(f"the file of bins {path} names none; it takes a name such as Agd:6 on each line")
    for name, count in Counter(names).items():
        if name not in columns:
            raise ConfigError(f"the file of bins {path} names {name[:60]!r}: {_missing(name, blocks)}")
        if count > 1:
            raise ConfigError(f"the file of bins {path} names {name!r} {count} times")
    return tuple(sorted(names, key=columns.__getitem__))


def _read_text(text: str) -> list[str]:
    lines = (line.strip() for line in text.splitlines())
    return [line for line in lines if line and not line.startswith("#")]


def _read_csv(text: str) -> list[str]:
    table = next((way for way in part_cells(text) if "bin" in way.header), None)
    if table is None:
        raise ValueError("it has no column named 'bin'")
    rows = (dict(zip(table.header, cells)) for cells in table.rows if cells)
    return [read_cell(row.get("bin", "")) for row in rows if row.get("chosen", "1") == "1"]


def _read_json(text: str) -> list[str]:
    content = json.loads(text)
    names = content.get("bins") if isinstance(content, dict) else content
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise ValueError("it holds neither a list of names nor an object with such a list under 'bins'")
    return names


_READERS = {".csv": _read_csv, ".json": _read_json}


def _missing(name: str, blocks: Sequence[FeatureBlock]) -> str:
    """Why there is no bin of this name, in words."""
    for block in blocks:
        if name == block.name or name.startswith((f"{block.name}:", f"{block.name}[")):
            first, last = block.columns[0], block.columns[-1]
            return f"the columns of {block.name} are {first} to {last}"
    features = ", ".join(block.name for block in blocks)
    return f"there is no such feature, only {features}; a feature of your own needs --external here too"


def scale_bins(table: FeatureTable, preset: Preset, bins: Sequence[str]) -> FloatArray:
    """The values that maps of a choice of bins compare, by Euclidean distance; (n, len(bins)).

    Balanced: each bin of :func:`~shapeviz_report.presets.compared_values` is divided by its standard deviation
    over all shapes, so that every chosen bin counts the same, however little surface it holds. A bin that is the
    same for all shapes becomes zero. Otherwise the plain values.
    """
    place = {column: index for index, column in enumerate(table.columns)}
    values = compared_values(table, preset)[:, [place[name] for name in bins]]
    if not preset.balanced:
        return values
    centred = values - values.mean(axis=0)
    spread = centred.std(axis=0)
    return np.divide(centred, spread, out=np.zeros_like(centred), where=spread > 1e-12)


def features_of(table: FeatureTable, bins: Sequence[str]) -> tuple[str, ...]:
    """The features that have one of these bins, in the order of the table."""
    chosen = set(bins)
    return tuple(block.name for block in table.blocks if not chosen.isdisjoint(block.columns))
