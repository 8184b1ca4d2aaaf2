"""Running one function over many inputs: in processes of this machine, or on a Dask cluster."""

from shapeviz_report.executor.apart import call_apart
from shapeviz_report.executor.base import Executor, Outcome
from shapeviz_report.executor.local import LocalExecutor
from shapeviz_report.executor.memory import memory_share

__all__ = ["Executor", "LocalExecutor", "Outcome", "call_apart", "memory_share"]
