"""The Compare page: what sets two groups apart, what they share, outliers, and classes that are alike."""

from __future__ import annotations

from shapeviz_report.bins import scale_bins
from shapeviz_report.neighbours import find_fits, find_nearest, most_standing, order_classes
from shapeviz_report.pages.base import PageContent, class_codes, class_names, map_title, rounded
from shapeviz_report.pages.chunks import Comparison, Side, Sides
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.similarity import feature_weight
from shapeviz_report.types import FloatArray, IntArray, Report
from shapeviz_report.wording import Said, agreed, dimensions_of, say_bins, word_whole

#: Decimals of a shape's fit, in [-1, 1].
FIT_DECIMALS = 4

#: What all features span, before any map of it.
SPACE = "features"


class ComparePage:
    """Two groups of shapes beside each other; shapes that fit their class least; classes that are alike."""

    name = "compare"
    title = "Compare"
    file = "compare.html"
    within = None

    def content(self, report: Report) -> PageContent:
        points = _points(report)
        spaces = {SPACE: points, **{method: shown.xy for method, (shown, _) in report.projections.items()}}
        projection, hits = next(iter(report.projections.values()))
        codes, classes = class_codes(report), len(class_names(report))
        return PageContent(
            context={
                "classes": classes,
                "standing": most_standing(len(report.shapes), classes) if classes > 1 else None,
                "spaces": [
                    {"key": key, "title": _space(projection.bins) if key == SPACE else map_title(key)}
                    for key in spaces
                ],
                "space": _space(projection.bins),
                "k": hits.k,
                # Where all others are neighbours of each shape, they say nothing of classes.
                "too_few": len(report.shapes) if hits.k >= len(report.shapes) - 1 else None,
            },
            chunks={"compare": _compare(report, points, codes, hits.k, list(spaces))},
            parts={
                "neighbours": (
                    find_nearest(place, hits.k).astype("<u4").tobytes() for place in spaces.values()
                )
            },
        )


def _points(report: Report) -> FloatArray:
    """What the maps of the site compare."""
    projection, _ = next(iter(report.projections.values()))
    preset = PRESETS[str(report.parameters["preset"])]
    if projection.bins is None:
        return scale(report.features, preset)
    return scale_bins(report.features, preset, projection.bins)


def _space(bins: tuple[str, ...] | None) -> str:
    """What is compared, in words."""
    return "all features" if bins is None else "the chosen bins"


def _compare(report: Report, points: FloatArray, codes: IntArray, k: int, spaces: list[str]) -> Comparison:
    """How well shapes fit their classes, in which order classes stand, and what a comparison needs beside the bins."""
    preset = PRESETS[str(report.parameters["preset"])]
    compared = compared_values(report.features, preset)
    fits = find_fits(points, codes)
    return {
        "k": k,
        # The order of the parts "neighbours", each with k numbers a shape.
        "spaces": spaces,
        "order": order_classes(points, codes),
        "fit": rounded(fits.fit, FIT_DECIMALS),
        "rival": fits.rival.tolist(),
        # What a squared difference in a feature's compared values counts.
        "weights": [
            feature_weight(block, preset, compared[:, report.features.slice_of(block.name)])
            for block in report.features.blocks
        ],
        "whole": word_whole(preset.by_area),
        # What the surface does that a bin counts; None for values that are no shares of it.
        "clauses": [
            None if said is None else said.clause
            for said in say_bins(report.features, report.edges, by_area=preset.by_area)
        ],
        "sides": _sides(report, by_area=preset.by_area),
    }


def _sides(report: Report, *, by_area: bool) -> list[Sides]:
    """Of each histogram that a stranger can picture, what lies below and above each inner edge."""
    sides: list[Sides] = []
    for dimension in dimensions_of(report.features, report.edges):
        if dimension.wording is None or dimension.wording.ease == 1:
            continue
        start = report.features.slice_of(dimension.block.name).start
        inner = [float(edge) for edge in dimension.edges[1:-1]]
        sides.append(
            {
                "start": start + dimension.number * dimension.block.bins,
                "below": [_side(agreed(dimension.say(None, edge), by_area)) for edge in inner],
                "above": [_side(agreed(dimension.say(edge, None), by_area)) for edge in inner],
            }
        )
    return sides


def _side(said: Said) -> Side:
    return {"clause": said.clause, "trend": said.trend, "fewer": said.fewer}
