"""What others see of a site: descriptions, previews of links, linked data, the introduction."""

import io
import json
import re
from dataclasses import replace
from hashlib import sha256

import numpy as np
import pytest
from page_markup import Markup
from PIL import Image
from reports import NASTY_LABELS, make_report, with_exported
from rocrate.rocrate import ROCrate

from shapeviz_report.pages import PAGES
from shapeviz_report.types import Accent, Licence, Logo, Projection, Publication
from shapeviz_report.writing import write_site
from shapeviz_report.writing.markdown import first_paragraph, render_markdown
from shapeviz_report.writing.preview import draw_preview

URL = "https://example.org/shapes/"
LICENCE = Licence("CC BY 4.0: Attribution", "https://creativecommons.org/licenses/by/4.0/")
SAID = Publication(
    description="Vessels & tools.",
    introduction="# Vessels\n\nAll *vessels* of the\nmuseum.",
    logo=Logo(".svg", b'<svg xmlns="http://www.w3.org/2000/svg"/>'),
    accent=Accent("#112233", "#ddeeff"),
    licence=LICENCE,
    citation="N. N.: Vessels.",
    creator="Museum </script>",
    url=URL,
)


@pytest.fixture(scope="module")
def report():
    return replace(make_report(["ant", "bird"], 4), publication=SAID)


