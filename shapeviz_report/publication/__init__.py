"""What the owner of a database says of it, read from the options and checked before anything long begins."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date
from pathlib import Path
from urllib.parse import urlsplit

from shapeviz_report.config import Config
from shapeviz_report.errors import ConfigError
from shapeviz_report.files import TooLargeError, read_regular
from shapeviz_report.publication.accent import fit_accent
from shapeviz_report.publication.licence import LICENCE_COLUMNS, find_licence
from shapeviz_report.publication.logo import read_logo
from shapeviz_report.types import Publication, ShapeEntry

__all__ = ["has_licence", "licence_warning", "read_publication"]

MOST_INTRODUCTION = 100_000
"""Bytes of an introduction: it is read before the map, and not instead of it."""


def read_publication(config: Config) -> Publication:
    """Read and check what the options say of the database.

    Raises
    ------
    ConfigError
        The introduction or the logo cannot be read, the accent is no colour, the address no address, the date no day.
    """
    return Publication(
        description=_one_line(config.description),
        introduction=None if config.introduction is None else _read_introduction(config.introduction),
        logo=None if config.logo is None else read_logo(config.logo),
        accent=None if config.accent is None else fit_accent(config.accent),
        licence=None if config.licence is None else find_licence(config.licence),
        citation=None if config.citation is None else config.citation.strip() or None,
        creator=_one_line(config.creator),
        url=None if config.url is None else _check_url(config.url),
        date=None if config.date is None else _check_date(config.date),
    )


def licence_warning(publication: Publication, shapes: Sequence[ShapeEntry]) -> str | None:
    """What to tell an owner whose readers cannot know what they may do with the shapes; None if they can.

    A licence is named for the database, or in a column of its table for each shape.
    """
    if publication.licence is not None:
        return None
    bare = sum(not has_licence(shape) for shape in shapes)
    if bare == 0:
        return None
    some = "1 shape has no licence" if bare == 1 else f"{bare:,} shapes have no licence"
    missing = "No licence is named" if bare == len(shapes) else some
    return (
        f"{missing}, so nobody can know what they may do with the shapes. Name one before you publish: "
        'licence = "CC-BY-4.0" in shapeviz.toml, or a column "licence" in the table.'
    )


def has_licence(shape: ShapeEntry) -> bool:
    """Whether a column of its table names the licence of a shape."""
    return any(
        column.casefold() in LICENCE_COLUMNS and value.strip() for column, value in shape.metadata.items()
    )


def _one_line(text: str | None) -> str | None:
    return None if text is None else " ".join(text.split()) or None


def _read_introduction(path: Path) -> str:
    try:
        content = read_regular(path, MOST_INTRODUCTION)
    except TooLargeError as error:
        raise ConfigError(
            f"the introduction {path} is too large; shorten it to {MOST_INTRODUCTION:,} bytes"
        ) from error
    except OSError as error:
        raise ConfigError(f"the introduction {path} cannot be read: {error.strerror}") from error
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ConfigError(f"the introduction {path} is not text in UTF-8 ({error.reason})") from error


def _check_url(url: str) -> str:
    try:
        parts = urlsplit(url)
    except ValueError as error:
        raise ConfigError(f"url {url!r} is no address: {error}") from error
    if parts.scheme not in ("http", "https") or not parts.hostname or parts.query or parts.fragment:
        raise ConfigError(
            f"url must be the address of the site's folder, such as https://example.org/shapes/, not {url!r}"
        )
    return url if url.endswith("/") else f"{url}/"


def _check_date(text: str) -> str:
    try:
        return date.fromisoformat(text.strip()).isoformat()
    except ValueError as error:
        raise ConfigError(
            f"date must be a day of the calendar, such as 2026-11-30, not {text[:40]!r}"
        ) from error
