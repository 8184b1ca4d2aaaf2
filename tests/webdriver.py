"""Browsers driven by the commands of WebDriver (W3C), which they all understand, over the two wires they come by."""

from __future__ import annotations

import json
import socket
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

import numpy as np


class WebDriverError(Exception):
    """What a browser answered instead of doing what it was asked for."""


class Wire(Protocol):
    """Carries a command, by its name in the standard, to a browser and its answer back."""

    def send(self, command: str, parameters: Mapping[str, Any]) -> Any: ...


#: The commands in use, and where a driver listens for them.
ADDRESSES = {
    "NewSession": ("POST", "/session"),
    "DeleteSession": ("DELETE", "/session/{session}"),
    "Navigate": ("POST", "/session/{session}/url"),
    "Back": ("POST", "/session/{session}/back"),
    "SetWindowRect": ("POST", "/session/{session}/window/rect"),
    "SwitchToFrame": ("POST", "/session/{session}/frame"),
    "ExecuteAsyncScript": ("POST", "/session/{session}/execute/async"),
    "PerformActions": ("POST", "/session/{session}/actions"),
}


class Http:
    """The wire of the standard, to a driver such as ``chromedriver`` or ``WebKitWebDriver``."""

    def __init__(self, port: int) -> None:
        socket.create_connection(("127.0.0.1", port)).close()
        self.root = f"http://127.0.0.1:{port}"
        self.session = ""

    def send(self, command: str, parameters: Mapping[str, Any]) -> Any:
        method, address = ADDRESSES[command]
        request = urllib.request.Request(
            self.root + address.format(session=self.session),
            json.dumps(parameters).encode() if method == "POST" else None,
            {"Content-Type": "application/json"},
            method=method,
        )
        try:
            with urllib.request.urlopen(request, timeout=90) as response:
                value = json.load(response)["value"]
        except urllib.error.HTTPError as error:
            problem = json.load(error)["value"]
            raise WebDriverError(f"{problem['error']}: {problem['message']}") from None
        if command == "NewSession":
            self.session = value["sessionId"]
        return value


class Marionette:
    """The wire that Firefox has built in: the same commands, as lines of ``LENGTH:JSON`` over a socket."""

    def __init__(self, port: int) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=90)
        self.stream = self.socket.makefile("rb")
        self.number = 0
        self._receive()

    def send(self, command: str, parameters: Mapping[str, Any]) -> Any:
        self.number += 1
        message = json.dumps([0, self.number, f"WebDriver:{command}", parameters])
        self.socket.sendall(f"{len(message)}:{message}".encode())
        _, number, problem, answer = self._receive()
        assert number == self.number
        if problem:
            raise WebDriverError(f"{problem['error']}: {problem['message']}")
        return answer["value"] if set(answer) == {"value"} else answer

    def _receive(self) -> Any:
        length = b""
        while (digit := self.stream.read(1)) != b":":
            length += digit
        return json.loads(self.stream.read(int(length)))


#: Answers with what a function of the page gives, once it is there, or with why there is none.
CALL = """const [values, answer] = arguments;
new Promise((resolve) => resolve((FUNCTION)(...values)))
  .then((value) => answer({ value: value ?? null }), (error) => answer({ error: String(error) }));"""

#: The middle of an element on the screen, once it is scrolled into view.
MIDDLE = """(selector, text) => {
  const found = [...document.querySelectorAll(selector)].find((node) => node.textContent.includes(text));
  if (!found) return null;
  found.scrollIntoView({ block: "nearest", inline: "nearest" });
  const { left, top, width, height } = found.getBoundingClientRect();
  return width && height ? [left + width / 2, top + height / 2] : null;
}"""

KEYS = {"Tab": "\ue004", "Enter": "\ue007", "Escape": "\ue00c", "ArrowRight": "\ue014"}


