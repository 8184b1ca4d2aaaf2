"""The order in which names are listed: as people count, so that 2 comes before 10."""

from __future__ import annotations

import re
from collections.abc import Iterable


def natural(text: str) -> tuple[object, ...]:
    """A key that sorts as people do: ``cup 2`` before ``cup 10``, capitals among small letters.

    A text that is nothing but a decimal goes by its value, ``0.25`` before ``0.5``. Inside of names points part counted
    numbers, ``v1.9`` before ``v1.10``, as file managers have it. The text itself comes last, so that only equal texts
    are equal.
    """
    decimal = re.fullmatch(r"(\d+)(\.\d+)", text, flags=re.ASCII)
    # Digits behind a decimal point compare from left to right, as text does.
    parts = ["", *decimal.groups()] if decimal else re.split(r"(\d+)", text.casefold(), flags=re.ASCII)
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
