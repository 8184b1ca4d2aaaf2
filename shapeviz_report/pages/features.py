"""The Features page: which features separate the classes (paper, 4.1 and 4.2; Fig. 3, Fig. 4 and Table 2), and how
well they find similar shapes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from shapeviz_report import charts, quality
from shapeviz_report.descriptors import DESCRIPTORS
from shapeviz_report.pages.base import (
    COORDINATE_STEPS,
    METHODS,
    PageContent,
    change,
    class_names,
    coordinate_steps,
    distinct_means,
    feature_marks,
    is_search_sampled,
    nothing_told,
    rounded,
    search_of,
    share_steps,
)
from shapeviz_report.pages.chunks import Box, Chunks, Search, SubsetFaith, SubsetMaps, SubsetNeighbours
from shapeviz_report.pages.fields import color_choices
from shapeviz_report.pages.retrieval import retrieval_chunk, retrieval_context
from shapeviz_report.pages.separation import separation_context
from shapeviz_report.search.certainty import measure_gain
from shapeviz_report.types import (
    FeatureEffect,
    FeatureSearch,
    FloatArray,
    HeldOutFold,
    HitRange,
    Report,
    SeedSpread,
    SubsetFaithfulness,
)

#: Decimals of NH_s and NH_c.
SCORE_DECIMALS = 6

#: A mean change of NH_s that a reader would not call help or harm.
NEGLIGIBLE = 0.005


class FeaturesPage:
    """All subsets of features with what they reach, their maps, and how sure that is."""

    name = "features"
    title = "Features"
    file = "features.html"
    within = None

    def content(self, report: Report) -> PageContent:
        context: dict[str, object] = {
            "search": None,
            "retrieval": None,
            "separation": separation_context(report),
        }
        chunks: Chunks = {}
        if report.retrieval is not None:
            context["retrieval"] = retrieval_context(report, report.retrieval)
            chunks["retrieval"] = retrieval_chunk(report, report.retrieval)
        search = search_of(report)
        if search is not None:
            ranking = Ranking.of(search)
            context |= {"search": _context(report, search, ranking), "colors": color_choices(report)}
            chunks |= {"search": _scores(report, search, ranking), "subsets": _maps(search, ranking)}
            if search.subsets.faithfulness is not None:
                chunks["faith"] = _neighbours(search.subsets.faithfulness, ranking)
        return PageContent(context, chunks)


@dataclass(frozen=True)
class Ranking:
    """The evaluated subsets from best to worst; in the order of the search where there are no labels.

    Attributes
    ----------
    order : tuple of int
        Row of ``FeatureSearch.subsets`` for each place.
    codes : tuple of str
        The members of the subset at each place: a ``1`` or ``0`` a feature.
    """

    order: tuple[int, ...]
    codes: tuple[str, ...]

    @classmethod
    def of(cls, search: FeatureSearch) -> Ranking:
        scores = search.subsets.nh_s
        order = range(len(scores)) if np.isnan(scores).any() else np.argsort(-scores, kind="stable").tolist()
        codes = ["".join("1" if has else "0" for has in search.subsets.members[row]) for row in order]
        return cls(tuple(order), tuple(codes))

    def place(self, search: FeatureSearch, features: tuple[str, ...]) -> int:
        """Where a subset stands, from 0."""
        return self.codes.index("".join("1" if name in features else "0" for name in search.features))


def _scores(report: Report, search: FeatureSearch, ranking: Ranking) -> Search:
    """All but the maps. No times: they differ from build to build."""
    from shapeviz_report.charts import specs

    number = {name: index for index, name in enumerate(class_names(report))}
    rows = list(ranking.order)
    paper = _of_paper(search)
    return {
        "method": search.method,
        "methodTitle": METHODS[search.method].title,
        "note": METHODS[search.method].explanation,
        "neighbours": search.k,
        "features": list(search.features),
        "paper": paper,
        "hues": list(charts.feature_color_indices(len(search.features))),
        # By falling effect: what helps most stands on top of the matrix.
        "order": _by_effect(search),
        "classes": [number[name] for name in search.classes],
        "rows": search.rows.tolist() if is_search_sampled(report) else None,
        "members": list(ranking.codes),
        "hit": rounded(search.subsets.nh_s[rows], SCORE_DECIMALS),
        "hitOfClass": [rounded(values, SCORE_DECIMALS) for values in search.subsets.nh_c[rows]],
        "faith": _faith(search.subsets.faithfulness, rows),
        "boxes": _boxes(search.subsets.nh_c),
        "boxesOfPaper": _boxes(search.subsets.nh_c[_within(search, paper)]) if paper else None,
        "chance": _chance(report, search),
        "highest": _range(report, search).highest,
        "chanceBest": float(np.median(search.null_best)) if len(search.null_best) else None,
        "greedy": [
            {
                "s": greedy.s,
                "runs": greedy.runs,
                "path": [ranking.place(search, step.features) for step in greedy.path],
            }
            for greedy in search.greedy
        ],
        "effects": [
            {
                "feature": search.features.index(effect.feature),
                "alone": effect.alone,
                "with": _joined(effect),
                "without": effect.mean_without,
            }
            for effect in search.effects
        ],
        "spread": [
            {
                "place": ranking.place(search, spread.features),
                "hits": rounded(spread.nh_s, SCORE_DECIMALS),
                "mean": spread.mean,
                "margin": spread.margin,
                "apart": spread.told_apart,
            }
            for spread in search.spread
        ],
        "charts": {
            "bars": specs.spec_of(specs.subset_bars),
            "matrix": specs.spec_of(specs.feature_matrix),
            "boxes": specs.spec_of(specs.class_boxes),
            "effects": specs.spec_of(specs.effect_dots),
            "seeds": specs.spec_of(specs.seed_dots),
        },
        "marks": feature_marks(),
    }


def _maps(search: FeatureSearch, ranking: Ranking) -> SubsetMaps:
    """The maps and the hits on them in whole numbers: the largest part of the site, loaded when one is wanted."""
    rows = list(ranking.order)
    steps = coordinate_steps(search.subsets.xy[rows])
    return {
        "steps": COORDINATE_STEPS,
        "x": list(steps[:, :, 0]),
        "y": list(steps[:, :, 1]),
        "hit": list(share_steps(search.subsets.nh[rows])),
    }


def _faith(found: SubsetFaithfulness | None, rows: list[int]) -> SubsetFaith | None:
    if found is None:
        return None

    def of_maps(values: FloatArray | None) -> list[float | None] | None:
        return None if values is None else rounded(values[rows], SCORE_DECIMALS)

    return {
        "mean": rounded(found.kept[rows].mean(axis=1, dtype=np.float64), SCORE_DECIMALS),
        "chance": found.chance,
        "trustworthiness": of_maps(found.trustworthiness),
        "continuity": of_maps(found.continuity),
        "random": found.random,
        "stress": rounded(found.stress[rows], SCORE_DECIMALS),
        "randomStress": rounded(found.random_stress[rows], SCORE_DECIMALS),
    }


def _neighbours(found: SubsetFaithfulness, ranking: Ranking) -> SubsetNeighbours:
    """Of every shape on every map, in whole numbers; loaded when a map is coloured by it."""
    rows = list(ranking.order)

    def steps(values: npt.NDArray[np.float32]) -> list[npt.NDArray[np.uint16]]:
        return list(share_steps(values[rows]))

    return {
        "kept": steps(found.kept),
        "false": None if found.false is None else steps(found.false),
        "missing": None if found.missing is None else steps(found.missing),
    }


def _by_effect(search: FeatureSearch) -> list[int]:
    """The features as their indices, those that help most first; as they come where nothing is known."""
    effects = {effect.feature: effect for effect in search.effects}

    def weight(index: int) -> float:
        effect = effects.get(search.features[index])
        if effect is None:
            return 0.0
        return effect.alone if effect.added is None else effect.added

    return sorted(range(len(search.features)), key=lambda index: -weight(index))


def _of_paper(search: FeatureSearch) -> list[int] | None:
    """Those of the paper's Table 1 by their indices; None if there are no others, or not all of their subsets."""
    names = {descriptor.name for descriptor in DESCRIPTORS}
    paper = [index for index, name in enumerate(search.features) if name in names]
    complete = np.count_nonzero(_within(search, paper)) == 2 ** len(paper) - 1
    return paper if 1 < len(paper) < len(search.features) and complete else None


