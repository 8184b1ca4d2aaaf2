"""All that a site shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from shapeviz_report.order import classes_of, natural
from shapeviz_report.types.arrays import FloatArray, IntArray
from shapeviz_report.types.bins import BinScores, BinSearch, Painting
from shapeviz_report.types.clusters import Clusters
from shapeviz_report.types.copies import Copy, WithoutCopies
from shapeviz_report.types.database import Database, Failure, ShapeEntry
from shapeviz_report.types.features import FeatureTable
from shapeviz_report.types.maps import Faithfulness, Projection, Quality
from shapeviz_report.types.mesh import ShapeFacts
from shapeviz_report.types.publication import Publication
from shapeviz_report.types.retrieval import Retrieval
from shapeviz_report.types.search import FeatureSearch
from shapeviz_report.types.separation import Separation


@dataclass(frozen=True)
class Exported:
    """Each shape as a file of binary glTF.

    Attributes
    ----------
    names : tuple of str
        By what is in them, with suffix: copies of a shape may share one.
    contents : sequence of bytes
    """

    names: tuple[str, ...]
    contents: Sequence[bytes]


@dataclass(frozen=True, repr=False)
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
    models : sequence of bytes, or None
        The 3D model of each shape as :func:`shapeviz_report.models.pack_model` packs it, gzipped. None if they were
        left out.
    exported : Exported or None
        None if files of shapes were not asked for.
    clusters : Clusters or None
        None where there are too few shapes.
    publication : Publication
        What the owner says of the database.
    copies : tuple of Copy
        Pairs of shapes that are the same shape again, in the order of the shapes.
    without_copies : WithoutCopies or None
        None where there are no copies.
    faithfulness : mapping of str to Faithfulness
        By projection; empty for one shape.
    related : (n, m) int32 array, or None
        The shapes most similar to each by distances that know their neighbourhood, the most similar first; None where
        there are too many for these.
    separation : Separation or None
        None where there are not two classes, or none of two shapes.
    best : tuple of Projection, Quality and Faithfulness, or None
        The map of all shapes by the best subset of the features, where the search laid out a sample of them.
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
    models: Sequence[bytes] | None = None
    exported: Exported | None = None
    clusters: Clusters | None = None
    publication: Publication = Publication()
    copies: tuple[Copy, ...] = ()
    without_copies: WithoutCopies | None = None
    faithfulness: Mapping[str, Faithfulness] = field(default_factory=dict)
    related: IntArray | None = None
    separation: Separation | None = None
    best: tuple[Projection, Quality, Faithfulness] | None = None

    def __repr__(self) -> str:
        """In a line: pictures and models alone are megabytes."""
        shapes, classes = len(self.shapes), len(classes_of(self.labels))
        return f"<Report of {self.database.name!r}: {shapes:,} shapes, {classes:,} classes>"

    def __post_init__(self) -> None:
        """Check what templates and scripts take for granted; a ``ValueError`` is an error of the caller."""
        count, columns = len(self.shapes), self.features.columns
        ids = tuple(shape.id for shape in self.shapes)
        _require(count > 0, "no shape")
        _require(len(set(ids)) == count, "two shapes share an id")
        _require(list(ids) == sorted(ids, key=natural), "shapes are not sorted by id")
        _require(ids == self.features.shape_ids, "feature rows are not those of the shapes")
        _require(self.features.values.shape == (count, len(columns)), "feature table of another size")
        _require(bool(np.isfinite(self.features.values).all()), "a feature is not finite")
        dimensions = sum(block.dimensions for block in self.features.blocks if block.bins > 1)
        _require(self.edges.shape == (dimensions, 11), "edges do not match the features")
        for name in ("facts", "thumbnails", "labels"):
            _require(len(getattr(self, name)) == count, f"{name} do not match the shapes")
        _require(all(map(_is_webp, self.thumbnails)), "a thumbnail is not a WebP image")
        _require(self.labeling is not None or not any(self.labels), "labels without a labeling")
        _require(bool(self.projections), "no projection")
        for method, (projection, quality) in self.projections.items():
            _require(
                method.isidentifier() and method == projection.method, f"projection {method!r} is misnamed"
            )
            _require(projection.xy.shape == (count, 2), f"projection {method} has another number of points")
            _require(
                bool(np.isfinite(projection.xy).all()), f"projection {method} has a point that is not finite"
            )
            _require(quality.nh.shape == (count,), f"quality of {method} has another number of shapes")
        if self.scores is not None:
            classes = classes_of(self.labels)
            _require(self.scores.classes == classes, "scores do not match the classes")
            size = (len(self.scores.methods), len(classes), len(columns))
            _require(self.scores.values.shape == size, "scores of another size")
            held = (self.scores.values >= 0) & (self.scores.values <= 1)
            _require(bool(held.all()), "a score is not in [0, 1]")
        for painting in self.paintings:
            _require(painting.column in columns, "a painting of a bin that is not there")
            _require(0 <= painting.shape < count, "a painting of a shape that is not there")
            _require(_is_webp(painting.value) and _is_webp(painting.inside), "a painting is not a WebP image")
        if self.models is not None:
            _require(len(self.models) == count, "models do not match the shapes")
        if self.exported is not None:
            lengths = {len(self.exported.names), len(self.exported.contents)}
            _require(lengths == {count}, "exported shapes do not match the shapes")
        if self.best is not None:
            _require(self.best[0].xy.shape == (count, 2), "the best map has another number of points")
        if self.related is not None:
            _require(len(self.related) == count, "related shapes of another number of shapes")
        if self.clusters is not None:
            found = self.clusters
            _require(found.of.shape == (count,), "clusters do not match the shapes")
            sizes = np.bincount(found.of, minlength=len(found.clusters)).tolist()
            _require(sizes == [cluster.size for cluster in found.clusters], "a cluster of another size")
            for number, cluster in enumerate(found.clusters):
                _require(found.of[cluster.central] == number, "the centre of a cluster is not in it")
            names = [found.clusters[number].name for number in found.of]
            _require(not found.stand_in or list(self.labels) == names, "labels are not the clusters")


def _require(holds: bool, what: str) -> None:
    if not holds:
        raise ValueError(f"inconsistent report: {what}")


def _is_webp(picture: bytes) -> bool:
    return picture[:4] == b"RIFF" and picture[8:12] == b"WEBP"
