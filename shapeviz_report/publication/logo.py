"""A logo, checked: it is what its owner takes it for, and it can do nothing but be seen."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

from lxml import etree
from PIL import Image

from shapeviz_report.errors import ConfigError
from shapeviz_report.files import TooLargeError, read_regular
from shapeviz_report.types import Logo

MOST_BYTES = 500_000
MOST_PIXELS = 4096
"""Width and height of a logo; it is shown some 30 pixels high."""

_FORMATS = {"PNG": ".png", "WEBP": ".webp"}
_SVG = "http://www.w3.org/2000/svg"
_XLINK_HREF = "{http://www.w3.org/1999/xlink}href"
_PAGES = ("http://www.w3.org/1999/xhtml", "http://www.w3.org/1998/Math/MathML", None)
_XML = "{http://www.w3.org/XML/1998/namespace}"
_MOST_DEPTH = 100
_MOST_ELEMENTS = 20_000

_ELEMENTS = frozenset(
    [
        "svg",
        "g",
        "defs",
        "symbol",
        "use",
        "switch",
        "title",
        "desc",
        "metadata",
        "path",
        "rect",
        "circle",
        "ellipse",
        "line",
        "polyline",
        "polygon",
        "text",
        "tspan",
        "textPath",
        "linearGradient",
        "radialGradient",
        "stop",
        "clipPath",
        "mask",
        "pattern",
        "marker",
        "style",
        "filter",
        "feGaussianBlur",
        "feOffset",
        "feBlend",
        "feColorMatrix",
        "feComposite",
        "feFlood",
        "feMerge",
        "feMergeNode",
        "feMorphology",
        "feComponentTransfer",
        "feFuncR",
        "feFuncG",
        "feFuncB",
        "feFuncA",
        "feDropShadow",
    ]
)
"""What a drawing is made of: no script, animation, link, picture, page or font."""

_UNREAD = frozenset(["metadata", "title", "desc"])
"""Elements whose content says something of the drawing, and is not drawn: it is not kept."""

_PROPERTIES = frozenset(
    [
        "fill",
        "fill-opacity",
        "fill-rule",
        "stroke",
        "stroke-width",
        "stroke-opacity",
        "stroke-linecap",
        "stroke-linejoin",
        "stroke-miterlimit",
        "stroke-dasharray",
        "stroke-dashoffset",
        "opacity",
        "color",
        "display",
        "visibility",
        "overflow",
        "clip-path",
        "clip-rule",
        "mask",
        "filter",
        "marker",
        "marker-start",
        "marker-mid",
        "marker-end",
        "stop-color",
        "stop-opacity",
        "flood-color",
        "flood-opacity",
        "font-family",
        "font-size",
        "font-style",
        "font-weight",
        "font-variant",
        "font-stretch",
        "font-variant-ligatures",
        "font-variant-position",
        "font-variant-caps",
        "font-variant-numeric",
        "font-variant-alternates",
        "font-variant-east-asian",
        "font-feature-settings",
        "font-variation-settings",
        "font-size-adjust",
        "font-kerning",
        "font",
        "text-anchor",
        "text-align",
        "text-decoration",
        "text-decoration-line",
        "text-decoration-style",
        "text-decoration-color",
        "text-indent",
        "text-transform",
        "text-orientation",
        "glyph-orientation-vertical",
        "glyph-orientation-horizontal",
        "kerning",
        "inline-size",
        "shape-inside",
        "shape-margin",
        "shape-padding",
        "shape-subtract",
        "letter-spacing",
        "word-spacing",
        "line-height",
        "writing-mode",
        "dominant-baseline",
        "baseline-shift",
        "alignment-baseline",
        "direction",
        "unicode-bidi",
        "white-space",
        "paint-order",
        "vector-effect",
        "shape-rendering",
        "text-rendering",
        "image-rendering",
        "color-rendering",
        "color-interpolation",
        "color-interpolation-filters",
        "mix-blend-mode",
        "mask-type",
        "isolation",
        "enable-background",
        "background",
        "background-color",
        "solid-color",
        "solid-opacity",
        "pointer-events",
        "transform-origin",
        "transform-box",
        "transform",
    ]
)
"""Properties of style; each is an attribute as well."""

_ATTRIBUTES = _PROPERTIES | frozenset(
    [
        "id",
        "class",
        "style",
        "version",
        "baseProfile",
        "viewBox",
        "preserveAspectRatio",
        "width",
        "height",
        "x",
        "y",
        "x1",
        "y1",
        "x2",
        "y2",
        "cx",
        "cy",
        "r",
        "rx",
        "ry",
        "fx",
        "fy",
        "fr",
        "d",
        "points",
        "pathLength",
        "dx",
        "dy",
        "rotate",
        "textLength",
        "lengthAdjust",
        "startOffset",
        "method",
        "spacing",
        "side",
        "offset",
        "gradientUnits",
        "gradientTransform",
        "spreadMethod",
        "clipPathUnits",
        "maskUnits",
        "maskContentUnits",
        "patternUnits",
        "patternContentUnits",
        "patternTransform",
        "markerUnits",
        "markerWidth",
        "markerHeight",
        "refX",
        "refY",
        "orient",
        "filterUnits",
        "primitiveUnits",
        "in",
        "in2",
        "result",
        "stdDeviation",
        "edgeMode",
        "mode",
        "operator",
        "k1",
        "k2",
        "k3",
        "k4",
        "type",
        "values",
        "radius",
        "tableValues",
        "slope",
        "intercept",
        "amplitude",
        "exponent",
        "media",
        "href",
        "role",
        "aria-label",
        "aria-hidden",
        "focusable",
    ]
)
_REFERENCE = re.compile(r"#[\w.:-]+")
_LOCAL = re.compile(r"url\(\s*([\"']?)#[\w.:-]+\1\s*\)")
_FUNCTIONS = frozenset(
    ["rgb", "rgba", "hsl", "hsla", "matrix", "translate", "scale", "rotate", "skewx", "skewy"]
)
_SELECTOR = re.compile(r"[\w\s.#,*>:-]+")


def read_logo(path: Path) -> Logo:
    """Read and check a logo.

    An SVG holds what a drawing is made of and nothing else: no script, animation, link, or reference to anything but
    its own parts. What programs note for themselves (foreign namespaces, metadata, comments) is left out, for the file
    lies in the site's folder and can be opened on its own.

    Raises
    ------
    ConfigError
        It cannot be read, is no SVG, PNG or WebP image, is too large, or not safe.
    """
    try:
        content = read_regular(path, MOST_BYTES)
    except TooLargeError as error:
        raise ConfigError(f"the logo {path} is too large; at most {MOST_BYTES:,} bytes are wise") from error
    except OSError as error:
        raise ConfigError(f"the logo {path} cannot be read: {error.strerror}") from error
    if path.suffix.lower() == ".svg":
        return Logo(".svg", _safe_drawing(content, path))
    return Logo(_check_picture(content, path), content)


def _check_picture(content: bytes, path: Path) -> str:
    try:
        with Image.open(io.BytesIO(content), formats=list(_FORMATS)) as image:
            kind, size = str(image.format), image.size
            # before a pixel is unpacked: a few bytes can stand for gigabytes
            if max(size) <= MOST_PIXELS:
                image.load()
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise ConfigError(f"the logo {path} is not an SVG, PNG or WebP image that can be shown") from error
    if max(size) > MOST_PIXELS:
        raise ConfigError(f"the logo {path} has {size[0]} x {size[1]} pixels; at most {MOST_PIXELS} are wise")
    return _FORMATS[kind]


def _safe_drawing(content: bytes, path: Path) -> bytes:
    """The drawing, written anew from what is allowed."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True)
    try:
        root = etree.fromstring(content, parser)
    except (etree.XMLSyntaxError, ValueError) as error:
        if getattr(error, "code", None) == etree.ErrorTypes.ERR_RESOURCE_LIMIT:
            beyond = str(error).partition(",")[0]
            raise ConfigError(
                f"the logo {path} goes beyond what is read of XML: {beyond}; simplify it"
            ) from error
        raise ConfigError(f"the logo {path} is not well-formed XML: {error}") from error
    if root.tag != f"{{{_SVG}}}svg":
        raise ConfigError(f"the logo {path} is XML, but not an SVG drawing")
    document: Any = root.getroottree().docinfo
    if document.internalDTD is not None and any(document.internalDTD.iterentities()):
        raise ConfigError(f"the logo {path} declares entities, which are not taken; save it without them")
    if document.system_url is not None and not document.system_url.startswith("http://www.w3.org/"):
        raise ConfigError(
            f"the logo {path} refers to {document.system_url[:60]!r}; save it without a DOCTYPE"
        )
    notes = list(root.getroottree().iter(etree.ProcessingInstruction)) + list(
        root.itersiblings(preceding=True)
    )
    if any(note.target == "xml-stylesheet" for note in notes):
        raise ConfigError(
            f"the logo {path} holds a stylesheet instruction, which is not taken; save it without"
        )
    crowded = sum(1 for _ in root.iter()) > _MOST_ELEMENTS
    reason = f"more than {_MOST_ELEMENTS:,} elements" if crowded else _strip(root, 0)
    if reason is not None:
        raise ConfigError(f"the logo {path} holds {reason}, which is not taken; save it without")
    etree.cleanup_namespaces(root)
    return etree.tostring(root, encoding="utf-8")


