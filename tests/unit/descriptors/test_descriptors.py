"""Every descriptor: analytic values, invariance, and a slow reference in plain numpy."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import Delaunay, cKDTree
from solids import ball, from_trimesh, lump, rotation, sheet, torus, tube

from shapeviz_report.descriptors import DESCRIPTORS, Surface
from shapeviz_report.descriptors.kernels.pairs import count_pfh, count_spfh
from shapeviz_report.descriptors.shape_context import SEEN, SHELLS
from shapeviz_report.descriptors.surface import CENTRES
from shapeviz_report.features import BINS, compute_histograms, fixed_edges
from shapeviz_report.mesh import normalise
from shapeviz_report.types import Mesh
from shapeviz_report.wording import WORDINGS

BY_NAME = {descriptor.name: descriptor for descriptor in DESCRIPTORS}


def compute(name: str, mesh: Mesh) -> np.ndarray:
    return np.asarray(BY_NAME[name].compute(Surface(mesh)))


# What descriptors share


@pytest.mark.slow
@pytest.mark.parametrize("name", ["even", "crowded", "stacked", "doubled", "few"])
def test_neighbours_against_a_tree(name) -> None:
    random = np.random.default_rng(0)
    vertices = {
        "even": lump().vertices,
        # Nine tenths in a thousandth of the width, and two far off.
        "crowded": np.concatenate(
            [random.normal(size=(300, 3)), 1e-3 * random.normal(size=(2700, 3)), [[50, 0, 0]]]
        ),
        # Three hundred sheets much closer to each other than the vertices of each.
        "stacked": np.concatenate([np.add(sheet(4).vertices, [1e-5 * i, 0, 1e-4 * i]) for i in range(300)]),
        "doubled": np.repeat(lump().vertices, 2, axis=0),
        "few": random.normal(size=(7, 3)),
    }[name]
    surface = Surface(Mesh(vertices, np.array([[0, 1, 2]], np.int32)))
    size = min(30, len(vertices) - 1)
    distances, indices = cKDTree(vertices).query(vertices, k=size + 1)
    assert np.sort(surface.neighbour_distances, axis=1) == pytest.approx(distances[:, 1:], abs=1e-12)
    assert surface.neighbours.shape == (len(vertices), size)
    assert (surface.neighbours != np.arange(len(vertices))[:, None]).all()
    assert (np.diff(np.sort(surface.neighbours, axis=1)) > 0).all()
    if name != "doubled":
        assert (np.sort(surface.neighbours, axis=1) == np.sort(indices[:, 1:], axis=1)).all()


@pytest.mark.slow
def test_neighbours_of_flat_and_regular_surfaces_in_every_orientation() -> None:
    cube = np.stack(np.meshgrid(*[np.arange(6.0)] * 3), axis=-1).reshape(-1, 3)
    for vertices in (
        sheet(12).vertices,
        cube,
        cube[(cube == 0).any(axis=1)],
        cube[(cube[:, 1:] == 0).all(axis=1)],
    ):
        size = min(30, len(vertices) - 1)
        nearest = np.sort(np.linalg.norm(vertices[:, None] - vertices, axis=2), axis=1)[:, 1 : size + 1]
        for axes, signs in product(permutations(range(3)), product((1.0, -1.0), repeat=3)):
            turned = Mesh(vertices[:, axes] * signs, np.array([[0, 1, 2]], np.int32))
            surface = Surface(turned)
            assert np.sort(surface.neighbour_distances, axis=1) == pytest.approx(nearest, abs=1e-12)
            assert (np.diff(np.sort(surface.neighbours, axis=1)) > 0).all()


def test_centres_are_spread_evenly() -> None:
    surface = Surface(lump())
    lengths = dijkstra(surface.graph, directed=False, indices=surface.centres)
    assert len(np.unique(surface.centres)) == CENTRES
    assert np.bincount(lengths.argmin(axis=0)).max() < 3 * 642 / CENTRES


def test_lines_lead_across_one_edge_and_two() -> None:
    # A strip of two squares with diagonals, folded by a right angle along x = 1.
    fold = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 1, 0], [1, 1, 0], [1, 1, 1]])
    faces = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]], np.int32)
    ways = Surface(Mesh(fold.astype(float), faces)).graph.toarray()
    assert ways == pytest.approx(ways.T)
    assert ways[1, 3] == ways[2, 4] == pytest.approx(np.sqrt(2))
    assert ways[0, 5] == pytest.approx(np.sqrt(5))
    assert ways[2, 3] == 0, "that line would cross three edges"


def _scattered() -> tuple[np.ndarray, np.ndarray]:
    """A square of triangles between random points."""
    points = np.random.default_rng(0).random((1500, 2))
    return np.column_stack([points, np.zeros(len(points))]), Delaunay(points).simplices


@pytest.mark.parametrize("surface", ["sphere", "squares", "random"])
def test_paths_are_little_longer_than_geodesics(surface) -> None:
    mesh = {
        "sphere": ball(4),
        "squares": sheet(40),
        "random": from_trimesh(trimesh.Trimesh(*_scattered(), process=False)),
    }[surface]
    straight = np.linalg.norm(mesh.vertices - mesh.vertices[0], axis=1)
    exact = 2 * np.arcsin(np.clip(straight / 2, 0, 1)) if surface == "sphere" else straight
    far = exact > 0.3
    stretch = dijkstra(Surface(mesh).graph, directed=False, indices=0)[far] / exact[far]
    # Chords of a ball are a little shorter than its arcs.
    assert stretch.min() > 0.999
    assert stretch.mean() < 1.04


# Gaussian curvature


def test_curvature_of_a_sphere_is_its_area_share() -> None:
    surface = Surface(ball())
    # K = 1 on the unit sphere, so each vertex holds its own area; Gauss-Bonnet: all together 4 pi.
    defect = BY_NAME["Gc"].compute(surface)[:, 0]
    assert defect.sum() == pytest.approx(4 * np.pi)
    assert defect == pytest.approx(surface.areas, rel=0.2)


def test_curvature_adds_up_by_gauss_and_bonnet() -> None:
    assert compute("Gc", torus()).sum() == pytest.approx(0, abs=1e-9)
    assert compute("Gc", sheet()).sum() == pytest.approx(2 * np.pi)
    assert compute("Gc", tube()).sum() == pytest.approx(0, abs=1e-9)


def test_flat_and_rolled_surfaces_have_no_curvature() -> None:
    assert compute("Gc", tube()) == pytest.approx(0, abs=1e-9)
    inner = np.abs(sheet().vertices[:, :2] - 0.5).max(axis=1) < 0.49
    assert compute("Gc", sheet())[inner] == pytest.approx(0, abs=1e-9)


# Average geodesic distance


def test_geodesic_distance_against_all_pairs() -> None:
    surface = Surface(lump())
    exact = dijkstra(surface.graph, directed=False).mean(axis=1)
    estimate = BY_NAME["Agd"].compute(surface)[:, 0]
    assert len(surface.vertices) > 5 * CENTRES
    assert np.abs(estimate - exact).mean() < 0.003 * exact.mean()
    assert np.abs(estimate - exact).max() < 0.02 * exact.mean()


def test_geodesic_distance_of_few_vertices_is_exact() -> None:
    surface = Surface(ball(1))
    assert len(surface.vertices) <= CENTRES
    exact = dijkstra(surface.graph, directed=False).mean(axis=1)
    assert BY_NAME["Agd"].compute(surface)[:, 0] == pytest.approx(exact)


def test_geodesic_distance_on_a_sphere_is_the_same_everywhere() -> None:
    values = compute("Agd", ball())
    # The mean angle to a point of the sphere is pi / 2; paths over the mesh are little longer.
    assert values.mean() == pytest.approx(np.pi / 2, rel=0.02)
    assert values.mean() > np.pi / 2
    assert values.std() < 0.03 * values.mean()


def test_parts_that_no_path_joins_are_bridged() -> None:
    near, far = ball(2), ball(2)
    mesh = Mesh(
        np.concatenate([near.vertices, far.vertices * 0.5 + [4, 0, 0]]),
        np.concatenate([near.faces, far.faces + len(near.vertices)]),
    )
    values = compute("Agd", mesh)[:, 0]
    assert np.isfinite(values).all()
    # Half of the vertices lie beyond a gap of 2.5.
    assert values.min() > 2.5 / 2


# Normal diameter


def test_diameter_of_sphere_and_tube() -> None:
    assert compute("Nd", ball()) == pytest.approx(2.0, rel=0.01)
    middle = np.abs(tube().vertices[:, 2]) < 0.9
    assert compute("Nd", tube(radius=0.2))[middle] == pytest.approx(0.4, rel=0.01)


def test_diameter_against_brute_force() -> None:
    mesh = lump()
    surface = Surface(mesh)
    expected = brute_force_diameter(mesh, surface.normals)
    assert (expected > 0).all()
    assert BY_NAME["Nd"].compute(surface)[:, 0] == pytest.approx(expected)


def test_diameter_of_an_open_sheet_is_zero() -> None:
    assert (compute("Nd", sheet()) == 0).all()


def brute_force_diameter(mesh: Mesh, normals: np.ndarray) -> np.ndarray:
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    result = np.zeros(len(mesh.vertices))
    for v, (origin, normal) in enumerate(zip(mesh.vertices, normals)):
        others = ~(mesh.faces == v).any(axis=1)
        system = np.stack([np.broadcast_to(normal, a.shape), b - a, c - a], axis=2)[others]
        t, u, w = np.linalg.solve(system, (origin - a[others])[..., None])[..., 0].T
        hit = (u >= -1e-9) & (w >= -1e-9) & (u + w <= 1 + 1e-9) & (t > 1e-6)
        result[v] = t[hit].min() if hit.any() else 0
    return result


# Normal and point angle


def test_angles_on_a_tube() -> None:
    mesh = tube()
    # Its axis is z: normals are square to it, and the way to the centre turns with height.
    assert compute("Na", mesh) == pytest.approx(0, abs=1e-6)
    expected = np.abs(mesh.vertices[:, 2]) / np.linalg.norm(mesh.vertices, axis=1)
    assert compute("Pa", mesh)[:, 0] == pytest.approx(expected, abs=1e-6)


def test_angle_of_a_flat_sheet() -> None:
    stretched = Mesh(sheet().vertices * [3, 1, 1], sheet().faces)
    assert compute("Na", stretched) == pytest.approx(0, abs=1e-9)


# Shape context


def test_context_against_slow_counting() -> None:
    mesh = lump()
    surface = Surface(mesh)
    assert compute("Sc", mesh) == pytest.approx(
        slow_context(surface, range(642)), abs=2.5 / len(mesh.vertices)
    )


def test_context_counting_a_sample() -> None:
    mesh = Mesh(lump().vertices, lump().faces)
    fine = from_trimesh(trimesh.Trimesh(mesh.vertices, mesh.faces).subdivide().subdivide())
    surface = Surface(fine)
    assert len(fine.vertices) > 5 * SEEN
    chosen = slice(0, None, 97)
    difference = np.abs(
        compute("Sc", fine)[chosen] - slow_context(surface, range(*chosen.indices(len(fine.vertices))))
    )
    assert difference.mean() < 1e-3
    assert difference.max() < 0.03


def test_context_of_a_tube_end_lies_behind_it() -> None:
    values = compute("Sc", tube())
    octants = values.reshape(-1, 3, 8)
    # From outside the tube everything lies on the inner side of the tangent plane.
    assert octants[:, :, 4:].sum() < 0.01 * octants.sum()
    assert values.sum(axis=1) == pytest.approx(1)


def slow_context(surface: Surface, chosen: range) -> np.ndarray:
    centre = surface.vertices.mean(axis=0)
    result = np.zeros((len(chosen), 24))
    for row, i in enumerate(chosen):
        x = surface.vertices[i]
        normal = surface.normals[i]
        plane = np.eye(3) - np.outer(normal, normal)
        patch = (surface.vertices[surface.neighbours[i]] - x) @ plane
        patch -= patch.mean(axis=0)
        tangents = np.linalg.eigh(patch.T @ patch)[1][:, [2, 1]].T
        tangents = [t if (centre - x) @ t >= 0 else -t for t in tangents]
        others = np.delete(surface.vertices, i, axis=0) - x
        distance = np.linalg.norm(others, axis=1) / 2
        shell = np.searchsorted(SHELLS, distance)
        octant = sum((others @ axis > 0) * 2**bit for bit, axis in enumerate([*tangents, normal]))
        result[row] = np.bincount(8 * shell + octant, minlength=24) / len(others)
    return result


# Point feature histograms


@pytest.mark.slow
def test_pfh_against_slow_pairs() -> None:
    surface = Surface(lump())
    chosen = range(0, len(surface.vertices), 40)
    values = BY_NAME["PFH"].compute(surface)
    for i in chosen:
        near = surface.neighbours[i]
        cells = np.zeros(125)
        for y in near:
            for z in near:
                if y != z:
                    alpha, phi, theta = angles(surface, y, z)
                    bins = [
                        int(min(4, np.floor(part * 5)))
                        for part in ((alpha + 1) / 2, (phi + 1) / 2, (theta / np.pi + 1) / 2)
                    ]
                    cells[25 * bins[0] + 5 * bins[1] + bins[2]] += 1
        assert values[i] == pytest.approx(cells / cells.sum(), abs=1e-5)


@pytest.mark.slow
def test_fpfh_against_slow_pairs() -> None:
    surface = Surface(lump())
    count = len(surface.vertices)
    spfh = np.zeros((count, 3, 11))
    for x in range(count):
        for y in surface.neighbours[x]:
            alpha, phi, theta = angles(surface, x, y)
            for group, part in enumerate([(alpha + 1) / 2, (phi + 1) / 2, (theta / np.pi + 1) / 2]):
                spfh[x, group, int(min(10, np.floor(part * 11)))] += 1 / 30
    expected = spfh.copy()
    for x in range(count):
        for y in surface.neighbours[x]:
            expected[x] += spfh[y] / np.linalg.norm(surface.vertices[x] - surface.vertices[y]) / 30
    expected /= expected.sum(axis=2, keepdims=True)
    values = BY_NAME["FPFH"].compute(surface).reshape(-1, 3, 11)
    # A pair on the very edge of a bin may round to either side; nearly all must agree.
    assert np.mean(np.abs(values - expected) < 1e-4) > 0.999
    assert values == pytest.approx(expected, abs=0.05)


def angles(surface: Surface, y: int, z: int) -> tuple[float, float, float]:
    """alpha, phi, theta of the paper's Eq. 4 and 5."""
    u, other = surface.normals[y], surface.normals[z]
    line = surface.vertices[z] - surface.vertices[y]
    v = np.cross(line, u)
    v /= np.linalg.norm(v)
    w = np.cross(u, v)
    return float(v @ other), float(u @ line / np.linalg.norm(line)), float(np.arctan2(w @ other, u @ other))


