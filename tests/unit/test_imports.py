"""No module of the current folder is imported, whichever way the command is started."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
import trimesh

COMMAND = str(Path(sys.executable).with_name("shapeviz-report"))
WAYS = {
    "the script": ([COMMAND], {}),
    "the script, an empty entry": ([COMMAND], {"PYTHONPATH": os.pathsep}),
    "the script, a dot": ([COMMAND], {"PYTHONPATH": "."}),
    "the script, a relative entry": ([COMMAND], {"PYTHONPATH": "sub"}),
    "the module": ([sys.executable, "-m", "shapeviz_report"], {}),
    "the command line": ([sys.executable, "-m", "shapeviz_report.cli"], {}),
    "safe": ([sys.executable, "-P", "-m", "shapeviz_report"], {}),
}
OPTIONAL = {
    *("svg", "xxhash", "openctm", "meshio", "pyassimp", "embreex", "rtree", "mapbox_earcut", "triangle", "cascadio"),
    *("pyglet", "psutil", "jsonschema", "sympy", "shapely", "httpx", "yaml", "cupy", "pandas"),
    *("usercustomize", "sitecustomize"),
}  # fmt: skip
"""Modules that libraries look for by name, and do without."""


@pytest.mark.parametrize("way", WAYS)
def test_no_module_of_the_current_folder_runs(tmp_path, way) -> None:
    command, environment = WAYS[way]
    installed = {name for name in packages_distributions() if name.isidentifier()}
    names = (installed | OPTIONAL | {"csv", "json", "email", "html", "uuid", "difflib"}) - {"shapeviz_report"}
    if "PYTHONPATH" in environment:
        # Python itself imports these while it starts, before the package can act; the last for a .pth file.
        names -= {"usercustomize", "sitecustomize", "_distutils_hack"}
    folder = tmp_path / "database"
    for place in (folder, folder / "sub"):
        place.mkdir(parents=True)
        for name in names:
            (place / f"{name}.py").write_text(f"open({str(tmp_path / 'it-ran')!r}, 'a').write('{name} ')\n")
    for number in range(2):
        trimesh.creation.icosphere(1).export(folder / f"{number}.off")
    done = subprocess.run(
        [*command, "check", ".", "--jobs", "1", "--cache", str(tmp_path / "cache")],
        cwd=folder,
        env=os.environ | environment,
        capture_output=True,
        text=True,
    )
    ran = tmp_path / "it-ran"
    assert not ran.exists(), ran.read_text()
    assert done.returncode == 0, done.stderr
