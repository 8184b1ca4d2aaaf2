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
        (
            "logo.svg",
            b"<svg>" + 500 * b"<g>" + 500 * b"</g>" + b"</svg>",
            "beyond what is read of XML: .* depth",
        ),
        ("logo.svg", b"<html/>", "not an SVG"),
        ("logo.png", b"GIF89a", "not an SVG, PNG or WebP"),
        ("logo.png", picture("PNG")[:40], "not an SVG, PNG or WebP"),
        ("logo.png", picture("JPEG"), "not an SVG, PNG or WebP"),
        ("logo.png", picture("PNG", (5000, 2)), "5000 x 2 pixels"),
        ("logo.png", b"x" * 500_001, "at most 500,000"),
    ],
    ids=["broken drawing", "deep drawing", "page", "gif", "half a picture", "jpeg", "wide", "heavy"],
)
def test_what_is_no_logo_is_refused(tmp_path, name, content, reason):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ConfigError, match=reason):
        read_logo(tmp_path / name)


def test_a_logo_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(ConfigError, match="cannot be read"):
        read_logo(tmp_path / "logo.png")


def test_what_drawing_programs_write_is_taken(tmp_path):
    """Inkscape writes out every property that it knows, with its default."""
    style = (
        "color:#000000;font-style:normal;font-variant:normal;font-weight:normal;font-stretch:normal;font-size:medium;"
        "line-height:normal;font-family:sans-serif;font-variant-ligatures:normal;font-variant-position:normal;"
        "font-variant-caps:normal;font-variant-numeric:normal;font-variant-alternates:normal;"
        "font-feature-settings:normal;text-indent:0;text-align:start;text-decoration:none;text-decoration-line:none;"
        "text-decoration-style:solid;text-decoration-color:#000000;letter-spacing:normal;word-spacing:normal;"
        "text-transform:none;writing-mode:lr-tb;direction:ltr;text-orientation:mixed;dominant-baseline:auto;"
        "baseline-shift:baseline;text-anchor:start;white-space:normal;shape-padding:0;clip-rule:nonzero;"
        "display:inline;overflow:visible;visibility:visible;isolation:auto;mix-blend-mode:normal;"
        "color-interpolation:sRGB;color-interpolation-filters:linearRGB;solid-color:#000000;solid-opacity:1;"
        "vector-effect:none;fill:url(#lg2);fill-opacity:1;fill-rule:nonzero;stroke:none;stroke-width:0.26;"
        "stroke-linecap:butt;stroke-linejoin:miter;stroke-miterlimit:4;stroke-dasharray:none;stroke-dashoffset:0;"
        "stroke-opacity:1;marker:none;color-rendering:auto;image-rendering:auto;shape-rendering:auto;"
        "text-rendering:auto;enable-background:accumulate;stop-color:#000000;-inkscape-stroke:none"
    )
    path = tmp_path / "logo.svg"
    path.write_text(DRAWING.format(f'<path d="M0 0" style="{style}"/>'))
    assert style.encode() in read_logo(path).content
