"""What all pages share: scripts, style, pictures of the site itself, and the data in chunks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from types import MappingProxyType

from shapeviz_report.pages import PAGES, Page, PageContent
from shapeviz_report.types import Accent, Report
from shapeviz_report.writing.joiner import join, join_pages
from shapeviz_report.writing.packing import pack
from shapeviz_report.writing.resources import site_folder

#: The layers of the style sheet, each over those before it: a sheet of that name in ``site/styles``, or a folder.
LAYERS = ("tokens", "base", "components", "pages", "paper")


@cache
def join_scripts() -> Mapping[str, str]:
    """The scripts by their file below ``assets/``; ``first.js`` is the one that runs before anything is painted, and
    ``shared.js`` before the script of a page."""
    source = site_folder()
    entries = {f"{page.name}.js": source / "scripts" / "pages" / f"{page.name}.js" for page in PAGES}
    return MappingProxyType(
        {
            "first.js": join(source / "scripts" / "opening" / "first.js"),
            # Unwrapped, Vega would leave thousands of names on the window.
            "vega.js": f"(() => {{\n{(source / 'vendor' / 'vega.js').read_text(encoding='utf-8')}\n}})();\n",
            **join_pages(entries, source / "scripts"),
        }
    )


def style_sheets() -> list[tuple[str, Path]]:
    """The style sheets in their order, each with its layer."""
    styles = site_folder() / "styles"
    return [
        (layer, sheet)
        for layer in LAYERS
        for sheet in (styles / f"{layer}.css", *sorted((styles / layer).glob("*.css")))
        if sheet.exists()
    ]


def join_styles(report: Report) -> str:
    """The style sheet, with the accent of the owner."""
    sheets = [
        f"@layer {layer} {{\n{sheet.read_text(encoding='utf-8')}}}\n" for layer, sheet in style_sheets()
    ]
    accent = report.publication.accent
    return "\n".join(sheets if accent is None else [*sheets, _accent_style(accent)])


def _accent_style(accent: Accent) -> str:
    """The rule of ``tokens.css`` for the accent colour again, over all layers."""
    return f":root {{ --accent: light-dark({accent.light}, {accent.dark}); }}\n"


def collect_assets(report: Report) -> dict[str, bytes]:
    """The files below ``assets/`` that are neither script nor style, by name."""
    source = site_folder()
    logo = report.publication.logo
    return {
        "icon.svg": (source / "icon.svg").read_bytes(),
        "vega-licenses.txt": (source / "vendor" / "LICENSES.txt").read_bytes(),
        **({} if logo is None else {f"logo{logo.suffix}": logo.content}),
    }


def pack_chunks(contents: Sequence[tuple[Page, PageContent]]) -> dict[str, tuple[str, bytes]]:
    """The data of all pages by name: its kind, and gzipped content."""
    chunks: dict[str, tuple[str, bytes]] = {}
    for page, content in contents:
        for name, value in content.chunks.items():
            packed = pack(value)
            if chunks.setdefault(name, packed) != packed:
                raise ValueError(f"page {page.name!r} disagrees with an earlier page on chunk {name!r}")
    chunks["engine"] = pack(join(site_folder() / "scripts" / "engine" / "worker.js"))
    return chunks
