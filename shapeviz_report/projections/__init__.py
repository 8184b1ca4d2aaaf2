"""Maps of a database (paper, 3.5): one file a method, ``PROJECTIONS`` in the order a reader meets them."""

from shapeviz_report.projections.base import (
    PAIRWISE_LIMIT,
    Method,
    align,
    arrange,
    bring_along,
    canonical_order,
    project,
    squared_distances,
    turn_towards,
)
from shapeviz_report.projections.diffused import DIFFUSED_METHOD
from shapeviz_report.projections.pca import PCA_METHOD
from shapeviz_report.projections.tsne import TSNE_METHOD
from shapeviz_report.projections.umap import UMAP_METHOD

PROJECTIONS: tuple[Method, ...] = (TSNE_METHOD, UMAP_METHOD, PCA_METHOD, DIFFUSED_METHOD)

MAIN_PROJECTION = PROJECTIONS[0]
"""The one that readers meet first, and by whose maps bins are chosen."""

__all__ = [
    "MAIN_PROJECTION",
    "PAIRWISE_LIMIT",
    "PROJECTIONS",
    "Method",
    "align",
    "arrange",
    "bring_along",
    "canonical_order",
    "project",
    "squared_distances",
    "turn_towards",
]
