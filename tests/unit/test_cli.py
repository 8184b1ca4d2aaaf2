"""What the command says, in words that fit the numbers."""

from __future__ import annotations

import dataclasses
import re
import shutil
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from shapeviz_report.cli import main
from shapeviz_report.cli.arguments import GROUPS
from shapeviz_report.cli.commands import COMMANDS
from shapeviz_report.cli.results import print_database
from shapeviz_report.cli.terminal import one_line
from shapeviz_report.config import Config
from shapeviz_report.database import read_database


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["check", ""], "argument DATABASE: it is empty; give a path"),
        (["build", "shapes", "-o", ""], "argument -o/--output: it is empty"),
        (["cache", "--unused", "-5"], "argument --unused: '-5' is no number from 0 on"),
        (["cache", "--keep", "all"], "argument --keep: 'all' is no number from 0 on"),
        (["cache", "--keep", "nan"], "argument --keep: 'nan' is no number from 0 on"),
    ],
)
def test_arguments_that_mean_nothing(capsys: pytest.CaptureFixture[str], arguments, said) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(arguments)
    assert said in capsys.readouterr().err


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
    print_database(read_database(tmp_path))
    told = capsys.readouterr().out
    assert all(words in told for words in said), told


@pytest.mark.parametrize("columns", [60, 80, 200])
@pytest.mark.parametrize("command", [(), *((name,) for name in COMMANDS)])
def test_help_fits_the_terminal(capsys, monkeypatch, columns, command) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    with pytest.raises(SystemExit):
        main([*command, "--help"])
    text = capsys.readouterr().out
    # a path or an address has no place to break it
    too_long = [line for line in text.splitlines() if len(line) > columns and len(line.split()) > 2]
    assert too_long == []
    if "exit codes:" in text:
        assert "\n  0    done; " in text
    if columns == 60 and command == ("build",):
        assert "\n  1    nothing was built: the message says why\n" in text
        assert "signal);\n       the same command continues" in text


def test_every_option_has_one_place_in_the_help() -> None:
    placed = Counter(name for names in GROUPS.values() for name in names)
    assert placed == Counter(field.name for field in dataclasses.fields(Config)), (
        "give every option of Config a place in GROUPS of cli/arguments.py"
    )


OFFERED = [
    ("des", "describe"),
    ("build --edge", "--edge-length"),
    ("completion z", "zsh"),
    ("build --preset ''", "default local paper"),
    ("build --single-file --search u", "umap"),
    ("build --gltf-values A", "Agd"),
    ("query --features PF", "PFH"),
    ("check --layout ''", "princeton table modelnet class-folders flat"),
    ("cache --cache ''", "folder"),
    ("build --external ''", "features.csv folder"),
    ("build ''", "features.csv folder"),
]
"""Words after the command, the last to be completed, and what is offered in a folder of a folder and a file."""


def complete(shell: str, folder: Path, script: str, command: str) -> list[str]:
    """What a shell gives for a command, run in such a folder, that has the script beside it."""
    (folder / "here" / "folder").mkdir(parents=True)
    (folder / "here" / "features.csv").touch()
    (folder / "script").write_text(script)
    done = subprocess.run(
        [shell, "-c", command], capture_output=True, text=True, check=True, cwd=folder / "here"
    )
    return sorted(line.partition("\t")[0].rstrip("/") for line in done.stdout.splitlines())


def script_of(shell: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["completion", shell]) == 0
    return capsys.readouterr().out


@pytest.mark.parametrize(("words", "offered"), OFFERED)
def test_bash_completes(capsys: pytest.CaptureFixture[str], tmp_path: Path, words, offered) -> None:
    command = f"""source ../script; COMP_WORDS=(shapeviz-report {words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
    _shtab_shapeviz_report; printf '%s\\n' "${{COMPREPLY[@]}}" """
    assert complete("bash", tmp_path, script_of("bash", capsys), command) == sorted(offered.split())


@pytest.mark.skipif(shutil.which("fish") is None, reason="fish is not installed")
@pytest.mark.parametrize(("words", "offered"), OFFERED)
def test_fish_completes(capsys: pytest.CaptureFixture[str], tmp_path: Path, words, offered) -> None:
    command = f"source ../script; complete -C 'shapeviz-report {words.removesuffix(chr(39) * 2)}'"
    assert complete("fish", tmp_path, script_of("fish", capsys), command) == sorted(offered.split())


def test_zsh_has_its_script(capsys: pytest.CaptureFixture[str]) -> None:
    script = script_of("zsh", capsys)
    assert script.startswith("#compdef shapeviz-report\n")
    assert re.search(r'"--preset\[.*\]:NAME:\(default local paper\)"', script)
    assert re.search(r'"--cache\[.*\]:FOLDER:_files -/"', script)


@pytest.mark.skipif(shutil.which("zsh") is None, reason="zsh is not installed")
def test_zsh_takes_its_script(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    command = """zsh -n ../script && mkdir ../functions && cp ../script ../functions/_shapeviz-report
    fpath=($PWD/../functions $fpath); autoload -Uz compinit; compinit -u -D; print $_comps[shapeviz-report]"""
    assert complete("zsh", tmp_path, script_of("zsh", capsys), command) == ["_shapeviz-report"]


def test_spaces_of_all_kinds_are_shown() -> None:
    assert one_line("0.2\u00a0% of 1\u202f000\u2028\u3000\x85") == "0.2 % of 1 000? ?"
