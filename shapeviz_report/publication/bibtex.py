"""A BibTeX entry for a database."""

from __future__ import annotations

import re

from shapeviz_report.types import Publication

_SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
}


def is_bibtex(citation: str) -> bool:
    """Whether a citation is an entry already, and no reference in words."""
    return re.match(r"@\w+\s*\{", citation) is not None


def bibtex_entry(title: str, publication: Publication) -> str | None:
    """The owner's own entry, or one made of the title and the creator; None if none of them is known.

    It names no year, because nobody told it.
    """
    if publication.citation is not None and is_bibtex(publication.citation):
        return publication.citation
    if publication.creator is None:
        return None
    fields = {
        "author": f"{{{_escaped(publication.creator)}}}",
        "title": f"{{{_escaped(title)}}}",
        "howpublished": None if publication.url is None else rf"\url{{{publication.url}}}",
        "note": None if publication.citation is None else _escaped(publication.citation),
    }
    lines = [f"  {name} = {{{value}}}," for name, value in fields.items() if value is not None]
    key = re.sub(r"[^a-z0-9]+", "-", title.casefold()).strip("-") or "shapes"
    return "\n".join((f"@misc{{{key},", *lines, "}"))


def _escaped(text: str) -> str:
    return "".join(_SPECIAL.get(letter, letter) for letter in " ".join(text.split()))
