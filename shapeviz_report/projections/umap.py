"""UMAP (McInnes, Healy, Melville 2018), by its authors."""

from __future__ import annotations

import warnings

from shapeviz_report.projections.base import Method
from shapeviz_report.types import FloatArray

NEIGHBOURS = 15


def embed(values: FloatArray, seed: int) -> FloatArray:
    """Lay out rows (n, w) with UMAP; (n, 2)."""
    with warnings.catch_warnings():
        # It warns that TensorFlow is missing and that a seed means one thread; both are meant to be so.
        warnings.simplefilter("ignore")
        from umap import UMAP

        reducer = UMAP(n_neighbors=min(NEIGHBOURS, len(values) - 1), random_state=seed, n_jobs=1)
        return reducer.fit_transform(values)


UMAP_METHOD = Method(
    name="umap",
    title="UMAP",
    explanation="Shapes that lie close together are alike. Groups are packed tighter than with t-SNE; the empty "
    "space between them says little about how different they are.",
    smallest=5,
    embed=embed,
)
