"""What loaders of data sets read: the tables of ``data/`` as MLCommons Croissant, which is schema.org's Dataset with
the columns of its files (https://docs.mlcommons.org/croissant/docs/croissant-spec.html)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePosixPath

from shapeviz_report.pages.base import feature_files
from shapeviz_report.types import Report
from shapeviz_report.writing.data import json_text
from shapeviz_report.writing.data.tables import column_type, shape_rows
from shapeviz_report.writing.linked_data import dataset

CONTEXT = {
    "@language": "en",
    "@vocab": "https://schema.org/",
    "citeAs": "cr:citeAs",
    "column": "cr:column",
    "conformsTo": "dct:conformsTo",
    "cr": "http://mlcommons.org/croissant/",
    "data": {"@id": "cr:data", "@type": "@json"},
    "dataType": {"@id": "cr:dataType", "@type": "@vocab"},
    "dct": "http://purl.org/dc/terms/",
    "equivalentProperty": "cr:equivalentProperty",
    "examples": {"@id": "cr:examples", "@type": "@json"},
    "extract": "cr:extract",
    "field": "cr:field",
    "fileObject": "cr:fileObject",
    "fileProperty": "cr:fileProperty",
    "fileSet": "cr:fileSet",
    "format": "cr:format",
    "includes": "cr:includes",
    "isLiveDataset": "cr:isLiveDataset",
    "jsonPath": "cr:jsonPath",
    "key": "cr:key",
    "md5": "cr:md5",
    "parentField": "cr:parentField",
    "path": "cr:path",
    "rai": "http://mlcommons.org/croissant/RAI/",
    "recordSet": "cr:recordSet",
    "references": "cr:references",
    "regex": "cr:regex",
    "repeated": "cr:repeated",
    "replace": "cr:replace",
    "samplingRate": "cr:samplingRate",
    "sc": "https://schema.org/",
    "separator": "cr:separator",
    "source": "cr:source",
    "subField": "cr:subField",
    "transform": "cr:transform",
}
"""The terms of Croissant 1.0."""

TYPES = {int: "sc:Integer", float: "sc:Float", bool: "sc:Boolean", str: "sc:Text"}

FORMATS = {
    ".csv": "text/csv",
    ".npz": "application/octet-stream",
    ".parquet": "application/x-parquet",
}


def croissant(report: Report, description: str, hashes: Mapping[str, str]) -> bytes:
    """``data/croissant.json``.

    Parameters
    ----------
    report : Report
    description : str
    hashes : mapping of str to str
        The SHA-256 of every file of ``data/``, by its name.
    """
    told = dataset(report, description, "../")
    files = [
        "shapes.csv",
        *(f"projection-{method}.csv" for method in report.projections),
        *feature_files(len(report.shapes)),
        *(name for name in hashes if name.endswith(".parquet")),
    ]
    columns = next(shape_rows(report))
    records = [
        _records(
            "shapes",
            "A shape a row: labels, metadata, facts and neighbourhood hit",
            [
                (column, _identifier(number, column), TYPES[column_type(column)])
                for number, column in enumerate(columns)
            ],
        )
    ]
    for method in report.projections:
        name = f"projection-{method}"
        places = [("id", "id", "sc:Text"), ("x", "x", "sc:Float"), ("y", "y", "sc:Float")]
        records.append(_records(name, f"The place of every shape on the map by {method}", places))
    whole = {
        **told,
        "@context": CONTEXT,
        "@type": "sc:Dataset",
        "citeAs": report.publication.citation,
        "conformsTo": "http://mlcommons.org/croissant/1.0",
        "distribution": [
            {
                "@type": "cr:FileObject",
                "@id": name,
                "name": name,
                "contentUrl": f"{report.publication.url}data/{name}" if report.publication.url else name,
                "encodingFormat": FORMATS[PurePosixPath(name).suffix],
                "sha256": hashes[name],
            }
            for name in files
        ],
        "recordSet": records,
    }
    whole = {key: value for key, value in whole.items() if value is not None}
    return (json_text(whole, indent=1) + "\n").encode("utf-8", "backslashreplace")


def _records(name: str, description: str, columns: list[tuple[str, str, str]]) -> dict[str, object]:
    """The rows of ``NAME.csv``, whose columns are given with an identifier and a type."""
    return {
        "@type": "cr:RecordSet",
        "@id": name,
        "name": name,
        "description": description,
        "key": {"@id": f"{name}/{columns[0][1]}"},
        "field": [
            {
                "@type": "cr:Field",
                "@id": f"{name}/{identifier}",
                "name": column,
                "dataType": kind,
                "source": {"fileObject": {"@id": f"{name}.csv"}, "extract": {"column": column}},
            }
            for column, identifier, kind in columns
        ],
    }


def _identifier(number: int, column: str) -> str:
    """What a column is called among identifiers: labelings and columns of a table, which have any name, by number."""
    kind, colon, name = column.partition(":")
    return f"{kind}-{number}" if kind in ("label", "metadata") else f"{kind}-{name}" if colon else column
