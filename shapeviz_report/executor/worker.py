"""What runs in a worker process of :class:`~shapeviz_report.executor.local.LocalExecutor`."""

from __future__ import annotations

import pickle
import signal
import sys
import time
import traceback
from multiprocessing.connection import Connection

from shapeviz_report.errors import ShapevizError


def serve(descriptor: int) -> None:
    """The life of a worker: take a task, answer with (value, error, CPU seconds), until the pipe closes."""
    # Ctrl-C reaches every process of the terminal; the parent alone decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    connection = Connection(descriptor)
    reported = 0.0
    while True:
        try:
            function, task = connection.recv()
        except (EOFError, ConnectionError):
            return
        value, error = None, None
        try:
            value = function(*task)
        except Exception as exception:
            error = _portable(exception)
        spent = time.process_time()
        try:
            connection.send((value, error, spent - reported))
        except ConnectionError:
            return
        reported = spent


def _portable(exception: Exception) -> Exception:
    """An exception as it can travel, with its traceback as a note."""
    if not isinstance(exception, ShapevizError):
        exception.add_note("".join(traceback.format_exception(exception)))
    try:
        pickle.loads(pickle.dumps(exception))
    except Exception:
        return RuntimeError("".join(traceback.format_exception(exception)))
    return exception


if __name__ == "__main__":
    serve(int(sys.argv[1]))
