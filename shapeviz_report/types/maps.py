"""Maps of the database, and how well they keep classes together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from shapeviz_report.types.arrays import FloatArray, Int64Array


@dataclass(frozen=True)
class Projection:
    """A map of the database.

    Attributes
    ----------
    method : str
        The name of a projection, or of a file of coordinates that were brought along.
    features : tuple of str
        The features it was made from; none where it was brought along.
    seed : int
    xy : (n, 2) float64 array
        One point a shape, in the order of the feature table. Centred, and scaled by one factor into [-1, 1]^2.
    bins : tuple of str or None
        The bins it was made from; None for all bins of its features.
    brought : bool
        Whether its coordinates were brought along.
    """

    method: str
    features: tuple[str, ...]
    seed: int
    xy: FloatArray
    bins: tuple[str, ...] | None = None
    brought: bool = False


@dataclass(frozen=True)
class HitRange:
    """What neighbourhood hit can be for classes of these sizes: from what chance gives to what no map exceeds.

    Of a shape of a class of n at most min(k, n - 1) of its k neighbours are of its class, so that NH ends below 1 where
    classes have k shapes or fewer. On a map of m shapes chance gives it (n - 1) / (m - 1) on average.

    Attributes
    ----------
    highest_of_class, chance_of_class : mapping of str to float
        Of NH_c, and of NH of every shape of the class; classes by name.
    highest, chance : float or None
        Of NH_s: the means over the labelled shapes. None without labels or neighbours.
    """

    highest_of_class: Mapping[str, float]
    chance_of_class: Mapping[str, float]
    highest: float | None
    chance: float | None

    @property
    def tells(self) -> bool:
        """Whether maps can differ in NH at all: not where all shapes are of one class, each is alone in its own, or k
        neighbours are all others."""
        return (
            self.highest is not None
            and self.chance is not None
            and len(self.highest_of_class) > 1
            and self.highest - self.chance > 1e-9
        )


@dataclass(frozen=True)
class Shepard:
    """A Shepard diagram: distances on a map against those in the features, both in units of the largest of the latter.

    Distances on the map are scaled as the stress has it: those in proportion lie on the diagonal.

    Attributes
    ----------
    pairs : (c, c) int array
        How many pairs fall into each cell: columns of equal width from 0 to 1 in the features, in each of them cells
        from 0 to ``height`` on the map.
    fit : (c,) float64 array
        Of each column, the mean of the monotone regression (Kruskal 1964) of its pairs; NaN without any.
    height : float
        The largest distance on the map.
    """

    pairs: Int64Array
    fit: FloatArray
    height: float


@dataclass(frozen=True)
class Faithfulness:
    """How far a map shows who is like whom; needs no labels.

    :func:`shapeviz_report.faithfulness.rate_maps` has the equations.

    Attributes
    ----------
    k : int
        Number of neighbours.
    kept : (n,) float64 array
        Of the k shapes nearest by the features, the share that is among the k nearest on the map; in [0, 1].
    chance : float
        What a map at random keeps.
    false : (n,) float64 array or None
        How far those near a shape on the map are from being so by the features: 0 where all are, 1 where they are the
        farthest of all. None where k is half of the shapes or more.
    missing : (n,) float64 array or None
        How far those near a shape by the features are from being so on the map, likewise.
    trustworthiness, continuity : float or None
        1 less the means of ``false`` and ``missing``.
    random : float or None
        What both are on a map at random.
    stress : float or None
        How far distances on the map are out of proportion to those in the features: from 0, in proportion, to 1. None
        where all shapes are equal.
    random_stress : float or None
        That of shapes dealt out anew over the places of the map.
    shepard : Shepard or None
        None where it was not asked for, or has nothing to show.
    """

    k: int
    kept: FloatArray
    chance: float
    false: FloatArray | None
    missing: FloatArray | None
    trustworthiness: float | None
    continuity: float | None
    random: float | None
    stress: float | None
    random_stress: float | None
    shepard: Shepard | None = None


@dataclass(frozen=True)
class Quality:
    """Neighbourhood hit of a projection (paper, Eq. 7 and 8), in [0, 1], higher is better separated.

    Attributes
    ----------
    k : int
        Number of neighbours; at most the number of shapes less one.
    nh : (n,) float64 array
        Per shape; NaN where the shape has no label or no neighbour.
    nh_c : mapping of str to float
        Per class, by falling value, then by name. Empty without labels.
    nh_s : float or None
        Of the whole database; None without labels.
    null_mean, null_std : float or None
        What random labels with the same class sizes reach on the same map.
    range : HitRange
        What these can be for classes of these sizes.
    """

    k: int
    nh: FloatArray
    nh_c: Mapping[str, float]
    nh_s: float | None
    null_mean: float | None
    null_std: float | None
    range: HitRange
