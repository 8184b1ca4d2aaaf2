"""The page of one shape as a reader uses it: from file://, with real features and real 3D."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from reports import make_report, with_external
from similar_cases import similar_cases

from shapeviz_report.features import PRESETS
from shapeviz_report.similarity import typical_distance
from shapeviz_report.site import write_site
from shapeviz_report.site.joiner import join

SIMILAR = Path(__file__).parent / "similar.js"


@pytest.mark.parametrize("preset", PRESETS)
def test_similar_shapes_are_those_of_python(preset, browser, tmp_path):
    report = with_external(make_report(["ant", "bird"], 9, features=("Gc", "Sc", "PFH")))
    report = replace(report, parameters={**report.parameters, "preset": preset})
    write_site(report, tmp_path / "site")
    page = browser.new_page()
    page.goto(f"{(tmp_path / 'site').as_uri()}/about.html")
    page.evaluate(join(SIMILAR))
    cases = similar_cases(report)
    answers = page.evaluate("(cases) => similar.answer(cases)", cases)
    page.close()
    for case, answer in zip(cases, answers, strict=True):
        expected = sorted(case["found"], key=lambda found: found["row"])
        found = sorted(answer["found"], key=lambda found: found["row"])
        assert [other["row"] for other in found] == [other["row"] for other in expected]
        distances = [other["distance"] for other in answer["found"]]
        assert distances == sorted(distances)
        # The site has the values in 65 536 steps.
        near = {"rel": 1e-4, "abs": 1e-4}
        assert [other["distance"] for other in found] == pytest.approx(
            [other["distance"] for other in expected], **near
        )
        closer, closer_expected = (
            np.array([other["closer"] for other in others]) for others in (found, expected)
        )
        # Two shapes that are equally far but for such a step may change places.
        assert np.abs(closer - closer_expected).max() <= 1.01 / (len(expected) - 1)
        assert answer["typical"] == pytest.approx(
            typical_distance(report.features, PRESETS[preset], features=case["features"], bins=case["bins"]),
            rel=1e-3,
        )
