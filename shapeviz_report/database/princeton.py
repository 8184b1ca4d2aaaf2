"""The Princeton Shape Benchmark's classification files (``.cla``), with their hierarchy of classes.

The format, version 1, as the benchmark documents it (Shilane et al., *The Princeton Shape Benchmark*, 2004)::

    PSB 1
    numCategories numModels

    className parentClassName numModelsInClass
    modelId
    ...

Tokens are separated by any white space. The parent ``0`` is the root; a parent stands before its children;
class names are unique; a class may have no models of its own. The class that is called ``-1`` collects what
belongs to no class: the benchmark's tools leave it out of every statistic, so here its models have no label.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from shapeviz_report.database.base import Layout, database_name, shape_ids, shape_names, sorted_shapes
from shapeviz_report.database.folder import MeshFile, leads_outside, scan_folder
from shapeviz_report.database.formats import MESH_SUFFIXES, split_name, suffix_of
from shapeviz_report.database.text import clean, decode
from shapeviz_report.errors import DatabaseError
from shapeviz_report.files import read_regular
from shapeviz_report.order import natural
from shapeviz_report.types import Database, Failure, ShapeEntry

CLASSIFICATION_FOLDER = "classification"
ROOT_CLASS = "0"
NO_CLASS = "-1"
MOST_BYTES = 4 * 1024**2
"""Size of the largest file that is read; the benchmark's have 10 kB."""
MOST_LEVELS = 20
"""Classes above one another; each level becomes a labeling. The benchmark has 4."""

_SPLIT_NAME = re.compile(r"(.*?)[-_ ]?(train|test)", re.IGNORECASE)

_PADDED_NAME = re.compile(r"[A-Za-z]*[-_]?0*([0-9]+)")


@dataclass(frozen=True)
class Category:
    """One class of a ``.cla`` file; ``parent`` is None at the top."""

    name: str
    parent: str | None
    models: tuple[str, ...]


@dataclass(frozen=True)
class Classification:
    """One labeling: a ``.cla`` file, or the two halves ``train`` and ``test`` of one.

    Attributes
    ----------
    name : str
    classes : mapping of str to str
        Model -> class, without the models that have none.
    parents : mapping of str to str
        Class -> parent class; a top class has no entry.
    """

    name: str
    classes: Mapping[str, str]
    parents: Mapping[str, str]

    def chain(self, label: str) -> tuple[str, ...]:
        """A class and the classes above it, from the top down."""
        chain = [label]
        while chain[0] in self.parents:
            chain.insert(0, self.parents[chain[0]])
        return tuple(chain)


class Princeton(Layout):
    """Princeton ``.cla`` files and the models ``m123.off`` that they list, anywhere below the same folder.

    Every file is a labeling; ``train.cla`` and ``test.cla`` of one folder are two halves of one, and the half
    becomes the metadata ``split``. Every coarser level of a hierarchy is a labeling as well.
    """

    name = "princeton"
    description = (
        "Princeton classification files: *.cla, or classification/**/*.cla, and models m123.off below"
    )

    def recognises(self, path: Path, outside: bool) -> bool:
        return bool(_classification_files(path))

    def read(self, path: Path, outside: bool) -> Database:
        files = _classification_files(path)
        if not files:
            raise DatabaseError(
                f"{path} holds no .cla file, neither in the folder itself nor in {CLASSIFICATION_FOLDER}/."
            )
        root = _root_of(path)
        warnings: list[str] = []
        for file in files:
            if path.is_dir() and not outside and leads_outside(file, path):
                raise DatabaseError(
                    f"{file} is a link to {os.path.realpath(file)}, outside the database's folder, and is not read. "
                    "Copy it into the folder, or use --outside."
                )
        categories = {file: _read_cla(file, warnings) for file in files}
        classifications = _combine(categories, root, warnings)
        listed_in: dict[str, Path] = {}
        splits: dict[str, str] = {}
        for file, found in categories.items():
            for model in (model for category in found for model in category.models):
                listed_in.setdefault(model, file)
                if split := _split_of(file)[1]:
                    splits.setdefault(model, split)
        meshes, unlisted = _find_models(listed_in, root, outside)
        if unlisted:
            warnings.append(f"{unlisted} mesh files below {root} are in no .cla file and are left out.")
        models = sorted(meshes, key=lambda model: (meshes[model].relative, model))
        ids = shape_ids([meshes[model].relative for model in models])
        labelings = {
            name: (classification, classes)
            for classification in classifications
            for name, classes in _levels(classification, models)
        }
        parents = {
            name: above
            for name, (classification, classes) in labelings.items()
            if (above := _parents_of(classification, set(classes.values())))
        }
        return Database(
            name=database_name(root),
            root=root,
            layout=self.name,
            shapes=sorted_shapes(
                ShapeEntry(
                    id,
                    meshes[model].path,
                    name,
                    labels={
                        name: classes[model] for name, (_, classes) in labelings.items() if model in classes
                    },
                    metadata={"split": splits[model]} if model in splits else {},
                )
                for id, name, model in zip(ids, shape_names(ids), models)
            ),
            labelings=tuple(labelings),
            parents=parents,
            failures=tuple(
                Failure(
                    f"m{model}.off",
                    "read",
                    f"{listed_in[model].relative_to(root).as_posix()} lists the model {model}, but below "
                    f"{root.name} there is no mesh called m{model} or {model}",
                )
                for model in sorted(set(listed_in) - set(meshes), key=natural)
            ),
            warnings=tuple(warnings),
        )


