"""The colours of 3MF: base materials of the core specification; groups of colours, and of places in pictures, of the
materials extension. Mixtures of these are white."""

from __future__ import annotations

import re
from array import array
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
import numpy.typing as npt

from shapeviz_report.mesh.paint import Bytes, Pictures, Wrap
from shapeviz_report.mesh.readers.polygons import Indices
from shapeviz_report.types import FloatArray

_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_MATERIAL = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02"
_COLOR = re.compile(r"\s*#([0-9a-f]{6})(?:[0-9a-f]{2})?\s*", re.IGNORECASE)
_BASE_MATERIALS, _BASE = f"{_CORE} basematerials", f"{_CORE} base"
_COLORS, _ONE_COLOR = f"{_MATERIAL} colorgroup", f"{_MATERIAL} color"
_PLACES, _PLACE = f"{_MATERIAL} texture2dgroup", f"{_MATERIAL} tex2coord"
_PICTURE = f"{_MATERIAL} texture2d"
_WRAPS: dict[str, Wrap] = {"mirror": "mirror", "clamp": "clamp", "none": "clamp"}


@dataclass
class Group:
    """Colours or places in a picture, which corners refer to by their numbers.

    Attributes
    ----------
    colors : bytearray
        sRGB, three channels in turns.
    places : array of float
        From left to right and from bottom to top, in turns.
    picture : str
        Id of the picture.
    of_triangles : bool
        A triangle has one of them, that of its first corner.
    """

    colors: bytearray = field(default_factory=bytearray)
    places: array[float] = field(default_factory=lambda: array("d"))
    picture: str = ""
    of_triangles: bool = False


class Groups:
    """The groups of a part, in the order in which they are first named, and its pictures by id: their paths, and what
    lies beyond them."""

    def __init__(self) -> None:
        self.pictures: dict[str, tuple[str, tuple[Wrap, Wrap]]] = {}
        self._groups: list[Group] = []
        self._numbers: dict[str, int] = {}
        self._last = Group()

    def number(self, name: str) -> int:
        """The number of a group, be it described or not."""
        if name not in self._numbers:
            self._numbers[name] = len(self._groups)
            self._groups.append(Group())
        return self._numbers[name]

    def describe(self, name: str, attributes: Mapping[str, str]) -> None:
        """Take what an element says, if it is of a group. What is not as it should be says nothing."""
        if name == _BASE:
            self._add_color(attributes.get("displaycolor", ""))
        elif name == _ONE_COLOR:
            self._add_color(attributes.get("color", ""))
        elif name == _PLACE:
            self._last.places.extend(_number(attributes.get(axis, "")) for axis in "uv")
        elif name in (_BASE_MATERIALS, _COLORS, _PLACES):
            self._last = self._groups[self.number(attributes.get("id", ""))]
            self._last.of_triangles = name == _BASE_MATERIALS
            self._last.picture = attributes.get("texid", "")
        elif name == _PICTURE:
            across, down = (_WRAPS.get(attributes.get(f"tilestyle{axis}", ""), "repeat") for axis in "uv")
            self.pictures[attributes.get("id", "")] = attributes.get("path", ""), (across, down)

    def _add_color(self, text: str) -> None:
        match = _COLOR.fullmatch(text)
        self._last.colors += bytes.fromhex(match[1]) if match else b"\xff\xff\xff"

    def paint(
        self, groups: Indices, corners: Indices, pictures: Pictures, read: Callable[[str], bytes | None]
    ) -> tuple[Bytes, FloatArray, Indices]:
        """Colour (m, 3, 3), place in a picture (m, 3, 2) and picture (m, 3) of the corners of triangles.

        Parameters
        ----------
        groups : (m,) int64 array
            Numbers; -1 for none.
        corners : (m, 3) int64 array
            What of it each corner has.
        pictures : Pictures
            The pictures are added to it.
        read : callable
            Gives the content of a file by its path, None if it is not there.
        """
        of_triangles = np.array([*(group.of_triangles for group in self._groups), False])[groups]
        corners = np.where(of_triangles[:, None], corners[:, :1], corners)
        colors = np.full((*corners.shape, 3), 255, np.uint8)
        there, rows = _rows([len(group.colors) // 3 for group in self._groups], groups, corners)
        table = np.frombuffer(b"".join(group.colors for group in self._groups), np.uint8).reshape(-1, 3)
        colors[there] = table[rows]
        places, shown = np.zeros((*corners.shape, 2)), np.full(corners.shape, -1)
        there, rows = _rows([len(group.places) // 2 for group in self._groups], groups, corners)
        table = np.concatenate([np.empty(0), *(group.places for group in self._groups)]).reshape(-1, 2)
        places[there] = table[rows] * [1, -1] + [0, 1]
        of_group = np.full(len(self._groups) + 1, -1)
        for number in np.unique(groups[there.any(axis=1)]).tolist():
            path, wraps = self.pictures.get(self._groups[number].picture, ("", ("repeat", "repeat")))
            of_group[number] = pictures.place(path, path or "a picture", partial(read, path), wraps)
        shown[there] = np.broadcast_to(of_group[groups][:, None], shown.shape)[there]
        return colors, places, shown


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return 0.0


def _rows(counts: Sequence[int], groups: Indices, corners: Indices) -> tuple[npt.NDArray[np.bool_], Indices]:
    """Which corners (m, 3) have an entry in a table of the entries of all groups, and the rows of those."""
    ends = np.cumsum([0, *counts])
    sizes = np.array([*counts, 0])[groups]
    there = (corners >= 0) & (corners < sizes[:, None])
    return there, (ends[groups][:, None] + corners)[there]
