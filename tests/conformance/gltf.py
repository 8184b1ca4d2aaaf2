"""glTF 2.0 and its extensions."""

from __future__ import annotations

import base64
import json
from typing import Any

from conformance.cases import BOX, BOX_TRIANGLES, Case, box


def embed(document: dict[str, Any], data: bytes) -> bytes:
    """A ``.gltf`` file with its one buffer within."""
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(document | {"buffers": [{"byteLength": len(data), "uri": uri}]}).encode()


def plain_box() -> Case:
    data = box().astype("<f4").tobytes() + BOX_TRIANGLES.astype("<u2").tobytes()
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 96},
            {"buffer": 0, "byteOffset": 96, "byteLength": 72},
        ],
    }
    return Case("triangles", "box.gltf", {"box.gltf": embed(document, data)}, 52, 24, BOX, 1)


CASES = [plain_box()]
