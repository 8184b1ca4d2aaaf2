"""The About page says what was built, from what, and what failed."""

import json
import re
from dataclasses import replace

import pytest
from reports import make_report

from shapeviz_report.pages import about
from shapeviz_report.pages.about import MOST_LISTED, MOST_OPEN, AboutPage
from shapeviz_report.types import Copy, Failure, Match
from shapeviz_report.writing import write_site


@pytest.fixture
def text(tmp_path):
    report = make_report(
        ["ant", None], 4, failures=[Failure("cup/9.off", "read", "the file ends in the middle of its faces")]
    )
    write_site(report, tmp_path)
    return (tmp_path / "about.html").read_text(encoding="utf-8")


@pytest.mark.slow
def test_it_names_every_failed_file_with_its_reason(text):
    assert "cup/9.off" in text
    assert "the file ends in the middle of its faces" in text


def test_thousands_are_set_apart(text):
    assert '<td class="number">9\u202f000</td>' in text
    assert ">9000<" not in text


def test_of_many_failed_files_the_first_are_listed_and_the_rest_is_counted(tmp_path):
    failures = [Failure(f"{number:04}.off", "read", "it is empty") for number in range(MOST_LISTED + 20)]
    write_site(make_report(["ant"], 2, failures=failures), tmp_path)
    text = (tmp_path / "about.html").read_text(encoding="utf-8")
    assert text.count("it is empty") == MOST_LISTED
    assert f"These are the first {MOST_LISTED} of {MOST_LISTED + 20} files" in text
    summary = json.loads((tmp_path / "data" / "summary.json").read_text(encoding="utf-8"))
    assert len(summary["failures"]) == MOST_LISTED + 20


@pytest.mark.parametrize("number", [MOST_OPEN, MOST_OPEN + 1])
def test_a_long_list_is_folded_so_that_what_follows_is_found(tmp_path, number):
    failures = [Failure(f"{each:04}.off", "read", "it is empty") for each in range(number)]
    write_site(make_report(["ant"], 2, failures=failures), tmp_path)
    text = (tmp_path / "about.html").read_text(encoding="utf-8")
    section = text[text.index("<h2>Files that failed</h2>") : text.index("<h2>Method</h2>")]
    assert ("<details" in section) == (number > MOST_OPEN)
    assert section.count("it is empty") == number


def test_of_many_copies_the_first_groups_are_listed_and_the_rest_is_counted(tmp_path, monkeypatch):
    monkeypatch.setattr(about, "MOST_LISTED", 2)
    monkeypatch.setattr(about, "MOST_NAMED", 3)
    report = make_report(["ant"], 11)
    ids = [shape.id for shape in report.shapes]
    pairs = [(a, b) for a in range(5) for b in range(a + 1, 5)] + [(5, 6), (7, 8), (9, 10)]
    copies = tuple(Copy(ids[a], ids[b], Match("identical file")) for a, b in pairs)
    write_site(replace(report, copies=copies), tmp_path)
    text = (tmp_path / "about.html").read_text(encoding="utf-8")
    section = text[text.index("<h2>Copies</h2>") : text.index("<h2>Files that failed</h2>")]
    lines = [re.sub("<.*?>", "", line).strip() for line in re.findall("<li>.*?</li>", section)]
    assert lines == [
        f"{ids[0]}, {ids[1]}, {ids[2]} and 2 more: identical file",
        f"{ids[5]}, {ids[6]}: identical file",
    ]
    assert "These are the first 2 of 4 groups" in section
    table = (tmp_path / "data" / "copies.csv").read_text().splitlines()
    assert [row.split(",")[-1] for row in table] == ["group", *["1"] * 10, "2", "3", "4"]


def test_of_very_many_meshes_those_with_most_repairs_are_listed(tmp_path, monkeypatch):
    monkeypatch.setattr(about, "MOST_MESHES", 3)
    report = make_report(["ant"], 6)
    facts = [replace(f, repairs={"faces turned": n} if n else {}) for n, f in enumerate(report.facts)]
    report = replace(report, facts=tuple(facts))
    write_site(report, tmp_path)
    text = (tmp_path / "about.html").read_text(encoding="utf-8")
    listed = text[text.index('<details id="meshes"') :]
    shown = [shape.id for shape in report.shapes if f">{shape.id}<" in listed]
    assert shown == [shape.id for shape in report.shapes[3:]]
    assert "of 6:" in text
    assert "These are 3 meshes, those in which most was mended." in text


def test_it_shows_seeds_parameters_versions_and_hashes(text):
    for expected in ("edge_length", "0.01", "shapeviz-report", f"{7:064x}", "duplicate faces removed: 4"):
        assert expected in text


def test_what_was_not_set_is_told_by_what_was_used():
    report = make_report(["ant"], 4)
    unset = {"layout": None, "labeling": None, "up": None, "bins": None, "external": []}
    told = dict(
        AboutPage().content(replace(report, parameters=report.parameters | unset)).context["parameters"]
    )
    assert told["layout"] == "guessed: class folders"
    assert told["labeling"] == "not set: folder"
    assert told["up"] == "guessed, where a file does not say"
    assert (told["bins"], told["external"]) == ("none", "none")
    chosen = report.parameters | {"layout": "flat", "labeling": "kind", "up": "y"}
    told = dict(AboutPage().content(replace(report, parameters=chosen)).context["parameters"])
    assert (told["layout"], told["labeling"], told["up"]) == ("flat", "kind", "y")


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


def test_repairs_are_summed_up_over_the_meshes():
    report = make_report(["ant"], 3)
    mended = [
        {"vertices welded": 5},
        {"vertices welded": 2, "empty faces dropped": 1},
        {},
    ]
    facts = tuple(
        replace(f, repairs=r, watertight=bool(r)) for f, r in zip(report.facts, mended, strict=True)
    )
    context = AboutPage().content(replace(report, facts=facts)).context
    assert context["repairs"] == [("vertices welded", 2, 7), ("empty faces dropped", 1, 1)]
    assert (context["repaired"], context["open"]) == (2, 1)


def test_what_comes_from_samples_is_said(monkeypatch, tmp_path):
    report = make_report(["ant", "bird"], 8)
    assert AboutPage().content(report).context["samples"] == []
    monkeypatch.setattr(about, "EXACT_LIMIT", 10)
    write_site(report, tmp_path)
    text = (tmp_path / "about.html").read_text(encoding="utf-8")
    assert "those of 2\u202f000 shapes among all others" in text
    assert "4\u202f000 that stand for their classes" in text
