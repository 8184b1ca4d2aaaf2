"""The colours of a surface: as files have them, at corners and in pictures; and at the vertices of a prepared mesh.

A prepared mesh has vertices of its own. Each takes the colour of the closest point of the surface that was read, so
that one colour a vertex is all that pictures and models need to know.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
from PIL import Image

from shapeviz_report.mesh.boxes import LEAF, along_curve, box_faces
from shapeviz_report.mesh.closest import find_closest
from shapeviz_report.types import FloatArray, Mesh

Bytes = npt.NDArray[np.uint8]
Indices = npt.NDArray[np.int64]

MOST_PIXELS = 2**26
"""Of a picture in a file; it is unpacked at once."""

SIDE = 1024
"""Pixels of a picture's longer side that are kept: as fine as pictures of shapes can show."""

MOST_PICTURES = 256
"""Pictures of one surface that are unpacked."""

INWARDS = 0.25
"""How far inside a face its colour is taken, of the way from a corner to the middle."""

LIFT = 1e-4
"""How far the two sides of a surface are held apart, of a shape's diagonal."""

_FORMATS = ("PNG", "JPEG", "WEBP", "BMP", "TGA")

GREYS = 8
"""Steps of 255 by which the channels of a colour may differ that says nothing: the grey or white of a program."""


Wrap = Literal["repeat", "mirror", "clamp"]
"""What lies beyond a picture: the same again, its mirror image, or the pixels of its edge."""


@dataclass(frozen=True)
class Picture:
    """A picture as it lies on a surface.

    Attributes
    ----------
    pixels : (h, w, 3) uint8 array
        sRGB.
    wraps : (Wrap, Wrap)
        Beyond its sides, and beyond its top and bottom.
    """

    pixels: Bytes
    wraps: tuple[Wrap, Wrap] = ("repeat", "repeat")


@dataclass(frozen=True)
class Paint:
    """What colours a surface, corner by corner.

    Attributes
    ----------
    colors : (k, 3) uint8 array
        sRGB, of every corner; what a picture has there is multiplied by it, as light.
    places : (k, 2) float32 array or None
        Where in its picture each corner is: from left to right and from top to bottom, 1 the whole.
    pictures : (k,) int16 array or None
        The picture of each corner; -1 for none.
    images : tuple of Picture
    lost : tuple of str
        What was left out: materials and pictures that are named and were not found, or cannot be used, and why.
    """

    colors: Bytes
    places: npt.NDArray[np.float32] | None = None
    pictures: npt.NDArray[np.int16] | None = None
    images: tuple[Picture, ...] = ()
    lost: tuple[str, ...] = ()

    def of(self, corners: Indices) -> Paint:
        """The paint of some corners, in any shape (...)."""
        return Paint(
            self.colors[corners],
            None if self.places is None else self.places[corners],
            None if self.pictures is None else self.pictures[corners],
            self.images,
            self.lost,
        )

    @property
    def is_plain(self) -> bool:
        """Whether all of it is one grey, or white: nobody has chosen that."""
        if self.images or not len(self.colors):
            return not self.images
        colors = self.colors.reshape(-1, 3)
        low, high = colors.min(axis=0), colors.max(axis=0)
        return bool((high == low).all() and int(high.max()) - int(high.min()) <= GREYS)


def as_bytes(values: npt.NDArray[np.generic], most: float | None = None) -> Bytes:
    """Colours (..., 3) in steps of 1/255, of numbers of which one is full; by default what the largest of them tells:
    1, 255 or 65535. Light a little above 1 is cut off."""
    numbers: FloatArray = np.nan_to_num(values.astype(np.float64))
    if most is None:
        largest = numbers.max(initial=0)
        most = next((full for full, bound in ((1, 2), (255, 256)) if largest < bound), 65535)
    parts: FloatArray = np.clip(numbers / most, 0, 1)
    return np.round(parts * 255).astype(np.uint8)


def read_picture(data: bytes) -> Bytes:
    """A picture (h, w, 3), made smaller. Raises ``ValueError``, with what it is instead, if it cannot be used."""
    try:
        with warnings.catch_warnings():
            # of many pixels the library warns by itself
            warnings.simplefilter("ignore")
            image = Image.open(io.BytesIO(data), formats=_FORMATS)
        with image:
            if image.width * image.height > MOST_PIXELS:
                raise Image.DecompressionBombError
            image.draft("RGB", (SIDE, SIDE))
            whole = _in_eight_bits(image).convert("RGB")
        whole.thumbnail((SIDE, SIDE), Image.Resampling.BOX)
        return np.asarray(whole)
    except MemoryError:
        raise
    except Image.DecompressionBombError as error:
        raise ValueError(f"has more than {MOST_PIXELS:,} pixels") from error
    except Exception as error:  # a broken picture can make a decoder fail in any way
        raise ValueError("is no picture that can be read") from error


