"""Copies: shapes that are the same shape again, whatever was done to their files.

A copy may be the same file, or the same surface moved, turned, mirrored, scaled evenly, renumbered, remeshed, decimated
or triangulated otherwise. Each shape is outlined by numbers that none of this changes; only shapes whose outlines
nearly agree are laid on each other, and only surfaces that then lie on each other are copies. ``docs/method/method.md``
has the limits.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import permutations, product

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from shapeviz_report.mesh.boxes import LEAF, along_curve, box_faces
from shapeviz_report.mesh.closest import find_closest
from shapeviz_report.mesh.sampling import sample_surface
from shapeviz_report.types import FloatArray, IntArray, Mesh
from shapeviz_report.types.copies import (
    IDENTICAL_FILE,
    IDENTICAL_GEOMETRY,
    NEARLY_SAME_SURFACE,
    SAME_SURFACE,
    Copy,
    Match,
)

OUTLINE_POINTS = 4000
"""Points of a surface behind its outline; they tell the quantiles of distances to some thousandths."""

QUANTILES = 16
"""Of the distances of a surface's points from its centre, in an outline."""

OUTLINE_REACH = 0.04
"""Outlines that differ by more in any number are of different shapes.
Decimation to half changed five demo shapes by 0.004 to 0.019."""

LENGTHS_REACH = 0.005
"""The same for the lengths of the principal axes, which are exact where the other numbers are of sampled points.
Decimation to a tenth changed a shape of each demo class by 0.0003 to 0.0023."""

NEAREST_OUTLINES = 8
"""Shapes with the nearest outlines that one is compared with, so that comparisons grow with the number of shapes."""

EQUAL_DECIMALS = 9
"""Outlines that agree to so many are one: what is moved and renumbered differs by rounding."""

SURFACE_DISTANCE = 0.001
"""Largest root mean square distance of one surface, as a fraction of its size."""

SURFACE_LARGEST = 0.015
"""Largest distance of a point of one surface from another, as a fraction of its size."""

NEARLY_DISTANCE = 0.0025
"""The same of surfaces that are nearly the same. Decimation to a tenth moved shapes of the demo by up to 0.0022;
different shapes whose axes agree were 0.0065 and more apart in the demo, 0.011 in messy12."""

NEARLY_LARGEST = 0.03
"""Largest distance of a point of one surface from another that is nearly the same."""

ROUNDING = 1e-5
"""Triangles whose corners differ by less than this fraction of the size are the same."""

POINTS = 1500
"""Points of each surface that are laid on the other."""

TRIED_POINTS = 50
"""Those that choose among many first positions."""

ROUGH_POINTS = 100
"""Those that a first position is tried with, before many are measured."""

ROUGH_DISTANCE = 2 * NEARLY_DISTANCE
"""Surfaces that are farther apart after a rough fit are different."""

HOPELESS_DISTANCE = 1.5 * NEARLY_DISTANCE
"""A fit that gains little and is farther off is not completed; its distance is within an eighth of what all points
say."""

SAME_LENGTH = 0.02
"""Principal axes whose lengths differ by less may stand for each other. Where they differ by more, those of copies are
at most ten degrees apart, by which a fit finds the way."""

STARTS = 8
"""First positions from which surfaces are fitted; without axes of one length there are four."""

STEPS = 12
"""Steps of a fit; it converges quadratically."""

ROUGH_STEPS = 6
"""Those of a rough fit."""

STALLED = 0.8
"""A fit is given up where a step leaves more than so much of a distance that is too large. From a start near the right
position a step leaves less than half."""

CLOSE_FITS = 2
"""Rough fits that are completed: those of a symmetric shape lie on each other, and each is as good as the next."""


@dataclass(frozen=True)
class Outline:
    """Numbers of a surface that no motion, reflection, even scaling or triangulation changes.

    Attributes
    ----------
    sha256 : str
        Of the file's content.
    values : (20,) float64 array
        Lengths of the principal axes, a third of the root of the area, and quantiles of the distance from the centre;
        all in units of the root mean square of this distance.
    """

    sha256: str
    values: FloatArray


