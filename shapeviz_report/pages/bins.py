"""The Bins page: the few bins that separate a class, those that separate all, and how they look on the shapes
(paper, 4.4; Fig. 6, 7 and 8)."""

from __future__ import annotations

from collections.abc import Sequence
from hashlib import sha256

import numpy as np

from shapeviz_report.exemplars import find_rivals
from shapeviz_report.features import BINS
from shapeviz_report.pages.base import (
    COORDINATE_STEPS,
    PageContent,
    bins_of,
    class_names,
    coordinate_steps,
    distinct_means,
    is_in_full,
    nothing_told,
    rounded,
)
from shapeviz_report.pages.chunks import BinSet, Dimension, Fold, FoundBins, PathStep, Selection
from shapeviz_report.pages.sampling import MOST_SAMPLED
from shapeviz_report.projections import MAIN_PROJECTION
from shapeviz_report.quality import hit_range
from shapeviz_report.render import CLAY, MARKED, ramp_codes
from shapeviz_report.search.certainty import choosing_pays, measure_gain
from shapeviz_report.types import BinSearch, BinStep, FloatArray, HeldOutBins, IntArray, MinimalSet, Report
from shapeviz_report.wording import dimensions_of

#: Decimals of NH.
SCORE_DECIMALS = 6


class BinsPage:
    """Small multiples of the classes with their fewest bins, the path of the selection, and bins on surfaces."""

    name = "bins"
    title = "Bins"
    file = "bins.html"
    within = None

    def content(self, report: Report) -> PageContent:
        found = bins_of(report)
        return PageContent(
            context={
                "classes": len(class_names(report)),
                "nothing": None if report.bins is None else nothing_told(report, report.bins.automatic.k),
                "searched": report.parameters.get("search") != "none",
                "selection": None if found is None else _headline(report, found),
                "models": report.models is not None,
                "sampled": None if is_in_full(report) else MOST_SAMPLED,
            },
            chunks={"selection": _selection(report)},
        )


def painting_name(picture: bytes) -> str:
    """File name of a picture below ``paintings/``, made of its content."""
    return sha256(picture).hexdigest()[:20] + ".webp"


def model_name(model: bytes) -> str:
    """Name of a shape's model: its script is ``models/NAME.js``, and its chunk ``model-NAME``."""
    return sha256(model).hexdigest()[:20]


def _selection(report: Report) -> Selection:
    """What the search for bins found, as far as there is one, and what the views of shapes need. No times: they differ
    from build to build."""
    place = {column: index for index, column in enumerate(report.features.columns)}
    searched = bins_of(report)
    found: FoundBins = {"minimal": [], "path": []} if searched is None else _found(report, searched, place)
    return {
        **found,
        "coordinateSteps": COORDINATE_STEPS,
        "dimensions": _dimensions(report),
        "paintings": [
            {
                "column": place[painting.column],
                "shape": painting.shape,
                "share": round(
                    float(report.features.values[painting.shape, place[painting.column]]), SCORE_DECIMALS
                ),
                "value": f"paintings/{painting_name(painting.value)}",
                "inside": f"paintings/{painting_name(painting.inside)}",
            }
            for painting in report.paintings
        ],
        "models": None if report.models is None else [model_name(model) for model in report.models],
        "ramp": ramp_codes(BINS),
        "clay": list(CLAY),
        "marked": list(MARKED),
    }


def _dimensions(report: Report) -> list[Dimension]:
    """What each dimension of the descriptors measures, and between which values its bins lie, as they are shown."""
    return [
        {
            "quantity": dimension.topic,
            "unit": dimension.unit,
            "edges": [float(f"{edge:.4g}") for edge in dimension.edges],
        }
        for dimension in dimensions_of(report.features, report.edges)
    ]


def _found(report: Report, found: BinSearch, place: dict[str, int]) -> FoundBins:
    automatic = found.automatic
    number = {name: index for index, name in enumerate(class_names(report))}
    projection, hits = next(iter(report.projections.values()))
    of_class = found.minimal[0].rows
    limits = hit_range([report.labels[row] for row in of_class], automatic.k)
    rivals = find_rivals(projection.xy, report.labels, hits.k)
    return {
        "minimal": [
            {
                "group": number[separated.label],
                "other": number[rivals[separated.label]],
                "sets": [_set(chosen, place) for chosen in separated.sets],
                "highest": limits.highest_of_class[separated.label],
                "byChance": [
                    {
                        "nh": round(chosen.nh_c, SCORE_DECIMALS),
                        "nhSpace": round(chosen.nh_c_space, SCORE_DECIMALS),
                    }
                    for chosen in found.by_chance(separated).sets
                ],
            }
            for separated in found.minimal
        ],
        "path": [_step(step, place) for step in automatic.path],
        "rows": _sample(automatic.rows, automatic.shape_count),
        "rowsOfClasses": _sample(of_class, automatic.shape_count),
        "neighbours": automatic.k,
        "seed": automatic.seed,
        "otherSeeds": rounded(automatic.nh_s_other_seeds, SCORE_DECIMALS),
        "heldOut": [_fold(fold, place) for fold in found.held_out],
        "shuffled": [_fold(fold, place) for fold in found.shuffled],
        "chance": round(found.chance, SCORE_DECIMALS),
        "allFeatures": round(all_features(report, found), SCORE_DECIMALS),
    }


