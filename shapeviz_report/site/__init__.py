"""Writes the site: pages, scripts, pictures and data, all of it at once. The only import of jinja2."""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path

import jinja2
import numpy as np
from markupsafe import Markup

from shapeviz_report.errors import SiteError
from shapeviz_report.order import natural
from shapeviz_report.pages import PAGES, Page, PageContent
from shapeviz_report.pages.base import class_names
from shapeviz_report.pages.bins import model_name, painting_name
from shapeviz_report.pages.overview import thumbnail_name
from shapeviz_report.places import explain
from shapeviz_report.site import preview
from shapeviz_report.site.data_files import data_files, json_text
from shapeviz_report.site.destination import check_destination
from shapeviz_report.site.joiner import join, join_pages
from shapeviz_report.site.linked_data import catalogue, dataset, describe
from shapeviz_report.site.markdown import first_paragraph, render_markdown
from shapeviz_report.site.record import RECORD, find_own, record_text, sealed
from shapeviz_report.site.resources import site_folder, templates_folder
from shapeviz_report.site.single_file import (
    Inline,
    base64_text,
    data_address,
    handed_over,
    media_type,
    split_large,
)
from shapeviz_report.site.swap import replaced_folder
from shapeviz_report.types import Accent, Report
from shapeviz_report.writing import write_atomically

__all__ = ["check_destination", "write_site"]

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

#: The style sheets that make up the site's one, in their order.
STYLES = (
    "tokens.css",
    "page.css",
    "tray.css",
    "overview.css",
    "features.css",
    "retrieval.css",
    "workbench.css",
    "bin-chart.css",
    "bins.css",
    "shapes.css",
    "shape.css",
    "compare.css",
    "about.css",
    "publication.css",
)


#: Data of more bytes than this is left out of a site in one file; the About page says so.
MOST_EMBEDDED = 2_000_000


def write_site(report: Report, destination: Path, *, single_file: bool = False) -> None:
    """Write the site of ``report`` into the folder ``destination``, which changes in one step at the end.

    Parameters
    ----------
    report : Report
    destination : Path
        A folder that is not there yet, or holds an earlier site, or nothing but what publishers keep beside one. Only
        files that a site wrote are replaced; whatever else is in it stays.
    single_file : bool
        Write one HTML file instead, without 3D models; ``destination`` is its path.

    Raises
    ------
    SiteError
        If ``destination`` must not be replaced or cannot be written, or no shape is left to show.
    ValueError
        If the parts of the report do not fit together: an error of the caller.
    """
    destination = Path(destination)
    check_destination(destination, single_file=single_file)
    _check_report(report)
    try:
        if single_file:
            write_atomically(destination.resolve(), sealed(_whole(report)))
            return
        with replaced_folder(destination, find_own) as folder:
            hashes = {}
            for name, content in _files(report):
                path = folder / name
                path.parent.mkdir(exist_ok=True)
                path.write_bytes(content)
                hashes[name] = sha256(content).hexdigest()
            (folder / RECORD).write_bytes(record_text(hashes))
    except OSError as error:
        raise SiteError(f"the site cannot be written to {destination}: {explain(error)}") from error


def _files(report: Report) -> Iterator[tuple[str, bytes]]:
    """Every file of the site: path below its folder, and content. Models come last and one by one: those of 10,000
    shapes are nearly a gigabyte."""
    contents = _contents(report)
    assets = {
        **{name: text.encode() for name, text in _scripts().items()},
        **_other_assets(report),
        "style.css": _style(report).encode(),
        **{f"chunk-{name}.js": _handing_over(name, *packed) for name, packed in _chunks(contents).items()},
    }
    # The address of an asset names its content, so that a browser's cache never mixes two versions of a site.
    addresses = {name: f"assets/{name}?{sha256(data).hexdigest()[:8]}" for name, data in assets.items()}
    environment = _environment()
    environment.globals["asset"] = addresses.__getitem__
    environment.globals["content_security_policy"] = CONTENT_SECURITY_POLICY
    environment.globals["chunk_addresses"] = json.dumps(
        {
            name.removeprefix("chunk-").removesuffix(".js"): address
            for name, address in addresses.items()
            if name.startswith("chunk-")
        }
    )
    yield from {
        **{page.file: _encode(text) for page, text in _pages(environment, report, contents)},
        **{f"assets/{name}": content for name, content in assets.items()},
        **_pictures(report),
        "preview.png": preview.draw_preview(report),
        **_data(report),
    }.items()
    for model in report.models or ():
        name = model_name(model)
        yield f"models/{name}.js", _handing_over(f"model-{name}", "bytes", model)


