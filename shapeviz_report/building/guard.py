"""What is refused before anything is computed: places where a build may not write."""

from __future__ import annotations

import os
from pathlib import Path

from shapeviz_report.config import Config
from shapeviz_report.errors import CacheError, SiteError
from shapeviz_report.places import explain, holds, tried
from shapeviz_report.types import Database
from shapeviz_report.writing import check_destination


def check_cache(root: Path, database: Path | None) -> None:
    """Refuse a folder of kept results that cannot be written, or whose files a database would read as its own.

    Raises
    ------
    CacheError
    """
    if database is not None and os.path.isdir(database) and holds(database, root):
        below = root.resolve().relative_to(database.resolve()).parts
        if not any(part.startswith(".") for part in below):
            raise CacheError(
                f"the cache {root} lies in the database {database}, which would read it: name a folder elsewhere, or a "
                "hidden one, with --cache"
            )
    try:
        with tried(root):
            pass
    except OSError as error:
        raise CacheError(
            f"results cannot be kept in {root}: {explain(error)}. Name another folder with --cache"
        ) from error


def check_places(destination: Path, config: Config, cache: Path, database: Path | None) -> None:
    """Refuse, before anything is computed, a place for the site or for results that cannot be written, or where
    writing would touch what the build reads."""
    kept = {"the cache": cache}
    if database is not None:
        kept["the database"] = database
    for name in ("introduction", "logo", "bins"):
        if (path := getattr(config, name)) is not None:
            kept[f"the file of the option {name}"] = path
    for name in ("external", "coordinates"):
        kept |= {f"the file {path.name} of the option {name}": path for path in getattr(config, name)}
    check_destination(destination, single_file=config.single_file, kept=kept)
    if holds(cache, destination):
        raise SiteError(f"{destination} lies in the cache {cache}: choose another place for the site")
    check_cache(cache, database)


def check_meshes(destination: Path, database: Database) -> None:
    """Refuse a site that would be written among the meshes it shows, wherever a table found them."""
    for folder in sorted({shape.path.parent for shape in database.shapes}):
        if holds(destination, folder):
            raise SiteError(
                f"{destination} holds meshes of the database (in {folder}): choose another place for the site"
            )
