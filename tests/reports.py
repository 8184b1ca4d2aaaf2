"""Reports made from numbers alone, for tests of what shows them. Pictures are real, small and different."""

from __future__ import annotations

import gzip
import io
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from hashlib import sha256
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from solids import ball

from shapeviz_report import quality
from shapeviz_report.bins import features_of, scale_bins
from shapeviz_report.clusters import describe_clusters, part
from shapeviz_report.diffusion import diffuse
from shapeviz_report.distinct import rate_without_copies
from shapeviz_report.exemplars import choose_exemplars
from shapeviz_report.faithfulness import rate_maps
from shapeviz_report.glb import encode_glb
from shapeviz_report.models import pack_model, simplify
from shapeviz_report.order import classes_of
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.projections import PROJECTIONS, bring_along, project, squared_distances
from shapeviz_report.retrieval import query_classes, rate, rate_chance, rate_subsets
from shapeviz_report.scorers import SCORERS, as_one_group, score_separation
from shapeviz_report.search import make_space, search_features
from shapeviz_report.search.bins import (
    encode,
    find_minimal_bins,
    hold_out,
    make_bin_space,
    select_bins,
    shuffle_labels,
)
from shapeviz_report.search.certainty import deal_folds
from shapeviz_report.separation import rate_separation
from shapeviz_report.types import (
    Accent,
    BinScores,
    BinSearch,
    Copy,
    Database,
    Exported,
    Failure,
    FeatureBlock,
    FeatureTable,
    Licence,
    Logo,
    Match,
    Mesh,
    Painting,
    Projection,
    Publication,
    Report,
    Retrieval,
    ShapeEntry,
    ShapeFacts,
    distinct_rows,
    group_copies,
)

NASTY_LABELS = (
    "</script><img src=x onerror=alert(1)>",
    "__proto__",
    "constructor",
    'say "cheese", please',
    "it's; a=trap&<b>",
    "🦄 einhorn / 独角獣",
    "עברית ימין",
    "a class name that goes on and on and on until no legend in the world has room for the whole of it",
)


