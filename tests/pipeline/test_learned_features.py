"""The guide to learned features, with the network that it offers to those who have none."""

from __future__ import annotations

import re
import runpy
import shutil
from pathlib import Path

import numpy as np
import pytest
from small_database import OPTIONS

import shapeviz_report

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]


def test_views_of_shapes_become_a_feature_of_a_site(database, cache, tmp_path) -> None:
    shapes = Path(shutil.copytree(database, tmp_path / "shapes"))
    (shapes / "ring" / "broken.off").write_text("OFF\n3 1 0\n")
    guide = (ROOT / "docs" / "using" / "learned-features.md").read_text(encoding="utf-8")
    (network,) = re.findall(r"```python\n(.*?)```", guide, re.DOTALL)
    names: dict = {}
    exec(compile(network, "learned-features.md", "exec"), names)
    example = runpy.run_path(str(ROOT / "examples" / "learned_features.py"))

    arrays = example["describe"](shapes, names["load_network"]())
    assert arrays["values"].shape == (16, 8 * 8 * 3)
    np.testing.assert_allclose(np.linalg.norm(arrays["values"], axis=1), 1, rtol=1e-5)
    shuffled = np.random.default_rng(0).permutation(16)
    file = tmp_path / "views.npz"
    np.savez(file, **{name: rows[shuffled] for name, rows in arrays.items()})

    report = shapeviz_report.build(shapes, tmp_path / "site", external=[file], cache=cache, **OPTIONS)
    assert [failure.path for failure in report.failures] == ["ring/broken.off"]
    own = report.features.values[:, report.features.slice_of("views")]
    row_of = dict(zip(arrays["shape_ids"].tolist(), arrays["values"], strict=True))
    np.testing.assert_allclose(own, [row_of[shape.id] for shape in report.shapes], rtol=1e-6)

    # what is alike in pictures is alike by the feature
    distances = np.linalg.norm(own[:, None] - own[None], axis=2)
    np.fill_diagonal(distances, np.inf)
    kinds = np.array([shape.id.split("/")[0] for shape in report.shapes])
    assert np.mean(kinds[distances.argmin(axis=1)] == kinds) > 0.8
