"""Four-legged animals, from dachshund to giraffe: one skeleton, one table of proportions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import Solid, attach, ball, blade, blend, cone, ellipsoid, tube, turn, unite
from shapeviz_report.types import FloatArray


@dataclass(frozen=True)
class _Build:
    """Proportions in units of the trunk's length."""

    trunk: tuple[float, float, float]  # radii at chest, belly and rump
    leg: float
    shank: float  # radius of the lower leg
    neck: float
    neck_angle: float  # degrees above the horizontal
    neck_radius: tuple[float, float]
    head: float  # length from the nape to the nose
    skull: float
    muzzle: float
    ear: tuple[float, float]  # length and half width
    ears_up: float  # 1 stand up, 0 stand off sideways, -1 hang
    tail: tuple[float, float, float]  # length, radius at the root, at the tip
    tail_up: float  # degrees above the horizontal
    extra: str = ""


_BUILDS = {
    "horse": _Build(
        (0.25, 0.245, 0.25),
        0.92,
        0.048,
        0.58,
        52,
        (0.20, 0.125),
        0.46,
        0.125,
        0.085,
        (0.15, 0.05),
        1,
        (0.62, 0.075, 0.06),
        -62,
        "mane",
    ),
    "dog": _Build(
        (0.24, 0.19, 0.19),
        0.62,
        0.058,
        0.30,
        48,
        (0.16, 0.13),
        0.40,
        0.165,
        0.085,
        (0.22, 0.085),
        -1,
        (0.48, 0.065, 0.04),
        38,
    ),
    "giraffe": _Build(
        (0.27, 0.245, 0.22),
        1.22,
        0.052,
        1.30,
        66,
        (0.20, 0.095),
        0.40,
        0.115,
        0.075,
        (0.17, 0.06),
        0,
        (0.50, 0.045, 0.06),
        -72,
        "ossicones",
    ),
    "cat": _Build(
        (0.19, 0.175, 0.185),
        0.54,
        0.056,
        0.20,
        42,
        (0.15, 0.14),
        0.25,
        0.185,
        0.095,
        (0.18, 0.085),
        1,
        (0.85, 0.055, 0.045),
        58,
    ),
    "elephant": _Build(
        (0.36, 0.39, 0.36),
        0.66,
        0.125,
        0.20,
        24,
        (0.28, 0.26),
        0.30,
        0.27,
        0.17,
        (0.36, 0.28),
        0,
        (0.40, 0.05, 0.04),
        -66,
        "trunk",
    ),
    "cow": _Build(
        (0.27, 0.30, 0.27),
        0.66,
        0.062,
        0.32,
        26,
        (0.21, 0.16),
        0.42,
        0.155,
        0.115,
        (0.19, 0.07),
        0,
        (0.58, 0.045, 0.055),
        -74,
        "horns",
    ),
    "dachshund": _Build(
        (0.19, 0.165, 0.17),
        0.30,
        0.058,
        0.26,
        46,
        (0.135, 0.115),
        0.42,
        0.145,
        0.075,
        (0.24, 0.09),
        -1,
        (0.42, 0.055, 0.035),
        24,
    ),
    "deer": _Build(
        (0.21, 0.19, 0.19),
        0.90,
        0.042,
        0.52,
        62,
        (0.145, 0.095),
        0.36,
        0.112,
        0.065,
        (0.20, 0.07),
        0,
        (0.14, 0.07, 0.05),
        20,
        "antlers",
    ),
    "pig": _Build(
        (0.28, 0.31, 0.28),
        0.36,
        0.070,
        0.14,
        12,
        (0.25, 0.22),
        0.42,
        0.205,
        0.115,
        (0.17, 0.095),
        0.6,
        (0.22, 0.045, 0.04),
        25,
        "snout",
    ),
    "fox": _Build(
        (0.20, 0.165, 0.17),
        0.56,
        0.050,
        0.26,
        46,
        (0.145, 0.125),
        0.40,
        0.155,
        0.055,
        (0.22, 0.09),
        1,
        (0.72, 0.075, 0.06),
        -12,
        "brush",
    ),
    "sheep": _Build(
        (0.29, 0.31, 0.30),
        0.50,
        0.055,
        0.24,
        38,
        (0.20, 0.14),
        0.36,
        0.13,
        0.09,
        (0.18, 0.065),
        -0.4,
        (0.16, 0.075, 0.06),
        -50,
        "wool",
    ),
    "bear": _Build(
        (0.30, 0.32, 0.32),
        0.54,
        0.105,
        0.22,
        28,
        (0.25, 0.21),
        0.40,
        0.205,
        0.105,
        (0.12, 0.09),
        1,
        (0.10, 0.08, 0.07),
        -10,
    ),
}
_DOWN = np.array([0.0, 0.0, -1.0])


