"""What workers compute."""

from __future__ import annotations

from shapeviz_report import demo
from shapeviz_report.building import stages


def test_shapes_that_are_compared_again_and_again_are_read_once(monkeypatch) -> None:
    read = []

    def parse_mesh(files):
        read.append(next(iter(files)))
        return stages_parse_mesh(files)

    stages_parse_mesh = stages.parse_mesh
    monkeypatch.setattr(stages, "parse_mesh", parse_mesh)
    monkeypatch.setattr(stages, "_laid_out", {})
    shapes = [{f"{index}.off": demo.encode_shape("table", index, 0)} for index in range(4)]
    for other in shapes[1:3]:
        assert stages.read_match(stages.compare_shapes(shapes[0], other)) is None
    assert read == ["0.off", "1.off", "2.off"]
    # no more are kept than there is room for, besides those that are compared
    monkeypatch.setattr(stages, "MOST_LAID_OUT", 0)
    for other in (shapes[3], shapes[1]):
        stages.compare_shapes(shapes[0], other)
    assert read == ["0.off", "1.off", "2.off", "3.off", "1.off"]
    assert stages.read_match(stages.compare_shapes(shapes[0], shapes[0])).kind == "identical geometry"
