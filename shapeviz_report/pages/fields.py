"""What the shapes of a database can be grouped, filtered and sorted by: labels, metadata, and facts of the meshes."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Sequence
from datetime import date
from itertools import pairwise
from typing import Any

import numpy as np

from shapeviz_report.order import natural
from shapeviz_report.pages.base import class_names, kind_of_group, map_title, stand_in
from shapeviz_report.pages.chunks import Field
from shapeviz_report.types import Clusters, FloatArray, Report, ShapeFacts

#: Most values of a column that still says what kind of shape one is; beyond, it names them, and is only searched.
MOST_VALUES = 1000

#: Shapes that a value of such a column stands for, on average, at the least.
FEWEST_SHAPES_A_VALUE = 1.5

#: Different numbers up to which a reader picks single ones; more of them are a range.
FEW_NUMBERS = 8

#: Most intervals that a range is cut into.
MOST_INTERVALS = 24

#: High over low from which a range of positive numbers is cut by factors and no longer by differences.
WIDE = 200

#: Digits of a number. More than a reader compares, and few enough to load quickly.
DIGITS = 6

#: What is measured of every mesh: key, title, unit.
_FACTS: tuple[tuple[str, str, str, Callable[[ShapeFacts], float | None]], ...] = (
    ("faces", "Faces", "", lambda facts: facts.faces_read),
    ("area", "Area", "file’s units²", lambda facts: facts.area),
    ("volume", "Volume", "file’s units³", lambda facts: facts.volume),
    ("side", "Longest side", "file’s units", lambda facts: max(facts.extents)),
    ("parts", "Parts", "", lambda facts: facts.components),
)

#: The day that dates are counted from, as browsers do.
_FIRST_DAY = date(1970, 1, 1).toordinal()

#: Months between the edges of dates.
_MONTHS = (1, 2, 3, 6, *(12 * step * power for power in (1, 10, 100, 1000) for step in (1, 2, 5)))

_DATE = re.compile(r"(\d{4})-(\d{2})(?:-(\d{2})(?:[T ].*)?)?", re.ASCII)
_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?", re.ASCII)


def describe_fields(report: Report) -> list[Field]:
    """Everything that shapes can be grouped, filtered or sorted by: the labelings, the active one first; the columns of
    metadata; what was measured."""
    labelings = report.database.labelings
    columns = {name: [shape.labels.get(name) for shape in report.shapes] for name in labelings}
    if report.labeling is not None:
        columns = {report.labeling: list(report.labels), **columns}
    found = [_column(f"label:{name}", name, values) for name, values in columns.items()]
    if report.labeling is not None:
        found[0] = _active(report)
    for name in dict.fromkeys(name for shape in report.shapes for name in shape.metadata):
        values = [shape.metadata.get(name) for shape in report.shapes]
        if values != columns.get(name):
            found.append(_column(f"column:{name}", name, values))
    if report.clusters is not None and not stand_in(report):
        found.append(_clusters(report.clusters))
    if report.copies:
        copied = {shape for copy in report.copies for shape in (copy.first, copy.second)}
        has = ["has copies" if shape.id in copied else "no copies" for shape in report.shapes]
        found.append(_choices("copies", "Copies", has))
    for key, title, unit, measure in _FACTS:
        found.append(_numbers(f"fact:{key}", title, [measure(facts) for facts in report.facts], unit))
    tight = ["watertight" if facts.watertight else "open" for facts in report.facts]
    found.append(_column("fact:watertight", "Surface", tight))
    return [field for field in found if field is not None]


def _active(report: Report) -> Field:
    """The active labels: classes, or the clusters that stand in for them; always a field, whatever they are."""
    field = _choices(f"label:{report.labeling}", kind_of_group(report).capitalize(), report.labels)
    field["active"] = True
    if report.clusters is not None and stand_in(report):
        notes = _notes(report.clusters)
        field["notes"] = [notes[name] for name in field["names"] or ()]
    return field


def _clusters(clusters: Clusters) -> Field:
    """The clusters of a database with labels of its own, the largest first as they come."""
    notes = _notes(clusters)
    field = _field("cluster", "Cluster")
    field["names"] = list(notes)
    field["of"] = clusters.of.astype(np.int32)
    field["notes"] = list(notes.values())
    return field


def _notes(clusters: Clusters) -> dict[str, str]:
    """The name of every cluster, and what is most typical of it."""
    return {cluster.name: next(iter(cluster.typical), "") for cluster in clusters.clusters}


def _choices(
    key: str, title: str, values: Sequence[str | None], order: Callable[[str], tuple[Any, ...]] = natural
) -> Field:
    """A field of few values."""
    field = _field(key, title)
    names = sorted({value for value in values if value}, key=order)
    number = {name: index for index, name in enumerate(names)}
    field["names"] = names
    field["of"] = np.array([number[value] if value else -1 for value in values], np.int32)
    return field


def _column(key: str, title: str, values: Sequence[str | None]) -> Field | None:
    """A column of text as a field; None where it tells no shapes apart, or every shape from all others."""
    counts = Counter(value for value in values if value)
    differs = len(counts) > 1 or (len(counts) == 1 and counts.total() < len(values))
    few = len(counts) <= MOST_VALUES and counts.total() >= FEWEST_SHAPES_A_VALUE * len(counts)
    days = None if len(counts) < 2 else _as_days(values)
    numbers = days if days is not None or len(counts) < 2 else _as_numbers(values)
    if not differs or not (few or numbers is not None):
        return None
    order = natural if numbers is None or days is not None else _as_number
    field = _choices(key, title, values, order) if few else _field(key, title)
    if numbers is not None:
        known = [number for number in numbers if number is not None]
        edges = _edges(known) if days is None else _date_edges(known)
        field["date"] = days is not None
        field["numbers"] = _rounded(numbers)
        field["edges"] = edges if len(counts) > FEW_NUMBERS else None
    return field


def _numbers(key: str, title: str, values: Sequence[float | None], unit: str) -> Field | None:
    """A measured number as a field; None where it is the same for all shapes."""
    different = {value for value in values if value is not None}
    if len(different) < 2:
        return None
    field = _field(key, title, unit)
    field["numbers"], field["edges"] = _rounded(values), _edges(sorted(different))
    return field


def _field(key: str, title: str, unit: str = "") -> Field:
    return Field(
        key=key,
        title=title,
        unit=unit,
        active=False,
        date=False,
        names=None,
        of=None,
        notes=None,
        numbers=None,
        edges=None,
    )


def _as_number(value: str) -> tuple[float, str]:
    """A key that sorts texts of numbers by the numbers."""
    return float(value), value


def _as_numbers(values: Sequence[str | None]) -> list[float | None] | None:
    """A column's numbers; None if one of its values is none."""
    if any(value and not _NUMBER.fullmatch(value) for value in values):
        return None
    numbers = [float(value) if value else None for value in values]
    return None if any(number is not None and math.isinf(number) for number in numbers) else numbers


