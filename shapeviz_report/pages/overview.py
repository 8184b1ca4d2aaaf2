"""The Overview: the whole database at a glance, on three linked maps (paper, Fig. 2)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from hashlib import sha256

import numpy as np

from shapeviz_report import charts
from shapeviz_report.pages.base import (
    PageContent,
    class_codes,
    class_names,
    clusters_chunk,
    is_in_full,
    is_search_sampled,
    map_note,
    map_title,
    rounded,
    search_of,
    share_steps,
    stand_in,
    texts_chunk,
)
from shapeviz_report.pages.chunks import (
    Chunks,
    Faith,
    Marks,
    Method,
    PicturePart,
    ShapeDetails,
    ShapeList,
    Sheets,
    SubsetChoice,
    Trust,
)
from shapeviz_report.pages.chunks import Shepard as ShepardChunk
from shapeviz_report.pages.fields import color_choices
from shapeviz_report.pages.levels import component_parts, level_table
from shapeviz_report.pages.map_pictures import ACROSS, GRIDS, map_pictures, sheet_name
from shapeviz_report.pages.separation import separation_chunk
from shapeviz_report.presets import PRESETS
from shapeviz_report.render import ramp_codes
from shapeviz_report.types import (
    Faithfulness,
    Projection,
    Quality,
    Report,
    Shepard,
    WithoutCopies,
    copies_beside,
    copies_of,
)

#: Decimals of a coordinate in [-1, 1]: a hundredth of a pixel on a map of 1000 pixels, magnified 20 times.
COORDINATE_DECIMALS = 6

#: Shapes a part of the chunk "details": some tens of kilobytes.
DETAILS_A_PART = 200

#: Pictures a part: few, as a search or a list of similar shapes shows some from everywhere.
PICTURES_A_PART = 32

#: Decimals of what is drawn on a small diagram.
SHARE_DECIMALS = 4

#: Values of a column that colours tell apart on a map; shapes of any other share one.
MOST_CATEGORIES = 12

#: Colours of the ramp of numbers, between which others are mixed.
RAMP_STEPS = 16

#: Of these, the darkest, which would not be seen on a dark ground.
DARKEST = 4


class OverviewPage:
    """Three linked maps, the classes with their neighbourhood hit, a tray for selections, a panel for one shape."""

    name = "overview"
    title = "Overview"
    file = "index.html"
    within = None

    def content(self, report: Report) -> PageContent:
        from shapeviz_report.charts import specs

        classes = class_names(report)
        methods = [
            _method(
                projection,
                quality,
                classes,
                report.without_copies,
                report.faithfulness.get(projection.method),
            )
            for projection, quality in report.projections.values()
        ]
        chunks: Chunks = {
            "overview": {
                "shapes": _shapes(report),
                "partSizes": {"details": DETAILS_A_PART, "pictures": PICTURES_A_PART},
                "classes": list(classes),
                "labeling": report.labeling,
                "standIn": stand_in(report),
                "methods": methods,
                "separation": separation_chunk(report),
                "subsets": _subsets(report),
                "charts": {
                    "class": specs.spec_of(specs.class_map, len(classes)),
                    "hit": specs.spec_of(specs.hit_map),
                    "thumbnail": specs.spec_of(specs.thumbnail_map),
                    "bars": specs.spec_of(specs.class_bars),
                },
                "marks": _marks(len(classes)),
            },
            "trust": {key: _trust(report.faithfulness.get(key)) for key in report.projections},
            "texts": texts_chunk([_text(report, row) for row in range(len(report.shapes))]),
            "sheets": _sheets(report),
            "clusters": clusters_chunk(report),
        }
        if report.best is not None:
            projection, quality, faithfulness = report.best
            key = f"{projection.method}:{'+'.join(projection.features)}"
            chunks["best"] = {
                **_method(projection, quality, classes, None, faithfulness),
                "key": key,
                "trust": _trust(faithfulness),
            }
        return PageContent(
            context={
                "methods": [{"key": method["key"], "title": method["title"]} for method in methods],
                "classes": len(classes),
                "bounded": any(
                    highest < 1
                    for _, quality in report.projections.values()
                    for highest in quality.range.highest_of_class.values()
                ),
                "subsets": _subsets(report),
                "colors": color_choices(report),
            },
            chunks=chunks,
            parts={"details": _details(report), "pictures": _picture_parts(report), **_components(report)},
        )


def thumbnail_name(thumbnail: bytes) -> str:
    """File name of a picture below ``thumbnails/``: a hash, so it is safe, and no stale cache shows another."""
    return sha256(thumbnail).hexdigest()[:20] + ".webp"


def _shapes(report: Report) -> ShapeList:
    return {
        "ids": texts_chunk([shape.id for shape in report.shapes]),
        "names": texts_chunk([shape.name for shape in report.shapes]),
        "groups": class_codes(report),
        "pictures": [thumbnail_name(thumbnail) for thumbnail in report.thumbnails]
        if is_in_full(report)
        else None,
    }


def _method(
    projection: Projection,
    quality: Quality,
    classes: tuple[str, ...],
    without_copies: WithoutCopies | None,
    faithfulness: Faithfulness | None,
) -> Method:
    """One projection with its quality; missing values are None."""
    # Adding zero turns -0.0 into 0.0, which would otherwise differ between equal builds.
    x, y = (np.round(projection.xy, COORDINATE_DECIMALS) + 0.0).T.astype(np.float32)
    return {
        "key": projection.method,
        "title": map_title(projection.method),
        "note": map_note(projection),
        "features": list(projection.features),
        "x": x,
        "y": y,
        "hit": share_steps(quality.nh),
        "neighbours": quality.k,
        "hitOfClass": rounded(
            np.array([quality.nh_c.get(name, np.nan) for name in classes], dtype=float), COORDINATE_DECIMALS
        ),
        "hitOfAll": quality.nh_s,
        "withoutCopies": None
        if without_copies is None
        else {
            "copies": without_copies.copies,
            "hitOfAll": without_copies.nh_s[projection.method],
            "highest": without_copies.nh_max,
        },
        "chance": quality.null_mean,
        "chanceSpread": quality.null_std,
        "faith": None if faithfulness is None else _faith(faithfulness),
    }


def _faith(found: Faithfulness) -> Faith:
    return {
        "kept": share_steps(found.kept),
        "mean": float(found.kept.mean()),
        "chance": found.chance,
        "trustworthiness": found.trustworthiness,
        "continuity": found.continuity,
        "random": found.random,
        "stress": found.stress,
        "randomStress": found.random_stress,
        "shepard": None if found.shepard is None else _shepard(found.shepard),
    }


def _trust(found: Faithfulness | None) -> Trust:
    if found is None or found.false is None or found.missing is None:
        return {"false": None, "missing": None}
    return {"false": share_steps(found.false), "missing": share_steps(found.missing)}


def _sheets(report: Report) -> Sheets:
    names = [thumbnail_name(thumbnail) for thumbnail in report.thumbnails]
    return {
        "grids": list(GRIDS),
        "across": ACROSS,
        "maps": {
            key: {
                "rows": pictures.rows.astype(np.int32),
                "ends": list(pictures.ends),
                "sheets": [sheet_name(rows, names) for rows in pictures.sheets()],
            }
            for key, pictures in map_pictures(report).items()
        },
    }


def _shepard(found: Shepard) -> ShepardChunk:
    """Cells by the logarithm of their pairs, in digits: 1 for a single pair, 9 for as many as the fullest has."""
    most = max(float(np.log(found.pairs.max())), 1.0)
    digits = np.where(found.pairs > 0, 1 + np.round(8 * np.log(np.maximum(found.pairs, 1)) / most), 0).astype(
        int
    )
    return {
        "columns": ["".join(map(str, column)) for column in digits.tolist()],
        "fit": rounded(found.fit, SHARE_DECIMALS),
        "height": found.height,
    }


def _subsets(report: Report) -> SubsetChoice | None:
    """Whose maps the page can show beside those of all features or of chosen bins: those of the search; None if there
    is none."""
    search = search_of(report)
    if search is None or search.method not in report.projections:
        return None
    bins = report.projections[search.method][0].bins
    return {
        "method": search.method,
        "features": list(search.features),
        "bins": None if bins is None else len(bins),
        "bestByChance": None if search.best is None else float(np.median(search.null_best)),
        "best": None if search.best is None else list(search.best),
        "sample": len(search.rows) if is_search_sampled(report) else None,
        "laidOut": report.best is not None,
    }


def _components(report: Report) -> Mapping[str, Iterable[object]]:
    """By what the others are placed on the maps of a search that laid out a sample. Where very many shapes have their
    values in parts, these are among them."""
    if not is_in_full(report) or not is_search_sampled(report):
        return {}
    preset = PRESETS[str(report.parameters["preset"])]
    return {"components": component_parts(level_table(report, preset))}


def _marks(class_count: int) -> Marks:
    """Colours and symbols, for what the page draws beside the charts; and the charts' configuration by theme."""
    return {
        "symbols": [charts.SYMBOLS[index] for index in charts.class_symbol_indices(class_count)],
        "categories": [charts.SYMBOLS[index] for index in charts.class_symbol_indices(MOST_CATEGORIES)],
        "plain": charts.SYMBOLS[0],
        "missing": charts.SYMBOLS[-1],
        "themes": {
            theme.name: {
                "config": charts.theme_config(theme, class_count),
                "classes": [theme.classes[index] for index in charts.class_color_indices(class_count)],
                "hit": list(theme.hit),
                "unlabelled": theme.unlabelled,
                "outline": theme.outline,
                "ground": theme.ground,
                "ink": theme.ink,
                "ramp": ramp_codes(RAMP_STEPS + DARKEST)[DARKEST if theme is charts.DARK else 0 :],
                "categories": [theme.classes[index] for index in charts.class_color_indices(MOST_CATEGORIES)],
            }
            for theme in charts.THEMES
        },
    }


