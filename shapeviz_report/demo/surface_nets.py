"""The surface of a solid as an even, watertight triangle mesh.

The signed distance is sampled on a regular grid near the surface, the inside is taken as a set of voxels, and
the mesh is the boundary of that set with its corners drawn onto the surface (surface nets, Gibson 1998).
The boundary of a voxel set is a 2-manifold exactly if the set is well-composed (Latecki 1997: no two voxels
meet only along an edge or at a corner), so voxels are added until it is, and where a gap is too narrow for
the grid. Tangential relaxation evens the triangles, and Newton steps along the gradient put the vertices on
the surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import label, map_coordinates
from scipy.sparse import coo_array

from shapeviz_report.compilation import kernel
from shapeviz_report.demo.solids import (
    ATTACH,
    BLADE,
    BLEND,
    BOX,
    CARVE,
    CONE,
    DROP,
    EXTRUSION,
    GUARD,
    KEEP,
    MATRIX,
    ORIGIN,
    PARAMETERS,
    REVOLUTION,
    Solid,
)
from shapeviz_report.types import BoolArray, FloatArray, IntArray, Mesh

SPACING = 0.0105
"""Grid spacing as a fraction of the bounding-box diagonal; the edges of the mesh are about as long."""

MOST_FACES = 12_000
"""About how many triangles a mesh may have; bulky solids get a wider spacing."""

_ROUGH = 3
_BLOCK = 4  # grid points a block edge; blocks far from the surface are sampled once
_RELAXATIONS = 4
_PROJECTIONS = 2
_ADDED = 0.25  # depth given to voxels that the topology asked for, in grid spacings
_TETRAHEDRON = np.array([[1, -1, -1], [-1, -1, 1], [-1, 1, -1], [1, 1, 1]], dtype=np.float64)


@kernel()
def _outline_distance(x: float, y: float, outline: FloatArray) -> float:
    """Signed distance to a closed polygon (n, 2), negative inside: nearest edge, sign by crossings."""
    nearest = np.inf
    inside = False
    previous = len(outline) - 1
    for i in range(len(outline)):
        ax, ay = outline[previous, 0], outline[previous, 1]
        ex, ey = outline[i, 0] - ax, outline[i, 1] - ay
        wx, wy = x - ax, y - ay
        t = min(max((wx * ex + wy * ey) / (ex * ex + ey * ey), 0.0), 1.0)
        dx, dy = wx - t * ex, wy - t * ey
        nearest = min(nearest, dx * dx + dy * dy)
        if (ay > y) != (ay + ey > y) and wx < ex * wy / ey:
            inside = not inside
        previous = i
    return -np.sqrt(nearest) if inside else np.sqrt(nearest)


@kernel()
def _round_cone(
    radial: float, z: float, length: float, start: float, end: float
) -> tuple[float, float, float]:
    """Signed distance to a round cone about the z axis, and its gradient (radial, z)."""
    slope = (start - end) / length if length > 0.0 else 0.0
    cosine = np.sqrt(1.0 - slope * slope)
    along = cosine * z - slope * radial
    if length > 0.0 and 0.0 <= along <= cosine * length:
        return cosine * radial + slope * z - start, cosine, slope
    radius = start
    if length > 0.0 and along > 0.0:
        radius = end
        z -= length
    norm = np.sqrt(radial * radial + z * z)
    if norm == 0.0:
        return -radius, 0.0, 1.0
    return norm - radius, radial / norm, z / norm


@kernel()
def _primitive_distance(
    px: float, py: float, pz: float, rows: FloatArray, i: int, outlines: FloatArray
) -> float:
    """Signed distance to the primitive in row ``i``."""
    row = rows[i]
    x, y, z = px - row[ORIGIN], py - row[ORIGIN + 1], pz - row[ORIGIN + 2]
    m = row[MATRIX:PARAMETERS]
    x, y, z = (
        m[0] * x + m[1] * y + m[2] * z,
        m[3] * x + m[4] * y + m[5] * z,
        m[6] * x + m[7] * y + m[8] * z,
    )
    a, b, c, d = row[PARAMETERS], row[PARAMETERS + 1], row[PARAMETERS + 2], row[PARAMETERS + 3]
    if row[0] == CONE:
        radial = np.sqrt(x * x + y * y)
        value, gradient_radial, gz = _round_cone(radial, z, a, b, c)
        gx, gy = gradient_radial, 0.0
        if radial > 0.0:
            gx, gy = gradient_radial * x / radial, gradient_radial * y / radial
        # A squashed cone's field is not a distance: divide by the length of its gradient in the world. That
        # holds to first order; deep inside a flat cone the quotient exceeds half its thickness, ``d``.
        wx = m[0] * gx + m[3] * gy + m[6] * gz
        wy = m[1] * gx + m[4] * gy + m[7] * gz
        wz = m[2] * gx + m[5] * gy + m[8] * gz
        return max(value / np.sqrt(wx * wx + wy * wy + wz * wz), -d)
    if row[0] == BLADE:
        value, _, _ = _round_cone(abs(y), z, a, b, c)
        value = max(value, 0.0)
        return np.sqrt(value * value + x * x) - d
    if row[0] == BOX:
        x, y, z = abs(x) - a + d, abs(y) - b + d, abs(z) - c + d
    elif row[0] == EXTRUSION:
        start, count = int(a), int(b)
        x, y, z = _outline_distance(x, y, outlines[start : start + count]) + d, -np.inf, abs(z) - c + d
    else:
        start, count = int(a), int(b)
        return _outline_distance(np.sqrt(x * x + y * y), z, outlines[start : start + count])
    ox, oy, oz = max(x, 0.0), max(y, 0.0), max(z, 0.0)
    return np.sqrt(ox * ox + oy * oy + oz * oz) + min(max(x, y, z), 0.0) - d


@kernel()
def _smooth_minimum(a: float, b: float, radius: float) -> float:
    """Cubic polynomial minimum: as ``min`` where the two differ by more than ``radius``."""
    overlap = max(radius - abs(a - b), 0.0)
    if overlap == 0.0:
        return min(a, b)
    return min(a, b) - overlap * overlap * overlap / (6.0 * radius * radius)


@kernel()
def _distances(points: FloatArray, rows: FloatArray, outlines: FloatArray, reach: float) -> FloatArray:
    """Run a program at every point (n, 3).

    Guards pass over parts that cannot change the result: an operator of radius r leaves ``a`` alone if ``b`` is
    greater than ``a + r``, and the distance to the part's bounding box is a lower bound of ``b``. A part beyond
    ``reach`` (more than any blend radius) is replaced by that bound: too far away to move the surface.
    """
    values = np.empty(len(points))
    stack = np.empty(len(rows))
    for n in range(len(points)):
        px, py, pz = points[n, 0], points[n, 1], points[n, 2]
        top = -1
        i = -1
        while i < len(rows) - 1:
            i += 1
            opcode = rows[i, 0]
            if opcode == GUARD:
                waiting = rows[i, PARAMETERS]
                limit = rows[i, PARAMETERS + 1]
                if waiting == BLEND:
                    limit += stack[top]
                elif waiting == CARVE:
                    limit -= stack[top]
                else:
                    limit += stack[top - 1]
                x = max(abs(px - rows[i, ORIGIN]) - rows[i, MATRIX], 0.0)
                y = max(abs(py - rows[i, ORIGIN + 1]) - rows[i, MATRIX + 1], 0.0)
                z = max(abs(pz - rows[i, ORIGIN + 2]) - rows[i, MATRIX + 2], 0.0)
                gap = np.sqrt(x * x + y * y + z * z)
                if gap > 0.0 and gap > limit:
                    i += int(rows[i, PARAMETERS + 2])
                elif gap > reach:
                    i += int(rows[i, PARAMETERS + 2]) - 1
                    top += 1
                    stack[top] = gap
            elif opcode <= REVOLUTION:
                top += 1
                stack[top] = _primitive_distance(px, py, pz, rows, i, outlines)
            elif opcode == KEEP:
                top += 1
                stack[top] = stack[top - 1]
            elif opcode == DROP:
                top -= 1
                stack[top] = stack[top + 1]
            else:
                top -= 1
                sign = -1.0 if opcode == CARVE else 1.0
                body = stack[top - 1] if opcode == ATTACH else stack[top]
                value = sign * _smooth_minimum(sign * body, stack[top + 1], rows[i, PARAMETERS])
                stack[top] = min(stack[top], value) if opcode == ATTACH else value
        values[n] = stack[0]
    return values


@dataclass(frozen=True)
class _Grid:
    """Distances at ``low + spacing * (i, j, k)``; ``reach`` as in :func:`_distances`."""

    values: FloatArray
    low: FloatArray
    spacing: float
    reach: float


def _sample(solid: Solid, spacing: float) -> _Grid:
    """Distances on a grid around the solid, exact near its surface only; elsewhere the sign is right."""
    blends = np.isin(solid.rows[:, 0], (BLEND, CARVE, ATTACH))
    reach = float(solid.rows[blends, PARAMETERS].max(initial=0.0)) + 2 * spacing
    margin = 3 * spacing + reach / 6
    low = solid.low - margin
    blocks = np.ceil((solid.high + margin - low) / (spacing * _BLOCK)).astype(np.int64) + 1
    offsets = np.indices((_BLOCK,) * 3).reshape(3, -1).T * spacing
    corners = low + np.indices(tuple(blocks)).reshape(3, -1).T * (_BLOCK * spacing)
    half = (_BLOCK - 1) / 2
    centres = _distances(corners + half * spacing, solid.rows, solid.outlines, reach)
    # Up to a block's corner and one step on; 1.25 allows for squashed cones, whose distances are rough.
    near = np.abs(centres) <= 1.25 * (np.sqrt(3.0) * half + 1.0) * spacing
    points = (corners[near, None] + offsets).reshape(-1, 3)
    values = np.repeat(centres[:, None], _BLOCK**3, axis=1)
    values[near] = _distances(points, solid.rows, solid.outlines, reach).reshape(-1, _BLOCK**3)
    values = values.reshape(*blocks, _BLOCK, _BLOCK, _BLOCK).transpose(0, 3, 1, 4, 2, 5)
    return _Grid(values.reshape(blocks * _BLOCK), low, spacing, reach)


def _cell_corners(grid: BoolArray) -> list[BoolArray]:
    """Views of the eight corners of all cells; opposite corners are ``n`` and ``7 - n``."""
    return [grid[i : i - 1 or None, j : j - 1 or None, k : k - 1 or None] for i, j, k in np.ndindex(2, 2, 2)]


def _compose_well(inside: BoolArray) -> None:
    """Add voxels in place until none meet only along an edge or at a corner, and no gap is one voxel wide.

    Walls nearer to each other than a cell is wide would share its vertex, and cross.
    """
    while True:
        before = np.count_nonzero(inside)
        for axis in range(3):
            lines = np.moveaxis(inside, axis, 0)
            lines[1:-1] |= lines[:-2] & lines[2:]
            # A 2 x 2 checkerboard in a plane across this axis: two voxels that meet along an edge.
            planes = np.moveaxis(inside, axis, 0)
            a, b = planes[:, :-1, :-1], planes[:, :-1, 1:]
            c, d = planes[:, 1:, :-1], planes[:, 1:, 1:]
            crossed = (a == d) & (b == c) & (a != b)
            for corner in (a, b, c, d):
                corner |= crossed
        # Two opposite corners of a cell against the six others: they meet at a point.
        cells = _cell_corners(inside)
        total = np.sum(cells, axis=0, dtype=np.int8)
        crossed = np.zeros(total.shape, dtype=bool)
        for one, opposite in zip(cells[:4], cells[:3:-1], strict=True):
            crossed |= (one == opposite) & (total == np.where(one, 2, 6))
        for cell in cells:
            cell |= crossed
        if np.count_nonzero(inside) == before:
            return


def _crossings(inside: BoolArray, values: FloatArray) -> tuple[BoolArray, FloatArray, IntArray]:
    """The cells that the surface passes, a vertex in each, and a quad around each grid edge it crosses.

    Returns a mask of the cells, vertices (n, 3) in grid units in the order of the cells, and quads (m, 4).
    """
    cells = _cell_corners(inside)
    mixed = np.logical_or.reduce(cells) & ~np.logical_and.reduce(cells)
    index = np.full(mixed.shape, -1, dtype=np.int32)
    index[mixed] = np.arange(np.count_nonzero(mixed), dtype=np.int32)
    quads, places = [], []
    for axis in range(3):
        unit = np.eye(3, dtype=np.int64)[axis]
        near_side = np.moveaxis(np.moveaxis(inside, axis, 0)[:-1], 0, axis)
        far_side = np.moveaxis(np.moveaxis(inside, axis, 0)[1:], 0, axis)
        edges = np.argwhere(near_side != far_side)
        near, far = values[tuple(edges.T)], values[tuple((edges + unit).T)]
        share = near / (near - far)
        second, third = np.roll(unit, 1), np.roll(unit, 2)
        ring = np.array([-second - third, -third, 0 * unit, -second])
        quad = index[tuple((edges[:, None] + ring).transpose(2, 0, 1))]
        leaving = near_side[tuple(edges.T)]
        quads.append(np.where(leaving[:, None], quad, quad[:, ::-1]))
        places.append(edges + share[:, None] * unit)
    corners = np.concatenate(quads)
    crossing = np.repeat(np.concatenate(places), 4, axis=0)
    count = np.bincount(corners.ravel())
    vertices = [np.bincount(corners.ravel(), weights=crossing[:, axis]) / count for axis in range(3)]
    return mixed, np.stack(vertices, axis=1), corners


def _settle(
    vertices: FloatArray, quads: IntArray, mended: BoolArray, solid: Solid, grid: _Grid
) -> FloatArray:
    """Relax vertices along the surface, then draw all but the mended ones onto it."""
    starts, ends = quads.ravel(), np.roll(quads, -1, axis=1).ravel()
    pull = coo_array((np.ones(len(starts)), (starts, ends)), shape=(len(vertices), len(vertices))).tocsr()
    pull = pull + pull.T
    valence = pull.sum(axis=1)[:, None]
    delta = 0.1 * grid.spacing
    for step in range(_RELAXATIONS + _PROJECTIONS):
        # Gradient from the corners of a tetrahedron; their mean is the distance.
        points = (vertices[:, None] + delta * _TETRAHEDRON).reshape(-1, 3)
        if step < _RELAXATIONS:  # on the way, the grid tells the distance well enough
            samples = map_coordinates(grid.values, (points - grid.low).T / grid.spacing, order=1)
        else:
            samples = _distances(points, solid.rows, solid.outlines, grid.reach)
        samples = samples.reshape(-1, 4)
        gradient = samples @ _TETRAHEDRON / (4 * delta)
        norm = np.maximum(np.linalg.norm(gradient, axis=1, keepdims=True), 0.1)
        normal = gradient / norm
        limit = 0.5 * grid.spacing
        offset = np.clip(samples.mean(axis=1, keepdims=True) / norm, -limit, limit)
        if step >= _RELAXATIONS:
            offset[mended] = 0.0
        vertices = vertices - offset * normal
        if step < _RELAXATIONS:
            move = (pull @ vertices) / valence - vertices
            vertices = vertices + 0.5 * (move - np.sum(move * normal, axis=1, keepdims=True) * normal)
    return vertices


def mesh_solid(solid: Solid) -> Mesh:
    """Mesh the surface of a solid.

    Parameters
    ----------
    solid : Solid
        Its parts should be thicker than three grid spacings (``SPACING`` of the diagonal) to be resolved.

    Returns
    -------
    Mesh
        A closed 2-manifold, faces counter-clockwise seen from outside; enclosed pockets are filled. One
        component if the solid is one.
    """
    spacing = SPACING * float(np.linalg.norm(solid.high - solid.low))
    # A rough pass tells the area: there are two triangles a crossed grid edge.
    rough = _sample(solid, _ROUGH * spacing).values < 0.0
    crossed = sum(np.count_nonzero(np.diff(rough, axis=axis)) for axis in range(3))
    spacing *= np.sqrt(max(1.0, 2 * crossed * _ROUGH**2 / MOST_FACES))
    grid = _sample(solid, spacing)
    inside = grid.values < 0.0
    _compose_well(inside)
    pockets, _ = label(~inside)
    inside |= pockets != pockets[0, 0, 0]
    added = inside & (grid.values >= 0.0)
    grid.values[added] = -_ADDED * spacing
    passed, vertices, quads = _crossings(inside, grid.values)
    mended = np.logical_or.reduce(_cell_corners(added))[passed]
    vertices = _settle(grid.low + spacing * vertices, quads, mended, solid, grid)
    # Cut every quad along its shorter diagonal.
    corners = vertices[quads]
    first = np.linalg.norm(corners[:, 0] - corners[:, 2], axis=1)
    second = np.linalg.norm(corners[:, 1] - corners[:, 3], axis=1)
    quads = np.where((first <= second)[:, None], quads, np.roll(quads, -1, axis=1))
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return Mesh(vertices, faces.astype(np.int32))
