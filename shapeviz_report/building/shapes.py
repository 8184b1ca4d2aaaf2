"""What a build makes of each shape alone: facts, a picture, features, and its files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from hashlib import sha256
from typing import Any, overload

import numpy as np

from shapeviz_report.building import stages
from shapeviz_report.building.chains import Chain, Plan
from shapeviz_report.building.measuring import Files, find_edges
from shapeviz_report.building.runner import Made, Runner
from shapeviz_report.config import Config
from shapeviz_report.copies import Outline
from shapeviz_report.models import faces_of_model
from shapeviz_report.presets import PRESETS
from shapeviz_report.render import Renderer
from shapeviz_report.types import Exported, FloatArray, ShapeEntry, ShapeFacts

PAINTING_SIZE = 320
"""Width and height of a picture of a bin, in pixels."""


@dataclass
class MadeShape:
    """What is made of a shape.

    Attributes
    ----------
    facts : ShapeFacts
    outline : Outline
        By which its copies are found.
    picture : bytes
        Its thumbnail.
    model : str
        The key of its 3D model in the cache.
    exported : (str, str) or None
        The name of its glTF file, and the key of its content in the cache.
    """

    facts: ShapeFacts
    outline: Outline
    picture: bytes
    model: str
    exported: tuple[str, str] | None


@dataclass
class MadeShapes:
    """What is made of the shapes; those that failed are missing.

    Attributes
    ----------
    edges : (D, 11) float64 array
        Of the histograms.
    shapes : dict of str to MadeShape
        By id.
    rows : dict of str to (w,) float64 array
        The features of each.
    """

    edges: FloatArray
    shapes: dict[str, MadeShape] = field(default_factory=dict)
    rows: dict[str, FloatArray] = field(default_factory=dict)


class ShapeMaker:
    """Makes what is made of each shape alone, a task a shape.

    Parameters
    ----------
    run : Runner
    meshes : mapping of str to callable
        The files of each shape, by id.
    config : Config
        With the size of thumbnails.
    renderer : Renderer
        Draws them.
    gltf_dimensions : mapping of str to int
        What glTF files carry at vertices, as :func:`~shapeviz_report.glb.find_dimensions` gives it.
    """

    def __init__(
        self,
        run: Runner,
        meshes: Mapping[str, Files],
        config: Config,
        renderer: Renderer,
        gltf_dimensions: Mapping[str, int],
    ) -> None:
        self._run = run
        self._meshes = meshes
        self._config = config
        self._renderer = renderer
        self._gltf_dimensions = gltf_dimensions
        self._preset = PRESETS[config.preset]
        self._faces = faces_of_model(len(meshes))
        # a site in one file has no place for them
        self._exports = config.gltf is not None and not config.single_file

    def make(self) -> MadeShapes:
        """All that is made of the shapes."""
        edges, kept = find_edges(self._run, self._meshes, self._preset, self._config.edge_length)
        made = MadeShapes(edges)
        described: list[stages.Stage[Any]] = [stages.DESCRIBE]
        if self._preset.whole:
            described.append(stages.DESCRIBE_WHOLE)
        wanted: list[stages.Stage[Any]] = [stages.FACTS, stages.EXAMINE, stages.RENDER, *described]
        if self._exports:
            wanted.append(stages.EXPORT)

        def take(shape: str, chain: Chain, found: dict[stages.Stage[Any], Any]) -> None:
            exported = None
            if self._exports:
                name = f"{sha256(found[stages.EXPORT]).hexdigest()[:20]}.glb"
                exported = (name, chain.key(stages.EXPORT))
            made.shapes[shape] = MadeShape(
                found[stages.FACTS],
                found[stages.EXAMINE].outline,
                found[stages.RENDER],
                chain.key(stages.DESCRIBE),
                exported,
            )
            made.rows[shape] = np.concatenate([found[stage] for stage in described])

        self._run.each("Measuring shapes", kept, wanted, partial(self._plan, edges), take)
        return made

    def plan_painting(self, edges: FloatArray, shape: str, bins: tuple[tuple[int, int], ...]) -> Plan:
        """How some bins are painted on a shape, each by its dimension and place, both from 0."""
        chain, files = self._plan(edges, shape)
        chain.add(stages.PAINT, [stages.PREPARE, stages.VIEW], edges, bins, PAINTING_SIZE, self._renderer)
        return chain, files

    def recall_models(self, made: MadeShapes, shapes: Sequence[ShapeEntry]) -> Sequence[bytes]:
        """The 3D models of some shapes."""
        keys = [made.shapes[shape.id].model for shape in shapes]
        return self._recall(stages.DESCRIBE, stages.read_model, made.edges, shapes, keys)

    def recall_exported(self, made: MadeShapes, shapes: Sequence[ShapeEntry]) -> Exported | None:
        """The glTF files of some shapes, where they are asked for."""
        files = [file for file in (made.shapes[shape.id].exported for shape in shapes) if file is not None]
        if not files:
            return None
        names, keys = zip(*files, strict=True)
        return Exported(names, self._recall(stages.EXPORT, bytes, made.edges, shapes, keys))

    def _recall(
        self,
        stage: stages.Stage[Any],
        read: Callable[[bytes], bytes],
        edges: FloatArray,
        shapes: Sequence[ShapeEntry],
        keys: Sequence[str],
    ) -> Recalled:
        """What a stage made of some shapes, whose results have these keys."""
        made = [
            Made(shape.id, key, partial(self._plan, edges, shape.id))
            for shape, key in zip(shapes, keys, strict=True)
        ]
        return Recalled(self._run, stage, read, made)

    def _plan(self, edges: FloatArray, shape: str) -> Plan:
        """The stages of a shape."""
        config = self._config
        files = self._meshes[shape]()
        chain = Chain(stages.identify(files))
        chain.add(stages.PREPARE, (), config.edge_length)
        chain.add(stages.FACTS, [stages.PREPARE])
        chain.add(stages.EXAMINE)
        chain.add(stages.VIEW, [stages.PREPARE], config.up)
        seen: list[stages.Stage[Any]] = [stages.PREPARE, stages.VIEW]
        chain.add(stages.RENDER, seen, config.thumbnail_size, self._renderer, config.clay)
        chain.add(stages.DESCRIBE, seen, edges, self._preset.by_area, self._faces, config.clay)
        if self._exports:
            faces = self._faces if config.gltf == "decimated" else None
            chain.add(stages.EXPORT, seen, faces, self._gltf_dimensions, config.clay)
        if self._preset.whole:
            chain.add(stages.DESCRIBE_WHOLE, [stages.PREPARE])
        return chain, files


class Recalled(Sequence[bytes]):
    """What a stage made of each shape, read when asked for: 3D models of 100,000 are several gigabytes."""

    def __init__(
        self,
        run: Runner,
        stage: stages.Stage[Any],
        read: Callable[[bytes], bytes],
        made: Sequence[Made],
    ) -> None:
        self._run = run
        self._stage = stage
        self._read = read
        self._made = made

    def __len__(self) -> int:
        return len(self._made)

    @overload
    def __getitem__(self, place: int) -> bytes: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[bytes]: ...
    def __getitem__(self, place: int | slice) -> bytes | Sequence[bytes]:
        if isinstance(place, slice):
            return Recalled(self._run, self._stage, self._read, self._made[place])
        return self._read(self._run.recall(self._stage, self._made, place))
