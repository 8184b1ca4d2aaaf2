"""A page of a real site with the engine at hand: numpy arrays go in and come out."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Page

from shapeviz_report.writing.joiner import join

ENTRY = Path(__file__).parent / "browser" / "engine.js"


class EnginePage:
    """The engine in a worker of a page that was opened from ``file://``, under the site's own policies."""

    def __init__(self, page: Page) -> None:
        self.page = page
        page.evaluate(join(ENTRY))

    def start(self, values: np.ndarray, blocks: np.ndarray | None = None, scaling: str = "balanced") -> None:
        """Start the engine on a table as :func:`make_table` makes it."""
        self.call("start", make_table(values, blocks, scaling))

    def run(self, task: str, **parameters: Any) -> Any:
        """The result of a task; arrays of floats and of integers arrive as such."""
        return self.run_with_reports(task, **parameters)[0]

    def run_with_reports(self, task: str, **parameters: Any) -> tuple[Any, list[Any]]:
        """The result of a task, and what it reported on its way."""
        answer = self.call("run", task, parameters)
        return answer["result"], answer["reports"]

    def call(self, name: str, *arguments: Any) -> Any:
        """Call a function of browser/engine.js."""
        return _receive(
            self.page.evaluate(f"(given) => engine.{name}(...given)", [_send(item) for item in arguments])
        )


def make_table(
    values: np.ndarray, blocks: np.ndarray | None = None, scaling: str = "balanced"
) -> dict[str, Any]:
    """Compared values (n, d) as the engine takes them; without ``blocks`` they are of one feature."""
    rows, columns = values.shape
    features = 1 if blocks is None else int(blocks.max()) + 1
    return {
        "rows": rows,
        "columns": columns,
        "steps": values.T.astype(np.float32).ravel(),
        "most": 1,
        "low": [0.0] * features,
        "high": [1.0] * features,
        "blocks": np.zeros(columns, np.int32) if blocks is None else blocks.astype(np.int32),
        "weights": [1.0] * features,
        "scaling": scaling,
    }


def _send(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        if value.dtype.kind in "iub":
            value = value.astype(np.int32)
        return {"kind": value.dtype.name, "bytes": base64.b64encode(value.tobytes()).decode()}
    if isinstance(value, dict):
        return {name: _send(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_send(item) for item in value]
    return value.item() if isinstance(value, np.generic) else value


def _receive(value: Any) -> Any:
    if isinstance(value, dict):
        if "kind" in value:
            return np.frombuffer(base64.b64decode(value["bytes"]), value["kind"])
        return {name: _receive(item) for name, item in value.items()}
    if isinstance(value, list):
        return [_receive(item) for item in value]
    return value