def _within(search: FeatureSearch, features: list[int]) -> npt.NDArray[np.bool_]:
    """Which of the subsets have no other features."""
    return np.delete(search.subsets.members, features, axis=1).sum(axis=1) == 0


def _boxes(nh_c: FloatArray) -> list[Box]:
    """The spread of NH_c over all subsets, a box a class."""
    if np.isnan(nh_c).any():
        return []
    parts = np.quantile(nh_c, [0, 0.25, 0.5, 0.75, 1], axis=0)
    boxes: list[Box] = []
    for column in parts.T:
        least, lower, median, upper, most = rounded(column, SCORE_DECIMALS)
        boxes.append({"least": least, "lower": lower, "median": median, "upper": upper, "most": most})
    return boxes


def _range(report: Report, search: FeatureSearch) -> HitRange:
    """What NH can be on its maps."""
    return quality.hit_range([report.labels[row] for row in search.rows], search.k)


def _chance(report: Report, search: FeatureSearch) -> float | None:
    """What random labels reach on a map: on average the same on all."""
    labels = [report.labels[row] for row in search.rows]
    everything = search.subsets.members.all(axis=1)
    return quality.score(search.subsets.xy[everything][0].astype(float), labels, k=search.k).null_mean


def _context(report: Report, search: FeatureSearch, ranking: Ranking) -> dict[str, object]:
    """What the template says in words and tables."""
    bins = next(iter(report.projections.values()))[0].bins
    labelled = bool(search.effects)
    paper = _of_paper(search)
    return {
        "method": METHODS[search.method].title,
        "features": search.features,
        "bins": None if bins is None else len(bins),
        "subsets": len(ranking.order),
        "exhaustive": search.exhaustive,
        "paper": None if paper is None else {"features": len(paper), "subsets": 2 ** len(paper) - 1},
        "refusal": search.refusal,
        "shapes": len(search.rows),
        "shape_count": search.shape_count,
        "labelled": labelled,
        "nothing": nothing_told(report, search.k),
        "measured": labelled or search.subsets.faithfulness is not None,
        "neighbours": search.k,
        "highest": _range(report, search).highest,
        "greedy": [greedy.s for greedy in search.greedy],
        "effects": _effects(search),
        "spread": _spread(search.spread, search.features) if search.spread else None,
        "held_out": _held_out(search.held_out) if search.held_out else None,
        "chance": _range(report, search).chance,
        "without_copies": report.without_copies,
        "chance_best": _chance_best(search) if len(search.null_best) else None,
        "table": search.table,
    }


