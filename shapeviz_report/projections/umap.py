"""UMAP (McInnes, Healy, Melville 2018), by its authors."""

from __future__ import annotations

import warnings
from types import ModuleType

from numba.core.dispatcher import Dispatcher

from shapeviz_report.projections.base import Method
from shapeviz_report.types import FloatArray

NEIGHBOURS = 15


def embed(values: FloatArray, seed: int) -> FloatArray:
    """Lay out rows (n, w) with UMAP; (n, 2)."""
    with warnings.catch_warnings():
        # It warns that TensorFlow is missing and that a seed means one thread; both are meant to be so.
        warnings.simplefilter("ignore")
        import umap

        _keep_compiled_code(umap.umap_, umap.layouts, umap.utils)
        reducer = umap.UMAP(n_neighbors=min(NEIGHBOURS, len(values) - 1), random_state=seed, n_jobs=1)
        return reducer.fit_transform(values)


def _keep_compiled_code(*modules: ModuleType) -> None:
    """Let numba store what it compiles of these modules: 15 seconds less in every process after the first."""
    for module in modules:
        for function in vars(module).values():
            if isinstance(function, Dispatcher) and not function.signatures:
                function.enable_caching()


UMAP_METHOD = Method(
    name="umap",
    title="UMAP",
    explanation="Shapes that lie close together are alike. Groups are packed tighter than with t-SNE; the empty "
    "space between them says little about how different they are.",
    smallest=5,
    embed=embed,
)
