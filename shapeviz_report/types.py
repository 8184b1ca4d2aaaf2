"""The data that flows from stage to stage: frozen dataclasses, checked where they are made.

``Database`` of ``ShapeEntry`` -> ``Mesh`` -> per-vertex descriptors -> ``FeatureTable`` -> ``Projection``
-> ``Quality`` -> pages. A ``Failure`` travels beside them to the About page.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]


@dataclass(frozen=True)
class ShapeEntry:
    """One shape of a database: where its mesh is and what is known of it.

    Attributes
    ----------
    id : str
        Unique in the database: the path of the file below the database's root, ``/`` between folders,
        without its suffix (with it where two files differ by the suffix alone). Any Unicode text.
    path : Path
        The mesh file.
    name : str
        What people call it; need not be unique.
    labels : mapping of str to str
        Labeling -> class. A labeling that does not name this shape has no entry here.
    metadata : mapping of str to str
        Further columns of a table, as text, in the table's order.
    """

    id: str
    path: Path
    name: str
    labels: Mapping[str, str] = field(default_factory=dict)
    metadata: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Failure:
    """A file that did not make it: which, at which stage, and why, in words for its owner."""

    path: str
    stage: str
    reason: str


@dataclass(frozen=True)
class Database:
    """A shape database as it was read.

    Attributes
    ----------
    name : str
        Title of the database.
    root : Path
        The folder that ``ShapeEntry.id`` and ``Failure.path`` are relative to.
    layout : str
        Name of the reader that recognised it.
    shapes : tuple of ShapeEntry
        Sorted by id.
    labelings : tuple of str
        The labelings there are; the first is the one to use when none is chosen. Empty without labels.
    parents : mapping
        Labeling -> class -> parent class, for labelings with a hierarchy. A top class has no entry.
    failures : tuple of Failure
        Files that belong to the database but cannot be taken: unknown format, listed but missing.
    warnings : tuple of str
        What its owner should know although nothing failed.
    """

    name: str
    root: Path
    layout: str
    shapes: tuple[ShapeEntry, ...]
    labelings: tuple[str, ...] = ()
    parents: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    failures: tuple[Failure, ...] = ()
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Mesh:
    """A triangle mesh.

    Attributes
    ----------
    vertices : (n, 3) float64 array
        Positions; finite.
    faces : (m, 3) int32 array
        Vertex indices, counter-clockwise seen from outside.
    """

    vertices: FloatArray
    faces: IntArray


@dataclass(frozen=True)
class FeatureBlock:
    """The columns of one feature: ``dimensions`` histograms of ``bins`` bins, dimension by dimension.

    An external feature without histograms has ``bins == 1``.
    """

    name: str
    dimensions: int
    bins: int

    @property
    def width(self) -> int:
        """Number of columns."""
        return self.dimensions * self.bins

    @property
    def columns(self) -> tuple[str, ...]:
        """Names such as ``FPFH[14]:3`` (dimension from 0, bin from 1) or, in one dimension, ``Agd:6``."""
        places = [""] if self.dimensions == 1 else [f"[{d}]" for d in range(self.dimensions)]
        if self.bins == 1:
            return tuple(f"{self.name}{place}" for place in places)
        return tuple(f"{self.name}{place}:{b + 1}" for place in places for b in range(self.bins))


@dataclass(frozen=True)
class FeatureTable:
    """One row of feature values a shape.

    Attributes
    ----------
    shape_ids : tuple of str
        The shape of each row.
    blocks : tuple of FeatureBlock
        The features, in the order of their columns.
    values : (n, w) float64 array
        Finite; ``w`` is the sum of the blocks' widths.
    """

    shape_ids: tuple[str, ...]
    blocks: tuple[FeatureBlock, ...]
    values: FloatArray

    @property
    def columns(self) -> tuple[str, ...]:
        """The name of every column."""
        return tuple(column for block in self.blocks for column in block.columns)

    def slice_of(self, feature: str) -> slice:
        """The columns of one feature. Raises ``KeyError`` for a feature that is not there."""
        start = 0
        for block in self.blocks:
            if block.name == feature:
                return slice(start, start + block.width)
            start += block.width
        raise KeyError(feature)


@dataclass(frozen=True)
class Projection:
    """A map of the database.

    Attributes
    ----------
    method : str
        ``tsne``, ``umap`` or ``pca``.
    features : tuple of str
        The features it was made from.
    seed : int
    xy : (n, 2) float64 array
        One point a shape, in the order of the feature table. Centred, and scaled by one factor into [-1, 1]^2.
    """

    method: str
    features: tuple[str, ...]
    seed: int
    xy: FloatArray


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
    """

    k: int
    nh: FloatArray
    nh_c: Mapping[str, float]
    nh_s: float | None
    null_mean: float | None
    null_std: float | None


@dataclass(frozen=True)
class ShapeFacts:
    """What was measured of one prepared shape.

    Attributes
    ----------
    sha256 : str
        Of the mesh file's content.
    faces_read, vertices_read : int
        As the file has them.
    faces, vertices : int
        After remeshing.
    components : int
        Connected parts of the prepared mesh.
    watertight : bool
        Whether every edge of the cleaned mesh has two faces.
    repairs : mapping of str to int
        What was mended and how often, for instance ``{"duplicate faces removed": 4}``; empty if nothing was.
    deviation : float
        Largest distance found between the input surface and the prepared one, as a fraction of the
        bounding-box diagonal.
    """

    sha256: str
    faces_read: int
    vertices_read: int
    faces: int
    vertices: int
    components: int
    watertight: bool
    repairs: Mapping[str, int]
    deviation: float


@dataclass(frozen=True)
class Report:
    """All that a site shows: the input of the pages.

    ``shapes``, ``facts``, ``thumbnails``, ``labels``, the rows of ``features`` and of every projection and
    quality have the same order: that of ``shapes``, sorted by id.

    Attributes
    ----------
    labeling : str or None
        The active labeling; None for a database without labels.
    labels : tuple of (str or None)
        The active class of each shape.
    thumbnails : tuple of bytes
        One square WebP image with transparent background a shape.
    projections : mapping of str to (Projection, Quality)
        By method, in the order in which a reader should meet them.
    parameters : mapping of str to JSON value
        Every option of the build.
    versions : mapping of str to str
        Of this package, Python, and the libraries that shape the result.
    seconds, cpu_seconds : mapping of str to float
        Per stage, in order: wall-clock, and CPU of all processes.
    """

    database: Database
    shapes: tuple[ShapeEntry, ...]
    facts: tuple[ShapeFacts, ...]
    thumbnails: tuple[bytes, ...]
    labeling: str | None
    labels: tuple[str | None, ...]
    features: FeatureTable
    projections: Mapping[str, tuple[Projection, Quality]]
    failures: tuple[Failure, ...]
    parameters: Mapping[str, object]
    versions: Mapping[str, str]
    seconds: Mapping[str, float]
    cpu_seconds: Mapping[str, float]
