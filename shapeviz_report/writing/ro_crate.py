"""A site as an RO-Crate, which archives of research data read: https://www.researchobject.org/ro-crate/specification/1.2/

The specification wants the day of publication and the licence. A build knows neither unless the owner says them.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePosixPath

from shapeviz_report.types import Publication, Report
from shapeviz_report.writing.croissant import FORMATS as TABLE_FORMATS
from shapeviz_report.writing.data import json_text

RO_CRATE = "ro-crate-metadata.json"
"""Its place in the folder of a site: this makes the folder a crate."""

SPECIFICATION = "https://w3id.org/ro/crate/1.2"

FORMATS = {
    **TABLE_FORMATS,
    ".html": "text/html",
    ".json": "application/json",
    ".jsonld": "application/ld+json",
    ".png": "image/png",
    ".txt": "text/plain",
}
"""Suffix -> type, of the files that are told one by one."""

FOLDERS = {
    "assets/": "Scripts and styles of the pages, and what they load",
    "chunks/": "Data of the pages, in parts",
    "gltf/": "Every shape as binary glTF 2.0",
    "models/": "3D models, as the pages read them",
    "paintings/": "Shapes on which the features are painted",
    "sheets/": "Sheets of small pictures for maps",
    "thumbnails/": "A picture of every shape",
}
"""What holds many files, which `data/files.json` lists with their hashes."""

VARIABLE = ("about.html", "data/summary.json")
"""Files that tell how long the build took: neither size nor hash is told, so that equal builds tell the same."""

STANDARDS = {"data/croissant.json": "http://mlcommons.org/croissant/1.0"}


def is_crate(publication: Publication) -> bool:
    """Whether the owner has said what a crate has to tell."""
    return publication.date is not None and publication.licence is not None


def ro_crate(report: Report, description: str, sizes: Mapping[str, int], hashes: Mapping[str, str]) -> bytes:
    """``ro-crate-metadata.json`` of a site that :func:`is_crate`.

    Parameters
    ----------
    report : Report
    description : str
    sizes, hashes : mapping of str to int, to str
        Bytes and SHA-256 of every other file of the site, by its path below the site's folder.
    """
    said = report.publication
    assert said.licence is not None
    licence = said.licence.url or "#licence"
    folders = [folder for folder in FOLDERS if any(name.startswith(folder) for name in sizes)]
    files = sorted(name for name in sizes if not name.startswith(tuple(FOLDERS)))
    root = {
        "@id": "./",
        "@type": "Dataset",
        "name": report.database.name,
        "description": description,
        "datePublished": said.date,
        "license": {"@id": licence},
        "author": None if said.creator is None else {"@id": "#creator"},
        "citation": said.citation,
        "url": said.url,
        "hasPart": [{"@id": name} for name in (*files, *folders)],
    }
    graph: list[dict[str, object]] = [
        {
            "@id": RO_CRATE,
            "@type": "CreativeWork",
            "about": {"@id": "./"},
            "conformsTo": {"@id": SPECIFICATION},
        },
        {key: value for key, value in root.items() if value is not None},
        {"@id": licence, "@type": "CreativeWork", "name": said.licence.text},
    ]
    if said.creator is not None:
        # a name alone does not tell a person from an institution
        graph.append({"@id": "#creator", "@type": "Thing", "name": said.creator})
    for name in files:
        entity: dict[str, object] = {
            "@id": name,
            "@type": "File",
            "name": PurePosixPath(name).name,
            "encodingFormat": FORMATS[PurePosixPath(name).suffix],
        }
        if name not in VARIABLE:
            entity |= {"contentSize": str(sizes[name]), "sha256": hashes[name]}
        if name in STANDARDS:
            entity["conformsTo"] = {"@id": STANDARDS[name]}
            graph.append({"@id": STANDARDS[name], "@type": "CreativeWork", "name": "Croissant 1.0"})
        if name == "data/catalogue.jsonld":
            entity["about"] = {"@id": "./"}
        graph.append(entity)
    graph += [
        {"@id": folder, "@type": "Dataset", "name": folder, "description": FOLDERS[folder]}
        for folder in folders
    ]
    whole = {"@context": f"{SPECIFICATION}/context", "@graph": graph}
    return (json_text(whole, indent=1) + "\n").encode("utf-8", "backslashreplace")