def _picture_parts(report: Report) -> Iterator[PicturePart]:
    """Pictures class by class: galleries show those of a class beside each other."""
    order = np.argsort(class_codes(report), kind="stable").tolist()
    for start in range(0, len(order), PICTURES_A_PART):
        pictures = [report.thumbnails[row] for row in order[start : start + PICTURES_A_PART]]
        yield {
            "ends": np.cumsum([len(picture) for picture in pictures]).astype(np.uint32),
            "content": np.frombuffer(b"".join(pictures), np.uint8),
        }


def _text(report: Report, row: int) -> str:
    """What a search finds a shape by beside its id, name and class."""
    shape, label = report.shapes[row], report.labels[row]
    return " ".join([*(other for other in shape.labels.values() if other != label), *shape.metadata.values()])


def _details(report: Report) -> Iterator[list[ShapeDetails]]:
    """What is known of shapes beyond their places: loaded when a reader opens one."""
    row = {shape.id: index for index, shape in enumerate(report.shapes)}
    name = [shape.name for shape in report.shapes]
    beside = copies_beside(report.copies)
    for start in range(0, len(report.shapes), DETAILS_A_PART):
        yield [
            {
                # Pairs, because a column may have any name, "__proto__" included.
                "labels": [
                    (labeling, shape.labels[labeling])
                    for labeling in report.database.labelings
                    if labeling in shape.labels
                ],
                "metadata": list(shape.metadata.items()),
                "copies": [
                    (row[other], f"by way of {name[row[found]]}" if isinstance(found, str) else found.words)
                    for other, found in copies_of(beside, shape.id)
                ],
                "repairs": list(facts.repairs.items()),
                "faces": facts.faces,
                "vertices": facts.vertices,
                "facesRead": facts.faces_read,
                "verticesRead": facts.vertices_read,
                "components": facts.components,
                "watertight": facts.watertight,
                "deviation": facts.deviation,
                "area": facts.area,
                "volume": facts.volume,
                "extents": list(facts.extents),
                "related": None if report.related is None else report.related[start + place].tolist(),
                "gltf": None if report.exported is None else report.exported.names[start + place],
            }
            for place, (shape, facts) in enumerate(
                zip(
                    report.shapes[start : start + DETAILS_A_PART],
                    report.facts[start : start + DETAILS_A_PART],
                    strict=True,
                )
            )
        ]
