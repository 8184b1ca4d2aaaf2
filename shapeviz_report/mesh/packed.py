"""A mesh in a file of gzip or ZIP. Names in it are data: nothing is ever written under them."""

from __future__ import annotations

import lzma
import zlib
from io import BytesIO
from pathlib import PurePosixPath
from posixpath import join, normpath
from zipfile import BadZipFile, ZipFile, ZipInfo

from shapeviz_report.database.finder import any_case
from shapeviz_report.database.formats import split_name, suffix_of
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.looks import collect_looks
from shapeviz_report.mesh.readers.gltf import GLTF, list_buffers
from shapeviz_report.mesh.readers.limits import MOST_UNPACKED, check_unpacked
from shapeviz_report.mesh.readers.sniff import what_it_seems

_GZIP_HEAD = b"\x1f\x8b"
_GZIP = 16 + zlib.MAX_WBITS
"""How zlib is told of the head and the end of a file of gzip."""


def unpack(name: str, data: bytes) -> dict[str, bytes]:
    """The files in a packed one.

    Parameters
    ----------
    name : str
        Such as ``chair.obj.gz``: it says what is in it, and how it is packed.
    data : bytes

    Returns
    -------
    dict of str to bytes
        As of :func:`shapeviz_report.mesh.read.collect_files`: the mesh first, then, of a ZIP archive, the others that
        it names.

    Raises
    ------
    MeshError
        It is not packed so, damaged, holds none or several meshes of the format, or unpacks to too much.
    """
    stem, suffix = split_name(name)
    format, packed = suffix.rsplit(".", 1)
    if packed == "gz":
        content = _gunzip(data)
        if format in GLTF and content.strip() and (names := list_buffers(content)):
            raise MeshError(f"it refers to {names[0][:100]!r}, which is not in it: pack both as {format}.zip")
        return {stem + format: content}
    try:
        with ZipFile(BytesIO(data)) as archive:
            return _unzip(archive, format)
    except BadZipFile as error:
        raise MeshError(f"it is no ZIP archive, {_instead(data, b'PK')}") from error


def _gunzip(data: bytes) -> bytes:
    """The content of one or several members, one after the other."""
    parts: list[bytes] = []
    left = MOST_UNPACKED
    while data:
        member = zlib.decompressobj(_GZIP)
        try:
            parts.append(member.decompress(data, left + 1))
        except zlib.error as error:
            if parts and not data.strip(b"\0"):
                break  # some programs fill up the last block
            raise MeshError(f"it is not compressed with gzip, {_instead(data, _GZIP_HEAD)}") from error
        left -= len(parts[-1])
        check_unpacked(MOST_UNPACKED - left)
        if not member.eof:
            raise MeshError("it is cut off: its compressed content has no end")
        data = member.unused_data
    return parts[0] if len(parts) == 1 else b"".join(parts)


def _instead(data: bytes, head: bytes) -> str:
    """What a file is that cannot be unpacked, though it may begin as packed ones do."""
    seems = None if data.startswith(head) else what_it_seems(data)
    return "or damaged" if seems is None else f"but seems to be {seems}"


def _unzip(archive: ZipFile, format: str) -> dict[str, bytes]:
    for info in archive.infolist():  # older programs of Windows part folders so
        info.filename = info.filename.replace("\\", "/")
    entries = [info for info in archive.infolist() if not info.is_dir() and not _is_hidden(info.filename)]
    meshes = [info for info in entries if suffix_of(info.filename) == format]
    if len(meshes) != 1:
        names = ", ".join(info.filename[:100] for info in (meshes or entries)[:3])
        more = ", ..." if len(meshes or entries) > 3 else ""
        if meshes:
            raise MeshError(
                f"it holds {len(meshes)} meshes ({names}{more}), and not one: give each its own file"
            )
        raise MeshError(f"it holds no {format} file" + (f", but {names}{more}" if names else ""))
    path = PurePosixPath(meshes[0].filename)
    files = {path.name: _read(archive, meshes[0], 0)}
    alike: dict[str, list[ZipInfo]] = {}
    for info in entries:
        alike.setdefault(any_case(info.filename), []).append(info)

    def find(name: str) -> ZipInfo | None:
        """The file of a name, from the folder of the mesh; in another case where it is the only one."""
        wanted = normpath(join(path.parent.as_posix(), name))
        found = alike.get(any_case(wanted), [])
        exact = [info for info in found if info.filename == wanted]
        return (exact or found)[-1] if exact or len(found) == 1 else None

    def read(name: str, most: int) -> bytes | None:
        """A file of colours, without which the surface is shown too."""
        info = find(name)
        if info is None or info.file_size > most:
            return None
        try:
            return _read(archive, info, sum(map(len, files.values())))
        except MeshError:
            return None

    if format in GLTF and files[path.name].strip():
        for name in list_buffers(files[path.name]):
            if (buffer := find(name)) is None:
                raise MeshError(f"it refers to {name[:100]!r}, which is not in it")
            files[name] = _read(archive, buffer, sum(map(len, files.values())))
    looks = collect_looks(format, files[path.name], read)
    return files | {name: content for name, content in looks.items() if name not in files}


def _is_hidden(name: str) -> bool:
    """Whether a file is hidden, or one of those that macOS puts beside every file."""
    return name.startswith("__MACOSX/") or PurePosixPath(name).name.startswith(".")


def _read(archive: ZipFile, info: ZipInfo, before: int) -> bytes:
    """A file of an archive, of which so many bytes were unpacked ``before``."""
    name = info.filename[:100]
    check_unpacked(before + info.file_size)
    if info.flag_bits & 1:
        raise MeshError("it is encrypted")
    try:
        with archive.open(info) as file:
            # no more than it has announced, whatever comes
            content = file.read(info.file_size + 1)
    except NotImplementedError as error:
        raise MeshError(
            f"it is compressed in a way that is not read (method {info.compress_type}); save it anew"
        ) from error
    except (zlib.error, lzma.LZMAError, EOFError, OSError, ValueError, BadZipFile) as error:
        raise MeshError(f"it is damaged: {name!r} cannot be unpacked from it") from error
    if len(content) != info.file_size:
        raise MeshError(f"it is damaged: {name!r} has another size than it says")
    return content
