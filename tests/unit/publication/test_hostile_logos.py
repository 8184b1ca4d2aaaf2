"""What a drawing may not hold, in the spellings that get past a list of what is forbidden; and what real ones hold."""

import re

import pytest
from lxml import etree
from PIL import Image

from shapeviz_report.errors import ConfigError
from shapeviz_report.publication.logo import read_logo

AWAY = "https://example.org/a"
DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'xmlns:h="http://www.w3.org/1999/xhtml" xmlns:ev="http://www.w3.org/2001/xml-events" viewBox="0 0 9 9">{}</svg>'
)
ELEMENTS = [
    *("script", "SCRIPT", "handler", "listener"),
    *("foreignObject", "foreignobject", "iframe", "embed", "object", "a", "image"),
    *("img", "video", "audio", "canvas", "animate", "set", "animateMotion", "animateTransform", "animateColor"),
    *("discard", "mpath", "feImage"),
    *( "font", "font-face-uri", "color-profile", "cursor", "tref", "link", "view", "solidcolor", "hatch"),
    *("h:script", "h:img", "h:form", "h:style", "h:link", "h:meta", "h:base", "h:body", "h:svg"),
]  # fmt: skip
VALUES = [
    f"url({AWAY})",
    f"url('{AWAY}')",
    f"URL( {AWAY} )",
    f"url(#a) url({AWAY})",
    "url(//example.org/a)",
    "url(a.svg#b)",
    "url(data:image/svg+xml,x)",
    f"u\\72l({AWAY})",
    f"\\75rl({AWAY})",
    f"u/**/rl({AWAY})",
    f"image-set('{AWAY}' 1x)",
    f"-webkit-image-set(url({AWAY}) 1x)",
    f"image('{AWAY}')",
    f"src('{AWAY}')",
    "expression(alert(1))",
    "var(--x)",
    "attr(href)",
    "env(x)",
    "cross-fade(red, blue)",
    "element(#a)",
    "url(",
    f"url({AWAY}",
]
SHEETS = [
    f"@import '{AWAY}';",
    f"@im\\70ort '{AWAY}';",
    f"/* */@import url({AWAY});",
    f"@font-face {{ font-family: a; src: url({AWAY}) }}",
    f"@namespace url({AWAY});",
    "@media all { path { fill: red } }",
    f"path[d^='M'] {{ fill: url({AWAY}) }}",
    "path { fill: red } }",
    "path { behavior: none }",
    "path { -moz-binding: url(#a) }",
    "<!-- path { fill: red }",
    "<path/>",
]
ATTRIBUTES = [
    *(f'<path {name}="alert(1)"/>' for name in ("onclick", "ONLOAD", "onfocusin", "xlink:onclick", "ev:onclick")),
    *(
        f'<use {name}="{value}"/>'
        for name in ("href", "xlink:href", "src")
        for value in (AWAY, "javascript:x", "data:image/svg+xml,x#a", "a.svg#b", "&#9;java&#10;script:x", "//x/#a")
    ),
]  # fmt: skip
HOSTILE = [
    *(DRAWING.format(f"<{name}/>") for name in ELEMENTS),
    *(DRAWING.format(f"<defs><g><{name}/></g></defs>") for name in ("script", "set", "h:script")),
    *(DRAWING.format(f'<path fill="{value}"/>') for value in VALUES),
    *(DRAWING.format(f'<path style="fill: {value}"/>') for value in VALUES),
    *(DRAWING.format(f"<style>path {{ fill: {value} }}</style>") for value in VALUES),
    *(DRAWING.format(f"<style>{sheet}</style>") for sheet in SHEETS),
    *(DRAWING.format(content) for content in ATTRIBUTES),
    '<?xml-stylesheet href="a.css"?>' + DRAWING.format(""),
    DRAWING.format('<g><?xml-stylesheet href="a.css"?></g>'),
    '<!DOCTYPE svg [<!ENTITY a "b">]>' + DRAWING.format("&a;"),
    f'<!DOCTYPE svg [<!ENTITY % a SYSTEM "{AWAY}"> %a;]>' + DRAWING.format(""),
    f'<!DOCTYPE svg SYSTEM "{AWAY}">' + DRAWING.format(""),
    '<!DOCTYPE svg [<!ENTITY a "b"><!ENTITY c "&a;&a;">]>' + DRAWING.format('<path d="&c;"/>'),
    DRAWING.format("<g>" * 120 + "</g>" * 120),
    DRAWING.format("<g/>" * 20_001),
    DRAWING.format("&undefined;"),
]
BENIGN = {
    "a path": '<path d="M0 0h9v9z" fill="#1f5f99" transform="rotate(30) matrix(1 0 0 1 0 0)"/>',
    "gradients": '<defs><linearGradient id="a"><stop offset="0" stop-color="red"/></linearGradient>'
    '<radialGradient id="b" xlink:href="#a"/></defs><path fill="url(#a)" stroke="url( \'#b\' )"/>',
    "clip": '<clipPath id="c"><circle r="3"/></clipPath><g clip-path="url(#c)"><rect width="9" height="9"/></g>',
    "mask": '<mask id="m"><rect fill="white"/></mask><rect mask="url(#m)" style="mask-type:alpha"/>',
    "classes": "<style type='text/css'>\n.st0{stroke:rgb(1,2,3);}\n/* a */ .st1, g > path{opacity:.5}\n</style>",
    "styles in CDATA": "<style><![CDATA[.a { fill: url(#b); }]]></style>",
    "text": '<text x="1" y="2" font-family="Arial, sans-serif" xml:space="preserve">a <tspan dy="1">(b)</tspan></text>',
    "use": '<symbol id="s" viewBox="0 0 1 1"><path d="M0 0"/></symbol><use href="#s" xlink:href="#s"/>',
    "a shadow": '<filter id="f"><feGaussianBlur in="SourceAlpha" stdDeviation="2"/></filter><g filter="url(#f)"/>',
    "Inkscape": '<i:namedview xmlns:i="http://www.inkscape.org/namespaces/inkscape" i:zoom="2"/><metadata><r:RDF '
    'xmlns:r="http://www.w3.org/1999/02/22-rdf-syntax-ns#"/></metadata>'
    '<path style="fill:red;-inkscape-font-specification:Sans"/>',
    "pattern": '<pattern id="p" patternUnits="userSpaceOnUse"><line x2="3"/></pattern><ellipse fill="url(#p)"/>',
    "words": "<title>A logo</title><desc>Of (a) url(https://example.org/)</desc><!-- drawn by hand -->",
}


