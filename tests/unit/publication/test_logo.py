"""A logo is an image, and can do nothing but be seen."""

import io

import pytest
from PIL import Image

from shapeviz_report.errors import ConfigError
from shapeviz_report.publication.logo import read_logo

DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{}</svg>'


def picture(kind, size=(30, 10)):
    file = io.BytesIO()
    Image.new("RGB", size, "red").save(file, kind)
    return file.getvalue()


@pytest.mark.parametrize(("kind", "suffix"), [("PNG", ".png"), ("WEBP", ".webp")])
def test_pictures_are_named_by_what_they_are(tmp_path, kind, suffix):
    path = tmp_path / "logo.jpg"
    path.write_bytes(picture(kind))
    assert read_logo(path).suffix == suffix
    assert read_logo(path).content == picture(kind)


def test_a_drawing_is_taken_as_it_is(tmp_path):
    path = tmp_path / "logo.SVG"
    text = DRAWING.format('<defs><g id="a"/></defs><use href="#a"/><path d="M0 0" fill="url(#a)"/>')
    path.write_text(text)
    assert (read_logo(path).suffix, read_logo(path).content) == (".svg", text.encode())


@pytest.mark.parametrize(
    "danger",
    [
        "<script>alert(1)</script>",
        '<path onclick="alert(1)"/>',
        "<foreignObject/>",
        '<a href="javascript:alert(1)"/>',
        '<image href="https://example.org/a.png"/>',
        '<image xmlns:x="http://www.w3.org/1999/xlink" x:href="//example.org/a.png"/>',
        "<style>@import 'a.css';</style>",
        "<style>path { fill: url(https://example.org/a) }</style>",
        "<path style=\"fill: url( 'https://example.org/a' )\"/>",
    ],
)
def test_a_drawing_that_does_more_is_refused(tmp_path, danger):
    (tmp_path / "logo.svg").write_text(DRAWING.format(danger))
    with pytest.raises(ConfigError, match="which is not taken"):
        read_logo(tmp_path / "logo.svg")


def test_entities_are_refused(tmp_path):
    (tmp_path / "logo.svg").write_text(
        '<!DOCTYPE svg [<!ENTITY a "b">]>' + DRAWING.format("<text>&a;</text>")
    )
    with pytest.raises(ConfigError, match="entities"):
        read_logo(tmp_path / "logo.svg")


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("logo.svg", b"<svg", "not well-formed"),
        ("logo.svg", b"<html/>", "not an SVG"),
        ("logo.png", b"GIF89a", "not an SVG, PNG or WebP"),
        ("logo.png", picture("PNG")[:40], "not an SVG, PNG or WebP"),
        ("logo.png", picture("JPEG"), "not an SVG, PNG or WebP"),
        ("logo.png", picture("PNG", (5000, 2)), "5000 x 2 pixels"),
        ("logo.png", b"x" * 500_001, "at most 500,000"),
    ],
    ids=["broken drawing", "page", "gif", "half a picture", "jpeg", "wide", "heavy"],
)
def test_what_is_no_logo_is_refused(tmp_path, name, content, reason):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ConfigError, match=reason):
        read_logo(tmp_path / name)


def test_a_logo_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(ConfigError, match="cannot be read"):
        read_logo(tmp_path / "logo.png")
