"""Fish: a bending body of many profiles, with fins, eyes and mouth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from scipy.interpolate import PchipInterpolator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import (
    Solid,
    attach,
    ball,
    blade,
    blend,
    carve,
    ellipsoid,
    extrude,
    spline,
    tube,
    unite,
)
from shapeviz_report.types import FloatArray


@dataclass(frozen=True)
class _Build:
    """Proportions; the body is two units long, the nose at y = -1."""

    depth: tuple[float, ...]  # half height at seven places from nose to tail
    flat: float  # width over height
    tail: tuple[float, float, float]  # half height, length, depth of the fork (0 round, 1 deep)
    dorsal: tuple[float, float, float, float]  # start, end (share of the body), height, sweep
    anal: tuple[float, float, float, float]
    pectoral: float


_BUILDS = {
    "trout": _Build(
        (0.07, 0.21, 0.29, 0.30, 0.25, 0.16, 0.095),
        0.62,
        (0.34, 0.42, 0.5),
        (0.40, 0.60, 0.19, 0.12),
        (0.60, 0.76, 0.20, 0.10),
        0.28,
    ),
    "goldfish": _Build(
        (0.10, 0.32, 0.44, 0.46, 0.36, 0.21, 0.11),
        0.66,
        (0.52, 0.72, 0.7),
        (0.28, 0.70, 0.30, 0.18),
        (0.56, 0.76, 0.30, 0.22),
        0.42,
    ),
    "angel": _Build(
        (0.09, 0.38, 0.60, 0.66, 0.54, 0.28, 0.12),
        0.32,
        (0.36, 0.44, 0.2),
        (0.32, 0.76, 0.72, 0.46),
        (0.40, 0.76, 0.72, 0.46),
        0.30,
    ),
    "tuna": _Build(
        (0.05, 0.22, 0.31, 0.31, 0.23, 0.12, 0.065),
        0.78,
        (0.50, 0.34, 1.0),
        (0.34, 0.46, 0.24, 0.18),
        (0.58, 0.70, 0.26, 0.18),
        0.30,
    ),
    "puffer": _Build(
        (0.14, 0.42, 0.56, 0.56, 0.42, 0.22, 0.12),
        0.92,
        (0.26, 0.40, 0.0),
        (0.60, 0.76, 0.26, 0.12),
        (0.62, 0.76, 0.22, 0.12),
        0.36,
    ),
    "shark": _Build(
        (0.05, 0.16, 0.24, 0.25, 0.19, 0.11, 0.06),
        0.92,
        (0.46, 0.42, 0.8),
        (0.34, 0.52, 0.40, 0.20),
        (0.70, 0.80, 0.16, 0.10),
        0.42,
    ),
}
_THICK = 0.042


def _fish(rng: Generator, kind: str) -> Solid:
    build = _BUILDS[kind]
    depth = np.array(build.depth) * rng.uniform(0.92, 1.10)
    bend = rng.uniform(-0.34, 0.34)
    wave = rng.uniform(-0.12, 0.12)

    def spine(y: float) -> FloatArray:
        """The body's axis: straight at the head, swept aside towards the tail."""
        s = (y + 1) / 2
        return np.array([bend * s * s + wave * np.sin(2 * np.pi * s) * s, y, 0.0])

    def axes(y: float) -> FloatArray:
        """Rows: backwards along the spine, up, and sideways."""
        along = spine(y + 0.01) - spine(y - 0.01)
        along /= np.linalg.norm(along)
        return np.array([along, [0, 0, 1.0], np.cross(along, [0, 0, 1.0])])

    stations = np.linspace(-1, 1, 7)
    stations[0] = -1 + depth[0]
    dense = np.linspace(stations[0], stations[-1], 60)
    radii = PchipInterpolator(stations, depth)(dense)

    def girth_at(y: float) -> float:
        """Half height of the body: the envelope of its balls."""
        return float(np.sqrt(np.max(radii**2 - (dense - y) ** 2)))

    body = tube([spine(y) for y in stations], depth, 30, build.flat, (1, 0, 0))

    def plate(points: list[tuple[float, float]], y: float, z: float = 0.0) -> Solid:
        outline = spline(np.array(points), 22)
        return extrude(outline, _THICK, 0.9 * _THICK, spine(y) + [0, 0, z], axes(y))

    half, length, fork = build.tail
    length *= rng.uniform(0.9, 1.15)
    half *= rng.uniform(0.92, 1.12)
    notch = length * (1 - 0.62 * fork) if fork else 1.04 * length
    upper = 1.2 if kind == "shark" else 1.0
    root = depth[-1]
    tail = plate(
        [
            (-0.14, 0.75 * root),
            (0.30 * length, 0.55 * half),
            (0.96 * length, upper * half),
            (length, 0.86 * upper * half),
            (notch, 0.0),
            (length, -0.86 * half / upper),
            (0.96 * length, -half / upper),
            (0.30 * length, -0.55 * half),
            (-0.14, -0.75 * root),
        ],
        1.0,
    )
    fins = [tail]
    for (start, end, height, sweep), sign in ((build.dorsal, 1), (build.anal, -1)):
        height = height * rng.uniform(0.85, 1.2)
        y0, y1 = 2 * start - 1, 2 * end - 1
        middle = (y0 + y1) / 2
        at = sign * np.array([girth_at(y) for y in (y0, middle, y1)])
        points = [
            (y0 - middle, 0.75 * at[0]),
            (y0 - middle + 0.3 * sweep + 0.05, at[1] + sign * 0.62 * height),
            (0.55 * (y1 - y0) * 0.5 + sweep, at[1] + sign * height),
            (0.5 * (y1 - y0) + 0.9 * sweep, at[1] + sign * 0.72 * height),
            (0.5 * (y1 - y0) + 0.10, at[2] + sign * 0.08),
            (0.5 * (y1 - y0), 0.6 * at[2]),
        ]
        fins.append(plate(points, middle))
    reach = build.pectoral * rng.uniform(0.9, 1.15)
    y = -0.36
    girth = girth_at(y)
    for side in (1.0, -1.0):
        droop, backwards = rng.uniform(0.35, 0.75), rng.uniform(0.75, 1.2)
        out = np.array([side * 0.9, backwards, -droop])
        out /= np.linalg.norm(out)
        base = spine(y) + [side * 0.86 * build.flat * girth, 0, -0.26 * girth]
        normal = np.cross(out, [0, 0.5, 1.0])
        elbow, tip = base + 0.55 * reach * out, base + reach * out
        width = 0.36 * reach
        fins.append(
            blade([base - 0.05 * out, elbow, tip], [0.55 * width, width, 0.62 * width], _THICK, normal)
        )
    figure = attach(body, *fins, radius=0.06)

    y_eye = -0.66
    girth = girth_at(y_eye)
    eyes = [
        ball(
            spine(y_eye) + [side * (0.95 * build.flat * girth - 0.035), 0, 0.34 * girth],
            min(0.095, 0.32 * girth),
        )
        for side in (1, -1)
    ]
    nose = spine(-1.0 + 0.02)
    mouth = ellipsoid(nose + [0, -0.02, -0.05], (0.30, 0.13, 0.036))
    snout = girth_at(-0.9)
    lips = ellipsoid(nose + [0, 0.10, -0.03], (min(0.11, 0.9 * snout), 0.11, min(0.10, 0.8 * snout)))
    figure = blend(figure, lips, radius=0.08)
    return unite(carve(figure, mouth, radius=0.05), *eyes)


FISH = DemoClass("fish", tuple(_BUILDS), _fish)