def test_flat_sheets_have_one_point_feature() -> None:
    pfh, fpfh = compute("PFH", sheet()), compute("FPFH", sheet())
    # alpha = phi = theta = 0: the middle cell of each.
    assert pfh[:, 25 * 2 + 5 * 2 + 2] == pytest.approx(1)
    assert fpfh[:, [5, 16, 27]] == pytest.approx(1)


# All of them


@pytest.mark.parametrize("descriptor", DESCRIPTORS, ids=lambda d: d.name)
@settings(max_examples=6, deadline=None)
@given(turn=st.integers(0, 10**6), scale=st.floats(0.01, 100), shift=st.floats(-50, 50))
def test_invariance_under_rigid_motion_and_scale(descriptor, turn, scale, shift) -> None:
    mesh = lump(1)
    moved = Mesh(scale * (mesh.vertices @ rotation(turn).T) + shift, mesh.faces)
    before = descriptor.compute(Surface(normalise(mesh)))
    after = descriptor.compute(Surface(normalise(moved)))
    # Rounding may push a pair or a point over the edge of a cell; a histogram of the values hardly notices.
    assert np.mean(np.abs(before - after) < 1e-5) > 0.999
    assert np.abs(before - after).mean() < 1e-5


def renumbered(mesh: Mesh) -> tuple[Mesh, np.ndarray]:
    """A mesh with its vertices and faces in another order, and that order of its vertices."""
    random = np.random.default_rng(0)
    order = random.permutation(len(mesh.vertices))
    faces = np.roll(np.argsort(order)[mesh.faces], 1, axis=1)[random.permutation(len(mesh.faces))]
    return Mesh(mesh.vertices[order], faces.astype(np.int32)), order