def outline(mesh: Mesh) -> FloatArray:
    """The values of an :class:`Outline` of a cleaned mesh."""
    frame = _find_frame(mesh)
    points, _ = sample_surface(mesh, OUTLINE_POINTS)
    reach = np.linalg.norm(points - frame.centre, axis=1) / frame.radius
    quantiles = np.quantile(reach, (np.arange(QUANTILES) + 0.5) / QUANTILES)
    return np.concatenate([frame.lengths, [np.sqrt(frame.area) / frame.radius / 3], quantiles])


def pair_outlines(outlines: Mapping[str, Outline]) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """Which shapes may be copies.

    Parameters
    ----------
    outlines : mapping of str to Outline
        By shape id, in the order of the database.

    Returns
    -------
    certain : list of (str, str)
        Shapes of identical files, each with the first of them.
    possible : list of (str, str)
        Shapes of other files, the first of each file, that are to be compared; sorted.
    """
    first: dict[str, str] = {}
    certain = []
    for shape, found in outlines.items():
        original = first.setdefault(found.sha256, shape)
        if original != shape:
            certain.append((original, shape))
    ids = list(first.values())
    if len(ids) < 2:
        return certain, []
    values = np.array([outlines[shape].values for shape in ids])
    values[:, :3] *= OUTLINE_REACH / LENGTHS_REACH
    # Of shapes without end that have one outline, so many are looked at as each can be compared with.
    kept = _first_of_each(values.round(EQUAL_DECIMALS), NEAREST_OUTLINES + 1)
    # The shape itself is the nearest, or as near as the nearest.
    count = min(NEAREST_OUTLINES + 1, len(kept))
    seen = values[kept]
    near = cKDTree(seen).query(seen, k=[*range(1, count + 1)], p=np.inf, distance_upper_bound=OUTLINE_REACH)[
        1
    ]
    pairs = {
        (min(row, other), max(row, other))
        for row, others in zip(kept.tolist(), np.append(kept, -1)[near].tolist())
        for other in others
        if other not in (row, -1)
    }
    # More copies of one shape than that may all be nearest to a few of them; by their exact numbers they form a row.
    row = np.lexsort(values[:, :4].T[::-1])
    alike = np.abs(np.diff(values[row], axis=0)).max(axis=1) <= OUTLINE_REACH
    pairs |= {(min(a, b), max(a, b)) for a, b in zip(row[:-1][alike].tolist(), row[1:][alike].tolist())}
    return certain, [(ids[a], ids[b]) for a, b in sorted(pairs)]


def _first_of_each(rows: FloatArray, most: int) -> IntArray:
    """The places of rows, but for those that ``most`` equal ones come before; rising."""
    _, same = np.unique(rows, axis=0, return_inverse=True)
    order = np.argsort(same, kind="stable")
    begins = np.flatnonzero(np.diff(same[order], prepend=-1))
    rank = np.arange(len(rows)) - np.repeat(begins, np.diff(begins, append=len(rows)))
    return np.sort(order[rank < most])


def join_copies(
    certain: Iterable[tuple[str, str]], compared: Mapping[tuple[str, str], Match | None], ids: Sequence[str]
) -> tuple[Copy, ...]:
    """All copies, in the order of ``ids``.

    Parameters
    ----------
    certain : pairs of ids
        Of identical files.
    compared : mapping of pairs of ids to Match or None
        What :func:`compare` found.
    ids : sequence of str
    """
    place = {shape: number for number, shape in enumerate(ids)}
    found = [Copy(a, b, Match(IDENTICAL_FILE)) for a, b in certain]
    found += [Copy(a, b, match) for (a, b), match in compared.items() if match is not None]
    return tuple(sorted(found, key=lambda copy: (place[copy.first], place[copy.second])))


