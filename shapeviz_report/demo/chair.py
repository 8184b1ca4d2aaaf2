"""Chairs: on four legs, a star base or rockers, with backs of slats, spindles or one shell."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import (
    Solid,
    attach,
    ball,
    blend,
    box,
    cone,
    extrude,
    spline,
    tube,
    turn,
    unite,
)

_KINDS = ("slats", "shell", "office", "armchair", "windsor", "rocker")


def _chair(rng: Generator, kind: str) -> Solid:
    width = rng.uniform(0.40, 0.47)  # half of it
    depth = rng.uniform(0.40, 0.45)
    seat = {"armchair": 0.72, "rocker": 0.84}.get(kind, rng.uniform(0.86, 1.0))
    back = {"armchair": 0.78, "office": 0.92, "shell": 0.80}.get(kind, rng.uniform(0.90, 1.15))
    tilt = np.radians(rng.uniform(5, 14))
    slab = 0.055
    leg = rng.uniform(0.046, 0.056)
    away = np.array([0, np.sin(tilt), np.cos(tilt)])
    axes = np.array([[1.0, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], away])
    heel = np.array([0, depth - 0.05, seat])  # where seat and back meet

    if kind in ("slats", "rocker"):
        cushion = box((0, 0, seat), (width, depth, slab), 0.045)
        posts, rails = [], []
        for s in (1, -1):
            x = s * (width - leg)
            posts.append(
                cone((x, depth - leg, seat - 0.1), heel + [x, 0, 0] + (back) * away, leg, 0.85 * leg)
            )
        if rng.uniform() < 0.5:
            count = int(rng.integers(2, 4))
            for i in range(count):
                at = heel + away * back * (0.42 + 0.50 * i / max(count - 1, 1))
                rails.append(box(at + [0, 0.02, 0], (width - leg, 0.038, 0.075), 0.035, axes))
        else:
            rails.append(
                box(heel + away * back * 0.93 + [0, 0.01, 0], (width - leg, 0.04, 0.085), 0.035, axes)
            )
            count = int(rng.integers(2, 4))
            for i in range(count):
                x = (width - leg) * (2 * (i + 1) / (count + 1) - 1)
                rails.append(
                    box(heel + [x, 0, 0] + away * back * 0.46, (0.045, 0.034, 0.48 * back), 0.03, axes)
                )
        legs = []
        floor = 0.12 if kind == "rocker" else leg
        for x in (1, -1):
            for y in (1, -1):
                splay = 0.05
                legs.append(
                    cone(
                        (x * (width - leg + 0.5 * splay), y * (depth - leg) + (splay * y), floor),
                        (x * (width - leg), y * (depth - leg), seat),
                        0.85 * leg,
                        leg,
                    )
                )
        stretchers = [
            cone(
                (s * (width - leg), -(depth - leg), 0.45 * seat),
                (s * (width - leg), depth - leg, 0.45 * seat),
                0.038,
                0.038,
            )
            for s in (1, -1)
        ]
        if kind == "rocker":
            for s in (1, -1):
                x = s * (width - leg + 0.02)
                legs.append(
                    tube(
                        [
                            (x, -depth - 0.32, 0.20),
                            (x, -0.4 * depth, 0.06),
                            (x, 0.4 * depth, 0.06),
                            (x, depth + 0.42, 0.22),
                        ],
                        [0.05] * 4,
                        14,
                    )
                )
                arm_z = seat + 0.36
                rear = heel + [x, 0, 0] + away * 0.36
                stretchers.append(
                    box(
                        (x, -0.02 + 0.5 * (rear[1] - depth), arm_z),
                        (0.062, 0.5 * (rear[1] + depth) + 0.02, 0.038),
                        0.034,
                    )
                )
                stretchers.append(cone((x, -depth + leg, seat), (x, -depth + 0.06, arm_z), 0.042, 0.042))
        return blend(cushion, *posts, *rails, *legs, *stretchers, radius=0.035)

    if kind == "windsor":
        t = np.linspace(0, 2 * np.pi, 36, endpoint=False)
        outline = np.stack(
            [
                width * 1.04 * np.sign(np.cos(t)) * np.abs(np.cos(t)) ** 0.7,
                depth * np.sign(np.sin(t)) * np.abs(np.sin(t)) ** 0.75,
            ],
            axis=1,
        )
        plate = extrude(outline, slab, 0.05, (0, 0, seat))
        hoop = [
            heel + np.array([x * width, 0, 0]) + away * z * back
            for x, z in (
                (0.86, 0),
                (0.98, 0.5),
                (0.80, 0.88),
                (0, 1.04),
                (-0.80, 0.88),
                (-0.98, 0.5),
                (-0.86, 0),
            )
        ]
        parts = [tube(hoop, [0.048] * 7, 26)]
        count = int(rng.integers(3, 5))
        for i in range(count):
            x = 2 * (i + 1) / (count + 1) - 1
            top = 1.02 * np.sqrt(max(0.0, 1 - (0.82 * x) ** 2)) ** 0.7
            parts.append(
                cone(
                    heel + [0.72 * x * width, 0, 0],
                    heel + np.array([0.86 * x * width, 0, 0]) + away * back * top,
                    0.036,
                    0.034,
                )
            )
        legs = []
        for x in (1, -1):
            for y in (1, -1):
                foot = np.array([x * width * 0.98, y * depth * 1.05, 0.05])
                head = np.array([x * width * 0.62, y * depth * 0.66, seat])
                legs.append(
                    tube(
                        [foot, foot + 0.4 * (head - foot), foot + 0.6 * (head - foot), head],
                        [0.038, 0.058, 0.05, 0.05],
                        8,
                    )
                )
        ends = [np.array([x * width * 0.85, 0, 0.36 * seat]) for x in (1, -1)]
        for e in ends:
            parts.append(cone(e + [0, -depth * 0.90, 0], e + [0, depth * 0.90, 0], 0.036, 0.036))
        parts.append(cone(ends[0], ends[1], 0.036, 0.036))
        return blend(plate, *parts, *legs, radius=0.03)

    if kind == "armchair":
        plump = rng.uniform(0.09, 0.12)
        width, depth = 0.50, 0.50
        base = box((0, 0, 0.40), (width, depth, 0.20), 0.07)
        cushion = box((0, -0.05, 0.66), (width - 0.12, depth - 0.02, 0.12), plump)
        rest = box(
            (0, depth - 0.06, 0.42) + away * 0.45 * back, (width - 0.02, 0.13, 0.58 * back), plump, axes
        )
        parts = []
        for s in (1, -1):
            x = s * (width + 0.03)
            parts.append(box((x, 0, 0.50), (0.09, depth, 0.30), 0.05))
            parts.append(cone((x, -depth + 0.06, 0.82), (x, depth - 0.06, 0.84), 0.125, 0.125))
            for y in (1, -1):
                parts.append(
                    cone(
                        (s * (width - 0.03), y * (depth - 0.10), 0.04),
                        (s * (width - 0.06), y * (depth - 0.13), 0.28),
                        0.045,
                        0.06,
                    )
                )
        return unite(blend(base, *parts, rest, radius=0.04), cushion)

    # A bent shell: seat and back in one, a plate that follows a curve seen from the side.
    profile = spline(
        [
            (-depth - 0.02, seat - 0.05),
            (-0.7 * depth, seat),
            (0.35 * depth, seat - 0.02),
            (0.90 * depth, seat + 0.10),
            (depth + 0.05, seat + 0.45 * back),
            (depth + 0.10 + back * np.sin(tilt) * 0.7, seat + back),
        ],
        26,
    )
    normal = np.gradient(profile, axis=0)
    normal = np.stack([-normal[:, 1], normal[:, 0]], axis=1) / np.linalg.norm(normal, axis=1, keepdims=True)
    half = 0.042
    outline = np.concatenate([profile + half * normal, (profile - half * normal)[::-1]])
    side_view = np.array([[0, 1.0, 0], [0, 0, 1.0], [1.0, 0, 0]])
    shell = extrude(outline, width, 0.035, axes=side_view)
    if kind == "shell":
        legs = []
        splay = rng.uniform(0.02, 0.14)
        for x in (1, -1):
            for y in (1, -1):
                head = np.array([x * 0.55 * width, y * 0.52 * depth - 0.04, seat - 0.03])
                foot = np.array([x * (0.80 * width + splay), y * (0.80 * depth + splay) - 0.03, 0.04])
                legs.append(cone(foot, head, 0.038, 0.055))
        brace = [
            cone((0.66 * width, y, 0.55 * seat), (-0.66 * width, y, 0.55 * seat), 0.036, 0.036)
            for y in (-0.63 * depth - 0.04, 0.63 * depth - 0.04)
        ]
        return attach(shell, unite(*legs, *brace), radius=0.04)
    column = unite(
        cone((0, 0, 0.20), (0, 0, 0.5 * seat), 0.085, 0.085),
        cone((0, 0, 0.3 * seat), (0, 0, seat - 0.15), 0.055, 0.055),
        cone((0, 0, seat - 0.105), (0, 0, seat - 0.10), 0.17, 0.16, 0.3),
    )
    star = []
    turned = rng.uniform(0, 72)
    for i in range(5):
        way = turn((0, 0, 1), turned + 72 * i) @ np.array([0, -1.0, 0])
        end = 0.52 * way + [0, 0, 0.13]
        star.append(unite(cone((0, 0, 0.24), end, 0.06, 0.046), ball(end - [0, 0, 0.05], 0.068)))
    parts = [shell, column, *star]
    for s in (1, -1) if rng.uniform() < 0.7 else ():
        x = s * (width + 0.03)
        rest_z = seat + rng.uniform(0.28, 0.38)
        parts.append(
            tube(
                [(s * 0.6 * width, -0.02, seat - 0.075), (x, -0.02, seat + 0.06), (x, 0, rest_z)],
                [0.042, 0.042, 0.042],
                8,
            )
        )
        parts.append(box((x, -0.02, rest_z), (0.06, 0.27, 0.042), 0.036))
    return blend(parts[0], *parts[1:], radius=0.035)


CHAIR = DemoClass("chair", _KINDS, _chair)
