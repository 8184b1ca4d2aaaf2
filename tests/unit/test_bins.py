"""Names of bins in files, the scaling of a choice of bins, and what a bin is in words."""

from __future__ import annotations

import json

import numpy as np
import pytest

from shapeviz_report.bins import features_of, read_bins, scale_bins
from shapeviz_report.errors import ConfigError
from shapeviz_report.features import BLOCKS, fixed_edges
from shapeviz_report.presets import PRESETS
from shapeviz_report.types import FeatureBlock, FeatureTable

BLOCKS_AND_OWN = (*BLOCKS, FeatureBlock("deep one", 3, 1))


def table(count: int = 12) -> FeatureTable:
    """Random fractions for all features, one bin that never changes, and a feature that was brought along."""
    random = np.random.default_rng(0)
    histograms = random.random((count, *fixed_edges()[:, 1:].shape)) ** 3
    histograms[:, 0, 0] = 0
    histograms /= histograms.sum(axis=2, keepdims=True)
    values = np.column_stack([histograms.reshape(count, -1), random.normal(5, 3, (count, 3))])
    return FeatureTable(tuple(map(str, range(count))), BLOCKS_AND_OWN, values)


class TestFiles:
    @pytest.mark.parametrize(
        ("name", "text"),
        [
            ("bins.txt", "# 3 bins, best first\n\nFPFH[14]:3\r\n  Agd:6 \ndeep one[2]\n"),
            ("bins", "\ufeffFPFH[14]:3\nAgd:6\ndeep one[2]"),
            (
                "scores.csv",
                "bin,rank,score,chosen\nFPFH[14]:3,1,0.9,1\nGc:1,2,.5,0\nAgd:6,3,.1,1\ndeep one[2],4,0,1\n",
            ),
            ("bins.csv", 'bin;chosen\n"FPFH[14]:3";1\nAgd:6;1\nAgd:7;0\n"deep one[2]";1\n'),
            ("bins.csv", 'bin\n"FPFH[14]:3"\nAgd:6\n"deep one[2]"\n'),
            ("bins.json", json.dumps(["FPFH[14]:3", "deep one[2]", "Agd:6"])),
            ("workbench.json", json.dumps({"about": ["x"], "bins": ["deep one[2]", "FPFH[14]:3", "Agd:6"]})),
        ],
    )
    def test_names_come_in_the_order_of_the_columns(self, tmp_path, name, text) -> None:
        (tmp_path / name).write_bytes(text.encode())
        assert read_bins(tmp_path / name, BLOCKS_AND_OWN) == ("Agd:6", "FPFH[14]:3", "deep one[2]")

    @pytest.mark.parametrize(
        ("name", "text", "reason"),
        [
            ("bins.txt", "Agd:11", r"'Agd:11': the columns of Agd are Agd:1 to Agd:10"),
            ("bins.txt", "FPFH[33]:1", r"the columns of FPFH are FPFH\[0\]:1 to FPFH\[32\]:10"),
            ("bins.txt", "FPFH", r"the columns of FPFH are"),
            ("bins.txt", "agd:6", r"no such feature, only Gc, Agd"),
            ("bins.txt", "deep:1", r"no such feature.*--external"),
            ("bins.txt", "Agd:6\nGc:1\nAgd:6", "names 'Agd:6' 2 times"),
            ("bins.txt", "# nothing here\n\n", "names none"),
            ("bins.csv", "bin,chosen\nAgd:6,0\n", "names none"),
            ("bins.csv", "name\nAgd:6\n", "no column named 'bin'"),
            ("bins.json", "[1, 2]", "neither a list of names"),
            ("bins.json", '{"chosen": []}', "neither a list of names"),
            ("bins.json", "{", "cannot be read"),
        ],
    )
    def test_what_cannot_be_followed_says_why_and_where(self, tmp_path, name, text, reason) -> None:
        (tmp_path / name).write_text(text)
        with pytest.raises(ConfigError, match=reason) as error:
            read_bins(tmp_path / name, BLOCKS_AND_OWN)
        assert name in str(error.value)

    def test_a_file_that_is_not_there_or_not_text(self, tmp_path) -> None:
        with pytest.raises(ConfigError, match="cannot be read"):
            read_bins(tmp_path / "bins.txt", BLOCKS)
        (tmp_path / "bins.txt").write_bytes(b"\xff\xfe\x00")
        with pytest.raises(ConfigError, match="cannot be read"):
            read_bins(tmp_path / "bins.txt", BLOCKS)


CHOSEN = ("Gc:1", "Agd:6", "FPFH[14]:3", "deep one[2]")


class TestScaling:
    def test_every_chosen_bin_counts_the_same(self) -> None:
        features = table()
        scaled = scale_bins(features, PRESETS["default"], CHOSEN)
        assert scaled.std(axis=0) == pytest.approx([0, 1, 1, 1])
        assert (scaled[:, 0] == 0).all(), "a bin that is the same for all shapes has no say"
        # Of histograms the square roots are compared, of other features the values.
        columns = [features.columns.index(name) for name in CHOSEN]
        agd, own = features.values[:, columns[1]], features.values[:, columns[3]]
        assert np.corrcoef(scaled[:, 1], np.sqrt(agd))[0, 1] == pytest.approx(1)
        assert np.corrcoef(scaled[:, 3], own)[0, 1] == pytest.approx(1)

    def test_a_bin_is_scaled_the_same_whatever_else_is_chosen(self) -> None:
        alone = scale_bins(table(), PRESETS["default"], CHOSEN[2:3])
        assert (scale_bins(table(), PRESETS["default"], CHOSEN)[:, 2:3] == alone).all()

    def test_the_papers_reading_is_not_scaled(self) -> None:
        features = table()
        scaled = scale_bins(features, PRESETS["paper"], CHOSEN[1:3])
        assert (scaled == features.values[:, [features.columns.index(name) for name in CHOSEN[1:3]]]).all()

    def test_features_of_a_choice(self) -> None:
        assert features_of(table(), ("deep one[0]", "Agd:6", "Agd:7")) == ("Agd", "deep one")
