"""Which shapes maps of very many show as pictures, and on which sheets these lie.

A picture of every shape would be hundreds of megabytes, of which a map has room for some two hundred at a time. So
there are grids of more and more cells over a map, and each cell that holds any shape shows the most central one; what
a coarse grid shows, the finer ones show too, so that no picture goes when a reader comes nearer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256

import numpy as np
import numpy.typing as npt

from shapeviz_report.pages.base import is_in_full
from shapeviz_report.types import FloatArray, Report

#: Cells on a side of the grids over a map, from the coarsest.
GRIDS = (32, 64, 128, 256)

#: Pictures on a side of a sheet.
ACROSS = 8


Rows = npt.NDArray[np.intp]


@dataclass(frozen=True)
class MapPictures:
    """The shapes that a map shows as pictures.

    Attributes
    ----------
    rows : ndarray of int, shape (n,)
        The shapes, grid by grid from the coarsest, and within each along a curve: those of a sheet lie together.
    ends : tuple of int
        How many of them each grid shows.
    """

    rows: Rows
    ends: tuple[int, ...]

    def sheets(self) -> list[Rows]:
        """The shapes on each sheet, row after row of it; the last may not be full."""
        return [self.rows[start : start + ACROSS**2] for start in range(0, len(self.rows), ACROSS**2)]


def map_pictures(report: Report) -> dict[str, MapPictures]:
    """What each map shows as pictures, by the key of the map; nothing where these are the pictures of all shapes."""
    if is_in_full(report):
        return {}
    labels = np.unique([label or "" for label in report.labels], return_inverse=True)[1]
    return {
        key: choose_pictures(projection.xy, labels, GRIDS)
        for key, (projection, _) in report.projections.items()
    }


def choose_pictures(xy: FloatArray, groups: Rows, grids: Sequence[int]) -> MapPictures:
    """Choose the shapes that a map shows as pictures.

    Parameters
    ----------
    xy : ndarray, shape (n, 2)
        In [-1, 1].
    groups : ndarray of int, shape (n,)
        The coarsest grid shows one shape of each at least.
    grids : sequence of int
        Cells on a side, each a multiple of the one before.

    Returns
    -------
    MapPictures
    """
    shown = np.zeros(len(xy), dtype=bool)
    parts: list[Rows] = []
    for grid in grids:
        column, line = np.clip(((xy + 1) / 2 * grid).astype(int), 0, grid - 1).T
        cells = line * grid + column
        free = ~np.isin(cells, cells[shown])
        chosen = _most_central(xy, cells, np.flatnonzero(free))
        if not parts:
            lacking = ~np.isin(groups, groups[chosen])
            chosen = np.concatenate([chosen, _most_central(xy, groups, np.flatnonzero(lacking))])
        shown[chosen] = True
        parts.append(chosen[np.argsort(_along_curve(column[chosen], line[chosen]), kind="stable")])
    ends = np.cumsum([len(part) for part in parts])
    return MapPictures(np.concatenate(parts), tuple(int(end) for end in ends))


def sheet_name(rows: Rows, pictures: Sequence[str]) -> str:
    """File name of a sheet below ``sheets/``: a hash of what is on it."""
    return sha256("\n".join(pictures[row] for row in rows).encode()).hexdigest()[:20] + ".webp"


def _most_central(xy: FloatArray, parts: Rows, rows: Rows) -> Rows:
    """Of some shapes, the one of each part that is nearest to the middle of those of the part."""
    _, part, sizes = np.unique(parts[rows], return_inverse=True, return_counts=True)
    middles = np.stack([np.bincount(part, axis) / sizes for axis in xy[rows].T], axis=1)
    distance = ((xy[rows] - middles[part]) ** 2).sum(axis=1)
    order = np.lexsort((rows, distance, part))
    return rows[order[np.searchsorted(part[order], np.arange(len(sizes)))]]


def _along_curve(column: Rows, line: Rows) -> Rows:
    """The place of cells along Morton's curve: the bits of both numbers by turns."""
    place = np.zeros_like(column)
    for bit in range(int(max(column.max(initial=0), line.max(initial=0))).bit_length()):
        place |= ((column >> bit) & 1) << (2 * bit) | ((line >> bit) & 1) << (2 * bit + 1)
    return place
