"""Parts of other packages: which are taken up, in which order, and what is said of those that cannot be used."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from solids import lump

from shapeviz_report import plugins
from shapeviz_report.database import LAYOUTS, Layout
from shapeviz_report.database import registry as layouts
from shapeviz_report.descriptors import DESCRIPTORS, Descriptor, Surface
from shapeviz_report.descriptors import registry as descriptors
from shapeviz_report.ending import end_in_order, listen, listening
from shapeviz_report.errors import MeshError, PluginError
from shapeviz_report.plugins import find_plugins, load_plugins, with_plugins
from shapeviz_report.projections import PROJECTIONS, Method
from shapeviz_report.projections import registry as projections
from shapeviz_report.wording import registry as wordings

Install = Callable[..., None]

HEIGHT = """
import numpy as np
from shapeviz_report.descriptors import Descriptor
def compute(surface):
    return surface.vertices[:, 2:]
HEIGHT = Descriptor("{name}", "Height", "How high a point is.", 1, tuple(np.linspace(-1, 1, 11)), compute)
"""


@pytest.fixture
def install(tmp_path, monkeypatch) -> Iterator[Install]:
    """Put a package onto the path as an installer leaves it there."""
    monkeypatch.syspath_prepend(str(tmp_path))

    def add(package: str, text: str, version: str = "1.0", **parts: str) -> None:
        module = package.replace("-", "_").lower()
        (tmp_path / f"{module}.py").write_text(text)
        info = tmp_path / f"{module}-{version}.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: {version}\n")
        (info / "entry_points.txt").write_text(
            "".join(
                f"[shapeviz_report.{group}]\n"
                + "".join(f"{entry} = {module}:{entry}\n" for entry in entries.split())
                for group, entries in parts.items()
            )
        )
        find_plugins.cache_clear()

    yield add
    find_plugins.cache_clear()
    for name, module in list(sys.modules.items()):
        if (getattr(module, "__file__", None) or "").startswith(str(tmp_path)):
            del sys.modules[name]


def all_descriptors() -> tuple[Descriptor, ...]:
    return with_plugins("shapeviz_report.descriptors", DESCRIPTORS, Descriptor, descriptors._prepare)


def test_without_plugins_all_is_ours() -> None:
    assert find_plugins() == ()
    assert all_descriptors() == DESCRIPTORS


def test_packages_come_by_name_and_ours_first(install) -> None:
    install("zebra", HEIGHT.format(name="Zh"), descriptors="HEIGHT")
    install("Ape_Tools", HEIGHT.format(name="Ah") + HEIGHT.format(name="Bh").replace("HEIGHT", "ALSO"),
            version="2.1", descriptors="HEIGHT ALSO")  # fmt: skip
    found = [(plugin.package, plugin.version, plugin.name) for plugin in find_plugins()]
    assert found == [("ape-tools", "2.1", "ALSO"), ("ape-tools", "2.1", "HEIGHT"), ("zebra", "1.0", "HEIGHT")]
    assert [d.name for d in all_descriptors()] == [*(d.name for d in DESCRIPTORS), "Bh", "Ah", "Zh"]


def test_a_descriptor_computes(install) -> None:
    install("heights", HEIGHT.format(name="Hgt"), descriptors="HEIGHT")
    surface = Surface(lump())
    np.testing.assert_array_equal(all_descriptors()[-1].compute(surface), surface.vertices[:, 2:])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("raise ValueError('no luck')", r"cannot be loaded \(ValueError: no luck\)"),
        ("raise SystemExit(3)", r"cannot be loaded \(SystemExit: 3\)"),
        ("import nowhere_to_be_found", r"cannot be loaded \(ModuleNotFoundError: .*nowhere_to_be_found"),
        ("OTHER = 1", "cannot be loaded .AttributeError"),
        ("HEIGHT = 3", "it is of the type int, not Descriptor"),
        (HEIGHT.format(name="Gc"), "has the name 'Gc', which is taken by one of shapeviz-report itself"),
        (HEIGHT.format(name="gC"), "has the name 'gC', which is taken by one of shapeviz-report itself"),
        (HEIGHT.format(name="H").replace('"Height"', '""'), "its 'title' has no letter"),
        (HEIGHT.format(name="H").replace('"Height"', r'"\u2060 \n"'), "its 'title' has no letter"),
        (HEIGHT.format(name="H").replace("How high a point is.", " ."), "its 'measures' has no letter"),
        (HEIGHT.format(name="two words"), "letters and digits only"),
        (HEIGHT.format(name="H").replace("11", "12"), "its edges are not 11 rising numbers"),
        (HEIGHT.format(name="H").replace("high a point is.", "high"), "ends with a full stop"),
        (HEIGHT.format(name="H").replace('"H"', "5"), "its 'name' is of the type int, not str"),
        (
            HEIGHT.format(name="H").replace(" 1, tuple", " '1', tuple"),
            "its 'dimensions' is of the type str, not int",
        ),
        (
            HEIGHT.format(name="H").replace("tuple(", "list("),
            r"'edges' is of the type list, not tuple\[float",
        ),
        (
            HEIGHT.format(name="H").replace(", compute)", ", None)"),
            "'compute' is of the type NoneType, not Call",
        ),
    ],
)
def test_what_cannot_be_used_is_told_with_its_package(install, text, said) -> None:
    install("heights", text, version="3.2", descriptors="HEIGHT")
    with pytest.raises(PluginError, match=said) as told:
        all_descriptors()
    assert str(told.value).startswith("the descriptor 'HEIGHT' of the package heights 3.2 ")


def test_a_name_that_two_packages_have(install) -> None:
    for package in ("one", "two"):
        install(package, HEIGHT.format(name="Hgt"), descriptors="HEIGHT")
    with pytest.raises(PluginError, match=r"of the package two 1\.0 has the name 'Hgt'.* of the package one"):
        all_descriptors()


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("surface.vertices", r"its values are an array \(\d+, 3\), and not \(\d+, 1\)"),
        ("surface.vertices[:, 2:] / 0", "not all of its values are finite"),
        ("surface.vertices[:, 2:].astype(str)", "its values are of the type .*, and no real numbers"),
        ("surface.vertices[:, 2:] + 1j", "its values are of the type complex128, and no real numbers"),
        ("surface.vertices[:, 2:] * 1e40", r"its values are not all from -1e\+30 to 1e\+30"),
        ("[[1], [2, 3]]", ".ValueError: .*inhomogeneous"),
        ("exit(3)", ".SystemExit: 3"),
        ("surface.nothing", r"\(AttributeError: 'Surface' object has no attribute 'nothing'\)"),
    ],
)
def test_what_fails_on_a_shape_is_told_with_its_package(install, body, said) -> None:
    install(
        "heights", HEIGHT.format(name="Hgt").replace("surface.vertices[:, 2:]", body), descriptors="HEIGHT"
    )
    ending = "; mend, update or uninstall the package$"
    with (
        np.errstate(all="ignore"),
        pytest.raises(PluginError, match=rf"heights 1\.0 failed.*{said}.*{ending}"),
    ):
        all_descriptors()[-1].compute(Surface(lump()))


@pytest.fixture
def command() -> Iterator[None]:
    """Signals are handled as the command does it."""
    with listening():
        listen(end_in_order)
        yield


def raising(error: str) -> str:
    return HEIGHT.format(name="Hgt").replace("return surface", f"raise {error}\n    return surface")


@pytest.mark.parametrize("error", ["KeyboardInterrupt", "SystemExit(143)", "GeneratorExit"])
def test_a_plugin_that_ends_the_program_is_told_as_any_failure(install, command, error) -> None:
    name = error.partition("(")[0]
    install("heights", raising(error), descriptors="HEIGHT")
    with pytest.raises(PluginError, match=rf"heights 1\.0 failed \({name}"):
        all_descriptors()[-1].compute(Surface(lump()))
    install("early", f"raise {error}", descriptors="EARLY")
    with pytest.raises(PluginError, match=rf"early 1\.0 cannot be loaded \({name}"):
        all_descriptors()


@pytest.fixture
def interruptible():
    """Ctrl-C as a terminal has it: what a shell starts in the background passes it over."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize(
    ("number", "error"), [(signal.SIGINT, KeyboardInterrupt), (signal.SIGTERM, SystemExit)]
)
def test_who_asks_the_program_to_end_is_heard_in_a_plugin(
    install, interruptible, command, number, error
) -> None:
    text = raising(f"SystemError(__import__('signal').raise_signal({number:d}))")
    install("heights", text, descriptors="HEIGHT")
    with pytest.raises(error):
        all_descriptors()[-1].compute(Surface(lump()))


