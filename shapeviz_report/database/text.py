"""Text from a database: bytes of unknown encoding, names that are not Unicode, labels that look alike."""

from __future__ import annotations

import codecs
import os
import unicodedata


def decode(data: bytes) -> tuple[str, bool]:
    """Decode a text file: by its byte order mark, else UTF-8, else Windows-1252.

    Returns
    -------
    text : str
        Without byte order mark.
    certain : bool
        False if the text is not UTF-8 and the encoding was guessed.
    """
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return data.decode("utf-16", errors="replace"), True
    try:
        return data.decode("utf-8-sig"), True
    except UnicodeDecodeError:
        # latin-1 would also take the five bytes that Windows-1252 leaves undefined, but never means them
        return data.decode("cp1252", errors="replace"), False


def readable(name: str) -> str:
    """A file name as text: a name that is not UTF-8 on disk is taken as Latin-1, which maps every byte."""
    try:
        name.encode("utf-8")
    except UnicodeEncodeError:
        return os.fsencode(name).decode("latin-1")
    return name


def encodable(text: str) -> str:
    """Text without the lone surrogates that JSON can smuggle in and no encoding can write; itself, if it has none."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return text.encode("utf-8", errors="surrogatepass").decode("utf-8", errors="replace")
    return text


def clean(text: str) -> str:
    """A label or a metadata value as it is kept: encodable, composed (NFC), stripped.

    Without the normal form, two spellings of one word (macOS decomposes accents in file names) would be two
    classes that look the same. Everything else is the owner's: quotes, markup and control characters stay.
    """
    return unicodedata.normalize("NFC", encodable(text)).strip()
