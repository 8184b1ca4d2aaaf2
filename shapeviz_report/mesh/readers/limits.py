"""How much a mesh file may become. A file of a megabyte can announce or unpack to any size; readers ask here before
they allocate."""

from __future__ import annotations

from shapeviz_report.errors import MeshError

MOST_FACES = 10_000_000
"""Triangles of a mesh, all placed copies of its parts counted. Preparing takes some 0.5 KiB of memory for each."""

MOST_UNPACKED = 1024**3
"""Bytes that a compressed file may unpack to, all its parts together."""


def check_faces(count: int) -> None:
    """Refuse a mesh of too many triangles. Raises ``MeshError``."""
    if count > MOST_FACES:
        raise MeshError(
            f"it has {count:,} triangles, all copies of its parts counted, more than {MOST_FACES:,}; simplify it "
            "before it is exported"
        )


def check_unpacked(size: int) -> None:
    """Refuse a file that unpacks to too many bytes. Raises ``MeshError``."""
    if size > MOST_UNPACKED:
        raise MeshError(
            f"it unpacks to {size / 2**20:,.0f} MiB, more than {MOST_UNPACKED / 2**20:,.0f} MiB; simplify it before it "
            "is exported"
        )
