"""What the command says, in words that fit the numbers."""

from __future__ import annotations

from pathlib import Path

import pytest

from shapeviz_report import cli
from shapeviz_report.database import read_database


@pytest.mark.parametrize(
    ("files", "said"),
    [
        (["cup/1.off"], ["1 shape, read as", "1 class\n"]),
        (["cup/1.off", "ant/1.off", "2.off"], ["3 shapes, read as", "2 classes, 1 shape without\n"]),
        (["1.off", "2.off"], ["2 shapes, read as", "No labels: clusters of the features stand in"]),
    ],
)
def test_numbers_agree_with_their_words(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], files: list[str], said: list[str]
) -> None:
    for file in files:
        path = tmp_path / file
        path.parent.mkdir(exist_ok=True)
        path.touch()
    cli._print_database(read_database(tmp_path))
    told = capsys.readouterr().out
    assert all(words in told for words in said), told
