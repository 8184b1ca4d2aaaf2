"""The documentation is built with a small demo in it: no warning, no link to nowhere, nothing asked of the network."""

from __future__ import annotations

import re
import subprocess
import sys
from html import unescape
from pathlib import Path

import pytest
from browsers import program
from PIL import Image, ImageChops
from playwright.sync_api import sync_playwright
from small_database import WITH_SEARCH
from sphinx.util.inventory import InventoryFile

import shapeviz_report
from shapeviz_report import errors, plugins, types
from shapeviz_report.cli.commands import COMMANDS
from shapeviz_report.config import Config
from shapeviz_report.demo import write_shape

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from links import faults_of_site  # noqa: E402

SHAPES = {"airplane": (0, 1), "bird": (0, 1), "cup": (0, 1), "human": (0, 3), "octopus": (0, 2)}
"""Of the demo, two of each class that the gallery leads to."""


@pytest.fixture(scope="module")
def documentation(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("documentation")
    for name, indices in SHAPES.items():
        for index in indices:
            write_shape(folder / "shapes", name, index)
    live = folder / "live"
    live.mkdir()
    for target, single_file in (("demo", False), ("report.html", True)):
        shapeviz_report.build(
            folder / "shapes", live / target, single_file=single_file, cache=folder / "cache", **WITH_SEARCH
        )
    command = ["-q", "-E", "-W", "--keep-going", "-d", folder / "doctrees", "-D", f"html_extra_path={live}"]
    made = subprocess.run(
        [sys.executable, "-m", "sphinx", *map(str, command), str(ROOT / "docs"), str(folder / "site")],
        capture_output=True,
        text=True,
    )
    assert (made.returncode, made.stderr) == (0, "")
    return folder / "site"


@pytest.fixture(scope="module")
def inventory(documentation) -> set[str]:
    """The names of Python that the reference has."""
    with (documentation / "objects.inv").open("rb") as file:
        found = InventoryFile.load(file, "", lambda base, path: path)
    return {name for kind, names in found.items() if kind.startswith("py:") for name in names}


def text_of(page: Path) -> str:
    return unescape(re.sub(r"<[^>]+>", "", page.read_text(encoding="utf-8")))


def test_links_lead_somewhere_and_nothing_is_asked_of_the_network(documentation) -> None:
    assert list(faults_of_site(documentation)) == []


def test_every_document_is_a_page(documentation) -> None:
    for document in (ROOT / "docs").rglob("*.md"):
        assert (documentation / document.relative_to(ROOT / "docs")).with_suffix(".html").is_file()


def test_links_to_documents_go_by_their_titles(documentation) -> None:
    page = (documentation / "using" / "learned-features.html").read_text(encoding="utf-8")
    assert re.search(
        r'href="\.\./method/method\.html"><span>Descriptors, maps, and the publication</span>', page
    )
    assert not re.search(r"\.md</(?:span|code)></a>", page)


def test_the_reference_has_every_public_name(inventory) -> None:
    own = {name: getattr(shapeviz_report, name) for name in shapeviz_report.__all__ if name != "__version__"}
    public = {f"{thing.__module__}.{name}" for name, thing in own.items() if name != "ShapeDescriptors"}
    public |= {"shapeviz_report.ShapeDescriptors", "shapeviz_report.config.Config"}
    public |= {f"shapeviz_report.types.{name}" for name in types.__all__}
    public |= {f"shapeviz_report.errors.{name}" for name in dir(errors) if name.endswith("Error")}
    assert public - inventory == set()


def test_the_reference_has_what_functions_give_back(inventory) -> None:
    for function in ("build", "check", "describe", "describe_database", "query"):
        given = getattr(shapeviz_report, function).__annotations__["return"]
        assert any(name.endswith(f".{given}") for name in inventory), given


def test_the_reference_has_the_parts_of_plugins(inventory) -> None:
    for kind, module in plugins.GROUPS.values():
        name = {"projection": "Method"}.get(kind, "".join(word.capitalize() for word in kind.split()))
        assert any(known.endswith(f".{name}") for known in inventory), module


def test_the_reference_has_every_command_and_option(documentation) -> None:
    page = documentation / "reference" / "commands.html"
    text = text_of(page)
    for command in COMMANDS:
        assert f'<section id="{command}">' in page.read_text(encoding="utf-8")
    for option in Config.__dataclass_fields__.values():
        assert f"--{option.name.replace('_', '-')}" in text
        assert option.metadata["help"].replace("`", "")[1:] in text


def test_the_gallery_shows_every_example_in_both_themes(documentation) -> None:
    page = (documentation / "gallery.html").read_text(encoding="utf-8")
    pictures = re.findall(r'class="only-(light|dark)" src="([^"]+)"', page)
    assert len(pictures) == 2 * len(re.findall("^```{example}", (ROOT / "docs/gallery.md").read_text(), re.M))
    for (_, light), (_, dark) in zip(pictures[::2], pictures[1::2], strict=True):
        with Image.open(documentation / light) as day, Image.open(documentation / dark) as night:
            assert ImageChops.difference(day.convert("L"), night.convert("L")).getextrema()[1] > 100


def test_pages_open_from_the_folder_and_ask_for_nothing_else(documentation) -> None:
    requests, complaints = [], []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=program("chromium-headless-shell"), args=["--no-sandbox"]
        )
        page = browser.new_page(viewport={"width": 390, "height": 844})
        page.on("request", lambda request: requests.append(request.url))
        page.on("pageerror", lambda error: complaints.append(str(error)))
        for name in ("index", "tutorial", "gallery", "reference/types"):
            page.goto((documentation / f"{name}.html").as_uri())
            assert page.evaluate("document.documentElement.scrollWidth") <= 390, name
        page.goto(f"{(documentation / 'search.html').as_uri()}?q=neighbourhood")
        page.wait_for_selector("#search-results li a")
        browser.close()
    assert complaints == []
    assert [url for url in requests if not url.startswith(("file:", "data:", "blob:"))] == []
