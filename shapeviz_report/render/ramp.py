"""The colours of a value on a surface: from dark violet over green to light yellow, in even steps.

Even means equal distances in OKLab (Ottosson, "A perceptual color space for image processing", 2020), in which
lightness rises at a constant rate as well: so the ramp is read right in grey, and by colour-blind eyes.
"""

from __future__ import annotations

import numpy as np

from shapeviz_report.types import FloatArray

_LIGHTNESS = (0.34, 0.93)
_HUE = (np.radians(300.0), np.radians(105.0))
_CHROMA = 0.13
_SAMPLES = 256


def ramp_colors(shares: FloatArray) -> FloatArray:
    """Colours of some places on the ramp.

    Parameters
    ----------
    shares : (n,) array
        From 0, the dark end, to 1; what lies beyond gets the colour of the end.

    Returns
    -------
    (n, 3) float64 array
        Linear RGB of sRGB's primaries, in [0, 1].
    """
    places = np.linspace(0, 1, _SAMPLES)
    return np.stack([np.interp(shares, places, channel) for channel in _TABLE.T], axis=1)


def ramp_codes(count: int) -> list[str]:
    """The ramp in ``count`` steps from end to end, at least 2, as ``#rrggbb``."""
    linear = ramp_colors(np.linspace(0, 1, count))
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return ["#" + "".join(f"{level:02x}" for level in row) for row in np.round(encoded * 255).astype(int)]


def _linear_rgb(lab: FloatArray) -> FloatArray:
    """OKLab to linear RGB; not clipped."""
    roots = lab @ np.array(
        [
            [1.0, 1.0, 1.0],
            [0.3963377774, -0.1055613458, -0.0894841775],
            [0.2158037573, -0.0638541728, -1.2914855480],
        ]
    )
    return roots**3 @ np.array(
        [
            [4.0767416621, -1.2684380046, -0.0041960863],
            [-3.3077115913, 2.6097574011, -0.7034186147],
            [0.2309699292, -0.3413193965, 1.7076147010],
        ]
    )


def _build_table() -> FloatArray:
    """The ramp in ``_SAMPLES`` colours, equally far from each other."""
    along = np.linspace(0, 1, 16 * _SAMPLES)
    lightness = np.interp(along, (0, 1), _LIGHTNESS)
    hue = np.interp(along, (0, 1), _HUE)
    lab = np.stack([lightness, _CHROMA * np.cos(hue), _CHROMA * np.sin(hue)], axis=1)
    # Colours that no screen shows lose chroma until one does.
    for _ in range(40):
        rgb = _linear_rgb(lab)
        beyond = (rgb < 0).any(axis=1) | (rgb > 1).any(axis=1)
        if not beyond.any():
            break
        lab[beyond, 1:] *= 0.97
    lengths = np.append(0, np.cumsum(np.linalg.norm(np.diff(lab, axis=0), axis=1)))
    even = np.interp(np.linspace(0, lengths[-1], _SAMPLES), lengths, np.arange(len(lab)))
    return np.clip(_linear_rgb(lab[np.round(even).astype(int)]), 0, 1)


_TABLE = _build_table()
