from __future__ import annotations

import dataclasses
import importlib.util
import os
from pathlib import Path

import numpy as np
import pytest

from shapeviz_report.config import MACHINE, Config, load_config
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
    write(database, 'external = ["deep.npy"]\nbins = "best.txt"\n')
    config = load_config(database, {})
    assert config.bins == database / "best.txt"
    assert config.external == (database / "deep.npy",)


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ('scheduler = "tcp://example.org:8786"', "scheduler"),
        ('cache = "kept"', "cache"),
        ("jobs = 2", "jobs"),
        ("time_limit = 9", "time_limit"),
        ("single_file = true", "single_file"),
        ("memory_limit = 2", "memory_limit"),
    ],
)
def test_a_database_says_nothing_of_the_machine(database, monkeypatch, line, name) -> None:
    write(database, line)
    flag, variable = "--" + name.replace("_", "-"), "SHAPEVIZ_" + name.upper()
    with pytest.raises(ConfigError, match=f"{name} .*{flag}.*{variable}.*--config"):
        load_config(database, {})
    own = database / "own.toml"
    (database / "shapeviz.toml").rename(own)
    said = getattr(load_config(database, {}, own), name)
    assert said != getattr(Config(), name)
    monkeypatch.setenv(variable, line.partition(" = ")[2].strip('"'))
    expected = Path("kept") if name == "cache" else said
    assert getattr(load_config(database, {}), name) == expected


def test_every_option_of_the_machine_is_refused() -> None:
    assert {"scheduler", "cache", "jobs", "time_limit", "single_file"} <= set(MACHINE)
    assert [f.name for f in dataclasses.fields(Config) if "limit" in f.name and f.name not in MACHINE] == []


def test_who_wins(database, monkeypatch) -> None:
    write(database, "seed = 1\nneighbours = 1\n")
    (database / "own.toml").write_text("seed = 2\njobs = 2\ntime_limit = 2\n")
    monkeypatch.setenv("SHAPEVIZ_JOBS", "3")
    monkeypatch.setenv("SHAPEVIZ_TIME_LIMIT", "3")
    monkeypatch.setenv("SHAPEVIZ_CACHE", "")
    config = load_config(database, {"time_limit": 4.0}, database / "own.toml")
    assert (config.neighbours, config.seed, config.jobs, config.time_limit) == (1, 2, 3, 4)
    assert config.cache is None
    monkeypatch.setenv("SHAPEVIZ_JOBS", "many")
    with pytest.raises(ConfigError, match=r"jobs must be a whole number.*SHAPEVIZ_JOBS"):
        load_config(database, {})


def test_any_option_may_stand_in_the_environment(database, monkeypatch) -> None:
    for variable, text in (("EDGE_LENGTH", "0.03"), ("TITLE", "Cups"), ("MESHES", ""), ("EXTERNAL", "a.npz")):
        monkeypatch.setenv(f"SHAPEVIZ_{variable}", text)
    config = load_config(database, {})
    assert (config.edge_length, config.title, config.external) == (0.03, "Cups", (Path("a.npz"),))


@pytest.mark.parametrize(
    ("variable", "nearest"),
    [
        ("SHAPEVIZ_CAHCE", "SHAPEVIZ_CACHE"),
        ("SHAPEVIZ_JOB", "SHAPEVIZ_JOBS"),
        ("SHAPEVIZ_NEIGHBORS", "SHAPEVIZ_NEIGHBOURS"),
        ("SHAPEVIZ_TIMELIMIT", "SHAPEVIZ_TIME_LIMIT"),
    ],
)
def test_a_misspelt_variable_is_told_with_the_nearest(database, monkeypatch, variable, nearest) -> None:
    monkeypatch.setenv(variable, "3")
    with pytest.raises(ConfigError, match=f"no option {variable} .*; the nearest is {nearest}$"):
        load_config(database, {})


def test_variables_of_others_are_nobodys_options(database, monkeypatch) -> None:
    usual = load_config(database, {})
    monkeypatch.setenv(
        "SHAPEVIZ_SOURCE", "git+https://example.org/shapeviz-report.git"
    )  # of the guide's workflow
    assert load_config(database, {}) == usual


def test_paths_of_the_database_stay_inside(tmp_path) -> None:
    database = tmp_path / "database"
    (database / "sub").mkdir(parents=True)
    key = tmp_path / "key.txt"
    key.write_text("secret")
    (database / "link.txt").symlink_to(key)
    (database / "away").symlink_to(tmp_path)
    (database / "loop").symlink_to(database / "loop")
    (database / "own.txt").symlink_to(database / "sub")
    for name in ("introduction", "logo", "bins", "external"):
        for path in (
            "../key.txt",
            "sub/../../key.txt",
            str(key),
            "link.txt",
            "away/key.txt",
            "loop",
            "a\\u0000b",
        ):
            write(database, f'{name} = "{path}"')
            with pytest.raises(ConfigError, match=name):
                load_config(database, {})
        write(database, f'{name} = "own.txt"')
        load_config(database, {})
    (database / "shapeviz.toml").unlink()
    (database / "own.toml").write_text('introduction = "../key.txt"')
    assert load_config(database, {}, database / "own.toml").introduction == database / "../key.txt"
    assert load_config(database, {"introduction": str(key)}).introduction == key