def _leg(start: FloatArray, length: float, radii: FloatArray, swing: float, fold: float, hind: bool) -> Solid:
    """Thigh, shank and foot in the plane of walking; ``fold`` degrees of a lifted leg."""
    bends = (
        (-16 - 0.5 * fold, 26 + fold, -10 - 0.5 * fold)
        if hind
        else (8 - 0.7 * fold, -12 + 1.4 * fold, 4 - 0.4 * fold)
    )
    shares = (0.40, 0.36, 0.24) if hind else (0.42, 0.34, 0.24)
    angle, points = swing, [start]
    for bend, share in zip(bends, shares, strict=True):
        angle += bend
        points.append(points[-1] + turn((1, 0, 0), angle) @ _DOWN * share * length)
    limb = tube(points, radii, 12)
    foot = ellipsoid(
        points[-1] + np.array([0, -0.35 * radii[3], -0.1 * radii[3]]), radii[3] * np.array([1.2, 1.55, 0.85])
    )
    return blend(limb, foot, radius=0.5 * radii[3])


def _fleece(centre: FloatArray, radii: FloatArray) -> list[Solid]:
    """Curls of wool over the upper part of an ellipsoid, spread by the golden angle."""
    count = 44
    curls = []
    for i in range(count):
        height = 1 - 1.5 * (i + 0.5) / count
        around = np.radians(137.508) * i
        ring = np.sqrt(1 - height * height)
        way = np.array([ring * np.cos(around), ring * np.sin(around), height])
        curls.append(ball(centre + 0.90 * radii * way, 0.115))
    return curls


