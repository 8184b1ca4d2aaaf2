"""Files and folders that are being written: hidden, locked while their writer lives, and cleared by the next writer.

A writer that is killed leaves what it was writing, and its lock ends with it. Whoever writes there next removes what
nobody holds.
"""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from hashlib import sha256
from pathlib import Path

from shapeviz_report.system import claimed, held


def hidden_prefix(name: str, state: str) -> str:
    """How names begin of what is written for an entry of a folder: in less than 60 characters, however long its own."""
    return f".{name[:24]}-{sha256(os.fsencode(name)).hexdigest()[:8]}.{state}-"


def new_path(folder: Path, prefix: str) -> Path:
    """A path in a folder whose name begins so, and where nothing is yet."""
    return folder / (prefix + secrets.token_hex(6))


@contextmanager
def created(folder: Path, prefix: str, make: Callable[[Path], object]) -> Iterator[Path]:
    """Make something new in a folder and hold it inside: it is no leftover, whatever it is renamed to.

    Parameters
    ----------
    folder : Path
    prefix : str
        How its name begins.
    make : callable
        Makes a file or a folder at a path.

    Raises
    ------
    OSError
        It cannot be made.
    """
    with ExitStack() as stack:
        while True:
            path = new_path(folder, prefix)
            make(path)
            # somebody may take it for a leftover in the instant before it is held
            with suppress(FileNotFoundError):
                stack.enter_context(held(path))
                break
        yield path


def leftovers(folder: Path, prefix: str) -> Iterator[Path]:
    """The entries of a folder whose names begin so and that no living process holds, each locked while it is looked at.

    Raises
    ------
    OSError
        The folder cannot be read.
    """
    for name in sorted(os.listdir(folder)):
        if not name.startswith(prefix):
            continue
        with suppress(OSError), claimed(folder / name):
            yield folder / name


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file so that at no moment anything but its old or its whole new content is there.

    Raises
    ------
    OSError
        The old content is still there.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    prefix = hidden_prefix(path.name, "writing")
    for left in leftovers(path.parent, prefix):
        with suppress(OSError):
            left.unlink()
    with created(path.parent, prefix, Path.touch) as temporary:
        try:
            temporary.write_bytes(content)
            temporary.replace(path)
        except BaseException:
            with suppress(OSError):
                temporary.unlink()
            raise
