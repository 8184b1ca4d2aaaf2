from __future__ import annotations

from pathlib import Path

import pytest

from shapeviz_report.executor.memory import LEAST, memory_share
from shapeviz_report.system import free_memory

GIB = 2**30


def machine(root: Path, files: dict[str, object]) -> Path:
    for name, content in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(f"{content}\n")
    return root


MEMINFO = f"MemTotal: {16 * GIB // 1024} kB\nMemAvailable:   {8 * GIB // 1024} kB"


@pytest.mark.parametrize(
    ("files", "free"),
    [
        ({}, 8 * GIB),
        ({"proc/self/cgroup": "0::/a/b"}, 8 * GIB),
        (
            {
                "proc/self/cgroup": "0::/a/b",
                "sys/fs/cgroup/a/b/memory.max": "max",
                "sys/fs/cgroup/a/b/memory.current": GIB,
                "sys/fs/cgroup/a/memory.max": 4 * GIB,
                "sys/fs/cgroup/a/memory.current": GIB,
            },
            3 * GIB,
        ),
        (
            {
                "proc/self/cgroup": "0::/",
                "sys/fs/cgroup/memory.max": 2 * GIB,
                "sys/fs/cgroup/memory.current": 3 * GIB,
            },
            0,
        ),
        (
            {
                "proc/self/cgroup": "5:cpu,memory:/docker/x\n1:name=systemd:/",
                "sys/fs/cgroup/memory/memory.limit_in_bytes": 6 * GIB,
                "sys/fs/cgroup/memory/memory.usage_in_bytes": GIB,
            },
            5 * GIB,
        ),
    ],
)
def test_free_memory_is_what_machine_and_groups_allow(tmp_path, files, free: int) -> None:
    assert free_memory(machine(tmp_path, {"proc/meminfo": MEMINFO} | files)) == free


def test_a_share_is_never_too_small_to_start() -> None:
    assert memory_share(10**6) == LEAST
    assert memory_share(1) <= free_memory() * 1.1 or memory_share(1) == LEAST
