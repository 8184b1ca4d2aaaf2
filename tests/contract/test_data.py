"""What the files of a site's ``data/`` hold is described in docs/using/site-data.md."""

from __future__ import annotations

import csv
import io
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pyarrow import parquet

from shapeviz_report.writing.data import data_files

from .test_chunks import everything

DOCUMENT = Path(__file__).parents[2] / "docs" / "using" / "site-data.md"


def names_in(name: str, content: bytes) -> list[str]:
    """The columns of a table, the arrays of an archive, or the keys of an object; without what stands for a NAME."""
    if name.endswith(".csv"):
        return [column.partition(":")[0] for column in next(csv.reader(io.StringIO(content.decode())))]
    if name.endswith(".parquet"):
        return [column.partition(":")[0] for column in parquet.read_schema(io.BytesIO(content)).names]
    if name.endswith(".npz"):
        return list(np.load(io.BytesIO(content)))
    if name.endswith(".json"):
        return list(json.loads(content))
    return []


@pytest.mark.slow
def test_every_column_is_described() -> None:
    text = re.sub(r"```.*?```", "", DOCUMENT.read_text(encoding="utf-8"), flags=re.DOTALL)
    described = {code.partition(":")[0] for code in re.findall(r"`([^`]+)`", text)}
    described |= {key for code in re.findall(r"`\{([^`]+)\}`", text) for key in re.findall(r'"(\w+)"', code)}
    report = everything()
    report = replace(report, parameters={**report.parameters, "parquet": True})
    features = {column.partition(":")[0] for column in report.features.columns}
    for name, content in data_files(report, "1"):
        for column in set(names_in(name, content)) - features:
            assert column in described, f"describe `{column}` of data/{name} in docs/using/site-data.md"
