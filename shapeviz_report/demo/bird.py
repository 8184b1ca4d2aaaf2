"""Birds: gliding on spread wings, or standing with folded ones."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import (
    Solid,
    attach,
    ball,
    blade,
    blend,
    cone,
    ellipsoid,
    extrude,
    spline,
    tube,
    turn,
    unite,
)
from shapeviz_report.types import FloatArray

_KINDS = ("gull", "sparrow", "eagle", "duck", "swallow", "heron")
_THICK = 0.042


def _wing(
    side: float,
    shoulder: FloatArray,
    span: float,
    chord: float,
    bend: FloatArray,
    sweep: float,
    fingered: bool,
) -> Solid:
    """A spread wing along a smooth arc.

    ``bend`` is its slope in degrees at the shoulder, the wrist and the tip; a fingered one ends in feathers.
    """
    s = np.linspace(0, 1, 9)
    slope = np.radians(np.interp(s, [0, 0.45, 1], bend))
    steps = (
        (0.76 if fingered else 1.0)
        * span
        / 8
        * np.stack([side * np.cos(slope), 0 * s, np.sin(slope)], axis=1)
    )
    points = shoulder + np.cumsum(steps, axis=0) - steps[0]
    # Forward to the wrist, then back: the leading edge of a living wing.
    points[:, 1] -= 0.28 * chord * np.sin(np.pi * np.minimum(s / 0.8, 1))
    points[:, 1] += sweep * np.clip((s - 0.4) / 0.6, 0, 1) ** 1.5
    taper = [1.0, 1.04, 1.04, 0.98, 0.80] if fingered else [1.0, 1.02, 0.88, 0.60, 0.26]
    width = 0.5 * chord * np.interp(s, [0, 0.3, 0.55, 0.8, 1.0], taper)
    wing = blade(points, width, _THICK, (0, 0, 1), 16)
    if not fingered:
        return wing
    out = steps[-1] / np.linalg.norm(steps[-1])
    upright = np.cross(out, [0, 1.0, 0]) * side
    feathers = []
    for f in np.linspace(0, 1, 5):
        way = turn(upright, side * (62 * f - 14)) @ out
        base = points[-1] + [0, (f - 0.5) * 1.25 * width[-1], 0]
        length = (0.46 - 0.12 * f) * span * 0.62
        line = [base - 0.10 * out, base + 0.6 * length * way, base + length * way]
        feathers.append(blade(line, [0.06, 0.062, 0.05], _THICK, upright, 4))
    return blend(wing, unite(*feathers), radius=0.06)


def _tail(root: FloatArray, pitch: float, length: float, half_width: float) -> Solid:
    axes = np.array(
        [
            [1.0, 0, 0],
            turn((1, 0, 0), pitch) @ np.array([0, 1.0, 0]),
            turn((1, 0, 0), pitch) @ np.array([0, 0, 1.0]),
        ]
    )
    narrow = 0.09
    outline = [
        (-narrow, -0.18),
        (-0.6 * half_width, 0.5 * length),
        (-half_width, 0.94 * length),
        (0, 1.08 * length),
        (half_width, 0.94 * length),
        (0.6 * half_width, 0.5 * length),
        (narrow, -0.18),
    ]
    return extrude(spline(outline, 32), _THICK, 0.95 * _THICK, root, axes)


def _head(
    centre: FloatArray, size: float, bill: float, hook: bool, nod: FloatArray, flat_bill: bool = False
) -> Solid:
    at = lambda x, y, z: centre + nod @ (size * np.array([x, y, z]))  # noqa: E731
    skull = ellipsoid(centre, (0.92 * size, 1.06 * size, 0.96 * size), nod.T)
    if flat_bill:
        beak = tube(
            [at(0, -0.7, -0.15), at(0, -1.3, -0.30), at(0, -1.0 - bill, -0.30)],
            [0.40 * size, 0.36 * size, 0.44 * size],
            6,
            0.42,
            nod @ np.array([0, 0, 1.0]),
        )
    elif hook:
        beak = tube(
            [at(0, -0.7, 0.05), at(0, -1.0 - 0.5 * bill, 0.0), at(0, -0.95 - bill, -0.55)],
            [0.42 * size, 0.32 * size, 0.11 * size],
            7,
        )
    else:
        beak = cone(at(0, -0.75, -0.08), at(0, -1.0 - bill, -0.22), 0.38 * size, 0.12 * size)
    eyes = [ball(at(0.72 * s, -0.56, 0.26), 0.17 * size) for s in (1, -1)]
    return unite(blend(skull, beak, radius=0.15 * size), *eyes)


def _flying(rng: Generator, kind: str) -> Solid:
    span, chord, girth, neck, bill = {
        "gull": (1.55, 0.44, 0.25, 0.34, 0.75),
        "eagle": (1.66, 0.74, 0.33, 0.34, 0.55),
        "swallow": (1.25, 0.36, 0.22, 0.24, 0.35),
    }[kind]
    span, chord = span * rng.uniform(0.92, 1.08), chord * rng.uniform(0.94, 1.08)
    body = tube(
        [(0, -0.52, 0.03), (0, -0.18, 0), (0, 0.25, 0), (0, 0.66, 0.03)],
        [0.62 * girth, girth, 0.86 * girth, 0.34 * girth],
        24,
    )
    size = 0.185 if kind != "swallow" else 0.17
    nod = turn((0, 0, 1), rng.uniform(-18, 18)) @ turn((1, 0, 0), rng.uniform(-4, 10))
    head = _head(np.array([0, -0.52 - neck, 0.10]), size, bill, kind == "eagle", nod)
    throat = cone((0, -0.42, 0.03), (0, -0.50 - neck, 0.09), 0.66 * girth, 0.8 * size)
    lift = rng.uniform(-8, 38)
    bend = np.array([lift, lift * 0.4 + rng.uniform(-6, 8), lift * 0.4 - rng.uniform(6, 40)])
    sweep = {"gull": 0.34, "eagle": 0.04, "swallow": 0.62}[kind] * rng.uniform(0.8, 1.2)
    wings = []
    for s in (1.0, -1.0):
        wings.append(
            _wing(s, np.array([0.35 * girth * s, -0.06, 0.08]), span, chord, bend, sweep, kind == "eagle")
        )
    if kind == "swallow":
        tail = unite(
            *(
                blade(
                    [(0.0, 0.50, 0.03), (0.13 * s, 0.95, 0.04), (0.36 * s, 1.36, 0.05)],
                    [0.12, 0.10, 0.05],
                    _THICK,
                    (0, 0, 1),
                    8,
                )
                for s in (1, -1)
            )
        )
    else:
        tail = _tail(np.array([0, 0.60, 0.03]), rng.uniform(-10, 8), 0.42, 0.24 if kind == "gull" else 0.30)
    return blend(attach(body, *wings, tail, radius=0.09), throat, head, radius=0.09)


def _standing(rng: Generator, kind: str) -> Solid:
    pitch = {"sparrow": rng.uniform(14, 38), "duck": rng.uniform(-2, 10), "heron": rng.uniform(10, 26)}[kind]
    lean = turn((1, 0, 0), -pitch)
    girth, length = {"sparrow": (0.40, 0.52), "duck": (0.42, 0.62), "heron": (0.30, 0.50)}[kind]
    girth *= rng.uniform(0.92, 1.08)
    along = lambda y, z=0.0: lean @ np.array([0, y, z])  # noqa: E731
    body = tube(
        [along(-length, 0.06), along(-0.3 * length), along(0.4 * length), along(1.12 * length, 0.05)],
        [0.60 * girth, girth, 0.84 * girth, 0.26 * girth],
        24,
    )
    tail_length = {"sparrow": 0.58, "duck": 0.26, "heron": 0.26}[kind] * rng.uniform(0.9, 1.15)
    tail = _tail(
        along(1.0 * length, 0.05), -pitch + {"sparrow": 10, "duck": 28, "heron": -12}[kind], tail_length, 0.17
    )
    nod = turn((0, 0, 1), rng.uniform(-32, 32)) @ turn((1, 0, 0), rng.uniform(-8, 10))
    if kind == "sparrow":
        size = 0.285
        centre = along(-length, 0.0) + [0, -0.06, 0.30]
        head = _head(centre, size, 0.42, False, nod)
        throat = cone(along(-0.7 * length, 0.02), centre, 0.30, 0.24)
    elif kind == "duck":
        size = 0.22
        centre = along(-length) + np.array([0, -0.14, rng.uniform(0.48, 0.72)])
        head = _head(centre, size, 0.95, False, nod, flat_bill=True)
        throat = tube(
            [along(-0.8 * length, 0.05), along(-length) + [0, -0.14, 0.26], centre + [0, 0.03, -0.04]],
            [0.28, 0.155, 0.15],
            10,
        )
    else:
        size = 0.135
        s = rng.uniform(0.7, 1.15)
        base = along(-0.9 * length, 0.04)
        centre = base + np.array([0, -0.34, 0.98 * s])
        head = _head(centre, size, 2.4, False, nod)
        throat = tube(
            [
                base,
                base + [0, -0.32, 0.16 * s],
                base + [0, -0.12, 0.55 * s],
                base + [0, -0.20, 0.86 * s],
                centre,
            ],
            [0.20, 0.115, 0.085, 0.085, 0.09],
            16,
        )
    figure = blend(attach(body, tail, radius=0.08), throat, radius=0.14)
    figure = blend(figure, head, radius=0.06)
    wings = []
    for s in (1.0, -1.0):
        flare = rng.uniform(2, 14)
        middle = along(0.18 * length, 0.06) + [s * 0.80 * girth, 0, 0]
        axes = np.array([along(1.0), along(0, 1.0), [1.0, 0, 0]])
        axes = axes @ turn((0, 0, 1), s * (flare - 10))
        outline = spline(
            [
                (-0.62 * length, 0.02),
                (-0.52 * length, 0.50 * girth),
                (0.0, 0.52 * girth),
                (0.65 * length, 0.20 * girth),
                (1.10 * length, -0.06),
                (0.60 * length, -0.30 * girth),
                (0.0, -0.56 * girth),
                (-0.48 * length, -0.40 * girth),
                (-0.62 * length, -0.02),
            ],
            28,
        )
        wings.append(extrude(outline, 0.075, 0.07, middle, axes))
    figure = blend(figure, *wings, radius=0.05)
    legs = []
    reach = {"sparrow": 0.34, "duck": 0.24, "heron": 1.15}[kind] * rng.uniform(0.9, 1.15)
    stride = rng.uniform(-0.14, 0.14)
    for s in (1.0, -1.0):
        hip = along(0.12 * length) + [0.45 * girth * s, 0, -0.62 * girth]
        foot = hip + [0.02 * s, s * stride, -reach - 0.1]
        knee = (hip + foot) / 2 + [0, 0.06 + 0.05 * reach, 0.02]
        thin = 0.044
        shank = unite(cone(hip, knee, 0.10 if kind != "heron" else 0.075, thin), cone(knee, foot, thin, thin))
        toes = [
            cone(foot, foot + turn((0, 0, 1), a) @ np.array([0, -0.22, -0.012]), thin, 0.036)
            for a in (-32, 0, 32)
        ]
        toes.append(cone(foot, foot + [0, 0.13, -0.01], thin, 0.036))
        if kind == "duck":
            web = extrude([(0, 0.02), (0.13, -0.24), (0, -0.27), (-0.13, -0.24)], 0.036, 0.03, foot)
            toes = [web]
        legs.append(blend(shank, unite(*toes), radius=0.03))
    return attach(figure, *legs, radius=0.07)


def _bird(rng: Generator, kind: str) -> Solid:
    return _flying(rng, kind) if kind in ("gull", "eagle", "swallow") else _standing(rng, kind)


BIRD = DemoClass("bird", _KINDS, _bird)
