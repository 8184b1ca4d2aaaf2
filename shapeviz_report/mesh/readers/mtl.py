"""The materials of Wavefront OBJ (MTL): the colour of light that is scattered, and its picture."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from shapeviz_report.mesh.paint import as_bytes
from shapeviz_report.mesh.readers.text import decode, strip_comments

_LIBRARY = re.compile(rb"^[ \t]*mtllib[ \t]+([^\r\n]+)", re.MULTILINE | re.IGNORECASE)
_OPTIONS = re.compile(
    r"(?:-(?:blendu|blendv|cc|clamp|texres|bm|boost|imfchan|type)\s+\S+\s+"
    r"|-[ost](?:\s+[-+.\deE]+){1,3}\s+|-mm\s+\S+\s+\S+\s+)*"
)


@dataclass(frozen=True)
class Material:
    """A material.

    Attributes
    ----------
    color : (3,) uint8 array
        ``Kd``; white without.
    picture : str
        ``map_Kd``, ``/`` between folders; empty without.
    """

    color: npt.NDArray[np.uint8]
    picture: str = ""


WHITE = Material(np.full(3, 255, np.uint8))


def list_materials(data: bytes) -> list[str]:
    """The files of materials that an OBJ names, as :func:`list_libraries` has them, each once."""
    return list(dict.fromkeys(name for names in list_libraries(data) for name in names))


def list_libraries(data: bytes) -> list[list[str]]:
    """What files each line of an OBJ may mean that names materials: all of it, and its words if there are several."""
    lines = _LIBRARY.findall(data) if b"mtllib" in data or b"MTLLIB" in data else ()
    names = [_plain(line.decode("utf-8", "replace")) for line in lines]
    return [[whole, *(whole.split() if " " in whole else ())] for whole in names]


def read_materials(data: bytes) -> dict[str, Material]:
    """The materials of a file by name. What is not written as it should be is passed over."""
    materials: dict[str, Material] = {}
    name = None
    for line in strip_comments(decode(data)).split("\n"):
        keyword, rest = [*line.strip().split(maxsplit=1), "", ""][:2]
        if keyword.lower() == "newmtl":
            name = rest
            materials[name] = WHITE
        elif name is not None and keyword.lower() == "kd":
            try:
                color = as_bytes(np.array(rest.split()[:3], np.float64), whole=False)
            except ValueError:
                continue
            if color.shape == (3,):
                materials[name] = Material(color, materials[name].picture)
        elif name is not None and keyword.lower() == "map_kd":
            materials[name] = Material(materials[name].color, _plain(_OPTIONS.sub("", rest, count=1)))
    # a black that would hide its picture is what some programs write beside one
    return {
        name: Material(WHITE.color, material.picture)
        if material.picture and not material.color.any()
        else material
        for name, material in materials.items()
    }


def _plain(name: str) -> str:
    return name.strip().strip('"').replace("\\", "/")
