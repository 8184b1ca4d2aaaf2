"""What one system has and another has not: signals, locks, bounds of memory, processes and their pipes.

The one place that asks which system this is. ``posix.py`` and ``windows.py`` have the same functions.
"""

import sys

if sys.platform == "win32":
    from shapeviz_report.system.windows import (
        LACKING_MEMORY,
        PipeEnd,
        alone_in,
        bound_memory,
        cache_folder,
        claimed,
        core_count,
        end_with_parent,
        exchange,
        fate,
        free_memory,
        held,
        is_link,
        is_mount_point,
        open_for_reading,
        start_listening,
        start_process,
    )
else:
    from shapeviz_report.system.posix import (
        LACKING_MEMORY,
        PipeEnd,
        alone_in,
        bound_memory,
        cache_folder,
        claimed,
        core_count,
        end_with_parent,
        exchange,
        fate,
        free_memory,
        held,
        is_link,
        is_mount_point,
        open_for_reading,
        start_listening,
        start_process,
    )

__all__ = [
    "LACKING_MEMORY",
    "PipeEnd",
    "alone_in",
    "bound_memory",
    "cache_folder",
    "claimed",
    "core_count",
    "end_with_parent",
    "exchange",
    "fate",
    "free_memory",
    "held",
    "is_link",
    "is_mount_point",
    "open_for_reading",
    "start_listening",
    "start_process",
]
