"""The About page says what was built, from what, and what failed."""

import pytest
from reports import make_report

from shapeviz_report.pages.about import AboutPage
from shapeviz_report.site import write_site
from shapeviz_report.types import Failure


@pytest.fixture
def text(tmp_path):
    report = make_report(
        ["ant", None], 4, failures=[Failure("cup/9.off", "read", "the file ends in the middle of its faces")]
    )
    write_site(report, tmp_path)
    return (tmp_path / "about.html").read_text(encoding="utf-8")


def test_it_names_every_failed_file_with_its_reason(text):
    assert "cup/9.off" in text
    assert "the file ends in the middle of its faces" in text


def test_it_shows_seeds_parameters_versions_and_hashes(text):
    for expected in ("edge_length", "0.01", "shapeviz-report", f"{7:064x}", "duplicate faces removed: 4"):
        assert expected in text


def test_times_add_up():
    stages = AboutPage().content(make_report()).context["stages"]
    assert stages["seconds"] == pytest.approx(15.85)
    assert [row["name"] for row in stages["rows"]] == ["read", "prepare", "project"]


def test_unlabelled_shapes_are_counted(text):
    assert "4 shapes without a label" in text


def test_a_database_without_failures_says_so(tmp_path):
    write_site(make_report(), tmp_path)
    assert "None: every file of the database is on the map." in (tmp_path / "about.html").read_text(
        encoding="utf-8"
    )
