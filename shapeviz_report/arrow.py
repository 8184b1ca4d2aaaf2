"""Parquet and data frames, by pyarrow: it weighs as much as all else here, and is installed where it is asked for."""

from __future__ import annotations

import importlib.util
import io
import os
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import ConfigError

if TYPE_CHECKING:
    from pathlib import Path

    import pyarrow

INSTALL = "pip install 'shapeviz-report[parquet]'"

Columns = list[tuple[str, list[str] | None]]
"""Names of columns, and their cells as texts; None where cells are no texts. A name may come twice."""

_SECOND = {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}

_EXTENSION = b"ARROW:extension:name"
"""The key of a column's metadata that names the library which knows what its values mean."""

_FRACTION = re.compile(r"\.(\d*?)0*(?=\D|$)")
"""The fraction of a second, with the zeros at its end apart."""


def require_pyarrow(what: str, instead: str) -> None:
    """Raise ``ConfigError`` where pyarrow is not installed, with what needs it and what to do ``instead``."""
    if importlib.util.find_spec("pyarrow") is None:
        raise ConfigError(f"{what} needs pyarrow, which is not installed: {INSTALL}; {instead}")


def parquet_bytes(columns: Mapping[str, npt.NDArray[Any] | Sequence[str | None]]) -> bytes:
    """Columns of one length as a file: the same bytes with the same version of pyarrow.

    Parameters
    ----------
    columns : mapping of str to (n,) array of numbers, or sequence of str
        By name, in order. NaN and None are nulls.
    """
    import pyarrow
    from pyarrow import parquet

    arrays = [
        pyarrow.array(values, from_pandas=True)
        if isinstance(values, np.ndarray)
        else pyarrow.array([None if text is None else _encodable(text) for text in values], pyarrow.string())
        for values in columns.values()
    ]
    names = [*map(_encodable, columns)]
    file = io.BytesIO()
    # Dictionaries of numbers and statistics of thousands of columns would be a fifth of the file.
    parquet.write_table(
        pyarrow.Table.from_arrays(arrays, names),
        file,
        compression="zstd",
        use_dictionary=[name for name, column in zip(names, arrays) if column.type == pyarrow.string()],
        write_statistics=False,
    )
    return file.getvalue()


def parquet_names(path: Path) -> list[str]:
    """What the columns of a Parquet file are called. Raises ``ValueError``, ``OSError``."""
    from pyarrow import parquet

    return list(parquet.read_schema(path).names)


def _encodable(text: str) -> str:
    """Text as UTF-8 can have it: a file name that is no valid text holds lone surrogates."""
    return text.encode("utf-8", "backslashreplace").decode()


def parquet_texts(content: bytes, most_cells: int, most_bytes: int) -> Columns:
    """The columns of a file as :func:`read_parquet` reads it, by their names, as :func:`column_texts` has them."""
    return table_texts(read_parquet(content, most_cells, most_bytes))


def table_texts(table: pyarrow.Table) -> Columns:
    """The columns of a table by their names, as :func:`column_texts` has them; None also for those that only another
    library can read, as periods of pandas, which are mere numbers without it."""
    return [
        (field.name, None if _is_foreign(field) else column_texts(column))
        for field, column in zip(table.schema, table.columns)
    ]


def _is_foreign(field: pyarrow.Field) -> bool:
    import pyarrow

    return isinstance(field.type, pyarrow.BaseExtensionType) or _EXTENSION in (field.metadata or {})


def read_parquet(content: bytes, most_cells: int, most_bytes: int) -> pyarrow.Table:
    """The table in a file of a stranger. Texts that repeat stay in dictionaries.

    Parameters
    ----------
    content : bytes
    most_cells, most_bytes : int
        Cells that it may have, nulls too, and bytes that they may unpack to.

    Raises
    ------
    ValueError
        It is no such table, or a larger one.
    """
    import pyarrow
    from pyarrow import parquet

    try:
        with parquet.ParquetFile(io.BytesIO(content)) as file:
            texts = [field.name for field in file.schema_arrow if _is_text(field.type)]
        # a few letters that a million cells share are not unpacked to a million times as many
        with parquet.ParquetFile(io.BytesIO(content), read_dictionary=texts) as file:
            told = file.metadata
            if told.num_rows * told.num_columns > most_cells:
                raise ValueError(f"it has more than {most_cells:,} cells")
            unpacked = 0
            parts = []
            for group in range(told.num_row_groups):
                unpacked += told.row_group(group).total_byte_size
                if unpacked > most_bytes:
                    raise ValueError(f"it unpacks to more than {most_bytes // 2**20} MiB")
                parts.append(file.read_row_group(group, use_threads=False))
            return pyarrow.concat_tables(parts) if parts else file.schema_arrow.empty_table()
    except (pyarrow.ArrowException, OSError) as error:
        reason = str(error).partition("\n")[0]
        raise ValueError(f"it is no Parquet: {reason[:200]}") from error


def _is_text(kind: pyarrow.DataType) -> bool:
    import pyarrow

    return pyarrow.types.is_string(kind) or pyarrow.types.is_large_string(kind)


