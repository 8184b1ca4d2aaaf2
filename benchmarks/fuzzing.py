"""Feed broken files and strange surfaces to everything that a shape passes, and report what is not borne.

    python -m benchmarks.fuzzing --seed 0 --rounds 20

A case is a mesh file. It is read, cleaned, prepared, described by all eight descriptors and summed up in
histograms, in a worker process. It may come through, with finite features, or be refused in words that its owner
understands. Reported are: crashes, cases over the time limit or the memory limit, exceptions, values that are not
finite, and refusals that speak of a program's insides. The files of reported cases are kept. A first run may report
slow cases that are none, while the descriptors are being compiled.
"""

from __future__ import annotations

import argparse
import re
import resource
import struct
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import trimesh

from shapeviz_report.executor import LocalExecutor, memory_share
from shapeviz_report.features import compute_histograms, fixed_edges
from shapeviz_report.mesh import collect_files, prepare
from shapeviz_report.mesh.read import read_mesh
from shapeviz_report.types import Mesh

TIME_LIMIT = 20.0
"""Seconds a case may take: none of them is large."""

MEMORY_LIMIT = 4 * 2**30
"""Bytes of address space a worker may take beyond what its libraries take."""

EDGE_LENGTH = 0.03

_INSIDES = re.compile(
    r"NoneType|has no attribute|out of bounds|index out of range|broadcast|dtype|argument|unpack|\baxis\b|\barray\b|"
    r"invalid literal|codec|subscript|Error\b|not supported between|allocate|divide|empty (range|sequence)|"
    r"expected (str|bytes|int)|process working on it ended",
    re.IGNORECASE,
)
"""What a message says only if it was written for programmers."""

Case = tuple[str, str, bytes]
"""What it is, the file's name, and its content."""


def try_case(path: Path) -> str:
    """Bring one file through; ``used``, or a complaint that begins with ``!``. Raises ``MeshError`` as a refusal."""
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, hard))
    if not np.isfinite(read_mesh(path).faces).all():
        return "! a face is not finite"
    mesh, facts = prepare(collect_files(path), EDGE_LENGTH)
    if not np.isfinite(mesh.vertices).all() or not np.isfinite(facts.deviation):
        return "! the prepared mesh is not finite"
    if np.linalg.norm(mesh.vertices, axis=1).max() > 1 + 1e-9:
        return "! the prepared mesh is larger than the unit ball"
    features = compute_histograms(mesh, fixed_edges(), by_area=True)
    if not np.isfinite(features).all():
        return "! a feature is not finite"
    if not np.allclose(features.reshape(-1, 10).sum(axis=1), 1):
        return "! a histogram does not add up to 1"
    return "used"


def whole_files(folder: Path) -> dict[str, bytes]:
    """A small valid file of every format, by name."""
    shape = trimesh.creation.icosphere(subdivisions=1)
    shape.apply_scale((1, 0.7, 0.5))
    files: dict[str, bytes] = {}
    for suffix in ("off", "obj", "ply", "stl", "glb", "3mf", "dae"):
        path = folder / f"whole.{suffix}"
        shape.export(path)
        files[path.name] = path.read_bytes()
    shape.export(folder / "text.ply", encoding="ascii")
    shape.export(folder / "text.stl", file_type="stl_ascii")
    files |= {name: (folder / name).read_bytes() for name in ("text.ply", "text.stl")}
    for name, content in shape.scene().export(file_type="gltf", embed_buffers=True).items():
        files[name.replace("model", "whole")] = content
    corners = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 1.5)]
    lines = [*(f"v {x} {y} {z}" for x, y, z in corners), "vt 0 0", "f 4/1 3/1 2/1 1/1"]
    files["polygons.obj"] = "\n".join(
        [*lines, *(f"f -{5 - i}/1 -{5 - (i + 1) % 4}/1 -1/1" for i in range(4))]
    ).encode()
    return files


