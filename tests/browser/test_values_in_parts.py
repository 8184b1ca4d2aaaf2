"""A site whose values come in parts says what one says that holds them all, to a step."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from reports import make_report
from waiting import drawn_again, eventually

from shapeviz_report.pages import base, workbench
from shapeviz_report.pages.base import class_codes
from shapeviz_report.pages.sampling import sample_rows
from shapeviz_report.presets import PRESETS
from shapeviz_report.similarity import rank_similar
from shapeviz_report.writing import write_site

CLASSES = ("ant", "bird", "cup")
SHAPE = 57
SAMPLED = 30


@pytest.fixture(scope="module")
def report():
    return make_report(CLASSES, 40, features=("Gc", "Agd", "Sc"))


@pytest.fixture(scope="module")
def sites(report, tmp_path_factory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("parts")
    with pytest.MonkeyPatch.context() as patch:
        write_site(report, folder / "whole")
        patch.setattr(base, "MOST_IN_FULL", 50)
        patch.setattr(workbench, "sample_rows", partial(sample_rows, most=SAMPLED))
        write_site(report, folder / "parts")
    return {name: folder / name for name in ("whole", "parts")}


@pytest.fixture
def both(open_page, sites):
    """Open a page of both sites."""

    def open_(file):
        return {name: open_page(name, address=f"{site.as_uri()}/{file}") for name, site in sites.items()}

    return open_


def figures(text: str) -> list[float]:
    return [float(found) for found in re.findall(r"\d+(?:\.\d+)?", text)]


def featured(page):
    page.locator("#by-features").scroll_into_view_if_needed()
    eventually(page, lambda: page.locator("#by-features[aria-busy]").count() == 0)
    drawn_again(page)
    return page


def similar(page) -> list[str]:
    return page.locator(".similar .name").all_inner_texts()


def named(report, **choice) -> list[str]:
    found = rank_similar(
        report.features, PRESETS["default"], report.features.values[SHAPE], member=SHAPE, count=12, **choice
    )
    return [report.shapes[shape.row].name for shape in found]


def agreed(found: list[str], expected: list[str]) -> bool:
    """Whether two lists of similar shapes are the same but for one: rows of noise are nearly equally far."""
    return len(set(found) & set(expected)) >= len(expected) - 1 and found[0] == expected[0]


def test_similar_shapes_are_found_under_any_choice(both, report):
    page = featured(both(f"shape.html#id={report.shapes[SHAPE].id}")["parts"])
    assert agreed(similar(page), named(report))
    assert "approximation" in page.locator("#similar-words").inner_text()
    for chosen in (["Sc"], ["Gc", "Sc"]):
        page.locator(".compared", has_text=chosen[-1] if len(chosen) == 1 else chosen[0]).last.click()
        eventually(page, lambda chosen=chosen: agreed(similar(page), named(report, features=chosen)))


def test_histograms_say_what_the_values_are(both, report):
    said = {}
    for name, page in both(f"shape.html#id={report.shapes[SHAPE].id}&parts=Sc[1]").items():
        bars = featured(page).locator(".of-bin-button")
        said[name] = [
            figures(label.partition(": ")[2])
            for label in bars.evaluate_all("(bars) => bars.map((bar) => bar.getAttribute('aria-label'))")
        ]
    assert len(said["whole"]) == 30
    for own, other in zip(said["parts"], said["whole"], strict=True):
        # The shape itself, half of its class and half of all: in cells of four steps.
        assert own == pytest.approx(other, abs=1.1)


@pytest.mark.parametrize("other", ["class:cup", "rest"], ids=["one by one", "counted"])
def test_two_groups_are_told_apart_alike(both, other):
    told = {}
    for name, page in both(f"compare.html#a=class:ant&b={other}").items():
        page.wait_for_selector("#result:not([hidden])", state="attached")
        told[name] = [
            page.locator("#answer h2").inner_text(),
            page.locator("#apart-bins .bin-chip").evaluate_all(
                "(chips) => chips.map(({ dataset }) => dataset.column)"
            ),
            figures(page.locator("#feature-rows").inner_text()),
        ]
    assert told["parts"][:2] == told["whole"][:2]
    assert told["parts"][2] == pytest.approx(told["whole"][2], abs=1)


def test_classes_are_compared_without_reading_their_columns(both):
    page = both("compare.html#a=class:ant&b=rest")["parts"]
    page.wait_for_selector("#result:not([hidden])", state="attached")
    asked = [
        address.rpartition("/")[2].partition("-")[0]
        for address in page.watch.requests
        if "/chunks/" in address
    ]
    assert asked.count("classes") == 2
    assert "columns" not in asked
    assert "sample" not in page.locator("#answer").inner_text()


def test_all_shapes_but_a_few_are_compared_by_all_of_them(both, report):
    few = "&".join(f"a-select={report.shapes[row].id}" for row in (3, SHAPE))
    page = both(f"compare.html#a=shapes&{few}&b=rest")["parts"]
    page.wait_for_selector("#result:not([hidden])", state="attached")
    assert "sample" not in page.locator("#answer").inner_text()


def test_what_sets_outliers_apart_is_told(both):
    reasons = {}
    for name, page in both("compare.html#view=outliers").items():
        eventually(page, lambda page=page: page.locator(".outlier .reasons:empty").count() == 0)
        reasons[name] = page.locator(".outlier").first.locator(".reason bdi").all_inner_texts()
    assert reasons["parts"] == reasons["whole"]


def test_how_much_of_a_bin_a_shape_has_is_told_of_each(both, report):
    shape = next(row for row in range(120) if row not in sample_rows(class_codes(report), SAMPLED))
    told = {}
    for name, page in both(f"bins.html#bin=Sc[1]:4&id={report.shapes[shape].id}").items():
        line = page.locator("#turn-name")
        eventually(page, lambda line=line: "in the bin" in line.inner_text())
        told[name] = figures(line.inner_text().partition("in the bin")[0])
        assert report.shapes[shape].name in line.inner_text()
    assert told["parts"] == pytest.approx(told["whole"], abs=0.5)


def test_a_map_is_coloured_by_a_bin_of_all_shapes(both):
    colours = {}
    for name, page in both("index.html#color=bin:Sc[1]:4").items():
        legend = page.locator("#color-legend")
        eventually(page, lambda legend=legend: "%" in legend.inner_text())
        colours[name] = figures(legend.inner_text())
    assert len(colours["whole"]) > 1
    assert np.allclose(colours["parts"], colours["whole"], atol=0.5)


def test_nothing_is_read_but_what_is_shown(both, report):
    page = featured(both(f"shape.html#id={report.shapes[SHAPE].id}")["parts"])
    asked = {
        address.rpartition("/")[2].partition("-")[0]
        for address in page.watch.requests
        if "/chunks/" in address
    }
    assert {"rows", "components", "classes"} <= asked
    assert not {"columns", "bins"} & asked


@pytest.mark.parametrize("file", ["index.html", "workbench.html", "bins.html"])
def test_no_script_that_handed_data_over_is_kept(both, file):
    for page in both(file).values():
        kept = page.evaluate("() => [...document.scripts].map((script) => script.src)")
        assert any("/assets/shared.js" in address for address in kept)
        assert not any("chunk" in address for address in kept)


def test_a_file_that_would_be_too_large_is_cut_and_read_as_one(open_page, sites, report, tmp_path):
    size = 2 * report.features.values.size
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(workbench, "BYTES_A_PART", 999)
        write_site(report, tmp_path)
    said = {}
    for site in (sites["whole"], tmp_path):
        page = featured(
            open_page(
                site.name, address=f"{site.as_uri()}/shape.html#id={report.shapes[SHAPE].id}&parts=Sc[1]"
            )
        )
        bars = page.locator(".of-bin-button")
        said[site] = bars.evaluate_all("(bars) => bars.map((bar) => bar.getAttribute('aria-label'))")
        assert agreed(similar(page), named(report))
    assert said[tmp_path] == said[sites["whole"]]
    page = open_page("cut", address=f"{tmp_path.as_uri()}/workbench.html")
    asked = [address for address in page.watch.requests if "/chunks/bins-" in address]
    assert len(asked) == -(-size // 999) > 3