def _effects(search: FeatureSearch) -> list[dict[str, object]]:
    """What each feature does, those that help most first."""
    if not search.effects:
        return []
    rows = []
    for index in _by_effect(search):
        effect = next(effect for effect in search.effects if effect.feature == search.features[index])
        joined, added, verdict = _joined(effect), None, None
        if joined is not None and effect.mean_without is not None:
            added = change(effect.mean_without, joined)
            verdict = "hardly matters" if abs(added) < NEGLIGIBLE else "helps" if added > 0 else "spoils"
        rows.append(
            {
                "feature": effect.feature,
                "hue": charts.feature_color_indices(index + 1)[-1],
                "verdict": verdict,
                "alone": effect.alone,
                "with": joined,
                "without": effect.mean_without,
                "added": added,
            }
        )
    return rows


def _joined(effect: FeatureEffect) -> float | None:
    """What the maps without a feature reach once it has joined them, so that its map alone is not among them."""
    if effect.added is None or effect.mean_without is None:
        return effect.mean_with
    return effect.mean_without + effect.added


def _spread(spread: tuple[SeedSpread, ...], features: tuple[str, ...]) -> dict[str, object]:
    """How many of the best are as good as the best, which of them is the smallest, and whether all features are."""
    similar = [row for row in spread if not row.told_apart]
    return {
        "rows": spread,
        "seeds": len(spread[0].nh_s),
        "similar": len(similar),
        "smallest": min(similar, key=lambda row: len(row.features)),
        "everything": next(row for row in spread if row.features == features),
    }


def _held_out(folds: tuple[HeldOutFold, ...]) -> dict[str, object]:
    """The deals, and their means with each shape counted once a deal."""
    deals = []
    for number in sorted({fold.deal for fold in folds}):
        own = [fold for fold in folds if fold.deal == number]
        picked = Counter(fold.features for fold in own).most_common()
        deals.append(
            {"number": number, "seed": own[0].seed, "folds": len(own), "picked": picked, **_means(own)}
        )
    return {
        "deals": deals,
        **_means(folds),
        "gain": measure_gain(folds),
        "distinct": distinct_means(folds),
    }


def _means(folds: Sequence[HeldOutFold]) -> dict[str, float]:
    shapes = [fold.shapes for fold in folds]
    return {
        "nh_s": float(np.average([fold.nh_s for fold in folds], weights=shapes)),
        "all": float(np.average([fold.nh_s_all for fold in folds], weights=shapes)),
    }


def _chance_best(search: FeatureSearch) -> dict[str, float]:
    return {
        "median": float(np.median(search.null_best)),
        "high": float(np.quantile(search.null_best, 0.95)),
    }