def _strip(node: etree._Element, depth: int) -> str | None:
    """Take out what other programs have noted; return what else is not allowed."""
    if depth > _MOST_DEPTH:
        return f"elements more than {_MOST_DEPTH} deep"
    name = etree.QName(node).localname
    if name not in _ELEMENTS:
        return f"<{name[:60]}>"
    attributes: dict[str, str] = dict(node.attrib)  # type: ignore[arg-type]  # its types allow for bytes
    for attribute, value in attributes.items():
        reason = _danger(attribute, value)
        if reason is not None:
            return reason
        if attribute not in _ATTRIBUTES and attribute not in (_XLINK_HREF, f"{_XML}space", f"{_XML}lang"):
            del node.attrib[attribute]
    if name == "style":
        if len(node):
            return "a style with elements in it"
        return _danger_of_sheet(node.text or "")
    if name in _UNREAD:
        node[:] = []
        if name == "metadata":
            node.text = None
        return None
    for child in list(node):
        if child.tag is etree.PI:
            node.remove(child)
            continue
        if not isinstance(child.tag, str):
            return "an entity"
        space = etree.QName(child).namespace
        if space == _SVG:
            reason = _strip(child, depth + 1)
            if reason is not None:
                return reason
        elif space in _PAGES:
            return f"<{etree.QName(child).localname[:60]}> of a page"
        else:
            node.remove(child)
    return None


