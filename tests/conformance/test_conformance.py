"""Every format's features, each in a file of known area, volume, extents and parts."""

from __future__ import annotations

import importlib
import re
from pathlib import Path

import numpy as np
import pytest
from conformance.cases import Case

from shapeviz_report.database.formats import MESH_FORMATS, suffix_of
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.clean import clean, count_components
from shapeviz_report.mesh.read import read_mesh

HERE = Path(__file__).parent
DOCUMENT = HERE.parents[1] / "docs" / "formats.md"
_NO_CASES = ("cases", "test_conformance")


def collect_cases() -> list[Case]:
    """All of ``CASES`` in the modules of this folder, one a format."""
    names = sorted(path.stem for path in HERE.glob("*.py") if path.stem not in _NO_CASES)
    return [case for name in names for case in importlib.import_module(f"conformance.{name}").CASES]


CASES = collect_cases()


def format_of(case: Case) -> str:
    return MESH_FORMATS[suffix_of(case.file_name)]


def documented() -> dict[tuple[str, str], str]:
    """(format, feature) -> ``read``, ``passed over`` or ``refused``: the rows of the tables in the document."""
    rows: dict[tuple[str, str], str] = {}
    section = ""
    for line in DOCUMENT.read_text().splitlines():
        if line.startswith("## "):
            section = line.removeprefix("## ")
        elif section in MESH_FORMATS.values() and (row := re.match(r"\| ([^|]+) \| ([^|]+) \|", line)):
            assert (section, row[1]) not in rows, f"{section}: {row[1]} stands twice"
            rows[section, row[1]] = row[2]
    return {key: outcome for key, outcome in rows.items() if key[1] != "feature" and "---" not in key[1]}


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{format_of(case)}: {case.name}")
def test_is_read_right_or_refused_with_its_reason(case: Case, tmp_path: Path) -> None:
    for name, content in case.files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    if case.refused is not None:
        with pytest.raises(MeshError, match=case.refused):
            read_mesh(tmp_path / case.file_name)
        return
    mesh = read_mesh(tmp_path / case.file_name)
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 == pytest.approx(
        case.area, rel=case.precision
    )
    if case.volume is not None:
        assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(case.volume, rel=case.precision)
    used = mesh.vertices[np.unique(mesh.faces)]
    size = case.precision * max(case.extents)
    assert np.ptp(used, axis=0) == pytest.approx(case.extents, rel=case.precision, abs=size)
    cleaned, _ = clean(mesh)
    assert count_components(len(cleaned.vertices), cleaned.faces) == case.parts


def test_the_document_has_a_row_for_every_case_and_no_other() -> None:
    rows = documented()
    for case in CASES:
        outcome = rows.pop((format_of(case), case.name), None)
        assert outcome is not None, f"{DOCUMENT.name} has no row for {format_of(case)}: {case.name}"
        assert (outcome == "refused") == (case.refused is not None), (
            f"{format_of(case)}: {case.name}: {outcome}?"
        )
        assert outcome in ("read", "passed over", "refused"), outcome
    assert not rows, "rows without a case"
