"""What is said of the values of a descriptor, and how numbers stand in it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from shapeviz_report.types import FloatArray


class Said(NamedTuple):
    """A range of values in plain words.

    Attributes
    ----------
    name : str
        In few words, as it stands beside the name of a bin: "thickness 0.2 to 0.3".
    clause : str
        What a part of the surface does or is, as it stands after "28 % of the surface": "is thicker than 0.4 radii".
    trend : str
        What a stranger sees of a shape that has more of it, as it stands before "in bird than in fish": "bodies are
        thicker". Empty where the clause says it all.
    fewer : bool
        Whether the trend is that there is less of something: then it is of what lies beyond the range, and so are its
        figures where any are told.
    """

    name: str
    clause: str
    trend: str = ""
    fewer: bool = False


@dataclass(frozen=True)
class Wording:
    """The words for a descriptor's values.

    Attributes
    ----------
    aspect : str
        What the descriptor looks at, as it stands in "alike in ... and ...": one thing, without an "and" of its own.
    topics : tuple of str
        What the value in each dimension is, in few words.
    quantities : tuple of str
        What it is exactly, as it stands in "where ... is from 1.4 to 1.6".
    unit : str
        Of the values as they are shown, as it follows a number: a word, ``°``, ``%``, or empty.
    shown : callable
        Values as a reader reads them, from values as they are computed; rising.
    low, high : str
        Where on a shape, or in what surroundings, small and large values are found.
    sought : tuple of pairs of str
        Other words by which readers may look for small and for large values of each dimension.
    ease : float
        How easily a stranger pictures the surface that a bin counts from its plain words: as often counts a difference
        in it where it is chosen what is told first. From 1, which is not at all.
    say : callable
        ``(dimension, low, high) -> Said`` of the values from ``low`` to ``high`` as they are shown; None for no limit.
    """

    aspect: str
    topics: tuple[str, ...]
    quantities: tuple[str, ...]
    unit: str
    shown: Callable[[FloatArray], FloatArray]
    low: str
    high: str
    sought: tuple[tuple[str, str], ...]
    ease: float
    say: Callable[[int, float | None, float | None], Said]

    rooted = False


@dataclass(frozen=True)
class GlobalWording:
    """The words for the values of a global descriptor.

    Attributes
    ----------
    aspect : str
        What it looks at, as it stands in "alike in ... and ...".
    names : tuple of str
        What each value is, in few words, as it stands before "is higher in bird than in fish".
    quantities : tuple of str
        What it is exactly, as it stands after "The value is".
    seek : callable
        From the number of a value, other words by which readers may look for it, whatever its size.
    rooted : bool
        Whether the values are square roots of shares: readers are told the shares, in per cent.
    """

    aspect: str
    names: tuple[str, ...]
    quantities: tuple[str, ...]
    seek: Callable[[int], str]
    rooted: bool = False

    low = ""
    high = ""
    ease = 1.0

    @property
    def sought(self) -> tuple[tuple[str, str], ...]:
        """Other words for small and for large values of each, as :class:`Wording` has them: the same for both."""
        return tuple((self.seek(number),) * 2 for number in range(len(self.names)))


AXES = ("longest", "middle", "shortest")
"""The axes of a shape."""

ENDS = ("end", "narrow side", "broad side")
"""What of a shape one sees who looks along each axis."""


def count_waves(number: int) -> str:
    """Some waves in words: "1 wave", "2 waves"."""
    return f"{number} wave" if number == 1 else f"{number} waves"


def list_waves(waves: tuple[int, int]) -> Iterator[tuple[int, int]]:
    """The waves of a spectrum in the order of its values: (in its rows, in its columns)."""
    return product(range(waves[0]), range(waves[1]))


def name_waves_around(waves: tuple[int, int]) -> Iterator[str]:
    """Where around each axis a panorama measures, in few words: a wave has as many crests as there are such places."""
    for axis in AXES:
        for along, around in list_waves(waves):
            sides = f"on {'one side' if around == 1 else f'{around} sides'} of the {axis} axis"
            places = f"at {'one place' if along == 1 else f'{along} places'} along"
            if around:
                yield f"{sides}, {places} it" if along else sides
            else:
                yield f"{places} the {axis} axis" if along else f"around the {axis} axis on average"


def place_waves_around(waves: tuple[int, int]) -> Iterator[str]:
    """The same, exactly."""
    for axis in AXES:
        for along, around in list_waves(waves):
            own = f"strength of {count_waves(around)} around the {axis} axis and {along} along it"
            yield own if around or along else f"mean around the {axis} axis"


def name_waves_across(waves: tuple[int, int]) -> Iterator[str]:
    """How an image along an axis repeats, in few words: " (2 parts across, 1 up)"; nothing for the mean."""
    for up, across in list_waves(waves):
        parts = [f"{across} {'part' if across == 1 else 'parts'} across"] if across else []
        unit = "" if across else " part" if up == 1 else " parts"
        parts += [f"{up}{unit} up"] if up else []
        yield f" ({', '.join(parts)})" if parts else ""


def place_waves_across(axis: int, waves: tuple[int, int]) -> Iterator[str]:
    """The same, exactly: across is along the axis that follows, up along the one after it."""
    across_axis, up_axis = AXES[(axis + 1) % 3], AXES[(axis + 2) % 3]
    for up, across in list_waves(waves):
        own = (
            f"strength of {count_waves(across)} along the {across_axis} axis and {up} along the {up_axis} one"
        )
        yield own if across or up else "mean"


def as_degrees(radians: FloatArray) -> FloatArray:
    """Radians in degrees."""
    return np.degrees(radians)


def as_percent(shares: FloatArray) -> FloatArray:
    """Fractions of 1 in per cent."""
    return 100 * shares


def as_slope(sines: FloatArray) -> FloatArray:
    """The angles of some sines, in degrees."""
    return np.degrees(np.arcsin(np.clip(sines, -1, 1)))


def span(low: float | None, high: float | None, unit: str = "") -> str:
    """A range in short: "under 0.1", "0.1 to 0.2", "over 0.9"."""
    if low is None:
        return f"under {measure(high or 0, unit)}"
    if high is None:
        return f"over {measure(low, unit)}"
    first, last = _both(low, high)
    return f"{first} to {last}{_attached(unit)}"


def measure(value: float, unit: str = "") -> str:
    """A number with two digits and its unit; whole from 10 on."""
    return f"{_digits(value, 2)}{_attached(unit)}"


def radii(value: float) -> str:
    """A length of a shape that reaches as far as one radius from its middle."""
    text = measure(value)
    return f"{text} radius" if text == "1" else f"{text} radii"


def percent(share: float, more: int = 0) -> str:
    """A share in per cent, short, with more digits where asked, as ``percent`` of ``base/words.js`` tells it."""
    value = round(100 * share, 4) + 0.0  # what sums of floats miss is nothing, and has no sign
    least = 10.0 ** -(more + 1)
    if 0 < value < least / 2:
        return f"<{least:g}\u00a0%"
    return f"{value:.{more if value == 0 or value >= 9.95 else more + 1}f}\u00a0%"


def percents(first: float, second: float) -> tuple[str, str]:
    """Two shares in per cent, with as many digits as tell them apart, but two more at most."""
    for more in range(3):
        told = percent(first, more), percent(second, more)
        if told[0] != told[1]:
            break
    return told


def amount(low: float | None, high: float | None) -> str:
    """How much a share is, in per cent: "hardly any of", "more than 64 % of"."""
    if low is None:
        return "hardly any of" if (high or 0) <= 1.1 else f"less than {measure(high or 0, '%')} of"
    return f"more than {measure(low, '%')} of" if high is None else f"{span(low, high, '%')} of"


def say_more(own: str, other: str, reach: float, half: float) -> tuple[str, bool]:
    """What there is more of at one end of a scale; where more than half of it is meant, what there is less of.

    ``own`` and ``other`` say what the surface does there, as they stand after "more surface". The answer is a trend,
    and whether there is less.
    """
    return (f"more surface {own}", False) if reach < half else (f"less surface {other}", True)


def _both(low: float, high: float) -> tuple[str, str]:
    """Both ends of a range, with as many digits as tell them apart."""
    for digits in (2, 3, 4, 6):
        ends = _digits(low, digits), _digits(high, digits)
        if ends[0] != ends[1]:
            break
    return ends


def _digits(value: float, digits: int) -> str:
    text = f"{value:.0f}" if abs(value) >= 10 ** (digits - 1) else f"{float(f'{value:.{digits}g}'):g}"
    return text.replace("-", "−")


def _attached(unit: str) -> str:
    # A number and its unit stay in one line.
    return f"\u00a0{unit}" if unit and unit != "°" else unit
