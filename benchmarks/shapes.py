"""The prepared meshes that a benchmark runs on."""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from shapeviz_report import demo
from shapeviz_report.config import Config
from shapeviz_report.descriptors import Surface
from shapeviz_report.mesh import collect_files, prepare
from shapeviz_report.types import Mesh


def parser_of_meshes(description: str | None) -> argparse.ArgumentParser:
    """An argument parser that takes mesh files and the edge length they are prepared with."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("meshes", nargs="*", type=Path, help="mesh files (default: one demo shape a class)")
    parser.add_argument(
        "--edge-length", type=float, default=Config().edge_length, help="default: %(default)s"
    )
    return parser


def prepared_shapes(paths: list[Path], edge_length: float) -> Iterator[tuple[str, Mesh]]:
    """Prepare meshes as a build does; without paths, the first demo shape of every class.

    Yields
    ------
    name : str
    mesh : Mesh
    """
    with tempfile.TemporaryDirectory() as folder:
        for path in paths or [demo.write_shape(Path(folder), c.name, 0) for c in demo.CLASSES]:
            yield f"{path.parent.name}/{path.stem}", prepare(collect_files(path), edge_length)[0]


class RoundedSurface(Surface):
    """A surface whose vertices and normals are exact in float32, the precision of the Point Cloud Library.

    What remains different between libraries is then how they compute, not what they compute from.
    """

    def __init__(self, mesh: Mesh) -> None:
        super().__init__(Mesh(mesh.vertices.astype(np.float32).astype(np.float64), mesh.faces))

    @property
    def normals(self) -> np.ndarray:
        """(n, 3) unit vertex normals."""
        return super().normals.astype(np.float32).astype(np.float64)
