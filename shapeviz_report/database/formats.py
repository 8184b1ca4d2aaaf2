"""Which files are meshes: what is read, what is a mesh of a format that is not read, and what is neither."""

from __future__ import annotations

import os

MESH_FORMATS = {
    ".off": "OFF",
    ".obj": "OBJ",
    ".ply": "PLY",
    ".stl": "STL",
    ".gltf": "glTF",
    ".glb": "glTF",
    ".3mf": "3MF",
    ".dae": "COLLADA",
}
"""Suffix (in lower case) -> name of the format, for every mesh format that is read."""

_UNREAD_FORMATS = frozenset(
    # modelling programs, scenes
    {".3dm", ".3ds", ".abc", ".ac", ".blend", ".c4d", ".cob", ".fbx", ".lwo", ".lws", ".ma", ".max", ".mb"}
    | {".ms3d", ".nff", ".skp", ".usd", ".usda", ".usdc", ".usdz", ".vrml", ".wrl", ".wrz", ".x3d", ".zae"}
    # CAD
    | {".3dxml", ".brep", ".dwg", ".dxf", ".iges", ".igs", ".ipt", ".jt", ".sat", ".sldasm", ".sldprt"}
    | {".step", ".stp", ".x_b", ".x_t"}
    # meshes, volumes and point clouds of research and printing
    | {".amf", ".binvox", ".ctm", ".drc", ".las", ".mesh", ".meshb", ".msh", ".pcd", ".smf", ".vtk", ".vtp"}
    | {".vtu", ".xyz"}
)
_COMPRESSED = frozenset({".7z", ".bz2", ".gz", ".lzma", ".rar", ".tar", ".tgz", ".xz", ".zip", ".zst"})


def suffix_of(name: str) -> str:
    """The last suffix of a file name, in lower case; empty if there is none."""
    suffix = os.path.splitext(name)[1].lower()
    return suffix if suffix != "." else ""


def is_read(name: str) -> bool:
    """Whether a file of this name is a mesh in one of :data:`MESH_FORMATS`."""
    return suffix_of(name) in MESH_FORMATS


def is_unread_mesh(name: str) -> bool:
    """Whether a file of this name plainly is a 3D model, but of a format (or packed so) that is not read."""
    suffix = suffix_of(name)
    if suffix in _COMPRESSED:
        inner = suffix_of(os.path.splitext(name)[0])
        return inner in MESH_FORMATS or inner in _UNREAD_FORMATS
    return suffix in _UNREAD_FORMATS


def why_not_read(name: str) -> str:
    """The reason, for the owner of a file whose name is not one that :func:`is_read`."""
    suffix = suffix_of(name)
    if suffix in _COMPRESSED:
        return f"compressed files ({suffix}) are not read; unpack it first"
    problem = (
        f"files of format {suffix} are not read" if suffix else "its name has no suffix that tells its format"
    )
    return f"{problem}; convert it to one of {', '.join(MESH_FORMATS)}"