def test_the_databases_file_is_a_regular_one_inside(tmp_path) -> None:
    database = tmp_path / "database"
    database.mkdir()
    (tmp_path / "other.toml").write_text("seed = 3")
    (database / "shapeviz.toml").symlink_to(tmp_path / "other.toml")
    with pytest.raises(ConfigError, match="outside"):
        load_config(database, {})
    (database / "shapeviz.toml").unlink()
    os.mkfifo(database / "shapeviz.toml")
    with pytest.raises(ConfigError, match="not a regular file"):
        load_config(database, {})


def test_a_file_that_is_named_must_be_there(database) -> None:
    with pytest.raises(ConfigError, match=r"own\.toml cannot be read: No such file"):
        load_config(database, {}, database / "own.toml")


def test_what_is_on_can_be_switched_off(database) -> None:
    write(database, "meshes = false")
    assert load_config(None, {}).meshes
    assert not load_config(database, {}).meshes
    assert load_config(database, {"meshes": True}).meshes


def test_numbers_of_numpy_are_numbers(database) -> None:
    config = load_config(database, {"seed": np.int64(3), "edge_length": np.float32(0.03125)})
    assert (config.seed, type(config.seed), config.edge_length) == (3, int, 0.03125)
    with pytest.raises(ConfigError, match="seed must be a whole number"):
        load_config(database, {"seed": np.float64(3)})


def test_the_file_lies_beside_a_table(database) -> None:
    (database / "shapes.csv").write_text("file\n")
    write(database, "seed = 4")
    assert load_config(database / "shapes.csv", {}).seed == 4


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("sead = 1", r"no option 'sead' .*; the nearest is seed$"),
        ("thumbnail-size = 99", r"no option 'thumbnail-size' .*; the nearest is thumbnail_size$"),
        ("wheels = 4", r"no option 'wheels' .*; there are: title, .*, cache$"),
        ('[site]\ntitle = "x"', r"no option 'site' .*, and no option has a table.*without \[site\]$"),
        ("seed = 1.5", "seed must be a whole number"),
        ("seed = true", "seed must be a whole number"),
        ("seed = -1", "seed must be from 0 to 4,294,967,295, not -1"),
        ('title = ["a"]', "title must be text"),
        ('edge_length = "small"', "edge_length must be a number"),
        ("edge_length = 0.5", r"edge_length must be from 0\.002 to 0\.1"),
        ("edge_length = nan", "edge_length must be from"),
        ('preset = "best"', "preset must be one of default, local, paper"),
        ("external = [1]", "external must be a list of file names"),
        ('up = "x"', "up must be one of y, z"),
        ("meshes = 1", "meshes must be true or false"),
        ("bins = 3", "bins must be a path"),
        ("seed = ", "cannot be read as TOML"),
        (f"title = {'[' * 5000}", "nested too deeply"),
    ],
)
def test_what_cannot_be_followed_is_an_error(database, text, reason) -> None:
    write(database, text)
    with pytest.raises(ConfigError, match=reason) as error:
        load_config(database, {})
    assert str(database / "shapeviz.toml") in str(error.value)


def test_a_value_out_of_range_is_told_with_its_place(database, monkeypatch) -> None:
    with pytest.raises(ConfigError, match=r"^seed must be from 0 .*, not -1 \(as an option\)$"):
        load_config(database, {"seed": -1})
    own = database / "own.toml"
    own.write_text('up = "x"')
    with pytest.raises(ConfigError, match=r"^up must be one of y, z, not 'x' \(in .*own\.toml\)$"):
        load_config(database, {}, own)
    monkeypatch.setenv("SHAPEVIZ_JOBS", "0")
    with pytest.raises(ConfigError, match=r"^jobs must be from 1 .*SHAPEVIZ_JOBS\)$"):
        load_config(database, {})


@pytest.mark.parametrize(
    "content", [b"\xff\xfe\x00", 'title = "x"'.encode("utf-16-le"), 'title = "M\xfcnze"'.encode("latin-1")]
)
def test_a_file_that_is_not_text(database, content) -> None:
    (database / "shapeviz.toml").write_bytes(content)
    with pytest.raises(ConfigError, match="cannot be read as TOML: it is no text in UTF-8"):
        load_config(database, {})


def test_parameters_are_json_and_leave_out_what_cannot_change_the_result() -> None:
    import json

    parameters = Config(external=(Path("/x/deep.npy"),), jobs=3, cache=Path("/y")).as_parameters()
    assert json.loads(json.dumps(parameters)) == parameters
    assert parameters["external"] == ["deep.npy"]
    assert parameters["bins"] is None
    assert Config(bins=Path("/x/best.txt")).as_parameters()["bins"] == "best.txt"
    assert not {"jobs", "cache", "time_limit"} & set(parameters)


def test_processes_are_as_many_as_cores(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {1, 3, 5}, raising=False)
    assert Config().worker_count == 3
    assert Config(jobs=2).worker_count == 2


def test_without_pyarrow_the_option_says_what_to_install(monkeypatch) -> None:
    assert Config(parquet=True).parquet
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(
        ConfigError, match=r"pip install 'shapeviz-report\[parquet\]'; or leave .* --no-parquet"
    ):
        Config(parquet=True)


def test_values_of_gltf_need_gltf() -> None:
    with pytest.raises(ConfigError, match="gltf must be one of decimated, prepared, not 'all'"):
        Config(gltf="all")
    with pytest.raises(ConfigError, match="gltf_values go along with gltf, which is not set"):
        Config(gltf_values="Agd")


def test_a_day_may_be_one_of_toml(database) -> None:
    write(database, "date = 2026-11-30")
    assert load_config(database, {}).date == "2026-11-30"
