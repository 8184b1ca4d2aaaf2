"""Preparing (paper, 3.2): clean, remesh to an even edge length, normalise, and check against the input."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.clean import clean, count_components, is_watertight
from shapeviz_report.mesh.read import content_hash, read_mesh
from shapeviz_report.mesh.remesh import remesh
from shapeviz_report.types import FloatArray, Mesh, ShapeFacts

MAX_DEVIATION = 0.03
"""A prepared surface farther than this fraction of the diagonal from its input is refused."""

SAMPLES_PER_VERTEX = 2
"""How densely a surface is sampled to find the deviation, relative to the prepared mesh."""


def prepare(path: Path, edge_length: float) -> tuple[Mesh, ShapeFacts]:
    """Turn a mesh file into the mesh that is measured and shown.

    Parameters
    ----------
    path : Path
        A mesh file.
    edge_length : float
        Target edge length as a fraction of the bounding-box diagonal.

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
    original = read_mesh(path)
    cleaned, repairs = clean(original)
    remeshed = remesh(cleaned, edge_length)
    distance = deviation(cleaned, remeshed)
    if distance > MAX_DEVIATION:
        remeshed, count = draw_back(cleaned, remeshed, edge_length)
        repairs["vertices drawn back to the surface"] = count
        distance = deviation(cleaned, remeshed)
    if distance > MAX_DEVIATION:
        raise MeshError(
            f"remeshing moved its surface by {distance:.1%} of the diagonal, more than {MAX_DEVIATION:.0%}"
        )
    facts = ShapeFacts(
        sha256=content_hash(path),
        faces_read=len(original.faces),
        vertices_read=len(original.vertices),
        faces=len(remeshed.faces),
        vertices=len(remeshed.vertices),
        components=count_components(len(remeshed.vertices), remeshed.faces),
        watertight=is_watertight(cleaned.faces),
        repairs=repairs,
        deviation=distance,
    )
    return normalise(remeshed), facts


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


def deviation(before: Mesh, after: Mesh) -> float:
    """Largest distance found between two surfaces, as a fraction of the diagonal of ``before``.

    The symmetric Hausdorff distance between dense area-weighted samples of the two surfaces, less what the
    spacing of the samples accounts for; so it may fall short of the true one, by about half an edge length.

    Parameters
    ----------
    before, after : Mesh

    Returns
    -------
    float
        At least 0.
    """
    diagonal = float(np.linalg.norm(before.vertices.max(axis=0) - before.vertices.min(axis=0)))
    count = SAMPLES_PER_VERTEX * len(after.vertices)
    first = np.concatenate([_sample(before, count), before.vertices])
    second = np.concatenate([_sample(after, count), after.vertices])
    there = cKDTree(second).query(first)[0].max()
    back = cKDTree(first).query(second)[0].max()
    # Among n even samples on an area A the farthest point of the surface from any is about sqrt(A ln n / (pi n)).
    a, b, c = (after.vertices[after.faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    spacing = np.sqrt(area * np.log(count) / (np.pi * count))
    return float(max(0.0, max(there, back) - spacing) / diagonal)


def draw_back(before: Mesh, after: Mesh, limit: float) -> tuple[Mesh, int]:
    """Put vertices that strayed from a surface back on it.

    The remesher takes large flat faces for patches of a curved surface and may bulge at their rims.

    Parameters
    ----------
    before, after : Mesh
        The surface, and its remeshed version.
    limit : float
        Vertices of ``after`` farther from the surface than this fraction of its diagonal are moved.

    Returns
    -------
    mesh : Mesh
    count : int
        Number of vertices moved.
    """
    diagonal = float(np.linalg.norm(before.vertices.max(axis=0) - before.vertices.min(axis=0)))
    surface = np.concatenate([_sample(before, 10 * len(after.vertices)), before.vertices])
    distances, nearest = cKDTree(surface).query(after.vertices)
    stray = distances > limit * diagonal
    vertices = after.vertices.copy()
    vertices[stray] = surface[nearest[stray]]
    return Mesh(vertices, after.faces), int(stray.sum())


def _sample(mesh: Mesh, count: int) -> FloatArray:
    """About ``count`` points spread evenly over a surface, the same ones every time."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(0)
    position = (np.arange(count) + random.random(count)) / count * area.sum()
    face = np.minimum(np.searchsorted(np.cumsum(area), position), len(area) - 1)
    u, v = random.random((2, count, 1))
    root = np.sqrt(u)
    return (1 - root) * a[face] + root * (1 - v) * b[face] + root * v * c[face]
