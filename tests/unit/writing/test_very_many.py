"""What a site of very many shapes leaves out, and where what it holds is."""

from __future__ import annotations

import json
import shutil

import numpy as np
import pytest
from packed_chunks import read_script
from reports import make_report, multiplied

from shapeviz_report.errors import SiteError
from shapeviz_report.pages.base import MOST_IN_FULL, class_codes
from shapeviz_report.writing import write_site
from shapeviz_report.writing.data import read_site
from shapeviz_report.writing.feature_files import write_feature_file

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def report():
    report = multiplied(make_report(["cup", None, "ant"], 2, methods=("tsne",), features=("Gc",)), 2000)
    assert len(report.shapes) > MOST_IN_FULL
    return report


@pytest.fixture(scope="module")
def site(report, tmp_path_factory):
    folder = tmp_path_factory.mktemp("many") / "site"
    write_site(report, folder)
    return folder


def parts(site, name):
    """The parts of a chunk in their order."""
    count = len(list((site / "chunks").glob(f"{name}-*.js")))
    found = [read_script(site / "chunks" / f"{name}-{number}.js") for number in range(count)]
    assert [part for part, _ in found] == [f"{name}-{number}" for number in range(count)]
    return [content for _, content in found]


def overview(site):
    return read_script(site / "assets" / "chunk-overview.js")[1]


def test_pictures_come_in_parts_only_class_by_class(site, report):
    held = [
        part["content"][start:end].tobytes()
        for part in parts(site, "pictures")
        for start, end in zip([0, *part["ends"][:-1].tolist()], part["ends"].tolist())
    ]
    order = np.argsort(class_codes(report), kind="stable")
    assert held == [report.thumbnails[row] for row in order]
    assert overview(site)["shapes"]["pictures"] is None
    assert not (site / "thumbnails").exists()


def test_every_part_but_the_last_is_of_as_many_shapes(site, report):
    size = overview(site)["partSizes"]["details"]
    held = parts(site, "details")
    assert {len(part) for part in held[:-1]} == {size}
    told = [details for part in held for details in part]
    assert [details["facesRead"] for details in told] == [facts.faces_read for facts in report.facts]
    assert told[7]["related"] == report.related[7].tolist()


def test_the_catalogue_is_of_the_database_alone(site, report):
    catalogue = json.loads((site / "data" / "catalogue.jsonld").read_text(encoding="utf-8"))
    assert catalogue["@type"] == "Dataset"
    assert "hasPart" not in catalogue


def test_it_holds_no_features_and_says_how_to_get_them(site):
    assert not [*site.glob("data/features*")]
    about = (site / "about.html").read_text(encoding="utf-8")
    assert "shapeviz-report describe DATABASE -o features.npz" in about
    catalogue = json.loads((site / "data" / "catalogue.jsonld").read_text(encoding="utf-8"))
    offered = {download["contentUrl"].rpartition("/")[2] for download in catalogue["distribution"]}
    assert offered <= {path.name for path in (site / "data").iterdir()}
    with pytest.raises(SiteError, match=r"describe DATABASE -o \S+features\.npz"):
        read_site(site)


def test_features_that_its_owner_puts_there_are_read(site, report, tmp_path):
    copy = shutil.copytree(site / "data", tmp_path / "data").parent
    table = report.features
    write_feature_file(copy / "data" / "features.npz", report.database, report.shapes, table, report.edges)
    with pytest.raises(SiteError, match="has other features than this version measures"):
        read_site(copy)  # whole, if not of real features
