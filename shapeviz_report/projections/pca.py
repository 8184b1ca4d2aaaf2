"""Principal component analysis: the straight view, for reference."""

from __future__ import annotations

from shapeviz_report.projections.base import Method, classical_scaling, principal_components
from shapeviz_report.types import FloatArray


def arrange(squared: FloatArray, seed: int) -> FloatArray:
    """Lay out rows by their squared distances (n, n); (n, 2). The seed has no effect."""
    return classical_scaling(squared)


def embed(values: FloatArray, seed: int) -> FloatArray:
    """Lay out rows (n, w) along their first two principal axes; (n, 2). The seed has no effect."""
    return principal_components(values)


PCA_METHOD = Method(
    name="pca",
    title="PCA",
    explanation="The two directions in which the features vary most. Shapes far apart do differ; shapes close "
    "together may still differ in a direction that is not shown.",
    smallest=2,
    arrange=arrange,
    embed=embed,
)
