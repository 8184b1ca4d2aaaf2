"""Broken files: every reader gives whole triangles or refuses in words of its own, whatever is changed in a file."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable

import numpy as np
import pytest
from conformance.cases import Case
from conformance.test_conformance import CASES, format_of
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from shapeviz_report.database.formats import MESH_FORMATS
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.read import parse_mesh

WORDS = [
    b"", b"x", b"-1", b"0", b"1.5", b"nan", b"1e999", b"65536", b"-2147483649", b"99999999999999999999", b"1_0",
    b"null", b"[]", b"\xff", b"\0", b"<", b'"',
]  # fmt: skip
"""What stands instead of a word of a file, or at any place of it."""

_PARSER = re.compile(r"invalid literal|codec|dtype|broadcast|reshape|NoneType|subscript|out of bounds")
"""What no reason has: words of the code."""

Change = tuple[str, float, bytes, float]


def change(content: bytes, changes: list[Change]) -> bytes:
    """A file with words exchanged, bytes exchanged, and pieces cut out or doubled, where fractions of it say."""
    for kind, where, word, length in changes:
        start = int(where * len(content))
        end = start + int(length * (len(content) - start))
        if kind == "word":
            found = list(re.finditer(rb"[^\s<>\",:{}\[\]]+", content))
            if found:
                old = found[int(where * len(found))]
                content = content[: old.start()] + word + content[old.end() :]
        elif kind == "byte":
            content = content[:start] + word + content[start + len(word) :]
        elif kind == "out":
            content = content[:start] + content[end:]
        else:
            content = content[:end] + content[start:]
    return content


def change_within(content: bytes, changes: list[Change]) -> bytes:
    """The same with the largest file of a ZIP archive."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    largest = max(files, key=lambda name: len(files[name]))
    files[largest] = change(files[largest], changes)
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return data.getvalue()


def small_cases(name: str) -> list[Case]:
    return [case for case in CASES if format_of(case) == name and len(case.files[case.file_name]) < 20_000]


FRACTIONS = st.floats(0, 1, exclude_max=True)
CHANGES = st.lists(
    st.tuples(st.sampled_from(["word", "word", "byte", "out", "twice"]), FRACTIONS, st.sampled_from(WORDS), FRACTIONS),
    min_size=1,
    max_size=3,
)  # fmt: skip


@pytest.mark.parametrize("name", sorted(set(MESH_FORMATS.values())))
@seed(12)
@settings(
    max_examples=60,
    deadline=10_000,
    database=None,
    phases=[Phase.generate, Phase.shrink],
    suppress_health_check=list(HealthCheck),
)
@given(choice=FRACTIONS, changes=CHANGES)
def test_a_changed_file_is_read_whole_or_refused_in_words(
    name: str, choice: float, changes: list[Change]
) -> None:
    cases = small_cases(name)
    case = cases[int(choice * len(cases))]
    content = case.files[case.file_name]
    how: Callable[[bytes, list[Change]], bytes] = change
    if zipfile.is_zipfile(io.BytesIO(content)) and content.startswith(b"PK\x03\x04"):
        how = change_within
    try:
        changed = how(content, changes)
    except (zipfile.BadZipFile, NotImplementedError):  # the case itself is such an archive
        changed = change(content, changes)
    reason, mesh = "", None
    try:
        mesh = parse_mesh(dict(case.files) | {case.file_name: changed})
    except MeshError as error:
        reason = str(error)
    # what parse_mesh says where a reader fails in a way that it does not know
    assert "damaged, cut off, or not" not in reason
    assert not _PARSER.search(reason)
    if mesh is None:
        return
    assert mesh.vertices.dtype == np.float64
    assert mesh.vertices.shape[1] == 3
    assert len(mesh.faces)
    assert 0 <= mesh.faces.min() <= mesh.faces.max() < len(mesh.vertices)
