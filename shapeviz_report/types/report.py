"""All that a site shows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from shapeviz_report.types.arrays import FloatArray
from shapeviz_report.types.bins import BinScores, BinSearch, Painting
from shapeviz_report.types.clusters import Clusters
from shapeviz_report.types.copies import Copy, WithoutCopies
from shapeviz_report.types.database import Database, Failure, ShapeEntry
from shapeviz_report.types.features import FeatureTable
from shapeviz_report.types.maps import Projection, Quality
from shapeviz_report.types.mesh import ShapeFacts
from shapeviz_report.types.publication import Publication
from shapeviz_report.types.retrieval import Retrieval
from shapeviz_report.types.search import FeatureSearch


@dataclass(frozen=True)
class Report:
    """All that a site shows: the input of the pages.

    ``shapes``, ``facts``, ``thumbnails``, ``labels``, the rows of ``features`` and of every projection and
    quality have the same order: that of ``shapes``, in natural order of ids.

    Attributes
    ----------
    labeling : str or None
        The active labeling; ``clusters`` where these stand in for labels; None with neither.
    labels : tuple of (str or None)
        The active class of each shape.
    thumbnails : tuple of bytes
        One square WebP image with transparent background a shape.
    edges : (d, 11) float64 array
        The bin edges of every dimension of the features that are histograms, in the order of the table; external
        features have none.
    projections : mapping of str to (Projection, Quality)
        By method, in the order in which a reader should meet them.
    parameters : mapping of str to JSON value
        Every option of the build.
    versions : mapping of str to str
        Of this package, Python, and the libraries that shape the result.
    seconds, cpu_seconds : mapping of str to float
        Per stage, in order: wall-clock, and CPU of all processes.
    search : FeatureSearch or None
        None if it was left out.
    scores : BinScores or None
        None where fewer than two classes have a shape.
    bins : BinSearch or None
        None if the search was left out, or where fewer than two classes have two shapes.
    retrieval : Retrieval or None
        None where no class has two shapes.
    paintings : tuple of Painting
        Of the bins that ``bins`` found, on shapes that show the contrast; those of external features have none.
    models : tuple of bytes, or None
        The 3D model of each shape as :func:`shapeviz_report.models.pack_model` packs it, gzipped. None if they were
        left out.
    clusters : Clusters or None
        None where there are too few shapes.
    publication : Publication
        What the owner says of the database.
    copies : tuple of Copy
        Pairs of shapes that are the same shape again, in the order of the shapes.
    without_copies : WithoutCopies or None
        None where there are no copies.
    """

    database: Database
    shapes: tuple[ShapeEntry, ...]
    facts: tuple[ShapeFacts, ...]
    thumbnails: tuple[bytes, ...]
    labeling: str | None
    labels: tuple[str | None, ...]
    features: FeatureTable
    edges: FloatArray
    projections: Mapping[str, tuple[Projection, Quality]]
    failures: tuple[Failure, ...]
    parameters: Mapping[str, object]
    versions: Mapping[str, str]
    seconds: Mapping[str, float]
    cpu_seconds: Mapping[str, float]
    search: FeatureSearch | None = None
    scores: BinScores | None = None
    bins: BinSearch | None = None
    retrieval: Retrieval | None = None
    paintings: tuple[Painting, ...] = ()
    models: tuple[bytes, ...] | None = None
    clusters: Clusters | None = None
    publication: Publication = Publication()
    copies: tuple[Copy, ...] = ()
    without_copies: WithoutCopies | None = None
