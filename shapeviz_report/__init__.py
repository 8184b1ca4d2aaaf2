"""A folder of 3D meshes becomes a self-contained static web site.

>>> import shapeviz_report
>>> report = shapeviz_report.build("meshes/", "out/")        # doctest: +SKIP
>>> report.projections["tsne"][1].nh_s                       # doctest: +SKIP
0.905

Features without a site: :func:`describe` of a mesh, :func:`describe_database`, and :class:`ShapeDescriptors` for
scikit-learn. The stages can be used on their own: ``database.read_database``, ``mesh.prepare``,
``descriptors.DESCRIPTORS``, ``features.compute_histograms``, ``projections.project``, ``quality.score``,
``search.bins.select_bins``, ``render.render_thumbnail``, ``models.simplify``, ``writing.write_site``.
"""

from __future__ import annotations

import sys

from shapeviz_report.imports import is_program, trusted_path

if is_program():
    # before any other module is looked for
    sys.path[:] = trusted_path()
    from shapeviz_report.ending import end_at_once, listen

    # imports take seconds, and somebody may have mistyped
    listen(end_at_once)

import os
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shapeviz_report.errors import ShapevizError

if TYPE_CHECKING:
    from shapeviz_report.building.check import CheckResult
    from shapeviz_report.building.describing import DescribedDatabase, DescribedMesh
    from shapeviz_report.building.query import QueryResult
    from shapeviz_report.database import Listing
    from shapeviz_report.transformer import ShapeDescriptors
    from shapeviz_report.types import Report

__version__ = version("shapeviz-report")
__all__ = [
    "ShapeDescriptors",
    "ShapevizError",
    "__version__",
    "build",
    "check",
    "demo_site",
    "describe",
    "describe_database",
    "query",
]


def __getattr__(name: str) -> Any:
    # scikit-learn takes long to import, and workers import this package too
    if name == "ShapeDescriptors":
        from shapeviz_report.transformer import ShapeDescriptors

        return ShapeDescriptors
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def build(database: Any, destination: str | os.PathLike[str], **options: Any) -> Report:
    """Build the site of a shape database.

    Parameters
    ----------
    database : path or data frame
        A folder of meshes, or a table of them, which may be a data frame of pandas, Polars or pyarrow.
    destination : path
        Where the site goes.
    **options
        The fields of :class:`shapeviz_report.config.Config`; they win over ``shapeviz.toml``.

    Returns
    -------
    Report
        What the site shows: features, projections, quality, failures.

    Raises
    ------
    ShapevizError
        Nothing could be built.
    """
    # Worker processes import this package too, and need little of what the pipeline does.
    from shapeviz_report.building.pipeline import build_report
    from shapeviz_report.config import load_config

    source = _source(database)
    return build_report(source, Path(destination), load_config(Path(source), options))


def _source(database: Any) -> Path | Listing:
    if isinstance(database, str | os.PathLike):
        return Path(database)
    from shapeviz_report.database import Listing

    return Listing(database)


def demo_site(destination: str | os.PathLike[str], **options: Any) -> Report:
    """Generate the demo database and build its site; see :func:`build`."""
    from shapeviz_report.building.demo import build_demo
    from shapeviz_report.config import load_config

    return build_demo(Path(destination), load_config(None, options))


def check(database: Any, **options: Any) -> CheckResult:
    """Read a database and all its meshes without building anything; see :func:`build`."""
    from shapeviz_report.building.check import check_database
    from shapeviz_report.config import load_config

    source = _source(database)
    return check_database(source, load_config(Path(source), options))


def describe(mesh: Any, **options: Any) -> DescribedMesh:
    """Everything that is measured of one mesh: values at every vertex, and its row of features.

    Parameters
    ----------
    mesh : path, pair of arrays, or object
        A mesh file; vertices (n, 3) and faces (m, 3); or what has ``vertices`` and ``faces``, as a
        ``trimesh.Trimesh``.
    **options
        Of the fields of :class:`shapeviz_report.config.Config`, ``edge_length``, ``cache``, ``time_limit`` and
        ``memory_limit`` matter.

    Raises
    ------
    MeshError
        The mesh cannot be used.
    """
    from shapeviz_report.building.describing import describe_mesh
    from shapeviz_report.config import load_config

    return describe_mesh(mesh, load_config(None, {"jobs": 1, **options}))


def describe_database(database: Any, **options: Any) -> DescribedDatabase:
    """The features of a shape database, without pictures, maps or a site; see :func:`build`."""
    from shapeviz_report.building import describing
    from shapeviz_report.config import load_config

    source = _source(database)
    return describing.describe_database(source, load_config(Path(source), options))


def query(
    site: str | os.PathLike[str],
    mesh: str | os.PathLike[str],
    *,
    features: Sequence[str] | None = None,
    bins: str | os.PathLike[str] | None = None,
    count: int = 10,
    cache: str | os.PathLike[str] | None = None,
) -> QueryResult:
    """The shapes of a built site that are most similar to a mesh, with the reasons.

    Parameters
    ----------
    site : path
        The folder of a site that this version has built.
    mesh : path
        A mesh file; it need not be in the database.
    features : sequence of str, optional
        What to compare, such as ``["PFH", "FPFH"]``; by default what the maps of the site compare.
    bins : path, optional
        Compare the bins that this file names instead: one name a line, or what the Workbench saves.
    count : int
        Most shapes to find.
    cache : path, optional
        Where results are kept, as for :func:`build`.

    Raises
    ------
    ShapevizError
        The folder is not a site of this version, the mesh cannot be used, or a feature or bin is not there.
    """
    from shapeviz_report.building.query import find_similar
    from shapeviz_report.cache import default_root
    from shapeviz_report.config import Config

    return find_similar(
        Path(site),
        Path(mesh),
        features=features,
        bins=None if bins is None else Path(bins),
        count=count,
        cache=default_root() if cache is None else Path(cache),
        time_limit=Config.time_limit,
    )
