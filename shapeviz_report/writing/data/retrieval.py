"""What is known of retrieval, for ``summary.json`` and for tables. ``docs/using/site-data.md`` describes it."""

from __future__ import annotations

import numpy as np

from shapeviz_report.retrieval import MEASURES, RECALL_LEVELS, best_subset
from shapeviz_report.types import FloatArray, Rating, Retrieval


def retrieval_summary(retrieval: Retrieval) -> dict[str, object]:
    """What each feature alone, all of them, the best subset, the bins and a random order reach."""

    def rated(rating: Rating) -> dict[str, object]:
        return {
            **named_scores(retrieval.over_shapes(rating.scores)),
            "class_mean": named_scores(rating.scores.mean(axis=0)),
            "precision": retrieval.over_shapes(rating.precision).tolist(),
        }

    best = best_subset(retrieval)
    by_bins, neighbourhood = None, retrieval.by_neighbourhood
    if retrieval.bins is not None and retrieval.by_bins is not None:
        by_bins = {"bins": list(retrieval.bins), **rated(retrieval.by_bins)}
    return {
        "shapes": len(retrieval.rows),
        "queries": int(retrieval.queries.sum()),
        "classes": len(retrieval.classes),
        "recall": list(RECALL_LEVELS),
        "features": {name: rated(retrieval.subsets[retrieval.place((name,))]) for name in retrieval.features},
        "everything": rated(retrieval.subsets[retrieval.place(retrieval.features)]),
        "best": {"features": list(retrieval.names(best)), **rated(retrieval.subsets[best])},
        "neighbourhood": None if neighbourhood is None else rated(neighbourhood),
        "bins": by_bins,
        "chance": rated(retrieval.chance),
    }


def retrieval_rows(retrieval: Retrieval) -> list[list[str]]:
    """What everything that was rated reaches on average over shapes, and over classes."""
    rows = [
        [
            *_head(retrieval),
            "over",
            *(measure.name for measure in MEASURES),
            *(f"precision:{level:g}" for level in RECALL_LEVELS),
        ]
    ]
    for compared, rating in _rated(retrieval):
        values = np.hstack([rating.scores, rating.precision])
        rows.append([*compared, "shapes", *map(_number, retrieval.over_shapes(values))])
        rows.append([*compared, "classes", *map(_number, values.mean(axis=0))])
    return rows


def retrieval_class_rows(retrieval: Retrieval) -> list[list[str]]:
    """What everything that was rated reaches on average over the shapes of each class."""
    rows = [[*_head(retrieval), "class", "queries", *(measure.name for measure in MEASURES)]]
    for compared, rating in _rated(retrieval):
        for name, queries, scores in zip(retrieval.classes, retrieval.queries, rating.scores, strict=True):
            rows.append([*compared, name, str(queries), *map(_number, scores)])
    return rows


def _head(retrieval: Retrieval) -> list[str]:
    return [*(f"feature:{name}" for name in retrieval.features), "compared"]


def _rated(retrieval: Retrieval) -> list[tuple[list[str], Rating]]:
    """What was rated: the first cells of its rows, as :func:`_head` names them, and the rating."""
    flags = np.where(retrieval.members, "1", "0").tolist()
    rated = [([*row, "features"], rating) for row, rating in zip(flags, retrieval.subsets, strict=True)]
    nothing = [""] * len(retrieval.features)
    if retrieval.by_neighbourhood is not None:
        rated.append(([*nothing, "neighbourhood"], retrieval.by_neighbourhood))
    if retrieval.by_bins is not None:
        rated.append(([*nothing, "bins"], retrieval.by_bins))
    return [*rated, ([*nothing, "random order"], retrieval.chance)]


def named_scores(values: FloatArray) -> dict[str, float]:
    """The scores (6,) by the names of the measures."""
    return {measure.name: float(value) for measure, value in zip(MEASURES, values, strict=True)}


def _number(value: float) -> str:
    return f"{value:.6f}"
