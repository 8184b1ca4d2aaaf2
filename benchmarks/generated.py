"""A site of as many generated shapes as one likes, without a mesh: to see what size does to the writer and the pages.

    python -m benchmarks.generated OUT [--shapes 100000] [--classes 60] [--features Gc,Agd,...] [--searched 0]

Rows of features are a prototype a class and noise; maps, their quality, facts and columns are dealt out as plausible
ones would be. Searches, scores and retrieval are those of a build, of a sample of ``--searched`` shapes, where a build
takes 1000; without, there are none. There are no models. Prints what each part took, and what each part of the site
weighs.
"""

from __future__ import annotations

import argparse
import io
import resource
import time
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFilter
from scipy.spatial import KDTree

from shapeviz_report.bins import scale_bins
from shapeviz_report.config import Config
from shapeviz_report.exemplars import choose_exemplars
from shapeviz_report.faithfulness import rate_maps
from shapeviz_report.features import BINS
from shapeviz_report.neighbours import RELATED, find_nearest
from shapeviz_report.order import classes_of
from shapeviz_report.pages.base import thumbnail_size
from shapeviz_report.pages.sampling import sample_rows
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.projections import squared_distances
from shapeviz_report.quality import NEIGHBOURS, hit_range
from shapeviz_report.render.thumbnail import WEBP_METHOD, WEBP_QUALITY
from shapeviz_report.retrieval import query_classes, rate, rate_chance, rate_subsets
from shapeviz_report.scorers import SCORERS, as_one_group, score_separation
from shapeviz_report.search import SearchSpace, make_space, search_features
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
    BinScores,
    BinSearch,
    Cluster,
    Clusters,
    Copy,
    Database,
    Failure,
    Faithfulness,
    FeatureSearch,
    FeatureTable,
    FloatArray,
    IntArray,
    Match,
    Painting,
    Projection,
    Quality,
    Report,
    Retrieval,
    ShapeEntry,
    ShapeFacts,
)
from shapeviz_report.types.copies import IDENTICAL_FILE
from shapeviz_report.writing.writer import write_site

PRESET = PRESETS["default"]
FEATURES = ("Gc", "Agd", "Nd", "Na", "Pa")
"""Those that take least room; all of them are 2705 values a shape."""
DRAWN = 2000
"""Different drawings; each picture has bytes of its own nevertheless."""
EMPTY = 0.67
"""Bins of histograms of many dimensions that hold nothing, as of psb14: how well rows pack hangs on that."""
RATED = 1000
"""Shapes whose quality is computed; the others have the figures of one of these."""
SCORED = 4
"""Classes that are scored and have bins searched for them; the others have those of one of these."""
MOST_BINS = 12
"""Bins of a choice for all classes."""
ROOT = Path("/generated")

KINDS = (
    *("bowl", "jar", "cup", "lamp", "bead", "brick", "spoon", "chair", "table", "bird", "horse", "fish"),
    *("car", "ship", "house", "tree", "hand", "mask", "knife", "ring"),
)
SORTS = ("round", "tall", "flat", "winged", "hollow", "broken", "twin", "long", "small", "old")
PERIODS = ("Stone Age", "Copper Age", "Bronze Age", "Iron Age", "Roman", "Medieval")
PLACES = tuple(f"{side} {name}" for side in ("Upper", "Lower") for name in ("Delta", "Hill", "Ford", "Mere"))