def test_ctrl_c_in_a_notebook_is_no_failure_of_a_plugin(install, interruptible) -> None:
    install("heights", raising("KeyboardInterrupt"), descriptors="HEIGHT")
    with pytest.raises(KeyboardInterrupt):
        all_descriptors()[-1].compute(Surface(lump()))


def test_a_plugin_changes_nothing_that_others_measure(install) -> None:
    text = HEIGHT.format(name="Hgt").replace(
        "return surface", "surface.normals[:] = surface.vertices[:] = 0; return surface"
    )
    install("heights", text, descriptors="HEIGHT")
    surface = Surface(lump())
    for descriptor in DESCRIPTORS:
        descriptor.compute(surface)
    before = surface.vertices.copy(), surface.normals.copy()
    assert not all_descriptors()[-1].compute(surface).any()
    np.testing.assert_array_equal((surface.vertices, surface.normals), before)


def test_what_a_plugin_prints_is_no_answer_of_the_command(install, capsys) -> None:
    text = HEIGHT.format(name="Hgt").replace("return surface", "print('computing'); return surface")
    install("heights", f"print('loading'){text}", descriptors="HEIGHT")
    all_descriptors()[-1].compute(Surface(lump()))
    assert capsys.readouterr() == ("", "loading\ncomputing\n")


