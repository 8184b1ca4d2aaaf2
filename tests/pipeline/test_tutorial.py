"""The tutorial is followed as it stands, from making meshes to publishing their site."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

TUTORIAL = (Path(__file__).parents[2] / "docs" / "tutorial.md").read_text(encoding="utf-8")
BEFORE, *BLOCKS = re.findall(r"^```(sh|text)\n(.*?)^```", TUTORIAL, re.MULTILINE | re.DOTALL)
"""What is typed and what is seen; the first installs what a test has already."""


def test_whoever_follows_the_tutorial_has_a_published_site(cache, tmp_path) -> None:
    assert "pip install" in BEFORE[1]
    told = tmp_path / "told.txt"
    host = tmp_path / "host.git"
    work = tmp_path / "work"
    work.mkdir()
    person = {
        f"GIT_{role}_{fact}": "reader@example.org"
        for role in ("AUTHOR", "COMMITTER")
        for fact in ("NAME", "EMAIL")
    }
    environment = (
        os.environ
        | person
        | {
            "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
            "SHAPEVIZ_CACHE": str(cache),
        }
    )
    subprocess.run(["git", "init", "--quiet", "--bare", host], check=True)
    for kind, block in BLOCKS:
        if kind == "sh":
            with told.open("w") as output:
                # Coarse and without a search, which take minutes otherwise.
                typed = block.replace(
                    "shapeviz-report build", "shapeviz-report build --edge-length 0.06 --search none"
                )
                typed = typed.replace("ADDRESS", str(host))
                done = subprocess.run(
                    ["bash", "-euc", typed],
                    cwd=work,
                    env=environment,
                    stdout=output,
                    stderr=subprocess.STDOUT,
                )
            assert done.returncode == 0, told.read_text()
        elif block.startswith("meshes/\n"):
            folders = re.findall(r"^  (\w+)/00\.off \.\.\. (\d+)\.off$", block, re.MULTILINE)
            assert folders
            made = {path.relative_to(work / "meshes").as_posix() for path in work.rglob("*.off")}
            assert made == {f"{name}/{n:02}.off" for name, last in folders for n in range(int(last) + 1)}
        else:
            assert block in told.read_text()

    published = subprocess.run(
        ["git", "-C", host, "ls-tree", "-r", "--name-only", "gh-pages"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    assert {"index.html", "compare.html", ".nojekyll", "data/shapes.csv"} <= set(published)
    summary = json.loads((work / "site" / "data" / "summary.json").read_text())
    (title,) = re.findall(r'^title = "(.*)"$', TUTORIAL, re.MULTILINE)
    assert title in json.dumps(summary)
    assert title in (work / "site.html").read_text(encoding="utf-8")
