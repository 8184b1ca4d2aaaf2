"""The questions that are asked of a whole database, each a stage of a build."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from hashlib import sha256
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.bins import features_of
from shapeviz_report.building.chains import Chain, Plan
from shapeviz_report.building.runner import Runner, Task
from shapeviz_report.building.stages import (
    CLUSTER,
    PAINT,
    PROJECT,
    RELATE,
    RETRIEVE,
    SCORE,
    SEARCH,
    SELECT,
    Stage,
)
from shapeviz_report.clusters import describe_clusters
from shapeviz_report.config import Config
from shapeviz_report.diffusion import diffuse
from shapeviz_report.features import BINS
from shapeviz_report.order import classes_of
from shapeviz_report.presets import PRESETS
from shapeviz_report.projections import PAIRWISE_LIMIT, align, squared_distances
from shapeviz_report.projections.registry import ALL_PROJECTIONS
from shapeviz_report.quality import hit_range
from shapeviz_report.retrieval import query_classes, rate_chance
from shapeviz_report.scorers import MOST_SCORED
from shapeviz_report.scorers.registry import ALL_SCORERS
from shapeviz_report.search import SearchSpace, SubsetMaps, planned_runs, search_features
from shapeviz_report.search.bins import (
    SAMPLE_LIMIT_OF_CLASS,
    BinSpace,
    affordable_deals,
    encode,
    make_bin_space,
    shuffle_labels,
)
from shapeviz_report.search.certainty import deal_folds
from shapeviz_report.search.space import stratified_sample
from shapeviz_report.types import (
    BinScores,
    BinSearch,
    Clusters,
    FeatureSearch,
    FeatureTable,
    FloatArray,
    HeldOutBins,
    IntArray,
    Painting,
    Projection,
    Retrieval,
    ShapeEntry,
    distinct_rows,
)

logger = logging.getLogger(__name__)

SUBSETS_A_TASK = 16
"""Maps that a worker makes before it reports back: few enough to lose little, many enough to send distances seldom."""

RATINGS_A_TASK = 64
"""Subsets whose retrieval a worker rates before it reports back: each takes 2 to 150 milliseconds, by the number of
shapes, against up to 32 MB of distances that are sent along."""

MOST_SENT = 2**28
"""Bytes of values that a question sends to another machine; with more it is answered on this one."""

SHUFFLES = 2
"""Folds that also meet labels dealt out at random. With labels without meaning the search takes twice the time, and two
folds of 56 shapes tell NH_s to 0.01."""


def find_clusters(
    run: Runner,
    shapes: Sequence[ShapeEntry],
    features: FeatureTable,
    scaled: FloatArray,
    edges: FloatArray,
    config: Config,
    *,
    stand_in: bool,
) -> Clusters | None:
    """Groups of the shapes by their features alone, with names."""
    key = CLUSTER.key(scaled.shape, sha256(scaled.tobytes()).hexdigest(), config.seed)
    here = scaled.nbytes > MOST_SENT
    partition = run.all(CLUSTER, {"all": Task.of(key, scaled, config.seed)}, here=here)["all"]
    if partition is None:
        return None
    preset = PRESETS[config.preset]
    return describe_clusters(partition, shapes, features, scaled, edges, preset, stand_in=stand_in)


def project_all(
    run: Runner,
    space: SearchSpace,
    features: FeatureTable,
    bins: tuple[str, ...] | None,
    values: FloatArray,
    seed: int,
) -> dict[str, Projection]:
    """The map of every method that takes so many rows, turned to agree with the first; from the scaled values of all
    columns or of some bins."""
    names = features_of(features, features.columns if bins is None else bins)
    # Where the search takes all shapes, its map of all features is the map: t-SNE and UMAP make another one of sums
    # that differ in their last digits.
    whole = bins is None and len(space.rows) == len(values)
    offered = [method for method in ALL_PROJECTIONS if method.takes(len(values))]
    methods = [method.name for method in offered]
    shared = {method.name for method in offered if method.rounds and whole}
    everything = (space.everything,)
    content = sha256(values.tobytes()).hexdigest()
    own = {
        method.name: Task.of(PROJECT.key(method.name, values.shape, content, seed), method.name, values, seed)
        for method in offered
        if method.name not in shared
    }
    of_search = {
        name: Task.of(SEARCH.key(space.key, name, seed, everything), space.squared, name, seed, everything)
        for name in methods
        if name in shared
    }

    with run.clock.stage(PROJECT.name, PROJECT.doing, len(methods)) as step:

        def done(_: str, cpu_seconds: float) -> None:
            step(cpu_seconds)

        found: dict[str, FloatArray] = run.answer(PROJECT, own, done, here=values.nbytes > MOST_SENT)
        as_map = replace(SEARCH, failing=PROJECT.failing)
        for method, made in run.answer(as_map, of_search, done).items():
            found[method] = np.empty((len(values), 2))
            found[method][space.rows] = made.xy[0]
    maps = {method: Projection(method, names, seed, found[method], bins) for method in methods}
    return {method: align(maps[method], maps[methods[0]]) for method in methods}


def lay_out_best(
    run: Runner,
    search: FeatureSearch,
    features: FeatureTable,
    bins: tuple[str, ...] | None,
    scaled: FloatArray,
    config: Config,
    like: Projection,
) -> tuple[Projection, FloatArray] | None:
    """The map of all shapes by the best subset of a search that laid out a sample, turned to agree with another, and
    the values that it compares; None where the search or the map of all features has it."""
    best = search.best
    if best is None or len(search.rows) == len(scaled) or (bins is None and best == search.features):
        return None
    values = np.ascontiguousarray(
        np.hstack(
            [scaled[:, features.slice_of(block.name)] for block in features.blocks if block.name in best]
        )
    )
    content = sha256(values.tobytes()).hexdigest()
    key = PROJECT.key(search.method, values.shape, content, config.seed)
    task = Task.of(key, search.method, values, config.seed)
    xy = run.all(PROJECT, {search.method: task}, here=values.nbytes > MOST_SENT)[search.method]
    return align(Projection(search.method, best, config.seed, xy, None), like), values


def relate_all(run: Runner, scaled: FloatArray) -> IntArray | None:
    """The shapes most similar to each by distances that know their neighbourhood; None where there are too many for
    these."""
    if len(scaled) > PAIRWISE_LIMIT:
        return None
    key = RELATE.key(scaled.shape, sha256(scaled.tobytes()).hexdigest())
    return run.all(RELATE, {"all": Task.of(key, scaled)})["all"]


def search_subsets(
    run: Runner, space: SearchSpace, labels: Sequence[str | None], groups: IntArray, config: Config
) -> FeatureSearch | None:
    """The search for the best subset of features, its maps made by the executor and kept."""
    if config.search == "none":
        return None
    with run.clock.stage(
        SEARCH.name, SEARCH.doing, planned_runs(len(space.features), config.search) or 0
    ) as step:

        def done(chunk: tuple[int, ...], cpu_seconds: float) -> None:
            step(cpu_seconds)
            for _ in chunk[1:]:
                step(0.0)

        def evaluate(seed: int, subsets: Sequence[int]) -> SubsetMaps:
            chunks = [tuple(subsets[i : i + SUBSETS_A_TASK]) for i in range(0, len(subsets), SUBSETS_A_TASK)]
            tasks = {
                chunk: Task.of(
                    SEARCH.key(space.key, config.search, seed, chunk),
                    space.squared,
                    config.search,
                    seed,
                    chunk,
                )
                for chunk in chunks
            }
            made = run.answer(SEARCH, tasks, done).values()
            return SubsetMaps(
                np.concatenate([maps.xy for maps in made]),
                np.concatenate([maps.cpu_seconds for maps in made]),
            )

        return search_features(
            space,
            labels,
            config.search,
            evaluate=evaluate,
            seed=config.seed,
            k=config.neighbours,
            groups=groups,
        )


def score_all(run: Runner, compared: FloatArray, labels: Sequence[str | None], seed: int) -> BinScores | None:
    """How well every bin separates each class from the rest, by every scorer; a task a class."""
    classes = classes_of(labels)
    if len(classes) < 2:
        return None
    content = sha256(compared.tobytes()).hexdigest()
    tasks = {}
    for name in classes:
        members, others = contestants(labels, name, seed)
        rows = [*members, *others]

        def arguments(rows: list[int] = rows, count: int = len(members)) -> tuple[Any, ...]:
            return compared[rows], range(count), range(count, len(rows)), seed

        tasks[name] = Task(SCORE.key(compared.shape, content, members, others, seed), arguments)
    found = run.all(SCORE, tasks)
    values = np.stack([found[name] for name in classes], axis=1)
    return BinScores(tuple(scorer.name for scorer in ALL_SCORERS), tuple(classes), values)


def contestants(labels: Sequence[str | None], name: str, seed: int) -> tuple[list[int], list[int]]:
    """The rows of a class and of the rest by which its bins are scored: all, or ``MOST_SCORED`` where there are more.

    Of these at most a tenth are of the class, or more where the rest leaves room; of the rest every class has its
    share.
    """
    members = [row for row, label in enumerate(labels) if label == name]
    others = [row for row, label in enumerate(labels) if label not in (name, None)]
    if len(members) + len(others) <= MOST_SCORED:
        return members, others
    count = min(len(members), max(MOST_SCORED // 10, MOST_SCORED - len(others)))
    chosen = stratified_sample([name] * len(members), count, seed)
    rest = stratified_sample([labels[row] for row in others], MOST_SCORED - count, seed)
    return [members[place] for place in chosen], [others[place] for place in rest]


def search_all_bins(
    run: Runner,
    features: FeatureTable,
    scaled: FloatArray,
    labels: Sequence[str | None],
    groups: IntArray,
    config: Config,
) -> BinSearch | None:
    """The bins that separate each class, those that separate all, and what these are worth."""
    if config.search == "none":
        return None
    preset = PRESETS[config.preset]
    space = make_bin_space(features, preset, labels, seed=config.seed)
    of_class = make_bin_space(features, preset, labels, seed=config.seed, limit=SAMPLE_LIMIT_OF_CLASS)
    codes = encode(space, labels)[1]
    classes, own_codes = encode(of_class, labels)
    sizes = np.bincount(own_codes[own_codes >= 0], minlength=len(classes))
    if (sizes > 1).sum() < 2:
        return None
    everything = squared_distances(scaled[space.rows])
    shared = {"k": config.neighbours, "seed": config.seed}
    questions: list[tuple[str, BinSpace, Sequence[str | None], dict[str, Any]]] = [
        ("select", space, labels, shared)
    ]
    held: dict[str, Any] = {"k": config.neighbours, "everything": everything}
    distinct = distinct_rows(groups[space.rows], codes >= 0)
    if distinct is not None:
        held["distinct"] = distinct.tolist()
    for deal in range(affordable_deals(len(codes))):
        seed = config.seed + deal
        for fold in deal_folds(codes, seed, groups[space.rows]):
            options = held | {"seed": seed, "fold": fold, "deal": deal + 1}
            questions.append(("hold out", space, labels, options))
    own = len(questions)
    # Each fold meets labels of its own, which tells more of chance than one labeling for all.
    for number in range(SHUFFLES):
        shuffled = shuffle_labels(space, labels, config.seed + number)
        folds = deal_folds(encode(space, shuffled)[1], config.seed, groups[space.rows])
        fold = folds[number % len(folds)]
        questions.append(("hold out", space, shuffled, shared | {"fold": fold, "everything": everything}))
    honest = len(questions)
    for label in (label for label, size in zip(classes, sizes) if size > 1):
        questions.append(("separate", of_class, labels, shared | {"label": label}))
    random = len(questions)
    of_size = {int(size): label for label, size in zip(classes, sizes) if size > 1}
    for label in of_size.values():
        shuffled = shuffle_labels(of_class, labels, config.seed)
        questions.append(("separate", of_class, shuffled, shared | {"label": label}))

    surpassed = sha256(everything.tobytes()).hexdigest()
    tasks = {}
    for number, (task, searched, names, options) in enumerate(questions):
        told = options | {"fold": list(options.get("fold", ()))}
        if "everything" in options:
            told["everything"] = surpassed
        key = SELECT.key(searched.content, searched.names, searched.rows.tolist(), task, tuple(names), told)
        tasks[number] = Task.of(key, task, searched, names, options)
    found = run.all(SELECT, tasks)
    held_out: list[HeldOutBins] = [found[i] for i in range(1, honest)]
    return BinSearch(
        automatic=found[0],
        held_out=tuple(held_out[: own - 1]),
        shuffled=tuple(held_out[own - 1 :]),
        chance=hit_range([labels[row] for row in space.rows], config.neighbours).chance or 0.0,
        minimal=tuple(found[i] for i in range(honest, random)),
        minimal_by_chance={size: found[i] for i, size in enumerate(of_size, start=random)},
        sizes=dict(zip(classes, sizes.tolist())),
    )


def rate_all(
    run: Runner,
    space: SearchSpace,
    labels: Sequence[str | None],
    search: FeatureSearch | None,
    bins: tuple[str, ...] | None,
    by_bins: FloatArray | None,
) -> Retrieval | None:
    """How well shapes of a class are found by each feature alone, all of them, the subsets of the search, and by some
    bins, whose scaled values of all shapes are ``by_bins``; all features by distances that know their neighbourhood
    too."""
    classes, codes = query_classes([labels[row] for row in space.rows])
    if not classes:
        return None
    features = range(len(space.features))
    searched = () if search is None else (search.subsets.members @ [1 << f for f in features]).tolist()
    subsets = sorted({*searched, *(1 << f for f in features), space.everything})
    distances: dict[str, tuple[str, npt.NDArray[np.floating]]] = {"subsets": (space.key, space.squared)}
    questions = [
        ("subsets", tuple(subsets[i : i + RATINGS_A_TASK])) for i in range(0, len(subsets), RATINGS_A_TASK)
    ]
    if space.shape_count <= PAIRWISE_LIMIT:
        squared = diffuse(space.squared.sum(axis=0, dtype=np.float64))[None]
        distances["neighbourhood"] = (sha256(squared.tobytes()).hexdigest(), squared)
        questions.append(("neighbourhood", (1,)))
    if by_bins is not None:
        squared = squared_distances(by_bins[space.rows])[None]
        distances["bins"] = (sha256(squared.tobytes()).hexdigest(), squared)
        questions.append(("bins", (1,)))
    tasks = {}
    for question in questions:
        key, compared = distances[question[0]]
        tasks[question] = Task.of(
            RETRIEVE.key(key, codes.tolist(), question[1]), compared, codes, question[1]
        )
    found = run.all(RETRIEVE, tasks)
    return Retrieval(
        features=space.features,
        rows=space.rows,
        shape_count=space.shape_count,
        classes=classes,
        queries=np.bincount(codes[codes >= 0]).astype(np.int32),
        members=np.array([[bool(subset >> f & 1) for f in features] for subset in subsets]),
        subsets=tuple(
            rating for question in questions if question[0] == "subsets" for rating in found[question]
        ),
        bins=bins,
        by_neighbourhood=found["neighbourhood", (1,)][0] if "neighbourhood" in distances else None,
        by_bins=None if by_bins is None else found["bins", (1,)][0],
        chance=rate_chance(codes),
    )


def paint_all(
    run: Runner,
    features: FeatureTable,
    exemplars: Mapping[str, Sequence[int]],
    plan: Callable[[str, tuple[tuple[int, int], ...]], Plan],
) -> tuple[Painting, ...]:
    """Bins painted on shapes, a task a shape.

    Parameters
    ----------
    run : Runner
    features : FeatureTable
    exemplars : mapping of str to rows
        Bin -> the shapes that are to show it.
    plan : callable
        The chain that paints some bins, each by its dimension and place, both from 0, on a shape, by its id.
    """
    place = {column: divmod(number, BINS) for number, column in enumerate(features.columns)}
    shapes = sorted({row for rows in exemplars.values() for row in rows})
    columns = {row: [column for column, rows in exemplars.items() if row in rows] for row in shapes}
    names = features.shape_ids
    bins = {names[row]: tuple(place[column] for column in columns[row]) for row in shapes}
    painted: dict[str, list[tuple[bytes, bytes]]] = {}

    def take(shape: str, _: Chain, values: dict[Stage[Any], Any]) -> None:
        painted[shape] = values[PAINT]

    run.each(PAINT.doing, bins, [PAINT], lambda shape: plan(shape, bins[shape]), take)
    found: dict[tuple[str, int], Painting] = {}
    for row in shapes:
        for column, (value, inside) in zip(columns[row], painted[names[row]], strict=True):
            found[column, row] = Painting(column, row, value, inside)
    return tuple(found[column, row] for column, rows in exemplars.items() for row in rows)
