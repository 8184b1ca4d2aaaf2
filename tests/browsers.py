"""Three browsers, each started from Debian's packages on a screen that nobody sees."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import struct
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from webdriver import Http, Marionette, Window, Wire

#: Debian's packages, each with the names that systems give the program in it.
PACKAGES = {
    # The same engine without windows, for tests of Chromium alone: it opens a page in less than half the time.
    "chromium-headless-shell": ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"),
    "chromium": ("chromium", "chromium-browser", "google-chrome"),
    "chromium-driver": ("chromedriver",),
    "firefox-esr": ("firefox-esr", "firefox"),
    "webkit2gtk-driver": ("WebKitWebDriver",),
    "xvfb": ("Xvfb",),
}

#: Room for a page of about 1440 x 900 and the browser's own bars.
SIZE = {"x": 0, "y": 0, "width": 1440, "height": 1000}

#: A reader who asks for less movement, so that a step is done when it is drawn; and nothing asks the network.
FIREFOX = {"marionette.port": 0, "ui.prefersReducedMotion": 1, "services.settings.server": "data:,"}
CHROMIUM = ["--no-sandbox", "--force-prefers-reduced-motion", "--enable-unsafe-swiftshader"]
GTK = "[Settings]\ngtk-enable-animations=0\n"


@contextmanager
def chromium(folder: Path, environment: Mapping[str, str]) -> Iterator[Wire]:
    binary = program("chromium")
    port = free_port()
    with running([program("chromium-driver"), f"--port={port}"], folder, environment):
        wire = reached(lambda: Http(port))
        wire.send("NewSession", wanted({"goog:chromeOptions": {"binary": binary, "args": CHROMIUM}}))
        yield wire
        wire.send("DeleteSession", {})


@contextmanager
def firefox(folder: Path, environment: Mapping[str, str]) -> Iterator[Wire]:
    profile = folder / "profile"
    profile.mkdir()
    (profile / "user.js").write_text(
        "".join(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in FIREFOX.items())
    )
    command = [program("firefox-esr"), "--marionette", "--no-remote", "--profile", str(profile)]
    with running(command, folder, environment):
        # Firefox takes a free port, and writes down which.
        wire = reached(lambda: Marionette(int((profile / "MarionetteActivePort").read_text())))
        wire.send("NewSession", wanted({}))
        yield wire


@contextmanager
def webkit(folder: Path, environment: Mapping[str, str]) -> Iterator[Wire]:
    settings = folder / "gtk-3.0" / "settings.ini"
    settings.parent.mkdir()
    settings.write_text(GTK)
    port = free_port()
    # Layers that are put together by a graphics card have none here.
    own = {"XDG_CONFIG_HOME": str(folder), "WEBKIT_DISABLE_COMPOSITING_MODE": "1"}
    with running([program("webkit2gtk-driver"), f"--port={port}"], folder, {**environment, **own}):
        wire = reached(lambda: Http(port))
        wire.send("NewSession", wanted({}))
        yield wire
        wire.send("DeleteSession", {})


BROWSERS: dict[str, Callable] = {"Chromium": chromium, "Firefox": firefox, "WebKit": webkit}


@contextmanager
def opened(name: str, folder: Path) -> Iterator[Window]:
    """The window of a browser of ``BROWSERS``, which keeps its files in ``folder``."""
    folder.mkdir()
    with screen(folder) as (display, picture):
        environment = {**os.environ, "DISPLAY": display, "GDK_BACKEND": "x11", "MOZ_ENABLE_WAYLAND": "0"}
        with BROWSERS[name](folder, environment) as wire:
            wire.send("SetWindowRect", SIZE)
            yield Window(wire, picture)


@contextmanager
def screen(folder: Path) -> Iterator[tuple[str, Callable[[], np.ndarray]]]:
    """A screen in memory: the name of its display, and what takes a picture of it."""
    read, write = os.pipe()
    size = f"{SIZE['width']}x{SIZE['height']}x24"
    command = [program("xvfb"), "-displayfd", str(write), "-screen", "0", size, "-fbdir", str(folder)]
    with running(command, folder, os.environ, pass_fds=[write]), os.fdopen(read) as told:
        os.close(write)
        number = told.readline().strip()
        assert number, (folder / "Xvfb.txt").read_text()
        yield f":{number}", lambda: read_dump((folder / "Xvfb_screen0").read_bytes())


def read_dump(dump: bytes) -> np.ndarray:
    """A picture in the format of ``xwd``, of four bytes a pixel; (h, w, 3)."""
    header = struct.unpack(">25I", dump[:100])
    width, height, line, colours = header[4], header[5], header[12], header[19]
    pixels = np.frombuffer(dump, np.uint8, height * line, header[0] + 12 * colours)
    return pixels.reshape(height, -1, 4)[:, :width, 2::-1].astype(float)


def wanted(capabilities: Mapping[str, Any]) -> dict[str, Any]:
    return {"capabilities": {"alwaysMatch": {"timeouts": {"script": 60_000}, **capabilities}}}


def program(package: str) -> str:
    """Where the program of a package is."""
    if path := found(package):
        return path
    raise FileNotFoundError(f"the browser tests need this installed: {' '.join(missing())}")


def found(package: str) -> str | None:
    return next(filter(None, map(shutil.which, PACKAGES[package])), None)


def missing(packages: Iterable[str] = PACKAGES) -> list[str]:
    return [package for package in packages if not found(package)]


@contextmanager
def running(
    command: list[str], folder: Path, environment: Mapping[str, str], **options: Any
) -> Iterator[subprocess.Popen]:
    """A program with all that it starts in turn; what it says goes into ``NAME.txt`` in the folder."""
    with (folder / f"{Path(command[0]).name}.txt").open("wb") as said:
        process = subprocess.Popen(
            command, env=environment, stdout=said, stderr=said, start_new_session=True, **options
        )
        try:
            yield process
        finally:
            os.killpg(process.pid, signal.SIGTERM)
            process.wait()


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        return server.getsockname()[1]


def reached(connected: Callable[[], Wire], seconds: float = 60) -> Wire:
    """The wire to a program that is about to listen."""
    end = time.monotonic() + seconds
    while True:
        try:
            return connected()
        except (OSError, ValueError):
            if time.monotonic() > end:
                raise
            time.sleep(0.05)


if __name__ == "__main__":
    print(*missing(sys.argv[1:] or PACKAGES))