@pytest.mark.parametrize("descriptor", DESCRIPTORS, ids=lambda d: d.name)
def test_the_numbering_of_vertices_and_faces_does_not_matter(descriptor) -> None:
    mesh = normalise(lump(1))
    other, order = renumbered(mesh)
    before, after = descriptor.compute(Surface(mesh))[order], descriptor.compute(Surface(other))
    assert np.mean(np.abs(before - after) < 1e-5) > 0.999
    assert np.abs(before - after).mean() < 1e-5


def test_rounding_decides_nothing_on_a_flat_plate() -> None:
    # Where all angles are 0 or a half turn, and all else lies in one plane with a vertex, a turn that adds errors of
    # rounding must not send a vertex into another bin.
    random = np.random.default_rng(0)
    square = random.random((500, 2)) * [2, 1]
    above = Delaunay(square).simplices
    below = above[:, ::-1] + len(square)
    vertices = np.column_stack([np.tile(square, (2, 1)), np.repeat([0.01, -0.01], len(square))])
    mesh = normalise(Mesh(vertices, np.concatenate([above, below]).astype(np.int32)))
    before = compute_histograms(mesh, fixed_edges(), by_area=True)
    for turn in range(3):
        moved = normalise(renumbered(Mesh(mesh.vertices @ rotation(turn).T, mesh.faces))[0])
        after = compute_histograms(moved, fixed_edges(), by_area=True)
        # Half the sum of the differences is the share of the surface that changed bins.
        moves = np.abs(after - before).reshape(-1, BINS).sum(axis=1) / 2
        assert moves.max() < 0.02
        assert moves.mean() < 0.001


