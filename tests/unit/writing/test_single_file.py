"""A site in one file: everything is in it, and its policy admits nothing that is not."""

import base64
import re
from dataclasses import replace
from hashlib import sha256

import pytest
from packed_chunks import texts_of, unpack
from page_markup import Markup
from reports import NASTY_LABELS, make_report, picture, with_models

from shapeviz_report.errors import SiteError
from shapeviz_report.pages import PAGES
from shapeviz_report.types import Painting
from shapeviz_report.writing import check_destination, write_site
from shapeviz_report.writing.single_file import Inline, split_large


@pytest.fixture(scope="module")
def report():
    return replace(with_models(make_report()), paintings=(Painting("Gc:1", 0, picture(1, 2), picture(2, 1)),))


@pytest.fixture(scope="module")
def file(report, tmp_path_factory):
    destination = tmp_path_factory.mktemp("mail") / "shapes.html"
    write_site(report, destination, single_file=True)
    return destination


@pytest.fixture(scope="module")
def markup(file):
    # What is for readers without scripts is never seen here.
    return Markup(re.sub(r"<noscript>.*?</noscript>", "", file.read_text(encoding="utf-8")))


def policy(markup):
    text = next(a["content"] for _, a in markup.tags if a.get("http-equiv") == "Content-Security-Policy")
    return dict(part.split(" ", 1) for part in text.split("; "))


def test_it_is_one_file(file):
    assert list(file.parent.iterdir()) == [file]


def test_every_page_is_a_template(markup):
    names = [a["id"] for tag, a in markup.tags if tag == "template"]
    assert names == [page.file for page in PAGES]


def test_the_policy_names_every_script_and_the_style_by_hash_and_no_other_place(markup):
    directives = policy(markup)
    running = [text for attributes, text in markup.texts("script") if attributes == {}]
    styles = [text for _, text in markup.texts("style")]

    def hashes(texts):
        return {f"'sha256-{base64.b64encode(sha256(t.encode()).digest()).decode()}'" for t in texts}

    assert len(running) > 5
    assert set(directives["script-src"].split()) == hashes(running)
    assert set(directives["style-src"].split()) == hashes(styles)
    assert directives["default-src"] == "'none'"
    assert directives["img-src"] == "data: blob:"
    assert directives["require-trusted-types-for"] == "'script'"
    assert not any("unsafe" in value or "file:" in value for value in directives.values())


def test_nothing_refers_to_a_file_elsewhere(markup):
    """What links and pictures of the pages name is a page, a place on the page, or a block of the file."""
    there = {a["id"] for _, a in markup.tags if "id" in a} | {page.file for page in PAGES}
    for tag, attributes in markup.tags:
        for name in ("src", "href"):
            address = attributes.get(name, "#")
            if tag == "script" and name == "src":
                continue  # inert, in a template: the name of a script that has been handed over
            if not address.startswith(("#", "data:")):
                assert address.partition("#")[0] in there, (tag, address)


def test_scripts_that_pages_name_are_there(markup):
    handed = {match for _, t in markup.texts("script") for match in re.findall(r'scripts\.set\("([^"]+)"', t)}
    chunks = {a["id"] for _, a in markup.tags if a.get("id", "").startswith("chunk-")}
    for tag, attributes in markup.tags:
        if tag == "script" and "src" in attributes:
            name = attributes["src"].removeprefix("assets/").removesuffix(".js")
            assert attributes["src"] in handed or name in chunks


def held_chunk(markup, name):
    kind, text = next(
        (a["data-kind"], t) for a, t in markup.texts("script") if a.get("id") == f"chunk-{name}"
    )
    return unpack(kind, base64.b64decode(text))


def test_data_and_pictures_are_those_of_the_folder(report, markup, tmp_path):
    write_site(report, tmp_path)
    held = {a["id"]: t for a, t in markup.texts("script") if a.get("type") == "text/plain"}
    folder = {str(p.relative_to(tmp_path)): p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}
    folder.pop("data/files.json")  # the record of a folder's files, which one file does not need
    for path in (p for p in folder if p.startswith(("thumbnails/", "paintings/", "data/"))):
        assert base64.b64decode(held[path]) == folder[path] or path == "data/summary.json"
    chunk = held_chunk(markup, "overview")
    assert texts_of(chunk["shapes"]["ids"]) == [shape.id for shape in report.shapes]


def test_it_holds_no_models_and_says_so(markup):
    held = {a["id"]: t for a, t in markup.texts("script") if "id" in a}
    assert not any(name.startswith("models/") for name in held)
    assert held_chunk(markup, "selection")["models"] is None


def test_text_from_the_database_is_never_markup(tmp_path):
    nasty = '</title></template></script><script>alert(1)</script><img src=x onerror="alert(2)">'
    report = make_report(NASTY_LABELS, 2, name=nasty, metadata={nasty: nasty})
    write_site(report, tmp_path / "nasty.html", single_file=True)
    markup = Markup((tmp_path / "nasty.html").read_text(encoding="utf-8"))
    assert not [tag for tag, _ in markup.tags if tag == "img"]
    assert not [a for _, a in markup.tags if any(key.startswith("on") for key in a)]
    assert "alert(1)" not in [text for _, text in markup.texts("script")]


def test_a_script_that_would_end_in_the_middle_is_refused():
    with pytest.raises(ValueError, match="</SCRIPT"):
        Inline("", ("const text = '</SCRIPT>';",))


def test_large_data_is_left_out():
    assert split_large({"a": b"123", "b": b"1234"}, 3) == ({"a": b"123"}, ("b",))


def test_only_a_site_is_replaced(file, tmp_path):
    check_destination(file, single_file=True)
    (tmp_path / "thesis.html").write_text("<!doctype html><title>Years of work</title>")
    with pytest.raises(SiteError, match="would be replaced"):
        check_destination(tmp_path / "thesis.html", single_file=True)
    (tmp_path / "folder.html").mkdir()
    with pytest.raises(SiteError, match="is a folder"):
        check_destination(tmp_path / "folder.html", single_file=True)
    with pytest.raises(SiteError, match=r"ends in \.html"):
        check_destination(tmp_path / "site", single_file=True)
    with pytest.raises(SiteError, match="is a file"):
        check_destination(file)


def test_a_file_that_was_changed_since_is_refused(report, tmp_path):
    file = tmp_path / "shapes.html"
    write_site(report, file, single_file=True)
    content = file.read_bytes()
    write_site(report, file, single_file=True)
    assert file.read_bytes() == content
    edits = [
        content.replace(b"</title>", b" of mine</title>", 1),
        content + b"<!-- mine -->\n",
        content[:-1],
        content.replace(b"\n", b"\r\n"),
    ]
    for edit in edits:
        file.write_bytes(edit)
        with pytest.raises(SiteError, match="was changed since it was written"):
            write_site(report, file, single_file=True)
        assert file.read_bytes() == edit
    earlier, _, _ = content.rpartition(b"<!--")
    file.write_bytes(earlier)  # as versions wrote it that did not seal
    write_site(report, file, single_file=True)
    assert file.read_bytes() == content
