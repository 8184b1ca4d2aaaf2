"""Scenes: parts that a tree of nodes places, as often as it names them."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.limits import check_faces
from shapeviz_report.mesh.readers.polygons import Indices
from shapeviz_report.types import FloatArray

_UNCOUNTABLE = 10**18
"""Where counting stops: nodes that name each other twice double it with every level."""

Key = TypeVar("Key", bound=Hashable)


@dataclass(frozen=True)
class Node(Generic[Key]):
    """One node of a scene.

    Attributes
    ----------
    transform : (4, 4) float64 array
        From the node to its parent; points are columns.
    children : sequence of keys
    triangles : int
        That the node itself shows.
    """

    transform: FloatArray
    children: Sequence[Key]
    triangles: int


@dataclass(frozen=True)
class Part:
    """Triangles, and where they are placed.

    Attributes
    ----------
    vertices : (n, 3) float64 array
    faces : (m, 3) int64 array
    transforms : (k, 4, 4) float64 array
        One a copy.
    """

    vertices: FloatArray
    faces: Indices
    transforms: FloatArray


def place_nodes(nodes: Mapping[Key, Node[Key]], roots: Sequence[Key]) -> dict[Key, FloatArray]:
    """Where a scene shows its nodes: as often as ways lead to each.

    Parameters
    ----------
    nodes : mapping
        Every root and child is a key.
    roots : sequence of keys

    Returns
    -------
    dict
        Key -> (k, 4, 4) float64, from the node to the scene, for the nodes that have triangles.

    Raises
    ------
    MeshError
        If nodes contain themselves, or the copies have too many triangles: before any is made.
    """
    order = _children_first(nodes, roots)
    counts: dict[Key, int] = {}
    for key in order:
        node = nodes[key]
        counts[key] = min(node.triangles + sum(counts[child] for child in node.children), _UNCOUNTABLE)
    check_faces(min(sum(counts[root] for root in roots), _UNCOUNTABLE))
    arriving: dict[Key, list[FloatArray]] = {key: [] for key in order}
    for root in roots:
        arriving[root].append(np.eye(4)[None])
    placed = {}
    for key in reversed(order):
        transforms, node = arriving.pop(key), nodes[key]
        if counts[key]:  # so that there are never more copies than triangles
            here = np.concatenate(transforms) @ node.transform
            for child in node.children:
                if counts[child]:
                    arriving[child].append(here)
            if node.triangles:
                placed[key] = here
    return placed


def _children_first(nodes: Mapping[Key, Node[Key]], roots: Iterable[Key]) -> list[Key]:
    """Every node that can be reached, after all that it contains; without recursion, for chains may be long."""
    order: list[Key] = []
    done: dict[Key, bool] = {}
    for root in roots:
        stack = [] if root in done else [(root, iter(nodes[root].children))]
        done.setdefault(root, False)
        while stack:
            key, children = stack[-1]
            child = next(children, None)
            if child is None:
                done[key] = True
                order.append(key)
                stack.pop()
            elif child not in done:
                done[child] = False
                stack.append((child, iter(nodes[child].children)))
            elif not done[child]:
                raise MeshError("a node of its scene contains itself")
    return order


def join_values(parts: Sequence[Part], values: Sequence[npt.NDArray[Any]]) -> npt.NDArray[Any]:
    """Rows (n, ...) for the vertices of :func:`join_parts`, of rows for the vertices of each part."""
    joined = []
    for part, rows in zip(parts, values, strict=True):
        if len(part.faces):
            used = np.zeros(len(part.vertices), bool)
            used[part.faces] = True
            joined += [rows[used]] * len(part.transforms)
    return np.concatenate(joined)


def join_corners(parts: Sequence[Part], values: Sequence[npt.NDArray[Any]]) -> npt.NDArray[Any]:
    """Rows (m, 3, ...) for the corners of the triangles of :func:`join_parts`, of rows for those of each part."""
    joined = []
    for part, rows in zip(parts, values, strict=True):
        if len(part.faces):
            copies = np.repeat(rows[None], len(part.transforms), axis=0)
            mirrored = np.linalg.det(part.transforms[:, :3, :3]) < 0
            copies[mirrored] = copies[mirrored, :, ::-1]
            joined.append(copies.reshape(-1, *rows.shape[1:]))
    return np.concatenate(joined)


def join_parts(parts: Iterable[Part]) -> tuple[FloatArray, Indices]:
    """Vertices (n, 3) and triangles (m, 3) of all copies of all parts.

    Vertices that no triangle uses are dropped. A copy that is mirrored has its triangles turned round, so that they
    look outwards still.
    """
    vertices: list[FloatArray] = [np.empty((0, 3))]
    faces: list[Indices] = [np.empty((0, 3), np.int64)]
    count = 0
    for part in parts:
        if not len(part.faces):
            continue
        used = np.zeros(len(part.vertices), bool)
        used[part.faces] = True
        points, triangles = part.vertices[used], (np.cumsum(used) - 1)[part.faces]
        linear = part.transforms[:, :3, :3]
        moved = points @ linear.transpose(0, 2, 1) + part.transforms[:, None, :3, 3]
        mirrored = np.linalg.det(linear) < 0
        copies = triangles + (count + len(points) * np.arange(len(moved)))[:, None, None]
        copies[mirrored] = copies[mirrored, :, ::-1]
        vertices.append(moved.reshape(-1, 3))
        faces.append(copies.reshape(-1, 3))
        count += moved.shape[0] * moved.shape[1]
    return np.concatenate(vertices), np.concatenate(faces)
