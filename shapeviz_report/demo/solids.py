"""A small modelling kit: solids as signed distance functions, written down as short postfix programs.

Every function returns a :class:`Solid`; solids are combined with :func:`unite`, :func:`blend`, :func:`attach`
and :func:`carve`. Nothing is evaluated here: ``surface.py`` runs the program and extracts the mesh.

Convention of all demo shapes: ``z`` is up, the figure looks towards ``-y``, its left hand is at ``+x``.
Units are the model's own.

Distances of all primitives are exact but for squashed round cones, where they hold to first order near the
surface, d = f / |grad f|. Smooth minima follow the cubic polynomial form (C2), so that
highlights run over a blend without a visible seam.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicSpline, PchipInterpolator

from shapeviz_report.types import FloatArray

# Opcodes: the first number of a row. Primitives push a distance, operators take distances from the stack.
CONE, BLADE, BOX, EXTRUSION, REVOLUTION, BLEND, CARVE, KEEP, ATTACH, DROP, GUARD = range(11)

# A row: opcode | origin (3) | world-to-local matrix (9) | parameters (4). A guard has the centre of a bounding
# box, its half sizes (3, then zeros), and as parameters the operator that waits for the guarded part, its
# radius, and how many rows to pass over.
ORIGIN, MATRIX, PARAMETERS, ROW = 1, 4, 13, 17

Point = npt.ArrayLike
Points = npt.ArrayLike | Sequence[npt.ArrayLike]
_GROUP = 4  # longer unions are cut into groups
_IDENTITY = np.eye(3)


@dataclass(frozen=True)
class Solid:
    """A solid as a program.

    Attributes
    ----------
    rows : (n, ROW) float64 array
        Postfix instructions.
    outlines : (m, 2) float64 array
        Points of all plane outlines that the rows refer to.
    low, high : (3,) float64 array
        Corners of the bounding box; blends may bulge beyond it by a sixth of their radius.
    """

    rows: FloatArray
    outlines: FloatArray
    low: FloatArray
    high: FloatArray


def _primitive(
    opcode: int,
    origin: Point,
    axes: FloatArray,
    scale: FloatArray,
    parameters: Sequence[float],
    local_low: FloatArray,
    local_high: FloatArray,
    outline: FloatArray | None = None,
) -> Solid:
    """One row; ``axes`` has the local axes as rows, ``scale`` stretches along each of them."""
    origin = np.asarray(origin, dtype=np.float64)
    to_world = axes.T * scale
    centre = origin + to_world @ ((local_low + local_high) / 2)
    half = (local_high - local_low) / 2
    extent = np.abs(to_world) @ half
    row = np.zeros(ROW)
    row[0] = opcode
    row[ORIGIN:MATRIX] = origin
    row[MATRIX:PARAMETERS] = (axes / scale[:, None]).ravel()
    row[PARAMETERS : PARAMETERS + len(parameters)] = parameters
    return Solid(
        row[None], np.empty((0, 2)) if outline is None else outline, centre - extent, centre + extent
    )


def _operator(opcode: int, radius: float = 0.0) -> FloatArray:
    row = np.zeros((1, ROW))
    row[0, 0] = opcode
    row[0, PARAMETERS] = radius
    return row


def _join(first: Solid, parts: Sequence[Solid], opcode: int, radius: float) -> Solid:
    """Concatenate programs: ``first``, then every part, behind a guard and followed by the operator."""
    rows, outlines, shift = [first.rows], [first.outlines], len(first.outlines)
    for part in parts:
        guard = np.zeros((1, ROW))
        guard[0, 0] = GUARD
        guard[0, ORIGIN:MATRIX] = (part.low + part.high) / 2
        guard[0, MATRIX : MATRIX + 3] = (part.high - part.low) / 2
        guard[0, PARAMETERS : PARAMETERS + 3] = opcode, radius, len(part.rows) + 1
        program = part.rows.copy()
        program[np.isin(program[:, 0], (EXTRUSION, REVOLUTION)), PARAMETERS] += shift
        rows += [guard, program, _operator(opcode, radius)]
        outlines.append(part.outlines)
        shift += len(part.outlines)
    low, high = first.low, first.high
    if opcode != CARVE:
        low = np.min([low, *(part.low for part in parts)], axis=0)
        high = np.max([high, *(part.high for part in parts)], axis=0)
    return Solid(np.concatenate(rows), np.concatenate(outlines), low, high)


def blend(first: Solid, *others: Solid, radius: float) -> Solid:
    """Smooth union, one after the other; each blend fills creases within about ``radius``."""
    return _join(first, others, BLEND, radius)


def unite(*parts: Solid) -> Solid:
    """Plain union with sharp creases."""
    if len(parts) > _GROUP:  # neighbours in groups, each behind its own guard
        step = max(_GROUP, round(len(parts) ** 0.5))
        parts = tuple(unite(*parts[i : i + step]) for i in range(0, len(parts), step))
    return blend(*parts, radius=0.0) if len(parts) > 1 else parts[0]


def attach(body: Solid, *limbs: Solid, radius: float) -> Solid:
    """Smooth union of every limb with the body, but not of the limbs with each other: fingers stay apart."""
    kept = Solid(np.concatenate([body.rows, _operator(KEEP)]), body.outlines, body.low, body.high)
    joined = _join(kept, limbs, ATTACH, radius)
    return Solid(np.concatenate([joined.rows, _operator(DROP)]), joined.outlines, joined.low, joined.high)


def carve(body: Solid, *tools: Solid, radius: float = 0.0) -> Solid:
    """Take the tools away from the body, with edges rounded within about ``radius``."""
    return _join(body, tools, CARVE, radius)


def frame(z: Point, x: Point = (1.0, 0.0, 0.0)) -> FloatArray:
    """Orthonormal axes as rows (3, 3): the third along ``z``, the first as near to ``x`` as can be."""
    third = np.asarray(z, dtype=np.float64)
    third = third / np.linalg.norm(third)
    first = np.asarray(x, dtype=np.float64)
    first = first - third * (first @ third)
    if np.linalg.norm(first) < 1e-6:
        first = np.eye(3)[np.argmin(np.abs(third))]
        first = first - third * (first @ third)
    first = first / np.linalg.norm(first)
    return np.array([first, np.cross(third, first), third])


def turn(axis: Point, degrees: float) -> FloatArray:
    """Rotation matrix (3, 3) about ``axis`` by ``degrees``, counter-clockwise (Rodrigues)."""
    x, y, z = np.asarray(axis, dtype=np.float64) / np.linalg.norm(np.asarray(axis, dtype=np.float64))
    angle = np.deg2rad(degrees)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return _IDENTITY + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def mirror(point: Point) -> FloatArray:
    """The point(s) on the other side of the figure: ``x`` changes sign."""
    return np.asarray(point, dtype=np.float64) * np.array([-1.0, 1.0, 1.0])


def ball(centre: Point, radius: float) -> Solid:
    """A sphere."""
    return ellipsoid(centre, (radius, radius, radius))


def ellipsoid(centre: Point, radii: npt.ArrayLike, axes: FloatArray = _IDENTITY) -> Solid:
    """An ellipsoid with half axes ``radii`` along the rows of ``axes``."""
    one, scale = np.ones(3), np.asarray(radii, dtype=np.float64)
    return _primitive(CONE, centre, axes, scale, (0.0, 1.0, 1.0, float(scale.min())), -one, one)


def _round_cone(
    start: Point, end: Point, start_radius: float, end_radius: float
) -> tuple[FloatArray, FloatArray, tuple[float, float, float], float, float]:
    """Origin, direction, parameters and extent along the direction; a cone within one of its balls is that ball."""
    start, end = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    length = float(np.linalg.norm(end - start))
    direction = end - start if length > 0.0 else np.array([0.0, 0.0, 1.0])
    if length <= abs(start_radius - end_radius):
        start, radius = (start, start_radius) if start_radius > end_radius else (end, end_radius)
        return start, direction, (0.0, radius, radius), -radius, radius
    low, high = min(-start_radius, length - end_radius), max(start_radius, length + end_radius)
    return start, direction, (length, start_radius, end_radius), low, high


def cone(
    start: Point,
    end: Point,
    start_radius: float,
    end_radius: float,
    flat: float = 1.0,
    normal: Point = (0, 0, 1),
) -> Solid:
    """A round cone: the hull of two balls, squashed along ``normal`` by ``flat``."""
    origin, direction, parameters, low, high = _round_cone(start, end, start_radius, end_radius)
    widest = max(parameters[1:])
    return _primitive(
        CONE,
        origin,
        frame(direction, normal),
        np.array([flat, 1.0, 1.0]),
        (*parameters, min(flat, 1.0) * widest),
        np.array([-widest, -widest, low]),
        np.array([widest, widest, high]),
    )


def spline(points: Points, count: int) -> FloatArray:
    """``count`` points (count, d) on a smooth curve through ``points`` (n, d), evenly spread by parameter."""
    points = np.asarray(points, dtype=np.float64)
    if len(points) == 2:
        return points[0] + np.linspace(0.0, 1.0, count)[:, None] * (points[1] - points[0])
    knots = _knots(points)
    return CubicSpline(knots, points, bc_type="natural")(np.linspace(0.0, knots[-1], count))


def _knots(points: FloatArray) -> FloatArray:
    """Centripetal parameters (n,): curves do not overshoot where points are uneven."""
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(np.sqrt(chords))])


def _sweep(points: Points, radii: npt.ArrayLike, pieces: int) -> tuple[FloatArray, FloatArray]:
    """Places (pieces + 1, 3) and radii (pieces + 1,) along a smooth curve."""
    points = np.asarray(points, dtype=np.float64)
    knots = _knots(points)
    widths = PchipInterpolator(knots, radii)(np.linspace(0.0, knots[-1], pieces + 1))
    return spline(points, pieces + 1), widths


def tube(
    points: Points, radii: npt.ArrayLike, pieces: int = 10, flat: float = 1.0, normal: Point = (0, 0, 1)
) -> Solid:
    """A limb along a smooth curve through ``points`` whose radius passes through ``radii``.

    ``pieces`` round cones make it up, each squashed along ``normal`` by ``flat``.
    """
    places, widths = _sweep(points, radii, pieces)
    return unite(
        *(cone(places[i], places[i + 1], widths[i], widths[i + 1], flat, normal) for i in range(pieces))
    )


def blade(
    points: Points, half_widths: npt.ArrayLike, half_thickness: float, normal: Point, pieces: int = 8
) -> Solid:
    """A wing, fin or ear: a plate of even thickness along a smooth curve, its rim round.

    It is thin along ``normal`` and as wide as ``half_widths`` say, which must exceed ``half_thickness``.
    """
    places, widths = _sweep(points, half_widths, pieces)
    parts = []
    for i in range(pieces):
        origin, direction, parameters, low, high = _round_cone(
            *places[i : i + 2], *(widths[i : i + 2] - half_thickness)
        )
        across = max(parameters[1:]) + half_thickness
        parts.append(
            _primitive(
                BLADE,
                origin,
                frame(direction, normal),
                np.ones(3),
                (*parameters, half_thickness),
                np.array([-half_thickness, -across, low - half_thickness]),
                np.array([half_thickness, across, high + half_thickness]),
            )
        )
    return unite(*parts)


def loop(points: Points, radius: float) -> Solid:
    """A closed rod through ``points`` (n, 3), joined by straight pieces."""
    points = np.asarray(points, dtype=np.float64)
    return unite(*(cone(points[i - 1], points[i], radius, radius) for i in range(len(points))))


def box(centre: Point, half: npt.ArrayLike, rounding: float, axes: FloatArray = _IDENTITY) -> Solid:
    """A box with half sizes ``half`` along the rows of ``axes`` and edges rounded by ``rounding``."""
    half = np.asarray(half, dtype=np.float64)
    return _primitive(BOX, centre, axes, np.ones(3), (*half, rounding), -half, half)


def extrude(
    outline: Points,
    half_height: float,
    rounding: float,
    centre: Point = (0, 0, 0),
    axes: FloatArray = _IDENTITY,
) -> Solid:
    """A plate: ``outline`` (n, 2) in the plane of the first two axes, thick by twice ``half_height``."""
    outline = np.asarray(outline, dtype=np.float64)
    low = np.array([*outline.min(axis=0), -half_height])
    high = np.array([*outline.max(axis=0), half_height])
    parameters = (0, len(outline), half_height, rounding)
    return _primitive(EXTRUSION, centre, axes, np.ones(3), parameters, low, high, outline)


def revolve(outline: Points, centre: Point = (0, 0, 0), axes: FloatArray = _IDENTITY) -> Solid:
    """Turn ``outline`` (n, 2), given as (distance from the third axis, place along it), about that axis."""
    outline = np.asarray(outline, dtype=np.float64)
    widest, bottom, top = outline[:, 0].max(), outline[:, 1].min(), outline[:, 1].max()
    low, high = np.array([-widest, -widest, bottom]), np.array([widest, widest, top])
    return _primitive(REVOLUTION, centre, axes, np.ones(3), (0, len(outline)), low, high, outline)
