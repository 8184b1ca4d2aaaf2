"""Sheets of small pictures, which maps of very many shapes show."""

from __future__ import annotations

import io
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor

from PIL import Image

from shapeviz_report.pages.map_pictures import ACROSS, map_pictures, sheet_name
from shapeviz_report.pages.overview import thumbnail_name
from shapeviz_report.types import Report

#: Pixels on a side of a picture, which a map shows from half as large to half as large again.
SIDE = 64

QUALITY, ALPHA_QUALITY = 50, 60


def write_sheets(report: Report) -> Iterator[tuple[str, bytes]]:
    """The sheets of a report, each with its path in the site."""
    names = [thumbnail_name(thumbnail) for thumbnail in report.thumbnails] if map_pictures(report) else []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for pictures in map_pictures(report).values():
            sheets = pictures.sheets()
            drawn = pool.map(lambda rows: draw_sheet([report.thumbnails[row] for row in rows]), sheets)
            for rows, content in zip(sheets, drawn, strict=True):
                yield f"sheets/{sheet_name(rows, names)}", content


def draw_sheet(thumbnails: Sequence[bytes]) -> bytes:
    """A WebP image of up to ``ACROSS`` times ``ACROSS`` pictures beside and below each other."""
    sheet = Image.new("RGBA", (ACROSS * SIDE, ACROSS * SIDE))
    for place, thumbnail in enumerate(thumbnails):
        with Image.open(io.BytesIO(thumbnail)) as picture:
            small = picture.convert("RGBA").resize((SIDE, SIDE), Image.Resampling.LANCZOS, reducing_gap=2)
        sheet.paste(small, (place % ACROSS * SIDE, place // ACROSS * SIDE))
    written = io.BytesIO()
    sheet.save(written, "WEBP", quality=QUALITY, alpha_quality=ALPHA_QUALITY)
    return written.getvalue()
