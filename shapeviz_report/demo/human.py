"""People: a jointed figure of changing build in everyday poses."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import Solid, attach, ball, blend, cone, ellipsoid, tube, turn, unite
from shapeviz_report.types import FloatArray

# Degrees: left leg, right leg (hip forward, hip outward, knee), left arm, right arm (forward, outward, elbow).
_POSES = {
    "stand": ((2, 5, 3), (2, 5, 3), (6, 14, 14), (6, 14, 14)),
    "walk": ((28, 4, 10), (-20, 4, 24), (-26, 10, 22), (30, 10, 26)),
    "wave": ((2, 8, 3), (2, 8, 3), (12, 138, 50), (4, 16, 16)),
    "run": ((62, 4, 72), (-28, 4, 62), (-48, 14, 88), (46, 12, 92)),
    "cheer": ((4, 16, 6), (4, 16, 6), (10, 148, 18), (10, 148, 18)),
    "dance": ((48, 22, 88), (0, 8, 6), (16, 84, 42), (14, 96, 70)),
}
_DOWN = np.array([0.0, 0.0, -1.0])


def _swing(forward: float, outward: float, side: float) -> FloatArray:
    """Rotation of a limb that hangs down; ``side`` is 1 for the figure's left."""
    return turn((0, 1, 0), -outward * side) @ turn((1, 0, 0), -forward)


def _leg(hip: FloatArray, side: float, angles: FloatArray, length: float, girth: float) -> Solid:
    upper = _swing(angles[0], angles[1], side)
    lower = upper @ turn((1, 0, 0), angles[2])
    knee = hip + upper @ _DOWN * 0.52 * length
    ankle = knee + lower @ _DOWN * 0.48 * length
    back = lower @ np.array([0, 0.022, 0])
    thigh = tube([hip, (hip + knee) / 2, knee], np.array([0.098, 0.083, 0.058]) * girth, 8)
    calf = tube(
        [knee, knee + 0.32 * (ankle - knee) + back, ankle], np.array([0.058, 0.062, 0.040]) * girth, 8
    )
    flex = turn((1, 0, 0), -0.35 * angles[2] + (8 if angles[0] < -10 else 0))
    foot_axes = lower @ flex
    heel = ankle + foot_axes @ np.array([0, 0.025, -0.035])
    toe = ankle + foot_axes @ np.array([0.015 * side, -0.155, -0.045])
    foot = cone(heel, toe, 0.052, 0.054, 0.80, foot_axes @ np.array([0, 0, 1.0]))
    return blend(unite(thigh, calf), foot, radius=0.05)


def _arm(shoulder: FloatArray, side: float, angles: FloatArray, length: float, girth: float) -> Solid:
    upper = _swing(angles[0], angles[1], side)
    # A raised arm bends inwards over the head, a hanging one forwards.
    raised = np.clip((angles[1] - 40) / 60, 0, 1)
    axis = (1 - raised) * np.array([-1.0, 0, 0]) + raised * np.array([0, -side, 0])
    lower = upper @ turn(axis, angles[2])
    elbow = shoulder + upper @ _DOWN * 0.5 * length
    wrist = elbow + lower @ _DOWN * 0.46 * length
    limb = tube([shoulder, (shoulder + elbow) / 2, elbow], np.array([0.060, 0.052, 0.043]) * girth, 6)
    forearm = tube([elbow, elbow + 0.3 * (wrist - elbow), wrist], np.array([0.043, 0.045, 0.033]) * girth, 6)
    palm = wrist + lower @ _DOWN * 0.075
    fingers = wrist + lower @ _DOWN * 0.150
    hand = cone(palm, fingers, 0.053, 0.042, 0.60, lower @ np.array([1.0, 0, 0]))
    thumb = cone(wrist + lower @ _DOWN * 0.045, wrist + lower @ np.array([0, -0.062, -0.095]), 0.026, 0.022)
    return blend(unite(limb, forearm), hand, thumb, radius=0.035)


