"""What a build reads beside meshes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shapeviz_report.building.reading import load_all_coordinates
from shapeviz_report.errors import ConfigError
from shapeviz_report.types import Database, ShapeEntry

DATABASE = Database(
    "two", Path("/db"), "flat", tuple(ShapeEntry(name, Path(f"/db/{name}.off"), name) for name in "ab")
)


def write(folder: Path, name: str) -> Path:
    np.save(folder / name, [[0.0, 1.0], [2.0, 3.0]])
    return folder / name


def test_maps_are_called_as_their_files(tmp_path) -> None:
    paths = [write(tmp_path, "by_age.npy"), write(tmp_path, "höhe.npy")]
    maps = load_all_coordinates(paths, DATABASE)
    assert list(maps) == ["by_age", "höhe"]
    assert maps["by_age"].tolist() == [[0, 1], [2, 3]]


@pytest.mark.parametrize("name", ["tsne", "t-SNE", "PCA", "Diffused", "features", "Best"])
def test_names_that_maps_have_already(tmp_path, name) -> None:
    said = "already a map named" if name.isidentifier() else "letters, digits and _"
    with pytest.raises(ConfigError, match=said):
        load_all_coordinates([write(tmp_path, f"{name}.npy")], DATABASE)


def test_names_that_no_column_can_have_and_two_of_a_name(tmp_path) -> None:
    with pytest.raises(ConfigError, match=r"'my map', and files .* rename the file"):
        load_all_coordinates([write(tmp_path, "my map.npy")], DATABASE)
    paths = [write(tmp_path, "own.npy"), write(tmp_path, "OWN.npy")]
    with pytest.raises(ConfigError, match="already a map named 'OWN'"):
        load_all_coordinates(paths, DATABASE)
