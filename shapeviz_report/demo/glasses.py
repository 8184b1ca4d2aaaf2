"""Spectacles: two rims of several fashions, a bridge, and temples folded by some angle."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import (
    Solid,
    attach,
    blend,
    ellipsoid,
    loop,
    mirror,
    tube,
    turn,
    unite,
)
from shapeviz_report.types import FloatArray

# Half width, half height, exponent of the superellipse, lift of the outer top corner, pull of the lower inner side.
_RIMS = {
    "round": (1.00, 0.98, 2.0, 0.00, 0.00),
    "wayfarer": (1.18, 0.88, 3.0, 0.10, 0.12),
    "cateye": (1.20, 0.82, 2.4, 0.42, 0.10),
    "aviator": (1.18, 1.02, 2.3, 0.02, 0.34),
    "rectangular": (1.25, 0.66, 4.5, 0.00, 0.04),
    "oval": (1.20, 0.76, 2.0, 0.00, 0.00),
}


def _rim(kind: str, rng: Generator) -> FloatArray:
    """Outline (n, 2) of the left lens about its centre; the nose is at negative x."""
    width, height, power, lift, pull = _RIMS[kind]
    width, height = width * rng.uniform(0.86, 1.10), height * rng.uniform(0.88, 1.12)
    angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    x = width * np.sign(np.cos(angle)) * np.abs(np.cos(angle)) ** (2 / power)
    z = height * np.sign(np.sin(angle)) * np.abs(np.sin(angle)) ** (2 / power)
    z = z + lift * np.clip(x / width, 0, 1) ** 2 * np.clip((z + height) / (2 * height), 0, 1)
    x = x * (1 - pull * np.clip(-z / height, 0, 1) * 0.5) + pull * 0.35 * np.clip(-z / height, 0, 1)
    # Even steps: superellipses crowd their points at the corners.
    closed = np.concatenate([np.stack([x, z], axis=1), [[x[0], z[0]]]])
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    steps = np.linspace(0, length[-1], 28, endpoint=False)
    return np.stack([np.interp(steps, length, closed[:, i]) for i in range(2)], axis=1)


def _glasses(rng: Generator, kind: str) -> Solid:
    outline = _rim(kind, rng)
    thick = rng.uniform(0.13, 0.17)
    gap = rng.uniform(0.26, 0.38)
    wrap = rng.uniform(0.03, 0.09)  # the front bends around the face
    centre = gap - outline[:, 0].min()
    x, z = outline[:, 0] + centre, outline[:, 1]
    left = np.stack([x, wrap * x**2 / 2, z], axis=1)
    inner = left[np.argmin(np.abs(z - 0.25) + 10 * (x > centre))]
    arch = rng.uniform(0.10, 0.22)
    bridge = tube(
        [inner + [0.05, 0, 0], [0, inner[1] - 0.03, inner[2] + arch], mirror(inner + [0.05, 0, 0])],
        [0.95 * thick] * 3,
        10,
    )
    # The temple starts at the outer upper part of the rim, goes back and hooks behind the ear.
    corner = left[np.argmax(x + 0.5 * np.minimum(z, 0.55))]
    length = rng.uniform(3.1, 4.4)
    hook = rng.uniform(0.55, 0.95)
    hinge = corner + [0.10, 0.14, 0.0]
    path = np.array(
        [
            [0, 0, 0],
            [0.05, 0.30 * length, 0.02],
            [0.02, 0.66 * length, 0.0],
            [-0.08, 0.86 * length, -0.30 * hook],
            [-0.16, length, -hook],
        ]
    )
    widths = np.array([1.05, 0.92, 0.9, 1.0, 1.05]) * thick
    pads = [
        ellipsoid(np.array([side, 1, 1]) * [0.62 * gap + 0.06, 0.20, -0.22], (0.10, 0.17, 0.24))
        for side in (1, -1)
    ]
    half_folded = rng.choice([1.0, -1.0, 0.0, 0.0])
    temples = []
    for side in (1.0, -1.0):
        fold = rng.uniform(-6, 32)  # degrees inwards from straight back
        if side == half_folded:
            # As far as its tip stays clear of the other temple.
            fold = min(rng.uniform(48, 70), np.degrees(np.arcsin(min(1.0, 0.85 * hinge[0] / length))))
        points = hinge + path @ turn((0, 0, 1), fold).T
        points = np.concatenate([[corner], points]) * [side, 1, 1]
        temples.append(tube(points, np.concatenate([[thick], widths]), 16))
    rims = unite(loop(left, thick), loop(mirror(left), thick))
    return attach(blend(rims, bridge, *pads, radius=0.16), *temples, radius=0.14)


GLASSES = DemoClass("glasses", tuple(_RIMS), _glasses)
