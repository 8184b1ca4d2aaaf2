"""Writes the site: pages, scripts, pictures and data, all of it at once."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from hashlib import sha256
from importlib.metadata import version
from itertools import chain
from pathlib import Path

from markupsafe import Markup

from shapeviz_report.errors import SiteError
from shapeviz_report.pages import Page, PageContent
from shapeviz_report.pages.base import is_in_full
from shapeviz_report.pages.bins import model_name, painting_name
from shapeviz_report.pages.overview import thumbnail_name
from shapeviz_report.places import explain
from shapeviz_report.staging import write_atomically
from shapeviz_report.types import Report
from shapeviz_report.writing import preview
from shapeviz_report.writing.assets import collect_assets, join_scripts, join_styles, pack_chunks
from shapeviz_report.writing.croissant import croissant
from shapeviz_report.writing.data import data_files
from shapeviz_report.writing.destination import check_destination
from shapeviz_report.writing.joiner import join
from shapeviz_report.writing.linked_data import catalogue, describe
from shapeviz_report.writing.packing import chunk_script, pack
from shapeviz_report.writing.record import RECORD, find_own, record_text, sealed
from shapeviz_report.writing.rendering import (
    CONTENT_SECURITY_POLICY,
    compute_contents,
    describe_site,
    encode,
    make_environment,
    render_pages,
)
from shapeviz_report.writing.resources import site_folder
from shapeviz_report.writing.ro_crate import RO_CRATE, is_crate, ro_crate
from shapeviz_report.writing.sheets import write_sheets
from shapeviz_report.writing.single_file import (
    Inline,
    base64_text,
    data_address,
    handed_over,
    media_type,
    split_large,
)
from shapeviz_report.writing.swap import replaced_folder

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
        If ``destination`` must not be replaced or cannot be written.
    """
    destination = Path(destination)
    check_destination(destination, single_file=single_file)
    try:
        if single_file:
            write_atomically(destination.resolve(), sealed(whole_site(report)))
            return
        with replaced_folder(destination, find_own) as folder:
            sizes: dict[str, int] = {}
            hashes: dict[str, str] = {}

            def write(name: str, content: bytes) -> None:
                path = folder / name
                path.parent.mkdir(exist_ok=True)
                path.write_bytes(content)
                sizes[name], hashes[name] = len(content), sha256(content).hexdigest()

            for name, content in _files(report):
                write(name, content)
            if is_crate(report.publication):
                write(RO_CRATE, ro_crate(report, describe(report), sizes, hashes))
            (folder / RECORD).write_bytes(record_text(hashes))
    except OSError as error:
        raise SiteError(f"the site cannot be written to {destination}: {explain(error)}") from error


def _files(report: Report) -> Iterator[tuple[str, bytes]]:
    """Every file of the site: path below its folder, and content. What is large comes bit by bit: pictures of 100,000
    shapes are half a gigabyte, and models of 10,000 are nearly one."""
    contents = compute_contents(report)
    chunks: dict[str, str] = {}
    counts = Counter[str]()
    for _, content in contents:
        for name, parts in content.parts.items():
            digest = sha256()
            for number, part in enumerate(parts):
                script = chunk_script(f"{name}-{number}", *_pack_part(name, part))
                digest.update(script)
                counts[name] += 1
                yield f"chunks/{name}-{number}.js", script
            chunks[name] = f"chunks/{name}-*.js?{digest.hexdigest()[:8]}"
    assets = {
        **{name: encode(text) for name, text in join_scripts().items()},
        **collect_assets(report),
        "style.css": encode(join_styles(report)),
        **{f"chunk-{name}.js": chunk_script(name, *packed) for name, packed in pack_chunks(contents).items()},
        "chunk-paintings.js": _held_paintings(report),
    }
    # The address of an asset names its content, so that a browser's cache never mixes two versions of a site.
    addresses = {name: f"assets/{name}?{sha256(data).hexdigest()[:8]}" for name, data in assets.items()}
    environment = make_environment()
    environment.globals["asset"] = addresses.__getitem__
    environment.globals["parts"] = lambda name: [
        chunks[name].replace("*", str(number)) for number in range(counts[name])
    ]
    environment.globals["content_security_policy"] = CONTENT_SECURITY_POLICY
    chunks |= {
        name.removeprefix("chunk-").removesuffix(".js"): address
        for name, address in addresses.items()
        if name.startswith("chunk-")
    }
    environment.globals["chunk_addresses"] = json.dumps(chunks)
    for page, text in render_pages(environment, report, contents):
        yield page.file, encode(text)
    for name, asset in assets.items():
        yield f"assets/{name}", asset
    yield from _thumbnails(report)
    yield from write_sheets(report)
    yield from _paintings(report)
    yield "preview.png", preview.draw_preview(report)
    yield from _data(report)
    for model in report.models or ():
        name = model_name(model)
        yield f"models/{name}.js", chunk_script(f"model-{name}", "bytes", model)
    if report.exported is not None:
        for name, file in zip(report.exported.names, report.exported.contents, strict=True):
            yield f"gltf/{name}", file