class Window:
    """A window of a browser, used as a reader uses it: by pointing, typing and looking.

    ``screen`` takes a picture of all that the window lies on, from its upper left corner.
    """

    def __init__(self, wire: Wire, screen: Callable[[], np.ndarray]) -> None:
        self.wire = wire
        self.screen = screen

    def visit(self, address: str) -> None:
        """Load a page, whatever was there before."""
        # From one address of a page to another, a browser does not load it again.
        self.wire.send("Navigate", {"url": "about:blank"})
        self.wire.send("Navigate", {"url": address})

    def enter(self, frame: int) -> None:
        """Go on in a frame of the document, by its number from 0."""
        self.wire.send("SwitchToFrame", {"id": frame})

    def leave(self) -> None:
        """Go on in the page itself."""
        self.wire.send("SwitchToFrame", {"id": None})

    def back(self) -> None:
        self.wire.send("Back", {})

    def evaluate(self, function: str, *values: Any) -> Any:
        """What a function gives in the page, or what it promises."""
        script = CALL.replace("FUNCTION", function)
        found = self.wire.send("ExecuteAsyncScript", {"script": script, "args": [list(values)]})
        if found is None or "error" in found:  # None from Firefox while a page gives way to another
            raise WebDriverError(found and found["error"])
        return found["value"]

    def until(self, function: str, *values: Any, seconds: float = 30) -> Any:
        """Wait until a function gives what counts as true, and return that; fails if it does not come."""
        end = time.monotonic() + seconds
        while True:
            try:
                found = self.evaluate(function, *values)
            except WebDriverError as error:  # as while a page gives way to another
                found, problem = None, str(error)
            else:
                problem = f"{found!r}"
            if found:
                return found
            assert time.monotonic() < end, f"{problem} after {seconds} seconds: {function} {values}"
            time.sleep(0.03)

    def wait_for_timeout(self, milliseconds: float) -> None:
        time.sleep(milliseconds / 1000)

    def text(self, selector: str) -> str:
        return self.evaluate("(selector) => document.querySelector(selector).innerText", selector)

    def click(self, selector: str, text: str = "") -> None:
        """Click the first such element whose text holds ``text``, as soon as it is seen."""
        x, y = self.until(MIDDLE, selector, text)
        self.drag([(x, y)])

    def point(self, x: float, y: float) -> None:
        self._pointer([self._move(x, y)])

    def drag(self, places: Sequence[tuple[float, float]]) -> None:
        """Press the mouse at the first place, and let it go at the last."""
        moves = [self._move(*place) for place in places]
        button = {"button": 0}
        down, up = {"type": "pointerDown", **button}, {"type": "pointerUp", **button}
        self._pointer([moves[0], down, *moves[1:], up])

    def wheel(self, x: float, y: float, by: int) -> None:
        scroll = {"type": "scroll", "x": round(x), "y": round(y), "deltaX": 0, "deltaY": by, "duration": 0}
        self._act({"type": "wheel", "id": "wheel", "actions": [scroll]})

    def press(self, *keys: str) -> None:
        """Press keys one after the other, each by its name or as what it types."""
        actions = [
            {"type": kind, "value": KEYS.get(key, key)} for key in keys for kind in ("keyDown", "keyUp")
        ]
        self._act({"type": "key", "id": "keyboard", "actions": actions})

    def picture(self) -> np.ndarray:
        """What is seen of the page; (h, w, 3)."""
        # What a browser shows besides a page lies above it.
        width, height, above = self.evaluate(
            """() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() =>
                done([innerWidth, innerHeight, outerHeight - innerHeight]))))"""
        )
        return self.screen()[above : above + height, :width]

    @staticmethod
    def _move(x: float, y: float) -> dict[str, Any]:
        return {"type": "pointerMove", "x": round(x), "y": round(y), "duration": 0, "origin": "viewport"}

    def _pointer(self, actions: list[dict[str, Any]]) -> None:
        mouse = {"pointerType": "mouse"}
        self._act({"type": "pointer", "id": "mouse", "parameters": mouse, "actions": actions})

    def _act(self, source: dict[str, Any]) -> None:
        self.wire.send("PerformActions", {"actions": [source]})
