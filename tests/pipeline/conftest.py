"""A small real database, built for real: read, remesh, describe, render, project, write."""

from __future__ import annotations

import fcntl
import os
import shutil
from pathlib import Path

import pytest
from small_database import OPTIONS, WITH_SEARCH, write_database

import shapeviz_report


@pytest.fixture(scope="session")
def database(tmp_path_factory) -> Path:
    return write_database(tmp_path_factory.mktemp("solids") / "Some solids")


@pytest.fixture(scope="session")
def first_cache(shared_folder) -> Path:
    """What ``built`` put into an empty cache, and nothing else."""
    return shared_folder / "first-cache"


@pytest.fixture(scope="session")
def built(database, first_cache, tmp_path_factory):
    """The site of ``database`` and its report."""
    site = tmp_path_factory.mktemp("sites") / "site"
    with open(first_cache.with_suffix(".lock"), "w") as lock:
        # the process that comes second finds all of it there
        fcntl.flock(lock, fcntl.LOCK_EX)
        return site, shapeviz_report.build(database, site, cache=first_cache, **WITH_SEARCH)


@pytest.fixture(scope="session")
def unsearched(database, cache, tmp_path_factory) -> Path:
    """The site of ``database`` without a search."""
    site = tmp_path_factory.mktemp("unsearched") / "site"
    shapeviz_report.build(database, site, cache=cache, **OPTIONS)
    return site


@pytest.fixture(scope="session")
def cache(shared_folder, first_cache, built) -> Path:
    """A cache for all tests of all processes, which begins with what ``built`` needed."""
    folder = shared_folder / "cache"
    with open(folder.with_suffix(".lock"), "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.exists():
            shutil.copytree(first_cache, folder, copy_function=os.link)
    return folder


@pytest.fixture
def own_cache(first_cache, built, tmp_path) -> Path:
    """A cache with what ``built`` needed, for a test that counts what else comes into it."""
    return Path(shutil.copytree(first_cache, tmp_path / "own-cache", copy_function=os.link))
