"""The About page: what was built from what, how long it took, and every file that failed and why."""

from __future__ import annotations

import json
from collections import Counter

from shapeviz_report.faithfulness import RANKED
from shapeviz_report.neighbours import FITTED
from shapeviz_report.pages.base import (
    MEASURED,
    PageContent,
    class_names,
    feature_files,
    grouped,
    is_in_full,
    map_title,
)
from shapeviz_report.presets import PRESETS
from shapeviz_report.projections.kernels.nearest import EXACT_LIMIT
from shapeviz_report.publication import has_licence, licence_warning
from shapeviz_report.publication.bibtex import bibtex_entry, is_bibtex
from shapeviz_report.scorers import MOST_SCORED
from shapeviz_report.search.certainty import choosing_pays
from shapeviz_report.types import BinSearch, FeatureSearch, Report, list_groups

#: Failures, and groups of copies, that the page lists; a page of a hundred thousand rows opens slowly, and nobody reads
#: them.
MOST_LISTED = 500

#: Of these, as many stand open; what comes below is to be found too.
MOST_OPEN = 50

#: Shapes of a group of copies that the page names.
MOST_NAMED = 20

#: Meshes that the page lists.
MOST_MESHES = 2000


class AboutPage:
    """Provenance: parameters, versions, times, hashes, failures and downloads, all of it plain HTML."""

    name = "about"
    title = "About"
    file = "about.html"
    within = None

    def content(self, report: Report) -> PageContent:
        return PageContent(
            context={
                "database": _database(report),
                "failures": report.failures,
                "most_listed": MOST_LISTED,
                "most_open": MOST_OPEN,
                "warnings": [
                    # What is said of the licence is for the owner; readers find it below "Use".
                    warning
                    for warning in report.database.warnings
                    if warning != licence_warning(report.publication, report.database.shapes)
                ],
                **_use(report),
                "projections": _projections(report),
                "samples": _samples(report),
                "bins": next(iter(report.projections.values()))[0].bins,
                "balanced": PRESETS[str(report.parameters["preset"])].balanced,
                "searched": report.search is not None,
                "copies": list_groups(report.copies, [shape.id for shape in report.shapes]),
                "most_named": MOST_NAMED,
                "clusters": _clusters(report),
                "stages": _stages(report),
                "parameters": _parameters(report),
                "versions": list(report.versions.items()),
                "meshes": _meshes(report),
                "mesh_count": len(report.shapes),
                "repaired": sum(bool(facts.repairs) for facts in report.facts),
                "repairs": _repairs(report),
                "open": sum(not facts.watertight for facts in report.facts),
                "features": _features(report),
                "whole": PRESETS[str(report.parameters["preset"])].whole,
                "feature_columns": sum(block.width for block in report.features.blocks),
                "downloads": _downloads(report),
                "features_held": is_in_full(report) or bool(report.parameters.get("parquet")),
            }
        )


def _features(report: Report) -> list[dict[str, object]]:
    """What is measured, or was brought along, and how much it counts."""
    measured = ((block, MEASURED.get(block.name)) for block in report.features.blocks)
    return [
        {
            "name": block.name,
            "title": block.name if descriptor is None else descriptor.title,
            "measures": "A feature that was brought along." if descriptor is None else descriptor.measures,
            "values": block.width,
            "weight": block.weight,
        }
        for block, descriptor in measured
    ]


def _database(report: Report) -> dict[str, object]:
    return {
        "name": report.database.name,
        "layout": report.database.layout,
        "shapes": len(report.shapes),
        "classes": len(class_names(report)),
        "unlabelled": sum(label is None for label in report.labels),
        "labeling": report.labeling,
        "labelings": report.database.labelings,
    }


def _use(report: Report) -> dict[str, object]:
    """Licence and citation."""
    said = report.publication
    entry = said.citation is not None and is_bibtex(said.citation)
    return {
        "licence": said.licence,
        "own_licences": sum(has_licence(shape) for shape in report.shapes),
        "citation": None if entry else said.citation,
        "bibtex": bibtex_entry(report.database.name, said),
    }


def _projections(report: Report) -> list[dict[str, object]]:
    return [
        {
            "title": map_title(method),
            "features": ", ".join(projection.features),
            "seed": None if projection.brought else projection.seed,
            "k": quality.k,
            "nh_s": quality.nh_s,
            "null_mean": quality.null_mean,
            "null_std": quality.null_std,
            "highest": quality.range.highest,
            "without_copies": None if report.without_copies is None else report.without_copies.nh_s[method],
        }
        for method, (projection, quality) in report.projections.items()
    ]


def _samples(report: Report) -> list[str]:
    """Sentences on what does not come from all shapes, for there are too many."""
    said = []
    if len(report.shapes) > EXACT_LIMIT:
        said += [
            "The nearest of each shape by its features were found by descent over a graph, which misses about one in a "
            "thousand.",
            f"Trustworthiness, continuity and stress are those of {grouped(RANKED)} shapes among all others, and a "
            f"shape’s fit to its class compares it with {grouped(FITTED)} that stand for their classes.",
        ]
    if report.scores is not None and len(report.shapes) > MOST_SCORED:
        said.append(
            f"The bins of each class were scored by {grouped(MOST_SCORED)} shapes of it and of the others."
        )
    return said