def compare(one: Surface, other: Surface) -> Match | None:
    """Whether two surfaces are the same, or nearly.

    Returns
    -------
    Match or None
        None where no motion, reflection and even scaling lays one surface nearly on the other.
    """
    best = _fit(one, other, mirrored=False)
    mirrored = False
    if best is None or best.distance > ROUNDING:
        image = _fit(one, other, mirrored=True)
        # Both fit a shape that is its own mirror image, and rounding must not choose.
        if image is not None and (best is None or best.distance > 2 * image.distance + ROUNDING):
            best, mirrored = image, True
    if best is None:
        return None
    times = other.unit / one.unit * best.scale
    if _same_triangles(one, other, best):
        return Match(IDENTICAL_GEOMETRY, scale=times, mirrored=mirrored)
    kind = SAME_SURFACE if best.same else NEARLY_SAME_SURFACE
    return Match(kind, best.distance, best.largest, times, mirrored)


@dataclass(frozen=True)
class _Frame:
    """Where a surface lies: exact moments of its area.

    Attributes
    ----------
    centre : (3,) float64 array
    radius : float
        Root mean square of the distance from the centre.
    axes : (3, 3) float64 array
        Rows: the principal axes, the longest first.
    lengths : (3,) float64 array
        Root mean square extents along them over ``radius``; falling.
    area : float
    """

    centre: FloatArray
    radius: float
    axes: FloatArray
    lengths: FloatArray
    area: float


