"""What a site's ``data/`` folder says to a query, checked for having been written by this version."""

from __future__ import annotations

import csv
import json
import os
import struct
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib.metadata import version
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from shapeviz_report.config import Config
from shapeviz_report.errors import ConfigError, SiteError
from shapeviz_report.files import read_regular
from shapeviz_report.pages.base import MOST_IN_FULL, feature_files
from shapeviz_report.presets import PRESETS, Preset
from shapeviz_report.types import FeatureBlock, FeatureTable, FloatArray
from shapeviz_report.writing.data.encoding import GENERATOR, read_archive, read_csv


@dataclass(frozen=True)
class SiteData:
    """What a site holds that a query needs.

    Attributes
    ----------
    folder : Path
    summary : dict
        The content of ``summary.json``.
    shapes : list of dict
        The rows of ``shapes.csv``.
    table : FeatureTable
        The features that a mesh alone has.
    brought : tuple of FeatureBlock
        Those that it has not.
    edges : (dimensions, 11) float64 array
    """

    folder: Path
    summary: dict[str, Any]
    shapes: list[dict[str, str]]
    table: FeatureTable
    brought: tuple[FeatureBlock, ...]
    edges: FloatArray

    @property
    def preset(self) -> Preset:
        return PRESETS[self.summary["parameters"]["preset"]]


def read_site(folder: Path) -> SiteData:
    """Read the ``data`` folder of a site, and check that its parts fit together and are of this version."""
    data = folder / "data"
    try:
        summary = json.loads(read_regular(data / "summary.json"))
    except (OSError, ValueError, RecursionError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is no JSON"
        raise SiteError(
            f"{folder} is not a folder that `shapeviz-report build` has written: {data / 'summary.json'} cannot be "
            f"read ({reason})"
        ) from error
    if not isinstance(summary, dict) or summary.get("generator") != GENERATOR:
        raise SiteError(f"{folder} is not a site of shapeviz-report: {data / 'summary.json'} does not say so")
    ours = version("shapeviz-report")
    if summary.get("version") != ours:
        raise SiteError(
            f"{folder} was built by version {summary.get('version')} of shapeviz-report, and this is version "
            f"{ours}, which may measure shapes differently: build the site again, or query it with its version"
        )
    try:
        with _reading("shapes.csv"):
            header, *rows = read_csv(read_regular(data / "shapes.csv"))
            shapes = [dict(zip(header, row, strict=True)) for row in rows]
            _require(bool(shapes) and {"id", "name", "class", "file"} <= {*header}, "its columns are others")
        whole = os.path.lexists(data / "features.npz")
        files = ["features.npz"] if whole else list(feature_files(len(shapes)))
        if not files:
            raise SiteError(
                f"the site {folder} holds no features, as one of more than {MOST_IN_FULL:,} shapes. Its owner can "
                f"write them, from the meshes and the cache of the build: `shapeviz-report describe DATABASE -o "
                f"{data / 'features.npz'}`"
            )
        found = [_read_features(data / file) for file in files]
        with _reading("features.npz"):
            columns, edges = found[0].columns, found[0].edges
            _require(
                all(part.columns == columns and np.array_equal(part.edges, edges) for part in found),
                "its parts are of different builds",
            )
            ids = tuple(chain.from_iterable(part.ids for part in found))
            values = np.concatenate([part.values for part in found])
            _require(
                [shape["id"] for shape in shapes] == list(ids), "it and shapes.csv are of different builds"
            )
        with _reading("summary.json"):
            blocks = tuple(FeatureBlock(**block) for block in summary["features"])
            widths = [block.dimensions * block.bins for block in blocks]
            _require(
                min(widths) > 0 and sum(widths) == len(columns), "it and features.npz are of different builds"
            )
            _require(
                [column for block in blocks for column in block.columns] == columns,
                "it and features.npz are of different builds",
            )
            dimensions = sum(block.dimensions for block in blocks if block.bins > 1)
            _require(edges.shape == (dimensions, 11), "its features do not fit the edges")
            own = PRESETS[summary["parameters"]["preset"]].blocks
            _require(all(0 <= block.weight < np.inf for block in blocks), "a feature has no weight")
            edge_length = summary["parameters"]["edge_length"]
            _require(isinstance(edge_length, float), "the length of an edge is no number")
            Config(edge_length=edge_length)
            _require(isinstance(summary["database"], str), "the database has no name")
            bins = next(iter(summary["projections"].values()))["bins"]
            _require(bins is None or (bool(bins) and {*bins} <= {*columns}), "its bins are not there")
    except ValueError as error:
        raise SiteError(f"the site {folder} is not complete, build it again: {error}") from error
    there = blocks[: len(own)]
    if tuple(replace(block, weight=1.0) for block in there) != own:
        raise SiteError(f"the site {folder} has other features than this version measures: build it again")
    width = sum(block.width for block in own)
    table = FeatureTable(ids, there, values[:, :width])
    return SiteData(folder, summary, shapes, table, blocks[len(own) :], edges)


@dataclass(frozen=True)
class _Features:
    """A file of features, whole or a part."""

    values: FloatArray
    columns: list[str]
    ids: list[str]
    edges: FloatArray


def _read_features(file: Path) -> _Features:
    with _reading(file.name):
        arrays = read_archive(read_regular(file))
        values, edges = (arrays[name].astype(np.float64, casting="safe") for name in ("values", "edges"))
        columns, ids = arrays["columns"].tolist(), arrays["shape_ids"].tolist()
        _require(values.shape == (len(ids), len(columns)), "its arrays do not fit together")
        _require(bool(np.isfinite(values).all() and np.isfinite(edges).all()), "a value is not finite")
        return _Features(values, columns, ids, edges)


@contextmanager
def _reading(file: str) -> Iterator[None]:
    """Inside, whatever is wrong with a file of a site becomes a ``ValueError`` that names the file."""
    try:
        yield
    except OSError as error:
        raise ValueError(f"{file} cannot be read ({error.strerror or error})") from error
    except ConfigError as error:
        raise ValueError(f"{file} says what no build does: {error}") from error
    except (
        ValueError, LookupError, TypeError, AttributeError, RuntimeError, StopIteration, OverflowError, EOFError,
        MemoryError, csv.Error, zipfile.BadZipFile, zlib.error, struct.error,
    ) as error:  # fmt: skip
        reason = str(error) if isinstance(error, _Misfit) else "it was damaged or changed"
        raise ValueError(f"{file}: {reason}") from error


class _Misfit(ValueError):
    """What :func:`_require` says."""


def _require(holds: bool, what: str) -> None:
    if not holds:
        raise _Misfit(what)
