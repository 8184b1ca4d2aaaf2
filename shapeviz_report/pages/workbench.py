"""The Workbench: six linked views to find the bins that separate classes (paper, 4.3 and Fig. 5)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from shapeviz_report import charts, quality
from shapeviz_report.pages.base import (
    MEASURED,
    PageContent,
    bins_of,
    class_codes,
    class_names,
    feature_marks,
    is_in_full,
)
from shapeviz_report.pages.bins import SCORE_DECIMALS, all_features, mean_over_folds
from shapeviz_report.pages.chunks import (
    Chunks,
    Feature,
    FeatureWords,
    FoundSet,
    MixedClasses,
    Scorer,
    Workbench,
)
from shapeviz_report.pages.fields import color_choices
from shapeviz_report.pages.sampling import sample_rows
from shapeviz_report.presets import PRESETS, Preset, compared_values
from shapeviz_report.scorers import SCORERS
from shapeviz_report.scorers.registry import ALL_SCORERS
from shapeviz_report.search.certainty import choosing_pays
from shapeviz_report.types import BinSearch, FeatureBlock, FeatureTable, FloatArray, IntArray, Report
from shapeviz_report.wording import call_bins, explain_bins
from shapeviz_report.wording.registry import all_global_wordings, all_wordings

#: Steps of a value from the lowest to the highest of its feature, and of a score from 0 to 1.
STEPS = 65535

#: Bytes of values a part. Some hosts take 25 MiB a file, and values that do not pack at all take a fifteenth more.
BYTES_A_PART = 17_000_000


class WorkbenchPage:
    """Classes and features, the original map, the scores of all bins, and the map of the chosen bins."""

    name = "workbench"
    title = "Workbench"
    file = "workbench.html"
    within = None

    def content(self, report: Report) -> PageContent:
        classes = class_names(report)
        preset = PRESETS[str(report.parameters["preset"])]
        spans = _spans(report.features, preset)
        sample = None if is_in_full(report) else sample_rows(class_codes(report))
        chunks: Chunks = {
            "workbench": _workbench(report, preset, spans, sample, classes),
        }
        if report.scores is not None:
            chunks["scores"] = _steps(report.scores.values, 0.0, 1.0)
        return PageContent(
            context={
                "classes": len(classes),
                "colors": color_choices(report),
                "bins": len(report.features.columns),
                "scored": report.scores is not None,
            },
            chunks=chunks,
            parts={"bins": _bins(report.features, preset, spans, sample)},
        )


#: The lowest and the highest compared value of every feature, by its name.
Spans = dict[str, tuple[float, float]]


def _workbench(
    report: Report, preset: Preset, spans: Spans, sample: IntArray | None, classes: tuple[str, ...]
) -> Workbench:
    """All but the values: what the columns are, and what the page starts from."""
    projection, hits = next(iter(report.projections.values()))
    shapes = len(report.shapes) if sample is None else len(sample)
    return {
        "sample": sample,
        "bytesOfBins": 2 * shapes * len(report.features.columns),
        "bytesAPart": BYTES_A_PART,
        "features": _features(report, spans),
        # In few plain words; empty for features that were brought along.
        "called": list(call_bins(report.features, report.edges)),
        "sentences": list(explain_bins(report.features, report.edges, by_area=preset.by_area)),
        "scaling": "balanced" if preset.balanced else "plain",
        "neighbours": hits.k,
        "seed": projection.seed,
        "method": projection.method,
        "scorers": _scorers(),
        "scored": report.scores is not None,
        # The columns that the maps of the site are made from; null for all of them.
        "bins": None if projection.bins is None else _columns(report, projection.bins),
        "example": _example(report, classes),
        "found": None if (found := bins_of(report)) is None else _found(report, found),
        "marks": feature_marks(),
    }


def _features(report: Report, spans: Spans) -> list[Feature]:
    """Every feature: its columns, its words, and between which values the chunk of bins is cut into steps."""
    hues = charts.feature_color_indices(len(report.features.blocks))
    features: list[Feature] = []
    for block, hue in zip(report.features.blocks, hues, strict=True):
        low, high = spans[block.name]
        features.append(
            {
                "name": block.name,
                "start": report.features.slice_of(block.name).start,
                "dimensions": block.dimensions,
                "bins": block.bins,
                "weight": block.weight,
                "hue": hue,
                "low": low,
                "high": high,
                **_words(block),
            }
        )
    return features


def _words(block: FeatureBlock) -> FeatureWords:
    """What a feature is: from its descriptor, or plain for one that was brought along."""
    descriptor = MEASURED.get(block.name)
    if descriptor is None:
        return {
            "title": block.name,
            "aspect": block.name,
            "measures": "A feature that was brought along.",
            "lowMeans": "",
            "highMeans": "",
            "sought": [("", "")] * block.dimensions,
            "rooted": False,
            "ease": 1,
        }
    wording = all_wordings().get(block.name) or all_global_wordings()[block.name]
    return {
        "title": descriptor.title,
        "aspect": wording.aspect,
        "measures": descriptor.measures,
        "lowMeans": wording.low,
        "highMeans": wording.high,
        "sought": list(wording.sought),
        "rooted": wording.rooted,
        "ease": wording.ease,
    }


def _spans(table: FeatureTable, preset: Preset) -> Spans:
    # Compared values rise with those of the table, whose copy would be gigabytes of a large database.
    extremes = np.stack([table.values.min(axis=0), table.values.max(axis=0)])
    low, high = compared_values(replace(table, values=extremes), preset)
    return {
        block.name: (float(low[columns].min()), float(high[columns].max()))
        for block in table.blocks
        for columns in [table.slice_of(block.name)]
    }


def _bins(table: FeatureTable, preset: Preset, spans: Spans, sample: IntArray | None) -> Iterator[bytes]:
    """The compared values of all shapes, or of a sample, column after column, each a number of steps between the ends
    of its feature: in parts."""
    values = table.values if sample is None else table.values[sample]
    compared = compared_values(replace(table, values=values), preset)
    whole = b"".join(
        _steps(compared[:, table.slice_of(block.name)].T, *spans[block.name]) for block in table.blocks
    )
    for start in range(0, len(whole), BYTES_A_PART):
        yield whole[start : start + BYTES_A_PART]


def _steps(values: np.ndarray, low: float, high: float) -> bytes:
    """Values as 16-bit numbers of steps from ``low`` to ``high``, in the order of the array."""
    width = high - low if high > low else 1.0
    return np.round((values - low) / width * STEPS).astype("<u2").tobytes()


def _columns(report: Report, bins: tuple[str, ...]) -> list[int]:
    place = {column: index for index, column in enumerate(report.features.columns)}
    return [place[name] for name in bins]


def _found(report: Report, found: BinSearch) -> FoundSet | None:
    """None where there are not two classes to search for."""
    if not found.automatic.path:
        return None
    return {
        "bins": _columns(report, found.automatic.bins),
        "nh": round(found.automatic.nh_s, SCORE_DECIMALS),
        "allFeatures": round(all_features(report, found), SCORE_DECIMALS),
        "heldOut": round(mean_over_folds(found.held_out, "nh_s"), SCORE_DECIMALS),
        "shapes": len(found.automatic.rows),
        "pays": choosing_pays(found.held_out),
    }


def _scorers() -> list[Scorer]:
    return [
        {
            "key": scorer.name,
            "title": scorer.title,
            "explanation": scorer.explanation,
            "exact": scorer.exact,
            "live": scorer in SCORERS,
        }
        for scorer in ALL_SCORERS
    ]


def _example(report: Report, classes: tuple[str, ...]) -> MixedClasses | None:
    """The two classes most mixed on the map of all features: whose shapes have the most neighbours of the other class.

    ``mixed`` is the mean of two shares: of the neighbours of the one class that belong to the other, and the other
    way round. None where no two classes are neighbours, there is no such map, or all others are neighbours on any.
    """
    original = _original_map(report)
    if original is None or not quality.hit_range(report.labels, original[1]).tells:
        return None
    xy, k = original
    member = np.array([[label == name for label in report.labels] for name in classes], dtype=float)
    shares = member @ quality.neighbour_weights(xy, k) @ member.T / member.sum(axis=1)[:, None]
    mixed = np.triu((shares + shares.T) / 2, k=1)
    first, second = divmod(int(mixed.argmax()), len(classes))
    if mixed[first, second] == 0:
        return None
    return {"classes": (first, second), "mixed": round(float(mixed[first, second]), 6)}


def _original_map(report: Report) -> tuple[FloatArray, int] | None:
    """The points of all features' map and the number of neighbours; None where a site of chosen bins has no such map,
    and for a single shape."""
    projection, hits = next(iter(report.projections.values()))
    if hits.k < 1:
        return None
    if projection.bins is None:
        return projection.xy, hits.k
    search = report.search
    if search is None or len(search.rows) < search.shape_count:
        return None
    everything = search.subsets.members.all(axis=1)
    return search.subsets.xy[everything][0].astype(float), search.k