def make_report(count: int, classes: int, features: Sequence[str] = FEATURES, seed: int = 0) -> Report:
    """A report of ``count`` shapes in ``classes`` classes of uneven sizes.

    Parameters
    ----------
    count, classes : int
        At least two of each class.
    features : sequence of str
        Of the default preset.
    seed : int
    """
    random = np.random.default_rng(seed)
    names = _class_names(classes)
    codes = np.sort(np.concatenate([np.repeat(np.arange(classes), 2), _deal(random, count, classes)]))
    labels = tuple(names[code] for code in codes)
    shapes = _shapes(random, codes, names)
    table = _features(random, codes, features, shapes)
    drawn = _places(random, count, RATED)
    maps = _maps(random, codes)
    projections = {
        method: (Projection(method, tuple(features), seed, xy), _quality(xy, codes, labels))
        for method, xy in maps.items()
    }
    sample = FeatureTable((), table.blocks, table.values[drawn])
    scaled = scale(sample, PRESET)
    sampled = [labels[row] for row in drawn]
    shown = {method: xy[drawn] for method, xy in maps.items()}
    rated = rate_maps(scaled, shown, NEIGHBOURS)
    like = random.integers(len(drawn), size=count)
    histograms = sum(block.dimensions for block in table.blocks if block.bins > 1)
    return Report(
        database=Database(
            f"{count:,} generated shapes",
            ROOT,
            "table",
            shapes,
            ("kind",),
            parents={"kind": {name: name.rpartition(" ")[2] for name in names}},
        ),
        shapes=shapes,
        facts=tuple(_facts(random, count)),
        thumbnails=tuple(_pictures(random, codes)),
        labeling="kind",
        labels=labels,
        features=table,
        edges=np.tile(np.linspace(0, 1, BINS + 1), (histograms, 1)),
        projections=projections,
        failures=tuple(
            Failure(f"broken/{number:05}.off", "read", "the file holds no faces")
            for number in range(count // 500)
        ),
        parameters={"seed": seed, "preset": PRESET.name, "search": "none", "edge_length": 0.01},
        versions={},
        seconds={},
        cpu_seconds={},
        clusters=_clusters(random, codes),
        copies=tuple(
            Copy(shapes[row].id, shapes[row + 1].id, Match(IDENTICAL_FILE))
            for row in range(0, count - 1, 500)
        ),
        faithfulness={method: _spread(found, like) for method, found in rated.items()},
        related=find_nearest(maps["tsne"], min(RELATED, count - 1)),
        separation=rate_separation(scaled, shown, sampled, NEIGHBOURS),
    )


def with_searches(report: Report, count: int, seed: int = 0) -> Report:
    """The report with what a build searches, scores and rates, of a sample of ``count`` shapes of all its classes."""
    names = classes_of(report.labels)
    number = {name: code for code, name in enumerate(names)}
    rows = sample_rows(np.array([number[label] for label in report.labels]), count)
    ids = tuple(report.shapes[row].id for row in rows)
    table = FeatureTable(ids, report.features.blocks, report.features.values[rows].astype(float))
    labels = [report.labels[row] for row in rows]
    scaled = scale(table, PRESET)
    space = make_space(table, scaled, labels, seed=seed)
    search = replace(
        search_features(space, labels, "tsne", seed=seed, rounds=1, groups=np.arange(len(rows))),
        rows=rows[space.rows],
        shape_count=len(report.shapes),
    )
    print("searched features", flush=True)
    bins = _search_bins(table, labels, scaled, seed)
    exemplars = choose_exemplars(
        bins, table, labels, scaled, next(iter(report.projections.values()))[0].xy[rows], NEIGHBOURS
    )
    print("searched bins", flush=True)
    compared = compared_values(table, PRESET)
    scores = [
        [score_separation(scorer, compared, as_one_group(labels, [name])) for name in names[:SCORED]]
        for scorer in SCORERS
    ]
    return replace(
        report,
        search=search,
        bins=_of_all(bins, rows, len(report.shapes)),
        retrieval=_rate(
            space, labels, search, scale_bins(table, PRESET, bins.automatic.bins), bins.automatic.bins
        ),
        scores=BinScores(
            tuple(scorer.name for scorer in SCORERS),
            names,
            np.array(scores, dtype=np.float32)[:, np.arange(len(names)) % SCORED],
        ),
        paintings=tuple(
            Painting(column, int(rows[row]), report.thumbnails[rows[row]], report.thumbnails[rows[row] - 1])
            for column, own in exemplars.items()
            for row in own
        ),
        parameters={**report.parameters, "search": "tsne"},
    )


def _search_bins(
    table: FeatureTable, labels: Sequence[str | None], scaled: FloatArray, seed: int
) -> BinSearch:
    space = make_bin_space(table, PRESET, labels, seed=seed)
    names, codes = encode(space, labels)
    sizes = np.bincount(codes, minlength=len(names))
    everything = squared_distances(scaled[space.rows])
    fold = deal_folds(codes, seed)[0]
    shuffled = shuffle_labels(space, labels, seed)
    found = [find_minimal_bins(space, labels, name) for name in names[:SCORED]]
    by_chance = find_minimal_bins(space, shuffled, names[0])
    return BinSearch(
        automatic=select_bins(space, labels, limit=MOST_BINS),
        held_out=(hold_out(space, labels, fold, everything, limit=MOST_BINS),),
        shuffled=(hold_out(space, shuffled, fold, everything, limit=2),),
        chance=float((sizes[codes] - 1).mean() / (len(codes) - 1)),
        minimal=tuple(replace(found[code % SCORED], label=name) for code, name in enumerate(names)),
        minimal_by_chance=dict.fromkeys(sizes.tolist(), by_chance),
        sizes=dict(zip(names, sizes.tolist())),
    )


def _of_all(found: BinSearch, rows: IntArray, count: int) -> BinSearch:
    """What was found of a sample, as of the database that it was taken from."""

    return replace(
        found,
        automatic=replace(found.automatic, rows=rows[found.automatic.rows], shape_count=count),
        minimal=tuple(replace(separated, rows=rows[separated.rows]) for separated in found.minimal),
    )


def _rate(
    space: SearchSpace,
    labels: Sequence[str | None],
    search: FeatureSearch,
    bins: FloatArray,
    names: tuple[str, ...],
) -> Retrieval:
    """How well the shapes of the search are found by its subsets, and by ``bins``, the values of those chosen."""
    classes, codes = query_classes([labels[row] for row in space.rows])
    subsets = search.subsets.members @ (1 << np.arange(len(space.features)))
    return Retrieval(
        features=space.features,
        rows=search.rows,
        shape_count=search.shape_count,
        classes=classes,
        queries=np.bincount(codes[codes >= 0]).astype(np.int32),
        members=search.subsets.members,
        subsets=tuple(rate_subsets(space.squared, codes, subsets.tolist())),
        bins=names,
        by_bins=rate(squared_distances(bins[space.rows]), codes),
        by_neighbourhood=None,
        chance=rate_chance(codes),
    )


def _class_names(count: int) -> tuple[str, ...]:
    """``round bowl`` and so on; beyond the sorts, ``sort 11 bowl``."""
    sorts = [*SORTS, *(f"sort {number + 1}" for number in range(len(SORTS), count))]
    return classes_of(
        f"{sorts[number // len(KINDS)]} {KINDS[number % len(KINDS)]}" for number in range(count)
    )


def _deal(random: np.random.Generator, count: int, classes: int) -> np.ndarray:
    """The class of all shapes but two of each class; large classes are ten times as large as small ones."""
    shares = np.geomspace(10, 1, classes)
    return random.choice(classes, size=count - 2 * classes, p=random.permutation(shares / shares.sum()))


def _places(random: np.random.Generator, count: int, most: int) -> np.ndarray:
    return np.sort(random.permutation(count)[:most])


def _shapes(random: np.random.Generator, codes: np.ndarray, names: Sequence[str]) -> tuple[ShapeEntry, ...]:
    count = len(codes)
    first = np.searchsorted(codes, codes)
    weights = random.lognormal(5, 1.5, count)
    periods = np.clip(np.round(codes % len(PERIODS) + random.normal(0, 0.6, count)), 0, len(PERIODS) - 1)
    places, days = random.integers(len(PLACES), size=count), random.integers(1, 29, size=count)
    years, known = random.integers(1890, 2025, size=count), random.random((count, 4)) < 0.95
    shapes = []
    for row, code in enumerate(codes.tolist()):
        values = {
            "period": PERIODS[int(periods[row])],
            "found at": PLACES[places[row]],
            "found on": f"{years[row]}-{1 + row % 12:02}-{days[row]:02}",
            "weight": f"{weights[row]:.4g}",
        }
        number = row - int(first[row])
        identifier = f"{names[code]}/{number:06}"
        shapes.append(
            ShapeEntry(
                identifier,
                ROOT / f"{identifier}.off",
                f"{names[code].capitalize()} {number + 1}",
                {"kind": names[code]},
                {
                    name: value
                    for name, value, is_known in zip(values, values.values(), known[row])
                    if is_known
                },
            )
        )
    return tuple(shapes)


def _features(
    random: np.random.Generator, codes: np.ndarray, features: Sequence[str], shapes: Sequence[ShapeEntry]
) -> FeatureTable:
    """Histograms of a prototype a class, with noise; float32, since all features in float64 are two gigabytes."""
    blocks = tuple(block for block in PRESET.blocks if block.name in features)
    parts = []
    for block in blocks:
        prototypes = random.gamma(0.5, 1, (codes.max() + 1, block.width)).astype(np.float32)
        if block.dimensions > 1 and block.bins > 1:
            prototypes[random.random(prototypes.shape) < EMPTY] = 0
        values = prototypes[codes] * random.gamma(4, 0.25, (len(codes), block.width)).astype(np.float32)
        if block.bins > 1:
            shares = values.reshape(len(codes), block.dimensions, block.bins) + np.float32(1e-6)
            values = (shares / shares.sum(axis=2, keepdims=True)).reshape(len(codes), -1)
        parts.append(values)
    return FeatureTable(tuple(shape.id for shape in shapes), blocks, np.hstack(parts))


def _maps(random: np.random.Generator, codes: np.ndarray) -> dict[str, FloatArray]:
    """Clumps, several a class, as t-SNE has them, tighter ones as of UMAP, and one cloud as of PCA; in [-1, 1]."""
    count, classes = len(codes), int(codes.max()) + 1
    clumps = 4
    angle = random.uniform(0, 2 * np.pi, classes)
    middles = np.sqrt(random.random(classes))[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    near = middles[:, None] + random.normal(0, 0.1, (classes, clumps, 2))
    own = near[codes, random.integers(clumps, size=count)]
    stray = random.random(count) < 0.05
    own[stray] = near[random.integers(classes, size=stray.sum()), 0]
    made = {
        "tsne": own + random.normal(0, 0.04, (count, 2)),
        "umap": 1.5 * own + random.normal(0, 0.015, (count, 2)),
        "pca": 0.4 * middles[codes] + random.normal(0, 1, (count, 2)) * [0.3, 0.12],
    }
    for xy in made.values():
        xy -= (xy.max(axis=0) + xy.min(axis=0)) / 2
        xy /= np.abs(xy).max()
    return made


def _quality(xy: FloatArray, codes: np.ndarray, labels: Sequence[str]) -> Quality:
    """As :func:`shapeviz_report.quality.score` has it, but with the level of chance by its mean."""
    k = min(NEIGHBOURS, len(xy) - 1)
    _, near = KDTree(xy).query(xy, k + 1, workers=-1)
    nh = (codes[near[:, 1:]] == codes[:, None]).mean(axis=1)
    limits = hit_range(labels, k)
    names = classes_of(labels)
    of_class = np.bincount(codes, nh) / np.bincount(codes)
    order = np.argsort(-of_class, kind="stable")
    return Quality(
        k=k,
        nh=nh,
        nh_c={names[code]: float(of_class[code]) for code in order},
        nh_s=float(nh.mean()),
        null_mean=limits.chance,
        null_std=0.3 / len(xy),
        range=limits,
    )


def _spread(found: Faithfulness, like: np.ndarray) -> Faithfulness:
    """What was found of a sample, dealt out to all."""
    parts = {
        name: None if (values := getattr(found, name)) is None else values[like]
        for name in ("kept", "false", "missing")
    }
    return Faithfulness(**{**vars(found), **parts})


def _clusters(random: np.random.Generator, codes: np.ndarray) -> Clusters:
    """About as many as half the classes, with a shape in ten astray, by falling size."""
    of = codes // 2
    stray = random.random(len(codes)) < 0.1
    of[stray] = random.integers(of.max() + 1, size=stray.sum())
    found, sizes = np.unique(of, return_counts=True)
    order = np.argsort(-sizes, kind="stable")
    place = np.empty(of.max() + 1, np.int32)
    place[found[order]] = np.arange(len(found))
    numbers = place[of]
    clusters = tuple(
        Cluster(
            f"like number {number + 1}",
            int(np.flatnonzero(numbers == number)[0]),
            int(sizes[order[number]]),
            ("More of the surface is flat.",),
        )
        for number in range(len(found))
    )
    return Clusters(clusters, numbers, silhouette=0.3, steadiness=0.8, stand_in=False)


def _facts(random: np.random.Generator, count: int) -> Iterator[ShapeFacts]:
    sizes = random.lognormal(0, 0.5, (count, 3))
    faces = random.lognormal(9, 1, count).astype(int) + 4
    for row in range(count):
        x, y, z = map(float, sizes[row])
        watertight = row % 3 != 0
        yield ShapeFacts(
            sha256=f"{row:064x}",
            faces_read=int(faces[row]),
            vertices_read=int(faces[row]) // 2 + 2,
            faces=9000 + row % 100,
            vertices=4500 + row % 50,
            components=1 + (row % 11 == 0),
            watertight=watertight,
            repairs={"duplicate faces removed": 1 + row % 9} if row % 4 == 0 else {},
            deviation=0.001 + row % 7 / 10000,
            area=2 * (x * y + y * z + z * x),
            volume=x * y * z if watertight else None,
            extents=(x, y, z),
        )


def _pictures(random: np.random.Generator, codes: np.ndarray) -> Iterator[bytes]:
    """A picture a shape: of shapes of a class, drawings that are alike."""
    classes = int(codes.max()) + 1
    variants = max(1, min(DRAWN, len(codes)) // classes)
    size = thumbnail_size(Config(), len(codes))
    drawings = [
        [_draw(random, code, variant, size) for variant in range(variants)] for code in range(classes)
    ]
    chosen = random.integers(variants, size=len(codes))
    for row, code in enumerate(codes.tolist()):
        yield _marked(drawings[code][chosen[row]], row)


def _draw(random: np.random.Generator, code: int, variant: int, size: int) -> bytes:
    """A WebP image of about as many bytes as a rendered shape: a few overlapping grey bodies with soft shades."""
    form = np.random.default_rng(code)
    image = Image.new("RGBA", (256, 256), (0, 0, 0, 0))
    drawing = ImageDraw.Draw(image)
    for _ in range(2 + code % 4):
        x, y = form.uniform(90, 166, 2) + random.normal(0, 4, 2)
        wide, high = form.uniform(20, 75, 2)
        shade = int(form.uniform(110, 190)) + variant % 12
        for step in range(8):
            part, light = 1 - step / 9, shade + 7 * step
            box = (
                x - wide * part - step,
                y - high * part - step,
                x + wide * part - step,
                y + high * part - step,
            )
            drawing.ellipse(box, fill=(light, light - 4, light - 14, 255))
    grain = Image.fromarray(random.normal(128, 40, (256, 256)).clip(0, 255).astype(np.uint8))
    soft = Image.merge("RGB", [grain.filter(ImageFilter.GaussianBlur(0.65))] * 3)
    image = Image.merge(
        "RGBA", (*Image.blend(image.convert("RGB"), soft, 0.8).split(), image.getchannel("A"))
    )
    file = io.BytesIO()
    image.resize((size, size)).save(file, "WEBP", quality=WEBP_QUALITY, method=WEBP_METHOD)
    return file.getvalue()


def _marked(picture: bytes, row: int) -> bytes:
    """The picture with the number of its shape in a part of the file that browsers skip."""
    part = b"ROWN" + (4).to_bytes(4, "little") + row.to_bytes(4, "little")
    return picture[:4] + (len(picture) - 8 + len(part)).to_bytes(4, "little") + picture[8:] + part


@contextmanager
def _timed(what: str) -> Iterator[None]:
    started = time.perf_counter()
    yield
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{what}: {time.perf_counter() - started:.1f} s, peak {peak:.0f} MiB", flush=True)


def print_sizes(site: Path) -> None:
    """What each part of a site weighs: folders, and files of chunks and data on their own; numbered ones together."""
    sizes: Counter[str] = Counter()
    files: dict[str, int] = defaultdict(int)
    for file in site.rglob("*"):
        if file.is_file():
            place = file.relative_to(site)
            alone = place.parent.name in ("assets", "data") and len(place.parts) == 2
            part = place.as_posix() if alone else f"{place.parent.as_posix()}/"
            sizes[part] += file.stat().st_size
            files[part] += 1
    print("| part | files | MB |\n|---|---|---|")
    for part, size in sizes.most_common():
        if size >= 50_000:
            print(f"| {part} | {files[part]} | {size / 1e6:.2f} |")
    print(f"| all | {sum(files.values())} | {sizes.total() / 1e6:.2f} |")


def main() -> None:
    """Generate, write, and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.generated")
    parser.add_argument("out", metavar="OUT", type=Path)
    parser.add_argument("--shapes", type=int, default=100_000)
    parser.add_argument("--classes", type=int, default=60)
    parser.add_argument("--features", default=",".join(FEATURES), help="names, or all")
    parser.add_argument("--searched", type=int, default=0, help="shapes that searches look at")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    every = [block.name for block in PRESET.blocks]
    features = every if given.features == "all" else given.features.split(",")
    with _timed("report"):
        report = make_report(given.shapes, given.classes, features, given.seed)
    if given.searched:
        with _timed("searches"):
            report = with_searches(report, given.searched, given.seed)
    with _timed("site"):
        write_site(report, given.out)
    print_sizes(given.out)


if __name__ == "__main__":
    main()
