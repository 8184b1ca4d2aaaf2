"""What a page consists of, for tests that look at tags and attributes."""

from __future__ import annotations

from collections.abc import Iterator
from html.parser import HTMLParser


class Markup(HTMLParser):
    """Tags with their attributes, and the text within each up to the next tag."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self._texts: list[list[str]] = []
        self._within = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        self._texts.append([])
        self._within = True

    def handle_endtag(self, tag):
        self._within = False

    def handle_data(self, data):
        if self._within:
            self._texts[-1].append(data)

    def texts(self, tag: str) -> Iterator[tuple[dict[str, str | None], str]]:
        """The attributes of every element of a kind, with its text."""
        for (name, attributes), pieces in zip(self.tags, self._texts, strict=True):
            if name == tag:
                yield attributes, "".join(pieces)
