"""Tables: tops of several outlines on legs, a pedestal or panels."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import Solid, attach, blend, box, cone, extrude, tube, unite
from shapeviz_report.types import FloatArray

_KINDS = ("dining", "tripod", "pedestal", "coffee", "trestle", "desk")


def _superellipse(width: float, depth: float, power: float) -> FloatArray:
    """Outline (48, 2) between an ellipse (power 2) and a rectangle."""
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    cosine, sine = np.cos(angle), np.sin(angle)
    size = (np.abs(cosine) ** power + np.abs(sine) ** power) ** (-1 / power)
    return np.stack([width * cosine * size, depth * sine * size], axis=1)


def _table(rng: Generator, kind: str) -> Solid:
    height = rng.uniform(0.70, 0.80)
    slab = rng.uniform(0.032, 0.042)
    if kind == "coffee":
        height *= 0.55
    width = {"dining": 0.85, "tripod": 0.48, "pedestal": 0.58, "coffee": 0.70, "trestle": 0.95, "desk": 0.80}[
        kind
    ]
    width *= rng.uniform(0.85, 1.15)
    depth = (
        width
        * {"dining": 0.56, "coffee": 0.62, "trestle": 0.48, "desk": 0.55}.get(kind, 1.0)
        * rng.uniform(0.92, 1.1)
    )
    if kind in ("tripod", "pedestal"):
        depth = width
    power = {"dining": 14.0, "coffee": 3.2, "trestle": 14.0, "desk": 14.0}.get(kind, 2.0)
    top_z = height - slab
    if kind in ("dining", "trestle", "desk"):
        top = box((0, 0, top_z), (width, depth, slab), 0.7 * slab)
    else:
        top = extrude(_superellipse(width, depth, power), slab, 0.8 * slab, (0, 0, top_z))
    if kind == "dining":
        leg = rng.uniform(0.045, 0.06)
        inset_x, inset_y = width - 1.3 * leg, depth - 1.3 * leg
        legs = [
            box((x * inset_x, y * inset_y, top_z / 2), (leg, leg, top_z / 2), 0.35 * leg)
            for x in (-1, 1)
            for y in (-1, 1)
        ]
        apron_z = top_z - slab - 0.055
        apron = [box((0, s * inset_y, apron_z), (inset_x, 0.03, 0.06), 0.012) for s in (-1, 1)]
        apron += [box((s * inset_x, 0, apron_z), (0.03, inset_y, 0.06), 0.012) for s in (-1, 1)]
        return blend(unite(top, *apron), *legs, radius=0.02)
    if kind in ("tripod", "coffee"):
        count = 3 if kind == "tripod" else 4
        splay = rng.uniform(0.08, 0.22)
        start = 90 if count == 3 else np.degrees(np.arctan2(depth, width))
        legs = []
        for i in range(count):
            angle = (
                np.radians(start + 120 * i)
                if count == 3
                else np.radians((1 if i % 2 else -1) * start + 180 * (i // 2))
            )
            direction = np.array([np.cos(angle), np.sin(angle)])
            reach = 0.62 * (width if count == 3 else np.hypot(width, depth) * 0.82)
            head = np.array([*(direction * reach), top_z - slab - 0.03])
            foot = np.array([*(direction * (reach + splay)), 0.03])
            legs.append(cone(foot, head, 0.032, rng.uniform(0.05, 0.062)))
        return attach(top, *legs, radius=0.06)
    if kind == "pedestal":
        feet = int(rng.integers(3, 5))
        column = tube(
            [(0, 0, 0.2), (0, 0, 0.32), (0, 0, 0.5), (0, 0, top_z - 0.08)],
            [0.08, rng.uniform(0.06, 0.10), 0.055, 0.08],
            14,
        )
        reach = 0.66 * width
        legs = []
        for i in range(feet):
            angle = 2 * np.pi * (i + 0.25) / feet - np.pi / 2 - np.pi / (2 * feet)
            x, y = np.cos(angle), np.sin(angle)
            path = [(0, 0, 0.24), (0.45 * reach * x, 0.45 * reach * y, 0.17), (reach * x, reach * y, 0.04)]
            legs.append(tube(path, [0.06, 0.05, 0.04], 8))
        return blend(attach(column, *legs, radius=0.06), top, radius=0.07)
    if kind == "trestle":
        place = width * rng.uniform(0.58, 0.74)
        lean = rng.uniform(0.10, 0.24)
        parts = []
        for s in (-1, 1):
            for t in (-1, 1):
                parts.append(
                    cone(
                        (s * place, t * (depth * 0.55 + lean), 0.04),
                        (s * place, t * depth * 0.22, top_z - slab),
                        0.042,
                        0.042,
                    )
                )
            parts.append(
                cone(
                    (s * place, -(depth * 0.40 + lean * 0.55), 0.3 * top_z),
                    (s * place, depth * 0.40 + lean * 0.55, 0.3 * top_z),
                    0.034,
                    0.034,
                )
            )
        parts.append(cone((-place, 0, 0.3 * top_z), (place, 0, 0.3 * top_z), 0.036, 0.036))
        return blend(top, *parts, radius=0.025)
    side = 0.036
    drawers = rng.uniform(0.42, 0.62) * width
    block_height = rng.uniform(0.45, 0.85) * top_z
    hand = rng.choice([-1.0, 1.0])
    panel = box((-hand * (width - side * 1.6), 0, top_z / 2), (side, depth * 0.94, top_z / 2), 0.014)
    block = box(
        (hand * (width - side * 0.6 - drawers / 2), 0, top_z - block_height / 2),
        (drawers / 2, depth * 0.94, block_height / 2),
        0.02,
    )
    parts = [panel, block]
    knobs = []
    for i in range(3):
        z = top_z - slab - block_height * (0.12 + 0.30 * i)
        x = hand * (width - side * 0.6 - drawers / 2)
        knobs.append(box((x, -depth * 0.94, z), (0.28 * drawers, 0.045, 0.024), 0.02))
    legs = []
    if block_height < 0.98 * top_z:
        for y in (-1, 1):
            for x in (hand * (width - side * 0.6 - 0.045), hand * (width - side * 0.6 - drawers + 0.045)):
                legs.append(
                    box(
                        (x, y * (depth * 0.94 - 0.045), (top_z - block_height / 2) / 2),
                        (0.036, 0.036, (top_z - block_height / 2) / 2),
                        0.014,
                    )
                )
    return blend(top, *parts, *legs, *knobs, radius=0.015)


TABLE = DemoClass("table", _KINDS, _table)
