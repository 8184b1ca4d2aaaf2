"""What a search for features found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from shapeviz_report.types.arrays import FloatArray, IntArray


@dataclass(frozen=True)
class SubsetFaithfulness:
    """How far the map of every subset shows who is like whom by the features of that subset, without labels.

    Attributes
    ----------
    kept : (S, m) float32 array
        As in :class:`Faithfulness`.
    false, missing : (S, m) float32 array or None
    trustworthiness, continuity : (S,) float64 array or None
    stress, random_stress : (S,) float64 array
        NaN where all shapes are equal by these features.
    chance : float
        What a map at random keeps.
    random : float or None
        What trustworthiness and continuity are on a map at random.
    """

    kept: npt.NDArray[np.float32]
    false: npt.NDArray[np.float32] | None
    missing: npt.NDArray[np.float32] | None
    trustworthiness: FloatArray | None
    continuity: FloatArray | None
    stress: FloatArray
    random_stress: FloatArray
    chance: float
    random: float | None


@dataclass(frozen=True)
class SubsetScores:
    """One map for every subset of features that was evaluated, and how well it separates the classes.

    Attributes
    ----------
    members : (S, f) bool array
        Which features make each subset; no row is empty, none repeats. With all subsets, row i has the binary
        digits of i + 1, the first feature lowest.
    xy : (S, m, 2) float32 array
        The maps, as in :class:`Projection`, all turned towards that of all features.
    nh : (S, m) float32 array
        NH of each shape; NaN without a label.
    nh_s : (S,) float64 array
        NH_s; NaN for a database without labels.
    nh_c : (S, c) float64 array
        NH_c, in the order of ``FeatureSearch.classes``.
    cpu_seconds : (S,) float64 array
        What each map cost.
    faithfulness : SubsetFaithfulness or None
        None for one shape.
    """

    members: npt.NDArray[np.bool_]
    xy: npt.NDArray[np.float32]
    nh: npt.NDArray[np.float32]
    nh_s: FloatArray
    nh_c: FloatArray
    cpu_seconds: FloatArray
    faithfulness: SubsetFaithfulness | None


@dataclass(frozen=True)
class GreedyStep:
    """A place on the path of Algorithm 1: the best subset after one pass of its outer loop.

    Attributes
    ----------
    features : tuple of str
    changed : tuple of str
        The features that joined or left in this step.
    nh_s : float
    """

    features: tuple[str, ...]
    changed: tuple[str, ...]
    nh_s: float


@dataclass(frozen=True)
class GreedySearch:
    """One run of Algorithm 1 (paper, 4.2), accounted as if nothing had been computed before.

    Attributes
    ----------
    s : int
        How many features may change in a step.
    path : tuple of GreedyStep
        From the empty set on, which is left out, to the result; NH_s rises.
    runs : int
        Distinct subsets that it had to evaluate.
    considered : int
        The same with repetitions, as the paper counts.
    cpu_seconds : float
        Of the distinct ones.
    """

    s: int
    path: tuple[GreedyStep, ...]
    runs: int
    considered: int
    cpu_seconds: float


@dataclass(frozen=True)
class SearchRow:
    """A row of Table 2.

    Attributes
    ----------
    round : int
        From 1; each round has its own seed.
    method : str
        ``exhaustive`` or ``greedy``.
    s : int or None
        Of the greedy search.
    features : tuple of str
        The best subset found.
    nh_s, cpu_seconds : float
    runs : int
        Distinct maps.
    """

    round: int
    method: str
    s: int | None
    features: tuple[str, ...]
    nh_s: float
    cpu_seconds: float
    runs: int


@dataclass(frozen=True)
class SeedSpread:
    """How the NH_s of one subset varies from seed to seed.

    Attributes
    ----------
    features : tuple of str
    nh_s : (seeds,) float64 array
    mean, std : float
        Of ``nh_s``; the sample's standard deviation.
    behind : float
        How far the mean lies below the best one's; 0 for the best itself.
    margin : float
        Half the 95 % interval of ``behind``, paired by shape.
    told_apart : bool
        Whether ``behind`` exceeds ``margin``. If not, this subset may be as good as the best.
    """

    features: tuple[str, ...]
    nh_s: FloatArray
    mean: float
    std: float
    behind: float
    margin: float
    told_apart: bool


@dataclass(frozen=True)
class Gain:
    """What choosing by labels gains on shapes whose labels had no part in it, against not choosing.

    Attributes
    ----------
    mean : float
        NH_s of held-out shapes on the chosen map less that on the map of all features, each shape counted once a deal.
    spread : float or None
        The standard deviation that this figure has if a database is dealt into folds only once: the larger of that
        over deals, and of that over folds divided by the root of their number in a deal. None for a single fold.
    deals : int
    """

    mean: float
    spread: float | None
    deals: int

    @property
    def is_sure(self) -> bool:
        """Whether the mean lies farther from 0 than its spread."""
        return self.spread is not None and abs(self.mean) > self.spread


@dataclass(frozen=True)
class HeldOutFold:
    """Choosing a subset without the labels of some shapes, then scoring it on these.

    Attributes
    ----------
    deal : int
        From 1: each deals the shapes into folds anew.
    seed : int
        Of the maps.
    features : tuple of str
        The subset that the labels of the other shapes choose.
    shapes : int
        Number held out.
    nh_s_seen : float
        What the choice went by: NH_s of the other shapes, counting only neighbours that are not held out.
    nh_s : float
        NH_s of the held-out shapes on the chosen map.
    nh_s_all : float
        NH_s of the same shapes on the map of all features.
    nh_max : float
        What NH_s of these shapes cannot exceed on any map.
    nh_s_distinct, nh_s_all_distinct : float or None
        ``nh_s`` and ``nh_s_all`` where one shape of each group of copies stands for all of it, as neighbour too; None
        where there are no copies.
    """

    deal: int
    seed: int
    features: tuple[str, ...]
    shapes: int
    nh_s_seen: float
    nh_s: float
    nh_s_all: float
    nh_max: float
    nh_s_distinct: float | None = None
    nh_s_all_distinct: float | None = None


@dataclass(frozen=True)
class FeatureEffect:
    """What a feature adds or spoils.

    Attributes
    ----------
    feature : str
    alone : float
        NH_s of the map of this feature only.
    mean_with, mean_without : float or None
        Mean NH_s over all subsets with it and without it. Where not all were evaluated, NH_s of all features, and of
        all but this one. None for the only feature.
    added : float or None
        Mean change of NH_s when it joins a subset, or all others; negative if it spoils. None for the only feature.
    """

    feature: str
    alone: float
    mean_with: float | None
    mean_without: float | None
    added: float | None


@dataclass(frozen=True)
class FeatureSearch:
    """The search for the subset of features whose map separates the classes best (paper, 4.1 and 4.2).

    Attributes
    ----------
    method : str
        The name of the projection.
    seed : int
        Of the maps in ``subsets``; round r of Table 2 has ``seed + r - 1``.
    k : int
        Of the neighbourhood hit.
    features : tuple of str
        Columns of ``subsets.members``.
    classes : tuple of str
        Columns of ``subsets.nh_c``, in natural order.
    rows : (m,) int32 array
        The shapes that took part, as rising rows of the feature table.
    shape_count : int
        Of the table. More than ``m`` if the search went over a sample.
    subsets : SubsetScores
    exhaustive : bool
        Whether ``subsets`` holds all of them.
    refusal : str or None
        Why not, in words.
    greedy : tuple of GreedySearch
        On the first seed, by rising ``s``. Empty without labels, as all that follows.
    table : tuple of SearchRow
        Table 2.
    spread : tuple of SeedSpread
        Of the best subsets and of all features, by falling mean.
    held_out : tuple of HeldOutFold
    null_best : FloatArray
        The best NH_s that the same search finds for labels dealt out at random, sorted.
    effects : tuple of FeatureEffect
        In the order of ``features``.
    """

    method: str
    seed: int
    k: int
    features: tuple[str, ...]
    classes: tuple[str, ...]
    rows: IntArray
    shape_count: int
    subsets: SubsetScores
    exhaustive: bool
    refusal: str | None
    greedy: tuple[GreedySearch, ...]
    table: tuple[SearchRow, ...]
    spread: tuple[SeedSpread, ...]
    held_out: tuple[HeldOutFold, ...]
    null_best: FloatArray
    effects: tuple[FeatureEffect, ...]

    @property
    def best(self) -> tuple[str, ...] | None:
        """The features of the best subset; None without labels."""
        if np.isnan(self.subsets.nh_s).any():
            return None
        has = self.subsets.members[int(self.subsets.nh_s.argmax())]
        return tuple(name for name, one in zip(self.features, has, strict=True) if one)