def _fourleg(rng: Generator, kind: str) -> Solid:
    build = _BUILDS[kind]
    stout = rng.uniform(0.92, 1.08)
    long = rng.uniform(0.94, 1.06)
    chest, belly, rump = np.array(build.trunk) * stout
    leg = build.leg * rng.uniform(0.92, 1.08)
    front, back = np.array([0, -0.5 * long + 0.2, 0]), np.array([0, 0.5 * long - 0.12, 0.01])
    sag = -0.012 + 0.15 * (rump - belly) * 0.2
    trunk = tube([front, (front + back) / 2 + [0, 0, sag], back], [chest, belly, rump], 14)
    trunk = blend(
        trunk, ellipsoid(front + [0, -0.03, -0.02], (0.92 * chest, 0.9 * chest, 1.04 * chest)), radius=0.12
    )

    legs = []
    pace = rng.uniform(6, 24)
    lifted = rng.integers(5)
    for number, (side, hind) in enumerate(((1, False), (-1, False), (1, True), (-1, True))):
        direction = 1 if (side > 0) != hind else -1
        swing = direction * pace * rng.uniform(0.7, 1.1) + rng.normal(0, 2)
        fold = rng.uniform(24, 46) if number == lifted else max(0.0, swing) * 0.5
        root = back if hind else front
        girth = rump if hind else chest
        start = root + np.array([side * (0.56 * girth), 0.03 if hind else -0.02, -0.30 * girth])
        thigh = (0.58 if hind else 0.46) * girth + 0.3 * build.shank
        radii = np.array([thigh, 0.55 * thigh + 0.45 * build.shank, build.shank, 0.98 * build.shank])
        legs.append(_leg(start, leg + 0.55 * girth, radii, -swing, fold, hind))
    body = attach(trunk, *legs, radius=0.10)

    neck_angle = build.neck_angle + rng.uniform(-12, 9)
    up = turn((0, 0, 1), rng.uniform(-14, 14)) @ turn((1, 0, 0), -neck_angle) @ np.array([0, -1.0, 0])
    base = front + np.array([0, -0.30 * chest, 0.25 * chest])
    poll = base + up * (build.neck * rng.uniform(0.92, 1.08) + 0.5 * chest)
    bow = np.array([0, 0.03, 0.0]) * build.neck
    neck = tube(
        [base, (base + poll) / 2 + bow, poll],
        [build.neck_radius[0], 0.47 * sum(build.neck_radius), build.neck_radius[1]],
        8,
    )

    # Head: local x left, y back, z up; the nose points to -y and down.
    pitch = rng.uniform(-6, 12) + (26 if build.neck_angle > 40 else 10)
    nod = turn((0, 0, 1), rng.uniform(-22, 22)) @ turn((1, 0, 0), pitch)
    size = build.skull
    at = lambda x, y, z: poll + nod @ np.array([x, y, z])  # noqa: E731
    nose = at(0, -build.head + 0.5 * size, -0.10 * size)
    head = blend(
        ellipsoid(at(0, -0.25 * size, 0.12 * size), (0.92 * size, 1.05 * size, 0.95 * size), nod.T),
        cone(at(0, -0.4 * size, 0), nose, 0.72 * size, build.muzzle),
        radius=0.5 * size,
    )
    eyes = [ball(at(0.62 * s * size, -0.82 * size, 0.42 * size), max(0.20 * size, 0.032)) for s in (1, -1)]
    details = []
    length, half_width = build.ear
    for s in (1, -1):
        root = at(0.58 * s * size, 0.18 * size, 0.62 * size)
        way = {True: np.array([0.45 * s, 0.12, 1.0]), False: np.array([1.0 * s, 0.10, 0.28])}[
            build.ears_up > 0.5
        ]
        if build.ears_up < -0.5:
            root = at(0.80 * s * size, 0.12 * size, 0.52 * size)
            way = np.array([0.34 * s, -0.06, -1.0])
        elif build.ears_up < 0:
            way = np.array([1.0 * s, 0.1, -0.35])
        way = nod @ (way / np.linalg.norm(way))
        thin = nod @ (
            np.array([0.9 * s, -0.5, 0.0]) if build.ears_up < -0.5 else np.array([0.25 * s, -1.0, 0.1])
        )
        middle, tip = root + 0.5 * length * way, root + length * way
        round_tip = kind in ("elephant", "bear") or build.ears_up < -0.5
        widths = np.array([0.75, 1.0, 0.72 if round_tip else 0.42]) * half_width
        details.append(blade([root, middle, tip], np.maximum(widths, 0.036), 0.034, thin, 6))
    head = attach(head, *details, radius=0.04)

    if build.extra == "trunk":
        swing = rng.uniform(-0.15, 0.30)
        line = [
            at(0, -0.22, -0.05),
            at(0, -0.40, -0.24),
            at(0, -0.42 - 0.3 * swing, -0.52),
            at(0, -0.48 - swing, -0.74 + 0.5 * abs(swing)),
        ]
        head = blend(head, tube(line, [0.17, 0.125, 0.085, 0.065], 12), radius=0.08)
        for s in (1, -1):
            tusk = [at(0.12 * s, -0.26, -0.14), at(0.17 * s, -0.42, -0.27), at(0.16 * s, -0.58, -0.26)]
            head = blend(head, tube(tusk, [0.055, 0.045, 0.034], 6), radius=0.03)
    elif build.extra in ("horns", "ossicones", "antlers"):
        for s in (1, -1):
            root = at(0.45 * s * size, -0.10 * size, 0.85 * size)
            if build.extra == "horns":
                horn = tube(
                    [
                        root,
                        at(1.35 * s * size, -0.1 * size, 1.15 * size),
                        at(1.55 * s * size, -0.3 * size, 1.95 * size),
                    ],
                    [0.045, 0.042, 0.03],
                    8,
                )
            elif build.extra == "ossicones":
                top = at(0.62 * s * size, 0.08 * size, 1.95 * size)
                horn = unite(cone(root, top, 0.036, 0.034), ball(top, 0.048))
            else:
                fork = at(1.15 * s * size, 0.5 * size, 2.2 * size)
                horn = unite(
                    tube([root, fork, at(1.9 * s * size, 0.1 * size, 3.5 * size)], [0.036, 0.034, 0.028], 8),
                    cone(fork, at(0.9 * s * size, -0.6 * size, 3.0 * size), 0.032, 0.028),
                    cone((root + fork) / 2, at(1.25 * s * size, -0.9 * size, 1.75 * size), 0.032, 0.028),
                )
            head = blend(head, horn, radius=0.02)
    elif build.extra == "snout":
        head = blend(head, cone(nose, nose + nod @ np.array([0, -0.07, 0]), 0.105, 0.105), radius=0.03)
    head = unite(head, *eyes)

    lift = np.radians(build.tail_up + rng.uniform(-14, 14))
    away = np.array([np.sin(rng.uniform(-0.5, 0.5)), np.cos(lift), np.sin(lift)])
    tail_length, thick, thin_end = build.tail
    root = back + np.array([0, 0.82 * rump, 0.45 * rump])
    curve = (
        np.array([0, 0.25, 0.0]) * tail_length
        if build.tail_up < 0
        else np.array([0, 0.5, -0.12]) * tail_length
    )
    middle, end = root + 0.5 * tail_length * away + 0.5 * curve, root + tail_length * away + (0.3 * curve)
    start = root - [0, 0.10, 0]
    if build.extra == "brush":
        tail = tube([start, root, middle, end], [thick, thick, 0.135, 0.05], 12)
    else:
        tail = tube([start, root, middle, end], [thick, thick, (thick + thin_end) / 2, thin_end], 12)
    figure = blend(body, neck, radius=0.14)
    if build.extra == "mane":
        crest_way = np.array([0, up[2], -up[1]])
        crest = [
            base + (poll - base) * t + crest_way * (np.interp(t, [0, 1], build.neck_radius) + 0.01)
            for t in (0.2, 0.6, 1.0, 1.14)
        ]
        figure = blend(figure, blade(crest, [0.06, 0.10, 0.10, 0.06], 0.042, (1, 0, 0)), radius=0.03)
    elif build.extra == "wool":
        figure = blend(
            figure, *_fleece(0.5 * (front + back), np.array([belly, 0.62 * long, belly])), radius=0.05
        )
    return blend(figure, tail, head, radius=0.07)


FOURLEG = DemoClass("fourleg", tuple(_BUILDS), _fourleg)