HOSTILE = (
    b"nan", b"inf", b"-inf", b"1e300", b"-1e300", b"1e-310", b"1e400", b"-1", b"0", b"4294967295", b"9999999999999",
    b"99999999999999999999999", b"1e6", b"0x10", b"1,5", b"", b"\xff\xfe", b"\x00", b"-2147483649", b"3.5", b"zero",
)  # fmt: skip
"""Tokens that stand where a reader expects another."""

_TOKEN = re.compile(rb"[^\s<>\"',:{}\[\]]+")
_NUMBER = re.compile(rb"(?<![\w.])-?\d[\w.+-]*")


def flip_bits(data: bytes, random: np.random.Generator) -> bytes:
    """A few bits changed anywhere."""
    changed = bytearray(data)
    for place in random.integers(len(data), size=random.integers(1, 9)):
        changed[place] ^= 1 << int(random.integers(8))
    return bytes(changed)


def cut_off(data: bytes, random: np.random.Generator) -> bytes:
    """The beginning only."""
    return data[: random.integers(1, len(data))]


def cut_out(data: bytes, random: np.random.Generator) -> bytes:
    """A piece missing from the middle."""
    start, end = np.sort(random.integers(len(data), size=2))
    return data[:start] + data[end:]


def swap_lines(data: bytes, random: np.random.Generator) -> bytes:
    """One line left out, doubled or moved."""
    lines = data.split(b"\n")
    place, other = random.integers(len(lines), size=2)
    line = lines[place] if random.random() < 0.5 else lines.pop(place)
    if random.random() < 0.7:
        lines.insert(int(other), line)
    return b"\n".join(lines)


def put_hostile_token(data: bytes, random: np.random.Generator) -> bytes:
    """A token replaced by a number, or no number, that nobody reckons with."""
    pattern = _NUMBER if random.random() < 0.8 else _TOKEN
    # As many cases for the header, whose counts rule the rest, as for all that follows.
    found = [m.span() for m in pattern.finditer(data)]
    start, end = found[random.integers(min(len(found), 12) if random.random() < 0.5 else len(found))]
    return data[:start] + HOSTILE[random.integers(len(HOSTILE))] + data[end:]


def put_hostile_number(data: bytes, random: np.random.Generator) -> bytes:
    """Four or eight bytes replaced by an extreme binary number, in either byte order."""
    kind = random.choice(["<I", ">I", "<f", ">f", "<d", ">d"])
    values: list[float] = [0, 1, 2**31, 2**32 - 1] if kind[1] == "I" else [np.nan, np.inf, 1e38, -1e38, 1e-45]
    number = struct.pack(kind, values[random.integers(len(values))])
    place = int(random.integers(min(len(data), 400) if random.random() < 0.5 else len(data)))
    return data[:place] + number + data[place + len(number) :]


def turn_bytes(data: bytes, random: np.random.Generator) -> bytes:
    """The wrong byte order from somewhere on."""
    start = int(random.integers(min(len(data), 200)))
    end = start + (len(data) - start) // 4 * 4
    return data[:start] + np.frombuffer(data[start:end], "<u4").byteswap().tobytes() + data[end:]


def repeat_piece(data: bytes, random: np.random.Generator) -> bytes:
    """A piece many times over."""
    start = int(random.integers(len(data)))
    piece = data[start : start + int(random.integers(1, 40))]
    return data[:start] + piece * int(random.integers(2, 2000)) + data[start:]


MUTATIONS: tuple[Callable[[bytes, np.random.Generator], bytes], ...] = (
    flip_bits, cut_off, cut_out, swap_lines, put_hostile_token, put_hostile_number, turn_bytes, repeat_piece,
)  # fmt: skip


