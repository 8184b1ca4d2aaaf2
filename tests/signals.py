"""Signals as a terminal has them, whatever the tests were started from."""

import signal


def hear_signals() -> None:
    """Before a program starts: what runs in the background, or below ``nohup``, ignores some."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
