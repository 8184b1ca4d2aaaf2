"""What runs in a worker process of :class:`~shapeviz_report.executor.local.LocalExecutor`."""

from __future__ import annotations

import errno
import os
import pickle
import select
import signal
import sys
import threading
import time
import traceback
from multiprocessing.connection import Connection

from shapeviz_report.ending import ASKING
from shapeviz_report.errors import ShapevizError


def serve(descriptor: int) -> None:
    """The life of a worker: take a task, answer with (value, error, CPU seconds), until the pipe closes."""
    # Ctrl-C reaches every process of the terminal; the parent alone decides what it means.
    for number in ASKING:
        signal.signal(number, signal.SIG_IGN if number == signal.SIGINT else signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, ASKING)
    _end_with_parent()
    connection = Connection(descriptor)
    tasks = os.fdopen(descriptor, "rb", closefd=False)
    reported = 0.0
    while True:
        try:
            function, task = pickle.load(tasks)
        except (EOFError, ConnectionError, pickle.UnpicklingError):
            return
        except MemoryError as error:
            # The rest of the task is still in the pipe, so this is the last answer.
            connection.send((None, _portable(error), 0.0))
            return
        try:
            answer = pickle.dumps((function(*task), None, time.process_time() - reported))
        except Exception as exception:
            answer = pickle.dumps((None, _portable(exception), time.process_time() - reported))
        reported = time.process_time()
        try:
            connection.send_bytes(answer)
        except ConnectionError:
            return


def _end_with_parent() -> None:
    """End this process as soon as its standard input closes, for then its parent has ended.

    On Linux the kernel does it, by a signal that ends a process also in the middle of native code; elsewhere a
    thread, which waits while native code holds the interpreter.
    """
    if sys.platform == "linux":
        import fcntl

        signal.signal(signal.SIGIO, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGIO])
        fcntl.fcntl(0, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(0, fcntl.F_SETFL, fcntl.fcntl(0, fcntl.F_GETFL) | os.O_ASYNC)
        # It may have closed before.
        if select.select([0], [], [], 0)[0]:
            os._exit(1)
    else:
        threading.Thread(target=lambda: (os.read(0, 1), os._exit(1)), daemon=True).start()


def _portable(exception: Exception) -> Exception:
    """An exception as it can travel, with its traceback as a note; of any lack of memory, a ``MemoryError``."""
    if isinstance(exception, MemoryError) or getattr(exception, "errno", None) == errno.ENOMEM:
        return MemoryError()
    if not isinstance(exception, ShapevizError):
        exception.add_note("".join(traceback.format_exception(exception)))
    try:
        pickle.loads(pickle.dumps(exception))
    except Exception:
        return RuntimeError("".join(traceback.format_exception(exception)))
    return exception


if __name__ == "__main__":
    serve(int(sys.argv[1]))
