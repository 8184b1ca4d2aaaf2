"""What can go wrong for a user, said as a user needs it: what, where, and what to do.

Everything that is not a :class:`ShapevizError` is a bug and keeps its traceback.
"""

from __future__ import annotations


class ShapevizError(Exception):
    """An error that its message alone explains: what is wrong, in which file, what to do.

    Each argument is a line of the message, so that a name with a line break in it begins none.
    """

    @property
    def lines(self) -> tuple[str, ...]:
        return tuple(map(str, self.args)) or (type(self).__name__,)

    def __str__(self) -> str:
        return "\n".join(self.lines)


class ConfigError(ShapevizError):
    """An option, a flag or a line of ``shapeviz.toml`` that cannot be followed."""


class DatabaseError(ShapevizError):
    """A shape database that cannot be read as a whole."""


class MeshError(ShapevizError):
    """One mesh that cannot be used; it is reported as a failure and the build goes on."""


class RenderError(ShapevizError):
    """Pictures cannot be made on this machine as asked for (OSMesa is missing, for instance)."""


class WorkerError(ShapevizError):
    """The machine cannot run worker processes."""


class CacheError(ShapevizError):
    """Results that cannot be kept where they were to be."""


class ClusterError(ShapevizError):
    """A Dask cluster that cannot be used, or no longer."""


class PluginError(ShapevizError):
    """A part that another package brings along, and that cannot be used."""


class SiteError(ShapevizError):
    """The site cannot be written where it was asked for."""
