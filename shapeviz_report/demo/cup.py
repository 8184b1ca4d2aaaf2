"""Cups: a turned vessel with a handle, from espresso cup to tall mug."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.solids import Solid, blend, revolve, spline, tube
from shapeviz_report.types import FloatArray

# Outer profile of each kind: radius at the foot, at a quarter, half and three quarters of the height, at the rim.
_PROFILES = {
    "mug": (0.40, 0.42, 0.42, 0.42, 0.42),
    "teacup": (0.26, 0.45, 0.56, 0.62, 0.68),
    "barrel": (0.38, 0.48, 0.51, 0.48, 0.42),
    "latte": (0.30, 0.36, 0.42, 0.47, 0.52),
    "tulip": (0.36, 0.50, 0.50, 0.44, 0.47),
    "bowl": (0.30, 0.53, 0.61, 0.63, 0.63),
}
_HEIGHTS = {"mug": 0.95, "teacup": 0.72, "barrel": 0.95, "latte": 1.15, "tulip": 1.05, "bowl": 0.75}


def _wall(rng: Generator, profile: FloatArray, thickness: float) -> FloatArray:
    """Section of the vessel: down the outside to the foot, in to the axis, and up the inside to a round rim."""
    height = profile[-1, 1]
    tangent = np.gradient(profile, axis=0)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    inside = profile - thickness * normal
    floor = thickness * rng.uniform(1.0, 1.4)
    bowl = inside[inside[:, 1] > floor + 0.16 * height]
    # The floor meets the wall in a curve, as a spoon would like it.
    t = np.linspace(0, 1, 7)[:-1, None]
    corner = np.array([bowl[0, 0] * (1 - 0.05), floor])
    curve = (1 - t) ** 2 * [0.45 * bowl[0, 0], floor] + 2 * t * (1 - t) * corner + t**2 * bowl[0]
    angles = np.linspace(0, np.pi, 11)[1:-1, None]
    middle, half = (profile[-1] + inside[-1]) / 2, (inside[-1] - profile[-1]) / 2
    up = np.array([half[1], -half[0]])
    rim = middle - half * np.cos(angles) + up * np.sin(angles)
    foot = profile[profile[:, 1] > 0.35 * thickness]
    bevel = [[profile[0, 0] - 0.35 * thickness, 0.0], [profile[0, 0] - 0.1 * thickness, 0.1 * thickness]]
    return np.concatenate([[[0.0, 0.0]], bevel, foot, rim, bowl[::-1], curve[::-1], [[0.0, floor]]])


def _cup(rng: Generator, kind: str) -> Solid:
    height = _HEIGHTS[kind] * rng.uniform(0.88, 1.12)
    radii = np.array(_PROFILES[kind]) * rng.uniform(0.94, 1.06) * (1 + rng.normal(0, 0.015, 5))
    wall = rng.uniform(0.095, 0.115)
    profile = spline(np.stack([radii, np.linspace(0, height, 5)], axis=1), 20)
    vessel = revolve(_wall(rng, profile, wall))

    top = height * rng.uniform(0.74, 0.82)
    bottom = height * rng.uniform(0.22, 0.32)
    reach = rng.uniform(0.26, 0.36)
    droop = rng.uniform(-0.04, 0.06)
    middle, half = (top + bottom) / 2, (top - bottom) / 2
    at_top, at_middle, at_bottom = np.interp([top, middle, bottom], profile[:, 1], profile[:, 0])
    widest = max(at_top, at_middle, at_bottom)
    ear = [
        (at_top, 0, top - 0.02),
        (at_top + 0.6 * (widest + reach - at_top), 0, top + 0.12 * half),
        (widest + reach, 0, middle + 0.42 * half - droop),
        (widest + 0.84 * reach, 0, middle - 0.38 * half - droop),
        (at_bottom, 0, bottom),
    ]
    thick = rng.uniform(0.056, 0.066)
    widths = [thick, thick, thick, 0.95 * thick, 0.9 * thick]
    handle = tube(ear, widths, 20, rng.uniform(1.1, 1.6), (0, 1, 0))
    return blend(vessel, handle, radius=0.09)


CUP = DemoClass("cup", tuple(_PROFILES), _cup)