def _danger(attribute: str, value: str) -> str | None:
    """What is wrong with an attribute; those that are left out anyway may say what they like, but for scripts."""
    key = etree.QName(attribute).localname
    if key.lower().startswith("on"):
        return f"the script {key[:60]!r}"
    if key.lower() in ("href", "src"):
        return None if _REFERENCE.fullmatch(value.strip()) else f"a reference to {value[:60]!r}"
    if attribute == "style":
        return _danger_of_style(value)
    return _danger_of_value(value) if attribute in _ATTRIBUTES else None


def _danger_of_value(value: str) -> str | None:
    """What a value of a property or an attribute reaches out for; CSS is read in both."""
    if "\\" in value or "/*" in value or "@" in value:
        return f"the escapes or comments of {value[:60]!r}"
    for before in _LOCAL.sub("", value).split("(")[:-1]:
        function = re.split(r"[^\w-]", before.rstrip())[-1]
        if function and function.lower() not in _FUNCTIONS:
            return f"a reference to another file, or a function: {value[:60]!r}"
    return None


def _danger_of_style(style: str) -> str | None:
    for declaration in style.split(";"):
        name, _, value = declaration.partition(":")
        reason = _danger_of_value(declaration)
        if reason is not None:
            return reason
        name = name.strip().lower()
        if name and value and name not in _PROPERTIES and not name.startswith("-inkscape-"):
            return f"the style {name[:60]!r}"
    return None


def _danger_of_sheet(sheet: str) -> str | None:
    """What is wrong with a stylesheet: it is rules of a selector and declarations, and comments."""
    *rules, rest = _without_comments(sheet).split("}")
    other = "a style that is more than rules such as '.a { fill: red }', or refers to another file"
    if rest.strip():
        return other
    for rule in rules:
        selector, opened, style = rule.partition("{")
        if not opened or not selector.strip() or "{" in style or not {"@", ";"}.isdisjoint(selector):
            return other
        if not _SELECTOR.fullmatch(selector):
            return f"the selector {selector.strip()[:60]!r}"
        reason = _danger_of_style(style)
        if reason is not None:
            return reason
    return None


def _without_comments(sheet: str) -> str:
    """Without the last one too, which need not be closed. By hand: a search for the ends of thousands that are not
    closed takes minutes."""
    pieces, position = [], 0
    while (start := sheet.find("/*", position)) >= 0:
        pieces.append(sheet[position:start])
        end = sheet.find("*/", start + 2)
        if end < 0:
            return " ".join(pieces)
        position = end + 2
    return " ".join([*pieces, sheet[position:]])
