"""The compared values of all shapes where these are too many for one chunk: in parts, each for one kind of question.

A page reads a part when a reader asks for what is in it: ``rows`` for what single shapes are, ``columns`` for what all
shapes have of a bin, ``components`` for who is similar to whom, ``classes`` for how values are spread.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
from threadpoolctl import threadpool_limits

from shapeviz_report.pages.base import class_codes, class_names
from shapeviz_report.pages.chunks import ClassPart, ComponentPart, Levels
from shapeviz_report.pages.sampling import scatter
from shapeviz_report.presets import Preset, compared_values
from shapeviz_report.similarity import weight_of_size
from shapeviz_report.types import FeatureTable, FloatArray, IntArray, Report

#: Levels of a compared value from the lowest to the highest of its column: a share of a quarter of the surface is known
#: to two thousandths of it all, a smaller one better.
LEVELS = 255

#: Shapes a part of the rows: few, as those that a search finds lie in as many parts.
ROWS_A_PART = 25

#: Columns a part: the bins of a dimension, or as many features of whole shapes.
COLUMNS_A_PART = 10

#: Levels that are counted together where a class says how its values are spread.
LEVELS_A_CELL = 4
CELLS = (LEVELS + 1) // LEVELS_A_CELL

#: Principal components of a feature by which similar shapes are looked for, a byte each.
COMPONENTS = 16

#: Shapes from which the components are found.
FITTED = 4000

#: Rows that are worked on at a time.
BLOCK = 4096

ByteArray = npt.NDArray[np.uint8]


@dataclass(frozen=True)
class LevelTable:
    """The compared values of a report in levels.

    Attributes
    ----------
    preset : Preset
    table : FeatureTable
    codes : (n,) int array
        The class of every shape, -1 without one.
    classes : int
    order : (n,) int32 array
        The shapes class by class, first those without one; within a class in the order of
        :func:`~shapeviz_report.pages.sampling.sample_rows`, so that a sample of it lies in few parts.
    low, high : (w,) float64 array
        Compared values of each column.
    values : (n, w) uint8 array
        In the order of the shapes.
    means, variances : (w,) float64 array
        Of compared values.
    """

    preset: Preset
    table: FeatureTable
    codes: IntArray
    classes: int
    order: IntArray
    low: FloatArray
    high: FloatArray
    values: ByteArray
    means: FloatArray
    variances: FloatArray

    @property
    def weights(self) -> FloatArray:
        """What a squared difference in the compared values of each feature counts; (f,)."""
        return np.array(
            [
                weight_of_size(
                    block, self.preset, float(self.variances[self.table.slice_of(block.name)].sum())
                )
                for block in self.table.blocks
            ]
        )


def level_table(report: Report, preset: Preset) -> LevelTable:
    """Bring all values of a report to levels.

    Parameters
    ----------
    report : Report
    preset : Preset
        How its values are compared.
    """
    table, codes = report.features, class_codes(report)
    # Compared values rise with those of the table.
    low, high = compared_values(
        replace(table, values=np.stack([table.values.min(axis=0), table.values.max(axis=0)]).astype(float)),
        preset,
    )
    width = np.where(high > low, high - low, 1.0)
    values = np.empty(table.values.shape, np.uint8)
    sums, squares = np.zeros(len(low)), np.zeros(len(low))
    for rows, compared in _blocks(table, preset):
        values[rows] = np.round((compared - low) / width * LEVELS)
        # About the lowest value, for few digits to be lost.
        sums += (compared - low).sum(axis=0)
        squares += ((compared - low) ** 2).sum(axis=0)
    means = sums / len(values)
    return LevelTable(
        preset,
        table,
        codes,
        len(class_names(report)),
        np.lexsort((scatter(len(codes)), codes)).astype(np.int32),
        low,
        high,
        values,
        low + means,
        np.maximum(squares / len(values) - means**2, 0.0),
    )


def levels_chunk(levels: LevelTable) -> Levels:
    """The chunk "levels": what all parts are in terms of."""
    return {
        "low": levels.low.astype(np.float32),
        "high": levels.high.astype(np.float32),
        "variances": levels.variances,
        "weights": levels.weights,
        "order": levels.order,
        "rowsAPart": ROWS_A_PART,
        "columnsAPart": COLUMNS_A_PART,
        "levelsACell": LEVELS_A_CELL,
    }


def level_parts(levels: LevelTable) -> Mapping[str, Iterable[object]]:
    """The parts, each made when it is asked for."""
    return {
        "rows": _rows(levels),
        "columns": _columns(levels),
        "components": component_parts(levels),
        "classes": _classes(levels),
    }


def _blocks(table: FeatureTable, preset: Preset) -> Iterator[tuple[slice, FloatArray]]:
    """Some rows of a table at a time, and their compared values: all at once would be gigabytes."""
    for start in range(0, len(table.values), BLOCK):
        rows = slice(start, start + BLOCK)
        yield rows, compared_values(replace(table, values=table.values[rows].astype(float)), preset)


def _rows(levels: LevelTable) -> Iterator[bytes]:
    for start in range(0, len(levels.order), ROWS_A_PART):
        yield levels.values[levels.order[start : start + ROWS_A_PART]].tobytes()


def _columns(levels: LevelTable) -> Iterator[bytes]:
    """Feature by feature, column after column; no part has columns of two features."""
    for block in levels.table.blocks:
        columns = levels.table.slice_of(block.name)
        for start in range(columns.start, columns.stop, COLUMNS_A_PART):
            chosen = slice(start, min(start + COLUMNS_A_PART, columns.stop))
            yield np.ascontiguousarray(levels.values[:, chosen].T).tobytes()


def component_parts(levels: LevelTable) -> Iterator[ComponentPart]:
    """The parts "components": of each feature, where the shapes lie along its principal components (Jolliffe 2002,
    2.1), a byte each."""
    count = len(levels.values)
    sample = np.sort(np.random.default_rng(0).permutation(count)[:FITTED])
    for block, weight in zip(levels.table.blocks, levels.weights, strict=True):
        columns = levels.table.slice_of(block.name)
        own = FeatureTable((), (block,), levels.table.values[:, columns])
        with threadpool_limits(limits=1):
            compared = compared_values(replace(own, values=own.values[sample].astype(float)), levels.preset)
            _, axes = np.linalg.eigh(np.atleast_2d(np.cov(compared.T)))
            axes = axes[:, ::-1][:, : min(COMPONENTS, block.width)]
            middle = levels.means[columns] @ axes
            places = np.concatenate([block_of @ axes - middle for _, block_of in _blocks(own, levels.preset)])
        # One step for all: what is small along one component is small beside the others.
        reach = float(np.abs(places).max())
        step = 2 * reach / LEVELS if reach > 0 else 1.0
        yield {
            "unit": float(step**2 * weight),
            "values": np.round((places + reach) / step).astype(np.uint8).T.ravel(),
        }


def _classes(levels: LevelTable) -> Iterator[ClassPart]:
    """Class by class, last of all shapes."""
    for code in range(levels.classes):
        yield _spread(levels, levels.values[levels.codes == code])
    yield _spread(levels, levels.values)


def _spread(levels: LevelTable, values: ByteArray) -> ClassPart:
    width = values.shape[1]
    cells = np.zeros(width * CELLS, np.int64)
    sums, squares, upto_sums, upto_squares = np.zeros((4, width))
    first = np.arange(width) * CELLS
    for start in range(0, len(values), BLOCK):
        some = values[start : start + BLOCK]
        cells += np.bincount((some // LEVELS_A_CELL + first).ravel(), minlength=len(cells))
        sums += some.sum(axis=0, dtype=float)
        squares += (some.astype(float) ** 2).sum(axis=0)
        upto = _shares_upto(levels, some)
        upto_sums += upto.sum(axis=0)
        upto_squares += (upto**2).sum(axis=0)
    means, upto_means = sums / len(values), upto_sums / len(values)
    return {
        "shapes": len(values),
        "means": means.astype(np.float32),
        "variances": np.maximum(squares / len(values) - means**2, 0).astype(np.float32),
        "upTo": np.maximum(upto_squares / len(values) - upto_means**2, 0).astype(np.float32),
        "cells": cells.astype(np.uint32),
    }


def _shares_upto(levels: LevelTable, some: ByteArray) -> FloatArray:
    """Of each bin, the share of the surface that lies in it and in those before it of its dimension; 0 for a feature
    of whole shapes. (m, w)."""
    shares = np.zeros(some.shape)
    for block in levels.table.blocks:
        if block.bins == 1:
            continue
        columns = levels.table.slice_of(block.name)
        low, high = levels.low[columns], levels.high[columns]
        compared = low + (high - low) / LEVELS * some[:, columns]
        own = compared**2 if levels.preset.balanced else compared
        shares[:, columns] = own.reshape(len(some), -1, block.bins).cumsum(axis=2).reshape(len(some), -1)
    return shares
