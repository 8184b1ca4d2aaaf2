"""The types of the site's data for those who read it: ``site/scripts/chunks.d.ts``, as ``make chunks`` writes it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import NoneType, UnionType
from typing import (
    Any,
    Literal,
    NotRequired,
    Required,
    Union,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

import numpy as np

from shapeviz_report.pages import chunks

DECLARATIONS = Path(__file__).parents[1] / "site" / "scripts" / "chunks.d.ts"

_HEAD = """\
// Made of shapeviz_report/pages/chunks.py by `make chunks`. Only the type checker reads this file.

declare namespace Chunk {
"""

_PLAIN = {
    str: "string",
    int: "number",
    float: "number",
    bool: "boolean",
    NoneType: "null",
    bytes: "ArrayBuffer",
    Any: "any",
}


_ARRAYS = {
    np.uint8: "Uint8Array",
    np.uint16: "Uint16Array",
    np.uint32: "Uint32Array",
    np.int8: "Int8Array",
    np.int16: "Int16Array",
    np.int32: "Int32Array",
    np.float32: "Float32Array",
    np.float64: "Float64Array",
}


def typescript() -> str:
    """Every TypedDict of the module as an interface, in its order."""
    records = [record for record in vars(chunks).values() if is_typeddict(record)]
    return _HEAD + "\n".join(line for record in records for line in _interface(record)) + "\n}\n"


def _interface(record: Any) -> Iterator[str]:
    if record.__doc__ and not record.__doc__.startswith("dict("):
        yield f"  /** {record.__doc__.partition(chr(10))[0].replace('``', '`')} */"
    yield f"  interface {record.__name__} {{"
    for name, hint in get_type_hints(record, include_extras=True).items():
        # A chunk that is left out is never asked for.
        optional = name in record.__optional_keys__ and record not in (chunks.Chunks, chunks.Parts)
        yield f"    {name}{'?' if optional else ''}: {_type(hint)};"
    yield "  }"


def _type(hint: Any) -> str:
    origin, parts = get_origin(hint), get_args(hint)
    if hint in _PLAIN:
        return _PLAIN[hint]
    if is_typeddict(hint):
        return hint.__name__
    if origin in (NotRequired, Required):
        return _type(parts[0])
    if origin is np.ndarray:
        return _ARRAYS[_item_of(hint)]
    if origin is Literal:
        return " | ".join(f'"{value}"' for value in parts)
    if origin in (Union, UnionType):
        return " | ".join(map(_type, parts))
    if origin is list:
        item = _type(parts[0])
        return f"({item})[]" if " " in item else f"{item}[]"
    if origin is tuple:
        return f"[{', '.join(map(_type, parts))}]"
    if origin is dict:
        return f"Record<{_type(parts[0])}, {_type(parts[1])}>"
    raise TypeError(f"{hint} is no type of a chunk")


def _item_of(hint: Any) -> Any:
    """Of what an array is."""
    return get_args(get_args(hint)[1])[0]


def misfits(value: object, hint: Any, place: str = "") -> Iterator[str]:
    """Where a value, as JSON and arrays hold it, is not of its type."""
    origin, parts = get_origin(hint), get_args(hint)
    if is_typeddict(hint):
        if not isinstance(value, dict):
            yield f"{place} is no {hint.__name__}"
            return
        yield from (f"{place}.{name} is missing" for name in hint.__required_keys__ - value.keys())
        hints = get_type_hints(hint)
        for name, item in value.items():
            if name in hints:
                yield from misfits(item, hints[name], f"{place}.{name}")
            else:
                yield f"{place}.{name} is not declared"
    elif origin in (Union, UnionType):
        found = [list(misfits(value, part, place)) for part in parts]
        if all(found):
            yield from max(found, key=len) if value is not None else [f"{place} is None"]
    elif origin is np.ndarray:
        if not isinstance(value, np.ndarray) or value.dtype != _item_of(hint):
            yield f"{place} is no array of {_item_of(hint).__name__}"
    elif origin is list:
        if not isinstance(value, list):
            yield f"{place} is no list"
            return
        for number, item in enumerate(value):
            yield from misfits(item, parts[0], f"{place}[{number}]")
    elif origin is tuple:
        if not isinstance(value, list) or len(value) != len(parts):
            yield f"{place} is no list of {len(parts)}"
            return
        for number, (item, part) in enumerate(zip(value, parts)):
            yield from misfits(item, part, f"{place}[{number}]")
    elif origin is dict:
        if not isinstance(value, dict):
            yield f"{place} is no mapping"
            return
        for name, item in value.items():
            yield from misfits(name, parts[0], f"{place} {name!r}")
            yield from misfits(item, parts[1], f"{place}[{name!r}]")
    elif origin is Literal:
        if value not in parts:
            yield f"{place} is {value!r}"
    elif hint is not Any:
        kinds = (int, float) if hint is float else (hint,)
        if not isinstance(value, kinds) or (isinstance(value, bool) and hint is not bool):
            yield f"{place} is {value!r}, no {hint.__name__}"


if __name__ == "__main__":
    DECLARATIONS.write_text(typescript(), encoding="utf-8")
