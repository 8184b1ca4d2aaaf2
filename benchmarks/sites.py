"""Features as a built site offers them for download."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.types import FeatureTable, FloatArray


def load_features(file: Path, preset: str) -> tuple[FeatureTable, FloatArray, list[str]]:
    """The table in SITE/data/features.npz, its values as projections compare them, and the folder of each shape.

    Parameters
    ----------
    file : Path
    preset : str
        The one that the site was built with.
    """
    with np.load(file) as archive:
        table = FeatureTable(tuple(archive["shape_ids"].tolist()), PRESETS[preset].blocks, archive["values"])
    return table, scale(table, PRESETS[preset]), [name.rpartition("/")[0] for name in table.shape_ids]
