"""3D models as the page reads them."""

from __future__ import annotations

import numpy as np

from shapeviz_report.models import POSITION_STEPS


def unpack(content: bytes) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """View, vertices, faces and bins of a model that :func:`shapeviz_report.models.pack_model` packed."""
    v, f, d = map(int, np.frombuffer(content, "<u4", 3))
    parts, at = [], 12
    for dtype, shape in (
        ("<f4", (3, 3)),
        ("<i2", (3, v)),
        ("<i4", (f,)),
        ("<i4", (2, f)),
        ("u1", (d, (v + 1) // 2)),
    ):
        size = int(np.prod(shape))
        parts.append(np.frombuffer(content, dtype, size, at).reshape(shape))
        at += parts[-1].nbytes
    assert at == len(content)
    view, positions, first, others, nibbles = parts
    first = np.cumsum(first)
    bins = np.stack([nibbles & 15, nibbles >> 4], axis=2).reshape(d, -1)[:, :v]
    return view, positions.T / POSITION_STEPS, np.column_stack([first, (others + first).T]), bins