def mutated_files(folder: Path, random: np.random.Generator) -> Iterator[Case]:
    """Every file with every mutation once, and one with two of them."""
    for name, content in whole_files(folder).items():
        for mutate in MUTATIONS:
            yield f"{mutate.__name__} of {name}", name, mutate(content, random)
        first, second = random.choice(len(MUTATIONS), size=2)
        once = MUTATIONS[first](content, random)
        yield f"two mutations of {name}", name, MUTATIONS[second](once, random) if once else once
        others = [other for other in whole_files(folder) if other != name]
        yield f"{name} under another name", others[random.integers(len(others))], content
    # What a file announces costs nothing to write, and must cost nothing to refuse.
    count = int(10 ** random.uniform(9, 19))
    for name, text in {
        "counts.off": f"OFF\n{count} {count} 0\n0 0 0\n",
        "face.off": f"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n{count} 0 1 2\n",
        "counts.ply": "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {count}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n",
        "bare.ply": f"ply\nformat ascii 1.0\nelement nothing {count}\nproperty list uchar int a\nend_header\n",
    }.items():
        yield f"{count} announced", name, text.encode()
    yield "triangles announced", "counts.stl", bytes(80) + struct.pack("<I", 2**32 - 1) + bytes(50)


def grid(rows: int, columns: int, wrap: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> Mesh:
    """A grid of triangles whose vertices lie where ``wrap`` puts the parameters in [0, 1]; seams are not joined."""
    u, v = (x.ravel() for x in np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1)))
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    a, b, c, d = corner, corner + 1, corner + columns + 2, corner + columns + 1
    return Mesh(wrap(u, v), np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.int32))


def moebius_band(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    angle, across = 2 * np.pi * u, 0.4 * (v - 0.5)
    radius = 1 + across * np.cos(angle / 2)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), across * np.sin(angle / 2)], axis=1)


def klein_bottle(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """The figure-eight immersion."""
    angle, section = 2 * np.pi * u, 2 * np.pi * v
    radius = 2 + np.cos(angle / 2) * np.sin(section) - np.sin(angle / 2) * np.sin(2 * section)
    height = np.sin(angle / 2) * np.sin(section) + np.cos(angle / 2) * np.sin(2 * section)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1)


