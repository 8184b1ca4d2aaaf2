"""Shapes as rows of features, for scikit-learn."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any, Self

import numpy as np
import numpy.typing as npt
from sklearn.base import BaseEstimator, TransformerMixin
from sklearn.utils.validation import check_is_fitted

from shapeviz_report.building.describing import name_mesh, open_run, read_files
from shapeviz_report.building.measuring import Files, find_edges, measure_meshes
from shapeviz_report.building.progress import QuietProgress
from shapeviz_report.building.runner import Runner
from shapeviz_report.config import Config, load_config
from shapeviz_report.errors import ConfigError, MeshError
from shapeviz_report.features import fixed_edges
from shapeviz_report.presets import PRESETS
from shapeviz_report.types import Failure, FeatureTable, FloatArray


class ShapeDescriptors(TransformerMixin, BaseEstimator):
    """The features of shapes: meshes in, one row of numbers a shape out.

    Meshes are read, cleaned, remeshed and measured as a build does it, by as many processes, and what was computed
    is kept in the same cache. The columns are those of a site's ``data/features.npz``.

    Parameters
    ----------
    preset : str
        ``"default"``, ``"local"`` or ``"paper"``. The histogram ranges of the last are learned from the meshes that
        it is fitted to; the others learn nothing.
    edge_length : float
        Of the remeshed surface, as a fraction of the shape's size.
    on_failure : {"raise", "nan"}
        What to do with a mesh that cannot be used: raise a ``MeshError``, or warn and fill its row with NaN.
    jobs : int, optional
        Worker processes; by default one a core.
    scheduler : str, optional
        Address of a Dask scheduler, to compute on its cluster instead.
    cache : path, optional
        Where results are kept.
    time_limit : float
        Seconds that one mesh may take in one stage.
    memory_limit : float, optional
        GiB of memory that one worker may take.

    Attributes
    ----------
    edges_ : (D, 11) float64 array
        Bin edges of the histograms.

    Examples
    --------
    >>> from shapeviz_report import ShapeDescriptors
    >>> ShapeDescriptors(preset="local").fit().get_feature_names_out()[:2]
    array(['Gc:1', 'Gc:2'], dtype=object)
    """

    def __init__(
        self,
        preset: str = "default",
        *,
        edge_length: float = Config.edge_length,
        on_failure: str = "raise",
        jobs: int | None = None,
        scheduler: str | None = None,
        cache: str | os.PathLike[str] | None = None,
        time_limit: float = Config.time_limit,
        memory_limit: float | None = None,
    ) -> None:
        self.preset = preset
        self.edge_length = edge_length
        self.on_failure = on_failure
        self.jobs = jobs
        self.scheduler = scheduler
        self.cache = cache
        self.time_limit = time_limit
        self.memory_limit = memory_limit

    def fit(self, X: Iterable[Any] = (), y: Any = None) -> Self:
        """Learn the ranges of histograms, where the preset takes them from the meshes.

        Parameters
        ----------
        X : iterable of meshes
            As for :meth:`transform`.
        y : ignored

        Raises
        ------
        ConfigError
            A parameter has a value that it cannot have.
        MeshError
            A mesh cannot be used, and ``on_failure`` is ``"raise"``.
        """
        config, meshes = self._config(), _list_meshes(X)
        if PRESETS[config.preset].fixed_ranges:
            self.edges_ = fixed_edges()
        else:
            with self._open_run(config, meshes) as (run, files):
                self.edges_, _ = find_edges(run, files, PRESETS[config.preset], config.edge_length)
        return self

    def transform(self, X: Iterable[Any]) -> FloatArray:
        """Measure shapes.

        Parameters
        ----------
        X : iterable of meshes
            Each a path, a pair of vertices (n, 3) and faces (m, 3), or an object that has both, as a
            ``trimesh.Trimesh``.

        Returns
        -------
        (n, w) float64 array
            A row a mesh. After ``set_output(transform="pandas")`` a data frame.

        Raises
        ------
        NotFittedError
        MeshError
            A mesh cannot be used, and ``on_failure`` is ``"raise"``: what was computed of the others is kept.
        """
        check_is_fitted(self)
        config, meshes = self._config(), _list_meshes(X)
        preset = PRESETS[config.preset]
        with self._open_run(config, meshes) as (run, files):
            found = measure_meshes(run, files, preset, self.edges_, config.edge_length).rows
        rows = np.full((len(meshes), sum(block.width for block in preset.blocks)), np.nan)
        for place, row in found.items():
            rows[int(place)] = row
        return rows

    def get_feature_names_out(self, input_features: Any = None) -> npt.NDArray[np.object_]:
        """The names of the columns, such as ``FPFH[14]:3``.

        Parameters
        ----------
        input_features : sequence of str, optional
            The name of the one column of meshes, which the names do not depend on.

        Raises
        ------
        ValueError
            It is not one name.
        """
        if input_features is not None and len(input_features) != 1:
            raise ValueError(
                f"input_features must name the one column of meshes, and not {len(input_features)}"
            )
        blocks = PRESETS[self._config().preset].blocks
        return np.array(FeatureTable((), blocks, np.empty((0, 0))).columns, dtype=object)

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        # meshes are no table of numbers
        tags.input_tags.two_d_array = False
        tags.no_validation = True
        return tags

    @contextmanager
    def _open_run(
        self, config: Config, meshes: Sequence[Any]
    ) -> Iterator[tuple[Runner, Mapping[str, Files]]]:
        """What runs stages, and the meshes by their places; tells of those that failed when it is left."""
        failures: list[Failure] = []
        names = {str(place): f"{place}, {name_mesh(mesh)}" for place, mesh in enumerate(meshes)}
        files = {str(place): partial(read_files, mesh) for place, mesh in enumerate(meshes)}
        with open_run(config, names, failures, QuietProgress()) as run:
            yield run, files
        if failures:
            told = [f"  {failure.path}: {failure.reason}" for failure in failures[:5]]
            if len(failures) > 5:
                told.append(f"  and {len(failures) - 5} more")
            error = MeshError(f"{len(failures)} of {len(meshes)} meshes cannot be used:", *told)
            if self.on_failure == "raise":
                raise error
            warnings.warn(str(error), stacklevel=5)

    def _config(self) -> Config:
        options = {name: value for name, value in self.get_params().items() if name != "on_failure"}
        if self.on_failure not in ("raise", "nan"):
            raise ConfigError(f"on_failure must be 'raise' or 'nan', not {self.on_failure!r}")
        return load_config(None, options)


def _list_meshes(X: Any) -> list[Any]:
    """The meshes in what a caller hands over; of a table, its one column."""
    if isinstance(X, str | os.PathLike) or hasattr(X, "vertices"):
        raise ConfigError("these must be several meshes: put a single one into a list, as in [mesh]")
    if getattr(X, "ndim", 1) == 2:
        if X.shape[1] != 1:
            raise ConfigError(f"a table of meshes has one column, their files, and not {X.shape[1]}")
        X = np.asarray(X)[:, 0]
    return list(X)
