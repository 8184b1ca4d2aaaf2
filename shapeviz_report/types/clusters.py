"""Groups of shapes that the features alone make."""

from __future__ import annotations

from dataclasses import dataclass

from shapeviz_report.types.arrays import IntArray


@dataclass(frozen=True)
class Cluster:
    """Shapes that are more like each other than like the rest.

    Attributes
    ----------
    name : str
        After its most central shape, such as ``like stool``; unique among the clusters.
    central : int
        The most central shape, as a row of the feature table.
    size : int
        Number of shapes.
    typical : tuple of str
        What tells the cluster from the rest, in sentences, the most typical first.
    """

    name: str
    central: int
    size: int
    typical: tuple[str, ...]


@dataclass(frozen=True)
class Clusters:
    """All shapes of a database in groups that no label had a say in.

    Attributes
    ----------
    clusters : tuple of Cluster
        By falling size.
    of : (n,) int32 array
        The cluster of each shape, in the order of the feature table, as a place in ``clusters``.
    silhouette : float
        How much closer shapes are to their own cluster than to the next, in [-1, 1]: the mean over the shapes that
        decided the clusters.
    steadiness : float
        Whether a part of the shapes has the same clusters: the mean adjusted Rand index, 1 where they are found again
        and about 0 where the cuts are made at will.
    stand_in : bool
        Whether the clusters are the active labeling, because the database has no labels.
    """

    clusters: tuple[Cluster, ...]
    of: IntArray
    silhouette: float
    steadiness: float
    stand_in: bool
