"""The contract of a global descriptor."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from shapeviz_report.global_descriptors.posed_shape import PosedShape
from shapeviz_report.types import FloatArray


@dataclass(frozen=True)
class GlobalDescriptor:
    """A descriptor of a whole shape: values that belong to no vertex.

    Attributes
    ----------
    name : str
        Short name; begins the names of its columns.
    title : str
        Its full name.
    measures : str
        What it measures, in a sentence that needs no mathematics.
    width : int
        Number of values.
    compute : callable
        ``PosedShape -> (width,)`` float64 array, finite for every shape. Euclidean distance compares the values.
    """

    name: str
    title: str
    measures: str
    width: int
    compute: Callable[[PosedShape], FloatArray]
