"""A surface as binary glTF 2.0, for viewers and other programs, with its colours, and values at its vertices on wish.

https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping, Sequence
from math import sqrt

import numpy as np
import numpy.typing as npt

from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
from shapeviz_report.errors import ConfigError
from shapeviz_report.mesh.paint import to_light
from shapeviz_report.types import FloatArray, IntArray

CLAY = (0.72, 0.69, 0.64)
"""The colour of surfaces without their own, linear red, green and blue."""

_FLOAT, _SHORT, _INT = 5126, 5123, 5125
_VERTICES, _INDICES = 34962, 34963
_HALF = sqrt(0.5)
_UPRIGHT = {
    (1, 1): None,
    (1, -1): (1.0, 0.0, 0.0, 0.0),
    (2, 1): (-_HALF, 0.0, 0.0, _HALF),
    (2, -1): (_HALF, 0.0, 0.0, _HALF),
    (0, 1): (0.0, 0.0, _HALF, _HALF),
    (0, -1): (0.0, 0.0, -_HALF, _HALF),
}
"""Axis and direction that point up -> the quaternion that turns them to y, which points up in glTF."""


def find_dimensions(names: str | None) -> dict[str, int]:
    """Attributes of vertices and the dimension of the descriptors that each holds: of descriptors that are named with
    commas between them, or of ``all``. Raises ``ConfigError`` for a name that is none."""
    wanted = [] if names is None else [name.strip() for name in names.split(",")]
    known = [descriptor.name for descriptor in ALL_DESCRIPTORS]
    if wanted == ["all"]:
        wanted = known
    for name in wanted:
        if name not in known:
            raise ConfigError(
                f"gltf_values names {name!r}, which has no values at vertices; there are: {', '.join(known)}, and all"
            )
    found, start = {}, 0
    for descriptor in ALL_DESCRIPTORS:
        if descriptor.name in wanted:
            for place in range(descriptor.dimensions):
                ending = "" if descriptor.dimensions == 1 else f"_{place}"
                found[f"_{descriptor.name.upper()}{ending}"] = start + place
        start += descriptor.dimensions
    return found


def encode_glb(
    vertices: FloatArray,
    faces: IntArray,
    view: FloatArray,
    values: Mapping[str, npt.NDArray[np.float32]],
    colors: npt.NDArray[np.uint8] | None = None,
) -> bytes:
    """A surface as one file.

    Parameters
    ----------
    vertices : (n, 3) float array
    faces : (m, 3) int array
    view : (3, 3) float array
        As :func:`shapeviz_report.render.choose_view` gives it: of the axes of the file, the one that points up most in
        the picture points up in viewers, too.
    values : mapping of str to (n,) float32 array
        At every vertex, by the names of attributes, which begin with ``_``.
    colors : (n, 3) uint8 array, optional
        sRGB, at every vertex.
    """
    short = len(vertices) < 2**16 - 1  # the last number has a meaning of its own
    positions = vertices.astype("<f4")
    parts: list[npt.NDArray[np.generic]] = [
        faces.astype("<u2" if short else "<u4").ravel(),
        positions,
        *(value.astype("<f4") for value in values.values()),
    ]
    accessors: list[dict[str, object]] = [
        {"componentType": _SHORT if short else _INT, "count": faces.size, "type": "SCALAR"},
        {
            "componentType": _FLOAT,
            "count": len(positions),
            "type": "VEC3",
            "min": positions.min(axis=0).tolist(),
            "max": positions.max(axis=0).tolist(),
        },
        *({"componentType": _FLOAT, "count": len(positions), "type": "SCALAR"} for _ in values),
    ]
    names = ["POSITION", *values]
    if colors is not None:
        # glTF has linear light, of which eight bits would not tell dark colours apart, and rows of whole four bytes
        opaque = np.pad(to_light(colors), ((0, 0), (0, 1)), constant_values=1)
        parts.append(np.round(opaque * 65535).astype("<u2"))
        accessors.append(
            {"componentType": _SHORT, "count": len(positions), "type": "VEC4", "normalized": True}
        )
        names.append("COLOR_0")
    chunks, views, offset = [], [], 0
    for number, part in enumerate(parts):
        content = part.tobytes()
        target = _INDICES if number == 0 else _VERTICES
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(content), "target": target})
        chunks.append(_padded(content, b"\0"))
        offset += len(chunks[-1])
    axis = int(np.abs(view[1]).argmax())
    turn = _UPRIGHT[axis, 1 if view[1, axis] > 0 else -1]
    attributes = {name: number for number, name in enumerate(names, start=1)}
    told = {
        "asset": {"version": "2.0", "generator": "shapeviz-report"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0} if turn is None else {"mesh": 0, "rotation": turn}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 0, "material": 0}]}],
        "materials": [
            {
                "pbrMetallicRoughness": {
                    "baseColorFactor": [*(CLAY if colors is None else (1, 1, 1)), 1],
                    "metallicFactor": 0,
                },
                "doubleSided": True,
            }
        ],
        "accessors": [accessor | {"bufferView": number} for number, accessor in enumerate(accessors)],
        "bufferViews": views,
        "buffers": [{"byteLength": offset}],
    }
    return _container(json.dumps(told, separators=(",", ":")).encode(), chunks)


def _container(told: bytes, chunks: Sequence[bytes]) -> bytes:
    content = b"".join(chunks)
    told = _padded(told, b" ")
    return b"".join(
        [
            struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(told) + 8 + len(content)),
            struct.pack("<I4s", len(told), b"JSON"),
            told,
            struct.pack("<I4s", len(content), b"BIN\0"),
            content,
        ]
    )


def _padded(content: bytes, filler: bytes) -> bytes:
    """To a multiple of four bytes."""
    return content + filler * (-len(content) % 4)
