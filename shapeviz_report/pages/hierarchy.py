"""Classes of classes: the trees by which a reader walks down into a database."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from shapeviz_report.order import natural
from shapeviz_report.pages.chunks import Field, Hierarchy, Tree, TreeNode
from shapeviz_report.types import Report

#: What stands between a class and its parent in a value that names both.
SEPARATORS = (" > ", ">", "/")

#: Most nodes of a tree of folders; more are not for reading.
MOST_FOLDERS = 1000

#: Shapes that a folder holds on average, at the least. Many databases give every shape a folder of its own.
FEWEST_SHAPES_A_FOLDER = 2

#: The way from the top of a tree down to a class; None for a shape without one.
Chain = tuple[str, ...] | None


def describe_hierarchy(report: Report, fields: Sequence[Field]) -> Hierarchy:
    """The trees of a database: its active classes, with all above them, and whatever else is ordered in levels.

    Parameters
    ----------
    report : Report
    fields : sequence of Field
        All of the report. A column that is one of them, and whose values name their parents (``animal/biped``), is a
        tree too.

    Returns
    -------
    Hierarchy
    """
    trees: list[Tree] = []
    known: list[list[Chain]] = []

    def add(key: str, title: str, chains: list[Chain], *, active: bool = False) -> None:
        known.append(chains)
        nodes, of = _tree(chains)
        trees.append(
            {"key": key, "title": title, "active": active, "nodes": nodes, "of": np.array(of, np.int32)}
        )

    for field in fields:
        chains = _chains(report, field)
        if chains is None:
            continue
        deep = any(chain is not None and len(chain) > 1 for chain in chains)
        if field["active"] or (deep and not any(_is_level(chains, finer) for finer in known)):
            add(field["key"], field["title"], chains, active=field["active"])
    folders = _folders([shape.id for shape in report.shapes])
    if folders is not None and not any(_is_level(folders, finer) for finer in known):
        add("folders", "Folders", folders)
    return {"trees": trees}


def _chains(report: Report, field: Field) -> list[Chain] | None:
    """The class of every shape in a field of few values, with all above it; None for another field."""
    names, of = field["names"], field["of"]
    if names is None or of is None:
        return None
    kind, _, name = field["key"].partition(":")
    parents = report.database.parents.get(name, {}) if kind == "label" else {}
    if field["notes"] is not None:
        # Clusters are named after a shape: what stands in its name are its folders, no classes above the cluster.
        chains: list[Chain] = [(name,) for name in names]
    else:
        chains = _above(names, parents) if parents else _split(names)
    return [None if number < 0 else chains[number] for number in of]


def _above(names: Sequence[str], parents: Mapping[str, str]) -> list[Chain]:
    chains: list[Chain] = []
    for name in names:
        chain = [name]
        while (parent := parents.get(chain[0])) is not None and parent not in chain:
            chain.insert(0, parent)
        # A class that is named with its parents, as folders are, needs them only once.
        chains.append(
            tuple(low.removeprefix(f"{high}/") if high else low for high, low in zip([None, *chain], chain))
        )
    return chains


def _split(names: Sequence[str]) -> list[Chain]:
    """Values cut at the separator that makes levels of them: where different values share their beginning."""
    for separator in SEPARATORS:
        chains = [tuple(part.strip() for part in name.split(separator)) for name in names]
        tops = {chain[0] for chain in chains}
        if len(tops) < len(chains) and all(all(chain) for chain in chains):
            return list(chains)
    return [(name,) for name in names]


def _folders(ids: Sequence[str]) -> list[Chain] | None:
    """The folders of the shapes below those that hold all of them; None where they are no groups."""
    parts = [tuple(identifier.split("/")[:-1]) for identifier in ids]
    common = 0
    while all(len(part) > common and part[common] == parts[0][common] for part in parts):
        common += 1
    chains = [part[common:] or None for part in parts]
    nodes = {chain[:depth] for chain in chains if chain for depth in range(1, len(chain) + 1)}
    held = sum(chain is not None for chain in chains)
    grouped = len({chain for chain in chains if chain}) * FEWEST_SHAPES_A_FOLDER <= held
    return chains if nodes and grouped and len(nodes) <= MOST_FOLDERS else None


def _is_level(chains: Sequence[Chain], finer: Sequence[Chain]) -> bool:
    """Whether one tree only repeats another: its upper levels, or its groups by other names and in no more levels."""
    if any((chain is None) != (fine is None) for chain, fine in zip(chains, finer)):
        return False
    pairs = {(chain, fine) for chain, fine in zip(chains, finer) if chain is not None and fine is not None}
    if all(fine[: len(chain)] == chain for chain, fine in pairs):
        return True
    same = len(pairs) == len({chain for chain, _ in pairs}) == len({fine for _, fine in pairs})
    return same and max(len(chain) for chain, _ in pairs) <= max(len(fine) for _, fine in pairs)


def _tree(chains: Sequence[Chain]) -> tuple[list[TreeNode], list[int]]:
    """The nodes of a tree, and the number of each shape's."""
    paths = {chain[:depth] for chain in chains if chain for depth in range(1, len(chain) + 1)}
    ordered = sorted(paths, key=lambda path: [natural(name) for name in path])
    number = {path: index for index, path in enumerate(ordered)}
    return (
        [{"name": path[-1], "parent": number.get(path[:-1], -1)} for path in ordered],
        [-1 if not chain else number[chain] for chain in chains],
    )
