"""The time left is told when it can be, and as the work goes now."""

from __future__ import annotations

import io
import sys

import pytest

from shapeviz_report.building.progress import TimeLeft, in_words
from shapeviz_report.cli import terminal


def test_starting_and_compiling_tell_nothing_of_the_rest() -> None:
    left = TimeLeft(1000)
    assert left.estimate(90.0) is None
    for step in range(33):
        left.step(100.0 + step)
    assert left.estimate(132.0) == pytest.approx(967.0), "a second each; with the start it were 3,900"


def test_nothing_is_said_before_a_few_are_done() -> None:
    left = TimeLeft(100)
    for step in range(8):
        left.step(10.0 * step)
        assert left.estimate(10.0 * step) is None
    left.step(80.0)
    assert left.estimate(80.0) == pytest.approx(910.0)


def test_what_an_earlier_build_kept_soon_counts_no_more() -> None:
    left = TimeLeft(2000)
    for step in range(1000):
        left.step(step / 1e4)
    for step in range(15):
        left.step(0.1 + 2.0 * (step + 1))
    assert left.estimate(30.1) == pytest.approx(2.0 * 985, rel=0.1)


def test_work_that_stands_still_takes_longer() -> None:
    left = TimeLeft(100)
    for step in range(50):
        left.step(float(step))
    assert left.estimate(49.0 + 300) > 10 * left.estimate(49.0)


def test_the_end_is_no_time_away() -> None:
    left = TimeLeft(1)
    left.step(3.0)
    assert left.estimate(3.0) == 0.0


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (3, "10 s"),
        (44, "40 s"),
        (89, "90 s"),
        (90, "2 min"),
        (3000, "50 min"),
        (12_000, "3.5 h"),
        (36_000, "10 h"),
    ],
)
def test_times_are_told_as_one_would(seconds, words) -> None:
    assert in_words(seconds) == words


def test_without_a_terminal_progress_is_lines(monkeypatch) -> None:
    now = 0.0
    monkeypatch.setattr(terminal.time, "monotonic", lambda: now)
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with terminal.TerminalProgress().stage("Preparing meshes", 2000) as advance:
        for _ in range(100):
            now += 1.0
            advance()
    assert sys.stderr.getvalue().splitlines() == [
        "Preparing meshes: 2,000",
        "Preparing meshes: 30 of 2,000, 30 s gone, about 33 min left",
        "Preparing meshes: 60 of 2,000, 60 s gone, about 32 min left",
        "Preparing meshes: 90 of 2,000, 2 min gone, about 32 min left",
    ]
