"""Markdown to HTML, for the owner's introduction. The only import of markdown_it."""

from __future__ import annotations

from itertools import pairwise

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup

#: CommonMark and tables; HTML in the text stays text. No pictures: they would be files of elsewhere.
_PARSER = MarkdownIt("commonmark", {"html": False}).enable("table").disable("image")


def render_markdown(text: str, first: int = 2) -> Markup:
    """Safe HTML. The highest headings are of level ``first``, below that of what the text stands in."""
    tokens = _PARSER.parse(text)
    down = first - min((int(token.tag[1]) for token in tokens if token.type == "heading_open"), default=first)
    for token in tokens:
        if token.type in ("heading_open", "heading_close"):
            token.tag = f"h{min(int(token.tag[1]) + down, 6)}"
        if token.type == "th_open" or token.type == "td_open":
            # Alignment would be a style attribute, which the site's policy refuses.
            token.attrs = {}
    return Markup(_PARSER.renderer.render(tokens, _PARSER.options, {}))


def first_paragraph(text: str) -> str:
    """The words of the first paragraph; empty if there is none."""
    tokens = _PARSER.parse(text)
    for opening, inline in pairwise(tokens):
        if opening.type == "paragraph_open" and opening.level == 0:
            return " ".join("".join(_words(token) for token in inline.children or ()).split())
    return ""


def _words(token: Token) -> str:
    return " " if token.type in ("softbreak", "hardbreak") else token.content
