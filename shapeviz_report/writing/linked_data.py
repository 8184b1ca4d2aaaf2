"""What search engines and catalogues of data sets read: schema.org's Dataset and 3DModel, as JSON-LD."""

from __future__ import annotations

from collections.abc import Mapping
from urllib.parse import urlencode

from shapeviz_report.pages.base import class_names, feature_files, is_in_full, kind_of_group
from shapeviz_report.pages.overview import thumbnail_name
from shapeviz_report.publication.licence import LICENCE_COLUMNS, find_licence
from shapeviz_report.types import Licence, Report, ShapeEntry, ShapeFacts
from shapeviz_report.writing.data import json_text

CONTEXT = "https://schema.org/"

_DOWNLOADS = {
    "shapes.csv": ("The shapes: labels, metadata, facts and neighbourhood hit", "text/csv"),
    "catalogue.jsonld": ("The database for search engines and catalogues", "application/ld+json"),
    "summary.json": ("Counts, quality, parameters and versions", "application/json"),
}


def describe(report: Report) -> str:
    """The owner's description, or what can be said of any database."""
    if report.publication.description is not None:
        return report.publication.description
    classes = len(class_names(report))
    groups = f" in {classes} {kind_of_group(report, classes)}" if classes else ""
    return (
        f"{len(report.shapes)} 3D shape{'' if len(report.shapes) == 1 else 's'}{groups}, laid out so that similar "
        "shapes lie close together: to browse, search and compare."
    )


def dataset(report: Report, description: str, folder: str = "") -> dict[str, object]:
    """The database as a schema.org ``Dataset``.

    Parameters
    ----------
    report : Report
    description : str
    folder : str
        The site's folder from where this is said; the site's own address goes before it, where it is known.
    """
    said = report.publication
    base = said.url or folder
    return _told(
        {
            "@context": CONTEXT,
            "@type": "Dataset",
            "@id": said.url,
            "name": report.database.name,
            "description": description,
            "url": said.url,
            "image": f"{base}preview.png",
            "license": _address(said.licence),
            # A name alone does not tell a person from an institution.
            "creator": said.creator and {"name": said.creator},
            "citation": said.citation,
            "datePublished": said.date,
            "isAccessibleForFree": True,
            "keywords": list(class_names(report)) or None,
            "distribution": [
                {
                    "@type": "DataDownload",
                    "name": name,
                    "encodingFormat": kind,
                    "contentUrl": f"{base}data/{file}",
                }
                for file, (name, kind) in _downloads(report).items()
            ],
        }
    )


def _downloads(report: Report) -> dict[str, tuple[str, str]]:
    """What a file below ``data/`` holds, and of what kind it is."""
    files = feature_files(len(report.shapes))
    parts = (
        [""] if len(files) == 1 else [f", part {number + 1} of {len(files)}" for number in range(len(files))]
    )
    return _DOWNLOADS | {
        file: (f"The feature table, for numpy{part}", "application/octet-stream")
        for file, part in zip(files, parts, strict=True)
    }


def catalogue(report: Report, description: str) -> bytes:
    """The database with every shape as a schema.org ``3DModel``, in one document: ``data/catalogue.jsonld``.
    Of very many shapes, which nobody would load for that, it is the database alone."""
    base = report.publication.url or "../"
    whole = dataset(report, description, "../")
    if is_in_full(report):
        whole["hasPart"] = [
            _model(report, base, place, *item)
            for place, item in enumerate(
                zip(report.shapes, report.labels, report.facts, report.thumbnails, strict=True)
            )
        ]
    return (json_text(whole, indent=1) + "\n").encode("utf-8", "backslashreplace")


def _model(
    report: Report,
    base: str,
    place: int,
    shape: ShapeEntry,
    label: str | None,
    facts: ShapeFacts,
    thumbnail: bytes,
) -> dict[str, object]:
    columns = {column.casefold(): value for column, value in shape.metadata.items() if value.strip()}
    own = next((columns[name] for name in LICENCE_COLUMNS if name in columns), None)
    creator = next((columns[name] for name in ("creator", "author") if name in columns), None)
    measured: Mapping[str, object] = {"faces": facts.faces_read, "vertices": facts.vertices_read}
    return _told(
        {
            "@type": "3DModel",
            "@id": f"{base}shape.html#{urlencode({'id': shape.id}, errors='backslashreplace')}",
            "name": shape.name,
            "identifier": shape.id,
            "image": f"{base}thumbnails/{thumbnail_name(thumbnail)}",
            "keywords": label,
            "encoding": report.exported
            and {
                "@type": "MediaObject",
                "contentUrl": f"{base}gltf/{report.exported.names[place]}",
                "encodingFormat": "model/gltf-binary",
            },
            "license": _address(find_licence(own) if own else report.publication.licence),
            "creator": creator and {"name": creator},
            "additionalProperty": [
                {"@type": "PropertyValue", "name": name, "value": value} for name, value in measured.items()
            ],
        }
    )


def _address(licence: Licence | None) -> str | None:
    return None if licence is None else licence.url or licence.text


def _told(values: Mapping[str, object]) -> dict[str, object]:
    """What is known."""
    return {key: value for key, value in values.items() if value is not None}
