"""Other libraries' PFH and FPFH of the same points, brought into our order of cells and to fractions."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Literal

import numpy as np

from shapeviz_report.descriptors import Surface
from shapeviz_report.types import FloatArray

PCL_PROGRAM = Path(__file__).parents[1] / "build" / "pcl" / "pcl_histograms"
"""Where benchmarks/README.md has it built."""


def require_peers() -> None:
    """End the program, before anything is measured, if another library is missing."""
    missing = [name for name in ("open3d", "rtree") if importlib.util.find_spec(name) is None]
    missing += [] if PCL_PROGRAM.exists() else [str(PCL_PROGRAM)]
    if missing:
        sys.exit(f"Not there: {', '.join(missing)}. benchmarks/README.md says how to get it.")


def with_self(surface: Surface) -> np.ndarray:
    """(n, 31) each vertex, then its 30 neighbours."""
    own = np.arange(len(surface.vertices), dtype=np.int32)[:, None]
    return np.concatenate([own, surface.neighbours], axis=1)


def run_pcl(
    kind: Literal["pfh", "fpfh"], surface: Surface, neighbourhoods: np.ndarray | None
) -> tuple[FloatArray, float]:
    """PFH or FPFH by the Point Cloud Library.

    Parameters
    ----------
    neighbourhoods : (n, k) int32 array or None
        Each beginning with the vertex itself; None has the library search the 31 nearest.

    Returns
    -------
    values : (n, 125) or (n, 3, 11) array
        As :mod:`benchmarks.pair_histograms` orders them, in fractions.
    seconds : float
        CPU time from points to values.
    """
    with tempfile.TemporaryDirectory() as folder:
        surface.vertices.astype(np.float32).tofile(f"{folder}/points.f32")
        surface.normals.astype(np.float32).tofile(f"{folder}/normals.f32")
        command = [str(PCL_PROGRAM), kind, folder, "31"]
        if neighbourhoods is not None:
            neighbourhoods.astype(np.int32).tofile(f"{folder}/neighbours.i32")
            command[-1:] = [str(neighbourhoods.shape[1]), "listed"]
        run = subprocess.run(command, check=True, capture_output=True, text=True)
        values = np.fromfile(f"{folder}/values.f32", np.float32).astype(np.float64) / 100
    if kind == "fpfh":
        return theta_last(values), float(run.stdout)
    # Its cells are theta + 5 alpha + 25 phi.
    cells = values.reshape(-1, 5, 5, 5).transpose(0, 2, 1, 3)
    return np.ascontiguousarray(cells).reshape(-1, 125), float(run.stdout)


def run_open3d(surface: Surface) -> tuple[FloatArray, float]:
    """FPFH by Open3D, from the 31 nearest points that its own tree finds, in one thread.

    Returns
    -------
    values : (n, 3, 11) array
        As :mod:`benchmarks.pair_histograms` orders them; its groups add up to 200, here to 1.
    seconds : float
        CPU time from points to values.
    """
    os.environ["OMP_NUM_THREADS"] = "1"  # read when the library is loaded
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(surface.vertices))
    cloud.normals = open3d.utility.Vector3dVector(surface.normals)
    start = time.process_time()
    feature = open3d.pipelines.registration.compute_fpfh_feature(
        cloud, open3d.geometry.KDTreeSearchParamKNN(31)
    )
    seconds = time.process_time() - start
    return theta_last(np.asarray(feature.data).T / 200), seconds


def theta_last(values: FloatArray) -> FloatArray:
    """Reorder the groups theta, alpha, phi of an FPFH (n, 33) to alpha, phi, theta (n, 3, 11)."""
    return values.reshape(-1, 3, 11)[:, [1, 2, 0]]