def _is_cla(name: str) -> bool:
    return suffix_of(name) == ".cla" and not name.startswith(".")


def _classification_files(path: Path) -> list[Path]:
    """The ``.cla`` files to read, sorted: the one given, those in the folder, or those of the benchmark."""
    if not path.is_dir():
        return [path] if _is_cla(path.name) else []
    try:
        if direct := [path / name for name in sorted(os.listdir(path)) if _is_cla(name)]:
            return direct
    except OSError:
        return []
    return sorted(
        Path(folder) / name
        for folder, _, names in os.walk(path / CLASSIFICATION_FOLDER)
        for name in names
        if _is_cla(name)
    )


def _root_of(path: Path) -> Path:
    """The folder below which the models lie; for a file in the benchmark's tree, that of the benchmark."""
    if path.is_dir():
        return path
    for folder in path.parents:
        if folder.name == CLASSIFICATION_FOLDER:
            return folder.parent
    return path.parent


def _split_of(file: Path) -> tuple[str, str]:
    """The name of a file's classification, and its half: ``coarse1Train.cla`` is ``("coarse1", "train")``."""
    if match := _SPLIT_NAME.fullmatch(file.stem):
        return match[1], match[2].lower()
    return file.stem, ""


def _read_cla(file: Path, warnings: list[str]) -> tuple[Category, ...]:
    """Parse one file. Raises ``DatabaseError`` with the line where it is wrong."""
    try:
        text, _ = decode(read_regular(file, MOST_BYTES))
    except OSError as error:
        raise DatabaseError(f"The classification {file} cannot be read: {error.strerror}.") from error
    tokens = [(token, line) for line, content in enumerate(text.splitlines(), 1) for token in content.split()]
    position = 0

    def take(what: str) -> str:
        nonlocal position
        if position == len(tokens):
            raise DatabaseError(f"The classification {file} ends where {what} should follow; it is cut off.")
        position += 1
        return tokens[position - 1][0]

    def wrong(problem: str) -> DatabaseError:
        return DatabaseError(f"{file}, line {tokens[position - 1][1]}: {problem}.")

    def take_count(what: str) -> int:
        token = take(what)
        if not (token.isascii() and token.isdigit() and len(token) < 16):
            raise wrong(f"'{token}' stands where {what} should")
        return int(token)

    if take("'PSB 1'") != "PSB":
        raise DatabaseError(f"{file} is not a Princeton classification: it does not begin with 'PSB 1'.")
    if (version := take("the version")) != "1":
        raise DatabaseError(f"{file} has version {version} of the Princeton format; only version 1 is known.")
    announced = take_count("the number of classes"), take_count("the number of models")
    categories: dict[str, Category] = {}
    level = {ROOT_CLASS: 0}
    while position < len(tokens):
        name, parent = clean(take("a class")), clean(take("the parent of a class"))
        if name in categories:
            raise wrong(f"the class '{name}' is defined a second time")
        if parent != ROOT_CLASS and parent not in categories:
            raise wrong(f"the parent '{parent}' of the class '{name}' is not defined above it")
        level[name] = level[parent] + 1
        if level[name] > MOST_LEVELS:
            raise wrong(f"the class '{name}' lies more than {MOST_LEVELS} levels deep")
        count = take_count(f"the number of models of the class '{name}'")
        models = tuple(take(f"a model of the class '{name}'") for _ in range(count))
        categories[name] = Category(name, None if parent == ROOT_CLASS else parent, models)
    held = len(categories), sum(len(category.models) for category in categories.values())
    if announced != held:
        warnings.append(
            f"{file.name} announces {announced[0]} classes and {announced[1]} models, "
            f"but holds {held[0]} classes and {held[1]} models."
        )
    return tuple(categories.values())


