"""A small real database, built for real: read, remesh, describe, render, project, write."""

from __future__ import annotations

from pathlib import Path

import pytest
from small_database import WITH_SEARCH, write_database

import shapeviz_report


@pytest.fixture(scope="session")
def cache(shared_folder) -> Path:
    return shared_folder / "cache"


@pytest.fixture(scope="session")
def database(tmp_path_factory) -> Path:
    return write_database(tmp_path_factory.mktemp("solids") / "Some solids")


@pytest.fixture(scope="session")
def built(database, cache, tmp_path_factory):
    """The site of ``database`` and its report."""
    site = tmp_path_factory.mktemp("sites") / "site"
    return site, shapeviz_report.build(database, site, cache=cache, **WITH_SEARCH)