def test_maps_are_not_called_as_something_else_is(install) -> None:
    text = """
from shapeviz_report.projections import Method
M = Method("Best", "Best of all", "All is well.", 3, print, None)
"""
    install("bests", text, projections="M")
    with pytest.raises(PluginError, match=r"bests 1\.0 cannot be used: pages call something else 'Best'"):
        with_plugins("shapeviz_report.projections", PROJECTIONS, Method, projections._prepare)


def test_what_a_plugin_says_of_a_mesh_is_passed_on(install) -> None:
    text = "from shapeviz_report.errors import MeshError\n" + HEIGHT.format(name="Hgt")
    flat = text.replace("return surface.vertices[:, 2:]", "raise MeshError('it is too flat')")
    install("heights", flat, descriptors="HEIGHT")
    with pytest.raises(MeshError, match="it is too flat"):
        all_descriptors()[-1].compute(Surface(lump()))


def test_layouts_of_plugins_are_asked_first(install, tmp_path) -> None:
    text = """
from shapeviz_report.database import Layout
class Odd(Layout):
    name, description = "odd", "an odd one"
    def recognises(self, path, outside): return True
    def read(self, path, outside): return None
ODD = Odd()
"""
    install("odd-layout", text, layouts="ODD")
    found = with_plugins("shapeviz_report.layouts", LAYOUTS, Layout, layouts._prepare, first=True)
    assert [layout.name for layout in found] == ["odd", *(layout.name for layout in LAYOUTS)]
    assert found[0].recognises(tmp_path, False)
    with pytest.raises(PluginError, match=r"odd-layout 1\.0 failed: what it gives is of the type NoneType"):
        found[0].read(tmp_path, False)


def test_words_that_fail_are_told_with_their_package(install, monkeypatch) -> None:
    text = """
import numpy as np
from shapeviz_report.wording.base import Wording
Hgt = Wording("height", ("height",), ("the height",), "", np.asarray, "low", "high", (("low", "high"),), 1.0,
              lambda dimension, low, high: "high")
"""
    install("heights", HEIGHT.format(name="Hgt") + text, descriptors="HEIGHT", wordings="Hgt")
    monkeypatch.setattr(wordings, "ALL_DESCRIPTORS", all_descriptors())
    words = wordings.all_wordings.__wrapped__()["Hgt"]
    with pytest.raises(PluginError, match=r"'Hgt' of the package heights 1\.0 failed: .* str, not Said"):
        words.say(0, 0.1, 0.2)


