"""A small real database that builds in seconds."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh

OPTIONS = {"edge_length": 0.06, "thumbnail_size": 64, "jobs": 1, "search": "none"}
"""Coarse meshes, small pictures and no search: the same way through, in seconds, half of them the start of a worker."""

WITH_SEARCH = OPTIONS | {"search": "tsne"}
"""All subsets of features."""


def make_shape(kind: str, index: int) -> trimesh.Trimesh:
    """A box, ball or ring whose proportions depend on the index."""
    random = np.random.default_rng((index, len(kind)))
    if kind == "box":
        return trimesh.creation.box(extents=1 + random.random(3))
    if kind == "ball":
        mesh = trimesh.creation.icosphere(2)
        mesh.apply_scale(1 + random.random(3))
        return mesh
    return trimesh.creation.torus(1, 0.2 + 0.2 * random.random(), 24, 12)


def write_database(root: Path, per_class: int = 5) -> Path:
    for kind in ("box", "ball", "ring"):
        (root / kind).mkdir(parents=True)
        for i in range(per_class):
            make_shape(kind, i).export(root / kind / f"{i}.off")
    return root


def read_site(site: Path) -> dict[str, bytes]:
    """Every file of a site but those that state how long the build took."""
    files = {p.relative_to(site).as_posix(): p.read_bytes() for p in sorted(site.rglob("*")) if p.is_file()}
    timed = ("about.html", "features.html", "data/summary.json", "data/files.json")
    return {name: content for name, content in files.items() if name not in timed}