def flat(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return np.stack([u, v, 0 * u], axis=1)


def strange_surfaces(random: np.random.Generator) -> Iterator[tuple[str, Mesh]]:
    """Surfaces that are hard to prepare or to describe."""
    ball = trimesh.creation.icosphere(subdivisions=2)
    round_shape = Mesh(ball.vertices * random.uniform(0.3, 1, 3), ball.faces.astype(np.int32))
    vertices, faces = round_shape.vertices, round_shape.faces

    for size in (1e-300, 1e-160, 1e-18, 1e18, 1e150, 1e300):
        yield f"a ball of size {size:g}", Mesh(vertices * size, faces)
    for offset in (1e4, 1e8, 1e12, 1e15):
        yield f"a ball {offset:g} from the origin", Mesh(vertices + offset, faces)
    yield "a ball with denormal coordinates", Mesh(vertices * 1e-310, faces)
    for value in (np.nan, np.inf, 1e300):
        broken = vertices.copy()
        broken[random.integers(len(broken), size=5), random.integers(3, size=5)] = value
        yield f"a ball with {value} in it", Mesh(broken, faces)

    count = int(random.integers(3, 200))
    points = random.normal(size=(count, 3)) * 10.0 ** random.integers(-3, 4)
    yield (
        f"soup of {count} vertices",
        Mesh(points, random.integers(count, size=(3 * count, 3)).astype(np.int32)),
    )
    lattice = random.integers(0, 4, (60, 3)).astype(float)
    yield "soup on a lattice", Mesh(lattice, random.integers(60, size=(150, 3)).astype(np.int32))
    scattered = random.normal(size=(900, 3)) + np.repeat(random.normal(size=(300, 3)) * 3, 3, axis=0)
    yield "triangles apart", Mesh(scattered, np.arange(900, dtype=np.int32).reshape(-1, 3))
    yield "one triangle", Mesh(random.normal(size=(3, 3)), np.array([[0, 1, 2]], np.int32))
    yield (
        "one needle",
        Mesh(np.array([[0, 0, 0], [1, 0, 0], [0.5, 1e-7, 0]]), np.array([[0, 1, 2]], np.int32)),
    )
    yield (
        "one tetrahedron",
        Mesh(random.normal(size=(4, 3)), np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]], np.int32)),
    )
    folded = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    yield "one triangle from both sides", Mesh(folded, np.array([[0, 1, 2], [0, 2, 1]], np.int32))
    apart = np.concatenate([folded, folded])
    yield "two triangles in one place", Mesh(apart, np.array([[0, 1, 2], [3, 5, 4]], np.int32))

    yield "a flat sheet", grid(9, 9, flat)
    yield "a sheet folded flat", grid(8, 8, lambda u, v: np.stack([np.abs(u - 0.5), v, 0 * u], axis=1))
    for ratio in (1e3, 1e6, 1e9):
        yield (
            f"a sheet {ratio:g} times as long as wide",
            grid(2, 30, lambda u, v, r=ratio: np.stack([u * r, v, 0 * u], axis=1)),
        )
        yield (
            f"a box {ratio:g} times as long as wide",
            Mesh(trimesh.creation.box((ratio, 1, 1)).vertices, trimesh.creation.box().faces),
        )
    yield "a line of faces without area", grid(3, 9, lambda u, v: np.stack([u, u, u + 1e-18 * v], axis=1))
    yield "Moebius band", grid(4, 40, moebius_band)
    yield "Klein bottle", grid(24, 24, klein_bottle)
    blades = int(random.integers(3, 40))
    angles = np.linspace(0, 2 * np.pi, blades, endpoint=False)
    rim = np.stack([np.cos(angles), np.sin(angles), 0.5 + 0 * angles], axis=1)
    hub = np.array([[0, 0, 0], [0, 0, 1.0]])
    wheel = np.stack([0 * np.arange(blades), 1 + 0 * np.arange(blades), 2 + np.arange(blades)], axis=1)
    yield f"{blades} faces on one edge", Mesh(np.concatenate([hub, rim]), wheel.astype(np.int32))
    fan = np.stack(
        [np.zeros(blades), 1 + np.arange(blades), 1 + (np.arange(blades) * 7 + 1) % blades], axis=1
    )
    yield "a fan in disorder", Mesh(np.concatenate([hub[:1], rim]), fan.astype(np.int32))
    yield (
        "a ball and the same inside out",
        Mesh(
            np.concatenate([vertices, vertices]),
            np.concatenate([faces, faces[:, ::-1] + len(vertices)]).astype(np.int32),
        ),
    )
    yield (
        "a ball five times",
        Mesh(np.tile(vertices, (5, 1)), np.concatenate([faces + i * len(vertices) for i in range(5)])),
    )
    small = trimesh.creation.icosphere(subdivisions=0)
    places = random.normal(size=(1000, 3)) * random.choice([0.5, 10, 1000])
    yield (
        "a thousand parts",
        Mesh(
            (small.vertices[None] + places[:, None]).reshape(-1, 3),
            (small.faces[None] + 12 * np.arange(1000)[:, None, None]).reshape(-1, 3).astype(np.int32),
        ),
    )
    needles = grid(1, 400, lambda u, v: np.stack([np.cos(7 * u), np.sin(7 * u), v], axis=1))
    yield "needles", Mesh(needles.vertices * [1, 1, 10.0 ** random.integers(-7, 3)], needles.faces)
    noisy = vertices + random.normal(size=vertices.shape) * 10.0 ** random.uniform(-4, 0)
    yield "a noisy ball", Mesh(noisy, faces)
    torn = Mesh(vertices[faces].reshape(-1, 3), np.arange(faces.size, dtype=np.int32).reshape(-1, 3))
    shaken = torn.vertices + random.normal(size=torn.vertices.shape) * 10.0 ** random.uniform(-8, -2)
    yield "a ball with cracks", Mesh(shaken, torn.faces)
    turned = faces.copy()
    backward = random.random(len(faces)) < 0.5
    turned[backward] = turned[backward, ::-1]
    yield "a ball wound at random", Mesh(vertices, turned)
    yield "a ball with holes", Mesh(vertices, faces[random.random(len(faces)) < 0.5])
    far = np.concatenate([vertices, vertices * 1e-6 + 50])
    yield "a ball and a speck", Mesh(far, np.concatenate([faces, faces + len(vertices)]))
    leaves = grid(1, 1, flat)
    book = np.concatenate([leaves.vertices + np.array([0, 0, 1e-4 * i]) for i in range(1000)])
    yield (
        "a book of a thousand leaves",
        Mesh(book, np.concatenate([leaves.faces + 4 * i for i in range(1000)])),
    )


