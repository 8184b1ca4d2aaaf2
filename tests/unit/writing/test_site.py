"""The site as files: what is there, what is refused, and that equal input gives equal bytes."""

import dataclasses
import gzip
import re
from functools import cache

import numpy as np
import pytest
from packed_chunks import read_script, texts_of
from packed_models import unpack
from page_markup import Markup
from reports import NASTY_LABELS, make_report, with_bin_search, with_models, with_paintings, with_scores

from shapeviz_report.errors import SiteError
from shapeviz_report.pages.base import NO_SHARE, SHARE_STEPS, texts_chunk
from shapeviz_report.pages.workbench import WorkbenchPage
from shapeviz_report.types import Failure, Projection
from shapeviz_report.writing import check_destination, write_site


def contents(folder) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def chunk(folder, name):
    found, content = read_script(folder / "assets" / f"chunk-{name}.js")
    assert found == name
    return content


@cache
def whole_report():
    """A report with all parts that may be missing."""
    return with_models(with_paintings(with_bin_search(with_scores(make_report()))))


def test_a_site_has_its_pages_pictures_and_data(tmp_path):
    write_site(make_report(), tmp_path / "site")
    files = set(contents(tmp_path / "site"))
    assert {"index.html", "about.html", "data/summary.json", "data/shapes.csv", "data/features.npz"} <= files
    assert {"data/projection-tsne.csv", "data/projection-umap.csv", "data/projection-pca.csv"} <= files
    assert len([name for name in files if re.fullmatch(r"thumbnails/[0-9a-f]+\.webp", name)]) == 24


def test_pages_refer_only_to_files_of_the_site(tmp_path):
    write_site(make_report(), tmp_path)
    files = set(contents(tmp_path))
    for page in ("index.html", "about.html"):
        markup = Markup((tmp_path / page).read_text(encoding="utf-8"))
        references = [value for _, a in markup.tags for key, value in a.items() if key in ("src", "href")]
        assert references
        for reference in references:
            assert reference.startswith("#") or reference.split("?")[0] in files


def test_a_chunk_holds_the_maps(tmp_path):
    report = make_report(["ant", None, "bird"], 5)
    write_site(report, tmp_path)
    data = chunk(tmp_path, "overview")
    assert data["classes"] == ["ant", "bird"]
    assert data["shapes"]["groups"].tolist() == [0] * 5 + [-1] * 5 + [1] * 5
    assert texts_of(data["shapes"]["ids"]) == [shape.id for shape in report.shapes]
    assert [method["key"] for method in data["methods"]] == ["tsne", "umap", "pca"]
    projection, quality = report.projections["tsne"]
    np.testing.assert_allclose(data["methods"][0]["x"], projection.xy[:, 0], atol=1e-6)
    hits = data["methods"][0]["hit"]
    assert (hits[5:10] == NO_SHARE).all()
    np.testing.assert_allclose(hits[:5] / SHARE_STEPS, quality.nh[:5], atol=1e-9)
    assert data["methods"][0]["hitOfAll"] == quality.nh_s
    for picture in data["shapes"]["pictures"]:
        assert (tmp_path / "thumbnails" / picture).is_file()


def test_a_chunk_of_bytes_keeps_them(tmp_path):
    report = make_report()
    write_site(report, tmp_path)
    [part] = WorkbenchPage().content(report).parts["bins"]
    assert read_script(tmp_path / "chunks" / "bins-0.js") == ("bins-0", part)


def test_a_model_is_a_script_of_its_own(tmp_path):
    report = with_models(make_report())
    write_site(report, tmp_path)
    for name, model in zip(chunk(tmp_path, "selection")["models"], report.models, strict=True):
        assert re.fullmatch("[0-9a-f]{20}", name)
        script = tmp_path / "models" / f"{name}.js"
        assert read_script(script) == (f"model-{name}", gzip.decompress(model))
    _, vertices, _, bins = unpack(gzip.decompress(report.models[0]))
    assert bins.shape == (len(report.edges), len(vertices))


@pytest.mark.slow
def test_without_models_nothing_else_changes(tmp_path):
    report = with_paintings(with_bin_search(make_report()))
    write_site(with_models(report), tmp_path / "with")
    write_site(report, tmp_path / "without")
    rest = {name for name in contents(tmp_path / "with") if not name.startswith("models/")}
    assert rest == set(contents(tmp_path / "without"))
    assert chunk(tmp_path / "without", "selection")["models"] is None


def test_the_worker_travels_as_text(tmp_path):
    write_site(make_report(), tmp_path)
    engine = chunk(tmp_path, "engine")
    assert "onmessage" in engine
    assert not re.search(r"^(import|export)\b", engine, re.MULTILINE)


@pytest.mark.slow
def test_equal_input_gives_equal_bytes_but_for_the_times(tmp_path):
    report = whole_report()
    write_site(report, tmp_path / "one")
    write_site(dataclasses.replace(report, seconds={"read": 9.0}), tmp_path / "two")
    one, two = contents(tmp_path / "one"), contents(tmp_path / "two")
    assert set(one) == set(two)
    assert {name for name in one if one[name] != two[name]} == {
        "about.html",
        "data/summary.json",
        "data/files.json",
    }