def frame_table(frame: Any) -> pyarrow.Table:
    """A data frame of pandas, Polars or whatever else speaks Arrow, as a table of pyarrow.

    Raises
    ------
    TypeError
        It is no data frame.
    ValueError
        A column holds what is no text, number or date.
    """
    import pyarrow

    # a single column has one type
    if not (isinstance(frame, pyarrow.Table) or hasattr(frame, "__arrow_c_stream__")) or hasattr(
        frame, "dtype"
    ):
        raise TypeError(f"{type(frame).__name__} is neither a path nor a data frame")
    frame = _with_texts(frame)
    try:
        return pyarrow.table(frame)
    except (pyarrow.ArrowException, ValueError, TypeError) as error:
        raise ValueError(": ".join(map(str, error.args))) from error


def _with_texts(frame: Any) -> Any:
    """A data frame of pandas with text in place of what Arrow has no type for, such as paths, years beside words,
    months or the ranges of ``pandas.cut``; any other frame as it is."""
    if not hasattr(frame, "iloc") or not frame.columns.is_unique:
        return frame
    texts = {}
    for column in frame.columns:
        if frame[column].dtype.kind == "O" and not _has_type(frame[column]):
            cells = zip(frame[column], frame[column].isna())
            texts[column] = [
                None if empty else os.fspath(cell) if isinstance(cell, os.PathLike) else str(cell)
                for cell, empty in cells
            ]
    if texts:
        frame = frame.copy(deep=False)
        for column, cells_of_it in texts.items():
            frame[column] = cells_of_it
    return frame


def _has_type(column: Any) -> bool:
    """Whether Arrow has a type for the cells of a column of pandas."""
    import pyarrow

    try:
        kind = pyarrow.array(column, from_pandas=True).type
    except (pyarrow.ArrowException, ValueError, TypeError):
        return False
    kind = kind.value_type if pyarrow.types.is_dictionary(kind) else kind
    return not isinstance(kind, pyarrow.BaseExtensionType)


def column_texts(column: pyarrow.ChunkedArray) -> list[str] | None:
    """The cells of a column as one would write them, empty for nulls and NaN; None for bytes that are no text, and for
    lists and the like.

    Whole numbers have no point, dates no time, durations hours, minutes and seconds, and none zeros at their ends.
    """
    import pyarrow
    from pyarrow import compute

    kind = column.type
    if pyarrow.types.is_dictionary(kind):
        found: list[str] = []
        for chunk in column.chunks:
            texts = column_texts(pyarrow.chunked_array([chunk.dictionary]))
            if texts is None:
                return None
            found += ["" if place is None else texts[place] for place in chunk.indices.to_pylist()]
        return found
    if pyarrow.types.is_duration(kind):
        second = _SECOND[kind.unit]
        counts = compute.cast(column, pyarrow.int64()).to_pylist()
        return ["" if count is None else _duration(count, second) for count in counts]
    try:
        cells = compute.cast(column, pyarrow.string()).to_pylist()
    except (pyarrow.ArrowException, UnicodeDecodeError):
        return None
    texts = ["" if cell is None else cell for cell in cells]
    if pyarrow.types.is_floating(kind):
        return ["" if text == "nan" else text for text in texts]
    if pyarrow.types.is_temporal(kind):
        texts = [_FRACTION.sub(_point_and_digits, text) for text in texts]
        if all(text == "" or text.endswith(" 00:00:00") for text in texts):
            texts = [text.removesuffix(" 00:00:00") for text in texts]
    return texts


def _duration(count: int, second: int) -> str:
    """A duration of so many parts of a second as hours, minutes and seconds."""
    seconds, rest = divmod(abs(count), second)
    text = f"{seconds // 3600}:{seconds // 60 % 60:02}:{seconds % 60:02}.{rest:0{len(str(second)) - 1}}"
    return ("-" if count < 0 else "") + _FRACTION.sub(_point_and_digits, text)


def _point_and_digits(fraction: re.Match[str]) -> str:
    return f".{fraction[1]}" if fraction[1] else ""


def column_numbers(column: pyarrow.ChunkedArray) -> npt.NDArray[np.float64] | None:
    """The cells of a column of numbers, or of lists of as many numbers, as (n, d) values, NaN for nulls; None for any
    other."""
    import pyarrow
    from pyarrow import compute

    kind, count = column.type, len(column)
    types = pyarrow.types
    if types.is_list(kind) or types.is_large_list(kind) or types.is_fixed_size_list(kind):
        lengths = compute.unique(compute.list_value_length(column)).to_pylist()
        if len(lengths) > 1 or None in lengths:
            return None
        column, kind = compute.list_flatten(column), kind.value_type
    if types.is_boolean(kind):
        column = compute.cast(column, pyarrow.uint8())
    elif not (types.is_integer(kind) or types.is_floating(kind) or types.is_decimal(kind)):
        return None
    values = np.asarray(compute.cast(column, pyarrow.float64(), safe=False).to_numpy(), np.float64)
    return values.reshape(count, -1) if count else values.reshape(0, 1)
