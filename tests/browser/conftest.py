"""A real Chromium that opens real sites, and reports everything it should not see."""

from __future__ import annotations

import functools
import http.server
import pickle
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from browsers import program
from engine_page import EnginePage
from playwright.sync_api import Browser, Page, sync_playwright
from reports import (
    NASTY_LABELS,
    make_report,
    multiplied,
    with_best,
    with_bin_search,
    with_bins,
    with_clusters,
    with_columns,
    with_copies,
    with_exported,
    with_external,
    with_labeling,
    with_models,
    with_own_map,
    with_paintings,
    with_parents,
    with_publication,
    with_retrieval,
    with_scores,
    with_search,
    with_searched_sample,
    with_strewn_map,
    without_gain,
)
from together import alone

from shapeviz_report.types import Report
from shapeviz_report.writing import write_site

FEATURES = ("Gc", "Sc", "PFH", "FPFH")
#: Names with which no line of a page is broken where it would be, or that go on to the left.
LONG_LABELS = (
    "Donaudampfschifffahrtselektrizitätenhauptbetriebswerkbauunterbeamtengesellschaft",
    "a_class_with_underscores_and_no_spaces_whatsoever_in_its_very_long_name",
    "كرسي مكتب ذو مسند ظهر مرتفع جدا ومسندين للذراعين وعجلات",
    "כיסא משרדי עם משענת גב גבוהה מאוד ושתי משענות יד",
)
NASTY_FEATURES = ("Gc", "<b>50 %</b> & more", "עברית ימין", "a feature name without an end " * 3)


def with_everything(report: Report) -> Report:
    """The report with all that a build can find in it."""
    for add in (
        with_clusters,
        with_search,
        with_bin_search,
        with_retrieval,
        with_paintings,
        with_models,
        with_external,
        with_scores,
    ):
        report = add(report)
    return report


