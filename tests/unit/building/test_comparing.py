"""Which pairs are compared together, and what becomes of those that fail."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shapeviz_report import demo
from shapeviz_report.building import stages
from shapeviz_report.building.comparing import BYTES_A_TASK, PAIRS_A_TASK, find_copies, share_out
from shapeviz_report.building.progress import Clock, QuietProgress
from shapeviz_report.building.runner import Runner
from shapeviz_report.cache import Cache
from shapeviz_report.config import Config
from shapeviz_report.copies import NEAREST_OUTLINES, Outline, pair_outlines
from shapeviz_report.executor import Outcome


class HereExecutor:
    """Runs tasks in this process and counts those of each function; of several pairs together, none is answered where
    that is said."""

    near = True

    def __init__(self, *, fails: bool = False) -> None:
        self.fails = fails
        self.tasks: list[str] = []

    def run(self, function, tasks, patience=1.0):
        for index, task in enumerate(tasks):
            self.tasks.append(function.__name__)
            if self.fails and function is stages.compare_all:
                yield Outcome(index, None, "it took longer than 1 second", 0.0)
            else:
                yield Outcome(index, function(*task), None, 0.0)


def find(folder: Path, executor: HereExecutor):
    shapes = {f"{name} {number}": {f"{name}.off": demo.encode_shape(name, 0, 0)} for name in ("cup", "table")
              for number in range(3)}  # fmt: skip
    # three files of each shape, and outlines that say that all may be one
    for number, files in enumerate(shapes.values()):
        files |= {name: content + b"\n" * number for name, content in files.items()}
    outlines = {shape: Outline(shape, np.zeros(20)) for shape in shapes}
    run = Runner(executor, Clock(QuietProgress()), Cache(folder), {}, [], Config())
    return {
        (copy.first, copy.second): copy.match.kind for copy in find_copies(run, shapes.__getitem__, outlines)
    }


SAME = {
    (f"{name} {first}", f"{name} {second}"): "identical geometry"
    for name in ("cup", "table")
    for first, second in ((0, 1), (0, 2), (1, 2))
}


@pytest.mark.parametrize("fails", [False, True])
def test_pairs_of_a_task_that_fails_are_compared_one_by_one(tmp_path, fails) -> None:
    executor = HereExecutor(fails=fails)
    assert find(tmp_path, executor) == SAME
    assert executor.tasks == ["compare_all"] + ["compare_shapes"] * (15 if fails else 0)
    again = HereExecutor()
    assert find(tmp_path, again) == SAME
    assert again.tasks == []


def test_pairs_are_dealt_out_so_that_few_files_travel() -> None:
    rows = np.random.default_rng(0).permutation(200)
    pairs = sorted(
        (min(a, b), max(a, b)) for a, b in ((str(rows[i]), str(rows[i + k])) for i in range(196) for k in range(1, 5))
    )  # fmt: skip
    shapes = {shape for pair in pairs for shape in pair}
    tasks = share_out(pairs, dict.fromkeys(shapes, 1))
    assert sorted(pair for task in tasks for pair in task) == pairs
    assert max(map(len, tasks)) == PAIRS_A_TASK
    assert sum(len({shape for pair in task for shape in pair}) for task in tasks) < 3 * len(shapes)
    # what is large travels with its partner alone
    assert {len(task) for task in share_out(pairs, dict.fromkeys(shapes, BYTES_A_TASK))} == {1}
    assert share_out([], {}) == []


def test_shapes_without_end_of_one_outline_are_compared_with_one_more_each() -> None:
    values = np.full(20, 0.5) + 1e-13 * np.random.default_rng(0).standard_normal((3000, 20))
    _, pairs = pair_outlines({str(row): Outline(str(row), one) for row, one in enumerate(values)})
    assert len(pairs) < 3000 + (NEAREST_OUTLINES + 1) ** 2
    assert {shape for pair in pairs for shape in pair} == {str(row) for row in range(3000)}


def test_a_shape_that_memory_cannot_hold_is_told_of_and_ends_nothing(tmp_path, caplog) -> None:
    def read(shape):
        raise MemoryError

    run = Runner(HereExecutor(), Clock(QuietProgress()), Cache(tmp_path), {}, [], Config())
    outlines = {shape: Outline(shape, np.zeros(20)) for shape in ("a", "b")}
    assert find_copies(run, read, outlines) == ()
    assert "Whether a and b are copies is not known: it is larger than the memory" in caplog.text