@pytest.mark.parametrize("name", ["Gc", "Agd", "Nd", "Na", "Pa", "Sc"])
def test_mirror_images_are_alike(name) -> None:
    # Not so PFH and FPFH: alpha and theta change sign in a mirror.
    mesh = lump(2)
    mirrored = Mesh(mesh.vertices * [-1, 1, 1], mesh.faces[:, ::-1].copy())
    before, after = (np.sort(compute(name, m), axis=0) for m in (mesh, mirrored))
    assert np.abs(before - after).mean() < 1e-4


DEGENERATE = {
    "one triangle": Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]], np.int32)),
    "two apart": Mesh(
        np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]]),
        np.array([[0, 1, 2], [3, 4, 5]], np.int32),
    ),
    "sliver": Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [0.5, 1e-15, 0]]), np.array([[0, 1, 2]], np.int32)),
    "without area": Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [0.5, 0, 0]]), np.array([[0, 1, 2]], np.int32)),
    "doubled vertices": Mesh(np.repeat(ball(1).vertices, 2, axis=0), ball(1).faces * 2),
    "folded": Mesh(
        np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 1e-9]]),
        np.array([[0, 1, 2], [1, 0, 3]], np.int32),
    ),
    "sheet": sheet(5),
}


@pytest.mark.parametrize("name", DEGENERATE)
@pytest.mark.parametrize("descriptor", DESCRIPTORS, ids=lambda d: d.name)
def test_degenerate_meshes_have_finite_values(descriptor, name) -> None:
    mesh = DEGENERATE[name]
    values = descriptor.compute(Surface(mesh))
    assert values.shape == (len(mesh.vertices), descriptor.dimensions)
    assert np.isfinite(values).all()


