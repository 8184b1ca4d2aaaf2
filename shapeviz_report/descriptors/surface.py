"""What descriptors share of a mesh, computed once and when first asked for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from shapeviz_report.descriptors.kernels.angles import gather_angles
from shapeviz_report.descriptors.kernels.boxes import along_curve
from shapeviz_report.descriptors.kernels.geodesics import shorten
from shapeviz_report.descriptors.kernels.grid import find_nearest
from shapeviz_report.types import FloatArray, IntArray, Mesh

NEIGHBOURS = 30
"""k of the paper's nearest neighbours (3.3)."""

SAME_LENGTH = 1e-6
"""Gaps that differ by less than this are equally wide."""

CELLS = 64
"""Parts that a surface is cut into; as many as vertices, where there are fewer."""


@dataclass(frozen=True)
class Cells:
    """A surface cut into parts of about equal size.

    Attributes
    ----------
    centres : (c,) int32 array
        The vertex in the middle of each cell.
    owners : (n,) int32 array
        The cell of each vertex: that of the nearest centre, along edges.
    distances : (n,) float64 array
        How far that is.
    """

    centres: IntArray
    owners: IntArray
    distances: FloatArray


class Surface:
    """A prepared mesh with the geometry that several descriptors need.

    Parameters
    ----------
    mesh : Mesh
        As :func:`shapeviz_report.mesh.prepare` returns it: finite, manifold, in the unit ball.
    """

    def __init__(self, mesh: Mesh) -> None:
        self.vertices: FloatArray = np.ascontiguousarray(mesh.vertices, dtype=np.float64)
        self.faces: IntArray = np.ascontiguousarray(mesh.faces, dtype=np.int32)

    @cached_property
    def _angles(self) -> tuple[FloatArray, FloatArray]:
        return gather_angles(self.vertices, self.faces)

    @property
    def angle_sums(self) -> FloatArray:
        """(n,) sum of the corner angles at each vertex, in radians."""
        return self._angles[0]

    @property
    def normals(self) -> FloatArray:
        """(n, 3) unit vertex normals, outward: face normals weighted by corner angle (Eq. 3)."""
        return self._angles[1]

    @cached_property
    def areas(self) -> FloatArray:
        """(n,) area of each vertex: a third of that of its faces."""
        a, b, c = (self.vertices[self.faces[:, i]] for i in range(3))
        third = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
        return np.bincount(self.faces.ravel(), np.repeat(third, 3), len(self.vertices))

    @cached_property
    def edges(self) -> IntArray:
        """(e, 2) distinct edges, each with its lower vertex first."""
        faces = self.faces.astype(np.int64)
        pairs = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        keys, counts = np.unique(pairs[:, 0] * len(self.vertices) + pairs[:, 1], return_counts=True)
        self._edge_faces = counts
        return np.stack(np.divmod(keys, len(self.vertices)), axis=1).astype(np.int32)

    @cached_property
    def on_boundary(self) -> np.ndarray:
        """(n,) bool: whether a vertex lies on an edge with one face."""
        edges = self.edges
        flags = np.zeros(len(self.vertices), dtype=bool)
        flags[edges[self._edge_faces == 1]] = True
        return flags

    @cached_property
    def _nearest(self) -> tuple[FloatArray, IntArray]:
        count = len(self.vertices)
        wanted = min(NEIGHBOURS, count - 1)
        low = self.vertices.min(axis=0)
        extent = self.vertices.max(axis=0) - low
        # Cells a little wider than the neighbourhoods of an even surface; but not many more cells than vertices.
        radius = np.sqrt(self.areas.sum() / count * (wanted + 1) / np.pi)
        width = max(1.1 * radius, extent.max() / np.cbrt(16 * count)) or 1.0
        cells = ((self.vertices - low) / width).astype(np.int32)
        rows, columns, places = (int(x) for x in cells.max(axis=0) + 1)
        keys = (cells[:, 0].astype(np.int64) * columns + cells[:, 1]) * places + cells[:, 2]
        order = np.argsort(keys, kind="stable").astype(np.int32)
        ends = np.concatenate([[0], np.cumsum(np.bincount(keys, minlength=rows * columns * places))])
        # The end of each row is the start of the next one.
        starts = np.empty((rows, columns, places + 1), np.int64)
        starts[..., :-1] = ends[:-1].reshape(rows, columns, places)
        starts[..., -1] = ends[places::places].reshape(rows, columns)
        points = np.ascontiguousarray(self.vertices[order].T)
        squared, nearest = find_nearest(points, cells[order], starts, width, order, wanted)
        return np.sqrt(squared, out=squared), nearest

    @property
    def neighbours(self) -> IntArray:
        """(n, k) the k = 30 vertices nearest to each vertex in space, itself excluded; fewer on tiny meshes."""
        return self._nearest[1]

    @property
    def neighbour_distances(self) -> FloatArray:
        """(n, k) distances to :attr:`neighbours`."""
        return self._nearest[0]

    @cached_property
    def curve(self) -> np.ndarray:
        """(n,) the vertices in an order in which near ones follow each other."""
        return along_curve(self.vertices)

    @cached_property
    def barycentre(self) -> FloatArray:
        """(3,) mean of the vertices."""
        return self.vertices.mean(axis=0)

    @cached_property
    def main_axis(self) -> FloatArray:
        """(3,) unit dominant eigenvector of the covariance of the vertices; its sign is arbitrary."""
        return np.linalg.eigh(np.cov(self.vertices.T))[1][:, -1]

    @cached_property
    def graph(self) -> csr_matrix:
        """(n, n) edge lengths between vertices, symmetric, and connected.

        Parts that no edge joins are bridged: each is linked to the largest one by one straight edge between
        the two closest vertices.
        """
        count = len(self.vertices)
        edges = np.concatenate([self.edges, self._bridges()])
        lengths = np.linalg.norm(self.vertices[edges[:, 0]] - self.vertices[edges[:, 1]], axis=1)
        # An explicit edge of length zero must stay an edge: sparse matrices would keep it, sums might not.
        both = np.concatenate([edges, edges[:, ::-1]])
        return coo_matrix((np.tile(lengths, 2), (both[:, 0], both[:, 1])), (count, count)).tocsr()

    @cached_property
    def cells(self) -> Cells:
        """The surface cut into 64 cells.

        Each first source is the vertex farthest, along edges, from those before it, beginning with the one farthest
        from the barycentre: that depends on the shape, not on how its vertices are numbered. Such sources
        sit on tips and borders; so the vertex nearest to the mean of each one's cell takes its place.
        """
        graph, count = self.graph, len(self.vertices)
        distances, owners = np.full(count, np.inf), np.zeros(count, np.int32)
        queue, waiting = np.empty(count, np.int32), np.zeros(count, np.bool_)
        source = int(((self.vertices - self.barycentre) ** 2).sum(axis=1).argmax())
        size = 0
        # Where vertices share a place there may be fewer places than cells.
        while size < CELLS and distances[source] > 0:
            distances[source], owners[source], queue[0] = 0.0, size, source
            shorten(graph.indptr, graph.indices, graph.data, distances, owners, queue, 1, waiting)
            source = int(distances.argmax())
            size += 1
        sizes = np.bincount(owners)
        means = (
            np.stack([np.bincount(owners, axis, size) for axis in self.vertices.T], axis=1) / sizes[:, None]
        )
        offsets = ((self.vertices - means[owners]) ** 2).sum(axis=1)
        centres = np.lexsort((offsets, owners))[np.cumsum(sizes) - sizes].astype(np.int32)
        distances[:] = np.inf
        distances[centres], owners[centres], queue[:size] = 0.0, np.arange(size), centres
        shorten(graph.indptr, graph.indices, graph.data, distances, owners, queue, size, waiting)
        return Cells(centres, owners, distances)

    def _bridges(self) -> IntArray:
        count = len(self.vertices)
        links = coo_matrix(
            (np.ones(len(self.edges), np.int8), (self.edges[:, 0], self.edges[:, 1])), (count, count)
        )
        parts, part = connected_components(links, directed=False)
        if parts == 1:
            return np.empty((0, 2), np.int32)
        # Of equals, such as the two sides of a plate, the one nearest to the barycentre: numbers must not decide.
        centrality = np.linalg.norm(self.vertices - self.barycentre, axis=1)
        sizes = np.bincount(part)
        first = np.lexsort((centrality, -sizes[part]))[0]
        main, rest = np.flatnonzero(part == part[first]), np.flatnonzero(part != part[first])
        distances, nearest = cKDTree(self.vertices[main]).query(self.vertices[rest])
        least = np.full(parts, np.inf)
        np.minimum.at(least, part[rest], distances)
        equal = np.flatnonzero(distances <= least[part[rest]] + SAME_LENGTH)
        main, rest = main[nearest[equal]], rest[equal]
        order = np.lexsort((centrality[main] + centrality[rest], part[rest]))
        chosen = order[np.unique(part[rest][order], return_index=True)[1]]
        return np.stack([rest[chosen], main[chosen]], axis=1).astype(np.int32)
