"""A gallery of places in the live demo, each with a picture that is taken of it while the documentation is made.

A picture is of the page that its link leads to, so it is of this version; and a link to what is not there ends the
build, since that page says so.
"""

from __future__ import annotations

import hashlib
import io
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from html import escape
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import directives
from PIL import Image
from playwright.sync_api import Browser, sync_playwright
from sphinx.application import Sphinx
from sphinx.errors import SphinxError
from sphinx.util.docutils import SphinxDirective
from sphinx.writers.html5 import HTML5Translator

BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
THEMES = ("light", "dark")
WINDOW = {"width": 1120, "height": 700}
PICTURE = (960, 600)
STILL = """() => new Promise((resolve, reject) => {
  const resolved = () => [...document.images].every((image) => image.complete) ? resolve() : wait();
  let timer;
  const wait = () => { clearTimeout(timer); timer = setTimeout(resolved, 1000); };
  new MutationObserver(wait).observe(document, { attributes: true, childList: true, subtree: true });
  setTimeout(() => reject(new Error("the page does not come to rest")), 60000);
  wait();
})"""
"""Waits until a page has changed nothing for a second."""


class GalleryError(SphinxError):
    category = "Gallery error"


class Example(nodes.General, nodes.Element):
    """A place in the demo: its picture, its title and what there is to see."""


class ExampleDirective(SphinxDirective):
    """``{example} TITLE`` with the address as an option, and what there is to see as its content."""

    required_arguments = 1
    final_argument_whitespace = True
    has_content = True
    option_spec = {"address": directives.unchanged_required}  # noqa: RUF012

    def run(self) -> list[nodes.Node]:
        node = Example(
            "", *self.parse_content_to_nodes(), title=self.arguments[0], address=self.options["address"]
        )
        self.set_source_info(node)
        return [node]


class Live(SphinxDirective):
    """``{live} TITLE``: a page of the demo in a frame."""

    required_arguments = 1
    final_argument_whitespace = True
    option_spec = {"address": directives.unchanged_required}  # noqa: RUF012

    def run(self) -> list[nodes.Node]:
        title, address = map(escape, (self.arguments[0], self.options["address"]))
        frame = f'<iframe class="live" title="{title}" src="{address}"></iframe>'
        link = f'<p><a href="{address}">{title}, in the whole window</a></p>'
        return [nodes.raw("", frame + link, format="html")]


def visit_example(writer: HTML5Translator, node: Example) -> None:
    title, address = escape(node["title"]), escape(node["address"])
    pictures = "".join(
        f'<img class="only-{theme}" src="_images/{node["picture"]}-{theme}.webp" alt="" loading="lazy" '
        f'width="{PICTURE[0]}" height="{PICTURE[1]}">'
        for theme in THEMES
    )
    writer.body.append(f'<div class="example"><a href="{address}">{pictures}<span>{title}</span></a>')


def depart_example(writer: HTML5Translator, node: Example) -> None:
    writer.body.append("</div>")


def name_pictures(app: Sphinx, doctree: nodes.document, document: str) -> None:
    """Name each picture by what it shows: the address, the files of the site, and how it is taken."""
    for node in doctree.findall(Example):
        site = live_folder(app) / node["address"].partition("#")[0]
        record = site.parent / "data" / "files.json"
        shown = record if record.is_file() else site
        if not site.is_file():
            raise GalleryError(f"{document}: the example {node['title']!r} is of {site}, which is not there")
        content = node["address"].encode() + shown.read_bytes() + Path(__file__).read_bytes()
        node["picture"] = f"{nodes.make_id(node['title'])}-{hashlib.sha256(content).hexdigest()[:8]}"
        app.env.examples[node["picture"]] = node["address"]


def start(app: Sphinx) -> None:
    app.env.examples = {}


def take_pictures(app: Sphinx, error: Exception | None) -> None:
    """Put the pictures of all examples beside the pages."""
    if error is not None:
        return
    kept = live_folder(app).parent / "pictures"  # from one build to the next
    files = {name: [kept / f"{name}-{theme}.webp" for theme in THEMES] for name in app.env.examples}
    missing = {name: paths for name, paths in files.items() if not all(path.is_file() for path in paths)}
    if missing:
        kept.mkdir(parents=True, exist_ok=True)
        with opened_browser() as browser:
            for name, paths in missing.items():
                address = f"{live_folder(app).as_uri()}/{app.env.examples[name]}"
                for path, picture in zip(paths, photograph(browser, address), strict=True):
                    path.write_bytes(picture)
    target = Path(app.outdir) / "_images"
    target.mkdir(exist_ok=True)
    for paths in files.values():
        for path in paths:
            shutil.copy(path, target)


@contextmanager
def opened_browser() -> Iterator[Browser]:
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        raise GalleryError(f"pictures of the demo need a browser: install {BROWSERS[0]}")
    with sync_playwright() as playwright:
        yield playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])


def photograph(browser: Browser, address: str) -> list[bytes]:
    """Pictures of a page in each theme, as WebP.

    Raises
    ------
    GalleryError
        The page fails, or says that its address names what is not there.
    """
    page = browser.new_page(viewport=WINDOW, reduced_motion="reduce")
    said: list[str] = []
    page.on("pageerror", lambda error: said.append(str(error)))
    pictures = []
    try:
        page.goto(address)
        for theme in THEMES:
            page.emulate_media(color_scheme=theme)
            page.evaluate(STILL)
            said += page.locator("#missing p").all_inner_texts()
            with Image.open(io.BytesIO(page.screenshot())) as screen, io.BytesIO() as file:
                screen.convert("RGB").resize(PICTURE, Image.Resampling.LANCZOS).save(file, "WEBP", quality=82)
                pictures.append(file.getvalue())
    finally:
        page.close()
    if said:
        raise GalleryError(f"{address}: {said[0]}")
    return pictures


def live_folder(app: Sphinx) -> Path:
    """Where the demo's sites are, which are copied beside the pages."""
    return (Path(app.confdir) / app.config.html_extra_path[0]).resolve()


def setup(app: Sphinx) -> None:
    app.add_node(Example, html=(visit_example, depart_example))
    app.add_directive("example", ExampleDirective)
    app.add_directive("live", Live)
    app.connect("env-before-read-docs", lambda app, env, names: start(app))
    app.connect("doctree-resolved", name_pictures)
    app.connect("build-finished", take_pictures)
