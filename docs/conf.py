"""How Sphinx makes the documentation's site of these documents; `make docs` runs it."""

import sys
from importlib import import_module
from pathlib import Path

from sphinx.application import Sphinx

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "extensions"))

from shapeviz_report import __version__  # noqa: E402

project = "shapeviz-report"
author = "The shapeviz-report authors"
copyright = author
version = release = __version__

root_doc = "index"
exclude_patterns = ["extensions"]
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.githubpages",  # a file without which GitHub Pages leaves folders like _static out
    "sphinx.ext.viewcode",
    "numpydoc",
    "commands",
    "formulas",
    "gallery",
    "titles",
]
smartquotes = False  # they would make one dash of the two of an option

# headings are linked to as on a host of repositories
myst_heading_anchors = 4
myst_enable_extensions = ["deflist"]

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True}
numpydoc_show_class_members = False
python_use_unqualified_type_names = True

html_domain_indices = False  # two modules are no index
html_math_renderer = "mathml"
html_theme = "pydata_sphinx_theme"
html_title = project
html_static_path = ["styles"]
html_css_files = ["docs.css"]
# the demo's sites, which `make docs` has built
html_extra_path = ["../build/live"]
html_context = {"default_mode": "auto"}
html_copy_source = False
html_show_search_summary = False  # a page that is opened from its folder may not read others
html_show_sourcelink = False
html_sidebars = {"index": [], "gallery": [], "tutorial": []}
html_theme_options = {
    "navbar_persistent": ["search-button"],
    "navbar_end": ["theme-switcher"],
    "header_links_before_dropdown": 7,
    "show_prev_next": False,
    "secondary_sidebar_items": {"**": ["page-toc"], "gallery": [], "index": []},
    "footer_start": ["copyright"],
    "footer_end": ["sphinx-version"],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}


def owner_of(app: Sphinx, module: str, name: str) -> str | None:
    """The module whose source has an object: that of the class for what it holds, also where a decorator made it."""
    return getattr(getattr(import_module(module), name.partition(".")[0], None), "__module__", None)


def setup(app: Sphinx) -> None:
    app.connect("viewcode-follow-imported", owner_of)
