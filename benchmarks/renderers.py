"""What draws thumbnails: CPU time a picture and its parts, and how far the pictures of two renderers differ.

    python -m benchmarks.renderers MESHES...

A mesh is prepared and drawn by pyrender and by our own depth buffer; medians over the meshes of five pictures each.
"""

from __future__ import annotations

import argparse
import io
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from shapeviz_report.mesh import collect_files, prepare
from shapeviz_report.render import RENDERERS, choose_view, render_thumbnail
from shapeviz_report.render.camera import frame
from shapeviz_report.render.normals import split_at_creases
from shapeviz_report.render.rasteriser import rasterise
from shapeviz_report.render.shading import CLAY, shade
from shapeviz_report.render.thumbnail import SUPERSAMPLING, encode_webp

TIMES = 5


def milliseconds(function: Callable[..., Any], *arguments: Any, **options: Any) -> float:
    """Median CPU time of a call."""
    taken = []
    for _ in range(TIMES):
        start = time.process_time()
        function(*arguments, **options)
        taken.append(1e3 * (time.process_time() - start))
    return float(np.median(taken))


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("meshes", type=Path, nargs="+")
    parser.add_argument("--size", type=int, default=320)
    options = parser.parse_args()
    rows, differences = [], []
    for path in options.meshes:
        mesh, _ = prepare(collect_files(path), 0.01)
        view = choose_view(mesh)
        surface = split_at_creases(mesh)
        camera = frame(surface.positions, view, options.size * SUPERSAMPLING)
        normals = (surface.normals @ camera.rotation.T + 1) / 2
        albedo = np.broadcast_to(np.array(CLAY, np.float32), (camera.size, camera.size, 3))
        pictures = {}
        row = {"view": milliseconds(choose_view, mesh), "creases": milliseconds(split_at_creases, mesh)}
        seen = (surface.positions, surface.faces, normals, camera)
        for name in RENDERERS:
            buffers = rasterise(*seen, name)
            content = render_thumbnail(mesh, view, size=options.size, renderer=name)
            pictures[name] = np.asarray(Image.open(io.BytesIO(content)).convert("RGBA"), float)
            row[name] = milliseconds(rasterise, *seen, name)
            row[f"whole, {name}"] = milliseconds(
                render_thumbnail, mesh, view, size=options.size, renderer=name
            )
        lighting = (buffers.depth, buffers.values * 2 - 1, albedo, camera)
        row["light"] = milliseconds(shade, *lighting)
        row["WebP"] = milliseconds(encode_webp, shade(*lighting))
        rows.append(row)
        one, other = pictures.values()
        apart = np.abs(one - other).max(axis=2)
        there = (one[..., 3] > 0) | (other[..., 3] > 0)
        differences.append((apart[there].mean(), (apart[there] > 16).mean()))
    for name in rows[0]:
        print(f"{name}: {np.median([row[name] for row in rows]):.1f} ms")
    if differences:
        mean, far = np.mean(differences, axis=0)
        print(
            f"{' and '.join(RENDERERS)} differ by {mean:.2f} of 255 a pixel of the shape; {far:.2%} by more than 16"
        )


if __name__ == "__main__":
    main()