def _clusters(report: Report) -> dict[str, object] | None:
    if report.clusters is None:
        return None
    return {
        "rows": report.clusters.clusters,
        "silhouette": report.clusters.silhouette,
        "steadiness": report.clusters.steadiness,
    }


def _stages(report: Report) -> dict[str, object]:
    """Wall-clock and CPU seconds by stage, in the order they ran, and their sums."""
    names = list(dict.fromkeys((*report.seconds, *report.cpu_seconds)))
    return {
        "rows": [
            {"name": name, "seconds": report.seconds.get(name), "cpu_seconds": report.cpu_seconds.get(name)}
            for name in names
        ],
        "seconds": sum(report.seconds.values()),
        "cpu_seconds": sum(report.cpu_seconds.values()),
    }


def _parameters(report: Report) -> list[tuple[str, str]]:
    """The options of the build; of those that nobody set, what was used in their place."""
    labeling = "none" if report.labeling is None else f"not set: {report.labeling}"
    used = {
        "layout": f"guessed: {report.database.layout}",
        "labeling": labeling,
        "up": "guessed, where a file does not say",
    }
    return [
        (name, used[name] if value is None and name in used else _plain(value))
        for name, value in report.parameters.items()
    ]


def _plain(value: object) -> str:
    """A parameter as a reader writes it: text as it is, anything else as JSON."""
    if value is None or value == []:
        return "none"
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _meshes(report: Report) -> list[dict[str, object]]:
    """The shapes with their facts: of very many those on which most was mended."""
    pairs = list(zip(report.shapes, report.facts, strict=True))
    if len(pairs) > MOST_MESHES:
        pairs = sorted(pairs, key=lambda pair: -sum(pair[1].repairs.values()))[:MOST_MESHES]
    return [
        {
            "id": shape.id,
            "sha256": facts.sha256,
            "faces_read": facts.faces_read,
            "vertices_read": facts.vertices_read,
            "faces": facts.faces,
            "vertices": facts.vertices,
            "components": facts.components,
            "watertight": facts.watertight,
            "deviation": facts.deviation,
            "repairs": list(facts.repairs.items()),
        }
        for shape, facts in pairs
    ]


def _repairs(report: Report) -> list[tuple[str, int, int]]:
    """What was mended, in how many meshes, and how often in all; by falling number of meshes."""
    meshes, times = Counter[str](), Counter[str]()
    for facts in report.facts:
        meshes.update(facts.repairs.keys())
        times.update(facts.repairs)
    return [
        (repair, count, times[repair])
        for repair, count in sorted(meshes.items(), key=lambda x: (-x[1], x[0]))
    ]


def _downloads(report: Report) -> list[tuple[str, str]]:
    """File below ``data/`` and what is in it."""
    full = is_in_full(report)
    return [
        ("summary.json", "counts, failures, quality of every projection, times, versions, parameters"),
        ("shapes.csv", "one row a shape: labels, metadata, facts, neighbourhood hit, hash"),
        *_feature_downloads(len(report.shapes)),
        *(
            (
                ("shapes.parquet", "the table of shapes with the coordinates on all maps, as Parquet"),
                ("features.parquet", "the feature table, as Parquet"),
            )
            if report.parameters.get("parquet")
            else ()
        ),
        (
            "catalogue.jsonld",
            ("every shape" if full else "the database") + " for search engines and catalogues, by schema.org",
        ),
        ("croissant.json", "what the columns of these tables hold, for loaders of data sets"),
        *(
            (f"projection-{method}.csv", f"coordinates of the {map_title(method)} map")
            for method in report.projections
        ),
        *(_search_downloads(report.search) if report.search is not None else ()),
        *(
            (("scores.npz", "how well every bin separates each class, by every scorer"),)
            if report.scores is not None
            else ()
        ),
        *(
            (
                ("retrieval.csv", "how well each subset of the features finds similar shapes"),
                ("retrieval-classes.csv", "the same for the shapes of each class"),
            )
            if report.retrieval is not None
            else ()
        ),
        *(
            (("separation.csv", "how far the features tell the classes apart, and each map after them"),)
            if report.separation is not None
            else ()
        ),
        *(
            (("copies.csv", "pairs of shapes that are the same shape again, and what says so"),)
            if report.copies
            else ()
        ),
        *((("selected-bins.txt", _worth_of_bins(report.bins)),) if report.bins is not None else ()),
    ]


def _feature_downloads(shapes: int) -> list[tuple[str, str]]:
    files = feature_files(shapes)
    parts = (
        [""] if len(files) == 1 else [f": part {number + 1} of {len(files)}" for number in range(len(files))]
    )
    return [(file, f"the feature table, for numpy{part}") for file, part in zip(files, parts, strict=True)]


def _worth_of_bins(found: BinSearch) -> str:
    words = "a few bins that separate all classes, for build --bins"
    return words if choosing_pays(found.held_out) else f"{words}; unseen shapes are no better off with them"


def _search_downloads(search: FeatureSearch) -> list[tuple[str, str]]:
    subsets = ("subsets.csv", "one row a subset of the features: NH of the database and of every class")
    if not search.table:
        return [subsets]
    return [
        subsets,
        ("greedy.csv", "the steps of the greedy search"),
        ("table2.csv", "the exhaustive and the greedy search side by side, round by round"),
    ]