def _in_eight_bits(image: Image.Image) -> Image.Image:
    """A picture, that of sixteen bits a grey without its lower ones: the library would cut off the upper ones."""
    if image.mode.startswith("I"):
        return Image.fromarray((np.asarray(image) >> 8).astype(np.uint8))
    return image


MISSING = "is not there, lies outside the folder or is too large"
"""Why a file of colours is left out that was not collected with the mesh."""


class Pictures:
    """The pictures of a surface, each unpacked once.

    Attributes
    ----------
    images : list of Picture
    lost : dict of str to None
        What is left out, and why, each once.
    """

    def __init__(self) -> None:
        self.images: list[Picture] = []
        self.lost: dict[str, None] = {}
        self._places: dict[tuple[Hashable, tuple[Wrap, Wrap]], int] = {}
        self._pixels: dict[Hashable, Bytes | None] = {}

    def place(
        self,
        key: Hashable,
        name: str,
        read: Callable[[], bytes | None],
        wraps: tuple[Wrap, Wrap] = ("repeat", "repeat"),
    ) -> int:
        """The place of a picture among ``images``; -1 if it cannot be used.

        Parameters
        ----------
        key : hashable
            What it is known by in its file.
        name : str
            What it is called.
        read : callable
            Gives its content; None if it is not there.
        wraps : (Wrap, Wrap)
            As of :class:`Picture`.
        """
        if (key, wraps) not in self._places:
            self._places[key, wraps] = self._add(key, name, read, wraps)
        return self._places[key, wraps]

    def _add(
        self, key: Hashable, name: str, read: Callable[[], bytes | None], wraps: tuple[Wrap, Wrap]
    ) -> int:
        if len(self.images) == MOST_PICTURES:
            self.lose(name, f"is one more picture than the {MOST_PICTURES} that are shown")
            return -1
        if key not in self._pixels:
            self._pixels[key] = self._read(name, read)
        if (pixels := self._pixels[key]) is None:
            return -1
        self.images.append(Picture(pixels, wraps))
        return len(self.images) - 1

    def _read(self, name: str, read: Callable[[], bytes | None]) -> Bytes | None:
        content = read()
        if content is None:
            self.lose(name, MISSING)
            return None
        try:
            return read_picture(content)
        except ValueError as error:
            self.lose(name, str(error))
            return None

    def miss_places(self, name: str) -> None:
        """A picture is left out, for the surface does not say where it lies on it."""
        self.lose(name, "has no place on the surface, which lacks texture coordinates")

    def lose(self, name: str, why: str) -> None:
        """Something of this name is left out."""
        self.lost[f"{name[:100]} {why}"] = None


def bake(paint: Paint, corners: FloatArray, mesh: Mesh) -> Bytes:
    """The colours at the vertices of a mesh that lies close to a painted surface.

    A vertex has the mean light of its faces, each taken a little inside: on an edge between two colours the closest
    point alone would be of either by chance. Where the surface has two sides in one place, a face has the colour of the
    one that looks where it does.

    Parameters
    ----------
    paint : Paint
        Of the corners (m, 3) of the surface's triangles.
    corners : (m, 3, 3) float64 array
    mesh : Mesh

    Returns
    -------
    (n, 3) uint8 array
        sRGB.
    """
    places = mesh.vertices[mesh.faces]
    inside = places + INWARDS * (places.mean(axis=1, keepdims=True) - places)
    light = _light(paint, corners, inside.reshape(-1, 3), np.repeat(_normals(places), 3, axis=0))
    owners, count = mesh.faces.ravel(), len(mesh.vertices)
    sums = np.stack([np.bincount(owners, channel, count) for channel in light.T], axis=1)
    return from_light(sums / np.maximum(np.bincount(owners, minlength=count), 1)[:, None])


def _light(paint: Paint, corners: FloatArray, points: FloatArray, facing: FloatArray) -> FloatArray:
    """Linear light (n, 3) of a painted surface where it is closest to some points, on the side that faces a way."""
    order = along_curve(corners[:, 0] + corners[:, 1] + corners[:, 2])
    sorted_corners = corners[order]
    closest, place = _find_side(points, facing, sorted_corners)
    weights, used = _weigh(sorted_corners[place], closest), paint.of(order[place])
    light = np.einsum("nc,nca->na", weights, to_light(used.colors))
    if used.places is not None and used.pictures is not None:
        where = np.einsum("nc,nca->na", weights, used.places.astype(np.float64))
        for number, image in enumerate(used.images):
            rows = np.flatnonzero((used.pictures[:, 0] == number) & np.isfinite(where).all(axis=1))
            light[rows] *= _look_up(image, where[rows])
    return light


