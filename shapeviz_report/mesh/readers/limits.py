"""How much a mesh file may become. A file of a megabyte can announce or unpack to any size; readers ask here before
they allocate."""

from __future__ import annotations

from shapeviz_report.errors import MeshError

MOST_FACES = 10_000_000
"""Triangles of a mesh, all placed copies of its parts counted. Preparing takes some 0.5 KiB of memory for each."""

MOST_UNPACKED = 1024**3
"""Bytes that a compressed file may unpack to, all its parts together."""

MOST_LOOKS = 64 * 1024**2
"""Bytes of all files of a mesh's colours together."""

MOST_CORNERS = 20_000
"""Corners of a polygon. Cutting it takes a time that grows with their square."""

MOST_JSON_BYTES = 256 * 1024**2
"""Bytes of a JSON text, which takes four times as much while it is read: ten million triangles written into it as
base64 take this much or less."""

MOST_JSON_VALUES = 5_000_000
"""Values that a JSON text may have. Each takes up to 100 bytes of memory, and two in the file."""


def check_faces(count: int) -> None:
    """Refuse a mesh of too many triangles. Raises ``MeshError``."""
    if count > MOST_FACES:
        stated = f"{count:,}" if count < 10**12 else "more than 10^12"
        raise MeshError(
            f"it has {stated} triangles, all copies of its parts counted, more than {MOST_FACES:,}; simplify it "
            "before it is exported"
        )


def check_corners(count: int) -> None:
    """Refuse a polygon of too many corners. Raises ``MeshError``."""
    if count > MOST_CORNERS:
        raise MeshError(
            f"it has a polygon of {count:,} corners, more than {MOST_CORNERS:,}; triangulate it before it is exported"
        )


def check_json(text: bytes) -> None:
    """Refuse a JSON text of too many bytes, or values, by the characters that part them. Raises ``MeshError``."""
    if len(text) > MOST_JSON_BYTES:
        raise MeshError(
            f"its JSON has {len(text) / 2**20:,.0f} MiB, more than {MOST_JSON_BYTES / 2**20:,.0f} MiB; export it with "
            "its buffers in files of their own, or as .glb"
        )
    count = text.count(b",") + text.count(b"[") + text.count(b"{")
    if count > MOST_JSON_VALUES:
        raise MeshError(
            f"its JSON has {count:,} values, more than {MOST_JSON_VALUES:,}; join its nodes and meshes before it is "
            "exported"
        )


def check_unpacked(size: int) -> None:
    """Refuse a file that unpacks to too many bytes. Raises ``MeshError``."""
    if size > MOST_UNPACKED:
        raise MeshError(
            f"it unpacks to more than {MOST_UNPACKED / 2**20:,.0f} MiB; simplify it before it is exported"
        )
