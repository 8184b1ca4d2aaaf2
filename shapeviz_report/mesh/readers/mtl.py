"""The materials of Wavefront OBJ (MTL): the colour of light that is scattered, and its picture."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from posixpath import dirname, isabs, join

import numpy as np
import numpy.typing as npt

from shapeviz_report.mesh.paint import Wrap, as_bytes
from shapeviz_report.mesh.readers.text import decode, in_utf8

_LIBRARY = re.compile(rb"^[ \t]*mtllib[ \t]+([^\r\n]+)", re.MULTILINE | re.IGNORECASE)
_OPTION = re.compile(
    r"-(?:(blendu|blendv|cc|clamp|texres|bm|boost|imfchan|type)(\s+\S+)|(mm)(\s+\S+\s+\S+)"
    r"|([ost])((?:\s+[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?){1,3}))\s+",
    re.ASCII,
)
_COMMENT = re.compile(r"(?:^|\s)#(?:\s.*)?$")
"""Behind a name, which may have the character in it: ``Material #25``."""


@dataclass(frozen=True)
class Material:
    """A material.

    Attributes
    ----------
    color : (3,) uint8 array
        ``Kd``; white without.
    picture : str
        ``map_Kd``, ``/`` between folders, from the folder of the mesh; empty without.
    scale, offset : (float, float)
        How the picture lies on the surface: it has at a place what it has at ``scale * place + offset``.
    wrap : Wrap
        What lies beyond it.
    """

    color: npt.NDArray[np.uint8] = field(default_factory=lambda: np.full(3, 255, np.uint8))
    picture: str = ""
    scale: tuple[float, float] = (1.0, 1.0)
    offset: tuple[float, float] = (0.0, 0.0)
    wrap: Wrap = "repeat"


WHITE = Material()


def list_materials(data: bytes) -> list[str]:
    """The files of materials that an OBJ names, as :func:`list_libraries` has them, each once."""
    return list(dict.fromkeys(name for names in list_libraries(data) for name in names))


def list_libraries(data: bytes) -> list[list[str]]:
    """What files each line of an OBJ may mean that names materials: all of it, and its words if there are several."""
    lines = _LIBRARY.findall(data) if b"mtllib" in data or b"MTLLIB" in data else ()
    names = [file_name(line.decode("latin-1")) for line in lines]
    return [[whole, *(whole.split() if " " in whole else ())] for whole in names]


def read_materials(data: bytes, file: str) -> dict[str, Material]:
    """The materials of a file, which lies where its name says, by name. What is not written as it should be is passed
    over."""
    materials: dict[str, Material] = {}
    name = None
    for line in decode(data).split("\n"):
        keyword, rest = [*line.strip().split(maxsplit=1), "", ""][:2]
        if keyword.lower() == "newmtl":
            name = plain_name(rest)
            materials[name] = WHITE
        elif name is not None and keyword.lower() == "kd":
            try:
                color = as_bytes(np.array(rest.split()[:3], np.float64), most=1)
            except ValueError:
                continue
            if color.shape == (3,):
                materials[name] = replace(materials[name], color=color)
        elif name is not None and keyword.lower() == "map_kd":
            materials[name] = _with_picture(materials[name], rest, dirname(file))
    # a black that would hide its picture is what some programs write beside one
    return {
        name: replace(material, color=WHITE.color)
        if material.picture and not material.color.any()
        else material
        for name, material in materials.items()
    }


def plain_name(words: str) -> str:
    """A name that stands behind a keyword, without a comment."""
    return _COMMENT.sub("", words).strip()


def _with_picture(material: Material, words: str, folder: str) -> Material:
    """A material with the picture that a line names behind options: how it lies, and others that are passed over."""
    scale, offset, wrap = [1.0, 1.0], [0.0, 0.0], WHITE.wrap
    while option := _OPTION.match(words):
        name, *values = " ".join(filter(None, option.groups())).split()
        if name == "clamp" and values[0].lower() == "on":
            wrap = "clamp"
        elif name in ("s", "o"):
            for axis, value in enumerate(values[:2]):
                (scale if name == "s" else offset)[axis] = float(value)
        words = words[option.end() :]
    picture = file_name(words)
    if picture and not isabs(picture):
        picture = join(folder, picture)
    return replace(
        material, picture=picture, scale=(scale[0], scale[1]), offset=(offset[0], offset[1]), wrap=wrap
    )


def file_name(words: str) -> str:
    """A name of a file that stands behind a keyword, ``/`` between folders."""
    return in_utf8(plain_name(words).strip('"').replace("\\", "/"))
