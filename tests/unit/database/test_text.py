import os
import unicodedata

import pytest

from shapeviz_report.database.text import clean, decode, readable


@pytest.mark.parametrize(
    ("data", "certain"),
    [
        ("Flügel €".encode(), True),
        ("Flügel €".encode("utf-8-sig"), True),
        ("Flügel €".encode("utf-16"), True),
        ("Flügel €".encode("cp1252"), False),
    ],
)
def test_decode(data, certain):
    assert decode(data) == ("Flügel €", certain)


def test_twins_of_one_word_become_one():
    twins = [unicodedata.normalize(form, "  Flügel\n") for form in ("NFC", "NFD")]
    assert twins[0] != twins[1]
    assert {clean(twin) for twin in twins} == {"Flügel"}


@pytest.mark.parametrize("text", ['"quoted"', "🐙", "</script>", "two\nlines", "bell \a", "x" * 100_000])
def test_clean_keeps_what_is_the_owners(text):
    assert clean(text) == text


def test_clean_text_can_be_written():
    assert clean("lone \ud800 surrogate").encode("utf-8")


def test_names_that_are_not_utf8_become_text():
    assert readable(os.fsdecode("Flügel".encode("latin-1"))) == "Flügel"
    assert readable("Flügel") == "Flügel"
