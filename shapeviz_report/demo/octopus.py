"""Octopuses: a mantle with large eyes above eight curling arms."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import Solid, attach, ball, blend, cone, ellipsoid, tube, turn, unite
from shapeviz_report.types import FloatArray

_KINDS = ("rest", "swim", "curl", "reach")
_STEPS = 20


def _arm(rng: Generator, kind: str, azimuth: float, length: float) -> FloatArray:
    """Centre line (_STEPS + 1, 3): its slope and heading are smooth functions of the arc length."""
    s = np.linspace(0, 1, _STEPS)
    sway = rng.uniform(-1, 1)
    heading = azimuth + np.radians(26 * sway * np.sin(2.2 * np.pi * s * rng.uniform(0.8, 1.1)) * s)
    settle = np.clip(s / 0.38, 0, 1)
    smooth = settle * settle * (3 - 2 * settle)
    if kind == "swim":
        slope = np.radians(rng.uniform(-62, -40) + 34 * np.sin(np.pi * s * rng.uniform(0.9, 1.5)))
        return _integrate(heading, slope, azimuth, length)
    curl = {"rest": rng.uniform(20, 120), "curl": rng.uniform(190, 330), "reach": rng.uniform(0, 90)}[kind]
    start = rng.uniform(-46, -34)
    slope = start * (1 - smooth) + curl * np.clip((s - 0.5) / 0.5, 0, 1) ** 1.6
    if kind == "reach" and rng.uniform() < 0.4:  # some arms are lifted
        slope = -30 + (rng.uniform(70, 110)) * smooth - 150 * np.clip((s - 0.55) / 0.45, 0, 1) ** 1.5
    return _integrate(heading, np.radians(slope), azimuth, length)


def _integrate(heading: FloatArray, slope: FloatArray, azimuth: float, length: float) -> FloatArray:
    steps = np.stack(
        [np.cos(slope) * np.cos(heading), np.cos(slope) * np.sin(heading), np.sin(slope)], axis=1
    )
    start = np.array([0.26 * np.cos(azimuth), 0.26 * np.sin(azimuth), 0.02])
    return start + np.concatenate([np.zeros((1, 3)), np.cumsum(steps * length / _STEPS, axis=0)])


def _octopus(rng: Generator, kind: str) -> Solid:
    tall = rng.uniform(0.85, 1.25)
    wide = rng.uniform(0.92, 1.10)
    lean = turn((1, 0, 0), rng.uniform(-26, 4))
    head = ellipsoid((0, 0, 0.22), (0.40 * wide, 0.38 * wide, 0.36))
    top = lean @ np.array([0, 0, 0.62 * tall]) + [0, 0, 0.18]
    mantle = ellipsoid(top, (0.50 * wide, 0.50 * wide, 0.58 * tall), lean.T)
    body = blend(head, mantle, radius=0.25)
    arms = []
    length = rng.uniform(1.35, 1.75)
    for i in range(8):
        azimuth = 2 * np.pi * (i + 0.5) / 8 + rng.normal(0, 0.05)
        line = _arm(rng, kind, azimuth, length * rng.uniform(0.92, 1.08))
        fraction = np.linspace(0, 1, _STEPS + 1)
        radii = 0.15 * (1 - fraction) ** 0.9 + 0.056
        arms.append(unite(*(cone(line[k], line[k + 1], radii[k], radii[k + 1]) for k in range(_STEPS))))
    siphon = tube([(0.0, -0.30, 0.12), (0, -0.50, 0.10)], [0.11, 0.09], 2)
    figure = blend(attach(body, *arms, radius=0.16), siphon, radius=0.06)
    eyes = []
    for side in (1, -1):
        brow = np.array([0.27 * side * wide, -0.30 * wide, 0.38])
        figure = blend(figure, ball(brow, 0.15), radius=0.10)
        eyes.append(ball(brow + [0.05 * side, -0.10, 0.03], 0.105))
    return unite(figure, *eyes)


OCTOPUS = DemoClass("octopus", _KINDS, _octopus)
