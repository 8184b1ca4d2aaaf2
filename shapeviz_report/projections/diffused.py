"""t-SNE of diffused distances: groups as chains of near shapes make them."""

from __future__ import annotations

from shapeviz_report.diffusion import diffuse
from shapeviz_report.projections import tsne
from shapeviz_report.projections.base import Method
from shapeviz_report.types import FloatArray


def arrange(squared: FloatArray, seed: int) -> FloatArray:
    """Lay out rows by their squared distances (n, n): exact t-SNE of what these are when
    :func:`~shapeviz_report.diffusion.diffuse` has been through them.

    Returns
    -------
    (n, 2) float32 array
    """
    return tsne.arrange(diffuse(squared), seed)


DIFFUSED_METHOD = Method(
    name="diffused",
    title="Diffused",
    explanation="t-SNE of distances that count two shapes as near when they are near to the same others. Groups "
    "stand apart more clearly here than the features alone set them: look at another map before you trust a gap.",
    smallest=5,
    arrange=arrange,
    embed=None,
)
