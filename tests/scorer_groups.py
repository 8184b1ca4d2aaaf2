"""Small groups of rows with the scores that Python gives them, so that the browser's can be compared.

After a scorer has changed on purpose, `python tests/scorer_groups.py` writes them anew.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from shapeviz_report.scorers import SCORERS

FILE = Path(__file__).parent / "fixtures" / "scorers.json"

GRAIN = 1 / 4096
"""Values are multiples of it, so that single precision and a few decimals hold them exactly."""


def make_groups() -> list[dict[str, Any]]:
    """The content of the file.

    Each group has ``values``, a list a row, ``positive``, the rows of one group, a ``seed``, and ``scores``, method ->
    relative score of each column. Methods that are not exact see the positive rows first and the columns as they stand:
    in an order of their own, two languages would draw different numbers.
    """
    random = np.random.default_rng(11)
    groups = []
    for name, positives, count, width in [
        ("histograms", 9, 30, 40),
        ("both signs", 12, 26, 12),
        ("one against many", 1, 14, 10),
        ("two against one", 2, 3, 6),
        ("one against one", 1, 2, 5),
        ("copies and constants", 6, 18, 12),
    ]:
        values = random.dirichlet(np.full(10, 0.4), (count, -(-width // 10))).reshape(count, -1)[:, :width]
        values[:positives, : width // 4] *= 0.3
        values = np.sqrt(values)
        if name == "both signs":
            values = 3 * random.normal(size=values.shape) + 5 * (np.arange(count) < positives)[:, None]
        if name == "copies and constants":
            values[:, 3], values[:, 4:6], values[:, 7] = values[:, 0], 0.5, np.arange(count) < positives
        values = np.round(values / GRAIN) * GRAIN
        scores = {scorer.name: _relative(scorer, values, positives, seed=len(groups)) for scorer in SCORERS}
        groups.append(
            {
                "name": name,
                "values": values.tolist(),
                "positive": list(range(positives)),
                "seed": len(groups),
                "scores": scores,
            }
        )
    return groups


def _relative(scorer, values: np.ndarray, positives: int, seed: int) -> list[float]:
    varying = np.ptp(values, axis=0) > 0
    scores = np.zeros(values.shape[1])
    scores[varying] = scorer.measure(values[:, varying], np.arange(len(values)) < positives, seed)
    return np.round(scores / (scores.max() or 1), 9).tolist()


def read_groups() -> list[dict[str, Any]]:
    """The groups in the file, with ``values`` and ``scores`` as arrays."""
    groups = json.loads(FILE.read_text(encoding="utf-8"))
    for group in groups:
        group["values"] = np.array(group["values"])
        group["scores"] = {method: np.array(scores) for method, scores in group["scores"].items()}
    return groups


if __name__ == "__main__":
    lines = ",\n".join(json.dumps(group) for group in make_groups())
    FILE.write_text(f"[\n{lines}\n]\n", encoding="utf-8")
