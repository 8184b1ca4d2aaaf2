"""What a site will weigh, before anything is computed, and which hosts would not take it."""

from __future__ import annotations

from dataclasses import dataclass

from shapeviz_report.config import Config
from shapeviz_report.glb import find_dimensions
from shapeviz_report.models import MANY
from shapeviz_report.pages.base import MOST_IN_FULL, ROWS_A_FILE, thumbnail_size


@dataclass(frozen=True)
class Weight:
    """What a site weighs, about.

    Attributes
    ----------
    bytes, models, exported : int
        In all, and of that the 3D models of the pages, and the files of glTF.
    files, folder : int
        In all, and most in one folder.
    largest : int
        Bytes of the largest file.
    """

    bytes: int
    models: int
    exported: int
    files: int
    folder: int
    largest: int


@dataclass(frozen=True)
class Host:
    """What a host of static sites takes at most; None where it names no limit."""

    name: str
    bytes: int | None = None
    files: int | None = None
    folder: int | None = None
    largest: int | None = None


HOSTS = (
    Host("GitHub Pages", bytes=10**9, largest=100 * 2**20),
    Host("GitLab Pages", bytes=10**9),
    Host("Cloudflare Pages", files=20_000, largest=25 * 2**20),
    Host("Hugging Face", folder=10_000),
)
"""As their documentation says, for plans that cost nothing."""

BASE, BASE_FILES = 8_000_000, 200
"""Bytes and files of a site beside those of its shapes."""

MODEL, MODEL_OF_MANY, VALUES, FACTS, ROW = 64_000, 22_000, 3_500, 1_400, 500
"""Bytes of a shape: its 3D model, its features for the browser, what is known of it, of that its row of a table."""

FEATURES = 10_000
"""Bytes of the features of a shape for download, as arrays, of not too many shapes, or as Parquet."""

OF_COLUMNS = 300
"""Files of single bins, where the values of all do not go into one."""

PICTURE, PICTURE_SIZE, PICTURE_POWER = 6_300, 320, 1.1
"""Bytes of a thumbnail of so many pixels, and the power of its size with which they grow."""


VERTICES, VERTICES_OF_MANY, VERTICES_PREPARED = 2_000, 560, 9_500
"""Of a shape in glTF: simplified, simplified of many shapes, and in full."""

VERTEX, VALUE = 24, 4
"""Bytes of a vertex in glTF with its two triangles, and of a value at it."""


def weigh(shapes: int, config: Config) -> Weight:
    """What a site of so many shapes will weigh, by those that were measured: to a third, of odd meshes to a half."""
    many = shapes > MOST_IN_FULL
    picture = PICTURE * (thumbnail_size(config, shapes) / PICTURE_SIZE) ** PICTURE_POWER
    # Once as files, and once more in parts for the browser; of very many the parts alone.
    pictures = int(shapes * picture * (1 if many else 2))
    features = shapes * FEATURES
    of_models = shapes * (MODEL if shapes <= MANY else MODEL_OF_MANY) if config.meshes else 0
    vertices = VERTICES if shapes <= MANY else VERTICES_OF_MANY
    if config.gltf == "prepared":
        vertices = VERTICES_PREPARED
    values = len(find_dimensions(config.gltf_values))
    exported = shapes * vertices * (VERTEX + VALUE * values) if config.gltf is not None else 0
    singles = (shapes if config.meshes else 0, 0 if many else shapes, shapes if exported else 0)
    parts = shapes // 32 + shapes // 200 + (shapes // 25 + OF_COLUMNS if many else 0)
    return Weight(
        bytes=BASE
        + pictures
        + (0 if many else features)
        + (features if config.parquet else 0)
        + shapes * (VALUES + FACTS)
        + of_models
        + exported,
        models=of_models,
        exported=exported,
        files=BASE_FILES + sum(singles) + parts,
        folder=max(*singles, parts),
        # What the pages load comes in parts.
        largest=max(
            2_000_000,
            shapes * ROW,
            min(shapes, ROWS_A_FILE) * FEATURES * (not many),
            features * bool(config.parquet),
        ),
    )


def refusals(weight: Weight) -> list[str]:
    """The hosts that would not take a site, each with its limit, in words."""
    said = []
    for host in HOSTS:
        limits = (
            (host.bytes, weight.bytes, "{} in all"),
            (host.largest, weight.largest, "{} a file"),
            (host.files, weight.files, "{} files"),
            (host.folder, weight.folder, "{} files a folder"),
        )
        broken = [
            words.format(f"{limit:,}" if "files" in words else in_words(limit))
            for limit, found, words in limits
            if limit is not None and found > limit
        ]
        if broken:
            said.append(f"{host.name} ({', '.join(broken)})")
    return said


def in_words(size: int) -> str:
    """A number of bytes as one would say it."""
    if size % 2**20 == 0:
        return f"{size // 2**20} MiB"
    return f"{size / 1e9:.1f} GB" if size >= 1e9 else f"{size / 1e6:.0f} MB"


def note(shapes: int, config: Config) -> str | None:
    """A sentence for who builds a site that some hosts would not take; None for one that all take."""
    weight = weigh(shapes, config)
    refusing = refusals(weight)
    if not refusing:
        return None
    text = (
        f"the site will weigh about {in_words(weight.bytes)} in {weight.files:,} files, more than these hosts take: "
        f"{'; '.join(refusing)}."
    )
    if weight.models:
        text += f" Of that, 3D models are {in_words(weight.models)}, which --no-meshes leaves out."
    if weight.exported:
        text += f" Files of glTF are {in_words(weight.exported)} of it."
    return text
