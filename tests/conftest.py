"""What all tests share."""

from __future__ import annotations

import os
from pathlib import Path

import pytest


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """One process begins with the build that compiles what all others load, another with pages in browsers; then come
    whole builds: at the end, one process would be left with the longest of them."""
    tests = Path(__file__).parent
    order = [
        tests / "pipeline" / "test_build.py",
        tests / "browser" / "everywhere",
        tests / "pipeline",
        tests,
    ]
    items.sort(key=lambda item: next(n for n, place in enumerate(order) if item.path.is_relative_to(place)))


@pytest.fixture(scope="session")
def shared_folder(tmp_path_factory) -> Path:
    """A folder of this test run, the same for all its processes."""
    own = tmp_path_factory.getbasetemp()
    return own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
