"""What is done for one shape at one go."""

from __future__ import annotations

import trimesh

from shapeviz_report.building import stages
from shapeviz_report.building.chains import FILES, Chain, work_through

BALL = {"ball.ply": trimesh.creation.icosphere(1).export(file_type="ply")}
NOTHING = {"nothing.obj": b"v 0 0 0\n"}


def chain_of(identity: str, edge_length: float = 0.06) -> Chain:
    chain = Chain(identity)
    chain.add(stages.PREPARE, (), edge_length)
    chain.add(stages.FACTS, [stages.PREPARE])
    chain.add(stages.VIEW, [stages.PREPARE], None)
    chain.add(stages.RENDER, [stages.PREPARE, stages.VIEW], 64, "zbuffer", False)
    return chain


def work(chain: Chain, given: dict, back: set[str], names: list[str] | None = None):
    links = [
        (name, link.stage.compute, link.inputs, link.options)
        for name, link in chain.links.items()
        if names is None or name in names
    ]
    return work_through(given, links, back)


def test_stages_take_what_earlier_ones_made_and_only_what_is_wanted_comes_back():
    done = work(chain_of("ball"), {FILES: BALL}, {"facts", "rendered"})
    assert done.refused is None
    assert done.results.keys() == {"facts", "rendered"}
    assert stages.FACTS.read(done.results["facts"]).watertight
    assert done.results["rendered"][8:12] == b"WEBP"
    assert list(done.cpu_seconds) == ["prepared", "facts", "viewed", "rendered"]
    one_by_one = stages.prepare_shape(BALL, 0.06)
    view = stages.view_shape(one_by_one, None)
    assert done.results["rendered"] == stages.render_shape(one_by_one, view, 64, "zbuffer", False)


def test_what_is_there_is_not_done_again():
    prepared = stages.prepare_shape(BALL, 0.06)
    done = work(chain_of("ball"), {"prepared": prepared}, {"facts"}, ["facts"])
    assert list(done.cpu_seconds) == ["facts"]
    assert stages.FACTS.read(done.results["facts"]).faces_read == 80


def test_a_mesh_that_cannot_be_used_ends_the_chain_and_keeps_why():
    done = work(chain_of("nothing"), {FILES: NOTHING}, {"prepared", "facts", "rendered"})
    assert done.results.keys() == {"prepared", "facts"}
    name, reason = done.refused
    assert name == "viewed"
    assert b"refused" in done.results["facts"]
    assert reason in done.results["facts"].decode()


def test_keys_follow_from_the_files_and_the_options_of_all_that_lies_before():
    first, same, other, longer = chain_of("a"), chain_of("a"), chain_of("b"), chain_of("a", 0.07)
    for stage in (stages.PREPARE, stages.FACTS, stages.RENDER):
        assert first.key(stage) == same.key(stage)
        assert len({first.key(stage), other.key(stage), longer.key(stage)}) == 3
