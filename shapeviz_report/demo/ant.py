"""Ants: three body parts, six jointed legs, elbowed antennae and mandibles."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import Solid, attach, ball, blend, cone, ellipsoid, tube, turn, unite

_KINDS = ("worker", "soldier", "alarmed")


def _ant(rng: Generator, kind: str) -> Solid:
    head = rng.uniform(0.30, 0.34) * (1.25 if kind == "soldier" else 1.0)
    gaster = rng.uniform(0.36, 0.46)
    leg = rng.uniform(0.85, 1.15)
    height = rng.uniform(0.42, 0.55) * leg
    chest = np.array([0, 0, height])
    thorax = tube(
        [
            (0, -0.34, height + 0.05),
            (0, -0.12, height + 0.10),
            (0, 0.16, height + 0.02),
            (0, 0.34, height - 0.02),
        ],
        [0.15, 0.215, 0.17, 0.12],
        10,
    )
    node = ellipsoid((0, 0.46, height + 0.06), (0.10, 0.085, 0.14))
    lift = turn((1, 0, 0), rng.uniform(40, 75) if kind == "alarmed" else rng.uniform(-12, 16))
    tip = lift @ np.array([0, 1.0, 0])
    hinge = np.array([0, 0.54, height + 0.02])
    abdomen = blend(
        cone(hinge - 0.10 * tip, hinge + 0.2 * tip, 0.075, 0.12),
        ellipsoid(hinge + 1.22 * gaster * tip, (0.92 * gaster, 1.25 * gaster, 0.88 * gaster), lift.T),
        cone(hinge + 1.9 * gaster * tip, hinge + 2.5 * gaster * tip, 0.16, 0.05),
        radius=0.10,
    )
    nod = turn((0, 0, 1), rng.uniform(-18, 18)) @ turn((1, 0, 0), rng.uniform(-8, 24))
    neck = np.array([0, -0.40, height + 0.06])
    centre = neck + nod @ np.array([0, -0.88 * head, 0.02])
    at = lambda x, y, z: centre + nod @ (head * np.array([x, y, z]))  # noqa: E731
    skull = blend(
        ellipsoid(centre, (0.90 * head, 0.95 * head, 0.72 * head), nod.T),
        ball(at(0.42, 0.42, 0.10), 0.52 * head),
        ball(at(-0.42, 0.42, 0.10), 0.52 * head),
        radius=0.3 * head,
    )
    eyes = [
        ellipsoid(at(0.76 * s, -0.20, 0.28), (0.20 * head, 0.26 * head, 0.24 * head), nod.T) for s in (1, -1)
    ]
    bite = rng.uniform(0.05, 0.30)
    jaw_length = 1.35 if kind == "soldier" else 1.0
    jaws, feelers = [], []
    for s in (1, -1):
        jaws.append(
            tube(
                [
                    at(0.42 * s, -0.75, -0.22),
                    at((0.62 + bite) * s, -0.75 - 0.48 * jaw_length, -0.28),
                    at((0.18 + bite) * s, -0.75 - 0.85 * jaw_length, -0.30),
                ],
                [0.18 * head, 0.15 * head, 0.085 * head],
                7,
            )
        )
        swing, rise = rng.uniform(-0.25, 0.45), rng.uniform(-0.1, 0.5)
        elbow = at((1.05 + swing) * s, -1.05, 0.95 + rise)
        end = elbow + np.array([0.30 * s * (0.4 + swing), -0.42 - 0.12 * rise, 0.05 + 0.3 * rise])
        feelers.append(
            unite(
                cone(at(0.28 * s, -0.72, 0.25), elbow, 0.050, 0.043),
                tube([elbow, (elbow + end) / 2 + [0, 0, 0.05], end], [0.043, 0.046, 0.058], 6),
            )
        )
    skull = attach(unite(skull, *eyes), *jaws, *feelers, radius=0.05)

    legs = []
    for row, y in enumerate((-0.22, 0.0, 0.20)):
        for s in (1, -1):
            # Tripod gait: fore and hind leg of one side step together with the middle leg of the other.
            phase = 1 if (row % 2 == 0) == (s > 0) else -1
            angle = np.radians((52, 2, -50)[row] + phase * rng.uniform(3, 15) + rng.normal(0, 3))
            out = np.array([s * np.cos(angle), -np.sin(angle), 0])
            hip = chest + [0.11 * s, y, -0.05]
            length = leg * (0.95, 0.95, 1.15)[row]
            lifted = 0.10 if phase > 0 and rng.uniform() < 0.6 else 0.0
            knee = hip + out * 0.46 * length + [0, 0, 0.30 * length + 0.5 * lifted]
            ankle = np.array([*(hip + out * 0.86 * length)[:2], 0.08 + lifted])
            toe = np.array([*(hip + out * 1.10 * length)[:2], 0.045 + 0.6 * lifted])
            legs.append(
                unite(
                    tube([hip, hip + 0.5 * (knee - hip) + [0, 0, 0.02], knee], [0.082, 0.066, 0.050], 6),
                    tube([knee, knee + 0.4 * (ankle - knee) + 0.02 * out, ankle], [0.050, 0.058, 0.044], 6),
                    cone(ankle, toe, 0.044, 0.046),
                )
            )
    body = attach(thorax, *legs, radius=0.07)
    return blend(body, node, abdomen, skull, cone(neck, centre, 0.085, 0.10), radius=0.05)


ANT = DemoClass("ant", _KINDS, _ant)
