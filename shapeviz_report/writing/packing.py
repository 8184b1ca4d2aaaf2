"""Chunks: data as scripts that hand it over, the one way to load any from ``file://``."""

from __future__ import annotations

import codecs
import gzip
import json
from collections.abc import Iterator
from typing import Any

import numpy as np

from shapeviz_report.writing.data import json_text

#: Arrays begin at multiples of so many bytes, as browsers want them.
ALIGNMENT = 8

#: Of gzip: 9 takes five times as long for a hundredth of the bytes.
LEVEL = 6

#: The letter of fifteen bits without any set; ``FIRST_LETTER`` of ``base/chunks.js``. From here on there are 2**15
#: letters of which none ends a comment of JavaScript and none is half of another.
FIRST_LETTER = 0x100


def pack(value: object, *, compressed: bool = True) -> tuple[str, bytes]:
    """The kind of a chunk and its content, gzipped.

    Parameters
    ----------
    value : object
        Bytes, or what JSON holds, in which arrays of numbers may stand anywhere but at the top.
    compressed : bool
        Whether to gzip it; what is compressed already, with arrays in it, only takes longer then.

    Returns
    -------
    kind : {"bytes", "json", "columns", "stored"}
    content : bytes
        Of ``columns``, and of ``stored`` ones without gzip, JSON whose arrays follow it in little-endian bytes, which
        take less room and time than text: the length of the JSON as uint32; at 8 the JSON, a ``value`` with nothing
        where its ``arrays`` belong, each with the way to its place, its type, its length, and where it starts; from the
        next multiple of 8 on the arrays.
    """
    if isinstance(value, bytes):
        kind, content = "bytes", value
    elif arrays := list(_arrays(value, ())):
        kind, content = "columns", _with_arrays(value, arrays)
        if not compressed:
            return "stored", content
    else:
        kind, content = "json", json_text(value).encode()
    return kind, gzip.compress(content, compresslevel=LEVEL, mtime=0)


def chunk_script(name: str, kind: str, packed: bytes) -> bytes:
    """A script that hands packed data to the page, as letters of fifteen bits.

    They are a comment of a function, whose text a page has without a copy. It is UTF-16 and says so in its first bytes,
    which count more than what a host says of it: so it takes a fifteenth more room than the data, where base64 takes a
    third.
    """
    head = f"shapeviz.receive({json.dumps(name)}, {json.dumps(kind)}, {len(packed)}, () => {{/*"
    return codecs.BOM_UTF16_LE + _utf16(head) + _letters(packed) + _utf16("*/});\n")


def _utf16(text: str) -> bytes:
    return text.encode("utf-16-le")


def _letters(content: bytes) -> bytes:
    """In UTF-16: fifteen numbers of two bytes at a time, without their highest bits, which follow in a letter.

    A page puts a number together in two steps, and goes through many megabytes of them.
    """
    numbers = np.frombuffer(content + bytes(-len(content) % 30), "<u2").reshape(-1, 15)
    letters = np.empty((len(numbers), 16), "<u2")
    letters[:, :15] = numbers & 0x7FFF
    letters[:, 15] = (numbers >> 15) @ (1 << np.arange(15))
    letters += FIRST_LETTER
    return letters.tobytes()


Way = tuple[str | int, ...]


def _arrays(value: Any, way: Way) -> Iterator[tuple[Way, np.ndarray]]:
    """The arrays within a value, and the keys that lead to them."""
    if isinstance(value, np.ndarray):
        yield way, value
    elif isinstance(value, dict | list | tuple):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            # Most are the texts and numbers of long lists.
            if not isinstance(item, str | int | float | None):
                yield from _arrays(item, (*way, key))


def _with_arrays(value: object, arrays: list[tuple[Way, np.ndarray]]) -> bytes:
    places, parts, start = [], [], 0
    for way, array in arrays:
        if array.dtype.kind == "f" and np.isinf(array).any():
            raise ValueError(f"an infinity in the array at {way}")
        content = array.astype(array.dtype.newbyteorder("<"), copy=False).tobytes()
        places.append({"way": way, "type": array.dtype.str[1:], "length": array.size, "start": start})
        parts.append(content + bytes(-len(content) % ALIGNMENT))
        start += len(parts[-1])
    head = json.dumps(
        {"value": value, "arrays": places}, allow_nan=False, separators=(",", ":"), default=lambda array: None
    ).encode()
    length = len(head).to_bytes(ALIGNMENT, "little")
    return b"".join([length, head, bytes(-len(head) % ALIGNMENT), *parts])
