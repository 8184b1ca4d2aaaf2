"""What an owner says of a database is checked before anything long begins."""

from dataclasses import replace

import pytest
from reports import make_report

from shapeviz_report.config import Config
from shapeviz_report.errors import ConfigError
from shapeviz_report.publication import licence_warning, read_publication
from shapeviz_report.publication.bibtex import bibtex_entry
from shapeviz_report.types import Licence, Publication


def test_what_is_not_said_is_none():
    assert read_publication(Config()) == Publication()


def test_what_is_said_is_read(tmp_path):
    (tmp_path / "words.md").write_bytes("\ufeffVasen 🏺".encode())
    said = read_publication(
        Config(
            description=" two\n lines ",
            introduction=tmp_path / "words.md",
            creator="N. N.",
            citation="\n@misc{a, title={A}}\n",
            url="https://example.org/shapes",
            licence="  ",
        )
    )
    assert said == Publication(
        description="two lines",
        introduction="Vasen 🏺",
        creator="N. N.",
        citation="@misc{a, title={A}}",
        url="https://example.org/shapes/",
    )


@pytest.mark.parametrize(
    "url",
    ["example.org", "ftp://example.org", "https://", "https://a.org/#x", "https://a.org/?q", "http://[1"],
)
def test_an_address_that_is_none_is_refused(url):
    with pytest.raises(ConfigError, match="url"):
        read_publication(Config(url=url))


def test_an_introduction_that_cannot_be_read_is_refused(tmp_path):
    for content, reason in (
        (None, "cannot be read"),
        (b"\xff", "not text in UTF-8"),
        (b"x" * 100_001, "shorten"),
    ):
        if content is not None:
            (tmp_path / "words.md").write_bytes(content)
        with pytest.raises(ConfigError, match=reason):
            read_publication(Config(introduction=tmp_path / "words.md"))


def test_a_database_without_a_licence_is_told_of():
    shapes = make_report(["ant"], 4).shapes
    assert "No licence is named" in licence_warning(Publication(), shapes)
    assert licence_warning(Publication(licence=Licence("MIT")), shapes) is None


@pytest.mark.parametrize("column", ["licence", "License", "RIGHTS"])
def test_a_column_of_licences_counts_for_its_shapes(column):
    shapes = make_report(["ant"], 4, metadata={column: "CC0"}).shapes
    assert licence_warning(Publication(), shapes) is None
    bare = replace(shapes[0], metadata={column: " "})
    assert "1 shape has no licence" in licence_warning(Publication(), (bare, *shapes[1:]))


def test_an_entry_in_bibtex_is_kept_and_one_is_made_where_there_is_none():
    own = "@article{me, title={Mine}}"
    assert bibtex_entry("T", Publication(citation=own)) == own
    assert bibtex_entry("T", Publication(citation="Words only")) is None
    made = bibtex_entry("50 % & {more}", Publication(creator="A_B", url="https://a.org/", citation="Words"))
    assert made.splitlines() == [
        "@misc{50-more,",
        r"  author = {{A\_B}},",
        r"  title = {{50 \% \& \{more\}}},",
        r"  howpublished = {\url{https://a.org/}},",
        "  note = {Words},",
        "}",
    ]


@pytest.mark.parametrize("day", ["2026-02-30", "30.11.2026", "2026", "", "yesterday"])
def test_dates_that_are_no_day(day):
    with pytest.raises(ConfigError, match="date must be a day of the calendar"):
        read_publication(Config(date=day))


def test_a_day_of_publication():
    assert read_publication(Config(date=" 2026-11-30 ")).date == "2026-11-30"
