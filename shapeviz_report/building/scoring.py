"""How good the maps are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from shapeviz_report.config import Config
from shapeviz_report.faithfulness import rate_maps
from shapeviz_report.quality import score
from shapeviz_report.separation import rate_separation
from shapeviz_report.types import Faithfulness, FloatArray, Projection, Quality, Separation


class ScoredMaps(NamedTuple):
    """Maps, and what they are worth.

    Attributes
    ----------
    maps : dict of str to (Projection, Quality)
        By name.
    faithfulness : dict of str to Faithfulness
        By the same names.
    separation : Separation or None
    best : (Projection, Quality, Faithfulness) or None
        The map of all shapes by the best subset of features, where it is another one.
    """

    maps: dict[str, tuple[Projection, Quality]]
    faithfulness: dict[str, Faithfulness]
    separation: Separation | None
    best: tuple[Projection, Quality, Faithfulness] | None


def score_maps(
    projections: Mapping[str, Projection],
    mapped: FloatArray,
    labels: Sequence[str | None],
    best: tuple[Projection, FloatArray] | None,
    config: Config,
) -> ScoredMaps:
    """Rate maps by the labels, and by the values that they compare.

    Parameters
    ----------
    projections : mapping of str to Projection
        By name.
    mapped : (n, w) float64 array
        The values that they compare.
    labels : n labels
        None for a shape without one.
    best : (Projection, (n, v) float64 array) or None
        The map of the best subset of features, and the values that it compares.
    config : Config
    """
    k, seed = config.neighbours, config.seed
    places = {name: projection.xy for name, projection in projections.items()}
    scored_best = None
    if best is not None:
        projection, values = best
        faithfulness = rate_maps(values, {"best": projection.xy}, k)["best"]
        scored_best = (projection, score(projection.xy, labels, k=k, seed=seed), faithfulness)
    return ScoredMaps(
        maps={
            name: (projection, score(projection.xy, labels, k=k, seed=seed))
            for name, projection in projections.items()
        },
        faithfulness=rate_maps(mapped, places, k),
        separation=rate_separation(mapped, places, labels, k, seed=seed),
        best=scored_best,
    )
