"""Objects through the pipe between an executor and its workers, piece by piece: a task may be a gigabyte, of which
neither side makes a copy."""

from __future__ import annotations

import io
import pickle
from typing import Any

from shapeviz_report.system import PipeEnd

_PIECE = 2**20
"""Bytes that go through the pipe at once."""


class _Sink:
    def __init__(self, connection: PipeEnd) -> None:
        self.connection = connection

    def write(self, data: Any) -> int:
        whole = memoryview(data).cast("B")
        for start in range(0, len(whole), _PIECE):
            self.connection.send_bytes(whole[start : start + _PIECE])
        return len(whole)


class _Source(io.RawIOBase):
    def __init__(self, connection: PipeEnd) -> None:
        self.connection = connection
        self.rest = memoryview(b"")

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        if not self.rest:
            try:
                self.rest = memoryview(self.connection.recv_bytes())
            except EOFError:
                return 0
        count = min(len(buffer), len(self.rest))
        buffer[:count] = self.rest[:count]
        self.rest = self.rest[count:]
        return count


class Channel:
    """One end of the pipe.

    Parameters
    ----------
    connection : PipeEnd
    """

    def __init__(self, connection: PipeEnd) -> None:
        self.connection = connection
        self._sink = _Sink(connection)
        self._source = io.BufferedReader(_Source(connection))

    def send(self, message: object) -> None:
        """Send an object.

        Raises
        ------
        ConnectionError
            The other end is closed.
        """
        pickle.dump(message, self._sink, pickle.HIGHEST_PROTOCOL)

    def receive(self) -> Any:
        """The next object; waits for it.

        Raises
        ------
        EOFError, ConnectionError, pickle.UnpicklingError
            The other end is closed.
        """
        return pickle.load(self._source)