def _find_side(points: FloatArray, facing: FloatArray, corners: FloatArray) -> tuple[FloatArray, Indices]:
    """As :func:`find_closest`, of triangles (m, 3, 3) sorted along a curve. Where one that faces the other way than it
    should is found, and another lies in the same place that does not, that is taken."""
    closest, place = find_closest(points, corners, box_faces(corners), LEAF)
    normals = _normals(corners)
    away = np.flatnonzero((normals[place] * facing).sum(axis=1) < 0)
    if len(away):
        # raised to the side that it faces, a triangle parts from one that faces the other way
        raised = corners + LIFT * normals[:, None]
        above = closest[away] + LIFT * facing[away]
        found, other = find_closest(above, raised, box_faces(raised), LEAF)
        seen = (normals[other] * facing[away]).sum(axis=1) > 0
        seen &= np.linalg.norm(found - above, axis=1) < LIFT
        closest[away[seen]] = found[seen] - LIFT * normals[other[seen]]
        place[away[seen]] = other[seen]
    return closest, place


def _normals(triangles: FloatArray) -> FloatArray:
    """Unit normals (n, 3) of triangles (n, 3, 3); zero of those without area."""
    crosses = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(crosses, axis=1, keepdims=True)
    return np.asarray(crosses / np.where(lengths > 0, lengths, 1))


def _weigh(triangles: FloatArray, points: FloatArray) -> FloatArray:
    """Weights (n, 3) of the corners of triangles (n, 3, 3) at points (n, 3) on them."""
    first, second = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    offset = points - triangles[:, 0]
    a, b, c = ((x * y).sum(axis=1) for x, y in ((first, first), (first, second), (second, second)))
    d, e = (offset * first).sum(axis=1), (offset * second).sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        weights = np.column_stack([c * d - b * e, a * e - b * d]) / (a * c - b * b)[:, None]
    # a triangle without area has its first corner's colour
    weights = np.clip(np.nan_to_num(weights, nan=0.0, posinf=0.0, neginf=0.0), 0, 1)
    weights = np.column_stack([1 - weights.sum(axis=1), weights])
    return np.clip(weights, 0, 1) / np.clip(weights, 0, 1).sum(axis=1, keepdims=True)


def _look_up(picture: Picture, where: FloatArray) -> FloatArray:
    """Light (n, 3) of a picture at places (n, 2), between its pixels."""
    pixels = picture.pixels
    left, right, right_share = _neighbours(where[:, 0], pixels.shape[1], picture.wraps[0])
    top, bottom, lower_share = _neighbours(where[:, 1], pixels.shape[0], picture.wraps[1])
    upper, lower = (
        _LINEAR[pixels[row, left]] * (1 - right_share) + _LINEAR[pixels[row, right]] * right_share
        for row in (top, bottom)
    )
    return np.asarray(upper * (1 - lower_share) + lower * lower_share)


def _neighbours(places: FloatArray, count: int, wrap: Wrap) -> tuple[Indices, Indices, FloatArray]:
    """The pixels (n,) before and behind places in a row of ``count``, and the share (n, 1) of the latter."""
    match wrap:
        case "repeat":
            within = places % 1
        case "mirror":
            within = 1 - np.abs(places % 2 - 1)
        case "clamp":
            within = np.clip(places, 0, 1)
    place = within * count - 0.5
    first = np.floor(place).astype(np.int64)
    before, behind = (
        pixel % count if wrap == "repeat" else np.clip(pixel, 0, count - 1) for pixel in (first, first + 1)
    )
    return before, behind, (place - first)[:, None]


def _to_srgb(light: FloatArray) -> FloatArray:
    """IEC 61966-2-1."""
    light = np.clip(light, 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def from_light(light: npt.ArrayLike) -> Bytes:
    """sRGB in steps of 1/255 of linear light."""
    return np.round(255 * _to_srgb(np.nan_to_num(np.asarray(light, np.float64)))).astype(np.uint8)


def to_light(colors: Bytes) -> FloatArray:
    """Linear light of sRGB in steps of 1/255."""
    return _LINEAR[colors]


def _linear() -> FloatArray:
    values = np.arange(256) / 255
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


_LINEAR = _linear()
