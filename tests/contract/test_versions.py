"""What is kept belongs to the code that made it: a stage's key changes with every module that its function reaches.

One copy of the package is changed module by module; and every stage is run once to see which modules it runs.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import shapeviz_report
from shapeviz_report.building import stages
from shapeviz_report.versions import find_function_closure

pytestmark = pytest.mark.slow

SOURCE = Path(shapeviz_report.__file__).parent
STAGES = {name: stage for name, stage in vars(stages).items() if isinstance(stage, stages.Stage)}


def run(folder: Path, script: str) -> dict[str, list[str]]:
    """What a script prints as JSON, in a process that finds the package in ``folder``."""
    path = os.pathsep.join([str(folder), *sys.path])
    done = subprocess.run(
        [sys.executable, "-P", "-c", textwrap.dedent(script), str(folder)],
        env=os.environ | {"PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def changed(tmp_path_factory) -> dict[str, list[str]]:
    """Module -> the stages whose version another is, after a change in that module alone."""
    folder = tmp_path_factory.mktemp("copy")
    shutil.copytree(SOURCE, folder / SOURCE.name, ignore=shutil.ignore_patterns("__pycache__", "_*s"))
    return run(
        folder,
        """
        import json, sys
        from pathlib import Path
        from shapeviz_report.building import stages
        from shapeviz_report.versions import function_version

        kept = {name: stage for name, stage in vars(stages).items() if isinstance(stage, stages.Stage)}
        root = Path(stages.__file__).parents[1]
        assert root.parent == Path(sys.argv[1])
        before = {name: stage.version for name, stage in kept.items()}
        changed = {}
        for file in sorted(root.rglob("*.py")):
            module = ".".join(file.relative_to(root.parent).with_suffix("").parts).removesuffix(".__init__")
            text = file.read_text()
            file.write_text(text + "# changed")
            function_version.cache_clear()
            changed[module] = [name for name, stage in kept.items() if stage.version != before[name]]
            file.write_text(text)
        print(json.dumps(changed))
        """,
    )


@pytest.mark.parametrize("name", STAGES)
def test_a_change_in_any_reached_module_changes_the_key(changed, name) -> None:
    reached = set(find_function_closure(STAGES[name].compute).modules)
    counted = {module for module, names in changed.items() if name in names}
    assert counted == reached, "find_function_closure of versions.py misses, or adds, a module"


EXPECTED = {
    "SCORE": {"scorers.kernels.random", "scorers.balance", "scorers.rfe"},
    "PREPARE": {"mesh.readers.ply", "mesh.remesh", "database.formats", "types.mesh"},
    "CLUSTER": {"clusters", "projections.base"},
    "RENDER": {"render.rasteriser", "render.shading"},
    "VIEW": {"render.viewpoint"},
    "DESCRIBE": {"descriptors.kernels.rays", "models", "features"},
}


@pytest.mark.parametrize("name", EXPECTED)
def test_known_reaches(changed, name) -> None:
    reached = {module.removeprefix("shapeviz_report.") for module, names in changed.items() if name in names}
    assert reached >= EXPECTED[name]
    assert not reached & {
        "building.pipeline",
        "cli",
        "pages.overview",
        "site",
        "types.report",
        "search.certainty",
    }


def test_a_change_in_the_function_itself_changes_the_key(tmp_path) -> None:
    shutil.copytree(SOURCE, tmp_path / SOURCE.name, ignore=shutil.ignore_patterns("__pycache__", "_*s"))
    versions = """
        import json
        from shapeviz_report.building import stages
        kept = {name: stage for name, stage in vars(stages).items() if isinstance(stage, stages.Stage)}
        print(json.dumps({name: stage.version for name, stage in kept.items()}))
    """
    before = run(tmp_path, versions)
    file = tmp_path / SOURCE.name / "building" / "stages.py"
    old = "score_separation(scorer, values, contests, seed=seed)"
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, old.replace("values", "values * 0")))
    after = run(tmp_path, versions)
    assert [name for name in before if after[name] != before[name]] == ["SCORE"]


def test_what_runs_is_reached() -> None:
    ran = run(
        SOURCE.parent,
        """
        import json, sys
        import numpy as np
        import trimesh
        from shapeviz_report.building import stages
        from shapeviz_report.features import BLOCKS, fixed_edges
        from shapeviz_report.presets import PRESETS
        from shapeviz_report.search.bins import make_bin_space
        from shapeviz_report.types import FeatureTable

        ran = {}
        def call(name, *arguments):
            # Once unwatched: what compiles and loads on a first call is much to watch, and none of it ours.
            getattr(stages, name).compute(*arguments)
            found = set()
            def see(frame, event, argument):
                module = frame.f_globals.get("__name__", "")
                if module.startswith("shapeviz_report") and frame.f_code.co_name != "<module>":
                    found.add(module)
            sys.setprofile(see)
            try:
                result = getattr(stages, name).compute(*arguments)
            finally:
                sys.setprofile(None)
            ran[name] = sorted(found)
            return result

        files = {"ball.ply": trimesh.creation.icosphere(1).export(file_type="ply")}
        call("EXAMINE", files)
        call("COMPARE", files, {"same.ply": files["ball.ply"]})
        prepared = call("PREPARE", files, 0.05)
        call("FACTS", prepared)
        view = call("VIEW", prepared, None)
        call("RENDER", prepared, view, 64, "osmesa", False)
        edges = fixed_edges()
        call("SAMPLE", prepared, 20)
        call("DESCRIBE", prepared, view, edges, True, 100, False)
        call("EXPORT", prepared, view, 100, {"_AGD": 1}, False)
        call("DESCRIBE_WHOLE", prepared)
        call("MEASURE", prepared, edges, True)
        call("MEASURE_VERTICES", prepared)
        call("PAINT", prepared, view, edges, [(0, 1)], 64, "osmesa")
        random = np.random.default_rng(0)
        values = random.random((24, sum(block.width for block in BLOCKS)))
        labels = ["a", "b", "c"] * 8
        for method in ("tsne", "umap", "pca", "diffused"):
            call("PROJECT", method, values, 0)
        call("CLUSTER", values, 0)
        call("RELATE", values)
        call("SCORE", values[:, :40], list(range(12)), list(range(12, 24)), 0)
        squared = random.random((2, 24, 24))
        squared = squared + squared.transpose(0, 2, 1)
        call("SEARCH", squared, "tsne", 0, (1, 3))
        call("RETRIEVE", squared, np.arange(24) % 3, (1, 3))
        features = FeatureTable(tuple(map(str, range(24))), BLOCKS, values)
        space = make_bin_space(features, PRESETS["default"], labels, seed=0)
        call("SELECT", "separate", space, labels, {"k": 5, "seed": 0, "label": "a"})
        call("GENERATE", "cup", 0, 0)
        print(json.dumps(ran))
        """,
    )
    own = stages.__name__
    for name, modules in ran.items():
        assert own in modules
        hidden = set(modules) - {own} - set(find_function_closure(STAGES[name].compute).modules)
        assert not hidden, f"{name} runs {sorted(hidden)} behind no import statement: import them by name"
    assert set(ran) == set(STAGES), f"call {sorted(set(STAGES) - set(ran))} in this test as a build does"
