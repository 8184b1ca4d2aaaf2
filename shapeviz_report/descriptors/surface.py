"""What descriptors share of a mesh, computed once and when first asked for."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from shapeviz_report.descriptors.kernels.angles import gather_angles
from shapeviz_report.descriptors.kernels.geodesics import add_source, draw_lines, pack_rows
from shapeviz_report.descriptors.kernels.grid import find_nearest
from shapeviz_report.mesh.boxes import along_curve
from shapeviz_report.types import FloatArray, IntArray, Mesh

NEIGHBOURS = 30
"""k of the paper's nearest neighbours (3.3)."""

SAME_LENGTH = 1e-6
"""Gaps that differ by less than this are equally wide."""

CROWD = 8
"""A vertex that shares its cell with more than this many times the neighbours wanted slows their search down."""

CENTRES = 64
"""Vertices that stand for all; all of them, where there are fewer."""


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
        return np.bincount(self.faces.ravel(), np.repeat(third, 3), len(self.vertices)).astype(np.float64)

    @cached_property
    def _sides(self) -> tuple[IntArray, IntArray, IntArray]:
        """Distinct edges, how many faces each has, and of each half-edge the other one of its edge, or -1."""
        starts, ends = self.faces.ravel(), np.roll(self.faces, -1, axis=1).ravel()
        keys = np.minimum(starts, ends).astype(np.int64) * len(self.vertices) + np.maximum(starts, ends)
        order = np.argsort(keys, kind="stable").astype(np.int32)
        keys = keys[order]
        first = np.flatnonzero(np.diff(keys, prepend=-1))
        counts = np.diff(np.append(first, len(keys)))
        twos = first[counts == 2]
        twins = np.full(len(keys), -1, np.int32)
        twins[order[twos]], twins[order[twos + 1]] = order[twos + 1], order[twos]
        return np.stack(np.divmod(keys[first], len(self.vertices)), axis=1).astype(np.int32), counts, twins

    @property
    def edges(self) -> IntArray:
        """(e, 2) distinct edges, each with its lower vertex first."""
        return self._sides[0]

    @cached_property
    def on_boundary(self) -> np.ndarray:
        """(n,) bool: whether a vertex lies on an edge with one face."""
        edges, counts, _ = self._sides
        flags = np.zeros(len(self.vertices), dtype=bool)
        flags[edges[counts == 1]] = True
        return flags

    @cached_property
    def _nearest(self) -> tuple[FloatArray, IntArray]:
        count = len(self.vertices)
        wanted = min(NEIGHBOURS, count - 1)
        low = self.vertices.min(axis=0)
        extent = self.vertices.max(axis=0) - low
        # Cells a little wider than the neighbourhoods of an even surface; but not many more cells than vertices.
        radius = np.sqrt(self.areas.sum() / count * (wanted + 1) / np.pi)
        least = extent.max() / np.cbrt(16 * count)
        width = max(1.1 * radius, least) or 1.0
        while True:
            cells = ((self.vertices - low) / width).astype(np.int32)
            rows, columns, places = (int(x) for x in cells.max(axis=0) + 1)
            keys = (cells[:, 0].astype(np.int64) * columns + cells[:, 1]) * places + cells[:, 2]
            # Where hundreds of sheets lie on each other a cell as wide as a neighbourhood holds far too many.
            company = np.square(np.bincount(keys)).sum() / count
            if company <= CROWD * wanted or width <= least:
                break
            width = max(width / 2, least)
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
    def _links(self) -> tuple[IntArray, FloatArray]:
        """Edges and bridges (e, 2), and their lengths (e,)."""
        ends = np.concatenate([self.edges, self._bridges()])
        return ends, np.linalg.norm(self.vertices[ends[:, 0]] - self.vertices[ends[:, 1]], axis=1)

    @cached_property
    def graph(self) -> csr_matrix:
        """(n, n) lengths of straight lines between vertices, symmetric, and connected.

        Edges alone make paths longer than the way over the surface, by up to 41 % and by how much depends on how it
        is cut into triangles. So there are also the lines across one edge or two, with the faces in between laid flat.
        Parts that no edge joins are bridged: each is linked to the largest one by one straight line between
        the two closest vertices. Where two vertices have several entries the shortest counts.
        """
        ends, lengths = self._links
        lines, spans = draw_lines(self.vertices, self.faces, self._sides[2])
        return self._packed(np.concatenate([ends, lines]), np.concatenate([lengths, spans]))

    def _packed(self, ends: IntArray, lengths: FloatArray) -> csr_matrix:
        count = len(self.vertices)
        offsets, neighbours, lengths = pack_rows(ends, lengths, count)
        return csr_matrix((lengths, neighbours, offsets), (count, count))

    @cached_property
    def centres(self) -> IntArray:
        """(c,) 64 vertices in the middle of cells of about equal size that the surface is cut into.

        The cells are those of sources: each next one is the vertex farthest, along edges, from those before it,
        beginning with the one farthest from the barycentre: that depends on the shape, not on how its vertices are
        numbered. Such sources sit on tips and borders; so the vertex nearest to the mean of each one's cell takes
        its place.
        """
        graph, count = self._packed(*self._links), len(self.vertices)
        distances, owners = np.full(count, np.inf), np.zeros(count, np.int32)
        queue, waiting = np.empty(count, np.int32), np.zeros(count, np.bool_)
        source = int(((self.vertices - self.barycentre) ** 2).sum(axis=1).argmax())
        for _ in range(CENTRES):
            add_source(graph.indptr, graph.indices, graph.data, source, distances, owners, queue, waiting)
            source = int(distances.argmax())
            # Where vertices share a place there may be fewer places than centres.
            if distances[source] == 0:
                break
        cells = np.unique(owners, return_inverse=True)[1]
        sizes = np.bincount(cells)
        means = np.stack([np.bincount(cells, axis) for axis in self.vertices.T], axis=1) / sizes[:, None]
        offsets = ((self.vertices - means[cells]) ** 2).sum(axis=1)
        return np.lexsort((offsets, cells))[np.cumsum(sizes) - sizes].astype(np.int32)

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
