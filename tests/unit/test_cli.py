"""What the command says, in words that fit the numbers."""

from __future__ import annotations

import dataclasses
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from shapeviz_report import cli
from shapeviz_report.config import Config
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


def test_every_option_has_one_place_in_the_help() -> None:
    placed = Counter(name for names in cli.GROUPS.values() for name in names)
    assert placed == Counter(field.name for field in dataclasses.fields(Config)), (
        "give every option of Config a place in GROUPS of cli.py"
    )


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        ("shapeviz-report des", "describe"),
        ("shapeviz-report build --edge", "--edge-length"),
        ("shapeviz-report completion z", "zsh"),
    ],
)
def test_a_shell_completes(capsys: pytest.CaptureFixture[str], tmp_path: Path, words, offered) -> None:
    assert cli.main(["completion", "bash"]) == 0
    script = tmp_path / "completion.bash"
    script.write_text(capsys.readouterr().out)
    asking = f"""source {script}; COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
    _shtab_shapeviz_report; echo "${{COMPREPLY[@]}}" """
    found = subprocess.run(["bash", "-c", asking], capture_output=True, text=True, check=True)
    assert found.stdout.split() == [offered]


def test_zsh_has_its_script(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["completion", "zsh"]) == 0
    script = capsys.readouterr().out
    assert script.startswith("#compdef shapeviz-report\n")
    assert "--edge-length" in script


def test_spaces_of_all_kinds_are_shown() -> None:
    assert cli._one_line("0.2\u00a0% of 1\u202f000\u2028\u3000\x85") == "0.2 % of 1 000? ?"