SHAPES = """
from pathlib import Path
from shapeviz_report.database import Layout
from shapeviz_report.types import Database, ShapeEntry
class Odd(Layout):
    name, description = "odd", "an odd one"
    def recognises(self, path, outside): return True
    def read(self, path, outside): return Database("d", path, "odd", tuple(ShapeEntry(*facts) for facts in FACTS))
ODD = Odd()
FACTS = """


@pytest.mark.parametrize(
    ("facts", "said"),
    [
        ("[('a', Path('a.off'), 'a'), ('a', Path('b.off'), 'b')]", "2 shapes have the id 'a'"),
        ("[(7, Path('a.off'), 'a')]", "of the shape 7 the id, the name, a label or metadata is no text"),
        ("[('a', Path('a.off'), 'a', {'class': 1})]", "of the shape 'a' the id, .* is no text"),
        ("[('a', 'a.off', 'a')]", "the path of the shape 'a' is of the type str"),
    ],
)
def test_shapes_of_a_layout_that_cannot_be_used(install, tmp_path, facts, said) -> None:
    install("odd-layout", SHAPES + facts, layouts="ODD")
    found = with_plugins("shapeviz_report.layouts", LAYOUTS, Layout, layouts._prepare, first=True)
    with pytest.raises(PluginError, match=rf"odd-layout 1\.0 failed: {said}"):
        found[0].read(tmp_path, False)


def test_shapes_of_a_layout_come_in_order(install, tmp_path) -> None:
    facts = "[(f'cup {n}', path / 'a.off', 'a') for n in (10, 2)]".replace("path", "Path()")
    install("odd-layout", SHAPES + facts, layouts="ODD")
    found = with_plugins("shapeviz_report.layouts", LAYOUTS, Layout, layouts._prepare, first=True)
    assert [shape.id for shape in found[0].read(tmp_path, False).shapes] == ["cup 2", "cup 10"]


def test_a_layout_without_a_name(install) -> None:
    install(
        "odd-layout", SHAPES.replace('name, description = "odd", ', "description = ") + "[]", layouts="ODD"
    )
    with pytest.raises(PluginError, match=r"odd-layout 1\.0 cannot be used: it has no 'name'"):
        with_plugins("shapeviz_report.layouts", LAYOUTS, Layout, layouts._prepare, first=True)


@pytest.mark.parametrize("lost", ["Name: heights\n", "Version: 1.0\n"])
def test_what_is_left_of_a_package(install, tmp_path, lost) -> None:
    # Once it is imported, as Dask does, it reads the metadata of all packages in its own way.
    pytest.importorskip("importlib_metadata")
    install("heights", HEIGHT.format(name="Hgt"), descriptors="HEIGHT")
    (metadata,) = tmp_path.glob("*.dist-info/METADATA")
    metadata.write_text(metadata.read_text().replace(lost, ""))
    find_plugins.cache_clear()
    with pytest.raises(PluginError, match=r"the package of the descriptor 'HEIGHT' .* no name or no version"):
        find_plugins()


def test_every_group_has_its_registry() -> None:
    for group, (_, module) in plugins.GROUPS.items():
        path = Path(plugins.__file__).parents[1] / (module.replace(".", "/") + ".py")
        assert f'"{group}"' in path.read_text(encoding="utf-8"), f"{path} takes up no {group}"


def test_a_plugin_that_is_imported_first() -> None:
    """It imports this package, which looks for plug-ins, which is it."""
    example = Path(__file__).parents[2] / "examples" / "plugin"
    code = f"import sys; sys.path.insert(0, {str(example)!r}); import shapeviz_example"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_kinds_of_a_group(install) -> None:
    install("words", "W = 1", wordings="W")
    with pytest.raises(PluginError, match="it is of the type int, not str or bytes"):
        load_plugins("shapeviz_report.wordings", (str, bytes))
