"""What the owner of a database says of it where it is published."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Licence:
    """What readers may do with the shapes.

    Attributes
    ----------
    text : str
        As people know it: a name, an identifier, or the owner's own words.
    url : str or None
        Where it can be read.
    """

    text: str
    url: str | None = None


@dataclass(frozen=True)
class Logo:
    """A picture that stands beside the title.

    Attributes
    ----------
    suffix : str
        ``.svg``, ``.png`` or ``.webp``: what the content really is.
    content : bytes
    """

    suffix: str
    content: bytes


@dataclass(frozen=True)
class Accent:
    """The site's one accent colour, for pages by day and by night, as ``#rrggbb``. Each can be read as text on the
    pages of its theme."""

    light: str
    dark: str


@dataclass(frozen=True)
class Publication:
    """What the owner of a database says of it; whatever is not said is None.

    Attributes
    ----------
    description : str or None
        A sentence or two, for search engines and previews of links.
    introduction : str or None
        Markdown.
    logo : Logo or None
    accent : Accent or None
    licence : Licence or None
        Of the whole database.
    citation : str or None
        How to cite the database: a reference, or an entry in BibTeX, which begins with ``@``.
    creator : str or None
        Who made the database.
    url : str or None
        Where the site will be, with a slash at the end.
    date : str or None
        The day of publication, as ``2026-11-30``.
    """

    description: str | None = None
    introduction: str | None = None
    logo: Logo | None = None
    accent: Accent | None = None
    licence: Licence | None = None
    citation: str | None = None
    creator: str | None = None
    url: str | None = None
    date: str | None = None
