"""An accent colour that can be read by day and by night."""

from __future__ import annotations

import re

from shapeviz_report.errors import ConfigError
from shapeviz_report.types import Accent

#: The ground on which text in the accent colour is hardest to read: ``--wash`` of each theme in ``tokens.css``.
LIGHT_GROUND = "#f1eee8"
DARK_GROUND = "#262a2f"

#: The least contrast of text (WCAG 2.2, criterion 1.4.3).
LEAST_CONTRAST = 4.5

_STEPS = 100


def fit_accent(color: str) -> Accent:
    """The variants of a colour that can be read on the pages: the colour itself where it can, else the nearest mixture
    with black by day, and with white by night.

    Parameters
    ----------
    color : str
        ``#rgb`` or ``#rrggbb``.

    Raises
    ------
    ConfigError
        It is written in another way.
    """
    digits = color.strip().removeprefix("#")
    if not re.fullmatch(r"[0-9a-fA-F]{3}|[0-9a-fA-F]{6}", digits):
        raise ConfigError(f"accent must be a colour such as #1f5f99, not {color!r}")
    whole = digits if len(digits) == 6 else "".join(digit * 2 for digit in digits)
    given = f"#{whole.lower()}"
    return Accent(_readable(given, "#000000", LIGHT_GROUND), _readable(given, "#ffffff", DARK_GROUND))


def contrast(one: str, other: str) -> float:
    """The contrast of two colours in [1, 21] (WCAG 2.2)."""
    darker, lighter = sorted((_luminance(one), _luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def _readable(color: str, towards: str, ground: str) -> str:
    mixtures = (_mixed(color, towards, step / _STEPS) for step in range(_STEPS + 1))
    return next(mixture for mixture in mixtures if contrast(mixture, ground) >= LEAST_CONTRAST)


def _mixed(one: str, other: str, share: float) -> str:
    pairs = zip(_channels(one), _channels(other), strict=True)
    return "#" + "".join(f"{round(a + (b - a) * share):02x}" for a, b in pairs)


def _channels(color: str) -> tuple[int, int, int]:
    red, green, blue = bytes.fromhex(color[1:])
    return red, green, blue


def _luminance(color: str) -> float:
    linear = [
        value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
        for value in (channel / 255 for channel in _channels(color))
    ]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
