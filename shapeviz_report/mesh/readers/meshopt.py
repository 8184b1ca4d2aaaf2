"""Buffers compressed with the codecs of meshoptimizer, as glTF holds them.

https://github.com/KhronosGroup/glTF/blob/main/extensions/2.0/Vendor/EXT_meshopt_compression/README.md, appendix A for
the bit streams, appendix B for the filters. There is no wheel of the library that is kept up on all systems; the
streams are simple.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel
from shapeviz_report.errors import MeshError

Bytes = npt.NDArray[np.uint8]

_DAMAGED = "what it has compressed with meshopt is damaged, cut off, or of a later version"


def decode_meshopt(content: bytes, count: int, stride: int, mode: str, filter: str) -> bytes:
    """``count`` elements of ``stride`` bytes.

    Parameters
    ----------
    content : bytes
    count, stride : int
    mode : str
        ``ATTRIBUTES``, ``TRIANGLES`` or ``INDICES``.
    filter : str
        ``NONE`` or ``EXPONENTIAL``; the others are for what is no position.

    Raises
    ------
    MeshError
        It is damaged, or of a kind that is not read.
    """
    data = np.frombuffer(content, np.uint8)
    if mode == "ATTRIBUTES" and stride % 4 == 0 and 0 < stride <= 256:
        # Every group of 16 elements has at least two bits a byte of an element: what is announced, the file has.
        if count // 16 * stride // 4 > len(data):
            raise MeshError(_DAMAGED)
        elements = np.zeros((count, stride), np.uint8)
        if not _decode_attributes(data, elements):
            raise MeshError(_DAMAGED)
        if filter == "EXPONENTIAL":
            return _expand(elements.view("<i4")).tobytes()
        if filter != "NONE":
            raise MeshError(
                f"its positions went through the filter {filter[:20]!r}, which is not for positions"
            )
        return elements.tobytes()
    if mode in ("TRIANGLES", "INDICES") and stride in (2, 4) and filter == "NONE":
        # a byte a triangle, or a corner, at least
        if count // 3 > len(data):
            raise MeshError(_DAMAGED)
        corners = np.zeros(count, np.uint32)
        decode = _decode_triangles if mode == "TRIANGLES" else _decode_indices
        if (mode == "TRIANGLES" and count % 3) or not decode(data, corners):
            raise MeshError(_DAMAGED)
        return corners.astype(f"<u{stride}").tobytes()
    raise MeshError(
        f"it has a buffer compressed with meshopt in a way that is not read ({mode[:20]!r}, {stride} bytes)"
    )


def _expand(packed: npt.NDArray[np.int32]) -> npt.NDArray[np.float32]:
    """Numbers of 24 bits of mantissa and 8 of exponent."""
    mantissa, exponent = packed << 8 >> 8, packed >> 24
    return np.ldexp(mantissa.astype(np.float64), exponent).astype("<f4")


@kernel()
def _decode_attributes(data: Bytes, elements: Bytes) -> bool:
    """Byte by byte of the elements, groups of 16 differences to the element before; False for a stream that is none."""
    count, stride = elements.shape
    tail = max(stride, 32)
    if len(data) < 1 + tail or data[0] != 0xA0:
        return False
    end = len(data) - tail
    last = data[len(data) - stride :].copy()
    in_block = min(8192 // stride & ~15, 256)
    place = 1
    for start in range(0, count, in_block):
        size = min(in_block, count - start)
        groups = (size + 15) // 16
        for byte in range(stride):
            head = place
            place += (groups + 3) // 4
            if place > end:
                return False
            value = np.int64(last[byte])
            for group in range(groups):
                bits = data[head + group // 4] >> (group % 4 * 2) & 3
                width = 0 if bits == 0 else 1 << np.int64(bits)
                packed, place = place, place + 2 * width
                if place > end:
                    return False
                for number in range(16):
                    if width == 8:
                        delta = np.int64(data[packed + number])
                    elif width == 0:
                        delta = np.int64(0)
                    else:
                        each = 8 // width
                        shift = 8 - width * (number % each + 1)
                        most = (1 << width) - 1
                        delta = np.int64(data[packed + number // each]) >> shift & most
                        if delta == most:
                            if place >= end:
                                return False
                            delta = np.int64(data[place])
                            place += 1
                    row = group * 16 + number
                    if row < size:
                        value = (value + (delta >> 1 ^ -(delta & 1))) & 0xFF
                        elements[start + row, byte] = value
            last[byte] = value
    return place == end


@kernel()
def _read_number(data: Bytes, place: int, end: int) -> tuple[np.int64, int]:
    """A number of seven bits a byte, and where the next begins; beyond the end if it is cut off."""
    value = np.int64(0)
    for number in range(5):
        if place >= end:
            return np.int64(0), end + 1
        byte = np.int64(data[place])
        place += 1
        value |= (byte & 0x7F) << (7 * number)
        if byte < 0x80:
            break
    return value & 0xFFFFFFFF, place


@kernel()
def _decode_indices(data: Bytes, corners: npt.NDArray[np.uint32]) -> bool:
    """Differences to one of two corners before; False for a stream that is none."""
    if len(data) < 5 or data[0] != 0xD1:
        return False
    end = len(data) - 4
    last = np.zeros(2, np.int64)
    place = 1
    for number in range(len(corners)):
        value, place = _read_number(data, place, end)
        if place > end:
            return False
        which, value = value & 1, value >> 1
        last[which] = (last[which] + (value >> 1 ^ -(value & 1))) & 0xFFFFFFFF
        corners[number] = last[which]
    return place == end


@kernel()
def _remember(edges: npt.NDArray[np.int64], edge: int, start: int, end: int) -> int:
    edges[edge & 15, 0] = start
    edges[edge & 15, 1] = end
    return edge + 1


@kernel()
def _decode_triangles(data: Bytes, corners: npt.NDArray[np.uint32]) -> bool:
    """Triangles by edges and corners that came before; False for a stream that is none."""
    count = len(corners) // 3
    if len(data) < 1 + count + 16 or data[0] != 0xE1:
        return False
    end = len(data) - 16  # a table of usual pairs
    place = 1 + count
    edges = np.zeros((16, 2), np.int64)
    recent = np.zeros(16, np.int64)
    edge = vertex = 0
    fresh = last = np.int64(0)
    for triangle in range(count):
        code = np.int64(data[1 + triangle])
        if code < 0xF0:
            used = (edge - 1 - (code >> 4)) & 15
            a, b = edges[used, 0], edges[used, 1]
            third = code & 15
            if third == 0:
                c = fresh
                fresh += 1
            elif third < 13:
                c = recent[(vertex - 1 - third) & 15]
            else:
                if third == 15:
                    value, place = _read_number(data, place, end)
                    if place > end:
                        return False
                    last = (last + (value >> 1 ^ -(value & 1))) & 0xFFFFFFFF
                else:
                    last = (last + (1 if third == 14 else -1)) & 0xFFFFFFFF
                c = last
            if third == 0 or third >= 13:
                recent[vertex & 15] = c
                vertex += 1
            edge = _remember(edges, edge, c, b)
            edge = _remember(edges, edge, a, c)
        else:
            if code < 0xFE:
                pair = np.int64(data[end + (code & 15)])
                first = np.int64(0)
            else:
                if place >= end:
                    return False
                pair = np.int64(data[place])
                place += 1
                first = np.int64(0 if code == 0xFE else 15)
                if pair == 0:
                    fresh = np.int64(0)
            second, third = pair >> 4, pair & 15
            # With a pair of the table 15 is a corner that came before; else it is a number that follows.
            far = np.int64(16 if code < 0xFE else 15)
            a = b = c = np.int64(0)
            if first == 0:
                a = fresh
                fresh += 1
            if second == 0:
                b = fresh
                fresh += 1
            elif second < far:
                b = recent[(vertex - second) & 15]
            if third == 0:
                c = fresh
                fresh += 1
            elif third < far:
                c = recent[(vertex - third) & 15]
            for which, kind in enumerate((first, second, third)):
                if kind >= far:
                    value, place = _read_number(data, place, end)
                    if place > end:
                        return False
                    last = (last + (value >> 1 ^ -(value & 1))) & 0xFFFFFFFF
                    if which == 0:
                        a = last
                    elif which == 1:
                        b = last
                    else:
                        c = last
            recent[vertex & 15] = a
            vertex += 1
            if second == 0 or second >= far:
                recent[vertex & 15] = b
                vertex += 1
            if third == 0 or third >= far:
                recent[vertex & 15] = c
                vertex += 1
            edge = _remember(edges, edge, b, a)
            edge = _remember(edges, edge, c, b)
            edge = _remember(edges, edge, a, c)
        corners[3 * triangle] = a
        corners[3 * triangle + 1] = b
        corners[3 * triangle + 2] = c
    return place == end
