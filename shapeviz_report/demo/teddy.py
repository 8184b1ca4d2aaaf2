"""Teddy bears: sitting, standing and waving."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import Solid, attach, ball, blend, carve, cone, ellipsoid, tube, turn, unite

_KINDS = ("sit", "stand", "wave", "hug")


def _teddy(rng: Generator, kind: str) -> Solid:
    plump = rng.uniform(0.90, 1.14)
    tall = rng.uniform(0.90, 1.12)
    head = rng.uniform(0.42, 0.50)
    body = blend(
        ellipsoid((0, 0, 0.44 * tall), (0.44 * plump, 0.40 * plump, 0.46 * tall)),
        ellipsoid((0, -0.02, 0.82 * tall), (0.32, 0.29, 0.28)),
        radius=0.22,
    )
    nod = (
        turn((0, 1, 0), rng.uniform(-14, 14))
        @ turn((0, 0, 1), rng.uniform(-22, 22))
        @ turn((1, 0, 0), rng.uniform(-4, 10))
    )
    centre = np.array([0, -0.02, 1.0 * tall + 0.72 * head])
    at = lambda x, y, z: centre + nod @ (head * np.array([x, y, z]))  # noqa: E731
    ear = rng.uniform(0.34, 0.42)
    skull = ellipsoid(centre, (1.06 * head, 0.92 * head, 0.94 * head), nod.T)
    for side in (1.0, -1.0):
        outer = ellipsoid(at(0.74 * side, 0.05, 0.72), (ear * head, 0.55 * ear * head, ear * head), nod.T)
        inner = ellipsoid(
            at(0.76 * side, -0.27, 0.74), (0.66 * ear * head, 0.22 * head, 0.66 * ear * head), nod.T
        )
        skull = blend(skull, carve(outer, inner, radius=0.06 * head), radius=0.10 * head)
    muzzle = ellipsoid(at(0, -0.80, -0.22), (0.46 * head, 0.40 * head, 0.36 * head), nod.T)
    skull = blend(skull, muzzle, radius=0.12 * head)
    nose = ellipsoid(at(0, -1.17, -0.06), (0.19 * head, 0.12 * head, 0.13 * head), nod.T)
    eyes = [ball(at(0.37 * side, -0.83, 0.20), 0.125 * head) for side in (1.0, -1.0)]
    face = unite(skull, nose, *eyes)

    limb = rng.uniform(0.155, 0.185)
    legs, arms = [], []
    for side in (1.0, -1.0):
        if kind in ("sit", "hug"):
            spread = rng.uniform(18, 38)
            reach = turn((0, 0, 1), side * spread) @ np.array([0, -1.0, 0])
            hip = np.array([0.26 * side * plump, -0.10, 0.14])
            foot = hip + (0.56 + 0.12 * rng.uniform()) * reach + [0, 0, -0.02 + rng.uniform(0, 0.08)]
            leg = cone(hip, foot, 1.15 * limb, 1.05 * limb)
            sole = ellipsoid(
                foot + 0.06 * reach + [0, 0, 0.07],
                (1.12 * limb, 0.13, 1.42 * limb),
                turn((0, 0, 1), side * spread).T,
            )
        else:
            stride = rng.uniform(-0.16, 0.16)
            hip = np.array([0.23 * side * plump, 0, 0.22])
            foot = np.array([0.27 * side * plump, stride, -0.30 * tall])
            leg = cone(hip, foot, 1.2 * limb, 1.08 * limb)
            sole = ellipsoid(foot + [0.02 * side, -0.11, -0.07], (1.1 * limb, 1.55 * limb, 0.13))
        legs.append(blend(leg, sole, radius=0.10))
        shoulder = np.array([0.27 * side, -0.03, 0.90 * tall])
        if kind == "wave" and side > 0:
            angle, forward = rng.uniform(120, 150), 0.1
        elif kind == "hug":
            angle, forward = rng.uniform(50, 75), rng.uniform(0.9, 1.4)
        else:
            angle, forward = rng.uniform(44, 80), rng.uniform(0.1, 0.6)
        out = np.array([side * np.sin(np.radians(angle)), -forward, -np.cos(np.radians(angle))])
        out /= np.linalg.norm(out)
        bend = out + [0, -0.5, 0.15]
        bend /= np.linalg.norm(bend)
        elbow = shoulder + 0.34 * tall * out
        paw = elbow + 0.26 * tall * bend
        arms.append(tube([shoulder, elbow, paw], [0.95 * limb, 0.92 * limb, 1.06 * limb], 8))
    tail = ball((0, 0.42 * plump, 0.20), 0.12)
    return blend(attach(body, *legs, *arms, tail, radius=0.09), face, radius=0.06)


TEDDY = DemoClass("teddy", _KINDS, _teddy)
