"""The codecs of meshoptimizer, against the library itself, which compresses what is read here."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.meshopt import decode_meshopt

ROOT = Path(__file__).parents[3]
ENCODE = """
import { MeshoptEncoder as encoder } from "meshoptimizer";
await encoder.ready;
const text = (await import("node:fs")).readFileSync(0, "utf8");
const packed = JSON.parse(text).map(({ content, count, stride, mode, exponential }) => {
  let bytes = new Uint8Array(Buffer.from(content, "base64"));
  if (exponential) bytes = encoder.encodeFilterExp(new Float32Array(bytes.buffer), count, stride, 20);
  return Buffer.from(encoder.encodeGltfBuffer(bytes, count, stride, mode, 0)).toString("base64");
});
console.log(JSON.stringify(packed));
"""

pytestmark = pytest.mark.skipif(
    shutil.which("node") is None or not (ROOT / "node_modules" / "meshoptimizer").is_dir(),
    reason="the library is not installed",
)


def encode(*tasks: tuple[np.ndarray, str]) -> list[bytes]:
    """Rows of numbers, each packed in its mode."""
    told = [
        {
            "content": base64.b64encode(values.tobytes()).decode(),
            "count": len(values),
            "stride": values[:1].nbytes,
            "mode": mode.removesuffix(" EXP"),
            "exponential": mode.endswith(" EXP"),
        }
        for values, mode in tasks
    ]
    command = ["node", "--input-type=module", "-e", ENCODE]
    done = subprocess.run(command, input=json.dumps(told).encode(), capture_output=True, cwd=ROOT, check=True)
    return [base64.b64decode(packed) for packed in json.loads(done.stdout)]


def decode(packed: bytes, like: np.ndarray, mode: str) -> np.ndarray:
    exponential = mode.endswith(" EXP")
    content = decode_meshopt(
        packed,
        len(like),
        like[:1].nbytes,
        mode.removesuffix(" EXP"),
        "EXPONENTIAL" if exponential else "NONE",
    )
    return np.frombuffer(content, like.dtype).reshape(like.shape)


def grid(side: int) -> np.ndarray:
    """The triangles of a square of points."""
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    return np.concatenate(
        [
            np.stack([corner, corner + 1, corner + side], 1),
            np.stack([corner + 1, corner + side + 1, corner + side], 1),
        ]
    )


@pytest.mark.slow
def test_what_the_library_packs_is_unpacked() -> None:
    random = np.random.default_rng(0)
    tasks = []
    for count in (1, 15, 16, 17, 300, 5000):
        tasks += [
            (random.random((count, 3)).astype("<f4"), "ATTRIBUTES"),
            (np.sin(np.arange(count * 3).reshape(count, 3) / 50).astype("<f4"), "ATTRIBUTES"),
            (np.cumsum(random.integers(-3, 4, (count, 4)), axis=0).astype("<i2"), "ATTRIBUTES"),
            (random.integers(0, 256, (count, 256)).astype("u1"), "ATTRIBUTES"),
            (np.zeros((count, 4), "<i2"), "ATTRIBUTES"),
            (random.normal(0, 10, (count, 3)).astype("<f4"), "ATTRIBUTES EXP"),
        ]
    for side in (2, 3, 20, 90):
        triangles = grid(side)
        for faces in (
            triangles,
            random.permutation(triangles),
            triangles[:, ::-1],
            random.integers(0, 70, (40, 3)),
        ):
            for kind in ("<u2", "<u4"):
                corners = faces.ravel().astype(kind)
                tasks += [(corners, "TRIANGLES"), (corners, "INDICES")]
    for (values, mode), packed in zip(tasks, encode(*tasks), strict=True):
        found = decode(packed, values, mode)
        if mode == "TRIANGLES":  # which may begin with another corner
            wanted, found = values.reshape(-1, 3), found.reshape(-1, 3)
            turns = [np.roll(wanted, turn, axis=1) for turn in range(3)]
            assert (np.stack([(found == turned).all(axis=1) for turned in turns]).any(axis=0)).all()
        elif mode.endswith("EXP"):
            np.testing.assert_allclose(found, values, rtol=1e-5, atol=1e-4)
        else:
            np.testing.assert_array_equal(found, values)


@pytest.mark.slow
def test_damaged_streams_are_refused_or_give_numbers() -> None:
    random = np.random.default_rng(1)
    tasks = [
        (random.random((100, 3)).astype("<f4"), "ATTRIBUTES"),
        (grid(12).ravel().astype("<u4"), "TRIANGLES"),
        (grid(12).ravel().astype("<u4"), "INDICES"),
    ]
    for (values, mode), packed in zip(tasks, encode(*tasks), strict=True):
        refused = 0
        for number in range(300):
            damaged = bytearray(packed[: -1 - number % 60] if number % 2 else packed)
            for place in random.integers(0, len(damaged), 2):
                damaged[place] = random.integers(256)
            try:
                decode(bytes(damaged), values, mode)
            except MeshError:
                refused += 1
        assert refused > 100, mode


def test_what_is_announced_must_be_there() -> None:
    for mode, stride in (("ATTRIBUTES", 256), ("TRIANGLES", 4), ("INDICES", 4)):
        with pytest.raises(MeshError, match="damaged, cut off"):
            decode_meshopt(b"\xa0" * 1000, 3 * 10**12, stride, mode, "NONE")