SITES = {
    "plain": lambda: make_report(
        [f"kind {letter}" for letter in "abcdefghijkl"], 10, name="Twelve kinds", metadata={"artist": "N. N."}
    ),
    "nasty": lambda: make_report([*NASTY_LABELS, None], 4, name='<img src=x onerror="alert(1)">'),
    "very many": lambda: multiplied(
        make_report(["ant", None, "cup"], 4, name="Very many", methods=("tsne",)), 1000
    ),
    "published": lambda: with_publication(make_report(["ant", "bird", "cup"], 6, name="Vessels")),
    "one shape": lambda: make_report(["ant"], 1),
    "one class": lambda: make_report(["ant"], 12),
    "few": lambda: with_scores(
        with_search(make_report([f"kind {letter}" for letter in "abcd"], 2, features=FEATURES[:2]))
    ),
    "few bins": lambda: with_bin_search(make_report([f"kind {letter}" for letter in "abcd"], 2)),
    "six": lambda: make_report(["ant", "bird", "cup"], 2),
    "one class searched": lambda: with_search(make_report(["ant"], 24, features=FEATURES[:2])),
    "no labels": lambda: make_report([None, None], 12),
    "clusters": lambda: with_clusters(make_report([None] * 4, 8, features=FEATURES[:3])),
    "clusters searched": lambda: with_scores(
        with_retrieval(
            with_bin_search(with_search(with_clusters(make_report([None] * 4, 8, features=FEATURES))))
        )
    ),
    "many classes": lambda: make_report([f"class {number:02}" for number in range(45)], 4),
    "own map": lambda: with_exported(
        with_own_map(
            with_search(make_report([f"kind {letter}" for letter in "abcde"], 10, features=FEATURES))
        )
    ),
    "searched": lambda: with_search(
        make_report([f"kind {letter}" for letter in "abcde"], 10, features=FEATURES)
    ),
    "searched with others": lambda: with_search(
        make_report([f"kind {letter}" for letter in "abcde"], 10, features=("Gc", "own", "Sc", "PFH"))
    ),
    "nasty features": lambda: with_search(make_report([*NASTY_LABELS, None], 4, features=NASTY_FEATURES)),
    "searched without labels": lambda: with_search(make_report([None], 24, features=FEATURES[:3])),
    "sampled": lambda: with_best(
        with_search(make_report(["ant", "bird"], 20, features=FEATURES[:3]), limit=24)
    ),
    "refused": lambda: with_search(
        make_report(["ant", "bird", "cup"], 6, features=[f"own {number}" for number in range(11)])
    ),
    "chosen bins": lambda: with_bins(
        with_search(make_report([f"kind {letter}" for letter in "abcde"], 10, features=FEATURES)),
        ("Gc:3", "PFH:10"),
    ),
    "workbench": lambda: with_scores(
        with_search(make_report([f"kind {letter}" for letter in "abcde"], 16, features=FEATURES[:3]))
    ),
    "nasty workbench": lambda: with_scores(make_report([*NASTY_LABELS, None], 4, features=NASTY_FEATURES)),
    "bins": lambda: with_external(
        with_models(with_paintings(with_bin_search(make_report(["ant", "bird", "cup", "fish"], 8))))
    ),
    "everything": lambda: with_everything(
        make_report(
            [*NASTY_LABELS, None],
            4,
            name="Everything at once",
            features=NASTY_FEATURES,
            metadata={"artist": "N. N.", "year": "1902"},
        )
    ),
    "long names": lambda: with_everything(make_report([*LONG_LABELS, None], 6, features=FEATURES)),
    "long texts": lambda: with_columns(
        with_labeling(make_report(["ant", "bird"], 6), "author", ["Ada", "Bob"] * 6),
        {"author": ["Ada", "Bob"] * 6, "note": ["Lorem ipsum dolor sit amet. " * 40] * 12},
    ),
    "museum": lambda: with_columns(
        with_parents(
            make_report(["ant", "bee", "cup", "plate", "table", None], 24, name="A museum"),
            {
                "ant": "insects",
                "bee": "insects",
                "cup": "tableware",
                "plate": "tableware",
                "tableware": "household",
            },
        ),
        {
            "place": ["Delft", "Kyoto", "Münster"] * 48,
            "year": [str(1400 + 3 * row) if row % 6 else "" for row in range(144)],
            "inventory": [f"K-{row:04}" for row in range(144)],
        },
    ),
    "bins that pay": lambda: with_strewn_map(SITES["bins"]()),
    "bins that pay nothing": lambda: without_gain(with_strewn_map(SITES["bins"]())),
    "bins of a sample": lambda: with_searched_sample(SITES["bins that pay"]()),
    "copied": lambda: with_copies(
        with_bin_search(with_search(with_retrieval(make_report(["ant", "bird"], 8)))),
        [(0, 3), (3, 5), (8, 9)],
    ),
    "large": lambda: make_report([f"class {number}" for number in range(8)], 250, methods=("tsne", "pca")),
}


@dataclass
class Watch:
    """What a page did that a reader would not see: requests, complaints of the browser, errors."""

    requests: list[str] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)


def hear(watch: Watch, text: str) -> None:
    # What Chromium's own renderer says of a picture that a test takes of a 3D view.
    if "GPU stall due to ReadPixels" not in text:
        watch.complaints.append(text)


def watched(page: Page) -> Page:
    """Give a page its ``watch``."""
    page.watch = Watch()
    page.on("request", lambda request: page.watch.requests.append(request.url))
    page.on("console", lambda message: hear(page.watch, message.text))
    page.on("pageerror", lambda error: page.watch.complaints.append(str(error)))
    page.on("dialog", lambda dialog: page.watch.complaints.append(f"dialog: {dialog.message}"))
    return page


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        yield playwright.chromium.launch(
            executable_path=program("chromium-headless-shell"), args=["--no-sandbox"]
        )


