from __future__ import annotations

import platform
import subprocess
import sys

import pytest

BOUNDED = """
import resource, sys
import mmgpy, numpy as np
from shapeviz_report.mesh.clean import clean
from shapeviz_report.mesh.remesh import remesh
from shapeviz_report.types import Mesh
corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
faces = [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))]
mesh = clean(Mesh(corners, np.array(faces, np.int32)))[0]
taken = next(int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmData")) * 1024
resource.setrlimit(resource.RLIMIT_DATA, (taken + (int(sys.argv[1]) << 20),) * 2)
try:
    print(len(remesh(mesh, 0.1).faces) > 100)
except BaseException as error:
    print(type(error).__name__)
"""


@pytest.mark.slow
@pytest.mark.skipif(platform.system() != "Linux", reason="only Linux bounds the memory of a process")
@pytest.mark.parametrize(("mebibytes", "found"), [(8, "MemoryError"), (110, "MemoryError"), (1000, "True")])
def test_want_of_memory_is_not_the_fault_of_the_mesh(mebibytes: int, found: str) -> None:
    run = subprocess.run([sys.executable, "-c", BOUNDED, str(mebibytes)], capture_output=True, text=True)
    assert run.stdout.strip() == found, run.stderr
