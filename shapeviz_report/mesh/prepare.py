"""Preparing (paper, 3.2): clean, remesh to an even edge length, normalise, and check against the input."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.boxes import LEAF, along_curve, box_faces
from shapeviz_report.mesh.clean import bounding_diagonal, clean, count_components, in_diagonals, is_watertight
from shapeviz_report.mesh.closest import largest_distance
from shapeviz_report.mesh.paint import Paint, bake
from shapeviz_report.mesh.read import content_hash, parse_painted
from shapeviz_report.mesh.remesh import MOST_VERTICES, affordable_edge_length, remesh, surface_size
from shapeviz_report.mesh.sampling import sample_surface
from shapeviz_report.types import FloatArray, Mesh, ShapeFacts

MAX_DEVIATION = 0.05
"""A prepared surface farther than this fraction of the diagonal from its input is refused.

Wide enough for the rims of coarse open surfaces, which the remesher rounds; far less than a limb."""

MAX_PARTS = 100_000
"""A surface of more parts is refused: each takes vertices of its own, however small it is."""

RIDGES = (20.0, 5.0)
"""Degrees between faces from which on creases are kept, to try where a surface strays."""

SAMPLES_PER_VERTEX = 1
"""How densely a surface is sampled to find the deviation, relative to the prepared mesh."""


def prepare(files: Mapping[str, bytes], edge_length: float) -> tuple[Mesh, ShapeFacts]:
    """Turn a mesh file into the mesh that is measured and shown.

    Parameters
    ----------
    files : mapping of str to bytes
        A mesh file, as :func:`~shapeviz_report.mesh.read.collect_files` finds it.
    edge_length : float
        Target edge length as a fraction of :func:`~shapeviz_report.mesh.remesh.surface_size`.

    Returns
    -------
    mesh : Mesh
        Oriented 2-manifold, possibly with boundary and of several parts, normalised by :func:`normalise`.
    facts : ShapeFacts

    Raises
    ------
    MeshError
        The file cannot be read, has no surface, cannot be remeshed, or the result strays from the input.
    """
    original, paint = parse_painted(files)
    cleaned, repairs = clean(original)
    parts = count_components(len(cleaned.vertices), cleaned.faces)
    if parts > MAX_PARTS:
        raise MeshError(
            f"its surface falls into {parts:,} parts that share no vertices, more than {MAX_PARTS:,}; join what "
            "belongs together (weld or merge its vertices) before it is exported"
        )
    wanted = edge_length * surface_size(cleaned)
    length = affordable_edge_length(cleaned, wanted)
    if length > wanted:
        repairs["edges lengthened, for the surface is large or rich in ridges"] = 1
    remeshed = remesh(cleaned, length)
    distance = deviation(cleaned, remeshed)
    if distance > MAX_DEVIATION:
        remeshed, distance, repair = _remesh_closer(cleaned, length)
        repairs[repair] = 1
    if distance > MAX_DEVIATION:
        raise MeshError(
            f"remeshing moved its surface by {distance:.1%} of the diagonal, more than {MAX_DEVIATION:.0%}; its parts "
            "may be thinner than an edge, or lie apart far off"
        )
    colors = None if paint is None else _find_colors(original, paint, remeshed, repairs)
    unit = bounding_diagonal(original)
    watertight = is_watertight(cleaned.faces)
    facts = ShapeFacts(
        sha256=content_hash(files),
        faces_read=len(original.faces),
        vertices_read=len(original.vertices),
        faces=len(remeshed.faces),
        vertices=len(remeshed.vertices),
        components=count_components(len(remeshed.vertices), remeshed.faces),
        watertight=watertight,
        repairs=repairs,
        deviation=distance,
        area=_in_units_of_file(surface_area(cleaned), unit, 2),
        volume=_in_units_of_file(enclosed_volume(cleaned), unit, 3) if watertight else None,
        extents=tuple((np.ptp(cleaned.vertices, axis=0) * unit).tolist()),
        up=original.up,
    )
    return replace(normalise(remeshed), colors=colors), facts


def read_paint(paint: Callable[[], Paint]) -> tuple[Paint | None, tuple[str, ...]]:
    """The colours of a surface, None if they cannot be read, and what is lost of them: no mesh fails for them."""
    try:
        with np.errstate(all="ignore"):
            found = paint()
    except MemoryError:
        raise
    except Exception:  # what is broken in them may make their reader fail in any way
        return None, ("its colours cannot be read",)
    return found, found.lost


def _find_colors(
    original: Mesh, paint: Callable[[], Paint], prepared: Mesh, repairs: dict[str, int]
) -> npt.NDArray[np.uint8] | None:
    """The colours (n, 3) of a mesh as it was read at the vertices of the one that it became; None if they say nothing,
    or cannot be read. What they lack is noted."""
    found, lost = read_paint(paint)
    if found is None:
        repairs["colours that cannot be read left out"] = 1
    elif lost:
        repairs["materials or pictures of its colours left out, which are missing or cannot be used"] = len(
            lost
        )
    if found is None or found.is_plain:
        return None
    vertices, finite, _ = in_diagonals(original)
    return bake(found.of(np.flatnonzero(finite)), vertices[original.faces[finite]], prepared)


def _remesh_closer(mesh: Mesh, edge_length: float) -> tuple[Mesh, float, str]:
    """A mesh that strays less from a cleaned one, how far, and what it took.

    Large faces that meet at less than a ridge are rounded, so ridges are kept from smaller angles on; and parts thinner
    than an edge vanish, so edges are made shorter, until it fits or takes ``MOST_VERTICES``.
    """
    for ridge in RIDGES:
        remeshed = remesh(mesh, edge_length, ridge)
        distance = deviation(mesh, remeshed)
        if distance <= MAX_DEVIATION:
            return remeshed, distance, "flat creases kept, for rounding them moved the surface"
    least = affordable_edge_length(mesh, 0, MOST_VERTICES)
    while distance > MAX_DEVIATION and edge_length > least:
        edge_length = max(edge_length / 2, least)
        remeshed = remesh(mesh, edge_length, RIDGES[-1])
        distance = deviation(mesh, remeshed)
    return remeshed, distance, "edges shortened, for parts are thinner"


def normalise(mesh: Mesh) -> Mesh:
    """Centre a mesh on the mean of its vertices and scale the farthest one to distance 1.

    The shape then lies in the unit ball, hence in [-1, 1]^3 as in the paper (3.2), and unlike a fit of the
    bounding box the scale does not change when the shape is rotated.

    Parameters
    ----------
    mesh : Mesh
        With at least two distinct vertices.

    Returns
    -------
    Mesh
    """
    centred = mesh.vertices - mesh.vertices.mean(axis=0)
    return Mesh(centred / np.linalg.norm(centred, axis=1).max(), mesh.faces)


def surface_area(mesh: Mesh) -> float:
    """The area of a surface, in the squared units of its vertices."""
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def enclosed_volume(mesh: Mesh) -> float:
    """The volume inside a closed surface: of the tetrahedra that its faces span with one point, with their signs.

    Parts that are oriented apart, such as a hollow's wall, count as they are oriented.

    Parameters
    ----------
    mesh : Mesh
        Watertight.

    Returns
    -------
    float
        In the cubed units of its vertices; at least 0.
    """
    # From its own middle: far from the origin the signed parts would be large, and cancel badly.
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] - mesh.vertices.mean(axis=0) for corner in range(3))
    return abs(float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6))


def _in_units_of_file(value: float, unit: float, power: int) -> float | None:
    """None where the number would be out of range."""
    with np.errstate(over="ignore"):
        result = float(value * np.float64(unit) ** power)
    return result if np.isfinite(result) else None


def deviation(before: Mesh, after: Mesh) -> float:
    """Largest distance found between two surfaces, as a fraction of the diagonal of ``before``.

    The symmetric Hausdorff distance, taken at the vertices of both and at points spread over them.

    Parameters
    ----------
    before, after : Mesh

    Returns
    -------
    float
        At least 0.
    """
    count = SAMPLES_PER_VERTEX * len(after.vertices)
    there, back = (
        _largest_distance(np.concatenate([sample_surface(one, count)[0], one.vertices]), other)
        for one, other in ((before, after), (after, before))
    )
    diagonal = np.linalg.norm(before.vertices.max(axis=0) - before.vertices.min(axis=0))
    return float(max(there, back) / diagonal)


def _largest_distance(points: FloatArray, mesh: Mesh) -> float:
    """How far the farthest of some points is from a surface."""
    corners = mesh.vertices[mesh.faces]
    corners = corners[along_curve(corners[:, 0] + corners[:, 1] + corners[:, 2])]
    return largest_distance(points[along_curve(points)], corners, box_faces(corners), LEAF)
