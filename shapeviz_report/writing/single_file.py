"""A whole site in one HTML file, to be mailed: pages as templates, data and pictures as blocks of text.

``site/scripts/opening/single-file.js`` opens one of the pages; ``site/scripts/base/place.js`` knows where the parts
are.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import PurePosixPath

#: Types of the files that a page shows or hands out.
_TYPES = {
    ".csv": "text/csv",
    ".json": "application/json",
    ".jsonld": "application/ld+json",
    ".npz": "application/octet-stream",
    ".parquet": "application/vnd.apache.parquet",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".txt": "text/plain",
    ".webp": "image/webp",
}

#: What would end a script, or begin another one inside it, wherever it stands in its text.
_BREAKS_OUT = re.compile(r"</script|<!--|<script|\r|\0", re.IGNORECASE)


@dataclass(frozen=True)
class Inline:
    """Scripts and style that stand in a document itself, and the policy that admits them and nothing else.

    Attributes
    ----------
    style : str
    scripts : tuple of str
        In the order in which they run.
    """

    style: str
    scripts: tuple[str, ...]

    def __post_init__(self) -> None:
        for script in self.scripts:
            found = _BREAKS_OUT.search(script)
            if found is not None:
                raise ValueError(f"a script with {found.group()!r} cannot stand in a document")

    @property
    def policy(self) -> str:
        """A Content-Security-Policy: these scripts and this style by their hashes, and no request at all."""
        return "; ".join(
            (
                "default-src 'none'",
                f"script-src {' '.join(_source(script) for script in self.scripts)}",
                f"style-src {_source(self.style)}",
                "img-src data: blob:",
                "worker-src blob:",
                "base-uri 'none'",
                "form-action 'none'",
                "require-trusted-types-for 'script'",
                "trusted-types default",
            )
        )


def handed_over(address: str, script: str) -> str:
    """A script that is kept until the page is opened that names it by its address in a folder."""
    return f'shapeviz.scripts.set("{address}", () => {{\n{script}\n}});\n'


def data_address(path: str, content: bytes) -> str:
    """A file as an address that holds it."""
    return f"data:{media_type(path)};base64,{base64_text(content)}"


def base64_text(content: bytes) -> str:
    """A file as it stands in the document."""
    return base64.b64encode(content).decode()


def media_type(path: str) -> str:
    """The type of a file of the site, by its name."""
    return _TYPES[PurePosixPath(path).suffix]


def _source(text: str) -> str:
    return f"'sha256-{base64_text(sha256(text.encode()).digest())}'"


def split_large(files: Mapping[str, bytes], limit: int) -> tuple[dict[str, bytes], tuple[str, ...]]:
    """The files of at most ``limit`` bytes, and the paths of the others."""
    small = {path: content for path, content in files.items() if len(content) <= limit}
    return small, tuple(path for path in files if path not in small)
