"""The command line: arguments in, messages and an exit code out."""

from __future__ import annotations

import io
import logging
import os
import sys
from collections.abc import Sequence
from contextlib import suppress

from shapeviz_report.cli.arguments import command_parser
from shapeviz_report.cli.commands import COMMANDS
from shapeviz_report.cli.terminal import LogFormatter, OutputError, Patient, complain
from shapeviz_report.ending import STOPPED, listening
from shapeviz_report.errors import ShapevizError
from shapeviz_report.imports import import_numba


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    with listening():
        return _run(arguments)


def _run(arguments: Sequence[str] | None) -> int:
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # as `>&-` has it
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif isinstance(stream, io.TextIOWrapper):
            # names of a database may have letters that a terminal has not
            stream.reconfigure(errors="backslashreplace")
    try:
        options = command_parser().parse_args(arguments)
        handler = logging.StreamHandler(Patient(sys.stderr))
        handler.setFormatter(LogFormatter("%(levelname)s: %(message)s"))
        # what Dask logs of a cluster that fails, as tracebacks, ends the build with a sentence of ours
        handler.addFilter(lambda record: record.name.partition(".")[0] != "distributed")
        logging.basicConfig(level=logging.WARNING, handlers=[handler])
        import_numba()
        return COMMANDS[options.command](options)
    except ShapevizError as error:
        first, *rest = error.lines
        complain(f"shapeviz-report: {first}", *rest)
        return 1
    except MemoryError:
        complain(
            "shapeviz-report: the memory of this machine does not suffice. What was computed is kept: end other "
            "programs, or use fewer --jobs, and the same command continues."
        )
        return 1
    except KeyboardInterrupt:
        complain("", STOPPED)
        return 130
    except OutputError as error:
        # Whoever reads no further, as `head`, wants no words.
        if not isinstance(error.__cause__, BrokenPipeError):
            complain(f"shapeviz-report: what there is to say cannot be written: {error}")
        return 1
    finally:
        # What follows is the end of Python, where nobody could say what went wrong.
        for stream in (sys.stdout, sys.stderr):
            try:
                stream.flush()
            except OSError:
                with suppress(OSError):
                    stream.close()
