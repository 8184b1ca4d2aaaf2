"""No module of the current folder is imported, whichever way the command is started."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
import trimesh

pytestmark = pytest.mark.slow

COMMAND = str(Path(sys.executable).with_name("shapeviz-report"))
WAYS = {
    "the script": ([COMMAND], {}),
    "the script, entries that lead there": ([COMMAND], {"PYTHONPATH": os.pathsep.join(["", ".", "sub"])}),
    "the module": ([sys.executable, "-m", "shapeviz_report"], {}),
    "the command line": ([sys.executable, "-m", "shapeviz_report"], {}),
    "safe": ([sys.executable, "-P", "-m", "shapeviz_report"], {}),
}
OPTIONAL = {
    *("svg", "xxhash", "openctm", "meshio", "pyassimp", "embreex", "rtree", "mapbox_earcut", "triangle", "cascadio"),
    *("pyglet", "psutil", "jsonschema", "sympy", "shapely", "httpx", "yaml", "cupy", "pandas", "tensorflow", "cython"),
    *("OpenGL_accelerate", "fcl", "sksparse", "scikits", "lz4", "olefile", "colorama", "rnc2rng", "fqdn", "idna"),
    *("isoduration", "jsonpointer", "rfc3339_validator", "rfc3987", "webcolors", "_winapi", "msvcrt", "nt"),
    *("usercustomize", "sitecustomize"),
}  # fmt: skip
"""Modules that libraries look for by name during a build, and do without; found by an audit hook."""


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


def test_numba_is_not_configured_by_the_current_folder(tmp_path) -> None:
    (tmp_path / ".numba_config.yaml").write_text(f"cache_dir: {tmp_path / 'stolen'}\n")
    trimesh.creation.box().export(tmp_path / "0.off")
    program = (
        "from shapeviz_report.cli import main\nmain(['check', '.', '--list'])\n"
        "from shapeviz_report.executor import LocalExecutor\n"
        "read = \"(__import__('numba'), __import__('numba.core.config').core.config.reload_config(), "
        "__import__('numba.core.config').core.config.CACHE_DIR)[-1]\"\n"
        "with LocalExecutor(1, 60, 2**32) as workers:\n"
        "    print([eval(read), *(o.value or o.reason for o in workers.run(eval, [(read,)]))])\n"
    )
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout == "0\n['', None]\n", done.stderr
