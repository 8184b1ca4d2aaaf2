"""What the guide to publishing tells people to type is understood."""

import re
import shlex
import tomllib
from pathlib import Path

import pytest
import yaml

from shapeviz_report.cli.arguments import command_parser
from shapeviz_report.config import load_config

DOCS = Path(__file__).resolve().parents[2] / "docs" / "using"
GUIDE = (DOCS / "publishing.md").read_text(encoding="utf-8")
RECIPE = (DOCS / "publish.yml").read_text(encoding="utf-8")
ACTION = yaml.safe_load((DOCS / "action.yml").read_text(encoding="utf-8"))
COMMANDS = sorted(
    set(re.findall(r"(?:run: |- |^)(shapeviz-report (?:build|check) .+)$", GUIDE + RECIPE, re.MULTILINE))
)


def test_there_are_commands():
    assert len(COMMANDS) >= 4


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_are_understood(command):
    options = command_parser().parse_args(shlex.split(command)[1:])
    assert options.database == Path("shapes")


def test_the_options_of_the_guide_are_options(tmp_path):
    (example,) = re.findall(r"```toml\n(.*?)```", GUIDE, re.DOTALL)
    (tmp_path / "shapeviz.toml").write_text(example, encoding="utf-8")
    config = load_config(tmp_path, {})
    for name, value in tomllib.loads(example).items():
        assert getattr(config, name) in (value, tmp_path / value)


def test_the_recipe_builds_before_it_publishes_and_keeps_what_was_computed():
    jobs = yaml.safe_load(RECIPE)["jobs"]
    assert jobs["publish"]["needs"] == "build"
    uses = [step.get("uses", "").partition("@")[0] for step in jobs["build"]["steps"]]
    assert uses.index("actions/cache/restore") < uses.index("actions/cache/save")
    (kept,) = {step["with"]["path"] for step in jobs["build"]["steps"] if "cache" in step.get("uses", "")}
    builds = [
        step["run"] for step in jobs["build"]["steps"] if "shapeviz-report build" in step.get("run", "")
    ]
    (upload,) = [step for step in jobs["build"]["steps"] if "upload" in step.get("uses", "")]
    assert f"--cache {kept}" in builds[0]
    assert f"-o {upload['with']['path']}/" in builds[0]


def test_the_action_checks_and_builds_what_it_is_given():
    steps = ACTION["runs"]["steps"]
    commands = [step["run"] for step in steps if step.get("run", "").startswith("shapeviz-report")]
    assert [command.split()[1] for command in commands] == ["check", "build"]
    for command in commands:
        options = command_parser().parse_args(shlex.split(command.replace(" $OPTIONS", ""))[1:])
        assert options.cache == ".shapeviz-cache"
    for step in steps:
        assert "shell" in step or "uses" in step
        # what a workflow is given stands in the environment, where a shell runs none of it
        assert "${{" not in step.get("run", "")
    named = set(re.findall(r"inputs\.([\w-]+)", (DOCS / "action.yml").read_text(encoding="utf-8")))
    assert named == set(ACTION["inputs"])
    assert ACTION["inputs"]["source"]["default"] == "shapeviz-report"
