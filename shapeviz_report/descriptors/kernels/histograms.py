"""Histograms of values at vertices."""

from shapeviz_report.compilation import kernel
from shapeviz_report.types import Float32Array, FloatArray


@kernel()
def add_up(values: Float32Array, limits: Float32Array, weights: FloatArray, totals: FloatArray) -> None:
    """Add the weight of every vertex to its bin of each dimension of ``totals``, (d, b + 1) float64.

    ``values`` are (n, d) float32, ``limits`` the (d, b) rising limits between bins, float32; a value at a limit
    belongs above it. ``weights`` are (n,) float64.
    """
    count, dimensions = values.shape
    inner = limits.shape[1]
    for i in range(count):
        for d in range(dimensions):
            place = 0
            for b in range(inner):
                place += values[i, d] >= limits[d, b]
            totals[d, place] += weights[i]
