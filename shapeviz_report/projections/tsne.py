"""t-SNE (van der Maaten and Hinton 2008): exact for databases of usual size, openTSNE's (Policar et al. 2024) above."""

from __future__ import annotations

import numpy as np

from shapeviz_report.projections.base import Method, classical_scaling, principal_components
from shapeviz_report.projections.kernels.nearest import nearest_rows
from shapeviz_report.types import FloatArray

PERPLEXITY = 30.0
"""Most effective neighbours; see :func:`perplexity_of`."""

ALL_PAIRS = 300
"""Up to this many rows all pairs have an affinity, as in the original paper. With more, each row has one with the
3 ``PERPLEXITY`` nearest, as in the libraries: the many far ones blur groups in noisy features."""

EXAGGERATION, EXAGGERATION_NEAREST = 4.0, 8.0
"""Factor on the affinities at first: the original paper's for all pairs, and one between that and today's custom of
12 for the nearest. docs/method/search.md compares them."""

EXAGGERATION_LARGE = 12.0
"""The same above :data:`~shapeviz_report.projections.base.PAIRWISE_LIMIT` rows, as is the custom."""

JITTER = 0.01
"""Size of the seeded noise on the start, relative to its extent: what differs between two seeds."""


def arrange(squared: FloatArray, seed: int) -> FloatArray:
    """Lay out rows by their squared distances (n, n) with exact t-SNE, started near their principal components.

    Returns
    -------
    (n, 2) float32 array
    """
    from shapeviz_report.projections.kernels import exact_tsne

    count = len(squared)
    perplexity = perplexity_of(count)
    if count <= ALL_PAIRS:
        neighbours, exaggeration = count - 1, EXAGGERATION
    else:
        neighbours, exaggeration = int(3 * perplexity), EXAGGERATION_NEAREST
    shares = exact_tsne.affinities(np.asarray(squared, dtype=np.float32), perplexity, neighbours)
    start = _start(classical_scaling(squared), seed).astype(np.float32)
    # Belkina et al. 2019: rows over exaggeration; 4 stands in the gradient already.
    rate = max(count / exaggeration / 4, 50.0)
    return exact_tsne.descend(shares, start, np.float32(exaggeration), np.float32(rate))


def embed(values: FloatArray, seed: int) -> FloatArray:
    """Lay out rows (n, w) with openTSNE from the same start, in time that grows as their number does; (n, 2).

    Forces are interpolated on a grid (Linderman et al. 2019) instead of summed over all pairs.
    """
    from openTSNE import TSNEEmbedding
    from openTSNE.affinity import PerplexityBasedNN
    from openTSNE.nearest_neighbors import PrecomputedNeighbors

    perplexity = perplexity_of(len(values))
    rows, distances = nearest_rows(values, int(3 * perplexity), seed)
    nearest = PrecomputedNeighbors(rows, distances.astype(np.float64))
    affinities = PerplexityBasedNN(knn_index=nearest, perplexity=perplexity, n_jobs=1)
    embedding = TSNEEmbedding(
        _start(principal_components(values), seed),
        affinities,
        negative_gradient_method="fft",
        random_state=seed,
        n_jobs=1,
    )
    # As in `arrange`: rows over exaggeration (Belkina et al. 2019), here for both phases.
    embedding.optimize(250, exaggeration=EXAGGERATION_LARGE, momentum=0.5, inplace=True)
    embedding.optimize(500, momentum=0.8, inplace=True)
    return np.asarray(embedding)


def perplexity_of(count: int) -> float:
    """Effective number of neighbours on a map of so many shapes: the square root of their number, up to 30.

    Up to a third of the other shapes, where there are few. docs/notes/features.md has what other rules give.
    """
    return min(PERPLEXITY, count**0.5, (count - 1) / 3)


def _start(components: FloatArray, seed: int) -> FloatArray:
    """Principal components (n, 2) with seeded noise, scaled down to 1e-4 on the first axis.

    The optimiser wants a small start (Kobak and Berens 2019).
    """
    size = components[:, 0].std()
    start = components + JITTER * size * np.random.default_rng(seed).standard_normal(components.shape)
    return start * (1e-4 / start[:, 0].std())


TSNE_METHOD = Method(
    name="tsne",
    title="t-SNE",
    explanation="Shapes that lie close together are alike. How far apart two groups lie, and how wide a group "
    "is spread, means little.",
    smallest=5,
    arrange=arrange,
    embed=embed,
    rounds=3,
)
