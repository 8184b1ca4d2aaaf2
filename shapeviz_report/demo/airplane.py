"""Airplanes: airliners, propeller planes, gliders and jets with swept or straight wings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import (
    Solid,
    attach,
    blend,
    carve,
    cone,
    ellipsoid,
    extrude,
    frame,
    revolve,
    tube,
    turn,
    unite,
)
from shapeviz_report.types import FloatArray


@dataclass(frozen=True)
class _Build:
    """Proportions; the fuselage is about two units long, the nose at y = -1."""

    girth: float
    span: float  # of one wing
    chord: tuple[float, float]  # at root and tip
    sweep: float  # how far the tip lies behind the root
    place: tuple[float, float]  # y of the root's front edge, z in units of the girth
    dihedral: float  # degrees
    engines: str
    tail_high: bool = False


_BUILDS = {
    "airliner": _Build(0.195, 0.96, (0.46, 0.17), 0.52, (-0.34, -0.45), 5, "wing"),
    "propeller": _Build(0.205, 0.94, (0.36, 0.28), 0.03, (-0.42, -0.55), 6, "nose"),
    "fighter": _Build(0.150, 0.62, (0.86, 0.22), 0.62, (-0.24, 0.0), 0, "rear"),
    "glider": _Build(0.150, 1.34, (0.30, 0.17), 0.05, (-0.38, 0.55), 4, "none", True),
    "bushplane": _Build(0.205, 1.0, (0.34, 0.32), 0.0, (-0.42, 0.95), 2, "nose"),
    "business": _Build(0.175, 0.84, (0.42, 0.16), 0.34, (-0.12, -0.5), 4, "tail", True),
}
_THICK = 0.042


def _plate(root: tuple[float, float], tip: tuple[float, float], length: float) -> FloatArray:
    """Outline with rounded tip; root and tip are (front, back) along the second axis."""
    t = np.linspace(0, 1, 7)[:, None]
    start, end = np.array([length * 0.92, tip[0]]), np.array([length * 0.92, tip[1]])
    peak = np.array([length * 1.08, 0.35 * tip[0] + 0.65 * tip[1]])
    curve = (1 - t) ** 2 * start + 2 * t * (1 - t) * peak + t**2 * end
    return np.concatenate([[[-0.05, root[0]]], curve, [[-0.05, root[1]]]])


def _surface(side: float, outline: FloatArray, place: FloatArray, angle: float) -> Solid:
    out = turn((0, 1, 0), -side * angle) @ np.array([side, 0, 0])
    axes = np.array([out, [0, 1.0, 0], np.cross(out, [0, 1.0, 0])])
    return extrude(outline, _THICK, 0.95 * _THICK, place, axes)


def _nacelle(centre: FloatArray, radius: float, length: float) -> Solid:
    """An engine pod along y with a spinner in its mouth."""
    profile = np.array(
        [
            (0, -0.62),
            (0.24, -0.52),
            (0.34, -0.46),
            (0.74, -0.48),
            (0.92, -0.44),
            (1.0, -0.32),
            (1.0, 0.05),
            (0.66, 0.5),
            (0.0, 0.54),
        ]
    )
    return revolve(profile * [radius, length], centre, frame((0, 1, 0)))


def _airplane(rng: Generator, kind: str) -> Solid:
    build = _BUILDS[kind]
    girth = build.girth * rng.uniform(0.92, 1.10)
    span = build.span * rng.uniform(0.90, 1.12)
    long = rng.uniform(0.94, 1.10)
    sweep = build.sweep * rng.uniform(0.75, 1.25)
    rise = 0.30 * girth
    fuselage = tube(
        [
            (0, -0.92 * long, -0.15 * girth),
            (0, -0.66 * long, 0),
            (0, 0.1, 0),
            (0, 0.62 * long, 0.35 * rise),
            (0, 1.0 * long, rise),
        ],
        np.array([0.42, 0.92, 1.0, 0.70, 0.34]) * girth,
        20,
    )
    if kind == "fighter":
        fuselage = blend(fuselage, cone((0, -0.8, -0.02), (0, -1.22 * long, -0.04), 0.10, 0.036), radius=0.08)
    canopy_y, canopy_l = {
        "fighter": (-0.52, 0.26),
        "glider": (-0.60, 0.24),
        "propeller": (-0.22, 0.25),
        "bushplane": (-0.42, 0.30),
    }.get(kind, (-0.80, 0.12))
    canopy_z = {"airliner": 0.42, "business": 0.48, "bushplane": 0.72}.get(kind, 0.72) * girth
    fuselage = blend(
        fuselage,
        ellipsoid((0, canopy_y * long, canopy_z), (0.60 * girth, canopy_l, 0.62 * girth)),
        radius=0.03,
    )

    y, z = build.place
    limbs = []
    for side in (1.0, -1.0):
        place = np.array([side * 0.55 * girth if abs(z) < 0.9 else 0.0, y * long, z * girth])
        outline = _plate((0.0, build.chord[0]), (sweep, sweep + build.chord[1]), span)
        limbs.append(_surface(side, outline, place, build.dihedral + rng.uniform(-2, 3)))
    stab = (0.40 if kind not in ("fighter",) else 0.36) * rng.uniform(0.9, 1.1)
    lean = 0.24 if sweep > 0.15 else 0.04
    fin_height = rng.uniform(0.38, 0.48)
    fin_axes = np.array([[0, 0, 1.0], [0, 1.0, 0], [-1.0, 0, 0]])
    fin = _plate((-0.06 - 0.5 * lean, 0.28), (0.10 + 0.6 * lean, 0.30 + 0.6 * lean), fin_height)
    fins = [extrude(fin, _THICK, 0.95 * _THICK, (0, 0.74 * long, rise + 0.25 * girth), fin_axes)]
    if kind == "fighter" and rng.uniform() < 0.6:  # twin fins
        fins = [
            extrude(
                fin,
                _THICK,
                0.95 * _THICK,
                (s * 0.16, 0.66 * long, 0.04),
                fin_axes @ turn((0, 1, 0), s * 16).T,
            )
            for s in (1, -1)
        ]
    high = 0.86 * fin_height if build.tail_high else 0.0
    back = (0.74 + (0.8 * lean if high else 0.0)) * long + (0.06 if high else 0.0)
    for side in (1.0, -1.0):
        outline = _plate((0.0, 0.24), (lean, lean + 0.14), stab)
        root = np.array(
            [0.0 if high else side * 0.2 * girth, back, rise + high + (0.25 * girth if high else 0)]
        )
        limbs.append(_surface(side, outline, root, 2.0))
    plane = attach(fuselage, *limbs, *fins, radius=0.06)

    if build.engines == "wing":
        pods = int(rng.choice([1, 2]))
        for side in (1.0, -1.0):
            for x in (0.40,) if pods == 1 else (0.32, 0.62):
                front = y * long + sweep * x
                wing_z = z * girth + np.tan(np.radians(build.dihedral)) * x * span
                centre = np.array([side * (0.5 * girth + x * span), front + 0.02, wing_z - 0.165])
                pod = _nacelle(centre, 0.115 if pods == 1 else 0.10, 0.36)
                strut = cone(centre + [0, 0.06, 0.03], centre + [0, 0.16, 0.14], 0.04, 0.04)
                plane = blend(plane, unite(pod, strut), radius=0.025)
    elif build.engines == "tail":
        for side in (1.0, -1.0):
            centre = np.array([side * (girth + 0.12), 0.50 * long, 0.09])
            plane = blend(
                plane,
                unite(_nacelle(centre, 0.105, 0.42), cone(centre, [0, centre[1], 0.06], 0.045, 0.045)),
                radius=0.03,
            )
    elif build.engines == "rear":
        nozzle = revolve(
            [(0, -0.2), (0.115, -0.2), (0.10, 0.10), (0.066, 0.10), (0.05, -0.02), (0, -0.02)],
            (0, 1.02 * long, rise),
            frame((0, 1, 0)),
        )
        plane = blend(plane, nozzle, radius=0.05)
        intakes = [
            tube(
                [(s * 0.15, -0.34, -0.05), (s * 0.155, 0.1, -0.04), (s * 0.09, 0.7, 0.0)],
                [0.085, 0.09, 0.07],
                8,
            )
            for s in (1, -1)
        ]
        plane = blend(plane, *intakes, radius=0.06)
        plane = carve(
            plane, *[ellipsoid((s * 0.15, -0.43, -0.05), (0.055, 0.09, 0.055)) for s in (1, -1)], radius=0.02
        )
    elif build.engines == "nose":
        tip = np.array([0, -1.0 * long - 0.06, -0.15 * girth])
        hub = cone(tip + [0, 0.16, 0], tip + [0, -0.05, 0], 0.085, 0.045)
        blades = int(rng.integers(2, 4))
        start = rng.uniform(0, 360)
        props = []
        for i in range(blades):
            way = turn((0, 1, 0), start + 360 * i / blades) @ np.array([0, 0, 1.0])
            across = np.cross(way, [0, 1.0, 0])
            props.append(
                tube(
                    [tip, tip + 0.18 * way, tip + 0.34 * way],
                    [0.05, 0.072, 0.055],
                    6,
                    0.52,
                    np.array([0, 1.0, 0]) + 0.5 * across,
                )
            )
        plane = unite(plane, blend(hub, *props, radius=0.03))
    if kind == "bushplane":
        for side in (1, -1):
            strut = cone(
                (side * 0.5 * girth, -0.22 * long, -0.55 * girth),
                (side * 0.52 * span, -0.24 * long, 1.0 * girth),
                0.034,
                0.034,
            )
            leg = cone(
                (side * 0.4 * girth, -0.40 * long, -0.6 * girth),
                (side * 0.24, -0.42 * long, -0.31),
                0.036,
                0.036,
            )
            wheel = ellipsoid((side * 0.255, -0.42 * long, -0.33), (0.045, 0.088, 0.088))
            plane = blend(plane, strut, leg, radius=0.03)
            plane = unite(plane, wheel)
    return plane


AIRPLANE = DemoClass("airplane", tuple(_BUILDS), _airplane)