@pytest.mark.slow
def test_text_from_the_database_is_never_markup(tmp_path):
    nasty = '</title></script><script>alert(1)</script><img src=x onerror="alert(2)">'
    report = make_report(
        NASTY_LABELS, 2, name=nasty, failures=[Failure(nasty, nasty, nasty)], metadata={nasty: nasty}
    )
    report = dataclasses.replace(
        report, parameters={**report.parameters, nasty: nasty}, versions={nasty: nasty}
    )
    write_site(report, tmp_path)
    for page in ("index.html", "about.html"):
        text = (tmp_path / page).read_text(encoding="utf-8")
        tags = Markup(text).tags
        assert "<script>" not in text
        assert not [tag for tag, _ in tags if tag == "img"]
        assert not [a for _, a in tags if any(key.startswith("on") for key in a)]
        assert all("src" in a or a["type"] == "application/ld+json" for tag, a in tags if tag == "script")


def test_texts_of_shapes_are_what_they_were():
    texts = ["cups/1", "", "M\u00fcnze \u6771\u4eac", "\U0001f600", "a\nb", ""]
    assert texts_of(texts_chunk(texts)) == texts
    assert texts_of(texts_chunk([])) == []


def test_a_file_name_that_is_no_text_does_not_stop_the_site(tmp_path):
    report = make_report(["ant"], 1)
    strange = dataclasses.replace(report.shapes[0], name="\udcff bad name")
    report = dataclasses.replace(
        report,
        shapes=(strange,),
        database=dataclasses.replace(report.database, name="db \udcff", shapes=(strange,)),
    )
    write_site(report, tmp_path)
    assert "db \\udcff" in (tmp_path / "index.html").read_text(encoding="utf-8")
    assert texts_of(chunk(tmp_path, "overview")["shapes"]["names"]) == ["\ufffd bad name"]


def test_every_page_forbids_all_requests_elsewhere(tmp_path):
    write_site(make_report(), tmp_path)
    for page in ("index.html", "about.html"):
        tags = Markup((tmp_path / page).read_text(encoding="utf-8")).tags
        policy = next(a["content"] for tag, a in tags if a.get("http-equiv") == "Content-Security-Policy")
        directives = dict(part.split(" ", 1) for part in policy.split("; "))
        assert directives["default-src"] == "'none'"
        assert directives["script-src"] == "'self' file:"
        assert directives["style-src"] == "'self' file:"
        assert "unsafe" not in policy
        assert "http" not in policy


@pytest.mark.slow
def test_a_site_replaces_an_earlier_site(tmp_path):
    destination = tmp_path / "site"
    write_site(make_report(["ant"], 3), destination)
    write_site(make_report(["bird", "cup"], 3), destination)
    assert chunk(destination, "overview")["classes"] == ["bird", "cup"]


def test_other_folders_are_not_replaced(tmp_path):
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(SiteError, match="would be replaced"):
        write_site(make_report(), tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_data_of_another_program_is_no_site(tmp_path):
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "summary.json").write_text('{"generator": "other"}')
    with pytest.raises(SiteError, match="would be replaced"):
        check_destination(tmp_path)


def test_a_file_is_no_place_for_a_site(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(SiteError, match="is a file"):
        check_destination(tmp_path / "file")
    with pytest.raises(SiteError, match="not a folder"):
        check_destination(tmp_path / "file" / "site")


def test_an_empty_or_missing_folder_is_welcome(tmp_path):
    check_destination(tmp_path)
    check_destination(tmp_path / "a" / "b")


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (lambda r: {"labels": r.labels[1:]}, "labels do not match"),
        (lambda r: {"thumbnails": (b"GIF89a", *r.thumbnails[1:])}, "thumbnail is not a WebP"),
        (lambda r: {"models": r.models[1:]}, "models do not match"),
        (
            lambda r: {"paintings": (dataclasses.replace(r.paintings[0], inside=b"GIF89a"),)},
            "painting is not a WebP",
        ),
        (
            lambda r: {"paintings": (dataclasses.replace(r.paintings[0], shape=24),)},
            "a shape that is not there",
        ),
        (
            lambda r: {"paintings": (dataclasses.replace(r.paintings[0], column="Gc:11"),)},
            "a bin that is not there",
        ),
        (lambda r: {"shapes": r.shapes[::-1]}, "not sorted"),
        (lambda r: {"shapes": ()}, "no shape"),
        (lambda r: {"projections": {}}, "no projection"),
        (lambda r: {"edges": r.edges[1:]}, "edges do not match"),
        (
            lambda r: {"scores": dataclasses.replace(r.scores, classes=("ant", "bee", "cup"))},
            "scores do not match",
        ),
        (lambda r: {"scores": dataclasses.replace(r.scores, values=r.scores.values + 1)}, r"not in \[0, 1\]"),
        (
            lambda r: {
                "projections": {
                    "tsne": (Projection("tsne", (), 0, np.full((24, 2), np.nan)), r.projections["tsne"][1])
                }
            },
            "not finite",
        ),
    ],
)
def test_parts_that_do_not_fit_are_a_bug_of_the_caller(change, complaint):
    report = whole_report()
    with pytest.raises(ValueError, match=complaint):
        dataclasses.replace(report, **change(report))
