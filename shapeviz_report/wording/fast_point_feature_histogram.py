"""How the surface around a point lies to it."""

from __future__ import annotations

import numpy as np

from shapeviz_report.wording.base import Said, Wording, amount, as_percent, span

COUNT = 33


def _degrees(dimension: int) -> tuple[int, int, int]:
    """Which angle a dimension counts, on which side of the middle (-1, 0, 1), and between which degrees."""
    angle, place = divmod(dimension, 11)
    ends = np.arange(place, place + 2) / 11 * 2 - 1
    near, far = np.sort(np.abs(180 * ends if angle == 2 else np.degrees(np.arcsin(ends)))).round().astype(int)
    return angle, near, far


def _side(dimension: int) -> int:
    return int(np.sign(dimension % 11 - 5))


def _name_part(dimension: int) -> str:
    """How the neighbouring surface that a dimension counts lies."""
    angle, near, far = _degrees(dimension)
    side = _side(dimension)
    if angle == 0:
        return (
            f"twisted {'right' if side > 0 else 'left'} by {near} to {far}°"
            if side
            else f"untwisted within {far}°"
        )
    if angle == 1:
        return (
            f"{'rising' if side > 0 else 'dropping'} by {near} to {far}°" if side else f"level within {far}°"
        )
    return f"{'rounded' if side > 0 else 'hollow'} by {near} to {far}°" if side else f"straight within {far}°"


def _look_for(dimension: int) -> str:
    """Words for surface that is mostly as a dimension counts it."""
    angle, side = dimension // 11, _side(dimension)
    if angle == 0:
        return "twisted leaning skewed" if side else "even"
    if side == 0:
        return "flat even smooth"
    # What falls off around a point, or turns outwards, is round.
    return "round rounded convex edge bent" if (side > 0) == (angle == 2) else "hollow concave groove bent"


def _say(dimension: int, low: float | None, high: float | None) -> Said:
    part = _name_part(dimension)
    return Said(
        f"surroundings {part}: {span(low, high, '%')}", f"has {amount(low, high)} its surroundings {part}"
    )


def _word_bin(dimension: int) -> str:
    """The neighbours that a dimension counts."""
    angle, near, far = _degrees(dimension)
    side = _side(dimension)
    if angle == 0:
        way = "right" if side > 0 else "left"
        which = (
            f"whose normal leans to the {way} by {near} to {far}°"
            if side
            else f"whose normal leans sideways by less than {far}°"
        )
    elif angle == 1:
        way = "above" if side > 0 else "below"
        which = f"that lie {near} to {far}° {way}" if side else f"that lie within {far}° of"
        which += " the tangent plane"
    else:
        way = "outwards" if side > 0 else "inwards"
        which = (
            f"whose normal turns {way} by {near} to {far}°"
            if side
            else f"whose normal turns by less than {far}°"
        )
    return f"the share of neighbouring points {which}"


FAST_POINT_FEATURE_HISTOGRAM = Wording(
    aspect="wider bends",
    topics=tuple(
        f"share of the surface around a point {_name_part(dimension)}" for dimension in range(COUNT)
    ),
    quantities=tuple(_word_bin(dimension) for dimension in range(COUNT)),
    unit="%",
    shown=as_percent,
    low="places with few such neighbours",
    high="places with many such neighbours",
    sought=tuple(("", _look_for(dimension)) for dimension in range(COUNT)),
    ease=1,
    say=_say,
)
