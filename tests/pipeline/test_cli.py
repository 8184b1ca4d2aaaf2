"""The command line as a person types it."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import trimesh
from small_database import OPTIONS, make_shape, write_database

from shapeviz_report import __version__
from shapeviz_report.cli import main
from shapeviz_report.database import read_database
from shapeviz_report.external import load_external


def run(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "shapeviz_report", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True)


@pytest.fixture
def flags(cache) -> list[str]:
    options = OPTIONS | {"cache": cache}
    return [part for name, value in options.items() for part in ("--" + name.replace("_", "-"), str(value))]


def test_version_and_help() -> None:
    assert run("--version").stdout == f"shapeviz-report {__version__}\n"
    text = run("build", "--help").stdout
    for flag in (
        "--output",
        "--layout",
        "--labeling",
        "--preset",
        "--seed",
        "--cache",
        "--time-limit",
        "exit codes",
    ):
        assert flag in text
    assert "shapeviz.toml" in text


def test_build_tells_what_it_did(database, built, tmp_path, flags) -> None:
    done = run("build", database, "-o", tmp_path / "site", *flags)
    assert done.returncode == 0
    summary = dict(line.strip().split("  ", 1) for line in done.stdout.splitlines() if "  " in line.strip())
    assert (summary["shapes"], summary["classes"], summary["failures"]) == ("15", "3", "0")
    found = built[1].projections["tsne"][1].nh_s
    assert float(summary["NH_s tsne"].split()[0]) == pytest.approx(found, abs=5e-4)
    assert "prepare" in summary["seconds"]
    assert done.stdout.rstrip().endswith(str(tmp_path / "site" / "index.html"))
    assert "Measuring shapes: 15" in done.stderr


def test_a_site_in_one_file_is_built_and_a_missing_licence_is_told(database, built, tmp_path, flags) -> None:
    file = tmp_path / "report.html"
    done = run("build", database, "-o", file, "--single-file", "--gltf", "decimated", *flags)
    assert "Note: a site in one file holds no glTF" in done.stderr
    assert done.returncode == 0
    assert done.stdout.rstrip().endswith(str(file))
    assert "Note: No licence is named" in done.stdout
    assert list(tmp_path.iterdir()) == [file]
    assert b'<html lang="en" data-single-file>' in file.read_bytes()[:100]


def test_check_asks_for_a_licence_until_one_is_named(database, cache) -> None:
    options = ("--cache", cache, "--jobs", 1)
    bare = run("check", database, *options).stdout
    told = run("check", database, *options, "--licence", "CC0-1.0").stdout
    assert "Note: No licence is named" in bare
    assert "Note:" not in told


def test_what_cannot_be_published_ends_the_build_before_it_begins(database, tmp_path, flags) -> None:
    done = run("build", database, "-o", tmp_path / "site", *flags, "--accent", "reddish")
    assert done.returncode == 1
    assert "accent must be a colour such as #1f5f99" in done.stderr
    assert "Preparing" not in done.stderr
    assert not (tmp_path / "site").exists()


def test_failures_do_not_fail_the_build(tmp_path, flags) -> None:
    database = write_database(tmp_path / "d", per_class=1)
    (database / "box" / "bad\x1b[31m.off").write_text("OFF\n")
    done = run("build", database, "-o", tmp_path / "site", *flags)
    assert done.returncode == 0
    assert "Cannot be used: 1 file" in done.stdout
    assert "\x1b" not in done.stdout


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["build", "nowhere", "-o", "site"], "nowhere"),
        (["build", "empty", "-o", "site"], "empty"),
        (["build", "wrong", "-o", "site"], "no option 'colour'"),
        (["build", "solids", "-o", "site", "--layout", "pyramid"], "pyramid"),
        (["build", "solids", "-o", "site", "--labeling", "style"], "style"),
        (["build", "solids", "-o", "site", "--edge-length", "5"], "edge_length must be from"),
        (["build", "solids", "-o", "solids"], "solids"),
        (["build", "solids", "-o", "site.html"], "site.html would be a folder: add --single-file"),
        (["build", "solids", "-o", "solids/box/0.off"], "file"),
        (["build", "solids", "-o", "site", "--external", "none.npy"], "none.npy"),
        (["check", "nowhere"], "nowhere"),
    ],
)
def test_what_cannot_be_done_says_why(tmp_path, monkeypatch, capsys, arguments, message) -> None:
    monkeypatch.chdir(tmp_path)
    write_database(Path("solids"), per_class=1)
    Path("empty").mkdir()
    write_database(Path("wrong"), per_class=1)
    Path("wrong/shapeviz.toml").write_text('colour = "red"\n')
    assert main(arguments) == 1
    error = capsys.readouterr().err
    _, _, said = ("\n" + error).partition("\nshapeviz-report: ")
    assert message in said
    assert "Traceback" not in error
    assert not Path("site").exists()


def test_wrong_usage_is_exit_code_2() -> None:
    assert run("build").returncode == 2
    assert run("paint").returncode == 2
    assert run("build", "x", "-o", "y", "--seed", "many").returncode == 2


def test_check_names_what_is_wrong(tmp_path) -> None:
    database = write_database(tmp_path / "d", per_class=2)
    good = run("check", database, "--jobs", 1)
    assert good.returncode == 0
    assert "6 shapes" in good.stdout
    assert "All files can be used" in good.stdout
    (database / "ring" / "bad.off").write_text("OFF\n1 2")
    bad = run("check", database, "--jobs", 1)
    assert bad.returncode == 1
    assert "ring/bad.off: " in bad.stdout
    assert "6 shapes" in bad.stdout, "what cannot be used was counted"
    assert "2  ring" in bad.stdout
    assert not (tmp_path / "site").exists()


def test_check_lists_ids_in_the_order_of_external_features(database) -> None:
    done = run("check", database, "--list")
    assert done.stdout.splitlines() == [f"{kind}/{i}" for kind in ("ball", "box", "ring") for i in range(5)]


def test_a_reader_that_goes_away_is_no_error(database) -> None:
    command = f"{sys.executable} -m shapeviz_report check '{database}' --list | head -1"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True)
    assert done.stdout == "ball/0\n"
    assert "Traceback" not in done.stderr


HOSTILE = "a\x1b[31m\nNote: b\u202e\x9b\x07"


def test_names_reach_the_terminal_as_one_line_of_printable_characters(tmp_path) -> None:
    folder = tmp_path / f"d{HOSTILE}"
    for label in (HOSTILE, "plain"):
        (folder / label).mkdir(parents=True)
        make_shape("box", len(label)).export(folder / label / f"good{HOSTILE}.off")
    (folder / HOSTILE / f"bad{HOSTILE}.off").write_text("OFF\n1 2")
    os.close(os.open(os.fsencode(folder) + b"/plain/\xff\xfe.off", os.O_CREAT))
    options = ["--jobs", "1", "--cache", tmp_path / "cache"]
    shown = "a?[31m?Note: b???"

    checked = run("check", folder, *options)
    assert checked.returncode == 1
    assert f"  {shown}/bad{shown}.off: " in checked.stdout
    assert f"     1  {shown}\n" in checked.stdout
    (folder / "plain" / f"good{HOSTILE}.off").unlink()
    (folder / HOSTILE / f"good{HOSTILE}.off").unlink()
    stopped = run("build", folder, "-o", tmp_path / "site", *options)
    assert stopped.returncode == 1
    assert f"None of the files in {tmp_path}/d{shown} can be used:\n  {shown}/bad" in stopped.stderr
    for done in (checked, stopped):
        said = done.stdout + done.stderr
        assert "Traceback" not in said
        assert "Note: b" in said
        assert "\nNote: b" not in said
        assert all(c.isprintable() or c in "\n\r" for c in said), ascii(said)


ODD = ["a\x1b[31m\u202e", "b\nc\u2028d", "ж", "plain"]


@pytest.fixture
def odd(tmp_path) -> Path:
    for name in ODD:
        (_folder(tmp_path / "odd") / f"{name}.off").touch()
    return tmp_path / "odd"


def test_ids_reach_a_file_as_they_are(odd) -> None:
    command = [sys.executable, "-m", "shapeviz_report", "check", odd, "--list"]
    # the letters of a file that a table is made from are not those of the terminal
    done = subprocess.run(command, capture_output=True, env=os.environ | {"PYTHONIOENCODING": "cp1252"})
    listed = done.stdout.decode("utf-8").splitlines()
    assert sorted(listed) == sorted([ODD[0], "b?c?d", *ODD[2:]])
    assert done.stderr.decode().startswith("1 of 4 are not printed as they are: ")
    told = json.loads(run("check", odd, "--json", "--jobs", 1, "--cache", odd.parent / "cache").stdout)
    exact = [shape["id"] for shape in told["shapes"]]
    assert sorted(exact) == sorted(ODD)
    assert [id for id in exact if id != ODD[1]] == [line for line in listed if line != "b?c?d"]
    table = odd.parent / "own.csv"
    table.write_text("id,v\n" + "".join(f"{line},1\n" for line in listed if "?" not in line), "utf-8")
    (odd / f"{ODD[1]}.off").unlink()
    assert len(load_external(table, [shape.id for shape in read_database(odd).shapes])) == 3


@pytest.mark.skipif(os.name == "nt", reason="there are no such terminals")
def test_ids_reach_a_terminal_as_printable_characters(odd) -> None:
    import pty

    ours, terminal = pty.openpty()
    command = [sys.executable, "-m", "shapeviz_report", "check", odd, "--list"]
    done = subprocess.run(command, stdout=terminal, stderr=subprocess.PIPE, text=True)
    os.close(terminal)
    said = os.read(ours, 10_000).decode()
    os.close(ours)
    assert sorted(said.splitlines()) == sorted(["a?[31m?", "b?c?d", *ODD[2:]])
    assert done.stderr.startswith("2 of 4 are not printed as they are: ")


def test_a_warning_is_logged_as_one_line() -> None:
    program = "import logging, shapeviz_report.cli as cli; cli.main(['check', 'none']); logging.warning('a\\x1b\\nb')"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stderr.splitlines()[-1] == "WARNING: a??b"


def test_a_mesh_outside_the_database_is_read_only_when_asked(tmp_path, capsys) -> None:
    """Through a link to a file, a link to a folder, and a row of a table."""
    root, secret = tmp_path / "database", tmp_path / "secret"
    make_shape("box", 0).export(secret_mesh := _folder(secret) / "s.off")
    make_shape("box", 1).export(_folder(root / "box") / "a.off")
    (root / "box" / "b.off").symlink_to(secret_mesh)
    (root / "linked").symlink_to(secret)
    make_shape("ball", 0).export(_folder(tmp_path / "table") / "c.off")
    table = tmp_path / "table" / "shapes.csv"
    table.write_text("file\nc.off\n../secret/s.off\n")
    cache = ["--cache", str(tmp_path / "cache"), "--jobs", "1"]
    for database, outside in ((root, 2), (table, 1)):
        assert main(["check", str(database), *cache]) == 1
        said = capsys.readouterr().out
        assert said.count("lies outside the database's folder") == outside
        assert str(secret_mesh) in said
        assert "read by --outside" in said
        assert main(["check", str(database), *cache, "--outside"]) == 0
        assert "All files can be used." in capsys.readouterr().out


def _folder(path: Path) -> Path:
    path.mkdir(parents=True, exist_ok=True)
    return path


def test_a_check_for_programs(database, cache, tmp_path) -> None:
    shutil.copytree(database, tmp_path / "shapes")
    (tmp_path / "shapes" / "box" / "9.off").touch()
    done = run("check", tmp_path / "shapes", "--json", "--cache", cache, "--jobs", 1)
    assert done.returncode == 1
    found = json.loads(done.stdout)
    assert (found["database"], found["layout"]) == ("shapes", "class-folders")
    assert found["labelings"] == {"class": {"ball": 5, "box": 6, "ring": 5}}
    assert found["failures"] == [{"file": "box/9.off", "reason": "the file is empty"}]
    usable = {shape["id"]: shape["usable"] for shape in found["shapes"]}
    assert len(usable) == 16
    assert not usable["box/9"]
    assert found["shapes"][0] == {
        "id": "ball/0",
        "name": "ball 0",
        "file": "ball/0.off",
        "labels": {"class": "ball"},
        "metadata": {},
        "usable": True,
        "repairs": {},
        "lost_colours": [],
    }


def test_a_check_tells_what_is_lost_of_colours(tmp_path, capsys) -> None:
    folder = _folder(tmp_path / "shapes")
    for name in ("one", "two"):
        ball = trimesh.creation.icosphere(2).export(file_type="obj", include_normals=False)
        (folder / f"{name}.obj").write_text(f"mtllib {name}.mtl\nusemtl wood\n{ball}")
    (folder / "Two.mtl").write_text("newmtl wood\nmap_Kd wood.png\n")
    (folder / "wood.png").write_bytes(b"no picture")
    arguments = ["check", str(folder), "--cache", str(tmp_path / "cache"), "--jobs", "1"]
    lost = {
        "one": "one.mtl is not there, lies outside the folder or is too large",
        "two": "wood.png is no picture that can be read",
    }
    assert main(arguments) == 0
    told = capsys.readouterr().out
    assert "Colours are left out of 2 shapes:\n" in told
    for shape, what in lost.items():
        assert f"  {shape}: {what}\n" in told
    assert main([*arguments, "--json"]) == 0
    shapes = json.loads(capsys.readouterr().out)["shapes"]
    assert {shape["id"]: shape["lost_colours"] for shape in shapes} == {k: [v] for k, v in lost.items()}


def test_how_much_is_said(database, cache, tmp_path) -> None:
    quiet = run("check", database, "--quiet", "--cache", cache, "--jobs", 1)
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, "", "")
    loud = run("check", database, "--verbose", "--cache", cache, "--jobs", 1)
    assert loud.returncode == 0
    for said in ("jobs = 1\n", f"results are kept in {cache}\n", "computed by 1 process of this machine\n"):
        assert said in loud.stderr
    assert re.search(r"^Checking meshes: \d+\.\d s$", loud.stderr, re.MULTILINE)
    (tmp_path / "flawed").mkdir()
    (tmp_path / "flawed" / "a.off").write_text("OFF\n")
    quiet = run("check", tmp_path / "flawed", "--quiet", "--cache", cache, "--jobs", 1)
    assert quiet.returncode == 1
    assert quiet.stdout.startswith("\nCannot be used: 1 file\n  a.off: ")
    (tmp_path / "empty").mkdir()
    quiet = run("check", tmp_path / "empty", "--quiet")
    assert quiet.returncode == 1
    assert "No shapes were found" in quiet.stderr