@pytest.fixture(scope="session")
def reports(shared_folder) -> Callable[[str], Report]:
    """The report of a site of ``SITES``, made when first asked for."""

    @functools.cache
    def report(name: str) -> Report:
        file = shared_folder / "reports" / f"{name.replace(' ', '-')}.pickle"
        with alone(file):
            if not file.exists():
                file.write_bytes(pickle.dumps(SITES[name]()))
            return pickle.loads(file.read_bytes())

    return report


@pytest.fixture(scope="session")
def site(shared_folder, reports) -> Callable[[str], Path]:
    """The folder of a site of ``SITES``, written when first asked for."""

    @functools.cache
    def folder(name: str) -> Path:
        destination = shared_folder / "sites" / name.replace(" ", "-")
        with alone(destination):
            if not destination.exists():
                write_site(reports(name), destination)
        return destination

    return folder


@pytest.fixture(scope="session")
def single_file(shared_folder, reports) -> Callable[[str], Path]:
    """A site of ``SITES`` in one file, written when first asked for."""

    @functools.cache
    def file(name: str) -> Path:
        destination = shared_folder / "single" / f"{name.replace(' ', '-')}.html"
        with alone(destination):
            if not destination.exists():
                write_site(reports(name), destination, single_file=True)
        return destination

    return file


@pytest.fixture
def open_page(browser, site, serve) -> Iterator[Callable[..., Page]]:
    """Open a page of a site from ``file://`` and wait until it is drawn.

    The reader is one who asks for less movement, so that a step is done when it is drawn; tests of the
    movements ask for them with ``reduced_motion="no-preference"``.

    Servers end after the pages, which may still be reading.

    ``watch`` of the page collects its requests and complaints; a complaint nobody expects fails the test.
    """
    contexts = []
    watches = []

    def open_(name: str, file: str = "index.html", address: str | None = None, **options) -> Page:
        context = browser.new_context(
            **({"viewport": {"width": 1440, "height": 900}, "reduced_motion": "reduce"} | options)
        )
        contexts.append(context)
        page = watched(context.new_page())
        watches.append(page.watch)
        page.goto(address or f"{site(name).as_uri()}/{file}")
        if not file.startswith("about.html"):
            page.wait_for_selector("html[data-ready]", state="attached")
        return page

    yield open_
    for context in contexts:
        context.close()
    assert [watch.complaints for watch in watches if watch.complaints] == []


@pytest.fixture(scope="module")
def engine_page(browser, site) -> Iterator[EnginePage]:
    """A page from ``file://`` with the engine of ``site/scripts/engine``, one for all tests of a module.

    Every test starts the engine on values of its own. A complaint nobody expects fails the module.
    """
    page = watched(browser.new_page())
    page.goto(f"{site('one shape').as_uri()}/about.html")
    yield EnginePage(page)
    page.close()
    assert page.watch.complaints == []


@pytest.fixture
def serve() -> Iterator[Callable[[Path, str], str]]:
    """Serve a folder over HTTP below a path; returns the address of the folder."""
    servers = []

    def start(folder: Path, below: str) -> str:
        class Handler(http.server.SimpleHTTPRequestHandler):
            def translate_path(self, path):
                prefix = f"/{below}/"
                return (
                    super().translate_path(path.removeprefix(prefix))
                    if path.startswith(prefix)
                    else "/nowhere"
                )

            def guess_type(self, path):
                kind = super().guess_type(path)
                # As some hosts call all text, whatever letters it is in.
                is_text = kind.startswith("text/") or kind.endswith("javascript")
                return f"{kind}; charset=iso-8859-1" if is_text else kind

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(
            ("127.0.0.1", 0), functools.partial(Handler, directory=str(folder))
        )
        threading.Thread(target=server.serve_forever, daemon=True).start()
        servers.append(server)
        return f"http://127.0.0.1:{server.server_port}/{below}"

    yield start
    for server in servers:
        server.shutdown()
        server.server_close()