def _human(rng: Generator, kind: str) -> Solid:
    pose = [np.array(angles, dtype=np.float64) + rng.normal(0, 5, 3) for angles in _POSES[kind]]
    for angles in pose:
        angles[2] = max(angles[2], 2.0)
    for angles in pose[:2]:
        angles[1] = max(angles[1], 4.0)
    for angles in pose[2:]:
        angles[1] = max(angles[1], 12.0)
    age = rng.uniform(0, 1) ** 2  # 0 is grown up, 1 a child: shorter limbs under a larger head
    build = rng.uniform(-1, 1)  # -1 slight, 1 stout
    hips = rng.uniform(-1, 1)  # -1 narrow under broad shoulders, 1 wide under narrow ones
    girth = 1.0 + 0.10 * build + 0.06 * age
    leg_length = 0.86 - 0.22 * age
    torso = 0.52 - 0.08 * age
    arm_length = 0.62 - 0.15 * age
    head = 0.138 + 0.02 * age
    hip_z, shoulder_z = 0.0, torso
    shoulder_x = (0.185 - 0.02 * hips - 0.03 * age) * (1 + 0.06 * build)
    hip_x = (0.095 + 0.012 * hips) * (1 + 0.06 * build)

    pelvis = ellipsoid((0, 0, hip_z + 0.02), ((0.165 + 0.02 * hips) * girth, 0.118 * girth, 0.115))
    belly = ellipsoid(
        (0, -0.012 - 0.02 * max(build, 0), 0.42 * torso),
        ((0.142 - 0.012 * hips) * girth, (0.105 + 0.025 * max(build, 0)) * girth, 0.16),
    )
    chest = ellipsoid((0, 0, 0.74 * torso), ((0.178 - 0.016 * hips) * girth, 0.112 * girth, 0.165))
    yoke = cone(
        (-0.8 * shoulder_x, 0, shoulder_z - 0.02),
        (0.8 * shoulder_x, 0, shoulder_z - 0.02),
        0.058 * girth,
        0.058 * girth,
    )
    trunk = blend(pelvis, belly, chest, yoke, radius=0.12)
    nod = turn((1, 0, 0), rng.uniform(-14, 4)) @ turn((0, 0, 1), rng.uniform(-28, 28))
    neck = np.array([0, 0.005, shoulder_z])
    centre = neck + np.array([0, 0, 0.09]) + nod @ np.array([0, -0.02, 0.6 * head + 0.03])
    axes = nod.T
    at = lambda x, y, z: centre + nod @ (head * np.array([x, y, z]))  # noqa: E731
    skull = ellipsoid(centre, (0.84 * head, 0.95 * head, 1.08 * head), axes)
    face = blend(
        skull,
        ellipsoid(at(0, -0.30, -0.62), (0.55 * head, 0.55 * head, 0.48 * head), axes),
        cone(at(0, -0.92, 0.12), at(0, -1.08, -0.10), 0.10 * head, 0.17 * head),
        ellipsoid(at(0.86, 0.05, -0.12), (0.13 * head, 0.20 * head, 0.27 * head), axes),
        ellipsoid(at(-0.86, 0.05, -0.12), (0.13 * head, 0.20 * head, 0.27 * head), axes),
        radius=0.25 * head,
    )
    style = rng.integers(3)
    hair = ellipsoid(at(0, 0.13, 0.24), (0.97 * head, 1.02 * head, 1.0 * head), axes)
    if style == 1:
        hair = blend(hair, ball(at(0, 0.62, 1.12), 0.42 * head), radius=0.1 * head)
    elif style == 2:
        hair = blend(
            hair,
            tube(
                [at(0, 0.95, 0.5), at(0, 1.45, 0.1), at(0, 1.35, -0.9)],
                [0.3 * head, 0.34 * head, 0.2 * head],
                8,
            ),
            radius=0.1 * head,
        )
    head_solid = unite(face, hair)
    throat = cone(neck - [0, 0, 0.02], centre - [0, 0, 0.5 * head], 0.062 * girth, 0.055 * girth)

    legs = [
        _leg(np.array([side * hip_x, 0, hip_z - 0.03]), side, pose[i], leg_length, girth)
        for i, side in enumerate((1.0, -1.0))
    ]
    arms = [
        _arm(np.array([side * shoulder_x, 0, shoulder_z - 0.03]), side, pose[2 + i], arm_length, girth)
        for i, side in enumerate((1.0, -1.0))
    ]
    return blend(attach(trunk, *legs, *arms, radius=0.07), throat, head_solid, radius=0.035)


HUMAN = DemoClass("human", tuple(_POSES), _human)
