"""The site's ``data/`` folder: what a build found, for machines. ``docs/using/site-data.md`` describes it.

Everything here but the times in ``summary.json`` depends on the input alone, so two builds of the same database
write the same bytes.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from shapeviz_report.cells import write_cell
from shapeviz_report.pages.base import class_names
from shapeviz_report.projections import MAIN_PROJECTION
from shapeviz_report.quality import hit_range, share_of_range
from shapeviz_report.search.certainty import measure_distinct_gain, measure_gain
from shapeviz_report.types import (
    BinSearch,
    BinSelection,
    Clusters,
    FeatureSearch,
    Gain,
    HeldOutBins,
    HeldOutFold,
    HitRange,
    Report,
    WithoutCopies,
)
from shapeviz_report.writing.retrieval_data import (
    named_scores,
    retrieval_class_rows,
    retrieval_rows,
    retrieval_summary,
)

#: Tells a folder that this package wrote from one that it must not replace.
GENERATOR = "shapeviz-report"


def data_files(report: Report, version: str) -> dict[str, bytes]:
    """``summary.json``, ``shapes.csv``, ``features.npz``, one ``projection-METHOD.csv`` a projection, and what a search
    found in ``subsets.csv``, ``greedy.csv`` and ``table2.csv``, the scores of bins in ``scores.npz``, the bins that
    separate all classes in ``selected-bins.txt``, and how well shapes are found in ``retrieval.csv`` and
    ``retrieval-classes.csv``, by name.

    Parameters
    ----------
    report : Report
    version : str
        Of this package.
    """
    files = {
        "summary.json": (json_text(summary(report, version), indent=1) + "\n").encode(),
        "shapes.csv": _csv(_shape_rows(report)),
        "features.npz": _archive(
            values=np.ascontiguousarray(report.features.values, dtype=np.float64),
            columns=np.array(report.features.columns, dtype=np.str_),
            shape_ids=np.array(report.features.shape_ids, dtype=np.str_),
            edges=report.edges,
        ),
    }
    for method, (projection, _) in report.projections.items():
        points = zip(report.shapes, projection.xy, strict=True)
        rows = [["id", "x", "y"], *([shape.id, _number(x), _number(y)] for shape, (x, y) in points)]
        files[f"projection-{method}.csv"] = _csv(rows)
    if report.search is not None:
        limits = hit_range([report.labels[row] for row in report.search.rows], report.search.k)
        files["subsets.csv"] = _csv(_subset_rows(report.search, limits))
        if report.search.table:
            files["greedy.csv"] = _csv(_greedy_rows(report.search, limits))
            files["table2.csv"] = _csv(_table_rows(report.search, limits))
    if report.scores is not None:
        files["scores.npz"] = _archive(
            scores=report.scores.values,
            methods=np.array(report.scores.methods, dtype=np.str_),
            classes=np.array(report.scores.classes, dtype=np.str_),
            columns=np.array(report.features.columns, dtype=np.str_),
        )
    if report.retrieval is not None:
        files["retrieval.csv"] = _csv(retrieval_rows(report.retrieval))
        files["retrieval-classes.csv"] = _csv(retrieval_class_rows(report.retrieval))
    if report.copies:
        files["copies.csv"] = _csv(_copy_rows(report))
    if report.bins is not None:
        files["selected-bins.txt"] = _bin_list(report.bins.automatic).encode()
    return files


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
            {"name": block.name, "dimensions": block.dimensions, "bins": block.bins}
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
                "seed": projection.seed,
                "k": quality.k,
                "nh_s": _finite(quality.nh_s),
                "nh_c": {name: _finite(value) for name, value in quality.nh_c.items()},
                **_range(quality.range, quality.nh_s, quality.null_mean),
                "null": {"mean": _finite(quality.null_mean), "std": _finite(quality.null_std)},
            }
            for method, (projection, quality) in report.projections.items()
        },
        "copies": [[copy.first, copy.second, copy.match.words] for copy in report.copies],
        "without_copies": None if report.without_copies is None else _without_copies(report.without_copies),
        "clusters": None if report.clusters is None else _clusters(report, report.clusters),
        "search": None if report.search is None else _search(report, report.search),
        "bins": None if report.bins is None else _bins(report, report.bins),
        "retrieval": None if report.retrieval is None else retrieval_summary(report.retrieval),
        "seconds": dict(report.seconds),
        "cpu_seconds": dict(report.cpu_seconds),
        "parameters": dict(report.parameters),
        "versions": dict(report.versions),
    }


def _without_copies(found: WithoutCopies) -> dict[str, object]:
    return {
        "copies": found.copies,
        "projections": {
            method: {"nh_s": _finite(nh_s), "nh_max": found.nh_max} for method, nh_s in found.nh_s.items()
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


def _range(limits: HitRange, nh_s: float | None, chance: float | None) -> dict[str, object]:
    """What no map of the shapes exceeds, and how far NH_s is on the way from chance to it."""
    return {
        "nh_max": limits.highest,
        "nh_share": share_of_range(_finite(nh_s), chance, limits.highest),
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
                "nh_s": _finite(subsets.nh_s[row]),
                "nh_c": {name: _finite(value) for name, value in zip(search.classes, subsets.nh_c[row])},
                **_range(limits, subsets.nh_s[row], limits.chance),
                "cpu_seconds": float(subsets.cpu_seconds[row]),
            }
            for row in _by_score(search)
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


def json_text(value: object, indent: int | None = None) -> str:
    """JSON in ASCII, so that any text survives any encoding. Raises ``ValueError`` for a NaN or an infinity."""
    separators = None if indent else (",", ":")
    return json.dumps(value, allow_nan=False, indent=indent, separators=separators)


def _archive(**arrays: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.savez_compressed(file, allow_pickle=False, **arrays)
    return file.getvalue()


def _shape_rows(report: Report) -> list[list[str]]:
    labelings = report.database.labelings
    columns = list(dict.fromkeys(column for shape in report.shapes for column in shape.metadata))
    methods = list(report.projections)
    highest = next(quality.range for _, quality in report.projections.values()).highest_of_class
    rows = [
        [
            "id",
            "name",
            "file",
            "class",
            *(("cluster",) if report.clusters is not None else ()),
            *(f"label:{labeling}" for labeling in labelings),
            *(f"metadata:{column}" for column in columns),
            *(f"nh:{method}" for method in methods),
            "nh_max",
            *("faces_read", "vertices_read", "faces", "vertices", "components", "watertight", "deviation"),
            *("area", "volume", "extent_x", "extent_y", "extent_z"),
            *("repairs", "sha256"),
        ]
    ]
    for index, (shape, facts, label) in enumerate(
        zip(report.shapes, report.facts, report.labels, strict=True)
    ):
        rows.append(
            [
                shape.id,
                shape.name,
                _relative_file(report, shape.path),
                label or "",
                *(
                    (report.clusters.clusters[report.clusters.of[index]].name,)
                    if report.clusters is not None
                    else ()
                ),
                *(shape.labels.get(labeling, "") for labeling in labelings),
                *(shape.metadata.get(column, "") for column in columns),
                *(_number(report.projections[method][1].nh[index]) for method in methods),
                _number(None if label is None else highest.get(label)),
                *map(
                    str,
                    (facts.faces_read, facts.vertices_read, facts.faces, facts.vertices, facts.components),
                ),
                "true" if facts.watertight else "false",
                _number(facts.deviation),
                *("" if value is None else _number(value) for value in (facts.area, facts.volume)),
                *map(_number, facts.extents),
                json_text(dict(facts.repairs)) if facts.repairs else "",
                facts.sha256,
            ]
        )
    return rows


def _copy_rows(report: Report) -> list[list[str]]:
    """A pair of copies a row."""
    rows = [["first", "second", "kind", "distance", "largest", "scale", "mirrored"]]
    for copy in report.copies:
        match = copy.match
        measured = map(_number, (match.distance, match.largest, match.scale))
        rows.append([copy.first, copy.second, match.kind, *measured, "true" if match.mirrored else "false"])
    return rows


def _by_score(search: FeatureSearch) -> list[int]:
    """The evaluated subsets from best to worst, in the order of the search where there are no labels."""
    return np.argsort(-search.subsets.nh_s, kind="stable").tolist()


def _bins(report: Report, found: BinSearch) -> dict[str, object]:
    automatic = found.automatic
    limits = hit_range([report.labels[row] for row in automatic.rows], automatic.k)
    return {
        "automatic": {
            "bins": list(automatic.bins),
            "nh_s": automatic.nh_s,
            "nh_max": limits.highest,
            "nh_share": share_of_range(_finite(automatic.nh_s), limits.chance, limits.highest),
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
            },
            "permuted": _folds(found.shuffled) | {"chance": found.chance},
        },
        "minimal": {
            separated.label: [
                {
                    "bins": list(chosen.bins),
                    "nh_c": chosen.nh_c,
                    "nh_c_space": chosen.nh_c_space,
                    "nh_max": limits.highest_of_class[separated.label],
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
                    "nh_max": limits.highest_of_class[random.label],
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


def _bin_list(selection: BinSelection) -> str:
    """What ``build --bins`` reads."""
    head = f"# {len(selection.bins)} bins that separate all classes: NH_s {selection.nh_s:.3f} on their "
    head += f"{MAIN_PROJECTION.title} map\n"
    return head + "".join(f"{name}\n" for name in selection.bins)


def _members(search: FeatureSearch, row: int) -> list[str]:
    return [name for name, has in zip(search.features, search.subsets.members[row], strict=True) if has]


def _subset_rows(search: FeatureSearch, limits: HitRange) -> list[list[str]]:
    subsets = search.subsets
    header = [
        *(f"feature:{name}" for name in search.features),
        "nh_s",
        *(f"nh_c:{name}" for name in search.classes),
        "nh_max",
        *(f"nh_c_max:{name}" for name in search.classes),
    ]
    return [
        header,
        *(
            [
                *("1" if has else "0" for has in subsets.members[row]),
                _number(subsets.nh_s[row]),
                *map(_number, subsets.nh_c[row]),
                _number(limits.highest),
                *(_number(limits.highest_of_class.get(name)) for name in search.classes),
            ]
            for row in _by_score(search)
        ),
    ]


def _greedy_rows(search: FeatureSearch, limits: HitRange) -> list[list[str]]:
    return [
        ["s", "step", *(f"feature:{name}" for name in search.features), "nh_s", "nh_max"],
        *(
            [
                str(run.s),
                str(number),
                *("1" if name in step.features else "0" for name in search.features),
                _number(step.nh_s),
                _number(limits.highest),
            ]
            for run in search.greedy
            for number, step in enumerate(run.path, start=1)
        ),
    ]


def _table_rows(search: FeatureSearch, limits: HitRange) -> list[list[str]]:
    return [
        ["round", "method", "s", "nh_s", "runs", "nh_max", *(f"feature:{name}" for name in search.features)],
        *(
            [
                str(row.round),
                row.method,
                "" if row.s is None else str(row.s),
                _number(row.nh_s),
                str(row.runs),
                _number(limits.highest),
                *("1" if name in row.features else "0" for name in search.features),
            ]
            for row in search.table
        ),
    ]


def _relative_file(report: Report, path: Path) -> str:
    """A mesh file as seen from the database's root, with ``/``; only its name where it lies elsewhere."""
    try:
        return path.resolve().relative_to(report.database.root.resolve()).as_posix()
    except ValueError:
        return path.name


def _csv(rows: list[list[str]]) -> bytes:
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows([write_cell(text) for text in row] for row in rows)
    # A file name that is no valid text holds lone surrogates, which have no place in UTF-8.
    return text.getvalue().encode("utf-8", "backslashreplace")


def _number(value: float | None) -> str:
    """The shortest text that reads back as the same number; empty for NaN and for none."""
    return "" if value is None or math.isnan(value) else repr(float(value) + 0.0)


def _finite(value: float | None) -> float | None:
    return None if value is None or math.isnan(value) else float(value)
