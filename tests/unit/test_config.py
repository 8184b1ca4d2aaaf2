from __future__ import annotations

from pathlib import Path

import pytest

from shapeviz_report.config import Config, load_config
from shapeviz_report.errors import ConfigError


@pytest.fixture
def database(tmp_path) -> Path:
    return tmp_path


def write(folder: Path, text: str) -> None:
    (folder / "shapeviz.toml").write_text(text, encoding="utf-8")


def test_defaults(database) -> None:
    assert load_config(database, {}) == Config()
    assert load_config(None, {"seed": None}) == Config()


def test_the_file_wins_over_defaults_and_flags_over_the_file(database) -> None:
    write(
        database,
        'title = "Vasen 🏺"\nseed = 5\nneighbours = 3\nedge_length = 0.02\nexternal = ["deep.npy"]\n',
    )
    config = load_config(database, {"seed": 7, "jobs": None, "external": ["here.npy"]})
    assert (config.title, config.seed, config.neighbours, config.edge_length) == ("Vasen 🏺", 7, 3, 0.02)
    assert config.external == (Path("here.npy"),)


def test_paths_of_the_file_start_at_its_folder(database) -> None:
    write(database, 'external = ["deep.npy"]\nbins = "best.txt"\ncache = "/somewhere"\n')
    config = load_config(database, {})
    assert config.bins == database / "best.txt"
    assert config.external == (database / "deep.npy",)
    assert config.cache == Path("/somewhere")


def test_what_is_on_can_be_switched_off(database) -> None:
    write(database, "meshes = false")
    assert load_config(None, {}).meshes
    assert not load_config(database, {}).meshes
    assert load_config(database, {"meshes": True}).meshes


def test_the_file_lies_beside_a_table(database) -> None:
    (database / "shapes.csv").write_text("file\n")
    write(database, "seed = 4")
    assert load_config(database / "shapes.csv", {}).seed == 4


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("sead = 1", r"no option 'sead'.*seed"),
        ("seed = 1.5", "seed must be a whole number"),
        ("seed = true", "seed must be a whole number"),
        ("seed = -1", "seed must be from 0"),
        ('title = ["a"]', "title must be text"),
        ('edge_length = "small"', "edge_length must be a number"),
        ("edge_length = 0.5", r"edge_length must be from 0\.002 to 0\.1"),
        ("edge_length = nan", "edge_length must be from"),
        ('preset = "best"', "preset must be one of default, paper"),
        ("external = [1]", "external must be a list of file names"),
        ('up = "x"', "up must be y or z"),
        ("meshes = 1", "meshes must be true or false"),
        ("cache = 3", "cache must be a path"),
        ("seed = ", "cannot be read as TOML"),
    ],
)
def test_what_cannot_be_followed_is_an_error(database, text, reason) -> None:
    write(database, text)
    with pytest.raises(ConfigError, match=reason) as error:
        load_config(database, {})
    assert (
        "range" in reason
        or "from" in reason
        or "must be y" in reason
        or "one of" in reason
        or "shapeviz.toml" in str(error.value)
    )


def test_a_file_that_is_not_text(database) -> None:
    (database / "shapeviz.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ConfigError, match="cannot be read as TOML"):
        load_config(database, {})


def test_parameters_are_json_and_leave_out_what_cannot_change_the_result() -> None:
    import json

    parameters = Config(external=(Path("/x/deep.npy"),), jobs=3, cache=Path("/y")).as_parameters()
    assert json.loads(json.dumps(parameters)) == parameters
    assert parameters["external"] == ["deep.npy"]
    assert parameters["bins"] is None
    assert Config(bins=Path("/x/best.txt")).as_parameters()["bins"] == "best.txt"
    assert not {"jobs", "cache", "time_limit"} & set(parameters)