def as_ply(mesh: Mesh) -> bytes:
    """A mesh as it is to the last bit."""
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh.vertices)}\nproperty double x\n"
        f"property double y\nproperty double z\nelement face {len(mesh.faces)}\nproperty list int int vertex_indices\n"
        "end_header\n"
    )
    rows = np.column_stack([np.full(len(mesh.faces), 3), mesh.faces]).astype("<i4")
    return header.encode() + mesh.vertices.astype("<f8").tobytes() + rows.tobytes()


def cases(seed: int, folder: Path) -> Iterator[Case]:
    """All cases of one round."""
    random = np.random.default_rng(seed)
    yield from mutated_files(folder, random)
    for title, mesh in strange_surfaces(random):
        yield title, "surface.ply", as_ply(mesh)


def main() -> None:
    """Run rounds of cases; exit code 1 if anything is to be reported."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, default=0, help="of the first round")
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument(
        "--keep", type=Path, default=Path("build/fuzzing"), help="where files of reported cases go"
    )
    parser.add_argument("--reasons", action="store_true", help="print every reason of a refusal once")
    arguments = parser.parse_args()
    found, refusals = Counter[str](), Counter[str]()
    with (
        tempfile.TemporaryDirectory() as name,
        LocalExecutor(arguments.jobs, TIME_LIMIT, memory_share(arguments.jobs)) as executor,
    ):
        folder = Path(name)
        for seed in range(arguments.seed, arguments.seed + arguments.rounds):
            titles, paths = [], []
            for title, file, content in cases(seed, folder):
                path = folder / f"{seed}-{len(paths)}-{file}"
                path.write_bytes(content)
                titles.append(title)
                paths.append(path)
            for outcome in executor.run(try_case, [(path,) for path in paths]):
                verdict = outcome.reason or outcome.value
                bad = verdict.startswith("!") or bool(_INSIDES.search(verdict)) or "took longer" in verdict
                found["reported" if bad else "refused" if outcome.reason else "used"] += 1
                if outcome.reason and not bad:
                    refusals[re.sub(r"[-+]?[\d.,]+(e[-+]?\d+)?", "N", verdict)] += 1
                path = paths[outcome.index]
                if bad:
                    print(f"seed {seed}, {titles[outcome.index]} ({path.name}): {verdict}", flush=True)
                    arguments.keep.mkdir(parents=True, exist_ok=True)
                    (arguments.keep / path.name).write_bytes(path.read_bytes())
                path.unlink()
    print(", ".join(f"{count} {what}" for what, count in sorted(found.items())))
    if arguments.reasons:
        for reason, count in refusals.most_common():
            print(f"{count:6} {reason}")
    sys.exit(bool(found["reported"]))


if __name__ == "__main__":
    # Workers import what they run by name, and this module's own name is another while it is the program.
    from benchmarks import fuzzing

    fuzzing.main()
