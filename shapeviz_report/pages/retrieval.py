"""The Retrieval section of the Features page: how well each choice of features finds shapes of a class."""

from __future__ import annotations

from typing import Any

import numpy as np

from shapeviz_report import charts
from shapeviz_report.pages import chunks
from shapeviz_report.pages.base import class_names, feature_marks, kind_of_group
from shapeviz_report.retrieval import MEASURES, RECALL_LEVELS, best_subset, highest_e_measures
from shapeviz_report.types import FloatArray, Rating, Report, Retrieval

#: Ratings are stored in thousandths, as they are shown.
RATING_STEPS = 1000


def retrieval_context(report: Report, retrieval: Retrieval) -> dict[str, object]:
    """What the template says in words."""
    everything = retrieval.place(retrieval.features)
    best = best_subset(retrieval)
    nearest, first, *_, average = retrieval.over_shapes(retrieval.subsets[everything].scores)
    bins = next(iter(report.projections.values()))[0].bins
    return {
        "shapes": len(retrieval.rows),
        "shape_count": retrieval.shape_count,
        "queries": int(retrieval.queries.sum()),
        "features": len(retrieval.features),
        "subsets": len(retrieval.subsets),
        "nearest": nearest,
        "first": first,
        "average": average,
        "chance": retrieval.over_shapes(retrieval.chance.scores)[0],
        "best": retrieval.names(best),
        "best_is_everything": best == everything,
        "best_average": retrieval.over_shapes(retrieval.subsets[best].scores)[-1],
        "bins": None if retrieval.bins is None else len(retrieval.bins),
        "bins_are_the_site_s": bins is not None,
        "highest_e_measure": float(
            np.average(
                highest_e_measures(retrieval.queries, len(retrieval.rows) - 1), weights=retrieval.queries
            )
        ),
        "measures": _measures(report),
        "without_copies": _without_copies(report),
    }


def _measures(report: Report) -> list[chunks.Measure]:
    kind = kind_of_group(report)
    return [
        {"title": measure.title, "explanation": measure.explanation.replace("class", kind)}
        for measure in MEASURES
    ]


def _without_copies(report: Report) -> dict[str, object] | None:
    """What all features reach where the copies are left out; None without copies, or without a class of two then."""
    found = report.without_copies
    if found is None or not found.retrieval:
        return None
    nearest, *_, average = found.retrieval["everything"]
    return {"copies": found.copies, "nearest": nearest, "average": average}


def retrieval_chunk(report: Report, retrieval: Retrieval) -> chunks.Retrieval:
    """Everything that was rated, for the page's chart and tables."""
    number = {name: index for index, name in enumerate(class_names(report))}
    singles = [retrieval.subsets[retrieval.place((name,))] for name in retrieval.features]
    reached = [retrieval.over_shapes(rating.scores)[-1] for rating in singles]
    return {
        "steps": RATING_STEPS,
        "features": list(retrieval.features),
        "hues": list(charts.feature_color_indices(len(retrieval.features))),
        # By falling average precision of each alone.
        "order": sorted(range(len(reached)), key=lambda index: -reached[index]),
        "classes": [number[name] for name in retrieval.classes],
        "queries": retrieval.queries.tolist(),
        "measures": _measures(report),
        "recall": list(RECALL_LEVELS),
        "members": ["".join("1" if has else "0" for has in row) for row in retrieval.members],
        "best": best_subset(retrieval),
        "subsets": [_rated(retrieval, rating) for rating in retrieval.subsets],
        "bins": None if retrieval.bins is None else list(retrieval.bins),
        "byBins": None if retrieval.by_bins is None else _rated(retrieval, retrieval.by_bins),
        "byNeighbourhood": (
            None if retrieval.by_neighbourhood is None else _rated(retrieval, retrieval.by_neighbourhood)
        ),
        "chance": _rated(retrieval, retrieval.chance),
        "marks": feature_marks(),
    }


def _rated(retrieval: Retrieval, rating: Rating) -> chunks.Rated:
    """The scores and the curve on average over shapes and over classes, and the scores of each class."""
    return {
        "shapes": _steps(retrieval.over_shapes(rating.scores)),
        "classes": _steps(rating.scores.mean(axis=0)),
        "curveOfShapes": _steps(retrieval.over_shapes(rating.precision)),
        "curveOfClasses": _steps(rating.precision.mean(axis=0)),
        "each": _steps(rating.scores),
    }


def _steps(values: FloatArray) -> list[Any]:
    return np.round(values * RATING_STEPS).astype(int).tolist()
