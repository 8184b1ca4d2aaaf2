"""Which shapes maps of very many show as pictures."""

from __future__ import annotations

import io

import numpy as np
import pytest
from packed_chunks import read_script
from PIL import Image
from reports import make_report

from shapeviz_report.pages import base
from shapeviz_report.pages.map_pictures import ACROSS, choose_pictures, map_pictures, sheet_name
from shapeviz_report.writing import write_site
from shapeviz_report.writing.sheets import SIDE, draw_sheet

GRIDS = (4, 8, 16)


def cells_of(xy, grid):
    return [tuple(min(int((value + 1) / 2 * grid), grid - 1) for value in place) for place in xy.tolist()]


@pytest.fixture(scope="module")
def xy():
    places = np.random.default_rng(3).normal(0, 0.3, (800, 2))
    return np.clip(np.concatenate([places, [[1, 1], [-1, -1], [1, -1]]]), -1, 1)


@pytest.fixture(scope="module")
def groups():
    # Two classes of a single shape, in the midst of others.
    found = np.random.default_rng(4).integers(0, 5, 803)
    found[[17, 42]] = 5, 6
    return found


@pytest.fixture(scope="module")
def chosen(xy, groups):
    return choose_pictures(xy, groups, GRIDS)


def test_each_cell_that_holds_a_shape_shows_one_and_finer_grids_show_what_coarser_ones_do(xy, groups, chosen):
    assert len(set(chosen.rows.tolist())) == len(chosen.rows) == chosen.ends[-1]
    before = 0
    for grid, end in zip(GRIDS, chosen.ends, strict=True):
        cells = cells_of(xy, grid)
        shown = chosen.rows[:end].tolist()
        assert {cells[row] for row in shown} == set(cells)
        if before > 0:
            # What is new is the only one of its cell.
            new = [cells[row] for row in shown[before:]]
            assert len(set(new)) == len(new)
            assert not set(new) & {cells[row] for row in shown[:before]}
        before = end
    assert set(groups[chosen.rows[: chosen.ends[0]]]) == set(groups)


def test_a_cell_shows_the_shape_nearest_to_the_middle_of_its_shapes(xy, chosen):
    cells = cells_of(xy, GRIDS[0])
    shown = set(chosen.rows[: chosen.ends[0]].tolist())
    for cell in set(cells):
        rows = [row for row, own in enumerate(cells) if own == cell]
        distance = np.hypot(*(xy[rows] - xy[rows].mean(axis=0)).T)
        assert rows[int(distance.argmin())] in shown


def test_a_class_that_no_cell_shows_is_shown_by_its_most_central_shape():
    # Nearest to the middle of the one cell is a shape of the second class.
    xy = np.array([[0.1, 0.1], [0.12, 0.1], [0.11, 0.1], [0.4, 0.4], [0.45, 0.4], [0.41, 0.4]])
    chosen = choose_pictures(xy, np.array([0, 0, 0, 1, 1, 1]), (1,))
    assert set(chosen.rows.tolist()) == {3, 2}


def test_shapes_of_a_sheet_lie_together(xy):
    places = np.random.default_rng(0).uniform(-1, 1, (20000, 2))
    chosen = choose_pictures(places, np.zeros(20000, int), (64,))
    spread = [np.ptp(places[rows], axis=0).max() for rows in chosen.sheets()]
    assert np.median(spread) < 0.5


def test_few_shapes_have_no_sheets(tmp_path):
    report = make_report()
    assert map_pictures(report) == {}
    write_site(report, tmp_path)
    assert not (tmp_path / "sheets").exists()
    assert read_script(tmp_path / "assets" / "chunk-sheets.js")[1]["maps"] == {}


def test_a_site_of_many_shapes_has_them(tmp_path, monkeypatch):
    monkeypatch.setattr(base, "MOST_IN_FULL", 20)
    report = make_report(("ant", "bird", None), 40)
    write_site(report, tmp_path)
    sheets = read_script(tmp_path / "assets" / "chunk-sheets.js")[1]
    assert list(sheets["maps"]) == ["tsne", "umap", "pca"]
    names = [name for held in sheets["maps"].values() for name in held["sheets"]]
    assert sorted(path.name for path in (tmp_path / "sheets").iterdir()) == sorted(set(names))
    held = sheets["maps"]["tsne"]
    assert len(held["rows"]) > 100
    own = [small(thumbnail) for thumbnail in report.thumbnails]
    for place in (0, 70, len(held["rows"]) - 1):
        with Image.open(tmp_path / "sheets" / held["sheets"][place // ACROSS**2]) as sheet:
            left, top = place % ACROSS * SIDE, place % ACROSS**2 // ACROSS * SIDE
            seen = on_white(sheet.crop((left, top, left + SIDE, top + SIDE)))
        differences = [np.abs(seen - picture).mean() for picture in own]
        assert min(differences) == differences[held["rows"][place]] < 10


def small(thumbnail):
    with Image.open(io.BytesIO(thumbnail)) as picture:
        return on_white(picture.convert("RGBA").resize((SIDE, SIDE)))


def on_white(picture):
    ground = Image.new("RGBA", picture.size, "white")
    return np.asarray(Image.alpha_composite(ground, picture.convert("RGBA")), float)


def test_the_name_of_a_sheet_says_what_is_on_it():
    rows, pictures = np.array([0, 1]), ["a.webp", "b.webp", "c.webp"]
    assert sheet_name(rows, pictures) == sheet_name(rows, pictures)
    assert (
        len({sheet_name(rows, pictures), sheet_name(rows[::-1], pictures), sheet_name(rows, pictures[1:])})
        == 3
    )


def test_a_sheet_is_the_same_every_time():
    thumbnails = make_report().thumbnails
    assert draw_sheet(thumbnails[:5]) == draw_sheet(thumbnails[:5])
