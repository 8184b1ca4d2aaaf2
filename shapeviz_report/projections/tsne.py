"""t-SNE (van der Maaten and Hinton 2008), as scikit-learn has it."""

from __future__ import annotations

import numpy as np

from shapeviz_report.projections.base import Method, principal_components
from shapeviz_report.types import FloatArray

PERPLEXITY = 30.0
"""Effective number of neighbours; a third of the other shapes where there are fewer than 91."""

JITTER = 0.01
"""Size of the seeded noise on the start, relative to its extent: what differs between two seeds."""


def embed(values: FloatArray, seed: int) -> FloatArray:
    """Lay out rows (n, w) with t-SNE, started near their principal components; (n, 2)."""
    from sklearn.manifold import TSNE

    start = principal_components(values)
    start += JITTER * start[:, 0].std() * np.random.default_rng(seed).standard_normal(start.shape)
    # The optimiser wants a small start (Kobak and Berens 2019): 1e-4 on the first axis.
    start *= 1e-4 / start[:, 0].std()
    perplexity = min(PERPLEXITY, (len(values) - 1) / 3)
    return TSNE(perplexity=perplexity, init=start, random_state=seed, n_jobs=1).fit_transform(values)


TSNE_METHOD = Method(
    name="tsne",
    title="t-SNE",
    explanation="Shapes that lie close together are alike. How far apart two groups lie, and how wide a group "
    "is spread, means little.",
    smallest=5,
    embed=embed,
)