def whole_site(report: Report) -> bytes:
    """The site as one HTML file. It holds no 3D models and no glTF: these would be most of it."""
    report = replace(report, models=None, exported=None)
    contents = compute_contents(report)
    scripts = dict(join_scripts())
    inline = Inline(
        join_styles(report),
        (
            scripts.pop("first.js"),
            *(handed_over(f"assets/{name}", text) for name, text in scripts.items()),
            join(site_folder() / "scripts" / "opening" / "single-file.js"),
        ),
    )
    assets = {f"assets/{name}": content for name, content in collect_assets(report).items()}
    data, left_out = split_large(dict(_data(report)), MOST_EMBEDDED)
    environment = make_environment(single_file=True, left_out=left_out)
    environment.globals["asset"] = "assets/".__add__
    environment.globals["parts"] = lambda name: ()
    environment.globals["content_security_policy"] = inline.policy
    *scripts_before, opening = map(Markup, inline.scripts)
    text = environment.get_template("single-file.html").render(
        site=describe_site(report),
        icon=data_address("icon.svg", assets["assets/icon.svg"]),
        style=Markup(inline.style),
        scripts=scripts_before,
        opening=opening,
        pages=[Markup(text) for _, text in render_pages(environment, report, contents)],
        chunks=[
            (name, kind, base64_text(packed))
            for name, (kind, packed) in [*pack_chunks(contents).items(), *_packed_parts(report, contents)]
        ],
        files=[
            (path, media_type(path), base64_text(content))
            for path, content in chain(
                assets.items(), _thumbnails(report), write_sheets(report), _paintings(report), data.items()
            )
        ],
    )
    return encode(text)


def _packed_parts(
    report: Report, contents: Sequence[tuple[Page, PageContent]]
) -> Iterator[tuple[str, tuple[str, bytes]]]:
    for _, content in contents:
        for name, parts in content.parts.items():
            if name != "pictures" or not is_in_full(report):
                for number, part in enumerate(parts):
                    yield f"{name}-{number}", _pack_part(name, part)


def _pack_part(name: str, part: object) -> tuple[str, bytes]:
    return pack(part, compressed=name != "pictures")


def _thumbnails(report: Report) -> Iterator[tuple[str, bytes]]:
    if is_in_full(report):
        for thumbnail in report.thumbnails:
            yield f"thumbnails/{thumbnail_name(thumbnail)}", thumbnail


def _paintings(report: Report) -> Iterator[tuple[str, bytes]]:
    for painting in report.paintings:
        for picture in (painting.value, painting.inside):
            yield f"paintings/{painting_name(picture)}", picture


def _held_paintings(report: Report) -> bytes:
    """The paintings once more, as text that a page from ``file://`` can read: it shows images, but does not know what
    is in them, and puts them into the figures that readers take away."""
    return chunk_script(
        "paintings", *pack({path: base64_text(content) for path, content in _paintings(report)})
    )


def _data(report: Report) -> Iterator[tuple[str, bytes]]:
    hashes = {}
    for name, content in data_files(report, version("shapeviz-report")):
        hashes[name] = sha256(content).hexdigest()
        yield f"data/{name}", content
    yield "data/catalogue.jsonld", catalogue(report, describe(report))
    yield "data/croissant.json", croissant(report, describe(report), hashes)
