"""Links that go by the name of a document's file, as they read well in the repository, have its title on pages."""

from __future__ import annotations

import posixpath
import re

from docutils import nodes
from sphinx.application import Sphinx


def use_titles(app: Sphinx, doctree: nodes.document, document: str) -> None:
    for link in doctree.findall(nodes.reference):
        if re.fullmatch(r"[\w-]+\.md", link.astext()):
            page = link["refuri"].partition("#")[0].removesuffix(".html")
            target = posixpath.normpath(posixpath.join(posixpath.dirname(document), page))
            link.children = [nodes.inline("", app.env.titles[target].astext())]


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("doctree-resolved", use_titles)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
