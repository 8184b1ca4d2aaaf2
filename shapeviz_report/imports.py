"""Where modules may come from: not from the current folder, which may be a database of strangers."""

from __future__ import annotations

import os
import site
import sys


def trusted_path() -> list[str]:
    """``sys.path`` without the current folder and without what ``PYTHONPATH`` names relative to it.

    Folders where packages are installed stay, wherever one stands. The folder of this package comes last if it is none
    of those left: whoever runs it from there means it, but no other module there.
    """
    here = os.path.realpath(os.curdir)
    relative = {
        os.path.realpath(entry)
        for entry in os.environ.get("PYTHONPATH", "").split(os.pathsep)
        if not os.path.isabs(entry)
    }
    installed = {os.path.realpath(path) for path in (*site.getsitepackages(), os.path.dirname(os.__file__))}
    refused = (relative | {here}) - installed
    kept = [entry for entry in sys.path if os.path.isabs(entry) and os.path.realpath(entry) not in refused]
    own = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    return kept if own in kept else [*kept, own]


def import_numba() -> None:
    """Import numba without the ``.numba_config.yaml`` of the current folder, which it obeys when it is imported and
    whenever it compiles, and which can name a folder of machine code to run.
    """
    here, own = os.getcwd(), os.path.dirname(os.path.abspath(__file__))
    os.chdir(own)
    try:
        from numba.core import config
    finally:
        os.chdir(here)
    config._config_fname = os.path.join(own, config._config_fname)


def is_program() -> bool:
    """Whether this process is the command, and not somebody's script that uses the package."""
    if sys.argv[:1] == ["-m"]:
        # so it is while `python -m NAME` looks for the module
        return any(word.removeprefix("-m").split(".")[0] == "shapeviz_report" for word in sys.orig_argv[1:])
    return os.path.basename(sys.argv[0] if sys.argv else "").removesuffix(".exe") == "shapeviz-report"