def _sample(rows: IntArray, shape_count: int) -> list[int] | None:
    return rows.tolist() if len(rows) < shape_count else None


def _set(chosen: MinimalSet, place: dict[str, int]) -> BinSet:
    x, y = coordinate_steps(chosen.xy).T.tolist()
    return {
        "bins": [place[name] for name in chosen.bins],
        "nhSpace": round(chosen.nh_c_space, SCORE_DECIMALS),
        "nh": round(chosen.nh_c, SCORE_DECIMALS),
        "x": x,
        "y": y,
    }


def _step(step: BinStep, place: dict[str, int]) -> PathStep:
    x, y = coordinate_steps(step.xy).T.tolist()
    return {
        "bins": [place[name] for name in step.bins],
        "added": [place[name] for name in step.added],
        "removed": [place[name] for name in step.removed],
        "nhSpace": round(step.nh_space, SCORE_DECIMALS),
        "nh": round(step.nh_s, SCORE_DECIMALS),
        "x": x,
        "y": y,
    }


def _fold(fold: HeldOutBins, place: dict[str, int]) -> Fold:
    return {
        "bins": [place[name] for name in fold.bins],
        "shapes": fold.shapes,
        "deal": fold.deal,
        "nhSpace": round(fold.nh_space, SCORE_DECIMALS),
        "nh": round(fold.nh_s, SCORE_DECIMALS),
        "nhAll": round(fold.nh_s_all, SCORE_DECIMALS),
        "recognised": round(fold.knn_accuracy, SCORE_DECIMALS),
        "recognisedAll": round(fold.knn_accuracy_all, SCORE_DECIMALS),
    }


def all_features(report: Report, found: BinSearch) -> float:
    """NH_s of the map of all features: the one that the site shows, if it shows all shapes on one."""
    whole = len(found.automatic.rows) == found.automatic.shape_count
    shown = report.projections.get(MAIN_PROJECTION.name)
    if whole and shown is not None and shown[0].bins is None and shown[1].nh_s is not None:
        return shown[1].nh_s
    return mean_over_folds(found.held_out, "nh_s_all")


def mean_over_folds(folds: Sequence[HeldOutBins], name: str) -> float:
    """The mean of a field over folds, in which each shape counts once."""
    values: FloatArray = np.array([getattr(fold, name) for fold in folds])
    return float(np.average(values, weights=[fold.shapes for fold in folds]))


def _headline(report: Report, found: BinSearch) -> dict[str, object]:
    """What the template says in words."""
    automatic = found.automatic
    return {
        "bins": len(automatic.bins),
        "of": len(report.features.columns),
        "nh_s": automatic.nh_s,
        "highest": hit_range([report.labels[row] for row in automatic.rows], automatic.k).highest,
        "other_seeds": float(automatic.nh_s_other_seeds.mean()),
        "all_features": all_features(report, found),
        "chance": found.chance,
        "shapes": len(automatic.rows),
        "shape_count": automatic.shape_count,
        "neighbours": automatic.k,
        "folds": len(found.held_out),
        "deals": len({fold.deal for fold in found.held_out}),
        "held_out": _means(found.held_out),
        "gain": measure_gain(found.held_out),
        "distinct": distinct_means(found.held_out),
        "without_copies": report.without_copies,
        "recognition_gain": measure_gain(found.held_out, "knn_accuracy", "knn_accuracy_all"),
        "pays": choosing_pays(found.held_out),
        "shapes_of_class": len(found.minimal[0].rows),
        "shuffled": _means(found.shuffled),
        "shuffled_seen": mean_over_folds(found.shuffled, "nh_s_seen"),
        "separated": len(found.minimal),
    }


def _means(folds: Sequence[HeldOutBins]) -> dict[str, float]:
    return {
        "nh_s": mean_over_folds(folds, "nh_s"),
        "all": mean_over_folds(folds, "nh_s_all"),
        "recognised": mean_over_folds(folds, "knn_accuracy"),
        "recognised_all": mean_over_folds(folds, "knn_accuracy_all"),
    }
