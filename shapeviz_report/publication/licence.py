"""Licences by the identifiers that people use for them."""

from __future__ import annotations

import re

from shapeviz_report.types import Licence

#: Columns of a table that name a licence for each shape, in lower case.
LICENCE_COLUMNS = ("licence", "license", "rights")

#: SPDX identifiers that are common for data and models, beside those of Creative Commons.
_SPDX = {
    "apache-2.0": ("Apache-2.0", "Apache License 2.0"),
    "bsd-2-clause": ("BSD-2-Clause", "BSD 2-Clause License"),
    "bsd-3-clause": ("BSD-3-Clause", "BSD 3-Clause License"),
    "cc-pddc": ("CC-PDDC", "Creative Commons Public Domain Dedication"),
    "cdla-permissive-2.0": ("CDLA-Permissive-2.0", "Community Data License Agreement Permissive 2.0"),
    "gpl-3.0-only": ("GPL-3.0-only", "GNU General Public License v3.0"),
    "gpl-3.0-or-later": ("GPL-3.0-or-later", "GNU General Public License v3.0 or later"),
    "mit": ("MIT", "MIT License"),
    "odbl-1.0": ("ODbL-1.0", "Open Database License 1.0"),
    "odc-by-1.0": ("ODC-By-1.0", "Open Data Commons Attribution License 1.0"),
    "pddl-1.0": ("PDDL-1.0", "Open Data Commons Public Domain Dedication and License 1.0"),
}
_CREATIVE_COMMONS = re.compile(r"cc[- ](by(?:-nc)?(?:-sa|-nd)?)[- ](1\.0|2\.0|2\.5|3\.0|4\.0)")
_TERMS = {"by": "Attribution", "nc": "NonCommercial", "sa": "ShareAlike", "nd": "NoDerivatives"}


def find_licence(text: str) -> Licence | None:
    """The licence that a text names: an SPDX identifier, an address, or words that are taken as they are.

    Returns
    -------
    Licence or None
        None for empty text.
    """
    words = " ".join(text.split())
    key = words.casefold()
    if key in ("cc0", "cc0-1.0", "cc0 1.0"):
        return Licence(
            "CC0 1.0: public domain dedication", "https://creativecommons.org/publicdomain/zero/1.0/"
        )
    found = _CREATIVE_COMMONS.fullmatch(key)
    if found is not None:
        kind, number = found.groups()
        terms = "-".join(_TERMS[part] for part in kind.split("-"))
        return Licence(
            f"CC {kind.upper()} {number}: {terms}", f"https://creativecommons.org/licenses/{kind}/{number}/"
        )
    if key in _SPDX:
        identifier, name = _SPDX[key]
        return Licence(name, f"https://spdx.org/licenses/{identifier}.html")
    if re.fullmatch(r"https?://[^\s<>\"]+", words):
        return Licence(words, words)
    return Licence(words) if words else None
