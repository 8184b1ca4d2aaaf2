"""Hands: a palm and five jointed fingers in common gestures."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import Solid, attach, blend, box, cone, ellipsoid, turn, unite
from shapeviz_report.types import FloatArray

# Curl of thumb, index, middle, ring and little finger, from 0 (straight) to 1 (in the palm).
_GESTURES = {
    "open": (0.0, 0.05, 0.03, 0.05, 0.08),
    "point": (0.75, 0.02, 0.95, 0.97, 1.0),
    "victory": (0.85, 0.03, 0.03, 0.97, 1.0),
    "relaxed": (0.25, 0.28, 0.36, 0.42, 0.45),
    "thumb": (-0.25, 0.97, 0.97, 0.97, 0.97),
    "horns": (0.80, 0.03, 0.97, 0.97, 0.05),
}
# Knuckle (x, z), length, radius, direction of the straight finger in degrees from upright.
_FINGERS = (
    (0.285, 0.86, 0.74, 0.098, -9.0),
    (0.100, 0.92, 0.83, 0.102, -2.0),
    (-0.090, 0.89, 0.77, 0.097, 4.0),
    (-0.265, 0.80, 0.61, 0.086, 12.0),
)
_UP = np.array([0.0, 0.0, 1.0])


def _finger(knuckle: FloatArray, axes: FloatArray, length: float, radius: float, curl: float) -> Solid:
    """Three phalanges that bend towards -y in the finger's own ``axes`` (columns)."""
    points, angle = [knuckle - axes @ _UP * 0.16], 0.0
    points.append(knuckle)
    for bend, share in zip((84, 100, 62), (0.46, 0.30, 0.24), strict=True):
        angle += bend * curl
        points.append(points[-1] + axes @ turn((1, 0, 0), angle) @ _UP * share * length)
    radii = radius * np.array([1.12, 1.08, 1.0, 0.94, 0.82])
    joints = [cone(points[i], points[i + 1], radii[i], radii[i + 1]) for i in range(4)]
    return blend(*joints, radius=0.04)


def _hand(rng: Generator, kind: str) -> Solid:
    slender = rng.uniform(-1, 1)
    stretch = 1 + 0.18 * slender
    thick = 1 - 0.10 * slender
    fan = rng.uniform(0.9, 2.1) if kind in ("open", "victory", "horns") else rng.uniform(0.4, 1.0)
    palm = blend(
        box((0, 0, 0.44), (0.355, 0.125 * thick, 0.40), 0.12 * thick),
        ellipsoid((0.0, 0.0, 0.78), (0.375, 0.135 * thick, 0.15)),
        ellipsoid((0.20, -0.07, 0.30), (0.17, 0.15 * thick, 0.28), turn((0, 1, 0), 14).T),
        ellipsoid((-0.22, -0.05, 0.32), (0.14, 0.13 * thick, 0.28)),
        radius=0.12,
    )
    # The wrist bends: the forearm leaves the hand in another direction.
    bend = turn((1, 0, 0), rng.uniform(-24, 24)) @ turn((0, 1, 0), rng.uniform(-18, 18))
    joint = np.array([0, 0.01, 0.08])
    below = -bend @ _UP
    length = rng.uniform(0.34, 0.54)
    wrist = cone(joint, joint + length * below, 0.215, 0.20, 0.72 * thick, bend @ [0, 1, 0])
    cuff = box(joint + (length + 0.12) * below, (0.26, 0.20, 0.16), 0.07, bend.T)
    gesture = np.clip(np.array(_GESTURES[kind]) + rng.normal(0, 0.05, 5), -0.3, 1.0)
    fingers = []
    for i, (x, z, length, radius, lean) in enumerate(_FINGERS):
        curl = float(gesture[i + 1])
        spread = lean * fan * (1 - 0.8 * max(curl, 0)) + (6 if kind == "victory" and i == 1 else 0)
        axes = turn((0, 1, 0), -spread)
        fingers.append(_finger(np.array([x, -0.01, z]), axes, length * stretch, radius * thick, curl))
    # The thumb turns in from its own saddle: curl swings it across the palm.
    across = float(gesture[0])
    aim = np.array(
        [0.80 - 0.85 * max(across, 0), -0.18 - 0.95 * max(across, 0), 0.72 + 0.25 * max(across, 0)]
    )
    if kind == "thumb":
        aim = np.array([1.0, -0.10, 0.62])
    aim /= np.linalg.norm(aim)
    inward = np.array([-0.55, -0.45, 0.45]) * (0.35 + 0.5 * max(across, 0))
    root = np.array([0.22, -0.05, 0.24])
    first = root + 0.40 * stretch * aim
    bent = aim + inward * (0.2 if kind == "thumb" else 1.0)
    second = first + 0.30 * stretch * bent / np.linalg.norm(bent)
    bent = bent + inward * (0.0 if kind == "thumb" else 0.6)
    third = second + 0.24 * stretch * bent / np.linalg.norm(bent)
    thumb = blend(
        cone(root, first, 0.165 * thick, 0.118 * thick),
        cone(first, second, 0.118 * thick, 0.110 * thick),
        cone(second, third, 0.110 * thick, 0.092 * thick),
        radius=0.04,
    )
    # Fingers that touch melt together a little: no slots that are too narrow to mesh.
    hand = blend(attach(palm, blend(*fingers, radius=0.06), radius=0.07), thumb, radius=0.07)
    return unite(blend(hand, wrist, radius=0.14), cuff)


HAND = DemoClass("hand", tuple(_GESTURES), _hand)
