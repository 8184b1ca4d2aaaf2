"""Pliers: two levers crossing at a pivot, opened by some angle."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import (
    Solid,
    blend,
    extrude,
    frame,
    revolve,
    spline,
    tube,
    turn,
    unite,
)
from shapeviz_report.types import FloatArray

# Right half of the closed jaw as (x, z) seen from the front, the pivot at the origin; x = 0 is the grip.
_JAWS = {
    "combination": [(0.30, 0.10), (0.34, 0.45), (0.30, 0.85), (0.22, 1.20), (0.10, 1.28)],
    "needle": [(0.28, 0.08), (0.28, 0.40), (0.21, 0.95), (0.15, 1.50), (0.09, 1.95)],
    "cutter": [(0.34, 0.10), (0.46, 0.38), (0.40, 0.66), (0.24, 0.84), (0.07, 0.92)],
    "pincer": [(0.30, 0.10), (0.62, 0.42), (0.66, 0.78), (0.44, 1.08), (0.08, 1.18)],
}


def _disc(radius: float, half_height: float, rounding: float) -> FloatArray:
    """Profile of a round plate with rounded rim, about the origin."""
    angles = np.linspace(0, np.pi / 2, 5)
    x, z = radius - rounding + rounding * np.cos(angles), half_height - rounding + rounding * np.sin(angles)
    quarter = np.stack([x, z], axis=1)
    return np.concatenate([[[0, -half_height]], quarter[::-1] * [1, -1], quarter, [[0, half_height]]])


def _plier(rng: Generator, kind: str) -> Solid:
    jaw = spline(np.array(_JAWS[kind]) * [rng.uniform(0.92, 1.1), rng.uniform(0.85, 1.15)], 16)
    hollow = 0.30 if kind == "pincer" else 0.0
    inner_x = hollow * np.sin(np.linspace(np.pi, 0, 9)) ** 0.8
    inner = np.stack([inner_x, np.linspace(jaw[-1, 1], 0.12, 9)], axis=1)
    outline = np.concatenate([[[0.0, -0.22], [0.24, -0.22]], jaw, inner])
    opening = rng.uniform(14, 46) if kind != "needle" else rng.uniform(10, 34)
    thick = rng.uniform(0.13, 0.16)
    length = rng.uniform(2.0, 2.8)
    spread = rng.uniform(0.42, 0.62)
    bow = rng.uniform(0.02, 0.16)
    grip = rng.uniform(0.155, 0.19)
    handle = np.array(
        [
            [0.06, 0, 0.0],
            [-0.16, 0, -0.30],
            [-spread * 0.86 - bow, 0, -0.38 * length],
            [-spread - bow, 0, -0.68 * length],
            [-spread + 0.02, 0, -length],
        ]
    )
    levers = []
    for side in (1.0, -1.0):
        mirrored = np.array([side, 1.0, 1.0])
        tilt = turn((0, 1, 0), side * opening / 2)
        axes = np.array([[side, 0, 0], [0, 0, 1], [0, 1, 0]]) @ tilt.T
        plate = extrude(outline, thick, 0.06, axes=axes)
        points = (handle * mirrored) @ tilt.T
        radii = [0.20, 0.19, grip, 1.12 * grip, 0.95 * grip]
        levers.append(blend(plate, tube(points, radii, 16, 0.82, (0, 1, 0)), radius=0.12))
    pivot = revolve(_disc(0.36, thick + 0.035, 0.06), axes=frame((0, 1, 0)))
    bolt = revolve(_disc(0.17, thick + 0.11, 0.05), axes=frame((0, 1, 0)))
    return unite(blend(pivot, bolt, radius=0.03), *levers)


PLIER = DemoClass("plier", tuple(_JAWS), _plier)
