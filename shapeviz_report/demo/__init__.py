"""The demo database: parametric, articulated shapes, generated from a seed instead of downloaded.

Every shape is a closed 2-manifold of one component. It stands upright (``z`` up) and faces ``-y``, and depends on
its class, its index and the seed alone.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from shapeviz_report.demo import (
    airplane,
    ant,
    bird,
    chair,
    cup,
    fish,
    fourleg,
    glasses,
    hand,
    human,
    octopus,
    plier,
    table,
    teddy,
)
from shapeviz_report.demo.classes import DemoClass
from shapeviz_report.demo.surface_nets import mesh_solid
from shapeviz_report.types import Mesh

__all__ = ["CLASSES", "PER_CLASS", "DemoClass", "encode_shape", "make_shape", "shape_path", "write_shape"]

PER_CLASS = 12
"""Shapes a class in the demo database."""

CLASSES: tuple[DemoClass, ...] = (
    airplane.AIRPLANE,
    ant.ANT,
    bird.BIRD,
    chair.CHAIR,
    cup.CUP,
    fish.FISH,
    fourleg.FOURLEG,
    glasses.GLASSES,
    hand.HAND,
    human.HUMAN,
    octopus.OCTOPUS,
    plier.PLIER,
    table.TABLE,
    teddy.TEDDY,
)


def make_shape(class_name: str, index: int, seed: int = 0) -> Mesh:
    """Generate one shape.

    Parameters
    ----------
    class_name : str
        The name of one of :data:`CLASSES`.
    index : int
        Any number from 0 on; the kinds of a class take turns.
    seed : int
        Of the whole database. The shape depends on nothing but these three.

    Returns
    -------
    Mesh
        A closed 2-manifold of one component.

    Raises
    ------
    KeyError
        If there is no such class.
    """
    demo_class = {entry.name: entry for entry in CLASSES}[class_name]
    entropy = (seed, *class_name.encode(), index)
    rng = np.random.default_rng(np.random.SeedSequence(entropy))
    kind = demo_class.kinds[index % len(demo_class.kinds)]
    return mesh_solid(demo_class.model(rng, kind))


def shape_path(root: Path, class_name: str, index: int) -> Path:
    """Where a shape belongs in the folder of the demo database."""
    return Path(root) / class_name / f"{index:02d}.off"


def encode_shape(class_name: str, index: int, seed: int = 0) -> bytes:
    """Generate one shape as the content of an OFF file; see :func:`make_shape`."""
    mesh = make_shape(class_name, index, seed)
    lines = ["OFF", f"{len(mesh.vertices)} {len(mesh.faces)} 0"]
    lines += [f"{x:.6f} {y:.6f} {z:.6f}" for x, y, z in mesh.vertices.tolist()]
    lines += [f"3 {a} {b} {c}" for a, b, c in mesh.faces.tolist()]
    return ("\n".join(lines) + "\n").encode("ascii")


def write_shape(root: Path, class_name: str, index: int, seed: int = 0) -> Path:
    """Generate one shape and write it to ``root/CLASS/NN.off``.

    Returns
    -------
    Path
        The file.
    """
    path = shape_path(root, class_name, index)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(encode_shape(class_name, index, seed))
    return path