def _find_frame(mesh: Mesh) -> _Frame:
    corners = mesh.vertices[mesh.faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    total = float(areas.sum())
    middles = corners.mean(axis=1)
    centre = areas @ middles / total
    corners = corners - centre
    middles = middles - centre
    # The second moment of a triangle: area / 12 times the sum of those of its corners and nine of its middle.
    spread = np.einsum("f,fci,fcj->ij", areas, corners, corners)
    spread = (spread + 9 * np.einsum("f,fi,fj->ij", areas, middles, middles)) / (12 * total)
    values, vectors = np.linalg.eigh(spread)
    radius = float(np.sqrt(np.trace(spread)))
    lengths = np.sqrt(np.maximum(values[::-1], 0)) / radius
    return _Frame(centre, radius, vectors.T[::-1], lengths, total)


class Surface:
    """A surface in units of its own radius, centred, ready to be measured against.

    Parameters
    ----------
    mesh : Mesh
        Cleaned, hence in units of the diagonal of its bounding box.
    diagonal : float
        This diagonal, as the file has it.

    Attributes
    ----------
    size : float
        The diagonal, in units of the radius.
    unit : float
        The radius, as the file has it.
    """

    def __init__(self, mesh: Mesh, diagonal: float = 1.0) -> None:
        self.frame = _find_frame(mesh)
        self.size = 1 / self.frame.radius
        self.unit = diagonal * self.frame.radius
        vertices = (mesh.vertices - self.frame.centre) / self.frame.radius
        self.triangles = vertices[mesh.faces]
        normals = np.cross(
            self.triangles[:, 1] - self.triangles[:, 0], self.triangles[:, 2] - self.triangles[:, 0]
        )
        self.normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        own = Mesh(vertices, mesh.faces)
        points, _ = sample_surface(own, POINTS)
        # In an order of their own: any first of them are spread over the surface.
        self.points = points[np.random.default_rng(0).permutation(len(points))]
        order = along_curve(self.triangles.mean(axis=1))
        self._corners = self.triangles[order]
        self._normals = self.normals[order]
        self._boxes = box_faces(self._corners)

    def closest(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The nearest points of the surface to some points, and the normals there; both (n, 3)."""
        found, places = find_closest(points, self._corners, self._boxes, LEAF)
        return found, self._normals[places]

    def distances(self, points: FloatArray) -> FloatArray:
        """The distance (n,) of each point from the surface."""
        return np.linalg.norm(self.closest(points)[0] - points, axis=1)


@dataclass(frozen=True)
class _Fit:
    """A similarity ``x -> scale * turn @ x + shift`` of the first surface on the second, and how well it lies there."""

    turn: FloatArray
    scale: float
    shift: FloatArray
    distance: float = np.inf
    largest: float = np.inf

    @property
    def same(self) -> bool:
        return self.distance <= SURFACE_DISTANCE and self.largest <= SURFACE_LARGEST

    @property
    def close(self) -> bool:
        return self.distance <= NEARLY_DISTANCE and self.largest <= NEARLY_LARGEST

    def apply(self, points: FloatArray) -> FloatArray:
        return self.scale * points @ self.turn.T + self.shift

    def undo(self, points: FloatArray) -> FloatArray:
        return (points - self.shift) @ self.turn / self.scale


def _fit(one: Surface, other: Surface, *, mirrored: bool) -> _Fit | None:
    """The first fit in which the surfaces are the same, the most promising tried first; else the best in which they
    nearly are; None if there is none."""
    starts = np.array(_first_turns(one.frame, other.frame, mirrored=mirrored))
    placed = one.points[:TRIED_POINTS] @ starts.transpose(0, 2, 1)
    misses = (other.distances(placed.reshape(-1, 3)).reshape(len(starts), -1) ** 2).mean(axis=1)
    rough = []
    for number in np.argsort(misses, kind="stable")[:STARTS]:
        start = _Fit(starts[number], 1.0, np.zeros(3))
        fit = _settle(one, other, start, ROUGH_POINTS, ROUGH_STEPS, enough=ROUGH_DISTANCE)
        if fit.distance <= ROUGH_DISTANCE:
            rough.append(fit)
        if fit.distance <= SURFACE_DISTANCE:
            break
    close: list[_Fit] = []
    for fit in sorted(rough, key=lambda fit: fit.distance)[:CLOSE_FITS]:
        start = replace(fit, distance=np.inf)
        fit = _settle(one, other, start, POINTS // 3, STEPS, enough=HOPELESS_DISTANCE)
        if fit.distance > HOPELESS_DISTANCE:
            continue
        fit = _measure(one, other, fit, POINTS)
        if fit.same:
            return fit
        close += [fit] if fit.close else []
    return min(close, key=lambda fit: fit.distance, default=None)


def _first_turns(one: _Frame, other: _Frame, *, mirrored: bool) -> list[FloatArray]:
    """Rotations, or reflections, that lay principal axes on principal axes; where axes are as long as each other, all
    that may be meant, closely enough for a fit to find the way."""
    lengths = one.lengths
    alike = np.abs(np.diff(lengths)) < SAME_LENGTH
    if alike.all():
        between = [rotation.as_matrix() for rotation in _even_rotations()]
    elif alike.any():
        axis = np.eye(3)[0 if alike[1] else 2]
        between = [
            Rotation.from_rotvec(angle * axis).as_matrix() for angle in np.arange(0, np.pi / 2, np.pi / 16)
        ]
    else:
        between = [np.eye(3)]
    orders = [
        order
        for order in permutations(range(3))
        if all(abs(lengths[place] - lengths[axis]) < SAME_LENGTH for place, axis in enumerate(order))
    ]
    wanted = -1.0 if mirrored else 1.0
    turns = []
    for order, signs, rotation in product(orders, product((1.0, -1.0), repeat=3), between):
        turn = other.axes.T @ (np.array(signs)[:, None] * np.eye(3)[list(order)]) @ rotation @ one.axes
        if np.linalg.det(turn) * wanted > 0:
            turns.append(turn)
    return turns


def _even_rotations() -> Rotation:
    """Rotations that, with those of the cube, leave none of 30 random ones more than 24 degrees away."""
    return Rotation.random(24, random_state=0)


def _settle(one: Surface, other: Surface, fit: _Fit, count: int, steps: int, enough: float) -> _Fit:
    """Move the first surface onto the second: Gauss-Newton steps on the distances along normals, from ``count`` points
    of each to the other (Chen and Medioni, 1992).

    The fit has the root mean square distance of these points before the last step. Steps end where they gain little
    and the surfaces are farther apart than ``enough``.
    """
    points = one.points[:count]
    back = other.points[:count]
    for _ in range(steps):
        moved = fit.apply(points)
        closest, normals = other.closest(moved)
        # From the other side: where the first surface is nearest to points of the second, in place.
        own, turned = one.closest(fit.undo(back))
        moved = np.concatenate([moved, fit.apply(own)])
        closest = np.concatenate([closest, back])
        normals = np.concatenate([normals, turned @ fit.turn.T])
        distance = float(np.sqrt(((closest - moved) ** 2).sum(axis=1).mean())) / other.size
        if distance > max(enough, STALLED * fit.distance):
            return replace(fit, distance=distance)
        missing = np.einsum("ij,ij->i", closest - moved, normals)
        stretch = np.einsum("ij,ij->i", moved, normals)
        slopes = np.column_stack([np.cross(moved, normals), normals, stretch])
        # A sphere may turn as it likes: steps that change nothing are not taken.
        step = np.linalg.lstsq(slopes, missing, rcond=1e-6)[0]
        turn = Rotation.from_rotvec(step[:3]).as_matrix()
        growth = float(np.clip(1 + step[6], 0.5, 2.0))
        fit = _Fit(turn @ fit.turn, fit.scale * growth, growth * (turn @ fit.shift) + step[3:6], distance)
        if np.abs(step).max() < 1e-9:
            break
    return fit


def _measure(one: Surface, other: Surface, fit: _Fit, count: int) -> _Fit:
    """The fit with the distances of the surfaces in it, at ``count`` points and as many corners of each."""
    there = np.concatenate([one.points[:count], _spread(one.triangles, count)])
    back = np.concatenate([other.points[:count], _spread(other.triangles, count)])
    moved = fit.apply(there)
    away = other.distances(moved) / other.size
    home = one.distances(fit.undo(back)) / one.size
    means = [float(np.sqrt(np.mean(d[:count] ** 2))) for d in (away, home)]
    return _Fit(fit.turn, fit.scale, fit.shift, max(means), float(max(away.max(), home.max())))


def _spread(triangles: FloatArray, count: int) -> FloatArray:
    """Corners of triangles, ``count`` at most, from all over the list."""
    corners = triangles.reshape(-1, 3)
    return corners[:: max(1, len(corners) // count)][:count]


def _same_triangles(one: Surface, other: Surface, fit: _Fit) -> bool:
    """Whether each triangle of one surface is one of the other's, in any order and numbering."""
    if len(one.triangles) != len(other.triangles):
        return False
    moved = fit.apply(one.triangles.reshape(-1, 3)).reshape(-1, 3, 3)
    middles = other.triangles.mean(axis=1)
    # The fit is as good as its points; triangles that belong together make it exact.
    _, partner = cKDTree(middles).query(moved.mean(axis=1))
    if len(np.unique(partner)) < len(partner):
        return False
    theirs = other.triangles[partner]
    between = np.linalg.norm(moved[:, :, None] - theirs[:, None], axis=3)
    nearest = between.argmin(axis=2)
    if not (np.sort(nearest, axis=1) == np.arange(3)).all():
        return False
    theirs = np.take_along_axis(theirs, nearest[:, :, None], axis=1).reshape(-1, 3)
    flat = moved.reshape(-1, 3)
    turn, shift, growth = _superpose(flat, theirs)
    gap = np.linalg.norm(growth * flat @ turn.T + shift - theirs, axis=1).max()
    return bool(gap <= ROUNDING * other.size)


def _superpose(points: FloatArray, targets: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """The similarity that lays points on their targets best (Umeyama, 1991): rotation, shift, scale."""
    middle, goal = points.mean(axis=0), targets.mean(axis=0)
    a, b = points - middle, targets - goal
    u, stretches, v = np.linalg.svd(b.T @ a)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ v))])
    turn = u * signs @ v
    scale = float((stretches * signs).sum() / (a**2).sum())
    return turn, goal - scale * turn @ middle, scale
