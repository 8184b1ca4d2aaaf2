"""Every format's features, each in a file of known area, volume, extents and parts."""

from __future__ import annotations

import importlib
import re
from pathlib import Path

import numpy as np
import pytest
from conformance.cases import Case

from shapeviz_report.database.formats import MESH_FORMATS, is_unread_mesh, suffix_of
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.clean import clean, count_components
from shapeviz_report.mesh.read import read_mesh
from shapeviz_report.mesh.readers import READERS, READERS_OF_SEVERAL

HERE = Path(__file__).parent
DOCUMENT = HERE.parents[1] / "docs" / "using" / "formats.md"
_NO_CASES = ("cases", "test_conformance")


def collect_cases() -> list[Case]:
    """All of ``CASES`` in the modules of this folder, one a format."""
    names = sorted(path.stem for path in HERE.glob("*.py") if path.stem not in _NO_CASES)
    return [case for name in names for case in importlib.import_module(f"conformance.{name}").CASES]


CASES = collect_cases()


def format_of(case: Case) -> str:
    return MESH_FORMATS.get(suffix_of(case.file_name), "unknown")


def documented() -> dict[tuple[str, str], tuple[str, str]]:
    """(format, feature) -> ``read``, ``passed over`` or ``refused``, and the reason: what the document lists."""
    found: list[tuple[str, str, str, str]] = []
    for part in re.split(r"(?m)^## ", DOCUMENT.read_text(encoding="utf-8")):
        section, _, text = part.partition("\n")
        if section not in MESH_FORMATS.values():
            continue
        for outcome, listed in re.findall(r"(?ms)^\*\*(Read|Passed over):\*\* (.*?)\.\n(?=\n|\Z)", text):
            features = " ".join(listed.split()).replace("\\*", "*").split("; ")
            found += [(section, feature, outcome.lower(), "") for feature in features]
        for feature, reason in re.findall(r"(?m)^\| (.+?) \| (.+) \|$", text):
            if feature != "refused":
                found.append((section, feature, "refused", reason.replace("\\<", "<")))
    rows = {(section, feature): (outcome, reason) for section, feature, outcome, reason in found}
    assert len(rows) == len(found), f"{DOCUMENT.name} lists a feature twice"
    return rows


def test_every_format_has_a_name_a_reader_and_cases() -> None:
    for suffix in sorted({suffix_of(case.file_name) for case in CASES}):
        assert suffix in MESH_FORMATS, f"name {suffix} in MESH_FORMATS of database/formats.py"
        assert suffix in {*READERS, *READERS_OF_SEVERAL}, (
            f"name {suffix} in READERS of mesh/readers/__init__.py"
        )
        assert not is_unread_mesh(f"mesh{suffix}"), (
            f"{suffix} is read: take it out of _UNREAD_FORMATS of formats.py"
        )
    for name in set(MESH_FORMATS.values()) - {format_of(case) for case in CASES}:
        pytest.fail(f"write tests/conformance/{name.lower()}.py, with a case for each feature of {name}")


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{format_of(case)}: {case.name}")
def test_is_read_right_or_refused_with_its_reason(case: Case, tmp_path: Path) -> None:
    for name, content in case.files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    if case.refused is not None:
        with pytest.raises(MeshError, match=case.refused) as caught:
            read_mesh(tmp_path / case.file_name)
        _, reason = documented()[format_of(case), case.name]
        # where the words are those of a parser of XML or JSON, the document has three dots
        assert re.fullmatch(re.escape(reason).replace("…", ".+"), str(caught.value))
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
        assert (format_of(case), case.name) in rows, (
            f"docs/using/formats.md, section {format_of(case)}: list {case.name!r} as read, passed over or refused"
        )
        outcome, reason = rows.pop((format_of(case), case.name))
        assert outcome in (("refused",) if case.refused else ("read", "passed over")), (
            f"{case.name}: {outcome}?"
        )
        assert bool(reason) == (outcome == "refused"), f"{case.name}: {reason}?"
    assert not rows, f"docs/using/formats.md lists what no case in tests/conformance shows: {sorted(rows)}"