def _whole(report: Report) -> bytes:
    """The site as one HTML file. It holds no 3D models: these would be most of it."""
    report = replace(report, models=None)
    contents = _contents(report)
    scripts = _scripts()
    inline = Inline(
        _style(report),
        (
            scripts.pop("first.js"),
            *(handed_over(f"assets/{name}", text) for name, text in scripts.items()),
            join(site_folder() / "scripts" / "opening" / "single-file.js"),
        ),
    )
    assets = {f"assets/{name}": content for name, content in _other_assets(report).items()}
    data, left_out = split_large(_data(report), MOST_EMBEDDED)
    environment = _environment(single_file=True, left_out=left_out)
    environment.globals["asset"] = "assets/".__add__
    environment.globals["content_security_policy"] = inline.policy
    *scripts_before, opening = map(Markup, inline.scripts)
    text = environment.get_template("single-file.html").render(
        site=_site_context(report),
        icon=data_address("icon.svg", assets["assets/icon.svg"]),
        style=Markup(inline.style),
        scripts=scripts_before,
        opening=opening,
        pages=[Markup(text) for _, text in _pages(environment, report, contents)],
        chunks=[(name, kind, base64_text(packed)) for name, (kind, packed) in _chunks(contents).items()],
        files=[
            (path, media_type(path), base64_text(content))
            for path, content in {**assets, **_pictures(report), **data}.items()
        ],
    )
    return _encode(text)


def _contents(report: Report) -> list[tuple[Page, PageContent]]:
    return [(page, page.content(report)) for page in PAGES]


def _pages(
    environment: jinja2.Environment, report: Report, contents: Sequence[tuple[Page, PageContent]]
) -> Iterator[tuple[Page, str]]:
    """Every page in HTML."""
    site = _site_context(report)
    for page, content in contents:
        template = environment.get_template(f"{page.name}.html")
        yield page, template.render(page=page, pages=PAGES, site=site, **content.context)


def _encode(text: str) -> bytes:
    # A file name that is no text may stand in one.
    return text.encode("utf-8", "backslashreplace")


def _pictures(report: Report) -> dict[str, bytes]:
    return {
        **{f"thumbnails/{thumbnail_name(thumbnail)}": thumbnail for thumbnail in report.thumbnails},
        **{
            f"paintings/{painting_name(picture)}": picture
            for painting in report.paintings
            for picture in (painting.value, painting.inside)
        },
    }


def _data(report: Report) -> dict[str, bytes]:
    files = data_files(report, version("shapeviz-report"))
    files["catalogue.jsonld"] = catalogue(report, describe(report))
    return {f"data/{name}": content for name, content in files.items()}


def _environment(*, single_file: bool = False, left_out: Sequence[str] = ()) -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(templates_folder()),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["markdown"] = render_markdown
    environment.globals["single_file"] = single_file
    environment.globals["left_out"] = left_out
    return environment


def _site_context(report: Report) -> dict[str, object]:
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
        "stand_in": report.clusters is not None and report.clusters.stand_in,
    }


def _style(report: Report) -> str:
    sheets = [(site_folder() / "styles" / name).read_text(encoding="utf-8") for name in STYLES]
    accent = report.publication.accent
    return "\n".join(sheets if accent is None else [*sheets, _accent_style(accent)])


def _accent_style(accent: Accent) -> str:
    """The rule of ``tokens.css`` for the accent colour again, and after it."""
    return f":root {{ --accent: light-dark({accent.light}, {accent.dark}); }}\n"


def _scripts() -> dict[str, str]:
    """The scripts by their file below ``assets/``; ``first.js`` is the one that runs before anything is painted, and
    ``shared.js`` before the script of a page."""
    source = site_folder()
    entries = {f"{page.name}.js": source / "scripts" / "pages" / f"{page.name}.js" for page in PAGES}
    return {
        "first.js": join(source / "scripts" / "opening" / "first.js"),
        # Unwrapped, Vega would leave thousands of names on the window.
        "vega.js": f"(() => {{\n{(source / 'vendor' / 'vega.js').read_text(encoding='utf-8')}\n}})();\n",
        **join_pages(entries, source / "scripts"),
    }


def _other_assets(report: Report) -> dict[str, bytes]:
    source = site_folder()
    logo = report.publication.logo
    return {
        "icon.svg": (source / "icon.svg").read_bytes(),
        "vega-licenses.txt": (source / "vendor" / "LICENSES.txt").read_bytes(),
        **({} if logo is None else {f"logo{logo.suffix}": logo.content}),
    }


