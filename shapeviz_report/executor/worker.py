"""What runs in a worker process of :class:`~shapeviz_report.executor.local.LocalExecutor`."""

from __future__ import annotations

import errno
import pickle
import signal
import sys
import time
import traceback

from shapeviz_report.ending import ASKING
from shapeviz_report.errors import ShapevizError
from shapeviz_report.executor.channel import Channel
from shapeviz_report.executor.pauses import tell_pauses
from shapeviz_report.system import PipeEnd, end_with_parent, start_listening


def serve(connection: PipeEnd) -> None:
    """The life of a worker: take a task, answer with (value, error, CPU seconds), until the pipe closes.

    True and False before an answer tell of a pause that begins and ends.
    """
    # Ctrl-C reaches every process of the terminal; the parent alone decides what it means.
    for number in ASKING:
        signal.signal(number, signal.SIG_IGN if number == signal.SIGINT else signal.SIG_DFL)
    start_listening()
    end_with_parent()
    tell_pauses(connection.send)
    tasks = Channel(connection)
    reported = 0.0
    while True:
        try:
            function, task = tasks.receive()
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
    serve(PipeEnd(int(sys.argv[1])))
