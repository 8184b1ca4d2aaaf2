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
PACKED = (".gz", ".zip")
"""Suffixes behind that of a mesh, which is read from inside."""

MESH_SUFFIXES = (*MESH_FORMATS, *(suffix + packed for packed in PACKED for suffix in MESH_FORMATS))
"""All that the name of a mesh may end in, plain ones first."""

_COMPRESSED = frozenset({*PACKED, ".7z", ".bz2", ".lzma", ".rar", ".tar", ".tgz", ".xz", ".zst"})


def suffix_of(name: str) -> str:
    """The last suffix of a file name, in lower case; empty if there is none."""
    suffix = os.path.splitext(name)[1].lower()
    return suffix if suffix != "." else ""


def split_name(name: str) -> tuple[str, str]:
    """A file name in two: ``chair`` and ``.obj.gz``, or ``.obj``; the suffix in lower case, both of a packed mesh."""
    stem, suffix = os.path.splitext(name)
    inner, format = os.path.splitext(stem)
    if suffix.lower() in PACKED and format.lower() in MESH_FORMATS:
        return inner, (format + suffix).lower()
    return stem, suffix_of(name)


def is_read(name: str) -> bool:
    """Whether a file of this name is a mesh in one of :data:`MESH_FORMATS`, packed or not."""
    return split_name(name)[1] in MESH_SUFFIXES


def format_of(name: str) -> str:
    """The format of a file whose name :func:`is_read`, as in :data:`MESH_FORMATS`."""
    return MESH_FORMATS["." + split_name(name)[1].split(".")[1]]


def is_unread_mesh(name: str) -> bool:
    """Whether a file of this name plainly is a 3D model, but of a format (or packed so) that is not read."""
    suffix = suffix_of(name)
    if suffix in _COMPRESSED:
        inner = suffix_of(_unpacked(name))
        return not is_read(name) and (inner in MESH_FORMATS or inner in _UNREAD_FORMATS)
    return suffix in _UNREAD_FORMATS


def _unpacked(name: str) -> str:
    """A name without any suffixes of compressed files."""
    while suffix_of(name) in _COMPRESSED:
        name = os.path.splitext(name)[0]
    return name


def why_not_read(name: str) -> str:
    """The reason, for the owner of a file whose name is not one that :func:`is_read`."""
    suffix = suffix_of(name)
    inner = suffix_of(_unpacked(name))
    if suffix in PACKED and inner not in MESH_FORMATS and inner not in _UNREAD_FORMATS:
        return f"its name does not tell the format of the mesh in it: call it NAME.obj{suffix}, for instance"
    if suffix in _COMPRESSED and inner not in _UNREAD_FORMATS:
        packed = "files packed twice" if suffix in PACKED else f"compressed files ({suffix})"
        return f"{packed} are not read; unpack it first, or pack it as {inner or '.obj'}.gz"
    problem = (
        f"files of format {inner} are not read" if inner else "its name has no suffix that tells its format"
    )
    return f"{problem}; convert it to one of {', '.join(MESH_FORMATS)}"
