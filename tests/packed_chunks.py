"""Chunks as the page reads them."""

from __future__ import annotations

import gzip
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from shapeviz_report.writing.packing import pack

_HANDED_OVER = re.compile(
    r'shapeviz\.receive\("([\w-]+)", "(\w+)", (\d+), \(\) => \{/\*([\u0100-\u80ff]*)\*/\}\);\n'
)


def packed(chunks: Mapping[str, object]) -> dict[str, tuple[str, bytes]]:
    """Chunks as the site holds them, which can be compared."""
    return {name: pack(value) for name, value in chunks.items()}


def read_script(script: Path) -> tuple[str, Any]:
    """The name and the content of a chunk."""
    name, kind, length, letters = _HANDED_OVER.fullmatch(script.read_text(encoding="utf-16")).groups()
    return name, unpack(kind, read_letters(letters, int(length)))


def read_letters(letters: str, length: int) -> bytes:
    """The bytes that groups of sixteen letters of fifteen bits stand for."""
    values = [ord(letter) - 0x100 for letter in letters]
    content = b"".join(
        (value | (values[group + 15] >> place & 1) << 15).to_bytes(2, "little")
        for group in range(0, len(values), 16)
        for place, value in enumerate(values[group : group + 15])
    )
    assert len(values) % 16 == 0
    assert len(content) - length in range(30)
    assert not any(content[length:])
    return content[:length]


def unpack(kind: str, packed: bytes) -> Any:
    """What :func:`shapeviz_report.writing.packing.pack` packed."""
    content = packed if kind == "stored" else gzip.decompress(packed)
    if kind == "bytes":
        return content
    if kind == "json":
        return json.loads(content)
    length = int.from_bytes(content[:8], "little")
    head = json.loads(content[8 : 8 + length])
    arrays = content[8 + length + -length % 8 :]
    for place in head["arrays"]:
        holder = head["value"]
        for key in place["way"][:-1]:
            holder = holder[key]
        holder[place["way"][-1]] = np.frombuffer(arrays, "<" + place["type"], place["length"], place["start"])
    return head["value"]


def texts_of(held: Mapping[str, np.ndarray]) -> list[str]:
    """Very many texts as `texts_chunk` of pages/base.py holds them, each with a byte that ends its line behind it."""
    content = held["bytes"].tobytes()
    ends = np.cumsum(held["lengths"] + 1) - 1
    return [content[end - length : end].decode() for end, length in zip(ends, held["lengths"], strict=True)]