def _combine(
    categories: Mapping[Path, Sequence[Category]], root: Path, warnings: list[str]
) -> list[Classification]:
    """The classifications of some files, the one with most classes first."""
    halves: dict[tuple[Path, str], list[Path]] = {}
    for file in categories:
        halves.setdefault((file.parent, _split_of(file)[0]), []).append(file)
    short = [stem or ("class" if folder == root else folder.name) for folder, stem in halves]
    classifications = []
    for (folder, stem), name in zip(list(halves), short):
        if short.count(name) > 1:
            name = (folder / stem).relative_to(root).as_posix()
        classes: dict[str, str] = {}
        parents: dict[str, str | None] = {}
        for file in halves[folder, stem]:
            for category in categories[file]:
                if parents.setdefault(category.name, category.parent) != category.parent:
                    warnings.append(
                        f"In {file.name} the class '{category.name}' has another parent than in the file "
                        f"before; it keeps '{parents[category.name] or ROOT_CLASS}'."
                    )
                if category.name == NO_CLASS:
                    continue
                for model in category.models:
                    if classes.setdefault(model, category.name) != category.name:
                        warnings.append(
                            f"In {file.name} the model {model} is in a second class, '{category.name}'; "
                            f"it keeps '{classes[model]}'."
                        )
        above = {name: parent for name, parent in parents.items() if parent is not None}
        classifications.append(Classification(name, classes, above))
    return sorted(classifications, key=lambda found: (-len(set(found.classes.values())), natural(found.name)))


def _levels(classification: Classification, models: Sequence[str]) -> list[tuple[str, dict[str, str]]]:
    """A classification as labelings, from the finest to the coarsest: name, and model -> class.

    Level 1 has the top classes, level 2 those below, and so on; a class that ends above a level stands for
    itself there. A level that does not differ from the finer one is left out.
    """
    chains = {
        model: classification.chain(classification.classes[model])
        for model in models
        if model in classification.classes
    }
    if not chains:
        return []
    levels = [(classification.name, {model: chain[-1] for model, chain in chains.items()})]
    for depth in range(max(map(len, chains.values())) - 1, 0, -1):
        classes = {model: chain[min(depth, len(chain)) - 1] for model, chain in chains.items()}
        if classes != levels[-1][1]:
            levels.append((f"{classification.name}, level {depth}", classes))
    return levels


def _parents_of(classification: Classification, labels: set[str]) -> dict[str, str]:
    """Class -> parent for some classes and all those above them."""
    chains = [classification.chain(label) for label in sorted(labels)]
    return {low: high for chain in chains for high, low in pairwise(chain)}


def _find_models(models: Mapping[str, Path], root: Path, outside: bool) -> tuple[dict[str, MeshFile], int]:
    """The mesh of every model that has one, and how many meshes belong to no model.

    The model 123 is the file ``m123.off`` as in the benchmark, or else ``123.off``, or else the only one whose
    name is that number after other letters or zeros, as ``D00123.off``. Of several such files the
    one with the first suffix in ``MESH_SUFFIXES`` is taken, then the first path.
    """
    suffixes = list(MESH_SUFFIXES)
    files = scan_folder(root, outside).files
    by_stem: dict[str, MeshFile] = {}
    for file in sorted(files, key=lambda file: (suffixes.index(split_name(file.relative)[1]), file.relative)):
        by_stem.setdefault(file.stem, file)
    padded: dict[str, list[MeshFile]] = {}
    for stem, file in by_stem.items():
        if match := _PADDED_NAME.fullmatch(stem):
            padded.setdefault(match[1], []).append(file)
    found = {}
    for model in models:
        exact = by_stem.get(f"m{model}") or by_stem.get(model)
        loose = padded.get(model.lstrip("0") or "0", []) if model.isascii() and model.isdigit() else []
        if mesh := exact or (loose[0] if len(loose) == 1 else None):
            found[model] = mesh
    taken = {file.stem for file in found.values()}
    return found, sum(file.stem not in taken for file in files)