def make_report(
    classes: Sequence[str | None] = ("ant", "bird", "cup"),
    per_class: int = 8,
    *,
    name: str = "Test shapes",
    root: Path = Path("/database"),
    methods: Sequence[str] = ("tsne", "umap", "pca"),
    features: Sequence[str] = ("Gc", "Sc"),
    failures: Sequence[Failure] = (),
    metadata: Mapping[str, str] | None = None,
    seed: int = 0,
) -> Report:
    """A report with one cluster of points a class; a class of None has no label.

    The layouts are drawn from ``seed``. Neighbourhood hit is computed, not made up. The first feature is noise; the
    others know the classes, each more than the one before.
    """
    random = np.random.default_rng(seed)
    shapes, labels = [], []
    for number, label in enumerate(classes):
        for index in range(per_class):
            identifier = f"class{number:03}/{index:04}"
            shapes.append(
                ShapeEntry(
                    id=identifier,
                    path=root / f"{identifier}.off",
                    name=f"{label or 'shape'} {index}",
                    labels={} if label is None else {"folder": label},
                    metadata=metadata or {},
                )
            )
            labels.append(label)
    labelled = any(label is not None for label in labels)
    count = len(shapes)
    blocks = tuple(FeatureBlock(name, 2 if name == "Sc" else 1, 10) for name in features)
    table = FeatureTable(
        tuple(shape.id for shape in shapes),
        blocks,
        random.random((count, sum(block.width for block in blocks))),
    )
    kinds = np.random.default_rng(seed).normal(0, 1, (len(classes), table.values.shape[1]))
    for number, block in enumerate(blocks):
        columns = table.slice_of(block.name)
        table.values[:, columns] += 0.12 * number * np.repeat(kinds[:, columns], per_class, axis=0)
    shares = np.maximum(table.values, 0).reshape(count, -1, 10)
    table.values[:] = (shares / shares.sum(axis=2, keepdims=True)).reshape(count, -1)
    projections = {}
    for method in methods:
        centres = random.uniform(-1, 1, (len(classes), 2))
        xy = np.repeat(centres, per_class, axis=0) + random.normal(0, 0.1, (count, 2))
        xy -= (xy.max(axis=0) + xy.min(axis=0)) / 2
        xy /= max(np.abs(xy).max(), 1e-9)
        projection = Projection(method, tuple(features), seed, xy)
        projections[method] = (projection, quality.score(xy, labels))
    return Report(
        database=Database(name, root, "class folders", tuple(shapes), ("folder",) if labelled else ()),
        shapes=tuple(shapes),
        facts=tuple(_facts(index) for index in range(count)),
        thumbnails=tuple(picture(index // per_class, index % per_class) for index in range(count)),
        labeling="folder" if labelled else None,
        labels=tuple(labels),
        features=table,
        edges=np.tile(np.linspace(0, 1, 11), (sum(block.dimensions for block in blocks), 1)),
        projections=projections,
        failures=tuple(failures),
        parameters={"seed": seed, "edge_length": 0.01, "preset": "default"},
        versions={"shapeviz-report": "0.1.0", "Python": "3.11"},
        seconds={"read": 0.1, "prepare": 12.5, "project": 3.25},
        cpu_seconds={"read": 0.1, "prepare": 24.0, "project": 3.0},
        separation=rate_separation(
            scale(table, PRESETS["default"]),
            {method: projection.xy for method, (projection, _) in projections.items()},
            labels,
            quality.NEIGHBOURS,
        ),
        faithfulness=rate_maps(
            scale(table, PRESETS["default"]),
            {method: projection.xy for method, (projection, _) in projections.items()},
            quality.NEIGHBOURS,
        ),
    )


def multiplied(report: Report, times: int) -> Report:
    """A report in which every shape of another stands so many times, with names and pictures of their own; each picture
    is of one colour, :func:`colour_of` its row."""
    count = times * len(report.shapes)
    shapes = tuple(
        replace(shape, id=f"{shape.id}-{number:05}", name=f"{shape.name} number {number}")
        for shape in report.shapes
        for number in range(times)
    )
    noise = np.random.default_rng(0).normal(0, 1e-3, (count, 2))
    return replace(
        report,
        database=replace(report.database, shapes=shapes),
        shapes=shapes,
        facts=tuple(_facts(row) for row in range(count)),
        thumbnails=tuple(plain_picture(colour_of(row)) for row in range(count)),
        labels=tuple(np.repeat(np.array(report.labels, object), times)),
        features=replace(
            report.features,
            shape_ids=tuple(shape.id for shape in shapes),
            values=np.repeat(report.features.values, times, axis=0),
        ),
        projections={
            method: (
                replace(projection, xy=np.repeat(projection.xy, times, axis=0) + noise),
                replace(hits, nh=np.repeat(hits.nh, times)),
            )
            for method, (projection, hits) in report.projections.items()
        },
        faithfulness={},
        separation=None,
        related=(np.arange(count)[:, None] + np.arange(1, 9)) % count,
    )


def colour_of(row: int) -> tuple[int, int, int]:
    """A colour for every row below 65,536."""
    return row % 256, row // 256, 77


def plain_picture(colour: tuple[int, int, int]) -> bytes:
    """A WebP image of one colour and no other."""
    file = io.BytesIO()
    Image.new("RGBA", (8, 8), (*colour, 255)).save(file, "WEBP", lossless=True, method=0)
    return file.getvalue()


def with_clusters(report: Report) -> Report:
    """The report with its real clusters, which stand in for labels where it has none; to be called before all else that
    looks at labels."""
    preset = PRESETS["default"]
    scaled = scale(report.features, preset)
    partition = part(scaled)
    if partition is None:
        return report
    stand_in = not any(label is not None for label in report.labels)
    clusters = describe_clusters(
        partition, report.shapes, report.features, scaled, report.edges, preset, stand_in=stand_in
    )
    if not stand_in:
        return replace(report, clusters=clusters)
    labels = tuple(clusters.clusters[code].name for code in clusters.of)
    projections = {
        method: (projection, quality.score(projection.xy, labels))
        for method, (projection, _) in report.projections.items()
    }
    return replace(report, clusters=clusters, labeling="clusters", labels=labels, projections=projections)


def with_publication(report: Report) -> Report:
    """The report of a database whose owner has said all that can be said."""
    said = Publication(
        introduction="Vessels of **two** museums.\n\n## What is here\n\nAll [shapes](shapes.html) of the museums.",
        logo=Logo(
            ".svg",
            b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 20"><circle cx="10" cy="10" r="9"/></svg>',
        ),
        accent=Accent("#a01346", "#d86b93"),
        licence=Licence("CC BY 4.0: Attribution", "https://creativecommons.org/licenses/by/4.0/"),
        citation="N. N.: Vessels of two museums, 2019.",
        creator="Two museums",
        url="https://example.org/vessels/",
    )
    return replace(report, publication=said)


def with_search(report: Report, *, limit: int = 1000) -> Report:
    """The report with a real search of two rounds over its features, of ``limit`` shapes at most."""
    space = make_space(report.features, report.features.values, report.labels, limit=limit)
    return replace(
        report, search=search_features(space, report.labels, "tsne", rounds=2, groups=_groups(report))
    )


def with_best(report: Report) -> Report:
    """The report with the map of all shapes by the best subset of a search that laid out a sample."""
    assert report.search is not None
    best = report.search.best
    assert best is not None
    blocks = [block for block in report.features.blocks if block.name in best]
    scaled = scale(report.features, PRESETS["default"])
    values = np.hstack([scaled[:, report.features.slice_of(block.name)] for block in blocks])
    made = project(PROJECTIONS[0], values, best, 0)
    rated = rate_maps(values, {"best": made.xy}, report.search.k)
    return replace(report, best=(made, quality.score(made.xy, report.labels), rated["best"]))


def with_scores(report: Report) -> Report:
    """The report with the scores of its bins for every class against the rest, by all scorers; without where there
    are not two classes."""
    classes = classes_of(report.labels)
    if len(classes) < 2:
        return report
    compared = compared_values(report.features, PRESETS["default"])
    scores = [
        [score_separation(scorer, compared, as_one_group(report.labels, [name])) for name in classes]
        for scorer in SCORERS
    ]
    names = tuple(scorer.name for scorer in SCORERS)
    return replace(report, scores=BinScores(names, classes, np.array(scores, dtype=np.float32)))


def with_bin_search(report: Report) -> Report:
    """The report with a real search for bins; without where there are not two classes of two shapes."""
    preset = PRESETS["default"]
    space = make_bin_space(report.features, preset, report.labels)
    classes, codes = encode(space, report.labels)
    sizes = np.bincount(codes[codes >= 0], minlength=len(classes))
    if (sizes > 1).sum() < 2:
        return report
    everything = squared_distances(scale(report.features, preset)[space.rows])
    groups = _groups(report)[space.rows]
    distinct = distinct_rows(groups, codes >= 0)
    folds = deal_folds(codes, 0, groups)[:2]
    shuffled = shuffle_labels(space, report.labels, 0)
    found = BinSearch(
        automatic=select_bins(space, report.labels, limit=6),
        held_out=tuple(
            hold_out(space, report.labels, fold, everything, limit=2, distinct=distinct) for fold in folds
        ),
        shuffled=(
            hold_out(space, shuffled, deal_folds(encode(space, shuffled)[1], 0)[0], everything, limit=2),
        ),
        chance=float((sizes[codes[codes >= 0]] - 1).mean() / (len(codes) - 1)),
        minimal=tuple(
            find_minimal_bins(space, report.labels, label, largest=2)
            for label, size in zip(classes, sizes)
            if size > 1
        ),
        minimal_by_chance={
            int(size): find_minimal_bins(space, shuffled, label, largest=2)
            for label, size in zip(classes, sizes)
            if size > 1
        },
        sizes=dict(zip(classes, sizes.tolist())),
    )
    return replace(report, bins=found)


def with_strewn_map(report: Report) -> Report:
    """The report with a first map on which shapes lie anywhere, which bins easily surpass."""
    method, (projection, _) = next(iter(report.projections.items()))
    strewn = replace(projection, xy=np.random.default_rng(1).permutation(projection.xy))
    rated = (strewn, quality.score(strewn.xy, report.labels))
    return replace(report, projections={**report.projections, method: rated})


def with_searched_sample(report: Report) -> Report:
    """The report whose search for bins knew every other shape only."""
    assert report.bins is not None
    rows = report.bins.automatic.rows[::2]
    return replace(report, bins=replace(report.bins, automatic=replace(report.bins.automatic, rows=rows)))


def without_gain(report: Report) -> Report:
    """The report whose bins are worth no more than all features to shapes that the search never saw."""
    assert report.bins is not None
    folds = tuple(
        replace(fold, nh_s=fold.nh_s_all, knn_accuracy=fold.knn_accuracy_all) for fold in report.bins.held_out
    )
    return replace(report, bins=replace(report.bins, held_out=folds))


def with_retrieval(report: Report) -> Report:
    """The report with how well its shapes are found: by every subset of a search, else by each feature and by all, and
    by the bins of its search; without where no class has two shapes."""
    preset = PRESETS["default"]
    space = make_space(report.features, scale(report.features, preset), report.labels)
    classes, codes = query_classes([report.labels[row] for row in space.rows])
    if not classes:
        return report
    singles = [1 << feature for feature in range(len(space.features))]
    subsets = [*singles, space.everything] if report.search is None else range(1, space.everything + 1)
    bins, by_bins = None, None
    if report.bins is not None:
        bins = report.bins.automatic.bins
        by_bins = rate(squared_distances(scale_bins(report.features, preset, bins)[space.rows]), codes)
    return replace(
        report,
        retrieval=Retrieval(
            features=space.features,
            rows=space.rows,
            shape_count=space.shape_count,
            classes=classes,
            queries=np.bincount(codes[codes >= 0]).astype(np.int32),
            members=np.array([[bool(subset & single) for single in singles] for subset in subsets]),
            subsets=tuple(rate_subsets(space.squared, codes, list(subsets))),
            bins=bins,
            by_bins=by_bins,
            by_neighbourhood=rate(diffuse(space.squared.sum(axis=0)), codes),
            chance=rate_chance(codes),
        ),
    )


def with_copies(report: Report, pairs: Sequence[tuple[int, int]]) -> Report:
    """The report with some shapes, by row, as copies of others, its searches as if this had been known, and its figures
    without them."""
    ids = [shape.id for shape in report.shapes]
    copies = tuple(Copy(ids[a], ids[b], Match("identical geometry", mirrored=True)) for a, b in pairs)
    space = make_space(report.features, scale(report.features, PRESETS["default"]), report.labels)
    report = replace(report, copies=copies)
    if report.search is not None:
        report = with_search(report)
    if report.bins is not None:
        report = with_bin_search(report)
    return replace(
        report,
        without_copies=rate_without_copies(
            _groups(report),
            report.labels,
            {method: projection.xy for method, (projection, _) in report.projections.items()},
            quality.NEIGHBOURS,
            space.rows,
            {"everything": space.squared.sum(axis=0, dtype=np.float64)},
            report.search,
            None if report.bins is None else report.bins.automatic,
        ),
    )


def _groups(report: Report) -> np.ndarray:
    return group_copies(report.copies, [shape.id for shape in report.shapes])


def with_paintings(report: Report) -> Report:
    """The report with pictures of the bins that its search found, which show polygons; of the right shapes."""
    xy = next(iter(report.projections.values()))[0].xy
    exemplars = choose_exemplars(
        report.bins, report.features, report.labels, report.features.values, xy, quality.NEIGHBOURS
    )
    paintings = (
        Painting(column, row, picture(number, row), picture(number, row + 1))
        for number, (column, rows) in enumerate(exemplars.items())
        for row in rows
    )
    return replace(report, paintings=tuple(paintings))


def with_models(report: Report) -> Report:
    """The report with the models of balls, more and more stretched. In their first dimension the bins are layers from
    bottom to top, in each further one they are turned by one bin more. The last shape has colours, red to the right."""
    sphere = ball(2)
    models = []
    for number in range(len(report.shapes)):
        stretched = Mesh(sphere.vertices * [1, 1 - number / (2 * len(report.shapes)), 0.5], sphere.faces)
        model = simplify(stretched)
        layers = np.clip((model.vertices[:, 1] + 1) * 5, 0, 9).astype(np.uint8)
        bins = np.stack([(layers + turn) % 10 for turn in range(len(report.edges))]).astype(np.uint8)
        last = number == len(report.shapes) - 1
        colors = np.where(model.vertices[:, :1] > 0, [[200, 20, 20]], [[20, 60, 200]]).astype(np.uint8)
        packed = pack_model(model, bins, np.eye(3), colors if last else None)
        models.append(gzip.compress(packed, mtime=0))
    return replace(report, models=tuple(models))


def with_exported(report: Report) -> Report:
    """The report with every shape as glTF: balls, more and more stretched, with a value at every vertex."""
    sphere = ball(2)
    files = []
    for number in range(len(report.shapes)):
        stretched = sphere.vertices * [1, 1 - number / (2 * len(report.shapes)), 0.5]
        values = {"_GC": stretched[:, 0].astype(np.float32)}
        files.append(encode_glb(stretched, sphere.faces, np.eye(3), values))
    names = tuple(f"{sha256(file).hexdigest()[:20]}.glb" for file in files)
    return replace(report, exported=Exported(names, files))


def with_external(report: Report) -> Report:
    """The report with a feature of two values a shape that was brought along, and that no search has seen.

    It counts more than the others.
    """
    table = report.features
    values = np.random.default_rng(0).normal(0, 1, (len(table.values), 2))
    blocks = (*table.blocks, FeatureBlock("own", 2, 1, weight=1.5))
    return replace(report, features=FeatureTable(table.shape_ids, blocks, np.hstack([table.values, values])))


def with_own_map(report: Report, name: str = "drawer") -> Report:
    """The report with a map that was brought along: all shapes in rows of ten."""
    rows = np.arange(len(report.shapes))
    own = bring_along(name, np.column_stack([rows % 10, rows // 10]).astype(float))
    rated = rate_maps(scale(report.features, PRESETS["default"]), {name: own.xy}, quality.NEIGHBOURS)
    report = replace(
        report,
        projections={**report.projections, name: (own, quality.score(own.xy, report.labels))},
        faithfulness={**report.faithfulness, **rated},
    )
    separation = rate_separation(
        scale(report.features, PRESETS["default"]),
        {method: projection.xy for method, (projection, _) in report.projections.items()},
        report.labels,
        quality.NEIGHBOURS,
    )
    return replace(report, separation=separation)


def with_bins(report: Report, bins: tuple[str, ...]) -> Report:
    """The report as if its maps, which stay as they are, were of these bins only."""
    features = features_of(report.features, bins)
    projections = {
        method: (replace(projection, features=features, bins=bins), hits)
        for method, (projection, hits) in report.projections.items()
    }
    return replace(report, projections=projections)


def with_columns(report: Report, columns: Mapping[str, Sequence[str]]) -> Report:
    """The report with columns of metadata; an empty value is left out, as readers of databases leave it out."""
    shapes = tuple(
        replace(shape, metadata={name: values[row] for name, values in columns.items() if values[row]})
        for row, shape in enumerate(report.shapes)
    )
    return replace(report, shapes=shapes, database=replace(report.database, shapes=shapes))


def with_labeling(report: Report, name: str, labels: Sequence[str]) -> Report:
    """The report with another labeling beside the active one, from a column of metadata of the same name."""
    report = with_columns(report, {name: labels})
    shapes = tuple(
        replace(shape, labels={**shape.labels, name: label})
        for shape, label in zip(report.shapes, labels, strict=True)
    )
    labelings = (*report.database.labelings, name)
    return replace(
        report, shapes=shapes, database=replace(report.database, shapes=shapes, labelings=labelings)
    )


def with_parents(report: Report, parents: Mapping[str, str]) -> Report:
    """The report with a hierarchy of its active classes: class -> parent."""
    return replace(report, database=replace(report.database, parents={report.labeling: parents}))


def _facts(index: int) -> ShapeFacts:
    return ShapeFacts(
        sha256=f"{index:064x}",
        faces_read=1000 + index,
        vertices_read=502,
        faces=9000,
        vertices=4502,
        components=1,
        watertight=index % 5 != 0,
        repairs={"duplicate faces removed": 4} if index % 3 == 0 else {},
        deviation=0.0012,
        area=6.0 + index,
        volume=1.0 + index / 7 if index % 5 != 0 else None,
        extents=(1.0, 2.0, 0.5 + index),
    )


@cache
def picture(kind: int, variant: int) -> bytes:
    """A WebP image of a polygon: corners by kind, turned by variant."""
    image = Image.new("RGBA", (256, 256), (0, 0, 0, 0))
    corners = 3 + kind % 5
    angles = 2 * np.pi * (np.arange(corners) / corners + variant / 31 + kind / 17)
    points = [(128 + 90 * np.cos(angle), 128 + 90 * np.sin(angle)) for angle in angles]
    shade = 110 + 25 * (kind % 4) + variant % 20
    ImageDraw.Draw(image).polygon(
        points, fill=(shade, shade - 5, shade - 20, 255), outline=(60, 60, 60, 255), width=4
    )
    file = io.BytesIO()
    image.save(file, "WEBP", quality=60, method=0)
    return file.getvalue()
