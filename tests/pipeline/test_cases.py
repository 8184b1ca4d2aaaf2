"""Databases as other programs leave them, built whole: what is read, how it is called, and the exit code."""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping

import pytest
from small_database import OPTIONS, make_shape

from shapeviz_report.cli import main

MODEL = "models/model_normalized"

CASES: dict[str, tuple[Mapping[str, str | None], list[str], list[str]]] = {
    # the files, None for a mesh; names and classes of the shapes in their order
    "numbers": (
        {f"{label}/chair_{number}.obj": None for label in ("10", "2", "1") for number in (10, 2)},
        [f"{label} chair_{number}" for label in (1, 2, 10) for number in (2, 10)],
        ["1", "1", "2", "2", "10", "10"],
    ),
    "shapenet": (
        {
            "taxonomy.json": '[{"synsetId": "02691156", "name": "plane", "children": []}]',
            **{f"{folder}/{MODEL}.obj": None for folder in ("02/2", "02/10", "03/2", "03/1b")},
            **{f"03/1b/{MODEL}{end}": "x" for end in (".solid.binvox", ".surface.binvox", ".mtl", ".json")},
        },
        ["02 2", "02 10", "1b", "03 2"],
        ["02", "02", "03", "03"],
    ),
    "filename": (
        {
            "shapes.csv": "sep=;\nfilename;label\nm/10.obj;cup\nm/2.obj;ant\n",
            "m/10.obj": None,
            "m/2.obj": None,
        },
        ["ant 2", "cup 10"],
        ["ant", "cup"],
    ),
    "nan": (
        {
            "t.json": '[{"file": "a.obj", "label": NaN}, {"file": "b.obj", "label": "x"}]',
            "a.obj": None,
            "b.obj": None,
        },
        ["a", "b"],
        ["", "x"],
    ),
    "toml": (
        {"shapeviz.toml": '\ufefftitle = "Vessels"\n', "c1/a.obj": None, "c2/b.obj": None},
        ["a", "b"],
        ["c1", "c2"],
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_database_of_another_program_is_built_whole(case, tmp_path, cache, capsys) -> None:
    files, names, classes = CASES[case]
    root = tmp_path / case
    for number, (file, text) in enumerate(files.items()):
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        if text is None:
            make_shape("box", number).export(root / file)
        else:
            (root / file).write_text(text, encoding="utf-8")
    options = {"cache": cache} | OPTIONS
    flags = [part for name, value in options.items() for part in ("--" + name.replace("_", "-"), str(value))]
    assert main(["check", str(root), "--cache", str(cache), "--jobs", "1"]) == 0
    assert "All files can be used" in capsys.readouterr().out
    assert main(["build", str(root), "-o", str(tmp_path / "site"), *flags]) == 0
    with (tmp_path / "site/data/shapes.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["name"] for row in rows] == names
    assert [row["class"] for row in rows] == classes
    summary = json.loads((tmp_path / "site/data/summary.json").read_text(encoding="utf-8"))
    assert summary["failures"] == []
    assert summary["database"] == ("Vessels" if case == "toml" else case)
