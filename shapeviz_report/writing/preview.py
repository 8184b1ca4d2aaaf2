"""The picture that stands for the site where somebody shares its address."""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from shapeviz_report import charts
from shapeviz_report.pages.base import class_names
from shapeviz_report.types import FloatArray, Report

WIDTH, HEIGHT = 1200, 630
"""Pixels: the size that previews of links are made for."""

_GROUND = "#faf8f4"
_MARGIN = 16
_MOST_PICTURES = 90
_DOT = 3.5
_APART = 0.75  # thumbnails have an empty margin


def draw_preview(report: Report) -> bytes:
    """The shapes as pictures at their places on the first map, as PNG; those that would cover another are dots in the
    colour of their class. The same report gives the same bytes."""
    projection, _ = next(iter(report.projections.values()))
    side = int(np.clip(np.sqrt(WIDTH * HEIGHT / min(len(report.shapes), _MOST_PICTURES)) * 0.95, 84, 300))
    centres = _place(projection.xy, side)
    shown = _apart(centres, side, _order(report.labels))
    colors = _colors(report)
    image = Image.new("RGB", (WIDTH, HEIGHT), _GROUND)
    pen = ImageDraw.Draw(image)
    for (x, y), label in zip(centres, report.labels, strict=True):
        pen.ellipse((x - _DOT, y - _DOT, x + _DOT, y + _DOT), fill=colors[label])
    for row in shown:
        with Image.open(io.BytesIO(report.thumbnails[row])) as thumbnail:
            picture = thumbnail.convert("RGBA").resize((side, side), Image.Resampling.LANCZOS)
        corner = (round(centres[row, 0] - side / 2), round(centres[row, 1] - side / 2))
        image.paste(picture, corner, picture)
    file = io.BytesIO()
    # A palette of 256 colours is hardly seen on clay, and a third of the size.
    image.quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(
        file, "PNG", optimize=True
    )
    return file.getvalue()


def _place(xy: FloatArray, side: int) -> FloatArray:
    """The map stretched over the picture, so that all of every thumbnail is in it."""
    low, high = xy.min(axis=0), xy.max(axis=0)
    extent = np.where(high > low, high - low, 1.0)
    share = np.where(high > low, (xy - low) / extent, 0.5)
    share[:, 1] = 1 - share[:, 1]
    edge = _MARGIN + side / 2
    return edge + share * (np.array([WIDTH, HEIGHT]) - 2 * edge)


def _order(labels: Sequence[str | None]) -> list[int]:
    """The rows of the first shape of every class, then those of the second, and so on."""
    met = Counter[str | None]()
    turns = []
    for row, label in enumerate(labels):
        turns.append((met[label], row))
        met[label] += 1
    return [row for _, row in sorted(turns)]


def _apart(centres: FloatArray, side: int, order: Sequence[int]) -> list[int]:
    """Shapes whose pictures hardly touch: who comes first has the place."""
    taken: list[int] = []
    for row in order:
        if all(np.abs(centres[other] - centres[row]).max() >= _APART * side for other in taken):
            taken.append(row)
    return taken


def _colors(report: Report) -> dict[str | None, str]:
    """The colour of every class, and of shapes without one."""
    theme = charts.THEMES[0]
    classes = class_names(report)
    indices = charts.class_color_indices(len(classes))
    return {None: theme.unlabelled} | {
        name: theme.classes[index] for name, index in zip(classes, indices, strict=True)
    }
