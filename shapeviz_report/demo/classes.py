"""What a class of the demo database is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from numpy.random import Generator

from shapeviz_report.demo.solids import Solid


@dataclass(frozen=True)
class DemoClass:
    """A class of shapes.

    Attributes
    ----------
    name : str
        Singular, as in the paper; also its folder.
    kinds : tuple of str
        Variants that the shapes of the class take in turn, so that even a few shapes show all of them.
    model : callable
        Draws pose and proportions of one shape of a kind and returns its solid, standing upright
        (z up, facing -y).
    """

    name: str
    kinds: tuple[str, ...]
    model: Callable[[Generator, str], Solid]
