"""Shortest paths over a surface."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import BoolArray, Float32Array, FloatArray, IntArray


@kernel()
def _place(vertices: FloatArray, near: int, far: int, tip: int) -> tuple[float, float, float]:
    """Where a triangle's tip lies in its plane: how far along the side from near to far, and how far beside it."""
    along = square = across = 0.0
    for axis in range(3):
        side = vertices[far, axis] - vertices[near, axis]
        way = vertices[tip, axis] - vertices[near, axis]
        along += way * side
        square += side * side
        across += way * way
    length = np.sqrt(square)
    along = along / length if length > 0.0 else 0.0
    return along, np.sqrt(max(0.0, across - along * along)), length


@kernel()
def _cross(px: float, py: float, qx: float, qy: float, ax: float, ay: float, bx: float, by: float) -> bool:
    """Whether two segments in the plane, from p to q and from a to b, meet."""
    wx, wy, sx, sy = qx - px, qy - py, bx - ax, by - ay
    apart = (wx * (ay - py) - wy * (ax - px)) * (wx * (by - py) - wy * (bx - px))
    beyond = (sx * (py - ay) - sy * (px - ax)) * (sx * (qy - ay) - sy * (qx - ax))
    return apart <= 0.0 and beyond <= 0.0


@kernel()
def draw_lines(vertices: FloatArray, faces: IntArray, twins: IntArray) -> tuple[IntArray, FloatArray]:
    """Straight lines across one edge or two, where two or three faces in a row are laid flat.

    A line goes between the outermost vertices of such a strip, and is left out where it would leave the strip.

    Parameters
    ----------
    vertices : (n, 3) float64 array
    faces : (m, 3) int32 array
        All wound the same way.
    twins : (3 m,) int array
        For each half-edge ``3 * face + corner``, which starts at that corner, the other one of its edge; -1 on
        a boundary.

    Returns
    -------
    ends : (l, 2) int32 array
        Two vertices may have several lines.
    lengths : (l,) float64 array
    """
    ends = np.empty((5 * len(faces), 2), np.int32)
    lengths = np.empty(len(ends))
    count = 0
    # A face in its plane, and the tips of its neighbours.
    x, y, tip_x, tip_y = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    tips = np.empty(3, np.int32)
    for face in range(len(faces)):
        x[2], y[2], x[1] = _place(vertices, faces[face, 0], faces[face, 1], faces[face, 2])
        x[0] = y[0] = y[1] = 0.0
        for k in range(3):
            start, end, twin = k, (k + 1) % 3, twins[3 * face + k]
            tips[k] = -1 if twin < 0 else faces[twin // 3, (twin + 2) % 3]
            if twin < 0:
                continue
            along, beside, length = _place(vertices, faces[face, start], faces[face, end], tips[k])
            if length == 0.0:
                tips[k] = -1
                continue
            # The face lies left of its sides, and its neighbours right.
            ux, uy = (x[end] - x[start]) / length, (y[end] - y[start]) / length
            tip_x[k] = x[start] + along * ux + beside * uy
            tip_y[k] = y[start] + along * uy - beside * ux
        for k in range(3):
            if tips[k] < 0:
                continue
            px, py, end, apex = tip_x[k], tip_y[k], (k + 1) % 3, (k + 2) % 3
            if twins[3 * face + k] > 3 * face + k and _cross(
                px, py, x[apex], y[apex], x[k], y[k], x[end], y[end]
            ):
                ends[count, 0], ends[count, 1] = tips[k], faces[face, apex]
                lengths[count] = np.hypot(px - x[apex], py - y[apex])
                count += 1
            qx, qy = tip_x[end], tip_y[end]
            if (
                tips[end] >= 0
                and _cross(px, py, qx, qy, x[k], y[k], x[end], y[end])
                and _cross(px, py, qx, qy, x[end], y[end], x[apex], y[apex])
            ):
                ends[count, 0], ends[count, 1] = tips[k], tips[end]
                lengths[count] = np.hypot(px - qx, py - qy)
                count += 1
    return ends[:count], lengths[:count]


@kernel()
def pack_rows(ends: IntArray, lengths: FloatArray, count: int) -> tuple[IntArray, IntArray, FloatArray]:
    """Lines between ``count`` vertices in compressed rows: offsets, neighbours and lengths, each line both ways."""
    offsets = np.zeros(count + 2, np.int32)
    for line in range(len(ends)):
        offsets[ends[line, 0] + 2] += 1
        offsets[ends[line, 1] + 2] += 1
    offsets = np.cumsum(offsets).astype(np.int32)
    neighbours, packed = np.empty(2 * len(ends), np.int32), np.empty(2 * len(ends))
    for line in range(len(ends)):
        for side in range(2):
            place = offsets[ends[line, side] + 1]
            offsets[ends[line, side] + 1] += 1
            neighbours[place], packed[place] = ends[line, 1 - side], lengths[line]
    return offsets[:-1], neighbours, packed


@kernel()
def add_source(
    offsets: IntArray,
    neighbours: IntArray,
    lengths: FloatArray,
    source: int,
    distances: FloatArray,
    owners: IntArray,
    queue: IntArray,
    waiting: BoolArray,
) -> None:
    """Carry distances on from one more source along the lines of a graph, to all that it is nearest to.

    First in, first out: on meshes of even edges hardly a vertex is visited twice, and there is no heap to keep.
    Exact for any lengths that are not negative.

    Parameters
    ----------
    offsets, neighbours, lengths : arrays
        The graph in compressed rows: the neighbours of vertex i and the lengths of the lines to them are at
        ``offsets[i]:offsets[i + 1]``. Symmetric.
    distances : (n,) float64 array
        From the sources so far, changed in place; that of ``source`` is not 0.
    owners : (n,) int32 array
        The nearest source, changed in place.
    queue : (n,) int32 array
        Overwritten.
    waiting : (n,) bool array
        All False, before and after.
    """
    count = len(distances)
    distances[source], owners[source] = 0.0, source
    queue[0], waiting[source] = source, True
    head, size = 0, 1
    while size > 0:
        node = queue[head]
        head = head + 1 if head + 1 < count else 0
        size -= 1
        waiting[node] = False
        for e in range(offsets[node], offsets[node + 1]):
            other = neighbours[e]
            through = distances[node] + lengths[e]
            if through < distances[other]:
                distances[other] = through
                owners[other] = source
                if not waiting[other]:
                    waiting[other] = True
                    tail = head + size
                    queue[tail if tail < count else tail - count] = other
                    size += 1


@kernel(error_model="numpy")
def measure_all(
    offsets: IntArray, neighbours: IntArray, lengths: Float32Array, orders: IntArray, distances: Float32Array
) -> None:
    """Carry distances from many sources at once on along the lines of a graph, until no line shortens any.

    Sweeps over the vertices, forth and back in each of several orders in turn, visit those of which a neighbour has
    changed. Most paths run along one of the orders, so that few sweeps suffice, and all sources of a vertex lie side by
    side in memory. Exact for any lengths that are not negative.

    Parameters
    ----------
    offsets, neighbours, lengths : arrays
        The graph in compressed rows: the neighbours of vertex i and the lengths of the lines to them are at
        ``offsets[i]:offsets[i + 1]``. Symmetric; ``lengths`` float32. Of several lines the shortest counts.
    orders : (k, n) int array
        Permutations of the vertices.
    distances : (n, s) float32 array
        Upper bounds, changed in place.
    """
    count, sources = distances.shape
    changed = np.ones(count, np.bool_)
    best = np.empty(sources, np.float32)
    left, sweep = count, 0
    while left > 0:
        order, step = orders[sweep // 2 % len(orders)], 1 - 2 * (sweep % 2)
        sweep += 1
        for node in order[::step]:
            if not changed[node]:
                continue
            changed[node] = False
            left -= 1
            here = distances[node]
            best[:] = here
            for e in range(offsets[node], offsets[node + 1]):
                there, length = distances[neighbours[e]], lengths[e]
                for s in range(sources):
                    through = there[s] + length
                    best[s] = through if through < best[s] else best[s]
            shorter = False
            for s in range(sources):
                shorter |= best[s] < here[s]
            if not shorter:
                continue
            here[:] = best
            for e in range(offsets[node], offsets[node + 1]):
                other = neighbours[e]
                if not changed[other]:
                    changed[other] = True
                    left += 1