@pytest.fixture(scope="module")
def site(report, tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    write_site(report, folder)
    return folder


def page(folder, file="index.html"):
    return Markup((folder / file).read_text(encoding="utf-8"))


def metas(markup):
    pairs = [
        (a.get("name") or a.get("property"), a.get("content")) for tag, a in markup.tags if tag == "meta"
    ]
    return {name: content for name, content in pairs if name}


def linked(folder):
    (text,) = [t for a, t in page(folder).texts("script") if a.get("type") == "application/ld+json"]
    return json.loads(text)


def test_every_page_describes_itself_for_previews_of_links(site):
    for each in PAGES:
        markup = page(site, each.file)
        known = metas(markup)
        address = URL + ("" if each.file == "index.html" else each.file)
        assert known["description"] == known["og:description"] == "Vessels & tools."
        assert known["og:title"].endswith("Test shapes")
        assert known["og:url"] == address
        assert known["og:image"] == f"{URL}preview.png"
        assert known["twitter:card"] == "summary_large_image"
        assert ("link", {"rel": "canonical", "href": address}) in markup.tags


def test_without_an_address_nothing_claims_one(tmp_path):
    write_site(make_report(["ant", "bird"], 4), tmp_path)
    known = metas(page(tmp_path))
    assert known["description"].startswith("8 3D shapes in 2 classes, ")
    assert not {"og:url", "og:image", "twitter:card"} & set(known)
    assert "http" not in (tmp_path / "shapes.html").read_text(encoding="utf-8").replace("http-equiv", "")


def test_the_database_is_a_schema_org_dataset(site):
    data = linked(site)
    assert (data["@type"], data["name"], data["url"]) == ("Dataset", "Test shapes", URL)
    assert data["license"] == LICENCE.url
    assert data["creator"] == {"name": "Museum </script>"}
    assert data["keywords"] == ["ant", "bird"]
    for download in data["distribution"]:
        assert (site / download["contentUrl"].removeprefix(URL)).is_file()


def test_every_shape_is_a_schema_org_model(site, report):
    catalogue = json.loads((site / "data" / "catalogue.jsonld").read_text(encoding="utf-8"))
    models = catalogue["hasPart"]
    assert [model["identifier"] for model in models] == [shape.id for shape in report.shapes]
    for model in models:
        assert model["@type"] == "3DModel"
        assert model["license"] == LICENCE.url
        assert (site / model["image"].removeprefix(URL)).is_file()
        assert model["@id"].startswith(f"{URL}shape.html#id=class")


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_loaders_of_data_sets_read_the_tables(tmp_path):
    import mlcroissant

    report = make_report(["ant", None], 3, metadata={"Height, in m": "1.5", "__proto__": "</script>"})
    report = replace(report, parameters={**report.parameters, "parquet": True})
    write_site(report, tmp_path)
    loaded = mlcroissant.Dataset(tmp_path / "data" / "croissant.json")
    assert not loaded.metadata.ctx.issues.errors
    rows = list(loaded.records("shapes"))
    assert [row["shapes/id"].decode() for row in rows] == [shape.id for shape in report.shapes]
    for row, facts, label in zip(rows, report.facts, report.labels, strict=True):
        assert row["shapes/faces"] == facts.faces
        assert row["shapes/deviation"] == pytest.approx(facts.deviation)
        assert (row["shapes/class"] or b"").decode() == (label or "")
        assert b"</script>" in row.values()
    tables = {file.name: file.sha256 for file in loaded.metadata.file_objects}
    assert {"shapes.parquet", "features.parquet"} <= tables.keys()
    for name, found in tables.items():
        assert sha256((tmp_path / "data" / name).read_bytes()).hexdigest() == found
    places = list(loaded.records("projection-tsne"))
    for axis, letter in enumerate("xy"):
        found = [row[f"projection-tsne/{letter}"] for row in places]
        assert found == pytest.approx(report.projections["tsne"][0].xy[:, axis].tolist())


@pytest.mark.slow
def test_archives_read_the_site_as_a_crate(tmp_path):
    report = with_exported(
        replace(make_report(["ant", None], 3), publication=replace(SAID, date="2026-11-30"))
    )
    site = tmp_path / "site"
    write_site(report, site)
    crate = ROCrate(site)
    root = crate.root_dataset
    assert crate.version == "1.2"
    assert root["name"] == report.database.name
    assert root["datePublished"].startswith("2026-11-30")
    assert root["license"]["name"] == LICENCE.text
    assert root["license"].id == LICENCE.url
    assert root["author"]["name"] == SAID.creator
    assert not json_misfits(site / "ro-crate-metadata.json")
    parts = {part.id: part for part in root["hasPart"]}
    there = {path.relative_to(site).as_posix() for path in site.rglob("*") if path.is_file()}
    folders = tuple(name for name in parts if name.endswith("/"))
    assert "gltf/" in folders
    told = {name for name in there if not name.startswith(folders)}
    assert told == parts.keys() - {*folders} | {"ro-crate-metadata.json", "data/files.json"}
    for name, part in parts.items():
        if name in folders or name in ("about.html", "data/summary.json"):
            assert "sha256" not in part.properties()
            continue
        content = (site / name).read_bytes()
        assert part["contentSize"] == str(len(content))
        assert part["sha256"] == sha256(content).hexdigest()
    write_site(replace(report, seconds={"read": 99.0}), tmp_path / "again")
    crates = [(folder / "ro-crate-metadata.json").read_bytes() for folder in (site, tmp_path / "again")]
    assert crates[0] == crates[1]
    write_site(report, site)
    assert (site / "ro-crate-metadata.json").read_bytes() == crates[0], "a rebuild replaces it"


def json_misfits(path):
    """References of a crate that lead to none of its entities, and entities without what each must have."""
    graph = json.loads(path.read_text())["@graph"]
    ids = [entity["@id"] for entity in graph]
    assert len(set(ids)) == len(ids)
    references = [
        value["@id"]
        for entity in graph
        for values in entity.values()
        for value in (values if isinstance(values, list) else [values])
        if isinstance(value, dict)
    ]
    return [
        *(one for one in references if one not in ids and one != "https://w3id.org/ro/crate/1.2"),
        *(entity for entity in graph if not {"@id", "@type"} <= entity.keys()),
    ]


@pytest.mark.parametrize("said", [{"date": None}, {"licence": None}])
def test_what_lacks_a_date_or_a_licence_is_no_crate(tmp_path, said):
    publication = replace(SAID, **{"date": "2026-11-30", **said})
    write_site(replace(make_report(["ant"], 3), publication=publication), tmp_path)
    assert not (tmp_path / "ro-crate-metadata.json").exists()


def test_without_an_address_the_catalogue_is_relative_to_its_folder(tmp_path):
    write_site(make_report(["ant"], 3, metadata={"Licence": "CC0", "author": "A. B."}), tmp_path)
    text = (tmp_path / "data" / "catalogue.jsonld").read_text(encoding="utf-8")
    model = json.loads(text)["hasPart"][0]
    assert (tmp_path / "data" / model["image"]).resolve().is_file()
    assert model["license"] == "https://creativecommons.org/publicdomain/zero/1.0/"
    assert model["creator"] == {"name": "A. B."}


def test_linked_data_is_never_markup(tmp_path):
    nasty = "</script><script>alert(1)</script>"
    write_site(make_report(NASTY_LABELS, 2, name=nasty), tmp_path)
    assert linked(tmp_path)["name"] == nasty
    assert "<script>" not in (tmp_path / "index.html").read_text(encoding="utf-8")


def test_the_preview_is_a_picture_of_the_map(report):
    picture = Image.open(io.BytesIO(draw_preview(report)))
    assert (picture.format, picture.size) == ("PNG", (1200, 630))
    pixels = np.asarray(picture.convert("RGB"), dtype=int)
    drawn = np.abs(pixels - pixels[0, 0]).max(axis=2) > 40
    assert 0.02 < drawn.mean() < 0.9
    assert not drawn[:4].any()
    assert draw_preview(report) == draw_preview(report)


@pytest.mark.parametrize("places", [[[0, 0]], [[0.5, -0.5]] * 5])
def test_shapes_at_one_place_have_a_preview(places):
    report = make_report(["ant"], len(places))
    projection = Projection("tsne", (), 0, np.array(places, dtype=float))
    report = replace(report, projections={"tsne": (projection, report.projections["tsne"][1])})
    assert draw_preview(report)[:4] == b"\x89PNG"


def test_the_accent_has_the_last_word_in_the_style(site):
    rules = (site / "assets" / "style.css").read_text(encoding="utf-8")
    assert re.findall(r"--accent: (.+);", rules)[-1] == "light-dark(#112233, #ddeeff)"


def test_the_logo_is_a_file_of_the_site(site):
    sources = [a["src"] for tag, a in page(site).tags if tag == "img"]
    assert [source.partition("?")[0] for source in sources] == ["assets/logo.svg"]
    assert (site / "assets" / "logo.svg").read_bytes() == SAID.logo.content


def test_the_about_page_says_how_to_use_and_to_cite(site):
    text = (site / "about.html").read_text(encoding="utf-8")
    assert f'<a href="{LICENCE.url}" rel="license"' in text
    assert "N. N.: Vessels." in text
    assert "@misc{test-shapes," in text
    assert "Museum &lt;/script&gt;" in text


def test_the_about_page_says_that_no_licence_is_known(tmp_path):
    write_site(make_report(["ant"], 3), tmp_path)
    assert "none is named" in (tmp_path / "about.html").read_text(encoding="utf-8")


def test_markdown_is_never_markup_of_its_author():
    text = "# A\n\n<b onclick=x>b</b> [c](javascript:alert(1)) ![d](https://a.org/d.png)\n\n|e|\n|:-:|\n|f|\n"
    markup = Markup(render_markdown(text))
    assert {tag for tag, _ in markup.tags} == {"h2", "p", "a", "table", "thead", "tbody", "tr", "th", "td"}
    assert [a for _, a in markup.tags if a] == [{"href": "https://a.org/d.png"}]


def test_headings_begin_below_the_title_of_the_page():
    html = render_markdown("# A\n\n## B\n\n###### F")
    assert re.findall(r"<(h\d)>", html) == ["h2", "h3", "h6"]
    # A text whose first headings are of the second level skips none either.
    assert "<h2>B</h2>" in render_markdown("## B\n\n### C")
    assert "<h4>C</h4>" in render_markdown("## B\n\n### C", 3)


def test_the_first_paragraph_is_its_words():
    assert first_paragraph("# Title\n\nSome *words*\nand `code`.\n\nMore.") == "Some words and code."
    assert first_paragraph("- only\n- a list") == ""