def test_table_1() -> None:
    assert [(d.name, d.dimensions) for d in DESCRIPTORS[:8]] == [
        ("Gc", 1), ("Agd", 1), ("Nd", 1), ("Na", 1), ("Pa", 1), ("Sc", 24), ("PFH", 125), ("FPFH", 33),
    ]  # fmt: skip


@pytest.mark.parametrize("descriptor", DESCRIPTORS, ids=lambda d: d.name)
def test_ranges_sit_where_the_values_are(descriptor) -> None:
    edges = np.array(descriptor.edges)
    assert len(edges) == 11
    assert (np.diff(edges) > 0).all()
    limb = Mesh(lump().vertices * [1, 0.3, 0.3], lump().faces)
    values = np.asarray(descriptor.compute(Surface(normalise(limb))))
    assert np.mean((values >= edges[0]) & (values <= edges[-1])) > 0.9


# What dimensions are in words


def seen_from(direction, normal) -> set[str]:
    """What PFH and FPFH say, in words, of a point in some direction from one whose normal points up."""
    vertices = np.array([[0, 0, 0], direction], float)
    normals = np.array([[0, 0, 1], normal], float)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    neighbours = np.array([[1], [0]])
    three = count_spfh(vertices, normals, neighbours)[0]
    # PFH counts both directions of the pair; the first point as seen from the second is a cell of its own.
    both = count_pfh(vertices, normals, np.array([[0, 1]] * 2))[0]
    return {WORDINGS["FPFH"].quantities[i] for i in np.flatnonzero(three)} | {
        WORDINGS["PFH"].quantities[i] for i in np.flatnonzero(both)
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    ("direction", "normal", "words"),
    [
        # Ahead lies x, up lies z, so y is on the left.
        (
            (1, 0, 0),
            (1, 0, 1),
            ["turns outwards by 16 to 49°", "lies within 12° of", "bends outwards by 36 to 108°"],
        ),
        ((1, 0, 0), (-1, 0, 1), ["turns inwards by 16 to 49°", "bends inwards by 36 to 108°"]),
        (
            (1, 0, 0),
            (0, -1, 1),
            ["leans to the right by 40 to 55°", "leans more than 37° to the right"],
        ),
        ((1, 0, 0), (0, 1, 2), ["leans to the left by 16 to 27°", "leans 12 to 37° to the left"]),
        (
            (1, 0, -1),
            (0, 0, 1),
            ["lie 40 to 55° below", "lies more than 37° below", "turns by less than 36°"],
        ),
        ((2, 0, 1), (0, 0, 1), ["lie 16 to 27° above", "lies 12 to 37° above", "turns by less than 16°"]),
    ],
)
def test_point_pairs_in_words(direction, normal, words) -> None:
    found = seen_from(direction, normal)
    for word in words:
        assert any(word in text for text in found), (word, found)


def test_shape_contexts_in_words() -> None:
    surface = Surface(ball(3))
    shares = dict(zip(WORDINGS["Sc"].quantities, compute("Sc", ball(3)).mean(axis=0), strict=True))
    # All of a ball lies inside its tangent planes.
    assert sum(
        share for text, share in shares.items() if "inside the tangent plane" in text
    ) == pytest.approx(1)
    distances = np.linalg.norm(surface.vertices[:, None] - surface.vertices, axis=2)
    far = (distances > 0.6).sum() / (len(distances) * (len(distances) - 1))
    found = sum(
        share for text, share in shares.items() if "more than 0.6 times the shape's radius away" in text
    )
    assert found == pytest.approx(far, abs=0.01)
