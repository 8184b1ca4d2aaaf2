"""Random numbers that are the same in a compiled loop and in a browser."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel

_MASK = np.uint64(0xFFFFFFFF)
_STEP = np.uint64(0x9E3779B9)


@kernel()
def start(seed: int) -> npt.NDArray[np.uint64]:
    """The state (1,) of a generator, which :func:`uniform` moves on; as ``site/scripts/engine/random.js`` has it."""
    state = np.empty(1, np.uint64)
    state[0] = ((np.uint64(seed) * np.uint64(0x9E3779B1)) & _MASK) ^ np.uint64(0x5BF03635)
    return state


@kernel()
def uniform(state: npt.NDArray[np.uint64]) -> float:
    """The next number, evenly from [0, 1)."""
    state[0] = (state[0] + _STEP) & _MASK
    bits = state[0]
    bits = ((bits ^ (bits >> np.uint64(16))) * np.uint64(0x21F0AAAD)) & _MASK
    bits = ((bits ^ (bits >> np.uint64(15))) * np.uint64(0x735A2D97)) & _MASK
    return float(bits ^ (bits >> np.uint64(15))) / 4294967296.0
