"""The order in which names are listed: as people count, so that 2 comes before 10."""

from __future__ import annotations

import re
from collections.abc import Iterable


def natural(text: str) -> tuple[object, ...]:
    """A key that sorts as people do: ``cup 2`` before ``cup 10``, capitals among small letters.

    The text itself comes last, so that only equal texts are equal.
    """
    parts = re.split(r"(\d+)", text.casefold(), flags=re.ASCII)
    # Split at numbers, every second part is one: text is compared with text, numbers with numbers. A number is
    # compared by its length before its digits, because Python turns no text of thousands of digits into one.
    key = tuple(
        (len(part.lstrip("0")), part.lstrip("0")) if place % 2 else part for place, part in enumerate(parts)
    )
    return key, text


def classes_of(labels: Iterable[str | None]) -> tuple[str, ...]:
    """The classes that some labels name, each once, in natural order; None is no label.

    This order numbers classes wherever they have numbers, here and in the browser.
    """
    return tuple(sorted({label for label in labels if label is not None}, key=natural))