def _as_days(values: Sequence[str | None]) -> list[float | None] | None:
    """The days of a column of ISO dates, counted from the first of 1970; None if one of its values is no date."""
    days: list[float | None] = []
    for value in values:
        found = _DATE.fullmatch(value) if value else None
        try:
            day = (
                date(*(int(part or 1) for part in found.groups())).toordinal() - _FIRST_DAY if found else None
            )
        except ValueError:
            return None
        if value and day is None:
            return None
        days.append(day)
    return days


def _date_edges(days: Sequence[float]) -> list[float] | None:
    """The beginnings of months or of years that cut a range of days into at most ``MOST_INTERVALS`` intervals."""
    low, high = (date.fromordinal(int(day) + _FIRST_DAY) for day in (min(days), max(days)))
    first, last = 12 * low.year + low.month - 1, 12 * high.year + high.month - 1
    for step in _MONTHS:
        edges = range(first - first % step, last + step + 1, step)
        if len(edges) <= MOST_INTERVALS and edges[0] >= 12 and edges[-1] < 12 * 9999:
            return [float(date(month // 12, month % 12 + 1, 1).toordinal() - _FIRST_DAY) for month in edges]
    return None


def _rounded(numbers: Sequence[float | None]) -> FloatArray:
    return np.array([np.nan if number is None else _round(number) for number in numbers])


def _round(number: float) -> float:
    return float(f"{number:.{DIGITS}g}")


def _edges(numbers: Sequence[float]) -> list[float] | None:
    """Round numbers that cut a range into at most ``MOST_INTERVALS`` intervals.

    Returns
    -------
    list of float, or None
        They rise, and the first and last enclose all numbers as they are rounded. None where no round numbers do:
        far from 0, and close together.
    """
    rounded = [_round(number) for number in numbers]
    low, high = min(rounded), max(rounded)
    edges = _factors(low, high) if low > 0 and high / WIDE >= low else _steps(low, high)
    rises = all(left < right for left, right in pairwise(edges))
    return edges if len(edges) > 2 and rises and edges[0] <= low and edges[-1] >= high else None


def _steps(low: float, high: float) -> list[float]:
    """Edges at multiples of 1, 2 or 5 times a power of ten."""
    least = high / MOST_INTERVALS - low / MOST_INTERVALS
    if least <= 0 or math.isinf(least):
        return []
    power = 10.0 ** math.floor(math.log10(least))
    # One interval may be lost at each end to rounding outwards.
    for step in (power, 2 * power, 5 * power, 10 * power, 20 * power):
        first, last = math.floor(low / step), math.ceil(high / step)
        if last - first <= MOST_INTERVALS:
            return [float(f"{number * step:.12g}") for number in range(first, last + 1)]
    return []


def _factors(low: float, high: float) -> list[float]:
    """Edges at 1, 2 and 5 times the powers of ten, at the powers alone, or at every second, third, ... power."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    stride = math.ceil((last - first) / MOST_INTERVALS)
    for digits in ((1, 1.5, 2, 3, 5, 7), (1, 2, 5), (1, 3), (1,)):
        edges = [
            float(f"{digit}e{power}") for power in range(first, last + stride, stride) for digit in digits
        ]
        below = [edge for edge in edges if edge <= low]
        above = [edge for edge in edges if edge >= high]
        inner = [edge for edge in edges if low < edge < high]
        if below and above and len(inner) < MOST_INTERVALS:
            return [below[-1], *inner, above[0]]
    return []


def color_choices(report: Report) -> list[tuple[str, list[tuple[str, str]]]]:
    """What else than the active labels a map can be coloured by: keys and titles, in groups with a title."""
    fields = [field for field in describe_fields(report) if not field["active"]]
    of_meshes = [field for field in fields if field["key"].startswith("fact:")]
    given = [field for field in fields if field not in of_meshes]
    hits = [(f"nh:{method}", f"on the {map_title(method)} map") for method in report.projections]
    groups = [
        ("Known of the shapes", [(field["key"], field["title"]) for field in given]),
        ("Measured of the meshes", [(field["key"], field["title"]) for field in of_meshes]),
        ("Fit (NH)", hits if len(class_names(report)) > 1 else []),
        ("Neighbours on the map in view", _neighbours(report)),
        ("Features", [("bin:", "A bin …")]),
    ]
    return [(title, choices) for title, choices in groups if choices]


def _neighbours(report: Report) -> list[tuple[str, str]]:
    """What says of each shape how truly a map shows its neighbours."""
    found = next(iter(report.faithfulness.values()), None)
    weighed = [("map:false", "False neighbours"), ("map:missing", "Missing neighbours")]
    if found is None:
        return []
    return [("map:kept", "Neighbours kept"), *(weighed if found.false is not None else ())]