def _chunks(contents: Sequence[tuple[Page, PageContent]]) -> dict[str, tuple[str, bytes]]:
    """The data of all pages by name: its kind, ``json`` or ``bytes``, and gzipped content."""
    chunks: dict[str, object] = {}
    for page, content in contents:
        for name, value in content.chunks.items():
            if name in chunks and chunks[name] != value:
                raise ValueError(f"page {page.name!r} disagrees with an earlier page on chunk {name!r}")
            chunks[name] = value
    chunks["engine"] = join(site_folder() / "scripts" / "engine" / "worker.js")
    return {name: _packed(value) for name, value in chunks.items()}


def _packed(value: object) -> tuple[str, bytes]:
    kind, content = ("bytes", value) if isinstance(value, bytes) else ("json", json_text(value).encode())
    return kind, gzip.compress(content, compresslevel=9, mtime=0)


def _handing_over(name: str, kind: str, packed: bytes) -> bytes:
    """A script that hands gzipped data to the page: the one way to load any from ``file://``."""
    text = base64.b64encode(packed).decode()
    return f"shapeviz.receive({json.dumps(name)}, {json.dumps(kind)}, {json.dumps(text)});\n".encode()


def _is_webp(picture: bytes) -> bool:
    return picture[:4] == b"RIFF" and picture[8:12] == b"WEBP"


def _check_report(report: Report) -> None:
    """Check once, here, what templates and scripts then take for granted."""
    count = len(report.shapes)
    if count == 0:
        raise SiteError(
            f"no shape of {report.database.name!r} could be used ({len(report.failures)} files failed): "
            "there is nothing to show"
        )
    ids = tuple(shape.id for shape in report.shapes)

    def require(holds: bool, what: str) -> None:
        if not holds:
            raise ValueError(f"inconsistent report: {what}")

    require(len(set(ids)) == count, "two shapes share an id")
    require(list(ids) == sorted(ids, key=natural), "shapes are not sorted by id")
    require(ids == report.features.shape_ids, "feature rows are not those of the shapes")
    require(
        report.features.values.shape == (count, len(report.features.columns)), "feature table of another size"
    )
    require(bool(np.isfinite(report.features.values).all()), "a feature is not finite")
    dimensions = sum(block.dimensions for block in report.features.blocks if block.bins > 1)
    require(report.edges.shape == (dimensions, 11), "edges do not match the features")
    if report.scores is not None:
        classes = class_names(report)
        require(report.scores.classes == classes, "scores do not match the classes")
        size = (len(report.scores.methods), len(classes), len(report.features.columns))
        require(report.scores.values.shape == size, "scores of another size")
        held = (report.scores.values >= 0) & (report.scores.values <= 1)
        require(bool(held.all()), "a score is not in [0, 1]")
    for name in ("facts", "thumbnails", "labels"):
        require(len(getattr(report, name)) == count, f"{name} do not match the shapes")
    for picture in report.thumbnails:
        require(_is_webp(picture), "a thumbnail is not a WebP image")
    for painting in report.paintings:
        require(painting.column in report.features.columns, "a painting of a bin that is not there")
        require(0 <= painting.shape < count, "a painting of a shape that is not there")
        require(_is_webp(painting.value) and _is_webp(painting.inside), "a painting is not a WebP image")
    if report.clusters is not None:
        clusters = report.clusters
        require(clusters.of.shape == (count,), "clusters do not match the shapes")
        sizes = np.bincount(clusters.of, minlength=len(clusters.clusters)).tolist()
        require(sizes == [cluster.size for cluster in clusters.clusters], "a cluster of another size")
        for number, cluster in enumerate(clusters.clusters):
            require(clusters.of[cluster.central] == number, "the centre of a cluster is not in it")
        names = [clusters.clusters[number].name for number in clusters.of]
        require(not clusters.stand_in or list(report.labels) == names, "labels are not the clusters")
    if report.models is not None:
        require(len(report.models) == count, "models do not match the shapes")
        require(all(model[:2] == b"\x1f\x8b" for model in report.models), "a model is not gzipped")
    require(report.labeling is not None or not any(report.labels), "labels without a labeling")
    require(bool(report.projections), "no projection")
    for method, (projection, quality) in report.projections.items():
        require(method.isidentifier() and method == projection.method, f"projection {method!r} is misnamed")
        require(projection.xy.shape == (count, 2), f"projection {method} has another number of points")
        require(bool(np.isfinite(projection.xy).all()), f"projection {method} has a point that is not finite")
        require(quality.nh.shape == (count,), f"quality of {method} has another number of shapes")
