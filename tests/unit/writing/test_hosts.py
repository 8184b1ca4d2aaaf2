"""What a site will weigh, and who would not take it."""

from __future__ import annotations

import pytest
from reports import make_report, with_exported, with_models

from shapeviz_report.config import Config
from shapeviz_report.pages.base import thumbnail_size
from shapeviz_report.writing import write_site
from shapeviz_report.writing.hosts import note, refusals, weigh


def test_a_small_site_goes_anywhere():
    assert note(280, Config()) is None
    assert note(2_000, Config(thumbnail_size=160, meshes=False)) is None


def test_what_is_too_much_is_named_with_its_limit():
    text = note(60_000, Config())
    assert "more than these hosts take: GitHub Pages (1.0 GB in all" in text
    assert "Cloudflare Pages (25 MiB a file, 20,000 files)" in text
    assert "Hugging Face (10,000 files a folder)" in text
    assert text.endswith("Of that, 3D models are 1.3 GB, which --no-meshes leaves out.")
    assert "--no-meshes" not in note(200_000, Config(meshes=False))


def test_less_is_written_of_more():
    assert weigh(1001, Config()).models < weigh(1000, Config()).models
    assert weigh(10_001, Config(meshes=False)).files < weigh(10_000, Config(meshes=False)).files / 5
    assert weigh(500, Config(thumbnail_size=160, meshes=False)).bytes < weigh(500, Config(meshes=False)).bytes
    assert refusals(weigh(1_000, Config(meshes=False))) == []


def test_a_hundred_thousand_shapes_without_models_fit_below_a_gigabyte():
    weight = weigh(100_000, Config(meshes=False))
    assert 800e6 < weight.bytes < 1e9
    assert weight.folder < 10_000
    assert weigh(100_000, Config(meshes=False, thumbnail_size=320)).bytes > 1e9
    assert "Hugging Face" not in note(100_000, Config(meshes=False))


def test_pictures_of_very_many_are_smaller_unless_one_says():
    assert [thumbnail_size(Config(), shapes) for shapes in (10_000, 10_001)] == [320, 192]
    assert thumbnail_size(Config(thumbnail_size=400), 100_000) == 400


def test_no_file_is_too_large_for_a_host():
    for shapes in (2_000, 5_000, 10_000, 12_000):
        assert not any("MiB a file" in said for said in refusals(weigh(shapes, Config())))


def test_files_are_counted_as_they_are_written(tmp_path):
    report = with_exported(with_models(make_report(["ant", "bird"], 30)))
    write_site(report, tmp_path)
    files = sum(path.is_file() for path in tmp_path.rglob("*"))
    assert weigh(60, Config(gltf="decimated")).files == pytest.approx(files, abs=180)
    assert len(list((tmp_path / "gltf").iterdir())) == 60


def test_files_of_gltf_are_weighed_with_their_values():
    plain = weigh(100, Config())
    few, all_ = (weigh(100, Config(gltf=kind)) for kind in ("decimated", "prepared"))
    assert plain.exported == 0
    assert few.bytes - plain.bytes == few.exported == 4_800_000
    assert all_.exported > 4 * few.exported
    assert few.files == plain.files + 100
    valued = weigh(100, Config(gltf="decimated", gltf_values="Agd,FPFH"))
    assert valued.exported == few.exported + 100 * 2000 * 4 * 34
    text = note(60_000, Config(meshes=False, gltf="prepared"))
    assert text.endswith("Files of glTF are 13.7 GB of it.")
