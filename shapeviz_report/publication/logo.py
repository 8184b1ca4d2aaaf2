"""A logo, checked: it is what its owner takes it for, and it can do nothing but be seen."""

from __future__ import annotations

import io
import re
from pathlib import Path

from lxml import etree
from PIL import Image

from shapeviz_report.errors import ConfigError
from shapeviz_report.types import Logo

MOST_BYTES = 500_000
MOST_PIXELS = 4096
"""Width and height of a logo; it is shown some 30 pixels high."""

_FORMATS = {"PNG": ".png", "WEBP": ".webp"}
_FORBIDDEN = ("script", "foreignObject", "handler", "iframe", "embed", "object")
_ELSEWHERE = re.compile(r"@import|url\(\s*['\"]?(?!#|data:image/)", re.IGNORECASE)


def read_logo(path: Path) -> Logo:
    """Read and check a logo.

    An SVG is refused if it holds a script, or needs another file: shown in a page it could use neither, but it lies in
    the site's folder and can be opened on its own.

    Raises
    ------
    ConfigError
        It cannot be read, is no SVG, PNG or WebP image, is too large, or not safe.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ConfigError(f"the logo {path} cannot be read: {error.strerror}") from error
    if len(content) > MOST_BYTES:
        raise ConfigError(f"the logo {path} has {len(content):,} bytes; at most {MOST_BYTES:,} are wise")
    if path.suffix.lower() == ".svg":
        _check_drawing(content, path)
        return Logo(".svg", content)
    return Logo(_check_picture(content, path), content)


def _check_picture(content: bytes, path: Path) -> str:
    try:
        with Image.open(io.BytesIO(content), formats=list(_FORMATS)) as image:
            kind, size = str(image.format), image.size
            image.load()
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise ConfigError(f"the logo {path} is not an SVG, PNG or WebP image that can be shown") from error
    if max(size) > MOST_PIXELS:
        raise ConfigError(f"the logo {path} has {size[0]} x {size[1]} pixels; at most {MOST_PIXELS} are wise")
    return _FORMATS[kind]


def _check_drawing(content: bytes, path: Path) -> None:
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        root = etree.fromstring(content, parser)
    except etree.XMLSyntaxError as error:
        raise ConfigError(f"the logo {path} is not well-formed XML: {error.msg}") from error
    if root.tag != "{http://www.w3.org/2000/svg}svg":
        raise ConfigError(f"the logo {path} is XML, but not an SVG drawing")
    if root.getroottree().docinfo.internalDTD is not None and b"<!ENTITY" in content:
        raise ConfigError(f"the logo {path} declares entities, which are not taken; save it without them")
    for node in root.iter(etree.Element):
        reason = _danger(node)
        if reason is not None:
            raise ConfigError(f"the logo {path} holds {reason}, which is not taken; save it without")


def _danger(node: etree._Element) -> str | None:
    name = etree.QName(node).localname
    if name in _FORBIDDEN:
        return f"<{name}>"
    if name == "style" and _ELSEWHERE.search("".join(node.itertext())):
        return "a style that refers to another file"
    for attribute, value in node.attrib.items():
        key = etree.QName(attribute).localname.lower()
        if key.startswith("on"):
            return f"the script {key!r}"
        if key in ("href", "src") and not value.strip().startswith(("#", "data:image/")):
            return f"a reference to {value[:60]!r}"
        if _ELSEWHERE.search(value):
            return "a reference to another file"
    return None
