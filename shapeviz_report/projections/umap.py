"""UMAP (McInnes, Healy, Melville 2018), by its authors."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import keep_compiled
from shapeviz_report.projections.base import Method
from shapeviz_report.projections.kernels.nearest import nearest_rows
from shapeviz_report.types import FloatArray

NEIGHBOURS = 15


def arrange(squared: FloatArray, seed: int) -> FloatArray:
    """Lay out rows by their squared distances (n, n) with UMAP; (n, 2).

    Handing over the nearest neighbours gives the same map, and spares a fresh installation 13 of 22 seconds
    of compiling UMAP's own search for them.
    """
    distances = np.sqrt(squared).astype(np.float32)
    ranked = distances.copy()
    # A point is its own first neighbour, also among points that lie in one place.
    np.fill_diagonal(ranked, -1)
    nearest = np.argsort(ranked, axis=1, kind="stable")[:, : _neighbours(len(squared))].astype(np.int32)
    neighbours = (nearest, np.take_along_axis(distances, nearest, axis=1))
    return _fit(distances, seed, metric="precomputed", precomputed_knn=neighbours)


def embed(values: FloatArray, seed: int) -> FloatArray:
    """Lay out rows (n, w) with UMAP; (n, 2)."""
    rows, distances = nearest_rows(values, _neighbours(len(values)) - 1, seed)
    # UMAP counts a point as its own first neighbour.
    own = np.arange(len(values), dtype=np.int32)[:, None]
    nearest = (np.hstack([own, rows]), np.pad(distances, ((0, 0), (1, 0))), None)
    return _fit(values, seed, precomputed_knn=nearest, force_approximation_algorithm=True)


def _neighbours(count: int) -> int:
    return min(NEIGHBOURS, count - 1)


def _fit(values: npt.NDArray[np.floating], seed: int, **options: Any) -> FloatArray:
    with warnings.catch_warnings():
        # It warns that TensorFlow is missing, that a seed means one thread, and that new points cannot be added
        # to the map; all are meant to be so.
        warnings.simplefilter("ignore")
        import umap

        # 15 seconds less in every process after the first
        keep_compiled("umap", umap.umap_, umap.layouts, umap.utils)
        reducer = umap.UMAP(n_neighbors=_neighbours(len(values)), random_state=seed, n_jobs=1, **options)
        return reducer.fit_transform(values)


UMAP_METHOD = Method(
    name="umap",
    title="UMAP",
    explanation="Shapes that lie close together are alike. Groups are packed tighter than with t-SNE; the empty "
    "space between them says little about how different they are.",
    smallest=5,
    arrange=arrange,
    embed=embed,
    rounds=1,  # a map costs ten times as much as one by t-SNE
)
