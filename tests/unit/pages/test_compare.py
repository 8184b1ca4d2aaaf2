"""What the Compare page gives its scripts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from reports import make_report, with_bins, with_external

from shapeviz_report import neighbours
from shapeviz_report.neighbours import find_nearest
from shapeviz_report.pages.compare import ComparePage
from shapeviz_report.presets import PRESETS, scale

REPORT = make_report(["ant", "bird", "cup", None], 6, features=("Gc", "Sc", "Agd"))


def parts(report):
    """The neighbours by space, as the script reads them."""
    content = ComparePage().content(report)
    data = content.chunks["compare"]
    held = [
        np.frombuffer(part, "<u4").reshape(len(report.labels), data["k"])
        for part in content.parts["neighbours"]
    ]
    return data, dict(zip(data["spaces"], held, strict=True))


def test_neighbours_are_those_of_every_map_and_of_all_features():
    data, found = parts(REPORT)
    assert data["spaces"] == ["features", "tsne", "umap", "pca"]
    assert (found["features"] == find_nearest(scale(REPORT.features, PRESETS["default"]), data["k"])).all()
    assert (found["umap"] == find_nearest(REPORT.projections["umap"][0].xy, data["k"])).all()


def test_it_is_known_how_many_stand_for_a_class(monkeypatch):
    assert ComparePage().content(REPORT).context["standing"] is None
    monkeypatch.setattr(neighbours, "EXACT_LIMIT", 20)
    assert ComparePage().content(REPORT).context["standing"] == 4000 // 3
    monkeypatch.setattr(neighbours, "FITTED", 12)
    assert ComparePage().content(REPORT).context["standing"] == 10


def test_only_chosen_bins_count_where_the_maps_are_made_of_them():
    _, every = parts(REPORT)
    _, chosen = parts(with_bins(REPORT, ("Agd:3",)))
    assert (every["features"] != chosen["features"]).any()
    values = REPORT.features.values[:, REPORT.features.columns.index("Agd:3")]
    nearest = chosen["features"][:, 0]
    roots = np.sqrt(values)
    others = np.abs(roots[:, None] - roots) + np.diag(np.full(len(roots), np.inf))
    assert np.allclose(np.abs(roots - roots[nearest]), others.min(axis=1))


def test_fits_are_there_for_shapes_with_a_label():
    data, _ = parts(REPORT)
    known = [fit is not None for fit in data["fit"]]
    assert known == [label is not None for label in REPORT.labels]
    assert sorted(data["order"]) == [0, 1, 2]


def test_words_match_the_columns():
    report = with_external(REPORT)
    data, _ = parts(report)
    assert len(data["clauses"]) == len(report.features.columns)
    assert data["clauses"][-1] is None
    assert (
        data["clauses"][31] == "is on average 0.1 to 0.2 radii from all other points, walking on the surface"
    )
    assert data["whole"] == "the surface"
    assert len(data["weights"]) == len(report.features.blocks)
    # Every histogram that can be pictured has sides: one of Gc, two of Sc, one of Agd.
    assert [sides["start"] for sides in data["sides"]] == [0, 10, 20, 30]
    below, above = data["sides"][3]["below"], data["sides"][3]["above"]
    assert len(below) == len(above) == 9
    assert below[0]["clause"].startswith("is on average less than 0.1 radii from all other points")
    assert (above[8]["trend"], above[8]["fewer"]) == ("less surface lies near the middle", True)


def test_sentences_on_patches_that_nobody_can_picture_have_no_sides():
    data, _ = parts(make_report(["ant", "bird"], 6, features=("PFH", "FPFH")))
    assert data["sides"] == []


def test_the_order_of_the_shapes_has_no_say():
    turned = np.arange(len(REPORT.labels))[::-1]
    backwards = replace(
        REPORT,
        labels=tuple(REPORT.labels[row] for row in turned),
        features=replace(REPORT.features, values=REPORT.features.values[turned]),
        projections={
            name: (replace(projection, xy=projection.xy[turned]), hits)
            for name, (projection, hits) in REPORT.projections.items()
        },
    )
    assert parts(backwards)[0]["fit"] == parts(REPORT)[0]["fit"][::-1]


def test_one_shape_has_no_neighbours():
    data, _ = parts(make_report(["ant"], 1))
    assert data["k"] == 0
    assert data["fit"] == [None]
