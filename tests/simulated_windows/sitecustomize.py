"""Python as it is on Windows, as far as :mod:`shapeviz_report` meets it: on the path of a process, before all else.

What Windows lacks is taken away from everybody. What only Windows has is there for ``system/windows.py`` alone, made of
what this system has: how files are shared, of locks; what a process inherits, of descriptors.
"""

from __future__ import annotations

import ctypes
import fcntl
import importlib.abc
import importlib.machinery
import multiprocessing.connection
import os
import signal
import subprocess
import sys
import types

# What the standard library takes from this system, it takes before that is gone.
for _module in ("asyncio", "shutil", "socket", "tempfile"):
    importlib.import_module(_module)

LACKING_MODULES = ("fcntl", "grp", "pty", "pwd", "resource", "syslog", "termios", "tty")
LACKING = {
    os: """
        O_ASYNC O_NOFOLLOW O_NONBLOCK chown fork forkpty getegid geteuid getgid getuid killpg mkfifo sched_getaffinity
        setsid statvfs sysconf
        """,
    signal: """
        SIGALRM SIGHUP SIGIO SIGPIPE SIGUSR1 SIGUSR2 SIG_BLOCK SIG_SETMASK SIG_UNBLOCK alarm pthread_sigmask setitimer
        sigwait
        """,
}

SHARING_VIOLATION = 32
SHARE_WRITE = 2
DELETE_ON_CLOSE = 0x04000000

_popen, _flock, _set_inheritable = subprocess.Popen, fcntl.flock, os.set_inheritable


def create_file(
    path: str, access: int, share: int, security: int, creation: int, flags: int, template: int
) -> int:
    """A handle of a file or folder that is open for writing. Who shares writing holds a shared lock, who does not an
    exclusive one."""
    assert access & 2
    temporary = bool(flags & DELETE_ON_CLOSE)
    handle = os.open(path, os.O_RDWR | os.O_CREAT if temporary else os.O_RDONLY)
    try:
        _flock(handle, (fcntl.LOCK_SH if share & SHARE_WRITE else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except BlockingIOError as error:
        os.close(handle)
        refused = PermissionError(13, "The process cannot access the file", path)
        refused.winerror = SHARING_VIOLATION  # type: ignore[misc]
        raise refused from error
    if temporary:
        _temporary[handle] = path
    return handle


_temporary: dict[int, str] = {}


def close_handle(handle: int) -> None:
    if handle in _temporary:
        os.unlink(_temporary.pop(handle))
    os.close(handle)


class StartupInfo:
    def __init__(self, lpAttributeList: dict[str, list[int]]) -> None:
        self.handles = lpAttributeList["handle_list"]


class Popen(subprocess.Popen):  # type: ignore[type-arg]
    """Hands on what Windows is told to."""

    def __init__(self, *arguments, startupinfo=None, creationflags=0, **options) -> None:
        if startupinfo is not None:
            assert all(map(os.get_inheritable, startupinfo.handles))
            options["pass_fds"] = startupinfo.handles
        super().__init__(*arguments, **options)


class Memory:
    """``kernel32.dll``, for how much memory is free."""

    def __init__(self, name: str, use_last_error: bool) -> None:
        assert (name, use_last_error) == ("kernel32", True)

    def GlobalMemoryStatusEx(self, status) -> bool:
        status = status._obj
        assert status.length == ctypes.sizeof(status) == 64
        status.available_physical = 8 * 2**30
        return True


class Loader(importlib.abc.Loader):
    """Runs a module as on Windows."""

    def __init__(self, loader) -> None:
        self.loader = loader

    def create_module(self, spec):
        return self.loader.create_module(spec)

    def exec_module(self, module) -> None:
        platform, sys.platform = sys.platform, "win32"
        sys.modules["_winapi"] = WINAPI
        try:
            self.loader.exec_module(module)
        finally:
            sys.platform = platform
            sys.modules.pop("_winapi", None)


class Finder(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name not in ("shapeviz_report.system", "shapeviz_report.system.windows"):
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, path)
        spec.loader = Loader(spec.loader)
        return spec


WINAPI = types.ModuleType("_winapi")
WINAPI.__dict__.update(NULL=0, OPEN_EXISTING=3, CreateFile=create_file, CloseHandle=close_handle)
subprocess.Popen = Popen  # type: ignore[misc]
subprocess.STARTUPINFO = StartupInfo
subprocess.CREATE_NEW_PROCESS_GROUP = 0x200
signal.SIGBREAK = signal.SIGQUIT
multiprocessing.connection.PipeConnection = multiprocessing.connection.Connection
os.set_handle_inheritable = _set_inheritable
os.O_BINARY = 0
ctypes.WinDLL = Memory
for _module in LACKING_MODULES:
    sys.modules[_module] = None  # type: ignore[assignment]
for _owner, _names in LACKING.items():
    for _name in _names.split():
        delattr(_owner, _name)
sys.meta_path.insert(0, Finder())
