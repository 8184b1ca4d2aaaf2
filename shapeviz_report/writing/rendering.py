"""Pages in HTML. The only import of jinja2."""

from __future__ import annotations

import codecs
from collections.abc import Iterator, Sequence
from importlib.metadata import version

import jinja2
from markupsafe import Markup

from shapeviz_report.pages import PAGES, Page, PageContent
from shapeviz_report.pages.base import change, class_names, grouped, kind_of_group, stand_in
from shapeviz_report.types import Report
from shapeviz_report.writing import preview
from shapeviz_report.writing.data import json_text
from shapeviz_report.writing.linked_data import dataset, describe
from shapeviz_report.writing.markdown import first_paragraph, render_markdown
from shapeviz_report.writing.resources import templates_folder

#: Nothing but the site's own files. ``file:`` stands beside ``'self'`` because a page opened by double-click has no
#: origin that ``'self'`` could mean. Trusted Types, where a browser knows them, make it impossible that a script
#: turns text from a database into markup; the one policy allowed is that of scripts/opening/trusted.js.
CONTENT_SECURITY_POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self' file:",
        "style-src 'self' file:",
        "img-src 'self' file: data: blob:",
        "worker-src blob:",
        "base-uri 'none'",
        "form-action 'none'",
        "require-trusted-types-for 'script'",
        "trusted-types default",
    )
)


class _Compiled(jinja2.BytecodeCache):
    """Templates that this process has compiled: a site of a few shapes waits for little else."""

    def __init__(self) -> None:
        self._code: dict[str, bytes] = {}

    def load_bytecode(self, bucket: jinja2.bccache.Bucket) -> None:
        if code := self._code.get(bucket.key):
            bucket.bytecode_from_string(code)

    def dump_bytecode(self, bucket: jinja2.bccache.Bucket) -> None:
        self._code[bucket.key] = bucket.bytecode_to_string()


_COMPILED = _Compiled()


def make_environment(*, single_file: bool = False, left_out: Sequence[str] = ()) -> jinja2.Environment:
    """What templates are rendered in. ``left_out`` are the paths of data that a site in one file does not hold."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(templates_folder()),
        bytecode_cache=_COMPILED,
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["markdown"] = render_markdown
    environment.filters["grouped"] = grouped
    environment.filters["change"] = change
    environment.globals["single_file"] = single_file
    environment.globals["left_out"] = left_out
    return environment


def compute_contents(report: Report) -> list[tuple[Page, PageContent]]:
    """Every page with what it shows."""
    return [(page, page.content(report)) for page in PAGES]


def render_pages(
    environment: jinja2.Environment, report: Report, contents: Sequence[tuple[Page, PageContent]]
) -> Iterator[tuple[Page, str]]:
    """Every page in HTML."""
    site = describe_site(report)
    for page, content in contents:
        template = environment.get_template(f"{page.name}.html")
        yield page, template.render(page=page, pages=PAGES, site=site, **content.context)


def describe_site(report: Report) -> dict[str, object]:
    """What every template may use, as ``site``."""
    said = report.publication
    description = describe(report)
    return {
        "publication": said,
        "description": description,
        "lead": said.description or first_paragraph(said.introduction or ""),
        "dataset": Markup(json_text(dataset(report, description)).replace("<", "\\u003c")),
        "preview_size": (preview.WIDTH, preview.HEIGHT),
        "logo": None if said.logo is None else f"logo{said.logo.suffix}",
        "title": report.database.name,
        "shapes": len(report.shapes),
        "classes": len(class_names(report)),
        "version": version("shapeviz-report"),
        "source": _source(report),
        "stand_in": stand_in(report),
        "kind": kind_of_group(report),
        "kinds": kind_of_group(report, 2),
        "labels": "clusters" if stand_in(report) else "labels",
    }


def _source(report: Report) -> str:
    """Where a figure that leaves the site is from, in one line."""
    said = report.publication
    # An entry in BibTeX is for programs, not for a line below a figure.
    cited = (
        None if said.citation is None or said.citation.startswith("@") else " ".join(said.citation.split())
    )
    parts = [
        f"Source: {report.database.name}, {grouped(len(report.shapes))} shapes"
        + (f", by {said.creator}" if said.creator else ""),
        cited,
        said.url,
        said.licence and f"Licence: {said.licence.text}",
        f"Made with shapeviz-report {version('shapeviz-report')}",
    ]
    return " · ".join(part for part in parts if part)


def encode(text: str) -> bytes:
    """A page, a script or a style sheet as a file. Its first bytes say that it is UTF-8, and count more than
    what a host says of it."""
    # A file name that is no text may stand in one.
    return codecs.BOM_UTF8 + text.encode("utf-8", "backslashreplace")
