"""Text of mesh files: its encoding, its line ends, its numbers."""

from __future__ import annotations

import codecs
import re
import warnings
from typing import Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import Indices, whole_numbers
from shapeviz_report.types import FloatArray

Characters = npt.NDArray[np.uint8]

# UTF-32 first: its mark begins with that of UTF-16
_MARKS = (
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF8, "latin-1"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
_SPECIAL = r"IND|INF|QNAN|SNAN|QNB|J"
# the '#' comes first, so that the search for it is quick
_COMMENT = re.compile(rf"#(?!(?<=1\.#)(?i:{_SPECIAL}))[^\n]*")
_FORTRAN_EXPONENT = re.compile(r"(?<=[\d.])[dD](?=[+-]?\d)")
_NOT_A_NUMBER = re.compile(
    r"(?<!\S)[+-]?(?:1\.#(?:IND|QNAN|SNAN|QNB)\d*|[qs]?nan(?:\([^()\s]*\)|[qs])?)(?!\S)", re.IGNORECASE
)
_INFINITE = re.compile(r"(?<!\S)([+-]?)1\.#(?:INF|J)\d*(?!\S)", re.IGNORECASE)
_NUMBER = re.compile(
    r"[+-]?(?:(?:\d+(?:\.\d*)?|\.\d+)(?:e[+-]?\d+)?|inf|infinity|nan)(?:/[-\d/]*)?", re.IGNORECASE
)
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(?:e[+-]?\d+)?,?", re.IGNORECASE)


def decode(data: bytes) -> str:
    r"""The text of a file, lines ended by ``\n``.

    UTF-16 and UTF-32 are known by their byte order mark, or by where the zeros of the first characters stand. Anything
    else is taken byte by byte: beyond names and comments a mesh is ASCII. Stray NULs, and the mark at which DOS ends a
    text, become blanks.
    """
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            text = data[len(mark) :].decode(encoding, errors="replace")
            break
    else:
        text = data.decode(_encoding_without_mark(data[:64]), errors="replace")
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    return text.replace("\0", " ").replace("\x1a", " ")


def in_utf8(name: str) -> str:
    """A name of which :func:`decode` took the bytes one by one, though most programs write UTF-8."""
    try:
        return name.encode("latin-1").decode()
    except UnicodeError:
        return name


def without_mark(data: bytes) -> bytes:
    """A file that may be binary behind a header of text, without a byte order mark; as bytes again if it is UTF-16 or
    UTF-32, which only text can be."""
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return data[len(mark) :] if encoding == "latin-1" else decode(data).encode("latin-1", "replace")
    if _encoding_without_mark(data[:64]) != "latin-1":
        return decode(data).encode("latin-1", "replace")
    return data


def _encoding_without_mark(head: bytes) -> str:
    head = head[: len(head) // 4 * 4]
    empty = [len(head) > 4 and not any(head[place::4]) for place in range(4)]
    encodings = {
        (False, True, True, True): "utf-32-le",
        (True, True, True, False): "utf-32-be",
        (False, True, False, True): "utf-16-le",
        (True, False, True, False): "utf-16-be",
    }
    return encodings.get((empty[0], empty[1], empty[2], empty[3]), "latin-1")


def strip_comments(text: str) -> str:
    """Text without what follows a ``#``, except where it is part of a number (``1.#IND``)."""
    return _COMMENT.sub("", text) if "#" in text else text


def parse_numbers(text: str) -> FloatArray:
    """All numbers of a text that has nothing else.

    Also numbers with Fortran's exponents (``1.0D+00``), and what is no number as C libraries write it
    (``-nan(ind)``, ``1.#QNAN``).

    Raises
    ------
    MeshError
        With the first word that is no number.
    """
    numbers = _scan(text, np.float64)
    if numbers is None:
        text = mend_numbers(text)
        numbers = _scan(text, np.float64)
    if numbers is None:
        raise not_numbers(text)
    return numbers


def parse_indices(text: str) -> Indices:
    """All numbers of a text that has nothing but whole numbers. Raises ``MeshError``."""
    indices = _scan(text, np.int64)  # much faster than as float64
    limits = np.iinfo(np.int64)  # where numpy stops counting in silence
    if indices is None or (len(indices) and (indices.max() == limits.max or indices.min() == limits.min)):
        return whole_numbers(parse_numbers(text))
    return indices


def parse_columns(text: str, width: int) -> FloatArray:
    """The first ``width`` numbers of each line, whatever follows them: an array (number of lines, ``width``).

    Raises
    ------
    MeshError
        If a line has fewer, or anything else among them.
    """
    words = count_words(text)
    if len(words) and words[0] >= width and (words == words[0]).all():
        numbers = _scan(text, np.float64)
        if numbers is not None and numbers.size == words.sum():
            return np.ascontiguousarray(numbers.reshape(len(words), -1)[:, :width])
    rows = text.split("\n")[: len(words)]
    short = np.flatnonzero(words < width)
    if len(short):
        raise MeshError(f"a vertex has fewer than {width} coordinates: {rows[short[0]].strip()[:60]!r}")
    wanted = "\n".join(word for row in rows for word in row.split()[:width])
    numbers = parse_numbers(wanted)
    if numbers.size != width * len(rows):
        raise not_numbers(wanted)
    return numbers.reshape(len(rows), width)


def count_words(text: str) -> Indices:
    """How many words each line has; text is ASCII or Latin-1, and all its lines are ended."""
    characters = np.frombuffer(text.encode("latin-1", "replace"), np.uint8)
    visible = characters > ord(" ")
    begins = np.cumsum(visible & ~np.concatenate([[False], visible[:-1]]))
    return np.diff(begins[characters == ord("\n")], prepend=0)


def mend_numbers(text: str) -> str:
    """Numbers that only some programs write, as all can read them."""
    text = _FORTRAN_EXPONENT.sub("e", text)
    text = _NOT_A_NUMBER.sub("nan", text)
    return _INFINITE.sub(r"\1inf", text)


def not_numbers(text: str) -> MeshError:
    """What to say of a text that has other words than numbers."""
    word = next((word for word in text.split() if not _NUMBER.fullmatch(word)), "")
    if _DECIMAL_COMMA.fullmatch(word):
        return MeshError(f"it has numbers with a decimal comma ({word[:20]}); export it with decimal points")
    return MeshError(f"something else stands where a number belongs: {word[:40]!r}")


def _scan(text: str, kind: type[np.float64] | type[np.int64]) -> npt.NDArray[Any] | None:
    """All numbers; None if numpy stops before the end, which it only warns of."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            return np.fromstring(text, kind, sep=" ")
        except (DeprecationWarning, ValueError):
            return None
