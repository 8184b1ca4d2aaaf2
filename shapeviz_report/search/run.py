"""The whole search, from distances to all that the Features page shows."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from math import comb

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_matrix, vstack

from shapeviz_report.faithfulness import rate_distances
from shapeviz_report.order import classes_of
from shapeviz_report.projections import PROJECTIONS, turn_towards
from shapeviz_report.quality import (
    NEIGHBOURS,
    highest_hits,
    hits_among,
    neighbour_weights,
    neighbourhood_hits,
)
from shapeviz_report.search.certainty import (
    DEALS,
    best_by_chance,
    compare_spreads,
    deal_folds,
    seen_scores,
)
from shapeviz_report.search.greedy import Trace, climb
from shapeviz_report.search.space import SearchSpace, SubsetMaps, map_subsets
from shapeviz_report.types import (
    FeatureEffect,
    FeatureSearch,
    FloatArray,
    GreedySearch,
    GreedyStep,
    HeldOutFold,
    IntArray,
    SearchRow,
    SeedSpread,
    SubsetFaithfulness,
    SubsetScores,
    distinct_rows,
)

EXHAUSTIVE_LIMIT = 10
"""Most features of which all subsets are evaluated: 1023."""

NEIGHBOUR_LIMIT = 300
"""Most subsets that a greedy search may look at in one step; a larger s is left out."""

GREEDY_SIZES = (1, 2, 3)
SPREAD_SEEDS = 10
FINALISTS = 12
"""Best subsets whose spread over seeds is measured, besides all features."""

EvaluateSubsets = Callable[[int, Sequence[int]], SubsetMaps]
"""``(seed, subsets) -> SubsetMaps``: :func:`map_subsets` for one space and method, in as many pieces and processes
as the caller likes."""


def _rounds(method: str) -> int:
    return next(known.rounds for known in PROJECTIONS if known.name == method)


def planned_runs(feature_count: int, method: str, rounds: int | None = None) -> int | None:
    """The most maps that :func:`search_features` asks for; None where that depends on what it finds."""
    rounds = rounds or _rounds(method)
    if feature_count > EXHAUSTIVE_LIMIT:
        return None
    subsets = (1 << feature_count) - 1
    return rounds * subsets + max(SPREAD_SEEDS - rounds, 0) * min(FINALISTS + 1, subsets)


def search_features(
    space: SearchSpace,
    labels: Sequence[str | None],
    method: str,
    *,
    evaluate: EvaluateSubsets | None = None,
    seed: int = 0,
    k: int = NEIGHBOURS,
    rounds: int | None = None,
    groups: IntArray | None = None,
) -> FeatureSearch:
    """Search for the subset of features whose map separates the classes best.

    Evaluates all subsets of up to ``EXHAUSTIVE_LIMIT`` features. Of more, all subsets of the paper's, the local ones,
    and those that the greedy algorithm wants. No map is made twice.

    Parameters
    ----------
    space : SearchSpace
    labels : n labels
        Of all rows of the feature table; None for a shape without one.
    method : str
        The name of a projection.
    evaluate : callable
        How maps are made; by default here and now.
    seed : int
        Of the first round; the r-th has ``seed + r - 1``.
    k : int
        Of the neighbourhood hit.
    rounds : int
        Rounds of Table 2; by default those of the method.
    groups : (n,) int array, optional
        Of all rows of the feature table; shapes of one group are held out together.
    """
    chosen = [labels[i] for i in space.rows]
    own = None if groups is None else groups[space.rows]
    return _Search(space, chosen, method, evaluate, seed, k, own).run(rounds or _rounds(method))


class _Search:
    """Maps and scores that are known already, and what is concluded from them."""

    def __init__(
        self,
        space: SearchSpace,
        labels: Sequence[str | None],
        method: str,
        evaluate: EvaluateSubsets | None,
        seed: int,
        k: int,
        groups: IntArray | None,
    ) -> None:
        self.groups = groups
        self.space, self.method, self.seed = space, method, seed
        self.evaluate = evaluate or (lambda s, subsets: map_subsets(space.squared, method, s, subsets))
        self.classes = classes_of(labels)
        number = {label: i for i, label in enumerate(self.classes)}
        self.codes = np.array([-1 if label is None else number[label] for label in labels], dtype=np.intp)
        self.labelled = self.codes >= 0
        self.k = min(k, len(labels) - 1)
        self.scored = self.k >= 1 and bool(self.classes)
        self.kept = None if groups is None else distinct_rows(groups, self.labelled)
        self.highest = highest_hits(self.codes, max(self.k, 1))
        self.maps: dict[int, np.ndarray] = {}
        self.weights: dict[tuple[int, int], csr_matrix] = {}
        self.hits: dict[tuple[int, int], np.ndarray] = {}
        self.distinct_hits: dict[tuple[int, int], np.ndarray] = {}
        self.seconds: dict[tuple[int, int], float] = {}

    def run(self, rounds: int) -> FeatureSearch:
        count, local = len(self.space.features), self.space.local
        refusal = None
        whole = count
        if count > EXHAUSTIVE_LIMIT:
            whole = local if local <= EXHAUSTIVE_LIMIT else 0
            evaluated = f"all {2**whole - 1:,} of the paper's {whole}, and of the others " if whole else ""
            refusal = (
                f"{count} features have {2**count - 1:,} subsets. Evaluated are {evaluated}those that the greedy "
                f"search asks for; up to {EXHAUSTIVE_LIMIT} features it would be all."
            )
        alone = [1 << i for i in range(count)]
        self.need(self.seed, [self.space.everything, *range(1, 1 << whole), *alone])
        greedy: tuple[GreedySearch, ...] = ()
        table: tuple[SearchRow, ...] = ()
        spread: tuple[SeedSpread, ...] = ()
        held_out: tuple[HeldOutFold, ...] = ()
        effects: tuple[FeatureEffect, ...] = ()
        null_best = np.empty(0)
        if self.scored:
            held_out = self.hold_out_all(rounds) if refusal is None else self.hold_out_climbing()
            greedy, table = self.fill_table(rounds, refusal is None)
            finalists = sorted(self.maps, key=lambda subset: (-self.score(self.seed, subset), subset))[
                :FINALISTS
            ]
            spread = self.measure_spread(finalists)
            null_best = best_by_chance(self.stack(sorted(self.maps), self.seed), self.codes, self.seed)
            effects = self.weigh_features(refusal is None)
        return FeatureSearch(
            method=self.method,
            seed=self.seed,
            k=max(self.k, 0),
            features=self.space.features,
            classes=self.classes,
            rows=np.sort(self.space.rows),
            shape_count=self.space.shape_count,
            subsets=self.gather(),
            exhaustive=refusal is None,
            refusal=refusal,
            greedy=greedy,
            table=table,
            spread=spread,
            held_out=held_out,
            null_best=null_best,
            effects=effects,
        )

    def need(self, seed: int, subsets: Sequence[int]) -> None:
        """Have maps and hits of these subsets; only what is missing is evaluated."""
        missing = [s for s in dict.fromkeys(subsets) if (seed, s) not in self.seconds]
        if not missing:
            return
        made = self.evaluate(seed, missing)
        for subset, xy, seconds in zip(missing, made.xy, made.cpu_seconds):
            if seed == self.seed:
                # The map of all features is the first to be asked for.
                reference = self.maps.get(self.space.everything, xy)
                if subset != self.space.everything:
                    xy = turn_towards(xy.astype(np.float64), reference.astype(np.float64)).astype(np.float32)
                self.maps[subset] = xy
            self.seconds[seed, subset] = float(seconds)
            hits = np.full(len(self.codes), np.nan)
            if self.scored:
                weights = neighbour_weights(xy.astype(np.float64), self.k)
                hits[self.labelled] = neighbourhood_hits(weights, self.codes)[self.labelled]
                self.weights[seed, subset] = weights
                if self.kept is not None:
                    self.distinct_hits[seed, subset] = hits_among(
                        xy.astype(np.float64), self.codes, self.kept, self.k
                    )
            self.hits[seed, subset] = hits

    def score(self, seed: int, subset: int) -> float:
        """NH_s of an evaluated subset."""
        return float(self.hits[seed, subset][self.labelled].mean())

    def stack(self, subsets: Sequence[int], seed: int) -> csr_matrix:
        """The neighbours on one seed's maps, one map below the other."""
        return vstack([self.weights[seed, s] for s in subsets], format="csr")

    def climb(self, seed: int, s: int) -> Trace:
        """Algorithm 1 on one seed's maps."""

        def scores_of(subsets: Sequence[int]) -> list[float]:
            self.need(seed, subsets)
            return [self.score(seed, subset) for subset in subsets]

        return climb(len(self.space.features), s, scores_of, float(self.highest[self.labelled].mean()))

    def fill_table(
        self, rounds: int, exhaustive: bool
    ) -> tuple[tuple[GreedySearch, ...], tuple[SearchRow, ...]]:
        """The greedy searches of the first seed, and Table 2."""
        count = len(self.space.features)
        neighbours = np.cumsum([comb(count, size) for size in range(1, count + 1)])
        sizes = [s for s in GREEDY_SIZES if s == 1 or (s <= count and neighbours[s - 1] <= NEIGHBOUR_LIMIT)]
        greedy, table = [], []
        for round_ in range(1, rounds + 1):
            seed = self.seed + round_ - 1
            if exhaustive:
                subsets = range(1, 1 << count)
                self.need(seed, subsets)
                best = max(subsets, key=lambda subset: self.score(seed, subset))
                table.append(self.row(round_, "exhaustive", None, seed, best, subsets))
            for s in sizes:
                trace = self.climb(seed, s)
                row = self.row(round_, "greedy", s, seed, trace.path[-1][0], trace.evaluated)
                table.append(row)
                if round_ == 1:
                    path = []
                    for before, (subset, value) in zip([0, *(p[0] for p in trace.path)], trace.path):
                        changed = self.space.names(before ^ subset)
                        path.append(GreedyStep(self.space.names(subset), changed, value))
                    greedy.append(GreedySearch(s, tuple(path), row.runs, trace.considered, row.cpu_seconds))
        return tuple(greedy), tuple(table)

    def row(
        self, round_: int, method: str, s: int | None, seed: int, best: int, evaluated: Collection[int]
    ) -> SearchRow:
        """A row of Table 2, with the time of all maps that this method needed."""
        return SearchRow(
            round=round_,
            method=method,
            s=s,
            features=self.space.names(best),
            nh_s=self.score(seed, best),
            cpu_seconds=sum(self.seconds[seed, subset] for subset in sorted(evaluated)),
            runs=len(evaluated),
        )

    def measure_spread(self, finalists: Sequence[int]) -> tuple[SeedSpread, ...]:
        """The best subsets and all features over seeds."""
        subsets = list(dict.fromkeys([*finalists, self.space.everything]))
        hits = []
        for seed in range(self.seed, self.seed + SPREAD_SEEDS):
            self.need(seed, subsets)
            hits.append([self.hits[seed, subset][self.labelled] for subset in subsets])
        return compare_spreads([self.space.names(s) for s in subsets], np.array(hits).swapaxes(0, 1))

    def hold_out_all(self, rounds: int) -> tuple[HeldOutFold, ...]:
        """Choose of all subsets by the labels of some shapes, score on the others; the deals share the rounds' maps."""
        folds = []
        for round_ in range(rounds):
            seed = self.seed + round_
            subsets = range(1, self.space.everything + 1)
            self.need(seed, subsets)
            weights = self.stack(subsets, seed)
            for deal in range(round_, DEALS, rounds):
                for fold in deal_folds(self.codes, self.seed + deal, self.groups):
                    scores = seen_scores(weights, self.codes, fold)
                    best = int(scores.argmax())
                    folds.append(self.fold(deal + 1, seed, subsets[best], float(scores[best]), fold))
            if round_ > 0:
                self.forget_neighbours(seed)
        return tuple(sorted(folds, key=lambda fold: fold.deal))

    def hold_out_climbing(self) -> tuple[HeldOutFold, ...]:
        """The same by Algorithm 1, once: every deal would ask for maps of its own."""
        return tuple(
            self.fold(1, self.seed, *self.climb_seeing(fold).path[-1], fold)
            for fold in deal_folds(self.codes, self.seed, self.groups)
        )

    def fold(self, deal: int, seed: int, chosen: int, seen: float, shapes: np.ndarray) -> HeldOutFold:
        """What the subset that was chosen without some shapes reaches on these."""
        subsets = (chosen, self.space.everything)
        own, everything = (float(self.hits[seed, subset][shapes].mean()) for subset in subsets)
        own_distinct, everything_distinct = None, None
        if self.kept is not None:
            distinct = np.intersect1d(shapes, self.kept)
            own_distinct, everything_distinct = (
                float(self.distinct_hits[seed, subset][distinct].mean()) for subset in subsets
            )
        return HeldOutFold(
            deal=deal,
            seed=seed,
            features=self.space.names(chosen),
            shapes=len(shapes),
            nh_s_seen=seen,
            nh_s=own,
            nh_s_all=everything,
            nh_max=float(self.highest[shapes].mean()),
            nh_s_distinct=own_distinct,
            nh_s_all_distinct=everything_distinct,
        )

    def forget_neighbours(self, seed: int) -> None:
        """Those of the first seed are asked for again, those of others are not, and weigh as much."""
        self.weights = {key: weights for key, weights in self.weights.items() if key[0] != seed}

    def climb_seeing(self, held_out: np.ndarray) -> Trace:
        """Algorithm 1 with s = 1, without the labels of some shapes."""

        def scores_of(subsets: Sequence[int]) -> FloatArray:
            self.need(self.seed, subsets)
            return seen_scores(self.stack(subsets, self.seed), self.codes, held_out)

        return climb(len(self.space.features), 1, scores_of)

    def weigh_features(self, exhaustive: bool) -> tuple[FeatureEffect, ...]:
        """What each feature adds or spoils: over all subsets, or, of too many features, to all others."""
        effects, everything = [], self.space.everything
        if not exhaustive:
            self.need(self.seed, [everything ^ 1 << i for i in range(len(self.space.features))])
        for i, feature in enumerate(self.space.features):
            own = 1 << i
            alone = self.score(self.seed, own)
            with_, without, added = None, None, None
            if not exhaustive:
                with_, without = self.score(self.seed, everything), self.score(self.seed, everything ^ own)
                added = with_ - without
            else:
                scores = {subset: self.score(self.seed, subset) for subset in self.maps}
                with_ = float(np.mean([value for subset, value in scores.items() if subset & own]))
                others = [subset for subset in scores if not subset & own]
                if others:
                    without = float(np.mean([scores[subset] for subset in others]))
                    added = float(np.mean([scores[subset | own] - scores[subset] for subset in others]))
            effects.append(FeatureEffect(feature, alone, with_, without, added))
        return tuple(effects)

    def gather(self) -> SubsetScores:
        """All subsets of the first seed, shapes back in the order of the feature table."""
        subsets = sorted(self.maps)
        back = np.argsort(self.space.rows)
        hits = np.array([self.hits[self.seed, s] for s in subsets])
        nh_c = np.full((len(subsets), len(self.classes)), np.nan)
        if self.scored:
            for c in range(len(self.classes)):
                nh_c[:, c] = hits[:, self.codes == c].mean(axis=1)
        return SubsetScores(
            members=np.array(
                [[s >> i & 1 for i in range(len(self.space.features))] for s in subsets], dtype=bool
            ),
            xy=np.array([self.maps[s][back] for s in subsets]),
            nh=hits[:, back].astype(np.float32),
            nh_s=np.array([self.score(self.seed, s) if self.scored else np.nan for s in subsets]),
            nh_c=nh_c,
            cpu_seconds=np.array([self.seconds[self.seed, s] for s in subsets]),
            faithfulness=self.rate_faithfulness(subsets, back),
        )

    def rate_faithfulness(self, subsets: Sequence[int], back: np.ndarray) -> SubsetFaithfulness | None:
        """What the maps of the first seed make of the neighbours and distances that they show."""
        maps = (self.maps[subset].astype(np.float64) for subset in subsets)
        rated = [
            found
            for subset, xy in zip(subsets, maps)
            if (found := rate_distances(self.space.distances(subset), xy, self.k)) is not None
        ]
        if not rated:
            return None

        def of_shapes(name: str) -> npt.NDArray[np.float32]:
            return np.array([getattr(found, name)[back] for found in rated], dtype=np.float32)

        def of_maps(name: str) -> FloatArray:
            return np.array([getattr(found, name) for found in rated], dtype=np.float64)

        ranked = rated[0].random is not None
        return SubsetFaithfulness(
            kept=of_shapes("kept"),
            false=of_shapes("false") if ranked else None,
            missing=of_shapes("missing") if ranked else None,
            trustworthiness=of_maps("trustworthiness") if ranked else None,
            continuity=of_maps("continuity") if ranked else None,
            stress=of_maps("stress"),
            random_stress=of_maps("random_stress"),
            chance=rated[0].chance,
            random=rated[0].random,
        )
