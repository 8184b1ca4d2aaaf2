"""Where the browser's side and the templates are: beside the package in a checkout, inside it in a wheel."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]


def _find(installed: str, checkout: str) -> Path:
    for folder in (_PACKAGE / installed, _PACKAGE.parent / checkout):
        if folder.is_dir():
            return folder
    raise FileNotFoundError(
        f"shapeviz_report is incomplete: neither {installed}/ nor ../{checkout}/ is there"
    )


def site_folder() -> Path:
    """Scripts, styles and vendored files."""
    return _find("_site", "site")


def templates_folder() -> Path:
    """Jinja2 templates."""
    return _find("_templates", "templates")