def test_there_are_many() -> None:
    assert len(set(HOSTILE)) >= 130


@pytest.mark.parametrize("text", HOSTILE)
def test_a_hostile_drawing_is_refused(tmp_path, text) -> None:
    (tmp_path / "logo.svg").write_text(text)
    with pytest.raises(ConfigError, match=re.escape("logo.svg")):
        read_logo(tmp_path / "logo.svg")


@pytest.mark.parametrize("encoding", ["utf-16", "utf-7"])
def test_a_hostile_drawing_in_another_encoding(tmp_path, encoding) -> None:
    text = f'<?xml version="1.0" encoding="{encoding}"?>' + DRAWING.format("<script/>")
    (tmp_path / "logo.svg").write_bytes(text.encode(encoding))
    with pytest.raises(ConfigError):
        read_logo(tmp_path / "logo.svg")


@pytest.mark.parametrize("name", BENIGN)
def test_a_real_drawing_is_taken(tmp_path, name) -> None:
    (tmp_path / "logo.svg").write_text(DRAWING.format(BENIGN[name]))
    kept = etree.fromstring(read_logo(tmp_path / "logo.svg").content)
    drawn = [node for node in etree.fromstring(DRAWING.format(BENIGN[name])).iter(etree.Element)]
    ours = [node.tag for node in drawn if node.tag.startswith("{http://www.w3.org/2000/svg}")]
    assert [node.tag for node in kept.iter(etree.Element)] == ours
    assert b"inkscape.org" not in etree.tostring(kept)
    assert b"<!--" not in etree.tostring(kept)


def test_the_doctype_of_illustrator_is_taken(tmp_path) -> None:
    text = (
        '<?xml version="1.0" encoding="utf-8"?>\n<!-- Generator: Adobe Illustrator -->\n<!DOCTYPE svg PUBLIC '
        '"-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">' + DRAWING.format("")
    )
    (tmp_path / "logo.svg").write_text(text)
    assert b"DOCTYPE" not in read_logo(tmp_path / "logo.svg").content


def test_a_picture_of_many_pixels_is_not_unpacked(tmp_path, monkeypatch) -> None:
    Image.new("1", (12_000, 12_000)).save(tmp_path / "logo.png")
    assert (tmp_path / "logo.png").stat().st_size < 100_000
    monkeypatch.setattr("PIL.ImageFile.ImageFile.load", lambda *_: pytest.fail("unpacked"))
    with pytest.raises(ConfigError, match=r"12000 x 12000|can be shown"):
        read_logo(tmp_path / "logo.png")
