"""``summary.json``: counts, failures, quality, times, and what the searches found."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapeviz_report.pages.base import class_names
from shapeviz_report.quality import hit_range, share_of_range
from shapeviz_report.search.certainty import choosing_pays, measure_distinct_gain, measure_gain
from shapeviz_report.types import (
    BinSearch,
    Clusters,
    Faithfulness,
    FeatureSearch,
    Gain,
    HeldOutBins,
    HeldOutFold,
    HitRange,
    Report,
    WithoutCopies,
)
from shapeviz_report.writing.data.encoding import GENERATOR, finite
from shapeviz_report.writing.data.retrieval import named_scores, retrieval_summary
from shapeviz_report.writing.data.separation import separation_summary
from shapeviz_report.writing.data.tables import by_score


def summary(report: Report, version: str) -> dict[str, object]:
    """The content of ``summary.json``: counts, failures, quality, times. Missing numbers are None."""
    classes = class_names(report)
    return {
        "generator": GENERATOR,
        "version": version,
        "database": report.database.name,
        "layout": report.database.layout,
        "labeling": report.labeling,
        "labelings": list(report.database.labelings),
        "shapes": len(report.shapes),
        "classes": len(classes),
        "unlabelled": sum(label is None for label in report.labels),
        "features": [
            {
                "name": block.name,
                "dimensions": block.dimensions,
                "bins": block.bins,
                "weight": block.weight,
            }
            for block in report.features.blocks
        ],
        "failures": [
            {"path": failure.path, "stage": failure.stage, "reason": failure.reason}
            for failure in report.failures
        ],
        "warnings": list(report.database.warnings),
        "repairs": {
            shape.id: dict(facts.repairs)
            for shape, facts in zip(report.shapes, report.facts, strict=True)
            if facts.repairs
        },
        "projections": {
            method: {
                "features": list(projection.features),
                "bins": None if projection.bins is None else list(projection.bins),
                "seed": None if projection.brought else projection.seed,
                "k": quality.k,
                "nh_s": finite(quality.nh_s),
                "nh_c": {name: finite(value) for name, value in quality.nh_c.items()},
                **_range(quality.range, quality.nh_s, quality.null_mean),
                "null": {"mean": finite(quality.null_mean), "std": finite(quality.null_std)},
                "faithfulness": _faithfulness(report.faithfulness.get(method)),
            }
            for method, (projection, quality) in report.projections.items()
        },
        "copies": [[copy.first, copy.second, copy.match.words] for copy in report.copies],
        "without_copies": None if report.without_copies is None else _without_copies(report.without_copies),
        "clusters": None if report.clusters is None else _clusters(report, report.clusters),
        "search": None if report.search is None else _search(report, report.search),
        "bins": None if report.bins is None else _bins(report, report.bins),
        "retrieval": None if report.retrieval is None else retrieval_summary(report.retrieval),
        "separation": None if report.separation is None else separation_summary(report.separation),
        "seconds": dict(report.seconds),
        "cpu_seconds": dict(report.cpu_seconds),
        "parameters": dict(report.parameters),
        "versions": dict(report.versions),
    }


def _without_copies(found: WithoutCopies) -> dict[str, object]:
    return {
        "copies": found.copies,
        "projections": {
            method: {"nh_s": finite(nh_s), "nh_max": found.nh_max} for method, nh_s in found.nh_s.items()
        },
        "bins": None if found.bins is None else {"nh_s": found.bins},
        "best": None if found.best is None else {"nh_s": found.best},
        "retrieval": {name: named_scores(scores) for name, scores in found.retrieval.items()},
    }


def _clusters(report: Report, found: Clusters) -> dict[str, object]:
    return {
        "stand_in": found.stand_in,
        "silhouette": found.silhouette,
        "steadiness": found.steadiness,
        "clusters": [
            {
                "name": cluster.name,
                "central": report.shapes[cluster.central].id,
                "shapes": cluster.size,
                "typical": list(cluster.typical),
            }
            for cluster in found.clusters
        ],
    }


def _faithfulness(found: Faithfulness | None) -> dict[str, object] | None:
    if found is None:
        return None
    return {
        "k": found.k,
        "kept": float(found.kept.mean()),
        "trustworthiness": found.trustworthiness,
        "continuity": found.continuity,
        "stress": found.stress,
        "chance": {
            "kept": found.chance,
            "trustworthiness": found.random,
            "continuity": found.random,
            "stress": found.random_stress,
        },
    }


def _range(limits: HitRange, nh_s: float | None, chance: float | None) -> dict[str, object]:
    """What no map of the shapes exceeds, and how far NH_s is on the way from chance to it."""
    return {
        "nh_max": limits.highest,
        "nh_share": share_of_range(finite(nh_s), chance, limits.highest),
        "nh_c_max": dict(limits.highest_of_class),
        "nh_c_chance": dict(limits.chance_of_class),
    }


def _search(report: Report, search: FeatureSearch) -> dict[str, object]:
    subsets = search.subsets
    limits = hit_range([report.labels[row] for row in search.rows], search.k)
    evaluated = {
        "runs": len(subsets.members),
        "seconds": float(subsets.cpu_seconds.sum()),
        "subsets": [
            {
                "features": _members(search, row),
                "nh_s": finite(subsets.nh_s[row]),
                "nh_c": {name: finite(value) for name, value in zip(search.classes, subsets.nh_c[row])},
                **_range(limits, subsets.nh_s[row], limits.chance),
                "cpu_seconds": float(subsets.cpu_seconds[row]),
            }
            for row in by_score(search)
        ],
    }
    greedy = [
        {
            "s": run.s,
            "runs": run.runs,
            "considered": run.considered,
            "seconds": run.cpu_seconds,
            "path": [
                {
                    "features": list(step.features),
                    "changed": list(step.changed),
                    "nh_s": step.nh_s,
                    "nh_max": limits.highest,
                }
                for step in run.path
            ],
        }
        for run in search.greedy
    ]
    return {
        "method": search.method,
        "seed": search.seed,
        "k": search.k,
        "features": list(search.features),
        "shapes": len(search.rows),
        "refusal": search.refusal,
        "exhaustive": evaluated if search.exhaustive else None,
        "evaluated": None if search.exhaustive else evaluated,
        "greedy": greedy[0] if greedy else None,
        "greedy_all": greedy,
        "table": [
            {
                "round": row.round,
                "method": row.method,
                "s": row.s,
                "features": list(row.features),
                "nh_s": row.nh_s,
                "nh_max": limits.highest,
                "runs": row.runs,
                "seconds": row.cpu_seconds,
            }
            for row in search.table
        ],
        "spread": [
            {
                "features": list(row.features),
                "nh_s": row.nh_s.tolist(),
                "nh_max": limits.highest,
                "mean": row.mean,
                "std": row.std,
                "behind": row.behind,
                "margin": row.margin,
                "told_apart": row.told_apart,
            }
            for row in search.spread
        ],
        "held_out": [
            {
                "deal": fold.deal,
                "seed": fold.seed,
                "features": list(fold.features),
                "shapes": fold.shapes,
                "nh_s_seen": fold.nh_s_seen,
                "nh_s": fold.nh_s,
                "nh_s_all": fold.nh_s_all,
                "nh_max": fold.nh_max,
                **_distinct(fold),
            }
            for fold in search.held_out
        ],
        "held_out_gain": _gain(measure_gain(search.held_out)) if search.held_out else None,
        "held_out_gain_without_copies": _gain(measure_distinct_gain(search.held_out)),
        "null_best": search.null_best.tolist(),
        "effects": {
            effect.feature: {
                "alone": effect.alone,
                "with": effect.mean_with,
                "without": effect.mean_without,
                "added": effect.added,
            }
            for effect in search.effects
        },
    }


def _bins(report: Report, found: BinSearch) -> dict[str, object]:
    automatic = found.automatic
    limits = hit_range([report.labels[row] for row in automatic.rows], automatic.k)
    of_class = hit_range([report.labels[row] for row in found.minimal[0].rows], automatic.k).highest_of_class
    return {
        "automatic": {
            "bins": list(automatic.bins),
            "nh_s": automatic.nh_s,
            "nh_max": limits.highest,
            "nh_share": share_of_range(finite(automatic.nh_s), limits.chance, limits.highest),
            "seconds": automatic.cpu_seconds,
            "seed": automatic.seed,
            "k": automatic.k,
            "shapes": len(automatic.rows),
            "nh_s_other_seeds": automatic.nh_s_other_seeds.tolist(),
            "path": [
                {
                    "bins": list(step.bins),
                    "added": list(step.added),
                    "removed": list(step.removed),
                    "nh_space": step.nh_space,
                    "nh_s": step.nh_s,
                    "nh_max": limits.highest,
                }
                for step in automatic.path
            ],
            "held_out": _folds(found.held_out)
            | {
                "gain": _gain(measure_gain(found.held_out)),
                "gain_without_copies": _gain(measure_distinct_gain(found.held_out)),
                "knn_gain": _gain(measure_gain(found.held_out, "knn_accuracy", "knn_accuracy_all")),
                "pays": choosing_pays(found.held_out),
            },
            "permuted": _folds(found.shuffled) | {"chance": found.chance},
        },
        "minimal": {
            separated.label: [
                {
                    "bins": list(chosen.bins),
                    "nh_c": chosen.nh_c,
                    "nh_c_space": chosen.nh_c_space,
                    "nh_max": of_class[separated.label],
                }
                for chosen in separated.sets
            ]
            for separated in found.minimal
        },
        "minimal_by_chance": {
            str(size): [
                {
                    "bins": list(chosen.bins),
                    "nh_c": chosen.nh_c,
                    "nh_c_space": chosen.nh_c_space,
                    "nh_max": of_class[random.label],
                }
                for chosen in random.sets
            ]
            for size, random in found.minimal_by_chance.items()
        },
    }


def _folds(folds: Sequence[HeldOutBins]) -> dict[str, object]:
    """The folds, and their means with each shape counted once."""
    names = ("nh_s_seen", "nh_space", "nh_s", "nh_s_all", "nh_max", "knn_accuracy", "knn_accuracy_all")
    shapes = [fold.shapes for fold in folds]
    return {
        **{
            name: float(np.average([getattr(fold, name) for fold in folds], weights=shapes)) for name in names
        },
        "folds": [
            {
                "deal": fold.deal,
                "bins": list(fold.bins),
                "shapes": fold.shapes,
                **{name: getattr(fold, name) for name in names},
                **_distinct(fold),
            }
            for fold in folds
        ],
    }


def _distinct(fold: HeldOutFold | HeldOutBins) -> dict[str, object]:
    return {"nh_s_distinct": fold.nh_s_distinct, "nh_s_all_distinct": fold.nh_s_all_distinct}


def _gain(gain: Gain | None) -> dict[str, object] | None:
    if gain is None:
        return None
    return {"mean": gain.mean, "spread": gain.spread, "deals": gain.deals, "sure": gain.is_sure}


def _members(search: FeatureSearch, row: int) -> list[str]:
    return [name for name, has in zip(search.features, search.subsets.members[row], strict=True) if has]
