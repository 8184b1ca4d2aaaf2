"""A site without labels works with clusters, and every page says so; a site with labels has them beside."""

from __future__ import annotations

import csv
import json
from dataclasses import replace

import pytest
from reports import make_report, with_clusters, with_scores, with_search

from shapeviz_report.pages import PAGES
from shapeviz_report.pages.base import clusters_chunk
from shapeviz_report.writing import write_site

NOTICE = '<p class="stand-in" role="note">'


@pytest.fixture(scope="module")
def unlabelled(tmp_path_factory):
    """A site whose shapes have no labels and names like markup, and its report."""
    plain = make_report([None] * 3, 8, features=("Gc", "Sc"))
    shapes = tuple(replace(shape, name=f"<b>{index}") for index, shape in enumerate(plain.shapes))
    plain = replace(plain, shapes=shapes, database=replace(plain.database, shapes=shapes))
    report = with_scores(with_search(with_clusters(plain)))
    site = tmp_path_factory.mktemp("site")
    write_site(report, site)
    return site, report


@pytest.mark.slow
def test_every_page_says_that_clusters_stand_in(unlabelled) -> None:
    site, report = unlabelled
    for page in PAGES:
        text = (site / page.file).read_text(encoding="utf-8")
        assert text.count(NOTICE) == 1, page.name
        assert 'href="about.html#clusters"' in text
        assert f"24 shapes in {len(report.clusters.clusters)} clusters" in text


def test_the_about_page_tells_of_every_cluster(unlabelled) -> None:
    site, report = unlabelled
    text = (site / "about.html").read_text(encoding="utf-8")
    assert '<h2 id="clusters">' in text
    for cluster in report.clusters.clusters:
        assert f"<bdi>like &lt;b&gt;{report.shapes[cluster.central].name[3:]}</bdi>" in text
        assert cluster.typical
    assert "higher than for any classes that people would name" in text


def test_the_data_name_them(unlabelled) -> None:
    site, report = unlabelled
    names = [report.clusters.clusters[code].name for code in report.clusters.of]
    with open(site / "data" / "shapes.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["cluster"] for row in rows] == [row["class"] for row in rows] == names
    summary = json.loads((site / "data" / "summary.json").read_text(encoding="utf-8"))
    assert summary["labeling"] == "clusters"
    assert summary["labelings"] == [], "what the database has"
    assert summary["clusters"]["stand_in"] is True
    for told, cluster in zip(summary["clusters"]["clusters"], report.clusters.clusters, strict=True):
        assert told["name"] == cluster.name
        assert told["central"] == report.shapes[cluster.central].id
        assert told["shapes"] == names.count(cluster.name)


def test_all_that_needs_labels_has_them(unlabelled) -> None:
    _, report = unlabelled
    names = tuple(sorted(cluster.name for cluster in report.clusters.clusters))
    assert report.scores.classes == report.search.classes == names
    assert report.search.effects


@pytest.mark.slow
def test_a_labelled_site_has_clusters_beside_its_classes(tmp_path) -> None:
    report = with_clusters(make_report(["ant", "bird", None], 8))
    write_site(report, tmp_path)
    assert NOTICE not in (tmp_path / "index.html").read_text(encoding="utf-8")
    assert '<h2 id="clusters">' in (tmp_path / "about.html").read_text(encoding="utf-8")
    with open(tmp_path / "data" / "shapes.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["class"] for row in rows] == ["ant"] * 8 + ["bird"] * 8 + [""] * 8
    assert all(row["cluster"].startswith("like ") for row in rows)


def test_the_chunk_is_what_pages_group_by() -> None:
    report = with_clusters(make_report(["ant", "bird", "cup"], 8))
    chunk = clusters_chunk(report)
    assert chunk["standIn"] is False
    assert [cluster["size"] for cluster in chunk["clusters"]] == [
        (chunk["of"] == code).sum() for code in range(len(chunk["clusters"]))
    ]
    assert all(chunk["of"][cluster["central"]] == code for code, cluster in enumerate(chunk["clusters"]))
    assert clusters_chunk(make_report(["ant"], 5)) is None


def test_clusters_that_do_not_fit_are_an_error_of_the_caller() -> None:
    report = with_clusters(make_report([None] * 3, 8))
    with pytest.raises(ValueError, match="labels are not the clusters"):
        replace(report, labels=tuple(reversed(report.labels)))
    with pytest.raises(ValueError, match="clusters do not match the shapes"):
        replace(report, clusters=replace(report.clusters, of=report.clusters.of[1:]))
