"""Surfaces compressed with Draco, as glTF holds them: https://google.github.io/draco/spec/"""

from __future__ import annotations

import DracoPy
import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.readers.polygons import Indices


def decode_draco(content: bytes) -> tuple[Indices, dict[int, npt.NDArray[np.generic]]]:
    """The corners (3 m, 1) of a surface's triangles, and (n, d) values of its vertices by the id of the attribute.

    Raises
    ------
    MeshError
        It is anything else, or damaged.
    """
    try:
        found = DracoPy.decode(content)
        attributes = {known["unique_id"]: np.atleast_2d(known["data"]) for known in found.attributes}
        corners = np.asarray(found.faces, np.int64).reshape(-1, 1)
    except MemoryError:
        raise
    except Exception as error:  # of its own kinds, and any that a damaged file may lead to
        raise MeshError("what it has compressed with Draco is damaged, or cut off") from error
    return corners, attributes
